"""verify as JUnit XML and as a LaTeX table."""
import json
import re
import unittest
import xml.etree.ElementTree as ElementTree

from command import LONG_LADDER, SHORT_LADDER, CommandTest, run

MIXED = ("verify", "rk4", "newmark+penalty", "--case", "symmetric-pair", "--set", "eta=0.5",
         "--levels", "6", "--samples-per-level", "2")
# A spring this soft bounces where the true masses do not collide.
SOFT = ("verify", "newmark+penalty:stiffness=100", "--levels", "8", "--samples-per-level", "1")


def suite(*arguments):
    """(exit code, the testsuite element) of a verify run."""
    done = run(*arguments, "--format", "junit")
    root = ElementTree.fromstring(done.stdout)
    return done.returncode, root.find("testsuite")


def properties(element):
    return {p.get("name"): p.get("value") for p in element.find("properties")}


class Junit(CommandTest):
    def test_has_a_test_a_method_with_the_numbers_of_the_record(self):
        code, tests = suite(*MIXED)
        self.assertEqual(code, 0)
        self.assertEqual({name: tests.get(name) for name in ("tests", "failures", "errors", "skipped")},
                         {"tests": "2", "failures": "0", "errors": "0", "skipped": "1"})
        self.assertTrue(tests.get("name").startswith("symmetric-pair (xi1 = 0.05, eta = 0.5"))
        good, refused = tests.findall("testcase")
        record = json.loads(run(*MIXED, "--format", "json").stdout)
        fit = record["cases"][0]["subjects"][0]["assessment"]["displacement"]
        self.assertEqual(float(properties(good)["order"]), fit["order"])
        self.assertEqual(float(properties(good)["u_error"]),
                         max(r["u_error"] for r in record["cases"][0]["subjects"][0]["levels"][-1]["runs"]))
        self.assertEqual(properties(tests)["eta"], "0.5")
        self.assertRegex(good.get("time"), r"\A\d+\.\d{3}\Z")
        self.assertEqual(good.get("name"), "rk4")
        self.assertIsNone(good.find("skipped"))
        self.assertIn("[penalty-needs-elastic]", refused.find("skipped").get("message"))

    def test_a_contradiction_is_a_failure_and_exit_code_1(self):
        code, tests = suite(*SOFT)
        self.assertEqual((code, tests.get("failures")), (1, "1"))
        failure = tests.find("testcase/failure")
        self.assertTrue(failure.get("message"))
        self.assertEqual(failure.text.count("\nh = "), 8)

    def test_undecided_is_skipped_with_the_reason_and_exit_code_3(self):
        code, tests = suite("verify", "rk4", *SHORT_LADDER)
        self.assertEqual((code, tests.get("skipped")), (3, "1"))
        self.assertIn("[too-few-levels]", tests.find("testcase/skipped").get("message"))


class Latex(CommandTest):
    def test_is_a_fragment_with_a_row_a_method(self):
        done = run(*MIXED, "--format", "latex")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        text = re.sub(r"(?m)^%.*\n", "", done.stdout)
        for part in (r"\toprule", r"\midrule", r"\bottomrule", r"\caption{symmetric-pair (xi1 = ",
                     r"\label{tab:clackers-symmetric-pair}", r"\texttt{rk4} & $"):
            self.assertIn(part, text)
        self.assertEqual(re.findall(r"\\(begin|end)\{(\w+)\}", text),
                         [("begin", "table"), ("begin", "tabular"), ("end", "tabular"), ("end", "table")])
        bare = re.sub(r"\\[\\{}%&_#$]", "", text)
        self.assertEqual(bare.count("{"), bare.count("}"))
        self.assertEqual(bare.count("$") % 2, 0)
        self.assertNotIn("\\document", text)
        rows = [line for line in text.splitlines() if line.endswith("\\\\")]
        self.assertEqual([row.count("&") for row in rows], [8] * 3)
        self.assertRegex(rows[1], r"\$\d\.\d\\cdot 10\^\{-\d+\}\$")


class Refusals(CommandTest):
    def test_of_other_formats_before_any_work(self):
        self.refused("verify", *LONG_LADDER, "--format", "junti", code="unknown-name",
                     says=('Did you mean "junit"?', "table, csv, json, junit, latex"))

    def test_of_verdict_formats_where_there_is_no_verdict(self):
        self.refused("respond", "stop", "--samples", "2", "--format", "junit", code="unknown-name",
                     says="table, csv, json")
        self.refused("list", "--format", "latex", code="unknown-name")


if __name__ == "__main__":
    unittest.main()
