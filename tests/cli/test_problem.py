"""--problem: the problems of files, and cases whose problems have loads and springs."""
import csv
import io
import json
import math
import os
import tempfile
import unittest

from command import CommandTest

PAIR = """M = [[1, 0], [0, 2]]
K = [[4, 0], [0, 2]]
end = 10
[start]
u = [0.5, 0]
[[contacts]]
direction = [1, -1]
gap = -0.1
restitution = 0.5
"""


class Problem(CommandTest):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = os.path.join(folder.name, "pair.toml")
        self.write(PAIR)

    def write(self, text):
        with open(self.file, "w", encoding="utf-8") as file:
            file.write(text)

    def test_stands_for_a_case_in_every_command(self):
        problem = self.json_of("show", "--problem", self.file)["problem"]
        self.assertEqual(problem["M"], [[1, 0], [0, 2]])
        self.assertEqual(problem["contacts"],
                         [{"direction": [1, -1], "gap": -0.1, "restitution": 0.5}])
        self.assertEqual(problem["end"], 10)
        text = self.good("respond", "--problem", self.file, "--samples", "201", "--format", "csv")
        first = next(csv.DictReader(io.StringIO(text)))
        self.assertEqual((float(first["u1"]), float(first["u2"])), (0.5, 0.0))
        history = self.file + ".csv"
        with open(history, "w", encoding="utf-8") as file:
            file.write(text)
        record = self.json_of("verify", "rk4", "--problem", self.file, "--levels", "5")
        self.assertIn("piecewise", str(record))
        self.assertIn("proper", str(record))

    def test_goes_through_impacts_that_accumulate_to_a_contact_that_rests(self):
        self.write("""M = [[2]]
K = [[2]]
end = 20
[start]
u = [1]
[[contacts]]
direction = [1]
gap = 0.5
restitution = 0.5
""")
        shown = self.good("show", "--problem", self.file)
        self.assertIn("Impacts: infinitely many", shown)
        self.assertIn("Contacts that stay closed: 1", shown)
        text = self.good("respond", "--problem", self.file, "--samples", "3", "--forces", "--format", "csv")
        self.assertEqual([float(row["force1"]) for row in csv.DictReader(io.StringIO(text))], [0.0, 1.0, 1.0])
        with open(self.file, encoding="utf-8") as file:
            self.write(file.read().replace("restitution = 0.5", "restitution = 0"))
        history = self.file + ".csv"
        with open(history, "w", encoding="utf-8") as file:
            file.write(self.good("respond", "--problem", self.file, "--samples", "201", "--format", "csv"))
        self.good("check", history, "--problem", self.file)
        self.assertIn("exact, as claimed",
                      self.good("verify", "piecewise-exact", "--problem", self.file, "--levels", "5"))

    def test_a_bad_file_is_refused_with_its_line(self):
        for old, new, code, says in (
                ("end = 10", "ned = 10", "unknown-name", ':3: unknown key "ned". Did you mean "end"?'),
                ("[[4, 0], [0, 2]]", "[[4, 1], [0, 2]]", "not-symmetric", ":2: K(1,2) = 1"),
                ("u = [0.5, 0]", "u = [0.5]", "wrong-size", ":5: u has 1 numbers"),
                ("M = [[1, 0], [0, 2]]", "M = [[1, 0], [0, -2]]", "not-positive-definite", "mass matrix"),
                ("direction = [1, -1]", "direction = [1, -1", "bad-syntax", "pair.toml:")):
            self.write(PAIR.replace(old, new))
            self.refused("show", "--problem", self.file, code=code, says=says)

    def test_may_be_what_show_writes(self):
        shown = self.json_of("show", "--problem", self.file)["problem"]
        self.write(self.good("show", "--problem", self.file, "--format", "json"))
        self.assertEqual(self.json_of("show", "--problem", self.file)["problem"], shown)
        self.write(json.dumps(shown).replace("-0.1", '"-1/10"'))
        self.assertEqual(self.json_of("show", "--problem", self.file)["problem"], shown)
        self.write(self.good("show", "penalized-pair", "--format", "json"))
        self.assertEqual(self.json_of("show", "--problem", self.file)["problem"],
                         self.json_of("show", "penalized-pair")["problem"])

    def test_another_case_beside_it_is_refused(self):
        self.refused("show", "stop", "--problem", self.file, code="bad-syntax", says="leave stop out")
        self.refused("verify", "rk4", "--case", "stop", "--problem", self.file, code="bad-syntax",
                     says="leave stop out")

    def test_loads_and_springs_are_part_of_the_problem(self):
        problem = self.json_of("show", "forced-pair")["problem"]
        t, start = problem["start"]["t"], problem["start"]
        self.assertEqual(len(problem["loads"]), 2)
        load = problem["loads"][0]
        self.assertEqual(load["dof"], 1)
        force = load["amplitude"] * math.cos(load["frequency"] * t + load["phase"])
        row = next(csv.DictReader(io.StringIO(
            self.good("respond", "forced-pair", "--samples", "2", "--format", "csv"))))
        rest = (problem["M"][0][0] * float(row["a1"]) + problem["C"][0][0] * start["v"][0]
                + problem["K"][0][0] * start["u"][0] - force)
        self.assertLess(abs(rest), 1e-14)
        problem = self.json_of("show", "penalized-pair")["problem"]
        self.assertEqual(problem["contacts"], [])
        self.assertEqual(problem["springs"], [{"direction": [1, -1], "gap": 0, "stiffness": 400}])

    def test_forces_of_springs_follow_those_of_contacts(self):
        self.write("""M = [[1, 0], [0, 1]]
K = [[2, -1], [-1, 1]]
end = 20
[start]
u = [0.5, 1]
[[contacts]]
direction = [0, 2]
gap = 0.2
stiffness = 200
[[contacts]]
direction = [1, 0]
restitution = 0.5
[[loads]]
dof = 1
amplitude = -2
frequency = 0
""")
        shown = self.good("show", "--problem", self.file)
        self.assertIn("Contacts with a stiffness, one-sided springs without impacts: 1", shown)
        self.assertRegex(shown, r"force2 +2 u2 +0\.2 +200\n")
        self.assertRegex(shown, r"\nsprings +1 .*\nspring_contacts +[1-9]")
        times = ("--problem", self.file, "--step", "0.05")
        forces = self.rows_of("respond", *times, "--forces")
        self.assertEqual(list(forces[0]), ["t", "side", "force1", "force2", "impulse1", "impulse2"])
        states = self.rows_of("respond", *times)
        pressed = held = 0
        for force, state in zip(forces, states):
            number = {name: float(state[name]) for name in ("u1", "u2", "a1", "a2")}
            push, spring = float(force["force1"]), float(force["force2"])
            self.assertEqual(spring > 0, 2 * number["u2"] < 0.2)
            self.assertAlmostEqual(2 * spring, number["a2"] + number["u2"] - number["u1"], delta=1e-10)
            if push > 0:
                self.assertAlmostEqual(push, 2 + number["a1"] + 2 * number["u1"] - number["u2"], delta=1e-10)
            pressed, held = pressed + (spring > 0), held + (push > 0)
        self.assertGreater(min(pressed, held), 5)

    def test_force_of_a_massless_mesh_is_that_of_its_first_element(self):
        times = ("bar-wall", "--set", "elements=4", "--samples", "81")
        closed = 0
        for force, state in zip(self.rows_of("respond", *times, "--forces"), self.rows_of("respond", *times)):
            expected = 4.0 * max(0.0, -0.25 - float(state["u1"]))
            self.assertAlmostEqual(float(force["force1"]), expected, places=14)
            closed += expected > 0.0
        self.assertGreater(closed, 10)

    def test_forces_of_a_problem_without_any_are_refused(self):
        self.refused("respond", "sdof", "--forces", "--samples", "3", code="no-closed-form", says="sdof has none of them.")
        self.refused("respond", "circle-billiard", "--forces", "--samples", "3", code="no-closed-form",
                     says="but impacts, whose impulses --impacts has")

    def test_tables_say_from_which_number_contacts_count(self):
        self.write("""M = [[1, 0], [0, 1]]
K = [[1, 0], [0, 1]]
end = 20
[start]
u = [1, 2]
[[contacts]]
direction = [1, 0]
restitution = 0.5
[[contacts]]
direction = [0, 1]
gap = 0.25
restitution = 0.5
""")
        shown = " ".join(self.good("show", "--problem", self.file).split())
        self.assertIn("that are resolved (contacts numbered from 0)", shown)
        self.assertIn("Contacts that stay closed: 1 (contacts numbered from 1)", shown)
        hits = self.good("respond", "--problem", self.file, "--impacts")
        self.assertIn("resolved (contacts numbered from 0)", hits.replace("\n", " "))
        self.assertIn("Impacts of row (contacts numbered from 0)\n", self.good("respond", "row", "--impacts"))
        history = self.file + ".csv"
        with open(history, "w", encoding="utf-8") as file:
            file.write(self.good("respond", "row", "--samples", "2001", "--format", "csv"))
        self.assertIn("read from its rows (contacts numbered from 1)\n",
                      self.good("check", history, "--case", "row", "--impacts"))
        for text in (self.good("show", "stop"), self.good("respond", "stop", "--impacts")):
            self.assertNotIn("numbered", text)

    def test_inadmissible_orbits_are_refused_with_what_to_change(self):
        self.refused("show", "base-excited-pair", "--set", "A_g=1", code="not-admissible",
                     says="With A_g = -1 they do not.")
        self.refused("show", "forced-pair", "--set", "n=1.5", code="not-whole", says="n = 1.5")


if __name__ == "__main__":
    unittest.main()
