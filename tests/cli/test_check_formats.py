"""check as JUnit XML, as a LaTeX table and as a page."""
import json
import os
import re
import unittest
import xml.etree.ElementTree as ElementTree

from command import run
from histories import CheckTest


class Junit(CheckTest):
    def suite(self, *arguments):
        done = run("check", *arguments, "--format", "junit")
        return done.returncode, ElementTree.fromstring(done.stdout).find("testsuite")

    def test_is_one_test_with_the_numbers_of_the_record(self):
        files = self.converging()
        code, suite = self.suite(*files, "--expect", "proper:2")
        self.assertEqual((code, suite.get("tests"), suite.get("failures")), (0, "1", "0"))
        test = suite.find("testcase")
        found = {p.get("name"): p.get("value") for p in test.find("properties")}
        record = self.checked(*files, "--expect", "proper:2")
        self.assertEqual(float(found["order"]), self.assessment(record)["displacement"]["order"])
        self.assertEqual(float(found["u_error"]), self.runs(record)[-1]["u_error"])
        self.assertEqual(found["verdict"], "agrees")

    def test_fails_and_skips_as_the_exit_code_says(self):
        files = self.converging(order=1)
        code, suite = self.suite(*files, "--expect", "proper:2")
        self.assertEqual((code, suite.get("failures")), (1, "1"))
        self.assertEqual(suite.find("testcase/failure").text.count(": h = "), len(files))
        code, suite = self.suite(self.converging(levels=1)[0], "--expect", "proper:2")
        self.assertEqual((code, suite.get("skipped")), (3, "1"))


class Latex(CheckTest):
    def test_has_a_row_a_file_and_the_verdict(self):
        files = self.converging()
        text = run("check", *files, "--expect", "proper:2", "--format", "latex").stdout
        self.assertEqual(len(re.findall(r"^    .*csv\} & .*\\\\$", text, re.M)), len(files))
        self.assertIn("Verdict: agrees.", text)
        self.assertRegex(text, r"order 2\.0\d \$\\pm")


class Page(CheckTest):
    def test_holds_the_runs_and_histories(self):
        files, page = self.converging(), self.path("check.html")
        done = run("check", *files, "--report", page)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("Wrote " + page, done.stderr)
        with open(page, encoding="utf-8") as file:
            text = file.read()
        self.assertLess(os.path.getsize(page), 2e6)
        data = json.loads(re.search(r'id="data">(.*?)</script>', text)[1])
        self.assertEqual(len(data["runs"]["rows"]), len(files))
        self.assertEqual([rows["series"] for rows in data["history_rows"]], ["mass 1", "mass 2"])
        self.assertNotIn('http-equiv="refresh"', text)

    def test_that_cannot_be_written_is_found_out_before_the_work(self):
        file = self.history("exact.csv")
        self.refused("check", file, "--report", self.path("no/folder/check.html"), exit_code=4,
                     code="cannot-write")
        self.refused("check", file, "--report", self.path("x"), "--out", self.path("x"),
                     code="bad-syntax", says="same file")

    def test_on_a_full_disk_leaves_the_table_and_exit_code_4(self):
        done = run("check", self.history("exact.csv"), "--report", "/dev/full")
        self.assertEqual(done.returncode, 4)
        self.assertIn("[cannot-write]", done.stderr)
        self.assertIn("Verdict: not claimed", done.stdout)


if __name__ == "__main__":
    unittest.main()
