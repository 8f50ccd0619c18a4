"""clackers.compare: two sets of histories where no exact motion is known."""
import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

import clackers

CASE = clackers.case("three-parameter")
T = np.linspace(0.0, CASE.end, 501)
U, V, _ = CASE.response(T)
STEPS = [0.16, 0.08, 0.04, 0.02, 0.01]


def off(h, order=2):
    return T, U * (1 + h**order), V


class Compared(unittest.TestCase):
    def test_the_largest_difference_of_each_mass_and_its_time(self):
        later = U.copy()
        later[T > 7.0, 1] += 0.01
        found = clackers.compare((T, U), (T, later))
        table = found.differences
        self.assertEqual(table["mass"].tolist(), [1, 2])
        np.testing.assert_allclose(table["difference"], [0.0, 0.01], atol=1e-15)
        self.assertAlmostEqual(table["since"][1], 7.04, places=9)
        self.assertTrue(np.isnan(table["since"][0]))
        self.assertIn("Agreement is no proof", str(found))

    def test_the_order_of_each_set_by_itself(self):
        sets = clackers.compare({h: off(h) for h in STEPS}, {h: off(h, 1) for h in STEPS[::-1]}).sets
        np.testing.assert_allclose(sets["order"], [2.0, 1.0], atol=1e-6)
        self.assertEqual(sets["finest"].tolist(), [0.01, 0.01])
        by_list = clackers.compare([off(h) for h in STEPS], off(0.1), step=[*STEPS, 0.1]).sets
        self.assertEqual((by_list["order"][0], by_list["histories"].tolist()), (sets["order"][0], [5, 1]))
        by_tolerance = clackers.compare([off(h) for h in STEPS], off(0.1), tolerances=[*STEPS, 0.1]).sets
        self.assertEqual(by_tolerance.rows[0], by_list.rows[0])

    def test_the_tolerance_decides(self):
        self.assertTrue(clackers.compare((T, U), (T, U)).is_within)
        self.assertEqual([clackers.compare(off(0.0), off(0.1), tolerance=limit).is_within for limit in (0.011, 0.009)], [True, False])

    def test_every_form_of_a_history_is_taken(self):
        flight = {"t": T, "y": np.hstack([U, V]).T}
        for form in ((T, U, V), (T, U.T), {"t": T, "u": U}, flight, [flight], [(T, U)]):
            found = clackers.compare(form, off(0.1))
            self.assertEqual(found.differences["mass"].tolist(), [1, 2])
            self.assertAlmostEqual(found.differences["relative"][0], 0.01 / 1.01, places=12)
        self.assertEqual(clackers.compare((T, U[:, 0]), (T, U[:, 0])).differences["mass"].tolist(), [1])

    def test_files_are_compared_as_the_command_does(self):
        with tempfile.TemporaryDirectory() as folder:
            paths = [Path(folder, f"h{h}.csv") for h in STEPS]
            for h, path in zip(STEPS, paths):
                np.savetxt(path, np.column_stack(off(h)[:2]), delimiter=",", header="t,u1,u2", comments="")
            found = clackers.compare(paths, paths[0])
            done = subprocess.run([os.environ["CLACKERS"], "check", *paths, "--against", paths[0], "--format", "json"],
                                  capture_output=True, text=True)
        for table, sheet in zip((found.differences, found.sets), json.loads(done.stdout)["sheets"]):
            for name, cells in zip(table, zip(*sheet["rows"])):
                known = [(mine, theirs) for mine, theirs in zip(table[name].tolist(), cells) if theirs is not None]
                self.assertEqual([mine for mine, _ in known], [theirs for _, theirs in known], name)
            self.assertEqual(table.title, sheet["title"])

    def test_result_files_have_nodes_and_directions(self):
        text = "".join(f"\n displacements (vx,vy,vz) for set ALL and time {t:14.7E}\n\n"
                       f"  7 0.0 {u[1]:13.6E} 0.0\n 12 0.0 {u[0]:13.6E} 0.0\n" for t, u in zip(T, U))
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "run.dat")
            path.write_text(text)
            chosen = {"reader": "calculix-dat", "node": [12, 7], "component": 2}
            self.assertLess(clackers.compare(path, (T, U), **chosen).differences["relative"].max(), 1e-6)
            self.assertEqual(clackers.check(path, case=CASE, tolerance=1e-5, **chosen).verdict, "agrees")
            self.assertGreater(clackers.compare(path, (T, U)).differences["relative"].max(), 0.1)
            with self.assertRaisesRegex(clackers.InputError, "component = 4"):
                clackers.compare(path, path, component=4)


class Refused(unittest.TestCase):
    ROWS = {
        "no common times": ("wrong-size", lambda: clackers.compare((T, U), (T[1:] + 0.01, U[1:]))),
        "other masses": ("no-column", lambda: clackers.compare((T, U), (T, U[:, :1]))),
        "steps of some": ("wrong-size", lambda: clackers.compare((T, U), (T, U), step=[0.1])),
        "steps and tolerances": ("bad-syntax", lambda: clackers.compare((T, U), (T, U), step=[1, 2], tolerances=[0.1, 0.2])),
        "a mapping beside a list": ("bad-syntax", lambda: clackers.compare({0.1: (T, U)}, (T, U))),
        "a tolerance of 1": ("out-of-range", lambda: clackers.compare((T, U), (T, U), tolerances=[0.1, 1.0])),
        "a tolerance below 0": ("out-of-range", lambda: clackers.compare((T, U), (T, U), tolerance=-1.0)),
        "a number": ("out-of-range", lambda: clackers.compare(3, (T, U))),
        "nothing": ("out-of-range", lambda: clackers.compare((T, U), None)),
        "an empty list": ("out-of-range", lambda: clackers.compare((T, U), [])),
        "three dimensions": ("wrong-size", lambda: clackers.compare((T, U[None]), (T, U))),
    }

    def test_each_row(self):
        for what, (code, call) in self.ROWS.items():
            with self.subTest(what):
                with self.assertRaises(clackers.InputError) as caught:
                    call()
                self.assertEqual(caught.exception.code, code, str(caught.exception))
                self.assertNotIn("--", str(caught.exception))


if __name__ == "__main__":
    unittest.main()
