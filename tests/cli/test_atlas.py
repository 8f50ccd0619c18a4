"""clackers atlas and campaign report: the folder, its page, going on, and results of others."""
import json
import os
import re
import shutil
import signal
import stat
import unittest

import databases
from command import CommandTest, rows, run, start

SPEC = """methods = ["newmark", "rk4", "newmark+penalty"]
[ladder]
levels = 3
samples_per_level = 2
[[cases]]
case = "stop"
set = { eta = [0.5, 1], xi1 = [0.05, 0.1] }
"""
LONG = """methods = ["rk4"]
[ladder]
levels = 5
coarsest = 2e-3
[[cases]]
case = "stop"
set = { xi1 = { from = 0, to = 0.1, points = 2000 } }
"""
# The exact motion plays the part of somebody's program.
SOLVER = """#!/bin/sh
exec "$CLACKERS" respond stop --step "$1" --format csv --set "eta=$2,xi1=0.05"
"""


def data_of(page):
    """What the figures of a page read."""
    found = re.search(r'<script type="application/json" id="data">(.*?)</script>', page, re.S)
    return json.loads(found.group(1))["atlas"]


class AtlasTest(CommandTest):
    def setUp(self):
        super().setUp()
        self.write("spec.toml", SPEC)
        self.spec, self.folder_of_atlas = self.path("spec.toml"), self.path("atlas")

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)

    def atlas(self, *more):
        return self.good("atlas", "--specification", self.spec, "--out", self.folder_of_atlas, "--quiet",
                         *more)

    def page(self):
        return self.text_of("atlas/index.html")


class Folder(AtlasTest):
    def test_has_page_database_and_specification(self):
        self.atlas()
        self.assertEqual(sorted(os.listdir(self.folder_of_atlas)), ["atlas.db", "atlas.toml", "index.html"])
        self.assertEqual(self.text_of("atlas/atlas.toml"), SPEC)
        data = data_of(self.page())
        self.assertEqual(len(data["cells"]), 12)
        self.assertEqual([method["name"] for method in data["methods"]], ["newmark", "rk4", "newmark+penalty"])
        self.assertEqual(data["systems"][1]["command"], "--case stop --set eta=0.5,xi1=0.1")

    def test_prints_the_verdicts_of_each_case(self):
        counts = rows(self.atlas("--format", "csv"))
        self.assertEqual([row["case"] for row in counts], ["stop"])
        self.assertEqual(counts[0]["systems"], "4")
        verdicts = ("agrees", "disagrees", "not_claimed", "undecided", "refused")
        self.assertEqual(sum(int(counts[0][word]) for word in verdicts), 12)

    def test_is_written_through_links(self):
        self.atlas()
        os.mkdir(self.path("elsewhere"))
        os.rename(self.path("atlas/index.html"), self.path("elsewhere/page.html"))
        os.symlink(self.path("elsewhere/page.html"), self.path("atlas/index.html"))
        os.truncate(self.path("elsewhere/page.html"), 0)
        self.atlas()
        self.assertTrue(os.path.islink(self.path("atlas/index.html")))
        self.assertTrue(self.text_of("elsewhere/page.html").endswith("</html>\n"))

    def test_says_what_it_wrote(self):
        done = run("atlas", "--specification", self.spec, "--out", self.folder_of_atlas)
        self.assertEqual((done.returncode, done.stderr), (0, f"Wrote {self.folder_of_atlas}/index.html\n"))

    def test_computes_nothing_twice(self):
        self.atlas()
        databases.change(self.path("atlas/atlas.db"), "DELETE FROM subjects WHERE task = 5",
                         "DELETE FROM runs WHERE task = 5", "DELETE FROM timings WHERE task = 5",
                         "UPDATE subjects SET reason = 'kept' WHERE task = 4")
        self.atlas()
        kept = rows(self.good("campaign", "query", self.path("atlas/atlas.db"),
                              "SELECT task, reason FROM subjects WHERE task IN (4, 5)", "--format", "csv"))
        self.assertEqual([row["task"] for row in kept], ["4", "5"])
        self.assertEqual(kept[0]["reason"], "kept")

    def test_that_was_interrupted_goes_on(self):
        self.write("long.toml", LONG)
        arguments = ("atlas", "--specification", self.path("long.toml"), "--out", self.folder_of_atlas,
                     "--jobs", "1", "--format", "csv")
        with start(*arguments, stdout=-1, stderr=-1, text=True) as process:
            self.wait_for(self.has_rows)
            process.send_signal(signal.SIGINT)
            out, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, errors)
        self.assertIn("[interrupted]", errors)
        self.assertGreater(int(rows(out)[0]["systems"]), 0)
        self.assertIn("of 2000 tasks are finished", self.page())

    def has_rows(self):
        # Nobody may read while the writer has its lock: the size tells. Files that are half written get
        # another name.
        try:
            return sum(entry.stat().st_size for entry in os.scandir(self.folder_of_atlas)) > 200000
        except FileNotFoundError:
            return False

    def test_commands_of_the_page_give_the_same_numbers(self):
        self.atlas()
        data = data_of(self.page())
        place = {name: i for i, name in enumerate(data["fields"])}
        cell = data["cells"][4]
        command = " ".join(["verify", data["methods"][cell[0]]["call"], data["systems"][cell[1]]["command"],
                            data["parts"][0]["options"]])
        found = rows(run(*command.split(), "--format", "csv").stdout)
        self.assertEqual(len(found), 6)
        self.assertEqual([float(f"{float(row['u_error']):.3e}") for row in found], cell[place["errors"]])
        self.assertEqual(found[0]["behaviour"], data["words"][cell[place["behaviour"]]])


class Refusals(AtlasTest):
    def test_of_a_folder_of_others(self):
        os.mkdir(self.folder_of_atlas)
        self.write("atlas/thesis.txt", "mine")
        self.refused("atlas", "--specification", self.spec, "--out", self.folder_of_atlas, code="foreign-folder",
                     says=("atlas: this folder holds other files", "--out FOLDER"))
        self.assertEqual(os.listdir(self.folder_of_atlas), ["thesis.txt"])

    def test_of_an_atlas_of_another_specification(self):
        self.atlas()
        self.write("spec.toml", SPEC.replace("levels = 3", "levels = 2"))
        self.refused("atlas", "--specification", self.spec, "--out", self.folder_of_atlas, code="other-campaign",
                     says="clackers atlas --specification")

    def test_of_options_that_do_not_go_together(self):
        for arguments, says in ((("--submit", "rk4"), "--out FILE.db"),
                                (("--exec", "./a {h}"), "--submit NAME"),
                                (("--author", "A"), "--submit NAME"),
                                (("--submit", "rk4", "--out", "x", "--merge", "y"), "give one of the two"),
                                (("--submit", "rk4", "--out", "x", "--expect", "exact"), "--exec")):
            self.refused("atlas", *arguments, code="bad-syntax", says=says)

    def test_of_files_that_are_no_results(self):
        for text, code in (("", "not-a-campaign"), ("{", "not-a-campaign"), ("x" * 5000, "not-a-campaign")):
            self.write("bad.db", text)
            self.refused("atlas", "--specification", self.spec, "--out", self.folder_of_atlas, "--merge",
                         self.path("bad.db"), code=code, says="bad.db")
            self.assertFalse(os.path.exists(self.folder_of_atlas))

    def test_of_results_that_somebody_changed(self):
        self.submit("bathe")
        os.rename(self.path("bathe.db"), self.path("good.db"))
        for change, code, says in (
                ("UPDATE runs SET level = 1000000000000", "out-of-range", "runs: level = 1"),
                ("UPDATE runs SET level = 65", "out-of-range", "up to 64"),
                ("UPDATE runs SET level = 1.5", "out-of-range", "a whole number"),
                ("UPDATE runs SET level = 'x'", "not-a-number", 'runs: level = "x"'),
                ("UPDATE runs SET u_error = -0.001", "out-of-range", "runs: u_error = -0.001"),
                ("UPDATE runs SET u_error = 'none'", "not-a-number", "a number"),
                ("UPDATE runs SET steps = 1e300", "out-of-range", "steps = 1e+300"),
                ("UPDATE runs SET finished = printf('%.*c', 20000, 'x')", "out-of-range", "20000 bytes"),
                ("UPDATE subjects SET v_error = -1", "out-of-range", "subjects: v_error"),
                ("UPDATE subjects SET verdict = 'superb'", "unknown-name", "verdict = superb"),
                ("UPDATE subjects SET claim_behaviour = 'superb'", "unknown-name", "proper"),
                ("UPDATE subjects SET refusal = printf('%.*c', 20000, 'x')", "out-of-range", "20000 bytes"),
                ("INSERT OR REPLACE INTO campaign VALUES ('author', printf('%.*c', 20000, 'x'))", "out-of-range", "origin"),
                ("UPDATE subjects SET task = 7 WHERE task = 0", "not-a-campaign", "damaged"),
                ("UPDATE subjects SET method = '--exec=sh'", "not-a-campaign", "no task"),
                ("UPDATE subjects SET \"case\" = 'x; sh'", "not-a-campaign", "no task"),
                ("UPDATE subjects SET set_eta = 0.7", "not-a-campaign", "no task"),
                ("UPDATE campaign SET value = 'methods = 1' WHERE key = 'specification'", "bad-syntax", "methods"),
                ("ALTER TABLE subjects DROP COLUMN verdict", "not-a-campaign", "no column verdict"),
                ("CREATE VIEW seen AS SELECT 1", "not-a-campaign", "view seen")):
            shutil.copy(self.path("good.db"), self.path("bathe.db"))
            self.change(change)
            self.refused("atlas", "--specification", self.spec, "--out", self.folder_of_atlas, "--merge",
                         self.path("bathe.db"), code=code, says=("bathe.db", says))
            self.assertFalse(os.path.exists(self.folder_of_atlas), change)

    def test_to_overwrite_what_is_read(self):
        self.submit("bathe")
        os.symlink(self.spec, self.path("link.toml"))
        for command in (("atlas", "--specification", self.spec, "--submit", "rk4"), ("campaign", "report", self.spec),
                        ("campaign", "export", self.spec, "--format", "csv")):
            self.refused(*command, "--out", self.path("link.toml"), code="bad-syntax", says="would overwrite it")
        self.assertEqual(self.text_of("spec.toml"), SPEC)

    def test_of_two_files_of_one_name(self):
        self.submit("bathe")
        os.mkdir(self.path("more"))
        shutil.copy(self.path("bathe.db"), self.path("more/bathe.db"))
        self.refused("atlas", "--specification", self.spec, "--out", self.folder_of_atlas, "--merge",
                     self.path("bathe.db"), "--merge", self.path("more/bathe.db"), code="bad-syntax",
                     says=("more/bathe.db", "each name once"))

    def test_that_were_refused_leave_the_atlas_as_it_was(self):
        self.atlas()
        self.submit("bathe")
        self.change("UPDATE subjects SET task = 7 WHERE task = 0")
        self.refused("atlas", "--specification", self.spec, "--out", self.folder_of_atlas, "--merge",
                     self.path("bathe.db"), code="not-a-campaign", says="bathe.db")
        self.atlas()

    def change(self, statement):
        databases.change(self.path("bathe.db"), statement)

    def test_of_a_method_that_there_is_not(self):
        self.refused("atlas", "--specification", self.spec, "--submit", "newmrak", "--out", self.path("x.db"),
                     code="unknown-name", says='Did you mean "newmark"?')
        self.assertFalse(os.path.exists(self.path("x.db")))

    def submit(self, method):
        self.good("atlas", "--specification", self.spec, "--submit", method, "--out",
                  self.path(f"{method}.db"), "--quiet")


class Submissions(AtlasTest):
    def test_of_a_method_stand_in_another_atlas_with_their_author(self):
        self.good("atlas", "--specification", self.spec, "--submit", "bathe", "--author", "B. Author", "--out",
                  self.path("bathe.db"), "--quiet")
        self.atlas()
        self.atlas("--merge", self.path("bathe.db"))
        self.assertEqual(os.listdir(self.path("atlas/results")), ["bathe.db"])
        page = self.page()
        data = data_of(page)
        self.assertEqual(len(data["systems"]), 4, "the systems are the same")
        self.assertEqual(len(data["cells"]), 16)
        added = data["methods"][3]
        self.assertEqual((added["name"], data["parts"][added["part"]]["origin"]), ("bathe", "B. Author"))
        self.assertIn("--submit bathe", data["parts"][1]["command"])
        self.atlas()
        self.assertEqual(len(data_of(self.page())["cells"]), 16, "they stay in the atlas")

    def test_with_numbers_below_the_normal_ones_are_shown(self):
        self.good("atlas", "--specification", self.spec, "--submit", "bathe", "--out", self.path("bathe.db"), "--quiet")
        databases.change(self.path("bathe.db"), "UPDATE runs SET u_error = 1e-310")
        self.atlas("--merge", self.path("bathe.db"))
        self.assertIn("1e-310", self.page())

    def test_of_a_program_claim_what_their_author_says(self):
        self.write("solver", SOLVER)
        os.chmod(self.path("solver"), stat.S_IRWXU)
        self.write("spec.toml", SPEC.replace(", 1], xi1 = [0.05, 0.1]", "], xi1 = [0.05]"))
        command = f"{self.path('solver')} {{h}} 0.5"
        self.good("atlas", "--specification", self.spec, "--submit", "ours", "--exec", command, "--expect", "exact",
                  "--out", self.path("ours.db"), "--quiet")
        self.write("solver", f"#!/bin/sh\ntouch '{self.path('started')}'\n")
        self.atlas("--merge", self.path("ours.db"))
        for action in (("status",), ("export",), ("query", "SELECT 1"), ("report", "--out", self.path("page.html"), "--quiet")):
            self.good("campaign", action[0], self.path("ours.db"), *action[1:])
        self.assertFalse(os.path.exists(self.path("started")), "a program that a database names is not started")
        data = data_of(self.page())
        place = {name: i for i, name in enumerate(data["fields"])}
        cell = data["cells"][-1]
        self.assertEqual(data["words"][cell[place["verdict"]]], "agrees")
        added = data["methods"][3]
        self.assertEqual((added["call"], added["program"]), (f"--exec '{command}' --name ours --expect exact", True))
        self.assertFalse(data["methods"][0]["program"])
        self.assertEqual(data["parts"][1]["origin"], "ours")

    def test_that_were_interrupted_leave_no_file(self):
        self.write("long.toml", LONG)
        with start("atlas", "--specification", self.path("long.toml"), "--submit", "rk4", "--out",
                   self.path("rk4.db"), stdout=-1, stderr=-1, text=True) as process:
            with self.assertRaises(Exception):
                process.wait(1)
            process.send_signal(signal.SIGINT)
            _, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, errors)
        self.assertFalse(os.path.exists(self.path("rk4.db")))


class Report(AtlasTest):
    def test_of_a_campaign_is_a_page(self):
        database = self.path("runs.db")
        self.good("campaign", "run", self.spec, "--database", database, "--quiet")
        done = run("campaign", "report", database, "--out", self.path("page.html"))
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", f"Wrote {self.path('page.html')}\n"))
        page = self.text_of("page.html")
        self.assertIn("<h1>Campaign runs</h1>", page)
        self.assertEqual(len(data_of(page)["cells"]), 12)

    def test_needs_a_file_and_a_database(self):
        self.refused("campaign", "report", self.path("runs.db"), code="bad-syntax", says="--out page.html")
        self.refused("campaign", "report", self.path("runs.db"), "--out", self.path("page.html"), code="cannot-read",
                     exit_code=4)
        self.assertFalse(os.path.exists(self.path("page.html")))


if __name__ == "__main__":
    unittest.main()
