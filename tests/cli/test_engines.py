"""clackers engines: the list, one engine, a run that is resumed, engines that are missing."""
import os
import pathlib
import shutil
import unittest

from command import CommandTest, rows, run

ENGINES = pathlib.Path(__file__).resolve().parents[2] / "engines"
# The exact motion plays the part of an engine, with a restitution of its own.
ENGINE = """name = "Ours"
integrates = "exactly"
licence = "MIT"
debian = ["ours"]
version = "echo 1.2"
build = "cp {folder}/solver.sh {program}"
command = "sh {program} {h} {out}"
traps = ["It bounces too little."]
[[facts]]
text = "It bounces with <0.9>."
setting = "default"
case = "stop"
quantity = "restitution"
from = 0.89
to = 0.91
source = "ours"
[[settings]]
name = "default"
why = "as it is"
words = "0.9"
[[settings]]
name = "tuned"
why = "the restitution of the case"
words = "1"
expect = "exact"
"""
SOLVER = '''"$CLACKERS" respond stop --step "$1" --format csv --set "eta=$3" --out "$2" --quiet
echo "# seconds 0.25 steps 40" >> "$2"
'''


class Engines(CommandTest):
    def setUp(self):
        super().setUp()
        for name, text in (("door.mjs", ""), ("ours/engine.toml", ENGINE), ("ours/solver.sh", SOLVER),
                           ("absent/engine.toml", ENGINE.replace("echo 1.2", "exit 1"))):
            os.makedirs(os.path.dirname(self.path("engines/" + name)), exist_ok=True)
            with open(self.path("engines/" + name), "w") as file:
                file.write(text)

    def engines(self, *words):
        return self.good("engines", *words, "--engines", self.path("engines"))

    def test_list_names_versions_and_what_is_missing(self):
        found = {row["engine"]: row for row in rows(self.engines("list", "--format", "csv", "--quiet"))}
        self.assertEqual(found["ours"]["version"], "1.2")
        self.assertEqual(found["absent"]["version"], "")
        self.assertEqual(found["ours"]["settings"], "default, tuned")

    def test_show_has_settings_and_traps(self):
        text = self.engines("show", "ours", "--format", "csv")
        self.assertIn("the restitution of the case", text)
        self.assertIn("It bounces too little.", text)
        self.assertIn("apt-get install ours", self.engines("show", "absent"))

    def test_run_judges_each_setting_and_goes_on(self):
        words = ("engines", "run", "--all", "--case", "stop", "--out", self.path("out"), "--engines", self.path("engines"))
        done = run(*words, "--quiet")
        self.assertEqual((done.returncode, done.stderr.splitlines()),
                         (0, ["absent is skipped: it is not installed. apt-get install ours"]))
        subjects = rows(self.good("campaign", "query", self.path("out/engines.db"),
                                  "SELECT method, verdict, behaviour FROM subjects ORDER BY task",
                                  "--format", "csv"))
        self.assertEqual([row["method"] for row in subjects], ["ours/default 1.2", "ours/tuned 1.2"])
        self.assertEqual([row["verdict"] for row in subjects], ["disagrees", "agrees"])
        stated = rows(self.good("campaign", "query", self.path("out/engines.db"), "SELECT DISTINCT steps FROM runs",
                                "--format", "csv"))
        self.assertEqual(stated, [{"steps": "40"}])
        page = pathlib.Path(self.path("out/index.html"))
        text = page.read_text()
        self.assertIn("<h1>0 of 1 engines are seen to converge to the exact motion through impacts as they come, 1 in some setting</h1>", text)
        self.assertIn("restitution 0.9", text)
        self.assertIn("clackers engines run ours --setting default --case stop</pre>", text)
        self.assertNotIn(self.path(""), text)
        self.assertNotRegex(text, "<script|src=|url\\(")
        page.unlink()
        self.assertEqual(run(*words, "--quiet").returncode, 0)
        self.assertTrue(page.exists())
        page.unlink()
        self.good("engines", "page", "--engines", self.path("none"), "--out", self.path("out"), "--quiet")
        self.assertTrue(page.exists())

    def test_names_that_do_not_exist_are_refused(self):
        self.refused("engines", "run", "our", "--engines", self.path("engines"), says="ours", code="unknown-name")
        self.refused("engines", "rnu", "--engines", self.path("engines"), says="run", code="unknown-name")
        self.refused("engines", "run", "ours", "--setting", "tunde", "--engines", self.path("engines"), says="tuned",
                     code="unknown-name")
        self.refused("engines", "run", "ours", "--out", "/proc/nowhere", "--engines", self.path("engines"),
                     says="the folder cannot be made", code="cannot-write", exit_code=4)
        self.refused("engines", "run", "--engines", self.path("engines"), says="--all", code="bad-syntax")
        self.refused("engines", "page", "--out", self.path("none"), says="engines run --all --out " + self.path("none"),
                     code="cannot-read", exit_code=4)

    def test_refused_values_leave_no_folder(self):
        for words, says, code in ((("--case", "stpo"), 'no case "stpo". Did you mean "stop"?', "unknown-name"),
                                  (("--case", "stop:eta"), "name=value", "bad-syntax"),
                                  (("--case", "stop:eta=nan"), "eta = nan", "not-a-number"), (("--jobs", "0"), "--jobs = 0", "out-of-range")):
            self.refused("engines", "run", "ours", *words, "--engines", self.path("engines"), "--out", self.path("out"),
                         says=says, code=code)
            self.assertFalse(os.path.exists(self.path("out")))

    def test_without_an_engine_that_is_installed_says_so(self):
        shutil.rmtree(self.path("engines/ours"))
        done = run("engines", "run", "--all", "--out", self.path("out"), "--engines", self.path("engines"))
        self.assertEqual(done.returncode, 4)
        self.assertRegex(done.stderr, r"apt-get install ours(.|\n)*\[program-failed\]")


class Shipped(CommandTest):
    def test_engines_have_programs_of_at_most_80_lines(self):
        found = rows(self.good("engines", "list", "--engines", str(ENGINES), "--format", "csv", "--quiet"))
        self.assertGreaterEqual(len(found), 25)
        self.assertGreaterEqual(sum(len(row["settings"].split(",")) for row in found), 45)
        for row in found:
            programs = [path for path in (ENGINES / row["engine"]).iterdir() if path.name != "engine.toml"]
            self.assertEqual(len(programs), 1, row["engine"])
            self.assertLessEqual(len(programs[0].read_text().splitlines()), 80, programs[0])


if __name__ == "__main__":
    unittest.main()
