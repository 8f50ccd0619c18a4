"""Dry friction and nonlinear springs from the command line."""
import json
import unittest

from command import CommandTest, run


class Friction(CommandTest):
    def test_force_of_a_slider_is_that_of_its_spring_at_rest(self):
        sliding, resting = self.rows_of("respond", "slider", "--step", "1", "--forces")[1:20:18]
        self.assertAlmostEqual(float(sliding["friction1"]), 0.09375, places=15)
        u = float(self.rows_of("respond", "slider", "--step", "1")[19]["u1"])
        self.assertAlmostEqual(float(resting["friction1"]), u, places=15)

    def test_energy_of_a_slider_is_dissipated_by_it(self):
        last = self.rows_of("respond", "slider", "--samples", "2", "--energy")[1]
        self.assertAlmostEqual(float(last["dissipated"]), 0.5 * (1.0 - 0.0625**2), places=13)
        self.assertAlmostEqual(float(last["total"]), 0.5, places=13)
        self.assertEqual(last["kinetic"], "0")

    def test_panel_agrees_where_it_has_a_law(self):
        for case in ("slider", "belt"):
            done = run("verify", "--case", case, "newmark", "rk4", "moreau-jean", "newmark+reversal",
                       "--format", "json")
            subjects = json.loads(done.stdout)["cases"][0]["subjects"]
            self.assertEqual([s["assessment"]["verdict"] for s in subjects[:3]], ["agrees"] * 3, done.stdout)
            self.assertEqual(subjects[3]["refusal_code"], "linear-only")

    def test_friction_of_a_contact_is_a_row_of_the_problem(self):
        row = {"direction": [1, 0, 1], "coefficient": 0.1, "velocity": 0, "contact": 1}
        problem = json.loads(run("show", "oblique-disk", "--format", "json").stdout)["problem"]
        self.assertEqual(problem["frictions"], [row])
        copy = self.path("copy.txt")
        run("verify", "--case", "oblique-disk", "--exec", f"cp {{case:text}} {copy}; false {{h}} {{out}}")
        with open(copy) as file:
            self.assertIn("rubbing1=1 0 1 0.1 0 1\n", file.read())
        done = run("verify", "--case", "oblique-disk", "rk4", "moreau-jean", "paoli-schatzman", "--format", "json")
        subjects = json.loads(done.stdout)["cases"][0]["subjects"]
        self.assertEqual([s["assessment"]["verdict"] for s in subjects[:2]], ["agrees"] * 2, done.stdout)
        self.assertEqual(subjects[2]["refusal_code"], "linear-only")
        self.refused("export", "oblique-disk", "--to", "scipy", "--out", self.path("deck"), code="no-deck",
                     says=("friction",))

    def test_force_of_a_disk_is_that_of_the_floor_and_its_friction(self):
        rows = self.rows_of("respond", "oblique-disk", "--set", "g=2,eta=0.5,mu=1/4,vx0=9,w0=0", "--step", "0.5",
                            "--forces")
        forces = {row["t"]: [row["force1"], row["friction1"]] for row in rows}
        self.assertEqual(forces["2.5"], ["0", "0"])
        self.assertEqual(forces["4.5"], ["2", "-0.5"])
        energy = self.rows_of("respond", "oblique-disk", "--set", "g=2,eta=0.5,mu=1/4,vx0=9,w0=0", "--step", "5",
                              "--energy")
        first, last = energy[0], energy[-1]
        self.assertAlmostEqual(float(last["total"]), float(first["total"]), places=13)
        self.assertGreater(float(last["dissipated"]), 0.0)

    def test_impacts_on_a_round_wall_are_not_counted(self):
        history, events = self.path("history.csv"), self.path("events.csv")
        with open(history, "w") as file:
            file.write(run("respond", "circle-billiard", "--step", "0.05", "--format", "csv").stdout)
        with open(events, "w") as file:
            file.write("t\n0.5\n")
        for more in ((), ("--events", events)):
            done = run("check", "--case", "circle-billiard", history, "--metrics", "all", *more)
            self.assertIn("No row of the problem states where the impacts are", done.stdout)
            self.assertNotIn("impact-missed-count  ", done.stdout)
            self.assertNotIn("impact-extra-count  ", done.stdout)
            self.assertNotIn("impact-late-count  ", done.stdout)
        header = run("respond", "circle-billiard", "--impacts", "--format", "csv").stdout.splitlines()[0]
        self.assertIn("u2,", header)

    def test_problem_of_a_case_is_read_again_and_refused_with_the_reason(self):
        path = self.path("belt.json")
        with open(path, "w") as file:
            file.write(run("show", "belt", "--format", "json").stdout)
        self.refused("show", "--problem", path, code="linear-only", says=("dry friction",))
        self.refused("export", "belt", "--to", "scipy", "--out", self.path("deck"), code="no-deck", says=("friction",))

    def test_implicit_methods_take_the_tangent_of_a_pendulum(self):
        done = run("verify", "--case", "pendulum", "newmark", "rk4", "energy-momentum", "--format", "json")
        subjects = json.loads(done.stdout)["cases"][0]["subjects"]
        self.assertEqual([s["assessment"]["verdict"] for s in subjects], ["agrees"] * 3, done.stdout)


if __name__ == "__main__":
    unittest.main()
