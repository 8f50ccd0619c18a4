"""The messages between ranks, with empty tasks under mpirun."""
import os
import unittest

from cluster import CommandTest, mpirun

PROGRAM = os.environ["CLACKERS_DISPATCH"]
TASKS = 10000


class Dispatch(CommandTest):
    def blocks(self):
        found = []
        for name in os.listdir(self.folder):
            found += [tuple(map(int, line.split())) for line in self.text_of(name).splitlines()]
        return sorted(found)

    def check(self, ranks):
        done = mpirun(ranks, PROGRAM, self.folder, str(TASKS))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(os.listdir(self.folder)), ranks)
        at = 0
        for first, last in self.blocks():
            self.assertEqual(first, at)
            self.assertGreater(last, first)
            at = last
        self.assertEqual(at, TASKS)

    def test_one_rank(self):
        self.check(1)

    def test_two_ranks(self):
        self.check(2)

    def test_five_ranks(self):
        self.check(5)

    def test_64_ranks_on_any_number_of_cores(self):
        self.check(64)


if __name__ == "__main__":
    unittest.main()
