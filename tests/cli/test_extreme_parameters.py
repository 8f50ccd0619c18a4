"""Every command and format at the corners of the parameter box: a result or a refusal in words."""
import itertools
import os
import unittest

from command import CommandTest, run

PAIR = "synchronized-pair"
CORNERS = [
    (PAIR, "X=3,r=2.9999999999999996"), (PAIR, "X=999999999,r=1,t_end=1e-3"), (PAIR, "X=1,r=1e-60"),
    (PAIR, "X=0.3333333333333333,r=1e60"), (PAIR, "xi1=0,t_end=1e-300"), (PAIR, "xi1=0.5,t_end=1450"),
    (PAIR, "xi1=0.9999999999999999"), (PAIR, "xi1=1e-60"), (PAIR, "eta=0"), (PAIR, "eta=1e-300"),
    (PAIR, "eta=0.9999999999999999"), (PAIR, "m1=1e-60,k1=1e60,t_end=1e-58"),
    (PAIR, "m1=1e60,k1=1e-60,t_end=1e60"), (PAIR, "A=1e-60,t_end=1e3"), (PAIR, "A=1e60"),
    (PAIR, "A=4.9e-324"), (PAIR, "t_end=4.9e-324"), (PAIR, "xi1=-0"), ("sdof", "xi1=0.9999999999999999"),
    ("sdof", "t_end=1e15"), ("stop", "eta=0"), ("stop", "eta=0,xi1=0.999"), ("symmetric-pair", "eta=1e-300"),
    ("one-parameter", "N=1e8"), ("two-parameter", "N=0,xi1=0"), ("three-parameter", "N=0,xi1=0.999,a_t=1e6"),
    ("three-parameter", "a_t=1e-9"), ("exact-data-pair", "sigma=0,X=1"), ("exact-data-pair", "t_end=1450"),
]


class Corners(CommandTest):
    def result(self, *arguments, codes=(0, 1, 2, 3)):
        """A run that ends in time, with a documented code and no failure of ours."""
        done = run(*arguments, timeout=120)
        self.assertIn(done.returncode, codes, (arguments, done.stderr))
        self.assertNotIn("[internal-error]", done.stderr, arguments)
        if done.returncode == 2:
            self.assertRegex(done.stderr, r"\[[a-z-]+\]\s*$", arguments)
        return done

    def test_show_and_respond_end_with_a_result_or_a_refusal(self):
        for (case, settings), kind in itertools.product(
                CORNERS, (("show",), ("respond", "--samples", "5"), ("respond", "--samples", "5", "--energy"),
                          ("respond", "--samples", "5", "--digits", "20"),
                          ("respond", "--samples", "5", "--sensitivity", "k1"))):
            self.result(kind[0], case, "--set", settings, *kind[1:], codes=(0, 2))

    def test_rows_have_every_format(self):
        for (case, settings), form in itertools.product(CORNERS, ("table", "csv", "json", "npy")):
            out = self.path("rows." + form)
            done = self.result("respond", case, "--set", settings, "--samples", "33", "--format", form,
                               "--out", out, codes=(0, 2))
            self.assertEqual(os.path.exists(out), done.returncode == 0, (case, settings, form))
            if done.returncode == 0:
                os.remove(out)

    def test_the_exact_motion_is_checked_in_every_format(self):
        checked = 0
        for case, settings in CORNERS:
            history = self.path("h.csv")
            if self.result("respond", case, "--set", settings, "--samples", "60", "--format", "csv",
                           "--out", history, codes=(0, 2)).returncode != 0:
                continue
            for form in ("table", "csv", "json", "junit", "latex"):
                self.result("check", history, "--case", case, "--set", settings, "--format", form,
                            "--report", self.path("page.html"))
            checked += 1
        self.assertGreater(checked, len(CORNERS) // 2)

    def test_methods_are_assessed_in_every_format(self):
        short = ("--levels", "4", "--samples-per-level", "1", "--jobs", "1")
        for case, settings in CORNERS:
            if "1e15" in settings or "1e60" in settings or "1e6" in settings:
                continue  # more steps than a test should take
            for method, form in (("rk4", "table"), ("newmark+penalty", "json"), ("moreau-jean", "junit")):
                self.result("verify", method, "--case", case, "--set", settings, *short, "--format", form,
                            "--report", self.path("page.html"))


if __name__ == "__main__":
    unittest.main()
