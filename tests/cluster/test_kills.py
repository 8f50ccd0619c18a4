"""A few runs ended by SIGKILL; scripts/kills ends hundreds."""
import unittest

import kills
from cluster import MPIRUN, PROGRAM


class Kills(unittest.TestCase):
    def test_nothing_is_lost_and_nothing_computed_twice(self):
        if not MPIRUN:
            raise unittest.SkipTest("no mpirun: scripts/setup test")
        totals = kills.check(PROGRAM, kills=10, seed=7, points=60)
        self.assertGreaterEqual(sum(totals[kind] for kind in kills.KINDS), 10)


if __name__ == "__main__":
    unittest.main()
