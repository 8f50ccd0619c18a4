"""First lines and verdicts: more levels never deny what a method is; the first word is the last one."""
import json
import re
import unittest

from command import CommandTest, run


def subject(*arguments):
    """The only subject of a study."""
    return json.loads(run("verify", *arguments, "--budget", "0", "--format", "json").stdout)["cases"][0]["subjects"][0]


class Verdicts(CommandTest):
    def test_more_levels_never_deny_a_right_floor(self):
        for method in ("newmark+penalty:law=kelvin-voigt", "newmark+penalty:law=jankowski"):
            verdicts = [subject(method, "--case", "stop", "--set", "eta=0.5", "--levels", str(levels))["assessment"]
                        for levels in (8, 9, 10, 11)]
            self.assertNotIn("disagrees", [one["verdict"] for one in verdicts], method)
            self.assertEqual(verdicts[-1]["verdict"], "agrees", method)
            self.assertEqual(verdicts[1]["reason"], "contact-not-resolved", method)

    def test_a_method_that_converges_has_no_other_limit(self):
        with open(self.path("rest.toml"), "w") as file:
            file.write("M = [[1, 0], [0, 2]]\nK = [[2, -1], [-1, 3]]\nend = 10\n[start]\nu = [0.5, -0.5]\n"
                       "[[contacts]]\ndirection = [1, -1]\nrestitution = 0\n")
        done = run("verify", "newmark+reversal", "--problem", self.path("rest.toml"), "--levels", "7")
        self.assertRegex(done.stdout, r"Agrees: Converges irregularly[^\[]*\[irregular\]")
        self.assertNotIn("wrong-limit", done.stdout)

    def test_an_order_of_the_coarse_range_is_undecided(self):
        found = subject("bdf1", "--set", "N=5,xi1=0.03", "--levels", "8")["assessment"]
        self.assertLess(found["displacement"]["order"], 0.8)
        self.assertEqual((found["verdict"], found["reason"]), ("undecided", "too-few-levels"))

    def test_explicit_generalized_alpha_is_proper_through_impacts(self):
        for case in (("--set", "N=0"), ("--case", "stop", "--set", "eta=0.5")):
            found = subject("explicit-generalized-alpha", *case)["assessment"]
            self.assertEqual((found["verdict"], found["displacement"]["behaviour"]), ("agrees", "proper"), case)

    def test_no_line_that_goes_on_has_a_floor(self):
        fit = subject("rk4")["assessment"]["displacement"]
        self.assertEqual((fit["behaviour"], fit["floor"], fit["floor_step"]), ("proper", 0.0, 0.0))

    def test_the_first_word_is_that_of_the_last_line_and_of_the_exit_code(self):
        exits = {"Agrees": 0, "Not claimed": 0, "Disagrees": 1, "Undecided": 3}
        for h in ("0.02", "0.01", "0.005"):
            self.good("respond", "three-parameter", "--step", h, "--format", "csv", "--quiet",
                      "--out", self.path(f"h{h}.csv"))
        exact = [self.path(f"h{h}.csv") for h in ("0.02", "0.01", "0.005")]
        for arguments in (("verify", "rk4", "--levels", "5"), ("check", *exact), ("check", *exact, "--expect", "exact"),
                          ("check", *exact, "--expect", "proper:2"), ("check", exact[0], exact[0], "--steps", "1,2"),
                          ("check", *exact, "--set", "xi1=0.0500001", "--expect", "proper:2"),
                          ("verify", "bdf1", "--set", "N=5,xi1=0.03", "--levels", "8", "--budget", "0"),
                          ("verify", "--exec", f"cp {exact[0]} {{out}} # {{h}}", "--levels", "4")):
            done = run(*arguments)
            if done.returncode == 2:
                continue
            word = done.stdout.split(":")[0]
            self.assertEqual(exits[word], done.returncode, done.stdout)
            self.assertRegex(done.stdout.splitlines()[-1], rf"^Verdict: {re.escape(word.lower())}\.")


if __name__ == "__main__":
    unittest.main()
