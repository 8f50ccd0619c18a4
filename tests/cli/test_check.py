"""check: histories of other programs and what is found in them."""
import csv
import json
import math
import os
import re
import unittest

import jsonschema  # Debian: python3-jsonschema

from command import rows, run
from histories import COLUMNS, CheckTest

SCHEMA = os.path.join(os.path.dirname(__file__), "../../docs/schemas/record-1.json")


class Verdicts(CheckTest):
    def test_without_a_claim_is_not_claimed(self):
        record = self.checked(self.history("exact.csv"))
        self.assertEqual((record["schema"], record["command"]), ("clackers/record/1", "check"))
        self.assertEqual(self.assessment(record)["verdict"], "not claimed")
        self.assertLess(self.runs(record)[0]["u_error"], 1e-14)
        impacts = self.runs(record)[0]["impacts"]
        self.assertEqual((impacts["expected"], impacts["matched"], impacts["extra"]), (6, 6, 0))

    def test_on_several_files_give_the_order(self):
        record = self.checked(*self.converging(), "--expect", "proper:2")
        self.assertEqual(self.assessment(record)["verdict"], "agrees")
        self.assertAlmostEqual(self.assessment(record)["displacement"]["order"], 2.0, delta=0.01)
        self.assertEqual([round(0.01 / found["step"]) for found in self.runs(record)],
                         [2**n for n in range(6)])

    def test_go_by_what_is_expected(self):
        files = self.converging(order=1)
        self.checked(*files, "--expect", "proper:2", exit_code=1)
        self.checked(*files, "--expect", "reduced:1")
        self.assertEqual(self.assessment(self.checked(*files))["verdict"], "not claimed")
        self.checked(self.converging(levels=1)[0], "--expect", "proper:2", exit_code=3)

    def test_go_by_the_tolerance(self):
        file = self.converging(levels=1)[0]
        error = self.runs(self.checked(file))[0]["u_error"]
        self.checked(file, "--tolerance", repr(error * 1.01))
        self.checked(file, "--tolerance", repr(error * 0.99), exit_code=1)

    def test_on_an_error_that_printing_blurs_is_undecided(self):
        file = self.history("coarse.csv", digits=4)
        record = self.checked(file, "--tolerance", "5e-4", exit_code=3)
        self.assertEqual(self.assessment(record)["reason"], "printed-digits")
        self.checked(file, "--tolerance", "1e-2")

    def test_on_digits_too_few_for_the_order_name_them(self):
        files = self.converging(digits=5, factor=1e-3)
        record = self.checked(*files, "--expect", "proper:2", exit_code=3)
        self.assertEqual(self.assessment(record)["displacement"]["behaviour"], "stagnating")
        self.assertEqual(self.assessment(record)["reason"], "printed-digits")
        self.checked(*files, "--expect", "stagnating")

    def test_on_exact_histories_is_exact(self):
        record = self.checked(self.history("exact.csv"), "--expect", "exact")
        self.assertEqual(self.assessment(record)["verdict"], "agrees")

    def test_on_another_motion_disagrees(self):
        # The masses pass through each other as if the other were not there.
        hits = [float(row["t"]) for row in rows(self.hits)]
        def through(row):
            sign = (-1)**sum(t < row["t"] for t in hits)
            return {name: value if name in ("t", "side") else sign * value
                    for name, value in row.items()}
        record = self.checked(self.history("through.csv", change=through), exit_code=1)
        self.assertEqual(self.assessment(record)["verdict"], "disagrees")
        self.assertEqual(self.assessment(record)["evidence"][0]["code"], "other-impacts")
        self.assertEqual(self.runs(record)[0]["impacts"]["found"], 0)

    def test_on_missing_events_disagrees(self):
        lines = self.hits.splitlines()
        events = self.write("hits.csv", "\n".join(lines[:3] + lines[4:]) + "\n")
        record = self.checked(self.history("exact.csv"), "--events", events, exit_code=1)
        self.assertEqual(self.runs(record)[0]["impacts"]["missed"], 1)
        none = self.write("none.csv", lines[0] + "\n")
        record = self.checked(self.history("exact.csv"), "--events", none, exit_code=1)
        self.assertEqual(self.notes(record)["no-impacts-reported"], ([6], ""))

    def test_on_events_in_milliseconds_is_refused(self):
        times = [1000 * float(row["t"]) for row in rows(self.hits)]
        events = self.write("ms.csv", "\n".join(["t", *map(repr, times)]) + "\n")
        self.refused("check", self.history("exact.csv"), "--events", events, code="time-unit",
                     says=("ms.csv: Times are in milliseconds, 1000 times seconds",))

    def test_with_the_exact_events_agree(self):
        events = self.write("hits.csv", self.hits)
        record = self.checked(self.history("exact.csv"), "--events", events)
        self.assertEqual(self.runs(record)[0]["file"]["collision_source"], "events")
        self.assertEqual(self.runs(record)[0]["impacts"]["worst_time_error"], 0)
        self.assertLess(self.runs(record)[0]["v_error"], 1e-12)


class Names(CheckTest):
    def files(self):
        """Two steps of the exact motion, as two solvers write them."""
        return self.history("a0.01.csv"), self.history("b0.02.csv", every=2), self.history("b0.01.csv")

    def test_make_subjects_of_the_files_behind_them(self):
        one, *two = self.files()
        record = self.checked("--name", "A", one, "--name", "B", *two, "--steps", "0.01,0.02,0.01")
        subjects = record["cases"][0]["subjects"]
        self.assertEqual([subject["name"] for subject in subjects], ["A", "B"])
        self.assertEqual([[level["step"] for level in subject["levels"]] for subject in subjects],
                         [[0.01], [0.02, 0.01]])
        with open(SCHEMA) as file:
            jsonschema.validate(record, json.load(file))
        text = run("check", "--name", "A", one, "--name=B", *two).stdout
        self.assertRegex(text, "\\ANot claimed: of 2 methods, 2 not claimed.\n")
        self.assertRegex(text, "(?m)^B .* not claimed$")
        self.assertRegex(text, "(?m)^b0.02.csv  B ")
        latex = run("check", "--name", "A", one, "--name=B", *two, "--format", "latex").stdout
        self.assertIn("a\\_t = 1). Of each method", latex)
        self.assertIn("\\par B: No events file", latex)

    def test_say_who_leaves_the_exact_motion_first(self):
        # The masses pass through each other from the second impact on.
        def through(row):
            sign = (-1)**sum(hits[1] <= t < row["t"] for t in hits)
            return {name: value if name in ("t", "side") else sign * value for name, value in row.items()}
        hits = [float(row["t"]) for row in rows(self.hits)]
        files = "--name", "A", self.history("through.csv", change=through), "--name", "B", self.history("exact.csv")
        left, right = (subject["departure"] for subject in self.checked(*files, exit_code=1)["cases"][0]["subjects"])
        self.assertEqual((left["impact"], left["time"], right), (2, hits[1], None))
        self.assertIn("First to leave the exact motion: A at t = 4.72 s (impact 2); B stays on it to",
                      run("check", *files, "--format", "table").stdout)

    def test_are_compared_with_a_baseline(self):
        one, *two = self.files()
        before = self.write("before.json", run("check", "--name", "A", one, "--format", "json").stdout)
        text = run("check", "--name", "A", one, "--name", "B", *two, "--baseline", before).stdout
        self.assertIn("1 of 2 methods\nchanged", text)
        self.assertIn("B: is new", text)

    def test_out_of_place_are_refused(self):
        one, *two = self.files()
        for arguments, says in (((one, "--name", "B", *two), "FILE before the first --name = " + one),
                                (("--name", "A", "--name", "B", *two), "--name = A; allowed: a name with one FILE"),
                                (("--name", "A", one, "--name", "A", *two), "--name = A; allowed: each name once")):
            self.refused("check", *arguments, code="bad-syntax", says=says)
        self.refused("check", "--name", "A", one, "--name", "B", *two, "--steps", "0.01,0.02", code="wrong-size",
                     says="2 of them; allowed: one a history, 3 here")


class Against(CheckTest):
    def against(self, *arguments, exit_code=0):
        done = run("check", *arguments, "--format", "json")
        self.assertEqual((done.returncode, done.stderr), (exit_code, ""))
        return [[dict(zip([column["name"] for column in sheet["columns"]], row)) for row in sheet["rows"]]
                for sheet in json.loads(done.stdout)["sheets"]]

    def test_another_set_is_compared_at_common_times_and_with_itself(self):
        exact = self.history("exact.csv", every=2)
        # The finest of the converging files is (8 h)^2 sin t away in u1, h = 0.01/16; its rows are every 0.01 s.
        h = 0.01 / 16
        files = self.converging(levels=5)
        masses, sets = self.against(*files, "--against", exact)
        self.assertAlmostEqual(masses[0]["difference"], (8 * h)**2, delta=1e-4 * h**2)
        self.assertAlmostEqual(math.sin(masses[0]["time"])**2, 1, delta=1e-3)
        self.assertEqual((masses[0]["since"], masses[1]["difference"]), (None, 0))
        self.assertAlmostEqual(sets[0]["order"], 2, delta=0.01)
        self.assertEqual((sets[1]["histories"], sets[1]["order"]), (1, None))

    def test_a_difference_that_is_visible_has_its_first_time(self):
        def compared(by):
            late = self.history("late.csv", change=lambda row: row | {"u2": row["u2"] + by * (row["t"] > 7.005)})
            return self.against(late, "--against", self.history("exact.csv"))[0]

        masses = compared(0.01)
        self.assertEqual([mass["since"] for mass in masses], [None, 7.01])
        visible = 0.01 * 1e-3 / masses[1]["relative"]
        self.assertEqual([compared(share * visible)[1]["since"] for share in (0.9, 1.1)], [None, 7.01])

    def test_the_exit_code_is_that_of_the_tolerance(self):
        files = self.converging(levels=1) + ["--against", self.history("exact.csv")]
        self.against(*files, "--tolerance", "0.0065")
        self.against(*files, "--tolerance", "0.0063", exit_code=1)
        self.assertIn("Agreement is no proof", run("check", *files).stdout)
        self.assertEqual([each["set"] for each in self.against(*files)[1]], ["h0.01.csv", "exact.csv"])

    def test_tolerances_stand_in_place_of_steps(self):
        files = self.converging(levels=5)
        given = ("--tolerances", "1e-3,2e-4,4e-5,8e-6,1.6e-6,0.1")
        sets = self.against(*files, "--against", self.history("exact.csv", every=2), *given)[1]
        self.assertEqual([each["finest"] for each in sets], [1.6e-6, 0.1])
        self.assertAlmostEqual(sets[0]["order"], math.log(4) / math.log(5), delta=0.01)
        self.refused("check", *files, "--against", files[0], *given, "--steps", "1", code="bad-syntax", says="one of them")

    def test_a_page_draws_the_differences_and_the_first_that_is_visible(self):
        late, page = self.history("late.csv", change=lambda row: row | {"u2": row["u2"] + 0.01 * (row["t"] > 7.005)}), self.path("page.html")
        done = run("check", late, "--against", self.history("exact.csv"), "--tolerance", "1e-6", "--report", page)
        self.assertEqual(done.returncode, 1)
        with open(page, encoding="utf-8") as file:
            text = file.read()
        data, drawn = (json.loads(re.search(rf'id="{name}">(.*?)</script>', text)[1]) for name in ("data", "specifications"))
        points = data["difference"]
        self.assertEqual({point["series"] for point in points}, {"mass 2"})
        self.assertAlmostEqual(min(point["x"] for point in points), 7.01, delta=0.05)
        self.assertEqual(drawn["difference"]["layer"][0]["data"]["values"][0]["x"], 7.01)
        for words in ("of mass 2 at t = 7.01 s", "Agreement is no proof"):
            self.assertIn(words, text)

    def test_a_part_of_the_motion_is_said_and_leaves_the_tolerance_undecided(self):
        exact = self.history("exact.csv")
        short = self.history("short.csv", until=10)
        done = run("check", exact, "--against", short)
        self.assertEqual(done.returncode, 0)
        self.assertIn("Compared from 0 to 10 s only; the first set goes from 0 to 20 s.", " ".join(done.stdout.split()))
        self.assertEqual(run("check", short, "--against", exact, "--tolerance", "1e-3").returncode, 3)
        self.assertNotIn("only", run("check", exact, "--against", exact).stdout)
        milliseconds = self.history("ms.csv", change=lambda row: row | {"t": 1000 * row["t"]})
        self.refused("check", exact, "--against", milliseconds, code="wrong-size", says="a factor of 1000")

    def test_what_cannot_be_compared_is_refused(self):
        exact, other = self.history("exact.csv"), self.history("other.csv", change=lambda row: row | {"t": 1.001 * row["t"]})
        self.refused("check", exact, "--against", exact, "--case", "stop", code="bad-syntax", says="--case is for an exact motion")
        self.refused("check", exact, "--case", "stop", "--node", "3", code="bad-syntax", says="--node = 3")
        self.refused("check", "--against", exact, code="bad-syntax", says="a FILE before it and one behind it")
        self.refused("check", exact, "--against", other, code="wrong-size", says="write both at the same times")
        self.refused("check", exact, "--against", self.history("one.csv", columns=("t", "u1")), code="no-column", says="no u2")
        self.refused("check", exact, "--against", other, exact, "--steps", "0.1,0.2", code="wrong-size", says="3 here")


class Formats(CheckTest):
    def test_output_of_respond_is_valid_input(self):
        record = self.checked(self.write("r.csv", self.response))
        self.assertLess(self.runs(record)[0]["u_error"], 1e-14)

    def test_of_text_do_not_change_the_errors(self):
        def score(path):
            found = self.runs(self.checked(path))[0]
            return {name: found[name] for name in ("u_error", "v_error", "energy_error", "impacts")}
        expected = score(self.history("plain.csv"))
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
            self.assertEqual(score(path), expected, name)

    def test_without_a_header_need_names(self):
        path = self.history("bare.out", header=False, between=" ")
        self.refused("check", path, code="no-column", says=("5 columns", "--columns"))
        named = self.checked(path, "--columns", ",".join(COLUMNS))
        self.assertLess(self.runs(named)[0]["u_error"], 1e-14)
        skipped = self.checked(path, "--columns", "t,u1,_,u2,_")
        self.assertFalse(self.runs(skipped)[0]["file"]["has_velocities"])
        self.assertEqual(self.runs(skipped)[0]["v_error"], "nan")

    def test_of_opensees_need_no_time(self):
        # A recorder: six digits, no header, no time, the first row after the first step.
        path = self.history("disp.out", digits=6, header=False, between=" ", columns=("u1", "u2"))
        self.refused("check", path, "--columns", "u1,u2", code="no-column", says="--steps")
        started = self.checked(path, "--columns", "u1,u2", "--steps", "0.01")
        self.assertEqual(self.notes(started)["no-times"], ([0.01, 0], ""))
        with open(path) as file:
            later = self.write("later.out", "".join(file.readlines()[1:]))
        record = self.checked(later, "--columns", "u1,u2", "--steps", "0.01")
        self.assertEqual(self.notes(record)["no-times"], ([0.01, 0.01], ""))
        found = self.runs(record)[0]
        self.assertEqual(found["file"]["columns"][0]["digits"], 6)
        self.assertLess(found["u_error"], found["file"]["printed_floor"] * 1.01)

    def test_of_numbers_in_fortran_are_read(self):
        path = self.history("f.txt", between=" ")
        with open(path) as file:
            text = file.read().replace("e", "D")
        self.assertLess(self.runs(self.checked(self.write("d.txt", text)))[0]["u_error"], 1e-14)

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


class Impacts(CheckTest):
    def test_of_the_exact_motion_keep_restitution_momentum_and_time(self):
        found = self.checked(self.history("exact.csv"))["cases"][0]["subjects"][0]["impact_table"]
        exact = [float(row["t"]) for row in csv.DictReader(self.hits.splitlines())]
        self.assertEqual(len(found), len(exact))
        for impact, t in zip(found, exact):
            self.assertAlmostEqual(impact["t"], t, delta=1e-9)
            self.assertAlmostEqual(impact["restitution"], 1.0, delta=1e-9)
            self.assertAlmostEqual(impact["momentum_defect"], 0.0, delta=1e-7)
            self.assertAlmostEqual(impact["delay_steps"], 0.0, delta=1e-6)

    def test_stand_in_a_table_when_asked(self):
        file = self.history("exact.csv")
        self.assertNotIn("Impacts of the finest", run("check", file).stdout)
        lines = run("check", file, "--impacts").stdout.splitlines()
        start = lines.index("Impacts of the finest history, read from its rows")
        self.assertIn("restitution", " ".join(lines[start:start + 4]))
        self.assertEqual(sum(line.lstrip()[:1].isdigit() for line in lines[start:start + 12]), 6)
        self.assertLessEqual(max(map(len, lines)), 80)
        displacements = self.history("u.csv", columns=("t", "u1", "u2"))
        self.assertIn("The rows show no impact", run("check", displacements, "--impacts").stdout)


class Steps(CheckTest):
    def steps(self, *arguments):
        return [(found["step"], found["file"]["step_source"])
                for found in self.runs(self.checked(*arguments))]

    def test_come_from_the_option_the_name_and_the_rows(self):
        path = self.history("run.csv")
        (step, source), = self.steps(path)
        self.assertAlmostEqual(step, 0.01, delta=1e-12)
        self.assertEqual(source, "data")
        self.assertEqual(self.steps(self.history("run-h0.005.csv")), [(0.005, "name")])
        self.assertEqual(self.steps(path, "--steps", "0.0025"), [(0.0025, "option")])

    def test_longer_than_the_time_between_rows_are_not_taken_from_a_name(self):
        record = self.checked(self.history("h2.csv"))
        self.assertEqual(self.runs(record)[0]["file"]["step_source"], "data")
        self.assertEqual(self.notes(record)["step-in-name-ignored"][0][0], 2)

    def test_of_names_count_before_rows_of_dense_output(self):
        files = [self.history(f"dt={step}.csv") for step in (0.04, 0.02)]
        self.assertEqual(self.steps(*files), [(0.04, "name"), (0.02, "name")])
        record = self.checked(*files)
        self.assertEqual(self.notes(record)["rows-closer-than-step"][0][0], 0.02)
        files = [self.history(f"N{count}.csv") for count in (500, 1000)]
        self.assertEqual(self.steps(*files), [(0.04, "name"), (0.02, "name")])

    def test_may_be_tolerances(self):
        files = [self.history(f"rtol1e-0{n}.csv") for n in (3, 6)]
        subject = self.checked(*files)["cases"][0]["subjects"][0]
        self.assertEqual(subject["resolution"], "tolerance")
        self.assertEqual([level["step"] for level in subject["levels"]], [1e-3, 1e-6])
        files = [self.history(f"run{n}.csv") for n in (1, 2)]
        subject = self.checked(*files, "--tolerances", "1e-4,1e-3")["cases"][0]["subjects"][0]
        self.assertEqual([level["step"] for level in subject["levels"]], [1e-3, 1e-4])
        self.refused("check", *files, "--tolerances", "0.1,2", code="out-of-range", says="--tolerances")

    def test_of_a_history_that_is_not_finite_are_failed_runs(self):
        files = self.converging()
        broken = self.write("h0.02.csv", "t,u1,v1,u2,v2\n0,1,-0.05,-0.333333333333,0.0166666666667\n"
                            "0.02,1,0,0,0\n0.04,nan,0,0,0\n")
        record = self.checked(broken, *files, "--expect", "proper:2")
        first = record["cases"][0]["subjects"][0]["levels"][0]["runs"][0]
        self.assertEqual((first["step"], first["finished"], first["failure_code"]),
                         (0.02, False, "not-finite"))
        self.refused("check", broken, code="not-finite", says="line 4")

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


if __name__ == "__main__":
    unittest.main()
