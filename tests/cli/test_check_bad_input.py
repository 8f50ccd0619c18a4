"""check: what is refused, and what is noted of a history that limits its own assessment."""
import math
import os
import signal
import struct
import subprocess
import unittest

from command import run, start
from histories import CheckTest


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

    def test_from_another_state_names_the_number_that_differs(self):
        other = run("respond", "three-parameter", "--set", "N=3", "--step", "0.01", "--format",
                    "csv").stdout
        self.refused("check", self.write("n3.csv", other), code="not-this-case",
                     says=("n3.csv: u2 starts at -0.230769", "at -0.333333: 0.31 of the envelope", "--set N=3"))
        other = run("respond", "synchronized-pair", "--set", "A=2", "--step", "0.01", "--format",
                    "csv").stdout
        self.refused("check", self.write("a2.csv", other), "--case", "synchronized-pair",
                     code="not-this-case", says=("u1 starts at 2", "With --set A=2 the case starts"))
        def still(row):
            row["v1"] += 0.05 * (row["t"] == 0)
            return row
        self.refused("check", self.history("still.csv", change=still), code="not-this-case",
                     says="v1 starts at 0")

    def test_from_another_state_than_that_of_a_problem_file_is_refused_as_well(self):
        rows = run("respond", "piecewise", "--step", "0.01", "--format", "csv").stdout.splitlines()
        cells = rows[1].split(",")
        rows[1] = ",".join(cells[:1] + [x and str(float(x) + 0.3) for x in cells[1:]])
        self.refused("check", self.write("piece.csv", "\n".join(rows)), "--case", "piecewise", code="not-this-case",
                     says="that of piecewise at")

    def test_whose_cause_is_plain_names_cause_and_cure(self):
        def millimetres(row):
            return {name: x if name == "t" else 1000 * x for name, x in row.items()}

        def exchanged(row):
            return row | {f"{x}{i}": row[f"{x}{3 - i}"] for x in "uv" for i in (1, 2)}

        def late(row):
            return row | {"t": 1000 * row["t"]}
        self.refused("check", self.history("mm.csv", change=millimetres), code="unit-scaled",
                     says=("are 1000 times those of the case, in mm: convert them to m and m/s.",))
        self.refused("check", self.history("exchanged.csv", change=exchanged),
                     code="masses-exchanged", says="--columns t,")
        self.refused("check", self.history("ms.csv", change=late), code="time-unit",
                     says="Times are in milliseconds, 1000 times seconds: convert them to seconds.")
        other = run("respond", "three-parameter", "--set", "N=5,xi1=0.25", "--step", "0.01",
                    "--format", "csv").stdout
        self.refused("check", self.write("both.csv", other), code="not-this-case",
                     says="With --set N=5,xi1=0.25 the case starts as the history does.")

    def test_a_little_beside_the_initial_state_is_said(self):
        def off(row):
            row["u2"] += 1e-5
            return row
        (error,), _ = self.notes(self.checked(self.history("off.csv", change=off)))["start-differs"]
        self.assertAlmostEqual(error, 3e-5, delta=1e-6)

    def test_that_ends_early_or_late_is_said(self):
        early = self.checked(self.history("early.csv", until=10.005), exit_code=3)
        self.assertEqual(self.notes(early)["ends-early"], ([10, 20], ""))
        self.assertEqual(self.runs(early)[0]["impacts"]["expected"], 3)
        late = self.checked(self.history("late.csv"), "--set", "a_t=0.5")
        self.assertEqual(self.notes(late)["rows-beyond-end"], ([1000, 10], ""))
        self.assertEqual(self.runs(late)[0]["file"]["rows"], 1001)
        before = self.checked(self.history("before.csv", until=1.0), exit_code=3)
        self.assertIn("no-impacts", self.notes(before))
        self.refused("check", self.write("beyond.csv", "t,u1,u2\n30,1,1\n31,1,1\n"),
                     code="too-short", says="t_end")

    def test_that_is_sampled_too_coarsely_is_said(self):
        record = self.checked(self.history("coarse.csv", every=50))
        self.assertEqual(self.assessment(record)["reason"], "sparse-rows")
        self.assertIn("few-rows-a-period", self.notes(record))
        self.assertFalse(self.runs(record)[0]["file"]["rows_resolve_collisions"])

    def test_whose_last_line_has_no_line_feed_is_noted(self):
        path = self.history("cut.csv")
        self.assertNotIn("last-line-incomplete", self.notes(self.checked(path)))
        with open(path) as file:
            text = file.read()
        self.write("cut.csv", text[:-3])  # its last number lost digits
        self.assertEqual(self.notes(self.checked(path))["last-line-incomplete"], ([2002], ""))
        self.assertIn("line feed", run("check", path).stdout)

    def test_with_few_digits_is_said(self):
        notes = self.notes(self.checked(self.history("six.csv", digits=6)))
        self.assertEqual((notes["printed-digits"][0][:2], notes["printed-digits"][1]), ([6, 0], "u1"))
        def single_precision(row):
            for name in ("u1", "u2"):
                row[name], = struct.unpack("f", struct.pack("f", row[name]))
            return row
        single = self.history("single.csv", change=single_precision)
        self.assertEqual(self.notes(self.checked(single))["printed-digits"][0][1], 1)

    def test_options_that_make_no_sense_are_refused(self):
        path = self.history("exact.csv")
        self.refused("check", code="bad-syntax", says="needs a FILE")
        for expect in ("proper", "exact:2", "proper:", "proper:x", "undecided", "proper:-1",
                       "proper:99"):
            self.refused("check", path, "--expect", expect,
                         code="(?:bad-syntax|out-of-range|unknown-name)", says="expect")
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
