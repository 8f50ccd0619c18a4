"""clackers.check on arrays and files."""
import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

import clackers
from solvers import event_driven, leapfrog, scipy_flights

CASE = clackers.case("three-parameter", N=2)
PROBLEM = CASE.problem


def exact(rows=2001):
    t = np.linspace(0, CASE.end, rows)
    return (t, *CASE.response(t))


class Arrays(unittest.TestCase):
    def test_the_exact_motion_is_within_any_tolerance(self):
        t, u, v, a = exact()
        record = clackers.check(t, u, v, a, case=CASE, tolerance=1e-12)
        self.assertEqual(record.verdict, "agrees")
        self.assertEqual(record.subject.kind, "histories")
        self.assertLess(record.table()["u_error"][0], 1e-14)

    def test_a_motion_that_is_off_is_not(self):
        t, u, v, _ = exact()
        record = clackers.check(t, u * (1 + 1e-4 * t[:, None]), v, case=CASE, tolerance=1e-4)
        self.assertEqual(record.verdict, "disagrees")
        self.assertEqual(record.exit_code, 1)

    def test_a_wrong_restitution_is_found_with_its_value(self):
        t, u, v = event_driven(PROBLEM, 0.01, restitution=0.9)
        record = clackers.check(t, u, v, case=CASE)
        self.assertEqual(record.diagnoses[0].code, "restitution-differs")
        self.assertAlmostEqual(record.diagnoses[0].value, 0.9, delta=1e-6)
        self.assertGreater(record.diagnoses[0].gain, 100)

    def test_a_mapping_from_names_has_a_subject_for_each(self):
        right, wrong = ([event_driven(PROBLEM, h, restitution=eta) for h in (0.02, 0.01)] for eta in (1.0, 0.9))
        record = clackers.check({"right": right, "wrong": wrong[1]}, case=CASE, step=[0.02, 0.01, 0.01])
        subjects = record.subjects
        self.assertEqual([(each.name, each.verdict) for each in subjects],
                         [("right", "not claimed"), ("wrong", "disagrees")])
        self.assertEqual(record.table()["step"].tolist(), [0.02, 0.01, 0.01])
        by_step = clackers.check({"a": {0.02: right[0], 0.01: right[1]}, "b": {0.01: wrong[1]}}, case=CASE)
        self.assertEqual(by_step.table()["step"].tolist(), [0.02, 0.01, 0.01])
        with self.assertRaisesRegex(clackers.InputError, "name = right; allowed: a name with one FILE or more"):
            clackers.check({"right": {}, "wrong": wrong}, case=CASE)

    def test_every_form_gives_the_same_error(self):
        t, u, v = event_driven(PROBLEM, 0.05)
        forms = {
            "arrays": clackers.check(t, u, v, case=CASE),
            "transposed": clackers.check(t, u.T, v.T, case=CASE),
            "a tuple": clackers.check((t, u, v), case=CASE),
            "a list with one tuple": clackers.check([(t, u, v)], case=CASE),
            "a mapping": clackers.check({"t": t, "u": u, "v": v}, case=CASE),
            "lists": clackers.check(t.tolist(), u.tolist(), v.tolist(), case=CASE),
            "not contiguous": clackers.check(t, np.repeat(u, 3, axis=0)[::3], v, case=CASE),
            "case by name": clackers.check(t, u, v, case="three-parameter", N=2),
        }
        expected = forms["arrays"].table()
        for form, record in forms.items():
            with self.subTest(form):
                for column in ("u_error", "v_error", "impacts_matched"):
                    np.testing.assert_array_equal(record.table()[column], expected[column])

    def test_arrays_are_not_written_to(self):
        t, u, v, _ = exact()
        copies = t.copy(), u.copy(), v.copy()
        for array in (t, u, v):
            array.flags.writeable = False
        clackers.check(t, u, v, case=CASE)
        for array, copy in zip((t, u, v), copies):
            np.testing.assert_array_equal(array, copy)

    def test_the_column_of_a_mass_that_is_not_known_is_nan(self):
        t, u, _, _ = exact()
        u[:, 1] = np.nan
        record = clackers.check(t, u, case=CASE, tolerance=1e-12)
        self.assertEqual(record.verdict, "agrees")

    def test_velocities_are_not_needed(self):
        t, u, _, _ = exact()
        self.assertTrue(np.isnan(clackers.check(t, u, case=CASE).table()["v_error"][0]))

    def test_flights_of_solve_ivp(self):
        record = clackers.check([scipy_flights(PROBLEM, 1e-9)], case=CASE, tolerance=1e-6)
        self.assertEqual(record.verdict, "agrees")
        self.assertEqual(record.table()["impacts_matched"][0], 6)

    def test_impacts_as_times_and_as_arrays(self):
        t, u, v, _ = exact()
        for impacts in (CASE.impacts().t, CASE.impacts(), {"t": CASE.impacts().t}):
            record = clackers.check(t, u, v, case=CASE, impacts=impacts)
            self.assertEqual(record.table()["impacts_matched"][0], 6)
            self.assertLess(record.table()["impact_time_error"][0], 1e-14)

    def test_impacts_have_a_former_name(self):
        t, u, v, _ = exact()
        times = CASE.impacts().t
        for record in (clackers.check(t, u, v, case=CASE, collisions=times),
                       clackers.check({"t": t, "u": u, "v": v, "collisions": times}, case=CASE)):
            self.assertLess(record.table()["collision_time_error"][0], 1e-14)
            self.assertEqual(record.table()["collisions_matched"][0], 6)
        self.assertEqual(CASE.collisions()["t"].tolist(), CASE.impact_table()["t"].tolist())

    def test_several_are_levels_of_one_method(self):
        steps = [0.02 * 2 ** (-k / 4) for k in range(20)]
        histories = {h: leapfrog(PROBLEM, h) for h in steps}
        record = clackers.check(histories, case=CASE)
        self.assertAlmostEqual(record.order, 1.0, delta=0.4)
        np.testing.assert_allclose(record.table()["step"], steps)
        same = clackers.check(list(histories.values()), step=steps, case=CASE)
        self.assertEqual(same.order, record.order)

    def test_the_name_and_the_line_that_reproduces_it(self):
        t, u, v, _ = exact()
        record = clackers.check(t, u, v, case=CASE, tolerance=1e-9, name="mine")
        self.assertEqual(record.table()["file"][0], "mine")
        self.assertEqual(
            record.provenance["command"],
            "clackers.check(t, u, v, case=clackers.case('three-parameter', N=2.0, xi1=0.05, a_t=1.0), "
            "tolerance=1e-09, name='mine')")
        again = eval(record.provenance["command"])
        np.testing.assert_array_equal(again.table()["u_error"], record.table()["u_error"])


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def written(self, name, h=0.02):
        t, u, v = leapfrog(PROBLEM, h)
        path = self.folder / name
        np.savetxt(path, np.column_stack([t, u, v]), delimiter=",", header="t,u1,u2,v1,v2", comments="")
        return path

    def test_a_path_is_what_the_command_checks(self):
        path = self.written("h0.02.csv")
        record = clackers.check(path, case=CASE)
        self.assertEqual(record.table()["step"][0], 0.02)
        command = os.environ.get("CLACKERS")
        if command:
            text = subprocess.run([command, "check", str(path), "--set", "N=2", "--format", "json"],
                                  capture_output=True, text=True).stdout
            self.assertEqual(json.loads(text)["cases"], json.loads(record.to_json())["cases"])

    def test_a_list_of_paths(self):
        paths = [self.written(f"h{h}.csv", h) for h in (0.04, 0.02, 0.01)]
        self.assertEqual(clackers.check(paths, case=CASE).table()["step"].tolist(), [0.04, 0.02, 0.01])
        self.assertEqual(clackers.check([str(path) for path in paths], case=CASE).table()["rows"].tolist(),
                         [501, 1001, 2001])

    def test_events_of_a_file(self):
        events = self.folder / "hits.csv"
        np.savetxt(events, CASE.impacts().t, header="t", comments="")
        record = clackers.check(self.written("run.csv"), impacts=events, case=CASE)
        self.assertEqual(record.table()["impacts_matched"][0], 6)
        record = clackers.check(self.written("run.csv"), impacts=CASE.impacts().t, case=CASE)
        self.assertEqual(record.table()["impacts_matched"][0], 6)

    def test_a_missing_file(self):
        with self.assertRaises(clackers.FileError):
            clackers.check(self.folder / "none.csv")
        with self.assertRaises(OSError):
            clackers.check(self.folder / "none.csv")


def changed(position, value):
    """The arrays of the exact motion with an entry replaced."""
    arrays = list(exact(201)[:3])
    arrays[position] = value(arrays[position])
    return arrays


class Refusals(unittest.TestCase):
    """A table: arguments, the code, and words of the message."""

    BAD = {
        "times alone": (lambda: dict(t=exact()[0]), "out-of-range", "(t, u)"),
        "a number": (lambda: dict(t=3), "out-of-range", "int"),
        "None": (lambda: dict(t=None), "out-of-range", "None"),
        "velocities without displacements": (lambda: dict(t=exact()[0], v=exact()[2]), "no-column", "u = None"),
        "masses": (lambda: dict(zip("tu", changed(1, lambda u: u[:, :1]))), "wrong-size", "(201, 2)"),
        "three dimensions": (lambda: dict(zip("tu", changed(1, lambda u: u[None]))), "wrong-size", "(1, 201, 2)"),
        "0-d": (lambda: dict(zip("tu", changed(1, lambda u: np.array(2.0)))), "wrong-size", "()"),
        "length": (lambda: dict(zip("tu", changed(0, lambda t: t[:-1]))), "wrong-size", "200 times"),
        "complex": (lambda: dict(zip("tu", changed(1, lambda u: u * 1j))), "not-a-number", "complex128"),
        "object": (lambda: dict(zip("tu", changed(1, lambda u: u.astype(object)))), "not-a-number", "object"),
        "text": (lambda: dict(zip("tu", changed(1, lambda u: u.astype(str)))), "not-a-number", "real numbers"),
        "boolean": (lambda: dict(zip("tu", changed(1, lambda u: u > 0))), "not-a-number", "bool"),
        "masked": (lambda: dict(zip("tu", changed(1, np.ma.array))), "not-a-number", "masked"),
        "velocities": (lambda: dict(zip("tuv", changed(2, lambda v: v[:, 0]))), "wrong-size", "v = "),
        "NaN in a time": (lambda: dict(zip("tu", changed(0, lambda t: np.where(t == 10, np.nan, t)))), "not-finite", "t"),
        "infinity in u": (lambda: dict(zip("tu", changed(1, lambda u: np.where(u == u[0], np.inf, u)))), "not-finite", "u1"),
        "nothing but NaN": (lambda: dict(zip("tu", changed(1, lambda u: u * np.nan))), "no-column", "u"),
        "backwards": (lambda: dict(zip("tu", changed(0, lambda t: t[::-1]))), "not-sorted", "row"),
        "one row": (lambda: dict(t=[0.0], u=[[1.0, 2.0]]), "too-short", "two"),
        "no rows": (lambda: dict(t=[], u=np.empty((0, 2))), "too-short", ""),
        "another motion": (lambda: dict(zip("tu", changed(1, lambda u: u + 5))), "not-this-case", "start"),
        "several cases": (lambda: dict(t=exact()[0], u=exact()[1], case=["stop", "row"]), "wrong-size", "case"),
        "steps of others": (lambda: dict(t=exact()[0], u=exact()[1], step=[0.1, 0.2]), "wrong-size", "1 here"),
        "a step of 0": (lambda: dict(t=exact()[0], u=exact()[1], step=0.0), "step-not-positive", "0"),
        "a tolerance of 0": (lambda: dict(t=exact()[0], u=exact()[1], tolerance=0.0), "out-of-range", "0"),
        "two of one step": (lambda: dict(t=[exact()[:2], exact()[:2]]), "out-of-range", "different steps"),
        "a name beside a step": (lambda: dict(t={"a": exact()[:2], 0.1: exact()[:2]}), "not-a-number", "key"),
        "keys beside steps": (lambda: dict(t={0.1: exact()[:2]}, step=0.1), "bad-syntax", "step"),
        "impacts that are text": (lambda: dict(t=exact()[0], u=exact()[1], impacts=["a"]), "not-a-number", "impacts"),
        "impacts backwards": (lambda: dict(t=exact()[0], u=exact()[1], impacts=[2.0, 1.0]), "not-sorted", ""),
        "an unknown parameter": (lambda: dict(t=exact()[0], u=exact()[1], case="stop", z=1), "unknown-name", "z"),
    }

    def test_each_is_refused(self):
        for what, (arguments, code, words) in self.BAD.items():
            with self.subTest(what):
                with self.assertRaises(clackers.InputError) as caught:
                    clackers.check(**arguments())
                self.assertEqual(caught.exception.code, code, str(caught.exception))
                self.assertIn(words, str(caught.exception))


if __name__ == "__main__":
    unittest.main()
