"""respond: columns, times, impacts, the picture, and what it refuses."""
import array
import ast
import math
import os
import shutil
import signal
import subprocess
import time
import unittest

from command import PROGRAM, CommandTest, environment, run, run_on_terminal, start

PAIR = "t,side,u1,v1,a1,u2,v2,a2"
CASES = {"sdof": "t,side,u1,v1,a1", "stop": "t,side,u1,v1,a1", "symmetric-pair": PAIR,
         "one-parameter": PAIR, "two-parameter": PAIR, "three-parameter": PAIR,
         "synchronized-pair": PAIR, "exact-data-pair": PAIR}


class Columns(CommandTest):
    def test_are_those_of_the_grammar_for_every_case(self):
        for case, columns in CASES.items():
            text = self.good("respond", case, "--samples", "5", "--format", "csv")
            self.assertEqual(text.splitlines()[0], columns)
        head = self.good("respond", "three-parameter", "--impacts", "--format", "csv")
        self.assertEqual(head.splitlines()[0],
                         "k,t,u1,v1-,v1+,v2-,v2+,impulse,energy_before,energy_after")
        head = self.good("respond", "stop", "--impacts", "--format", "csv")
        self.assertEqual(head.splitlines()[0],
                         "k,t,u1,v1-,v1+,impulse,energy_before,energy_after")

    def test_json_has_schema_columns_and_the_same_doubles_as_csv(self):
        whole = self.json_of("respond", "three-parameter", "--samples", "101")
        self.assertEqual(whole["schema"], "clackers/response/1")
        self.assertEqual([c["name"] for c in whole["columns"]], PAIR.split(","))
        self.assertEqual([c["unit"] for c in whole["columns"]],
                         ["s", "", "m", "m/s", "m/s^2", "m", "m/s", "m/s^2"])
        listed = self.rows_of("respond", "three-parameter", "--samples", "101")
        self.assertEqual(len(listed), len(whole["rows"]))
        for row, values in zip(listed, whole["rows"]):
            for text, value in zip(row.values(), values):
                self.assertEqual(float(text) if text else None, value)

    def test_table_fits_80_columns(self):
        for case in CASES:
            for way in (("--samples", "11"), ("--impacts",)):
                for line in self.good("respond", case, *way).splitlines():
                    self.assertLessEqual(len(line), 80, line)


class Points(CommandTest):
    def test_of_a_bar_have_two_rows_where_a_front_passes(self):
        found = self.rows_of("respond", "bar-wall", "--at", "0,1/2", "--step", "0.25", "--set", "t_end=1")
        self.assertEqual(",".join(found[0]), "t,side,u1,v1,stress1,u2,v2,stress2,force,impulse,kinetic,elastic,potential")
        self.assertEqual([(row["t"], row["side"]) for row in found],
                         [("0", ""), ("0.25", "-"), ("0.25", "+"), ("0.5", ""), ("0.75", "-"), ("0.75", "+"), ("1", "")])
        self.assertEqual([row["v1"] for row in found], ["-1", "-1", "0", "0", "0", "0", "0"])
        self.assertEqual([row["stress2"] for row in found], ["0", "0", "0", "0", "0", "-1", "-1"])
        self.assertEqual([row["force"] for row in found], ["0", "0", "1", "1", "1", "1", "1"])
        self.assertEqual(found[-1]["impulse"], "0.75")
        self.assertEqual((found[-1]["kinetic"], found[-1]["elastic"]), ("0.125", "0.375"))

    def test_lie_in_the_bars_of_a_case(self):
        self.refused("respond", "bar-wall", "--at", "1.5", "--samples", "3", code="out-of-range", says="x = 1.5")
        string = self.rows_of("respond", "string-over-point", "--at", "0.25", "--step", "0.5", "--set", "t_end=0.5")
        self.assertEqual(",".join(string[0]), "t,side,u1,v1,transverse_force1,force,impulse,kinetic,elastic,potential")
        self.assertEqual(",".join(string[-1].values()), "0.5,,0,-2,0,4,0.5,1.5,0.5,0")
        # All points strike at 0.5 s: the impulse 4 between the limits.
        touch = self.rows_of("respond", "string-on-obstacle", "--at", "0.25", "--step", "0.5", "--set", "t_end=0.5,place=1/2")
        self.assertEqual([",".join(row.values()) for row in touch[-2:]],
                         ["0.5,-,0,-2,0,0,0,2,0,0", "0.5,+,0,2,0,0,4,2,0,0"])
        self.refused("respond", "two-bars", "--at", "-1.5", "--samples", "3", code="out-of-range", says="-1 <= x <= 2")
        self.refused("respond", "stop", "--at", "0", "--samples", "3", code="no-closed-form", says="bar-wall")
        self.refused("respond", "stop", "--at", "0", "--impacts", code="no-closed-form", says="bar-wall")

    def test_where_the_contact_changes(self):
        def changes(case, *settings):
            found = self.rows_of("respond", case, "--at", "0", "--impacts", "--set", ",".join(settings))
            return [",".join((row["t"], row["side"], row["force"], row["impulse"])) for row in found]
        self.assertEqual(changes("bouncing-bar", "t_end=21"),  # the second period of 16 s begins with the contact at 19 s
                         ["3,-,0,0", "3,+,0.375,0", "5,-,0.625,1", "5,+,0,1", "11,-,0,1", "11,+,0.625,1", "13,-,0.375,2",
                          "13,+,0,2", "19,-,0,2", "19,+,0.375,2", "21,-,0.625,3", "21,+,0,3"])
        self.assertEqual(changes("bar-between-stops", "t_end=3.5"),
                         ["0.25,-,0,0", "0.25,+,1,0", "2.25,-,1,2", "2.25,+,0,2", "3,-,0,2", "3,+,1,2"])
        self.assertEqual(changes("string-on-obstacle", "place=1/2,t_end=2"),
                         ["0.5,-,0,0", "0.5,+,0,4", "1.5,-,0,4", "1.5,+,0,8"])
        self.assertEqual(changes("string-over-point", "t_end=2"), ["0.375,-,0,0", "0.375,+,4,0", "1,-,4,2.5", "1,+,0,2.5",
                                                                   "1.75,-,0,2.5", "1.75,+,4,2.5"])
        for name in ("two-bars", "mass-on-bar"):
            self.assertEqual(len(changes(name, "t_end=5")), 4, name)
        self.assertEqual(changes("bar-wall", "t_end=2.25")[-2:], ["2.25,-,1,2", "2.25,+,0,2"])
        self.assertEqual(changes("bar-wall", "t_end=0.1"), [])
        self.assertIn("no contact", self.good("respond", "bar-wall", "--at", "0", "--impacts", "--set", "t_end=0.1"))
        self.assertIn("--at 0 --impacts", self.good("respond", "bar-wall", "--impacts"))


class Times(CommandTest):
    def times(self, *arguments, **more):
        return [float(row["t"]) for row in self.rows_of("respond", *arguments, **more)
                if row["side"] != "+"]

    def test_of_samples_are_equally_spaced_with_both_ends(self):
        self.assertEqual(self.times("sdof", "--samples", "8"), [k * (20 / 7) for k in range(7)] + [20])
        self.assertEqual(len(self.times("sdof", "--samples", "1e3")), 1000)

    def test_of_a_step_reach_the_end_when_it_divides_it(self):
        self.assertEqual(self.times("sdof", "--step", "7"), [0, 7, 14])
        self.assertEqual(self.times("sdof", "--step", "0.1"), [k * 0.1 for k in range(200)] + [20])
        self.assertEqual(self.times("sdof", "--step", "20"), [0, 20])

    def test_follow_the_end_of_the_case(self):
        self.assertEqual(self.times("sdof", "--samples", "2", "--set", "t_end=3"), [0, 3])

    def test_from_standard_input_skip_comments_and_blanks_and_keep_their_order(self):
        text = "# times\n\n 3.5 # the later one\n%\n\t1/2\r\n0x\n".replace("0x\n", "+2e0")
        self.assertEqual(self.times("sdof", "--times", "-", stdin=text), [3.5, 0.5, 2.0])

    def test_from_a_file(self):
        with open(self.path("times"), "w") as file:
            file.write("1\n2\n")
        self.assertEqual(self.times("sdof", "--times", self.path("times")), [1, 2])

    def test_read_back_to_the_same_double(self):
        given = [0.1, 1 / 3, math.pi, 5e-324, 19.999999999999996, 1e-17]
        text = "".join(f"{t!r}\n" for t in given)
        self.assertEqual(self.times("sdof", "--times", "-", stdin=text), given)

    def test_name_the_line_that_is_wrong(self):
        for text, code, says in (("1\n\n# x\nabc\n2", "not-a-number", ("line 4", '"abc"')),
                                 ("1\n0,5\n", "decimal-comma", ("line 2", "decimal point")),
                                 ("1\nnan\n", "not-finite", "line 2"),
                                 ("inf\n", "not-finite", "line 1"),
                                 ("1 2\n", "no-column", "line 1"), ("u1,u2\n1,2\n", "no-column", "column t"),
                                 ("1e999\n", "not-finite", "line 1"),
                                 ("1\n2\n20.000000000000004\n", "time-outside", ("line 3", "0 <= t <= 20")),
                                 ("-1e-9\n", "time-outside", "line 1"),
                                 ("0\0\n", "not-text", "byte 0")):
            self.refused("respond", "sdof", "--times", "-", stdin=text, code=code, says=says)

    def test_refuse_a_file_without_times(self):
        for text in ("", "\n\n", "# none\n", "t\n"):
            self.refused("respond", "sdof", "--times", "-", stdin=text, code="too-short", says="standard input")

    def test_of_a_history_are_its_column_t_with_both_sides_of_a_jump(self):
        text = self.good("respond", "stop", "--times", "-", "--format", "csv", stdin="1\n1.5727545956420138\n2")
        self.assertEqual(self.good("respond", "stop", "--times", "-", "--format", "csv", stdin=text), text)
        run("respond", "stop", "--samples", "3", "--format", "npy", "--out", self.path("h.npy"))
        self.assertEqual(self.times("stop", "--times", self.path("h.npy")), [0, 10, 20])

    def test_are_read_with_any_line_end_and_a_byte_order_mark(self):
        for end in ("\n", "\r\n", "\r"):
            self.assertEqual(self.times("sdof", "--times", "-", stdin=f"\ufeff0{end}1{end}"), [0, 1])

    def test_refuse_a_file_that_cannot_be_read(self):
        self.refused("respond", "sdof", "--times", self.path("none"), exit_code=4,
                     code="cannot-read", says=(self.path("none"), "No such file"))
        self.refused("respond", "sdof", "--times", self.folder, exit_code=4, code="cannot-read",
                     says="directory")
        self.refused("respond", "sdof", "--times", "/dev/zero", code="not-text", says="byte 0")


def npy(data):
    """Names, shape and numbers of NumPy's file, read as its format says."""
    assert data[:8] == b"\x93NUMPY\x01\x00", data[:8]
    end = 10 + int.from_bytes(data[8:10], "little")
    assert end % 64 == 0 and data[end - 1:end] == b"\n"
    header = ast.literal_eval(data[10:end].decode("ascii"))
    assert header["fortran_order"] is False
    assert {kind for _, kind in header["descr"]} == {"<f8"}
    return [name for name, _ in header["descr"]], header["shape"], array.array("d", data[end:])


class Npy(CommandTest):
    WAYS = (("three-parameter", "--samples", "5001"), ("stop", "--step", "0.1"),
            ("three-parameter", "--impacts"), ("stop", "--energy", "--samples", "11"),
            ("stop", "--sensitivity", "xi1", "--samples", "11"),
            ("stop", "--spectrum", "--samples", "11", "--highest", "20"))

    def test_holds_the_numbers_of_csv_in_a_file_and_in_a_pipe(self):
        sides = {"-": -1.0, "": 0.0, "+": 1.0}
        for way in self.WAYS:
            done = run("respond", *way, "--format", "npy", "--out", self.path("r.npy"))
            self.assertEqual(done.returncode, 0, done.stderr)
            with open(self.path("r.npy"), "rb") as file:
                data = file.read()
            piped = subprocess.run([PROGRAM, "respond", *way, "--format", "npy"],
                                   capture_output=True, env=environment(), timeout=60)
            self.assertEqual((piped.returncode, piped.stderr), (0, b""))
            self.assertEqual(piped.stdout, data)
            names, shape, values = npy(data)
            listed = self.rows_of("respond", *way)
            self.assertEqual(names, list(listed[0]))
            self.assertEqual(shape, (len(listed),))
            read = iter(values)
            for row in listed:
                for name, text in row.items():
                    expected = sides[text] if name == "side" else float(text)
                    self.assertEqual(next(read), expected, (way, name))
            self.assertEqual(list(read), [])

    def test_keeps_both_rows_at_an_impact(self):
        t = self.rows_of("respond", "stop", "--impacts")[0]["t"]
        run("respond", "stop", "--times", "-", "--format", "npy", "--out", self.path("r.npy"),
            stdin=f"1\n{t}\n2\n")
        with open(self.path("r.npy"), "rb") as file:
            names, shape, values = npy(file.read())
        self.assertEqual(shape, (4,))
        self.assertEqual(list(values[names.index("side")::len(names)]), [0, -1, 1, 0])

    def test_reads_back_with_numpy(self):
        program = next((python for python in ("python3", "/usr/bin/python3")
                        if shutil.which(python) and subprocess.run(
                            [python, "-c", "import numpy"], capture_output=True).returncode == 0),
                       None)
        if program is None:
            self.skipTest("no Python with numpy")
        run("respond", "stop", "--samples", "101", "--format", "npy", "--out", self.path("r.npy"))
        done = subprocess.run(
            [program, "-c", "import sys, numpy as np; a = np.load(sys.argv[1]); "
             "print(a.shape, a.dtype.names, repr(float(a['u1'][-1])), a.flags['C_CONTIGUOUS'])",
             self.path("r.npy")], capture_output=True, text=True)
        last = self.rows_of("respond", "stop", "--samples", "101")[-1]["u1"]
        self.assertEqual(done.stdout,
                         f"(101,) ('t', 'side', 'u1', 'v1', 'a1') {float(last)!r} True\n",
                         done.stderr)

    def test_is_refused_for_text_and_for_a_terminal(self):
        self.refused("respond", "stop", "--samples", "3", "--digits", "20", "--format", "npy",
                     code="bad-syntax", says=("--digits", "csv or json"))
        self.refused("respond", "stop", "--samples", "3", "--format", "npz", code="unknown-name",
                     says="table, csv, json, npy")
        self.refused("list", "cases", "--format", "npy", code="unknown-name")
        code, text = run_on_terminal("respond", "stop", "--samples", "3", "--format", "npy")
        self.assertEqual((code, text), (2, ""))
        code, text = run_on_terminal("respond", "stop", "--samples", "3", "--format", "npy",
                                     "--out", self.path("r.npy"))
        self.assertEqual(code, 0)


class Long(CommandTest):
    LONG = ("--samples", "1e9")

    def interrupted(self, *arguments):
        process = start("respond", "three-parameter", *arguments, "--out", self.path("rows"),
                        stderr=subprocess.PIPE)
        self.wait_for(lambda: self.open_files(process))
        time.sleep(0.3)
        process.send_signal(signal.SIGINT)
        begin = time.monotonic()
        text = process.communicate(timeout=20)[1].decode()
        self.assertEqual(process.returncode, 130, text)
        self.assertEqual(self.files(), [])
        return time.monotonic() - begin

    def test_ends_soon_after_an_interrupt(self):
        for way in (("--format", "csv"), ("--format", "json"), ("--format", "npy"), (),
                    ("--format", "csv", "--digits", "1000"),
                    ("--format", "csv", "--energy"), ("--format", "csv", "--sensitivity", "k2")):
            # 0.2 s on a machine that does nothing else.
            self.assertLess(self.interrupted(*self.LONG, *way), 1.0, way)

    def test_shows_its_progress_on_a_terminal(self):
        _, text = run_on_terminal("respond", "three-parameter", "--samples", "3e6", "--format",
                                  "csv", "--out", os.devnull, stream="stderr")
        self.assertRegex(text, r"\rrespond +\d+ %, \d+ s elapsed")
        _, text = run_on_terminal("respond", "three-parameter", "--samples", "3e6", "--format",
                                  "csv", "--out", os.devnull, "--quiet", stream="stderr")
        self.assertEqual(text, "")


class Impacts(CommandTest):
    def test_at_the_nearest_double_give_two_rows_and_at_its_neighbours_one(self):
        for case in ("three-parameter", "stop", "exact-data-pair"):
            hit = self.rows_of("respond", case, "--impacts")[1]
            t = float(hit["t"])
            times = [math.nextafter(t, 0), t, math.nextafter(t, 30)]
            got = self.rows_of("respond", case, "--times", "-", stdin="\n".join(map(repr, times)))
            self.assertEqual([row["side"] for row in got], ["", "-", "+", ""])
            self.assertEqual([float(row["t"]) for row in got], [times[0], t, t, times[2]])
            # The impact is at the true instant, the row at the double nearest to it: half an ulp
            # of t apart, where |a| <= E omega = 1 or less; both values are within 2 ulp of E omega.
            for row, side in ((got[1], "v1-"), (got[2], "v1+")):
                self.assertAlmostEqual(float(row["v1"]), float(hit[side]), delta=(t + 8) * 2**-52)
            self.assertLess(float(got[1]["v1"]) * float(got[2]["v1"]), 0)

    def test_are_numbered_from_one_and_in_order(self):
        got = self.rows_of("respond", "three-parameter", "--impacts")
        self.assertEqual([int(row["k"]) for row in got], list(range(1, len(got) + 1)))
        self.assertGreater(len(got), 3)
        times = [float(row["t"]) for row in got]
        self.assertEqual(times, sorted(times))
        self.assertEqual(self.rows_of("respond", "three-parameter", "--collisions"), got)

    def test_of_a_mass_without_stop_are_none(self):
        self.assertEqual(self.rows_of("respond", "sdof", "--impacts"), [])
        for case, end in (("sdof", "20"), ("stop", "0.5")):
            self.assertEqual(self.good("respond", case, "--set", f"t_end={end}", "--impacts"),
                             f"Impacts of {case}: none until the end of its run at {end} s\n")


class Quantities(CommandTest):
    WAYS = (("--energy", "--samples", "11"), ("--sensitivity", "m1", "--samples", "11"),
            ("--spectrum", "--samples", "11", "--highest", "20"))

    def test_have_their_columns_for_every_case_and_fit_80_columns(self):
        for case, response in CASES.items():
            two = response == PAIR
            heads = ("t,side,kinetic,potential,dissipated,lost,total,momentum",
                     "t,side,du1,dv1,da1" + (",du2,dv2,da2" if two else ""),
                     "omega,re1,im1" + (",re2,im2" if two else ""))
            for way, head in zip(self.WAYS, heads):
                text = self.good("respond", case, *way, "--format", "csv")
                self.assertEqual(text.splitlines()[0], head)
                for line in self.good("respond", case, *way).splitlines():
                    self.assertLessEqual(len(line), 80, line)

    def test_name_their_schema(self):
        for way, name in zip(self.WAYS, ("energy", "sensitivity", "spectrum")):
            self.assertEqual(self.json_of("respond", "stop", *way)["schema"], f"clackers/{name}/1")

    def test_energy_is_complete_at_every_time_and_jumps_where_the_impact_takes_it(self):
        hit = self.rows_of("respond", "stop", "--set", "eta=0.5", "--impacts")[0]
        got = self.rows_of("respond", "stop", "--set", "eta=0.5", "--energy", "--times", "-",
                           stdin=f"0\n{hit['t']}\n15\n")
        self.assertEqual([row["side"] for row in got], ["", "-", "+", ""])
        for row in got:
            # 64 units of 2^-52 in all.
            self.assertAlmostEqual(float(row["total"]), float(got[0]["total"]), delta=1.5e-14)
        taken = float(hit["energy_before"]) - float(hit["energy_after"])
        self.assertAlmostEqual(float(got[2]["lost"]) - float(got[1]["lost"]), taken, delta=1e-14)

    def test_sensitivity_is_what_a_small_change_of_the_parameter_makes(self):
        for name, setting in (("xi1", "xi1"), ("class:k1", "k1"), ("A", "A"), ("r", "r"),
                              ("eta", "eta")):
            base = {"xi1": 0.05, "k1": 1.0, "A": 1.0, "r": 0.5, "eta": 0.9}
            def at(change):
                values = {**base, setting: base[setting] + change}
                given = ",".join(f"{key}={value!r}" for key, value in values.items())
                return self.rows_of("respond", "synchronized-pair", "--set", given, "--times", "-",
                                    stdin="8.5\n")[0]
            up, down = at(1e-5), at(-1e-5)
            given = ",".join(f"{key}={value!r}" for key, value in base.items())
            got = self.rows_of("respond", "synchronized-pair", "--set", given, "--sensitivity", name,
                               "--times", "-", stdin="8.5\n")[0]
            for column in ("u1", "v1", "a1", "u2", "v2", "a2"):
                slope = (float(up[column]) - float(down[column])) / 2e-5
                # The third derivative grows with (X omega t)^2 = 6e3, times 1e-10.
                self.assertAlmostEqual(float(got["d" + column]), slope, delta=1e-4 * (1 + abs(slope)))

    def test_spectrum_at_zero_is_the_mean(self):
        got = self.rows_of("respond", "sdof", "--set", "xi1=0", "--spectrum", "--samples", "3",
                           "--highest", "2")
        self.assertEqual([float(row["omega"]) for row in got], [0, 1, 2])
        # The integrals of cos t and, at resonance, of cos t exp(-it) over 20 s.
        self.assertAlmostEqual(float(got[0]["re1"]), math.sin(20), delta=1e-13)
        self.assertAlmostEqual(float(got[1]["re1"]), 10 + math.sin(40) / 4, delta=1e-12)

    def test_of_an_unknown_parameter_are_refused_with_a_suggestion(self):
        self.refused("respond", "three-parameter", "--sensitivity", "u01", "--samples", "3",
                     code="unknown-name", says=("Did you mean", "u10 u20"))
        self.refused("respond", "sdof", "--sensitivity", "m2", "--samples", "3", code="unknown-name")
        self.refused("respond", "sdof", "--sensitivity", "", "--samples", "3", code="bad-syntax")

    def test_without_a_derivative_are_refused_with_the_reason(self):
        for case, name, settings, says in (
                ("synchronized-pair", "k2", ("--set", "eta=0"), "eta = 0"),
                ("stop", "eta", ("--set", "eta=0"), "eta = 0"),
                ("three-parameter", "N", (), "whole number"),
                ("synchronized-pair", "X", (), "whole number"),
                ("three-parameter", "a_t", (), "the end of the run"),
                ("sdof", "t_end", (), "the end of the run")):
            self.refused("respond", case, "--sensitivity", name, "--samples", "3", *settings,
                         code="no-derivative", says=says)

    def test_asked_for_in_contradiction_are_refused(self):
        for arguments, says in (
                (("--energy", "--spectrum", "--samples", "3"), "only one of"),
                (("--energy", "--sensitivity", "m1", "--samples", "3"), "only one of"),
                (("--energy",), "needs times"), (("--sensitivity", "m1"), "needs times"),
                (("--spectrum",), "needs --samples"),
                (("--spectrum", "--samples", "3"), "needs --highest"),
                (("--spectrum", "--step", "1", "--highest", "3"), "frequencies, not times"),
                (("--samples", "3", "--highest", "3"), "--spectrum; add it"),
                (("--energy", "--impacts"), "rows of its own"),
                (("--energy", "--samples", "3", "--digits", "5"), "takes no --digits")):
            self.refused("respond", "stop", *arguments, code="bad-syntax", says=says)
        for highest, code in (("0", "out-of-range"), ("-1", "out-of-range"), ("inf", "not-finite"),
                              ("1e300", "out-of-range"), ("x", "not-a-number")):
            self.refused("respond", "stop", "--spectrum", "--samples", "3", "--highest", highest,
                         code=code, says="highest")


class Picture(CommandTest):
    def test_alone_is_drawn_without_rows(self):
        text = self.good("respond", "three-parameter", "--plot")
        self.assertGreater(len(text.splitlines()), 8)
        for line in text.splitlines():
            self.assertLessEqual(len(line), 80, line)

    def test_stands_below_the_table(self):
        picture = self.good("respond", "stop", "--plot")
        table = self.good("respond", "stop", "--samples", "3")
        self.assertEqual(self.good("respond", "stop", "--samples", "3", "--plot"), table + picture)

    def test_is_on_the_terminal_while_rows_go_to_a_file(self):
        done = run("respond", "stop", "--plot", "--samples", "3", "--format", "csv", "--out",
                   self.path("rows.csv"))
        self.assertEqual(done.returncode, 0)
        self.assertEqual(done.stdout, self.good("respond", "stop", "--plot"))
        with open(self.path("rows.csv")) as file:
            self.assertEqual(len(file.readlines()), 4)

    def test_is_refused_inside_rows_for_a_program(self):
        for form in ("csv", "json"):
            self.refused("respond", "stop", "--plot", "--samples", "3", "--format", form,
                         code="bad-syntax", says="--out FILE")
        self.refused("respond", "stop", "--plot", "--out", self.path("x"), code="bad-syntax",
                     says="--out needs rows")
        self.assertEqual(self.files(), [])


class Refusals(CommandTest):
    def test_of_a_request_without_or_with_too_many_ways(self):
        self.refused("respond", code="bad-syntax", says="needs a CASE")
        self.refused("respond", "stop", code="bad-syntax", says="--impacts")
        self.refused("respond", "stop", "--samples", "3", "--step", "1", code="bad-syntax",
                     says="only one of")

    def test_of_unknown_names(self):
        self.refused("respond", "three-paramter", "--samples", "3", code="unknown-name",
                     says='Did you mean "three-parameter"?')
        self.refused("respond", "stop", "--samples", "3", "--set", "xi=0.1", code="unknown-name",
                     says=('"xi"', 'Did you mean "xi1"?'))

    def test_of_samples_that_are_no_sensible_number(self):
        for samples, code in (("0", "out-of-range"), ("1", "out-of-range"), ("-5", "out-of-range"),
                              ("2.5", "out-of-range"), ("nan", "not-a-number"),
                              ("many", "not-a-number"), ("inf", "out-of-range|not-finite"),
                              ("1e10", "too-many-rows"), ("1e300", "out-of-range")):
            self.refused("respond", "sdof", "--samples", samples, code=f"(?:{code})", says="samples")

    def test_of_steps_that_are_zero_negative_or_not_finite(self):
        for step, code in (("0", "step-not-positive"), ("-0.1", "step-not-positive"),
                           ("nan", "not-a-number"), ("inf", "not-finite"), ("x", "not-a-number"),
                           ("1e-9", "too-many-rows"),
                           ("1e-320", "too-many-rows")):
            self.refused("respond", "sdof", "--step", step, code=code, says="step")

    def test_of_a_step_longer_than_the_run(self):
        self.refused("respond", "sdof", "--step", "30", code="out-of-range", says="0 < step <= 20 s")

    def test_of_parameters_outside_their_range(self):
        for case, setting, code, says in (
                ("sdof", "xi1=1", "out-of-range", ("xi1 = 1", "0 <= xi1 < 1")),
                ("sdof", "xi1=-0.1", "out-of-range", "xi1 = -0.1"),
                ("sdof", "xi1=nan", "not-a-number", "xi1 = nan"),
                ("sdof", "t_end=inf", "not-finite", "t_end = inf"),
                ("sdof", "t_end=0", "out-of-range", "t_end = 0"),
                ("sdof", "t_end=-1", "out-of-range", "t_end = -1"),
                ("stop", "eta=1.5", "out-of-range", ("eta = 1.5", "0 <= eta <= 1")),
                ("stop", "eta=-0.1", "out-of-range", "eta = -0.1"),
                ("three-parameter", "N=2.5", "not-whole", "N = 2.5"),
                ("three-parameter", "N=-1", "out-of-range", "N = -1"),
                ("three-parameter", "a_t=0", "out-of-range", "a_t = 0"),
                ("synchronized-pair", "m1=-1", "out-of-range", "m1 = -1"),
                ("synchronized-pair", "m1=0", "out-of-range", "m1 = 0"),
                ("synchronized-pair", "k1=-1", "out-of-range", "k1 = -1"),
                ("synchronized-pair", "X=8", "not-odd", "X = 8"),
                ("synchronized-pair", "X=2.5", "not-odd", "X = 2.5"),
                ("synchronized-pair", "r=-1", "[a-z-]+", "r = -1"),
                ("synchronized-pair", "r=0", "[a-z-]+", "r = 0")):
            self.refused("respond", case, "--samples", "3", "--set", setting, code=code, says=says)

    def test_of_a_mass_ratio_beyond_r_star_say_how_far_where_when_and_what_to_change(self):
        text = self.refused("respond", "synchronized-pair", "--samples", "3", "--set", "r=5",
                            code="not-admissible", says=("r = 5", "4.41"))
        self.assertRegex(text, r"t = [0-9.]+ s")
        self.good("respond", "synchronized-pair", "--samples", "3", "--set", "r=4.41")

    def test_of_settings_that_are_no_settings(self):
        for setting, says in (("xi1", '"xi1"'), ("xi1=0,05", '"05"'), ("=3", '"=3"'),
                              ("", "empty"), ("xi1=0.1,", '""'), ("xi1=0.1,xi1=0.2", "set before")):
            self.refused("respond", "sdof", "--samples", "3", "--set", setting, code="bad-syntax",
                         says=says)
        self.refused("respond", "sdof", "--samples", "3", "--set", "xi1=0.1", "--set", "xi1=0.1",
                     code="bad-syntax", says="set before")
        self.refused("respond", "sdof", "--samples", "3", "--set", "xi1=abc", code="not-a-number",
                     says="xi1 = abc; allowed: 0 or 1e-60 <= xi1 < 1")
        for value in ("", "0.1x", "1/", "0x10", "1/2/3", "--1", "+-1", "1 2"):
            self.refused("respond", "sdof", "--samples", "3", "--set", f"xi1={value}",
                         code="not-a-number", says=f'xi1 = "{value}"')
        self.refused("respond", "sdof", "--samples", "3", "--set", "xi1=1e-999", code="not-finite")
        self.refused("respond", "sdof", "--samples", "3", "--set", "xi1=0/0", code="not-a-number")


if __name__ == "__main__":
    unittest.main()
