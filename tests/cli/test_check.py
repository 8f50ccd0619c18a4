"""check: histories of other programs, what is found in them, and what is refused."""
import json
import math
import os
import signal
import struct
import subprocess
import unittest

import jsonschema  # Debian: python3-jsonschema

from command import CommandTest, rows, run, start

SCHEMA = os.path.join(os.path.dirname(__file__), "../../docs/schemas/check-1.json")

COLUMNS = ("t", "u1", "v1", "u2", "v2")


class CheckTest(CommandTest):
    @classmethod
    def setUpClass(cls):
        """The exact response of the default case every 0.01 s, and its collisions."""
        cls.response = run("respond", "three-parameter", "--step", "0.01", "--format", "csv").stdout
        cls.exact = [{k: row[k] if k == "side" else float(row[k]) for k in row}
                     for row in rows(cls.response)]
        cls.hits = run("respond", "three-parameter", "--collisions", "--format", "csv").stdout

    def write(self, name, text, mode="w", **more):
        path = self.path(name)
        with open(path, mode, **more) as file:
            file.write(text)
        return path

    def history(self, name, digits=17, every=1, columns=COLUMNS, between=",", header=True,
                change=lambda row: row, until=math.inf):
        """A file with the exact response, changed row by row."""
        lines = [between.join(columns)] if header else []
        for row in self.exact[::every]:
            row = change(dict(row))
            if row["t"] > until:
                break
            lines.append(between.join(f"{row[c]:.{digits}g}" for c in columns))
        return self.write(name, "\n".join(lines) + "\n")

    def converging(self, order=2, digits=17, levels=6, factor=1.0):
        """Files of a method of that order: the exact motion with an error factor (8 h)^order."""
        files = []
        for level in range(levels):
            h = 0.01 / 2**level
            def change(row):
                row["u1"] += factor * (8 * h)**order * math.sin(row["t"])
                return row
            files.append(self.history(f"h{h:.10g}.csv", digits, change=change))
        return files

    def checked(self, *arguments, exit_code=0):
        done = run("check", *arguments, "--format", "json")
        if (done.returncode, done.stderr) != (exit_code, ""):
            self.fail(f"{arguments}: {done.returncode} {done.stderr}\n" + run("check", *arguments).stdout)
        return json.loads(done.stdout)

    def notes(self, record):
        return " ".join(note for file in record["files"] for note in file["notes"])


class Verdicts(CheckTest):
    def test_without_a_claim_is_not_claimed(self):
        record = self.checked(self.history("exact.csv"))
        self.assertEqual((record["schema"], record["verdict"]), ("clackers/check/1", "not claimed"))
        self.assertLess(record["files"][0]["score"]["u_error"], 1e-14)
        impacts = record["files"][0]["score"]["impacts"]
        self.assertEqual((impacts["expected"], impacts["matched"], impacts["extra"]), (6, 6, 0))

    def test_on_several_files_give_the_order(self):
        record = self.checked(*self.converging(), "--expect", "proper:2")
        self.assertEqual(record["verdict"], "agrees")
        self.assertAlmostEqual(record["assessment"]["displacement"]["order"], 2.0, delta=0.01)
        self.assertEqual([round(0.01 / file["score"]["step"]) for file in record["files"]],
                         [2**n for n in range(6)])

    def test_go_by_what_is_expected(self):
        files = self.converging(order=1)
        self.checked(*files, "--expect", "proper:2", exit_code=1)
        self.checked(*files, "--expect", "reduced:1")
        self.assertEqual(self.checked(*files)["verdict"], "not claimed")
        self.checked(files[0], "--expect", "proper:2", exit_code=3)

    def test_go_by_the_tolerance(self):
        file = self.converging(levels=1)[0]
        error = self.checked(file)["files"][0]["score"]["u_error"]
        self.checked(file, "--tolerance", repr(error * 1.01))
        self.checked(file, "--tolerance", repr(error * 0.99), exit_code=1)

    def test_on_an_error_that_printing_blurs_is_undecided(self):
        file = self.history("coarse.csv", digits=4)
        record = self.checked(file, "--tolerance", "5e-4", exit_code=3)
        self.assertEqual(record["reason"], "printed-digits")
        self.checked(file, "--tolerance", "1e-2")

    def test_on_digits_too_few_for_the_order_name_them(self):
        files = self.converging(digits=5, factor=1e-3)
        record = self.checked(*files, "--expect", "proper:2", exit_code=3)
        self.assertEqual(record["assessment"]["displacement"]["behaviour"], "stagnating")
        self.assertEqual(record["reason"], "printed-digits")
        self.checked(*files, "--expect", "stagnating")

    def test_on_exact_histories_is_exact(self):
        record = self.checked(self.history("exact.csv"), "--expect", "exact")
        self.assertEqual(record["verdict"], "agrees")

    def test_on_another_motion_disagrees(self):
        # The masses pass through each other as if the other were not there.
        hits = [float(row["t"]) for row in rows(self.hits)]
        def through(row):
            sign = (-1)**sum(t < row["t"] for t in hits)
            return {name: value if name in ("t", "side") else sign * value
                    for name, value in row.items()}
        record = self.checked(self.history("through.csv", change=through), exit_code=1)
        self.assertEqual(record["verdict"], "disagrees")
        self.assertIn("another motion", record["sentence"])
        self.assertEqual(record["files"][0]["score"]["impacts"]["found"], 0)

    def test_on_missing_events_disagrees(self):
        lines = self.hits.splitlines()
        events = self.write("hits.csv", "\n".join(lines[:3] + lines[4:]) + "\n")
        record = self.checked(self.history("exact.csv"), "--events", events, exit_code=1)
        self.assertEqual(record["files"][0]["score"]["impacts"]["missed"], 1)
        none = self.write("none.csv", lines[0] + "\n")
        record = self.checked(self.history("exact.csv"), "--events", none, exit_code=1)
        self.assertIn("reports no collision, while 6 happen", self.notes(record))

    def test_with_the_exact_events_agree(self):
        events = self.write("hits.csv", self.hits)
        record = self.checked(self.history("exact.csv"), "--events", events)
        self.assertEqual(record["files"][0]["collision_source"], "events")
        self.assertEqual(record["files"][0]["score"]["impacts"]["worst_time_error"], 0)
        self.assertLess(record["files"][0]["score"]["v_error"], 1e-12)


class Formats(CheckTest):
    def test_output_of_respond_is_valid_input(self):
        record = self.checked(self.write("r.csv", self.response))
        self.assertLess(record["files"][0]["score"]["u_error"], 1e-14)

    def test_of_text_do_not_change_the_judgement(self):
        expected = self.checked(self.history("plain.csv"))["files"][0]["score"]
        with open(self.path("plain.csv")) as file:
            text = file.read()
        for name, bytes_ in (("semicolon", text.replace(",", ";").encode()),
                             ("tab", text.replace(",", "\t").encode()),
                             ("blank", text.replace(",", "   ").encode()),
                             ("crlf", text.replace("\n", "\r\n").encode()),
                             ("mark", b"\xef\xbb\xbf" + text.encode()),
                             ("no-end", text.rstrip("\n").encode()),
                             ("comment", b"# made by hand\n% and by foot\n" + text.encode()),
                             ("savetxt", b"# " + text.encode()),
                             ("case", text.replace("t,u1", "TIME,U1").encode())):
            path = self.write(name, bytes_, "wb")
            self.assertEqual(self.checked(path)["files"][0]["score"], expected, name)

    def test_without_a_header_need_names(self):
        path = self.history("bare.out", header=False, between=" ")
        self.refused("check", path, code="no-column", says=("5 columns", "--columns"))
        named = self.checked(path, "--columns", ",".join(COLUMNS))
        self.assertLess(named["files"][0]["score"]["u_error"], 1e-14)
        skipped = self.checked(path, "--columns", "t,u1,_,u2,_")
        self.assertFalse(skipped["files"][0]["has_velocities"])
        self.assertEqual(skipped["files"][0]["score"]["v_error"], "nan")

    def test_of_opensees_need_no_time(self):
        # A recorder: six digits, no header, no time, the first row after the first step.
        path = self.history("disp.out", digits=6, header=False, between=" ", columns=("u1", "u2"))
        self.refused("check", path, "--columns", "u1,u2", code="no-column", says="--steps")
        started = self.checked(path, "--columns", "u1,u2", "--steps", "0.01")
        self.assertIn("the first at 0", self.notes(started))
        with open(path) as file:
            later = self.write("later.out", "".join(file.readlines()[1:]))
        record = self.checked(later, "--columns", "u1,u2", "--steps", "0.01")
        self.assertIn("one step after the start", self.notes(record))
        file = record["files"][0]
        self.assertEqual(file["columns"][0]["digits"], 6)
        self.assertLess(file["score"]["u_error"], file["printed_floor"] * 1.01)

    def test_of_numbers_in_fortran_are_read(self):
        path = self.history("f.txt", between=" ")
        with open(path) as file:
            text = file.read().replace("e", "D")
        self.assertLess(self.checked(self.write("d.txt", text))["files"][0]["score"]["u_error"], 1e-14)

    def test_of_results(self):
        files = self.converging(levels=4)
        for line in run("check", *files).stdout.splitlines():
            self.assertLessEqual(len(line), 80, line)
        got = rows(run("check", *files, "--format", "csv").stdout)
        self.assertEqual(len(got), 4)
        self.assertEqual([row["file"] for row in got], files)
        self.assertIn("metric:u-max", got[0])
        with open(SCHEMA) as file:
            schema = json.load(file)
        jsonschema.Draft202012Validator.check_schema(schema)
        validator = jsonschema.Draft202012Validator(schema)
        for arguments in ((files[0],), (*files, "--expect", "proper:2", "--tolerance", "1"),
                          (files[0], "--columns", "t,u1,_,_,_")):
            validator.validate(self.checked(*arguments))
        for form in ("table", "csv", "json"):
            done = run("check", files[0], "--format", form, "--out", self.path("out"))
            self.assertEqual((done.returncode, done.stdout), (0, ""))
            self.assertEqual(done.stderr, f"Wrote {self.path('out')}\n")

    def test_table_ends_with_the_verdict_and_what_to_do(self):
        last = run("check", self.history("exact.csv")).stdout.splitlines()[-1]
        self.assertRegex(last, r"\AVerdict: not claimed\. Next: ")


class Steps(CheckTest):
    def steps(self, *arguments):
        return [(file["score"]["step"], file["step_source"])
                for file in self.checked(*arguments)["files"]]

    def test_come_from_the_option_the_name_and_the_rows(self):
        path = self.history("run.csv")
        (step, source), = self.steps(path)
        self.assertAlmostEqual(step, 0.01, delta=1e-12)
        self.assertEqual(source, "data")
        self.assertEqual(self.steps(self.history("run-h0.005.csv")), [(0.005, "name")])
        self.assertEqual(self.steps(path, "--steps", "0.0025"), [(0.0025, "option")])

    def test_longer_than_the_time_between_rows_are_not_taken_from_a_name(self):
        record = self.checked(self.history("h2.csv"))
        self.assertEqual(record["files"][0]["step_source"], "data")
        self.assertIn("not taken for the step", self.notes(record))

    def test_sort_the_files(self):
        files = [self.history(f"run{n}.csv", every=n) for n in (1, 4, 2)]
        self.assertEqual([round(step, 9) for step, _ in self.steps(*files)], [0.04, 0.02, 0.01])

    def test_of_levels_must_differ(self):
        files = [self.history(name) for name in ("a.csv", "b.csv")]
        self.refused("check", *files, code="out-of-range", says="--steps")
        self.refused("check", *files, "--steps", "0.1", code="wrong-size", says="2 here")
        self.refused("check", *files, "--events", files[0], code="wrong-size", says="--events")
        for steps, code in (("0,1", "(?:step-not-positive|out-of-range)"), ("x,1", "not-a-number"),
                            ("1,", "bad-syntax"), ("-1,1", "(?:step-not-positive|out-of-range)")):
            self.refused("check", *files, "--steps", steps, code=code)


class BadInput(CheckTest):
    def test_is_refused_with_its_line(self):
        for text, code, says in (
                ("", "too-short", "is empty"),
                ("t,u1,u2\n", "too-short", "no rows"),
                ("t,u1,u2\n0,1,-0.3333333333333333\n", "too-short", "two different times"),
                ("t,u1,u2\n0,1,2\n2,1,2\n1,1,2\n", "not-sorted", "line 4"),
                ("t,u1,u2\n0,1,2\n1,1,2\n1,1,2\n1,1,2\n", "not-sorted", "line 5"),
                ("t,u1,u2\n0,1,2\n1,nan,2\n", "not-finite", "line 3"),
                ("t,u1,u2\n0,1,2\n1,inf,2\n", "not-finite", "line 3"),
                ("t,u1,u2\n0,1,2\n1,1\n", "ragged-row", "line 3"),
                ("t;u1;u2\n0;1;2\n0,5;1;2\n", "decimal-comma", "line 3"),
                ("t,x1,u2x\n0,1,2\n1,1,1\n", "no-column", "no column u1"),
                ("t,u1,u2\n0,1,x\n1,1,1\n", "not-a-number", "line 2")):
            self.refused("check", self.write("bad.csv", text), code=code, says=says)
        binary = self.write("b.bin", bytes(range(256)), "wb")
        self.refused("check", binary, code="not-text", says="byte 0")

    def test_that_cannot_be_read_is_a_failure(self):
        self.refused("check", self.path("none.csv"), code="cannot-read", exit_code=4,
                     says="No such file")
        self.refused("check", self.folder, code="cannot-read", exit_code=4, says="directory")
        if os.geteuid() != 0:
            path = self.history("secret.csv")
            os.chmod(path, 0)
            self.refused("check", path, code="cannot-read", exit_code=4, says="Permission")

    def test_from_another_state_names_the_parameter(self):
        other = run("respond", "three-parameter", "--set", "N=3", "--step", "0.01", "--format",
                    "csv").stdout
        self.refused("check", self.write("n3.csv", other), code="not-this-case",
                     says=("n3.csv: ", "--set N=3 "))
        other = run("respond", "synchronized-pair", "--set", "A=2", "--step", "0.01", "--format",
                    "csv").stdout
        self.refused("check", self.write("a2.csv", other), "--case", "synchronized-pair",
                     code="not-this-case", says=("u1 starts at 2", "--set A=2 "))
        def still(row):
            row["v1"] += 0.05 * (row["t"] == 0)
            return row
        self.refused("check", self.history("still.csv", change=still), code="not-this-case",
                     says="v1 starts at 0")

    def test_a_little_beside_the_initial_state_is_said(self):
        def off(row):
            row["u2"] += 1e-5
            return row
        self.assertIn("initial state is off by 3e-05", self.notes(self.checked(
            self.history("off.csv", change=off))))

    def test_that_ends_early_or_late_is_said(self):
        early = self.checked(self.history("early.csv", until=10.005))
        self.assertIn("ends at 10 s, the case at 20 s", self.notes(early))
        self.assertEqual(early["files"][0]["score"]["impacts"]["expected"], 3)
        late = self.checked(self.history("late.csv"), "--set", "a_t=0.5")
        self.assertIn("1000 rows lie after the case's end, 10 s", self.notes(late))
        self.assertEqual(late["files"][0]["rows"], 1001)
        before = self.checked(self.history("before.csv", until=1.0))
        self.assertIn("nothing is said of impacts", self.notes(before))
        self.refused("check", self.write("beyond.csv", "t,u1,u2\n30,1,1\n31,1,1\n"),
                     code="too-short", says="t_end")

    def test_that_is_sampled_too_coarsely_is_said(self):
        record = self.checked(self.history("coarse.csv", every=50))
        self.assertEqual(record["reason"], "sparse-rows")
        self.assertIn("rows a fast period", self.notes(record))
        self.assertFalse(record["files"][0]["rows_resolve_collisions"])

    def test_with_few_digits_is_said(self):
        notes = self.notes(self.checked(self.history("six.csv", digits=6)))
        self.assertIn("u1 is printed with 6 digits", notes)
        def single_precision(row):
            for name in ("u1", "u2"):
                row[name], = struct.unpack("f", struct.pack("f", row[name]))
            return row
        single = self.history("single.csv", change=single_precision)
        self.assertIn("single precision", self.notes(self.checked(single)))

    def test_options_that_make_no_sense_are_refused(self):
        path = self.history("exact.csv")
        self.refused("check", code="bad-syntax", says="needs a FILE")
        for expect in ("proper", "exact:2", "proper:", "proper:x", "undecided", "proper:-1",
                       "proper:99"):
            self.refused("check", path, "--expect", expect,
                         code="(?:bad-syntax|out-of-range|unknown-name)", says="--expect")
        self.refused("check", path, "--expect", "propre:2", code="unknown-name", says="proper")
        for tolerance in ("0", "-1", "inf", "nan"):
            self.refused("check", path, "--tolerance", tolerance,
                         code="(?:out-of-range|not-a-number|not-finite)", says="--tolerance")
        self.refused("check", path, "--case", "three-paramter", code="unknown-name",
                     says='"three-parameter"')
        self.refused("check", path, "--columns", "t,,u1", code="bad-syntax", says="--columns")

    def test_that_never_ends_can_be_interrupted(self):
        os.mkfifo(self.path("pipe"))
        with start("check", self.path("pipe"), stdout=subprocess.PIPE,
                   stderr=subprocess.PIPE) as process:
            with open(self.path("pipe"), "w") as pipe:
                pipe.write("t,u1,u2\n0,1,-0.3\n")
                pipe.flush()
                process.send_signal(signal.SIGINT)
                out, error = process.communicate(timeout=20)
        self.assertEqual((process.returncode, out), (130, b""), error)


if __name__ == "__main__":
    unittest.main()
