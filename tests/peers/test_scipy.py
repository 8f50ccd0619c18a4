"""Histories by SciPy's solve_ivp with terminal events."""
import json
import os
import subprocess
import sys
import unittest

from peers import HERE, PeerTest, pair, runs


def with_scipy():
    """An interpreter that has SciPy: this one, or Debian's."""
    for python in (sys.executable, "/usr/bin/python3"):
        if subprocess.run([python, "-c", "import scipy.integrate"], capture_output=True).returncode == 0:
            return python
    return None


PYTHON = with_scipy()


@unittest.skipUnless(PYTHON, "needs python3-scipy")
class SolveIvp(PeerTest):
    def setUp(self):
        super().setUp()
        with open(self.path("pair.json"), "w") as file:
            json.dump(pair(), file)

    def histories(self, name, method, step):
        files = self.path(name + ".csv"), self.path(name + "-events.txt")
        subprocess.run([PYTHON, os.path.join(HERE, "scipy_pair.py"), self.path("pair.json"), method,
                        step, *files], check=True)
        return files

    def test_tight_tolerance_agrees(self):
        history, events = self.histories("tight", "DOP853", "rtol=1e-12")
        subject = self.checked(history, "--events", events, "--tolerance", "1e-9")
        self.assert_six_impacts(runs(subject)[0], 1e-9)

    def test_large_steps_are_noted_as_few_rows(self):
        # Its own steps, a few a period.
        history, _ = self.histories("sparse", "DOP853", "rtol=1e-6")
        subject = self.checked(history)
        self.assertIn("few-rows-a-period", [note["code"] for note in runs(subject)[0]["file"]["notes"]])

    def test_equal_steps_have_the_order_of_the_method(self):
        steps = [0.04 / 2**n for n in range(5)]
        files = [self.histories(f"h{h:g}", "RK45", repr(h)) for h in steps]
        histories, events = [f[0] for f in files], [f[1] for f in files]
        with_events = [word for file in events for word in ("--events", file)]
        for arguments in (histories, histories + with_events):
            subject = self.checked(*arguments, "--expect", "proper:5")
            self.assertAlmostEqual(subject["assessment"]["displacement"]["order"], 5.0, delta=0.1)
            self.assertEqual([run["file"]["step_source"] for run in runs(subject)], ["name"] * 5)
        self.checked(*histories, "--expect", "proper:4", exit_code=1)


if __name__ == "__main__":
    unittest.main()
