"""Histories by SUNDIALS CVODE with its root finding."""
import os
import subprocess
import unittest

from peers import HERE, PeerTest, pair, runs

LIBRARIES = ("-lsundials_cvode", "-lsundials_nvecserial", "-lsundials_sunlinsoldense",
             "-lsundials_sunmatrixdense", "-lm")


@unittest.skipUnless(os.path.exists("/usr/include/cvode/cvode.h"), "needs libsundials-dev")
class Cvode(PeerTest):
    def setUp(self):
        super().setUp()
        self.program = self.path("cvode_pair")
        subprocess.run([os.environ.get("CC") or "cc", "-O1", os.path.join(HERE, "cvode_pair.c"), "-o",
                        self.program, *LIBRARIES], check=True)
        self.pair = pair()

    def histories(self, name, rtol, step=0.01, digits=17, eta=None, end=None):
        """(history, events) of a run."""
        p = self.pair
        numbers = [p["m1"], p["m2"], p["k1"], p["k2"], p["c1"], p["c2"], p["eta"] if eta is None else eta,
                   p["u1(0)"], p["d2"], p["v1(0)"], p["v2(0)"], p["t_end"] if end is None else end, rtol,
                   step, digits]
        files = self.path(name + ".txt"), self.path(name + "-events.txt")
        subprocess.run([self.program, *map(repr, numbers), *files], check=True)
        return files

    def test_tight_tolerance_agrees(self):
        history, events = self.histories("tight", 1e-10)
        for arguments in ((history,), (history, "--events", events)):
            subject = self.checked(*arguments, "--tolerance", "1e-6")
            self.assertEqual(subject["assessment"]["verdict"], "agrees")
            self.assert_six_impacts(runs(subject)[0], 1e-6)
        self.assertEqual(self.checked(history)["assessment"]["verdict"], "not claimed")

    def test_loose_tolerance_disagrees(self):
        history, events = self.histories("loose", 1e-3)
        self.checked(history, "--events", events, "--tolerance", "1e-6", exit_code=1)

    def test_tolerances_as_steps_give_an_irregular_order(self):
        tolerances = [10**-(4 + n / 4) for n in range(25)]
        files = [self.histories(f"run{i}", rtol)[0] for i, rtol in enumerate(tolerances)]
        # The controller chooses order and steps anew for each tolerance: no line. Steps of order q
        # that keep a local error of rtol end with rtol^(q / (q + 1)), and q goes up to 5.
        subject = self.checked(*files, "--tolerances", ",".join(map(repr, tolerances)), "--expect",
                              "irregular:1")
        order = subject["assessment"]["displacement"]["order"]
        self.assertTrue(0.7 < order < 1.0, order)

    def test_six_printed_digits_are_undecided(self):
        history, _ = self.histories("six", 1e-11, digits=6)
        subject = self.checked(history, "--expect", "exact", exit_code=3)
        self.assertEqual(subject["assessment"]["reason"], "printed-digits")
        run = runs(subject)[0]
        self.assertLess(run["u_error"], 2 * run["file"]["printed_floor"])

    def test_other_restitution_agrees_with_the_case_that_has_it(self):
        history, events = self.histories("soft", 1e-10, eta=0.5)
        arguments = (history, "--events", events, "--tolerance", "1e-6")
        # The impacts come at the same times, whatever the restitution.
        subject = self.checked(*arguments, exit_code=1)
        self.assert_six_impacts(runs(subject)[0], 1e-6)
        self.checked(*arguments, "--case", "synchronized-pair", "--set", "eta=0.5")

    def test_history_that_ends_early_is_undecided_unless_the_case_ends_there(self):
        history, events = self.histories("early", 1e-10, end=self.pair["t_end"] / 2)
        arguments = (history, "--events", events, "--tolerance", "1e-6")
        subject = self.checked(*arguments, exit_code=3)
        self.assertEqual(subject["assessment"]["reason"], "ends-early")
        self.assertEqual(runs(subject)[0]["impacts"]["expected"], 3)
        subject = self.checked(*arguments, "--set", "a_t=0.5")
        self.assertEqual(subject["assessment"]["verdict"], "agrees")
        self.assertEqual(runs(subject)[0]["impacts"]["expected"], 3)


if __name__ == "__main__":
    unittest.main()
