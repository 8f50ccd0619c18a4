"""clackers report: a history over records, what changed, and its page."""
import json
import pathlib
import unittest

from command import CommandTest, run, rows

QUICK = ("--coarsest", "0.05", "--levels", "5", "--samples-per-level", "2", "--jobs", "1")


class History(CommandTest):
    def setUp(self):
        super().setUp()
        run("verify", "rk4", "newmark", *QUICK, "--format", "json", "--out", self.path("v1.json"), "--quiet")
        self.code = run("verify", "rk4", *QUICK, "--quiet").returncode

    def version(self, name, change):
        record = json.loads(self.text_of("v1.json"))
        change(record["cases"][0]["subjects"])
        pathlib.Path(self.path(name)).write_text(json.dumps(record))
        return self.path(name)

    def test_what_changed_stands_in_its_row(self):
        def worse(subjects):
            subjects[0]["levels"][-1]["runs"][-1]["u_error"] *= 8

        words = (self.path("v1.json"), self.version("v2.json", lambda _: None), self.version("v3.json", worse))
        done = run("report", *words, "--format", "csv", "--out", self.path("h.html"), "--quiet")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        versions, table = (rows(part) for part in done.stdout.split("\n\n")[:2])
        self.assertEqual([row["record"] for row in versions], ["v1", "v2", "v3"])
        self.assertEqual([(row["number"], row["subject"]) for row in table],
                         [(f"{k}", name) for k in (1, 2, 3) for name in ("rk4", "newmark")])
        self.assertEqual([bool(row["changed"]) for row in table], [False] * 4 + [True, False])
        self.assertIn("grew by a factor 8", table[4]["changed"])
        page = self.text_of("h.html")
        specifications = json.loads(page.split('id="specifications">')[1].split("</script>")[0])
        self.assertEqual(set(specifications), {"order", "error", "evaluations", "seconds"})
        self.assertIn("From v2 to v3 1 of 2 subjects changed: rk4. The newest, v3: agrees.", page)
        self.assertTrue(specifications["error"]["encoding"]["x"]["axis"]["labelExpr"].startswith('["v1","v2","v3"]'))
        self.assertEqual([mark["x"] for mark in specifications["error"]["layer"][0]["data"]["values"]], [3])

    def test_without_a_change_it_is_said_first(self):
        same = self.version("v2.json", lambda _: None)
        self.assertTrue(run("report", self.path("v1.json"), same).stdout.startswith("Nothing changed in 2 records. The newest, v2: agrees."))

    def test_the_exit_code_is_that_of_the_newest(self):
        def disagree(subjects):
            subjects[1]["assessment"]["verdict"] = "disagrees"

        bad = self.version("bad.json", disagree)
        self.assertEqual(run("report", self.path("v1.json"), bad).returncode, 1)
        self.assertEqual(run("report", bad, self.path("v1.json")).returncode, 0)

    def test_gone_and_new_subjects_are_told(self):
        other = self.version("v2.json", lambda subjects: subjects.pop())
        self.assertIn("is gone", run("report", self.path("v1.json"), other).stdout)
        self.assertIn("is new", run("report", other, self.path("v1.json")).stdout)

    def test_other_studies_are_refused(self):
        run("verify", "rk4", "--case", "stop", *QUICK, "--format", "json", "--out", self.path("stop.json"), "--quiet")
        self.refused("report", self.path("v1.json"), self.path("stop.json"), says="stop.json", code="other-study")
        self.refused("report", self.path("v1.json"), says="oldest first", code="bad-syntax")
        self.refused("report", self.path("v1.json"), "--out", self.path("h.txt"), says=".html", code="bad-syntax")


if __name__ == "__main__":
    unittest.main()
