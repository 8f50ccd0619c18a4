"""verify with several cases: every output holds all of them, and a performance profile over all."""
import json
import os
import unittest
import xml.etree.ElementTree as ElementTree

import jsonschema  # Debian: python3-jsonschema

from command import CommandTest, rows, run

SCHEMA = os.path.join(os.path.dirname(__file__), "../../docs/schemas/record-1.json")
CASES = ("--case", "stop", "--case", "symmetric-pair", "--coarsest", "0.1", "--levels", "4",
         "--samples-per-level", "1", "--set", "t_end=8")


class Cases(CommandTest):
    def test_prints_a_table_a_case_then_the_profile(self):
        done = run("verify", "rk4", "newmark", *CASES)
        self.assertIn(done.returncode, (0, 3), done.stderr)
        stop, pair = done.stdout.index("stop ("), done.stdout.index("symmetric-pair (")
        profile = done.stdout.index("Performance profile over 2 cases and ")
        self.assertTrue(stop < pair < profile)
        self.assertRegex(done.stdout, r"\nrk4 +\d+ +\d+ % +\d+ % +\d+/\d+\n")
        self.assertTrue(done.stdout.splitlines()[-1].startswith("Verdict: "))
        self.assertTrue(all(len(line) <= 80 for line in done.stdout.splitlines()))

    def test_json_holds_all_cases_and_is_valid(self):
        record = json.loads(run("verify", "rk4", "newmark", *CASES, "--format", "json").stdout)
        with open(SCHEMA) as file:
            jsonschema.Draft202012Validator(json.load(file)).validate(record)
        self.assertEqual([case["problem"]["name"] for case in record["cases"]],
                         ["stop", "symmetric-pair"])
        self.assertEqual(len(record["profiles"][0]["tasks"]),
                         sum(len(case["profiles"][0]["tasks"]) for case in record["cases"]))

    def test_every_format_and_the_report_hold_all_cases(self):
        table = rows(run("verify", "rk4", "newmark", *CASES, "--format", "csv").stdout)
        self.assertEqual([row["case"] for row in table], ["stop"] * 8 + ["symmetric-pair"] * 8)
        junit = ElementTree.fromstring(run("verify", "rk4", *CASES, "--format", "junit").stdout)
        self.assertEqual([len(suite.findall("testcase")) for suite in junit.iter("testsuite")], [1, 1])
        latex = run("verify", "rk4", *CASES, "--format", "latex").stdout
        self.assertEqual(latex.count(r"\begin{table}"), 2)
        run("verify", "rk4", *CASES, "--report", self.path("r.html"), "--quiet")
        with open(self.path("r.html")) as file:
            page = file.read()
        self.assertTrue("stop" in page and "symmetric-pair" in page)

    def test_takes_settings_that_every_case_has(self):
        self.refused("verify", "rk4", "--case", "stop", "--case", "one-parameter", "--set", "eta=0.5",
                     code="unknown-name", says=("eta",))

    def test_refuses_a_case_twice(self):
        self.refused("verify", "rk4", "--case", "stop", "--case", "stop", code="bad-syntax",
                     says=("each case once",))

    def test_one_case_leaves_the_methods_behind_it_alone(self):
        done = run("verify", "--case", "stop", "rk4", *CASES[4:], "--format", "json")
        record = json.loads(done.stdout)
        self.assertEqual([case["problem"]["name"] for case in record["cases"]], ["stop"])
        self.assertEqual(record["profiles"], [])


if __name__ == "__main__":
    unittest.main()
