"""verify --baseline, check --baseline: what changed since an earlier record, in words."""
import json
import math
import os
import unittest

from command import LONG_LADDER, CommandTest, run
from histories import CheckTest

QUICK = ("--coarsest", "0.05", "--levels", "5", "--samples-per-level", "2", "--jobs", "1")


class Baseline(CommandTest):
    def setUp(self):
        super().setUp()
        self.old = self.path("old.json")
        run("verify", "rk4", "newmark", *QUICK, "--format", "json", "--out", self.old, "--quiet")
        with open(self.old) as file:
            self.record = json.load(file)

    def bend(self, change):
        change(self.record)
        with open(self.old, "w") as file:
            json.dump(self.record, file)

    def verify(self, *arguments):
        return run("verify", *arguments, *QUICK, "--baseline", self.old)

    def test_the_same_run_changes_nothing(self):
        done = self.verify("rk4", "newmark")
        self.assertEqual(done.stderr, "")
        text = done.stdout.replace("\n", " ")
        self.assertIn("Against the baseline of " + self.record["provenance"]["date"], text)
        self.assertIn("nothing changed in 2 methods.", text)
        self.assertTrue(done.stdout.splitlines()[-1].startswith("Verdict: "))

    def test_differences_are_told_and_leave_the_exit_code(self):
        before = run("verify", "rk4", "moreau-jean", *QUICK).returncode

        def change(record):
            method = record["cases"][0]["subjects"][0]
            method["assessment"]["verdict"] = "disagrees"
            method["assessment"]["displacement"]["behaviour"] = "reduced"
            finest = method["levels"][-1]["runs"][-1]
            finest["u_error"] /= 4
            finest["impacts"]["missed"] = 2
        self.bend(change)
        done = self.verify("rk4", "moreau-jean")
        self.assertEqual(done.returncode, before)
        text = done.stdout.replace("\n", " ")
        self.assertIn("3 of 3 methods changed", text)
        self.assertRegex(text, r"rk4: verdict \w+, before disagrees\.")
        self.assertRegex(text, r"rk4: behaviour \w+( \[[a-z-]+\])?, before reduced")
        self.assertRegex(text, r"rk4: error in u at h = [\d.]+ s grew by a factor 4: ")
        self.assertRegex(text, r"rk4: misses none of 6 impacts at h = [\d.]+ s, before 2\.")
        self.assertIn("moreau-jean: is new; the baseline does not have it.", text)
        self.assertIn("newmark: is gone; only the baseline has it.", text)
        for line in done.stdout.splitlines():
            self.assertLessEqual(len(line), 80, line)

    def test_formats_without_a_place_for_changes_tell_them_on_standard_error(self):
        for kind in ("json", "csv", "latex"):
            done = run("verify", "rk4", "newmark", *QUICK, "--baseline", self.old, "--format", kind)
            self.assertIn("Against the baseline", done.stderr)
            self.assertNotIn("Against the baseline", done.stdout)
            quiet = run("verify", "rk4", "newmark", *QUICK, "--baseline", self.old, "--format", kind,
                        "--quiet")
            self.assertEqual(quiet.stderr, "")
        done = run("verify", "rk4", "newmark", *QUICK, "--baseline", self.old, "--format", "junit")
        self.assertEqual(done.stderr, "")
        self.assertIn("<system-out>Against the baseline", done.stdout)

    def test_changes_are_a_section_of_the_report(self):
        self.verify("rk4", "--report", self.path("r.html"), "--quiet")
        with open(self.path("r.html")) as file:
            page = file.read()
        self.assertIn('<section id="changes"', page)
        self.assertIn("newmark</dt><dd><ul><li>is gone", page)

    def test_may_come_from_standard_input(self):
        with open(self.old) as file:
            done = run("verify", "rk4", "newmark", *QUICK, "--baseline", "-", stdin=file.read())
        self.assertIn("nothing changed in 2 methods.", done.stdout.replace("\n", " "))

    def test_may_be_replaced_by_the_new_record(self):
        done = run("verify", "rk4", *QUICK, "--baseline", self.old, "--format", "json", "--out", self.old)
        self.assertIn("1 of 2 methods changed", done.stderr.replace("\n", " "))
        with open(self.old) as file:
            self.assertEqual(len(json.load(file)["cases"][0]["subjects"]), 1)


class Cases(CommandTest):
    def test_are_compared_by_their_names(self):
        old = self.path("old.json")
        both = ("--case", "stop", "--case", "symmetric-pair")
        run("verify", "rk4", "newmark", *QUICK, *both, "--format", "json", "--out", old, "--quiet")
        done = run("verify", "rk4", "newmark", *QUICK, *both, "--baseline", old)
        self.assertIn("nothing changed", done.stdout.replace("\n", " "))
        done = run("verify", "rk4", *QUICK, "--case", "stop", "--baseline", old)
        self.assertIn("newmark", done.stdout.split("Against the baseline")[1])
        self.refused("verify", "rk4", *QUICK, "--case", "sdof", "--baseline", old,
                     code="other-study", says="another case")


class Histories(CheckTest):
    def test_are_compared_with_an_earlier_record(self):
        old, path = self.path("old.json"), self.history("run.csv")
        run("check", path, "--format", "json", "--out", old, "--quiet")
        done = run("check", path, "--baseline", old)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("nothing changed", done.stdout.replace("\n", " "))
        def worse(row):
            row["u1"] += 1e-3 * math.sin(row["t"])
            return row
        done = run("check", self.history("run.csv", change=worse), "--baseline", old, "--format", "csv")
        self.assertRegex(done.stderr, r"histories: error in u at h = 0\.01 s: 1\.00e-3, before 0\.")
        self.refused("check", path, "--case", "stop", "--baseline", old, code="other-study",
                     says="another case")
        self.refused("verify", "rk4", *QUICK, "--baseline", old, code="other-study",
                     says="another command: clackers check")


class Refusals(CommandTest):
    def test_before_any_work(self):
        # On a ladder of minutes: the answer comes at once or the test times out.
        self.refused("verify", *LONG_LADDER, "--baseline", self.path("none.json"), code="cannot-read",
                     exit_code=4, says="none.json")
        self.refused("verify", *LONG_LADDER, "--baseline", self.folder, code="cannot-read", exit_code=4)
        for text in ("", "no json", "{}", '{"schema": "clackers/runs/1"}'):
            with open(self.path("bent.json"), "w") as file:
                file.write(text)
            self.refused("verify", *LONG_LADDER, "--baseline", self.path("bent.json"), "--report",
                         self.path("r.html"), code="not-a-record", says="bent.json")
        self.assertEqual(self.files(), ["bent.json"])

    def test_of_another_case_parameter_or_ladder(self):
        old = self.path("old.json")
        run("verify", "rk4", *QUICK, "--format", "json", "--out", old)
        size = os.path.getsize(old)
        self.refused("verify", "rk4", *QUICK, "--case", "stop", "--baseline", old, code="other-study",
                     says=("another case: --case three-parameter --set N=2,xi1=0.05,a_t=1",
                           "this run: --case stop"))
        self.refused("verify", "rk4", *QUICK, "--set", "xi1=0.1", "--baseline", old,
                     code="other-study", says="other parameters")
        self.refused("verify", "rk4", *LONG_LADDER[:4], "--baseline", old,
                     "--out", old, code="other-study", says=("another ladder", "--coarsest 2e-05"))
        self.assertEqual(os.path.getsize(old), size)


if __name__ == "__main__":
    unittest.main()
