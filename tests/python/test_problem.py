"""Problems as SciPy's solvers take them."""
import unittest

import numpy as np
from scipy.integrate import solve_ivp

import clackers


class Problem(unittest.TestCase):
    def test_matrices_are_those_of_the_constants(self):
        case = clackers.case("three-parameter")
        constants, problem = case.constants, case.problem
        np.testing.assert_array_equal(problem.M, np.diag([constants["m1"], constants["m2"]]))
        np.testing.assert_array_equal(problem.C, np.diag([constants["c1"], constants["c2"]]))
        np.testing.assert_array_equal(problem.K, np.diag([constants["k1"], constants["k2"]]))
        self.assertEqual((problem.dof, problem.end, problem.start.t), (2, case.end, 0.0))
        u, v, _ = case.response(0.0)
        np.testing.assert_array_equal(problem.start.u, u)
        np.testing.assert_array_equal(problem.start.v, v)
        np.testing.assert_array_equal(problem.y0, [*u, *v])

    def test_contact_keeps_mass_1_above_mass_2(self):
        (contact,) = clackers.case("synchronized-pair", eta=0.5).problem.contacts
        np.testing.assert_array_equal(contact.direction, [1.0, -1.0])
        self.assertEqual((contact.gap, contact.restitution), (0.0, 0.5))
        self.assertEqual(clackers.case("sdof").problem.contacts, ())

    def test_contact_with_a_stiffness_is_a_spring_that_pushes(self):
        case = clackers.case("penalized-pair", stiffness=300.0)
        problem = case.problem
        (spring,) = problem.springs
        np.testing.assert_array_equal(spring.direction, [1.0, -1.0])
        self.assertEqual((spring.gap, spring.stiffness, problem.contacts), (0.0, 300.0, ()))
        self.assertEqual(clackers.case("stop").problem.springs, ())
        t = np.linspace(0.0, case.end, 201)
        u, v, a = case.response(t)
        free = [np.linalg.solve(problem.M, -problem.C @ v[k] - problem.K @ u[k]) for k in range(len(t))]
        push = 300.0 * np.maximum(u[:, 1] - u[:, 0], 0.0)
        self.assertGreater(push.max(), 1.0)
        np.testing.assert_allclose(a, free + np.outer(push, [1.0, -1.0]) @ np.linalg.inv(problem.M), rtol=0, atol=1e-11)
        for k in range(len(t)):
            np.testing.assert_allclose(problem.rhs(t[k], np.concatenate([u[k], v[k]]))[2:], a[k], rtol=0, atol=1e-11)

    def test_arrays_cannot_be_written_to(self):
        problem = clackers.case("three-parameter").problem
        for array in (problem.M, problem.C, problem.K, problem.start.u, problem.start.v, problem.contacts[0].direction,
                      problem.load(0.0)):
            with self.assertRaises(ValueError):
                array[0] = 1.0
        problem.y0[0] = 7.0
        self.assertNotEqual(problem.y0[0], 7.0)

    def test_rate_of_the_exact_motion_is_its_velocity_and_acceleration(self):
        case = clackers.case("three-parameter")
        t = np.linspace(0.0, case.end, 101)
        u, v, a = case.response(t)
        for k in range(len(t)):
            rate = case.problem.rhs(t[k], np.concatenate([u[k], v[k]]))
            np.testing.assert_array_equal(rate[:2], v[k])
            np.testing.assert_allclose(rate[2:], a[k], rtol=0, atol=1e-14 * np.abs(a).max())

    def test_problem_outlives_its_case(self):
        problem = clackers.case("three-parameter").problem
        import gc
        gc.collect()
        np.testing.assert_array_equal(problem.rhs(0.0, [0, 0, 1, 2])[:2], [1.0, 2.0])

    def test_events_of_solve_ivp_find_the_first_impact(self):
        case = clackers.case("three-parameter")
        problem = case.problem
        (event,) = problem.events
        self.assertEqual((event.terminal, event.direction, event.contact), (True, -1.0, 0))
        run = solve_ivp(problem.rhs, (0.0, problem.end), problem.y0, events=problem.events, rtol=1e-11, atol=1e-13)
        self.assertEqual(run.status, 1)
        # The error of a step at this tolerance; the state carries some hundred of them.
        self.assertAlmostEqual(run.t[-1], case.impacts(last=1).t[0], delta=1e-9)

    def test_mesh_is_that_of_programs(self):
        mesh = clackers.case("mass-on-bar", elements=2, mass="lumped").mesh
        self.assertEqual((mesh["mass"], [node["fixed"] for node in mesh["nodes"]]), ("lumped", [False, False, True]))
        self.assertIsNone(clackers.case("stop").mesh)

    def test_simulation_from_impact_to_impact_meets_the_exact_motion(self):
        case = clackers.case("synchronized-pair", X=5, r=2, eta=0.8)
        problem = case.problem
        t, y, hits = problem.start.t, problem.y0, 0
        while t < problem.end:
            run = solve_ivp(problem.rhs, (t, problem.end), y, events=problem.events, rtol=1e-11, atol=1e-13)
            t, y = run.t[-1], run.y[:, -1]
            if run.status == 1:
                hits += 1
                y = problem.impact(y)
        self.assertEqual(hits, case.impact_count())
        u, v, _ = case.response(case.end)
        np.testing.assert_allclose(y, [*u, *v], rtol=0, atol=1e-7)


if __name__ == "__main__":
    unittest.main()
