"""verify: verdicts as exit codes, the record, the report, and what it refuses."""
import json
import os
import signal
import subprocess
import unittest

from command import LONG_LADDER, PANEL, SHORT_LADDER, CommandTest, environment, run, start

# Enough levels for a judgement on RK4, and quick.
SHORT = ("--levels", "6", "--samples-per-level", "2")


class Verdicts(CommandTest):
    def test_agreement_is_exit_code_0(self):
        done = run("verify", "rk4", *SHORT)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("agrees", done.stdout)
        self.assertIn("proper", done.stdout)

    def test_a_contradiction_is_exit_code_1(self):
        # A spring this soft bounces where the true masses do not collide.
        soft = "newmark+penalty:stiffness=100"
        done = run("verify", soft, "--levels", "8", "--samples-per-level", "1")
        self.assertEqual((done.returncode, done.stderr), (1, ""))
        self.assertIn("disagrees", done.stdout)
        self.assertEqual(run("verify", soft, "rk4", "--levels", "8", "--samples-per-level", "1").returncode, 1)

    def test_a_ladder_that_is_too_short_is_undecided_with_exit_code_3(self):
        done = run("verify", "rk4", *SHORT_LADDER)
        self.assertEqual((done.returncode, done.stderr), (3, ""))
        self.assertIn("undecided", done.stdout)

    def test_the_table_fits_80_columns(self):
        for methods in (("rk4",), ("rk4", "newmark:beta=0.25,gamma=0.5", "moreau-jean",
                                   "newmark+penalty:stiffness=1e6")):
            for line in run("verify", *methods, *SHORT_LADDER).stdout.splitlines():
                self.assertLessEqual(len(line), 80, line)

    def test_all_is_every_pair(self):
        record = json.loads(run("verify", "--all", "--coarsest", "0.5", "--levels", "1",
                                "--samples-per-level", "1", "--format", "json").stdout)
        names = [subject["name"] for subject in record["cases"][0]["subjects"]]
        self.assertEqual(len(names), len(self.json_of("list", "pairs")["rows"]))
        self.refused("verify", "--all", "rk4", code="bad-syntax", says="--all")

    def test_only_shows_the_verdicts_asked_for(self):
        done = run("verify", "rk4", "newmark+penalty:stiffness=100", *SHORT, "--only", "agrees")
        self.assertEqual(done.returncode, 1)
        self.assertIn("Only agrees: 1 of 2 methods.", done.stdout)
        self.assertNotIn("newmark", done.stdout.split("Of 2 methods")[0].split("Only")[1])
        self.refused("verify", "--only", "disagree", code="unknown-name",
                     says='Did you mean "disagrees"?')
        self.refused("verify", "--only", "agrees", "--format", "json", code="bad-syntax",
                     says="--only: this is for tables")


class Path(CommandTest):
    def test_says_what_the_orders_are_and_should_be(self):
        lines = self.good("verify", "bar-wall", "newmark", "bdf1", "--path", "0.45", "--levels", "1").splitlines()
        self.assertEqual(lines[0], "bar-wall along the path step = 0.45 h/c, 16 to 29 elements")
        for line in lines:
            self.assertLessEqual(len(line), 80, line)
        self.good("verify", "newmark", "--path", "1/2", "--levels", "1", "--quiet", "--report",
                  self.path("path.html"))
        with open(self.path("path.html")) as file:
            self.assertIn("bar-wall along a path", file.read())
        done = self.json_of("verify", "newmark", "--path", "1/2", "--levels", "1")
        self.assertEqual(done["schema"], "clackers/path/1")
        self.assertEqual([len(sheet["rows"]) for sheet in done["sheets"]], [1, 1, 8, 8])

    def test_refuses_what_does_not_go_with_it(self):
        for rest in (("--path", "x"), ("--path", "0"), ("--path", "0.4", "--case", "stop"), ("--path", "0.4", "--coarsest", "0.1"),
                     ("--path", "0.4", "--film", self.path("a.gif")), ("--path", "0.4", "--case", "bar-wall", "--case", "two-bars")):
            self.refused("verify", "newmark", *rest, code="[a-z-]+", says="path")


class Requirements(CommandTest):
    def test_decide_the_exit_code_and_name_what_fails(self):
        done = run("verify", "rk4", *SHORT, "--require", "agrees", "--require", "order:4")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        done = run("verify", "rk4", *SHORT_LADDER, "--require", "agrees")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr, "Required: agrees. Not met by 1 of 1: rk4 (undecided).\n")
        done = run("verify", "rk4", *SHORT, "--require", "order:5", "--require", "proper", "--quiet")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"^Required: order:5\. Not met by 1 of 1: rk4 \(order (4\.0.|3\.9.)\)\.\n$")

    def test_count_refused_methods(self):
        both = ("rk4", "newmark+penalty", "--case", "stop", "--set", "eta=0.5", *SHORT)
        self.assertEqual(run("verify", *both).returncode, 0)
        done = run("verify", *both, "--require", "error:0.1")
        self.assertEqual(done.returncode, 1)
        self.assertIn("newmark+penalty (refused)", done.stderr)

    def test_are_refused_before_the_work(self):
        self.refused("verify", *LONG_LADDER, "--require", "agree", code="unknown-name", says='"agrees"')


class Record(CommandTest):
    def record(self, *arguments):
        return json.loads(run("verify", *arguments, "--format", "json").stdout)

    def test_holds_the_request(self):
        record = self.record("rk4", "newmark", "--case", "two-parameter", "--set", "N=1,xi1=0.1",
                             "--coarsest", "0.04", "--levels", "2", "--samples-per-level", "3", "--jobs", "1")
        self.assertEqual((record["schema"], record["command"]), ("clackers/record/1", "verify"))
        case, = record["cases"]
        self.assertEqual(case["plan"], {"coarsest": 0.04, "levels": 2, "samples_per_level": 3})
        self.assertEqual(case["problem"]["name"], "two-parameter")
        self.assertEqual({p["name"]: p["value"] for p in case["problem"]["parameters"]},
                         {"N": 1, "xi1": 0.1})
        self.assertEqual([m["name"] for m in case["subjects"]], ["rk4", "newmark"])
        for subject in case["subjects"]:
            self.assertEqual([len(level["runs"]) for level in subject["levels"]], [3, 3])
        self.assertFalse(record["interrupted"])

    def test_holds_the_command_as_a_shell_reads_it(self):
        arguments = ("rk4", *SHORT_LADDER, "--set", "xi1=0.1,N=1", "--out", self.path("it's a $file"))
        run("verify", *arguments, "--format", "json")
        with open(self.path("it's a $file")) as file:
            command = json.load(file)["provenance"]["command"]
        self.assertTrue(command.startswith("clackers verify rk4 --coarsest 0.05"), command)
        words = subprocess.run(["sh", "-c", f'clackers() {{ printf "%s\\n" "$@"; }}; {command}'],
                               capture_output=True, text=True).stdout.splitlines()
        self.assertEqual(words, ["verify", *arguments, "--format", "json"])

    def test_csv_has_a_row_a_run(self):
        text = run("verify", "rk4", "--levels", "2", "--samples-per-level", "3", "--format", "csv").stdout
        self.assertEqual(len(text.splitlines()), 1 + 6)

    def test_without_arguments_is_the_default_panel_on_the_default_case(self):
        record = self.record(*SHORT_LADDER)
        case, = record["cases"]
        self.assertEqual(case["problem"]["name"], "three-parameter")
        self.assertEqual(tuple(m["name"] for m in case["subjects"]), PANEL)


class Report(CommandTest):
    def test_is_written_beside_the_table_and_its_place_is_told(self):
        done = run("verify", "rk4", *SHORT_LADDER, "--report", self.path("r.html"))
        self.assertEqual(done.returncode, 3)
        self.assertEqual(done.stderr, f"Wrote {self.path('r.html')}\n")
        self.assertIn("rk4", done.stdout)
        self.assertEqual(self.files(), ["r.html"])
        with open(self.path("r.html")) as file:
            page = file.read()
        self.assertTrue(page.lower().startswith("<!doctype html>"))
        self.assertIn("</html>", page)
        self.assertIn(f"--report {self.path('r.html')}", page)

    def test_and_record_are_written_together(self):
        done = run("verify", "rk4", *SHORT_LADDER, "--quiet", "--report", self.path("r.html"),
                   "--out", self.path("r.json"), "--format", "json")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (3, "", ""))
        self.assertEqual(self.files(), ["r.html", "r.json"])

    def test_and_record_need_two_names(self):
        self.refused("verify", "--report", self.path("x"), "--out", self.path("./x"),
                     code="bad-syntax", says="same file")
        self.assertEqual(self.files(), [])


class Refusals(CommandTest):
    def test_of_unknown_names(self):
        self.refused("verify", "newmrak", code="unknown-name", says='Did you mean "newmark"?')
        self.refused("verify", "newmark+penatly", code="unknown-name", says='"penalty"')
        self.refused("verify", "newmark:bate=0.25", code="unknown-name", says='"beta"')
        self.refused("verify", "--case", "three-paramter", code="unknown-name",
                     says='"three-parameter"')
        self.refused("verify", "--set", "xi=1", code="unknown-name", says='"xi1"')

    def test_of_a_good_name_behind_which_a_bad_one_stands(self):
        self.refused("verify", "rk4", "newmrak", code="unknown-name")

    def test_of_ladders_that_make_no_sense(self):
        for options, code in ((("--levels", "0"), "out-of-range"),
                              (("--levels", "-3"), "out-of-range"),
                              (("--levels", "2.5"), "out-of-range"),
                              (("--levels", "nan"), "not-a-number"),
                              (("--levels", "1e12"), "out-of-range"),
                              (("--samples-per-level", "0"), "out-of-range"),
                              (("--jobs", "0"), "out-of-range"),
                              (("--jobs", "x"), "not-a-number"),
                              (("--coarsest", "0"), "step-not-positive"),
                              (("--coarsest", "-0.1"), "step-not-positive"),
                              (("--coarsest", "nan"), "(?:not-a-number|step-not-positive)"),
                              (("--coarsest", "inf"), "(?:not-finite|step-not-positive)"),
                              (("--coarsest", "21"), "step-not-positive"),
                              (("--coarsest", "1e-9"), "too-many-steps"),
                              (("--levels", "40"), "too-many-steps")):
            self.refused("verify", "rk4", *options, code=code, says=options[0].strip("-"))

    def test_of_parameters_outside_their_range(self):
        self.refused("verify", "newmark:gamma=0.4", code="out-of-range", says=("gamma", "1/2"))
        self.refused("verify", "newmark:beta=nan", code="not-a-number", says="beta")
        self.refused("verify", "--set", "xi1=1", code="out-of-range", says="0 <= xi1 < 1")
        self.refused("verify", "--case", "synchronized-pair", "--set", "r=5", code="not-admissible")


class Interrupted(CommandTest):
    def test_writes_the_finished_rows_whole_and_marked(self):
        for sign in (signal.SIGINT, signal.SIGTERM):
            with start("verify", "rk4", "newmark", *LONG_LADDER, "--format", "json", "--out",
                       self.path("r.json"), "--report", self.path("r.html"),
                       stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
                self.wait_for(lambda: len(self.open_files(process)) == 2)
                process.send_signal(sign)
                out, error = process.communicate(timeout=20)
            self.assertEqual((process.returncode, out), (130, b""), error)
            self.assertIn(b"interrupted; the finished rows were kept. [interrupted]\n", error)
            with open(self.path("r.json")) as file:
                record = json.load(file)
            self.assertEqual((record["schema"], record["interrupted"]), ("clackers/record/1", True))
            with open(self.path("r.html")) as file:
                self.assertIn("interrupted", file.read())
            self.assertEqual(self.files(), ["r.html", "r.json"])
            for name in self.files():
                os.unlink(self.path(name))

    def test_prints_the_table_when_there_is_no_file(self):
        process = start("verify", "rk4", *LONG_LADDER, "--out", "/dev/stdout", "--report",
                        self.path("r.html"), stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                        env=environment())
        self.wait_for(lambda: self.open_files(process))
        process.send_signal(signal.SIGINT)
        out, _ = process.communicate(timeout=20)
        self.assertEqual(process.returncode, 130)
        self.assertIn(b"interrupted", out.lower())


if __name__ == "__main__":
    unittest.main()
