"""Exact responses as arrays."""
import math
import unittest

import numpy as np

import clackers
from command import rows_of_command

CASES = {"three-parameter": {"N": 3, "xi1": 0.02}, "stop": {"eta": 0.5}, "sdof": {}, "synchronized-pair": {"X": 1 / 5, "r": 2}}


class Response(unittest.TestCase):
    def test_values_are_the_bits_that_the_command_prints(self):
        for name, parameters in CASES.items():
            rows = rows_of_command("respond", name, "--samples", "1001", *settings(parameters))
            rows = rows[rows["side"] != "+"]
            u, v, a = clackers.case(name, **parameters).response(rows["t"].to_numpy(), side="left")
            for symbol, values in (("u", u), ("v", v), ("a", a)):
                for mass in range(values.shape[1]):
                    np.testing.assert_array_equal(values[:, mass] + 0.0, rows[f"{symbol}{mass + 1}"], f"{name} {symbol}")

    def test_free_mass_is_the_textbook_s(self):
        xi = 0.05
        case = clackers.case("sdof", xi1=xi)
        t = np.linspace(0.0, case.end, 777)
        start = case.problem.start
        omega = math.sqrt(1 - xi**2)
        expected = np.exp(-xi * t) * (start.u[0] * np.cos(omega * t) + (start.v[0] + xi * start.u[0]) / omega * np.sin(omega * t))
        # An argument of cos near 20 carries a rounding of 20 x 1.1e-16 in this formula, and there are two.
        np.testing.assert_allclose(case.response(t).u[:, 0], expected, rtol=0, atol=5e-15)

    def test_parameters_may_be_words(self):
        dense = clackers.case("assembly", pairs=2, coupling="dense")
        self.assertEqual((dense.dof, dense.parameters["coupling"]), (4, "dense"))
        self.assertIn("coupling=dense", repr(dense))
        chain = clackers.case("assembly", pairs=2)
        self.assertFalse(np.array_equal(dense.problem.M, chain.problem.M))
        record = clackers.verify("piecewise-exact", case=dense, levels=4, samples_per_level=1)
        self.assertIn("coupling", str(record))
        with self.assertRaisesRegex(clackers.InputError, 'Did you mean "dense"'):
            clackers.case("assembly", coupling="dens")
        with self.assertRaisesRegex(clackers.InputError, "N"):
            clackers.case("three-parameter", N="2")

    def test_shape_is_time_and_mass(self):
        case = clackers.case("three-parameter")
        for values in case.response([0.0, 1.0, 2.0]):
            self.assertEqual((values.shape, values.dtype), ((3, 2), np.float64))
        for values in case.response(1.0):
            self.assertEqual(values.shape, (2,))
        for values in case.response([]):
            self.assertEqual(values.shape, (0, 2))

    def test_sides_are_the_limits_at_an_impact(self):
        case = clackers.case("synchronized-pair", eta=0.25)
        impacts = case.impacts()
        left, right = case.response(impacts.t, side="left"), case.response(impacts.t, side="right")
        # Both are the true limits rounded, so they differ by two units in the last place at most.
        np.testing.assert_allclose(left.v, impacts.v_before, rtol=5e-16, atol=0)
        np.testing.assert_allclose(right.v, impacts.v_after, rtol=5e-16, atol=0)
        self.assertTrue((left.v != right.v).all())
        np.testing.assert_array_equal(case.response(impacts.t).v, right.v)

    def test_many_times_are_those_of_one_call_each(self):
        case = clackers.case("three-parameter")
        t = np.linspace(0.0, case.end, 200_001)  # more than two blocks, the last one not full
        u, v, a = case.response(t)
        for k in (0, 65535, 65536, 131071, 131072, 200_000):
            single = case.response(t[k])
            for values, expected in zip((u, v, a), single):
                np.testing.assert_array_equal(values[k], expected)

    def test_any_array_like_of_real_numbers_is_taken(self):
        case = clackers.case("three-parameter")
        expected = case.response(np.array([0.0, 1.0, 2.0])).u
        read_only = np.array([0.0, 1.0, 2.0])
        read_only.setflags(write=False)
        unaligned = np.frombuffer(b"x" + np.array([0.0, 1.0, 2.0]).tobytes(), offset=1)
        for given in ([0, 1, 2], (0.0, 1.0, 2.0), range(3), np.arange(3), np.arange(3, dtype=np.uint8), np.float32([0, 1, 2]),
                      np.longdouble([0, 1, 2]), np.array([0.0, 1.0, 2.0], dtype=">f8"), np.arange(6.0)[::2] / 2, read_only,
                      np.array([[0.0, 1.0, 2.0]]).T[:, 0], unaligned, memoryview(read_only)):
            np.testing.assert_array_equal(case.response(given).u, expected, repr(given))

    def test_any_order_of_times_is_taken(self):
        case = clackers.case("three-parameter")
        t = np.linspace(0.0, case.end, 101)
        np.testing.assert_array_equal(case.response(t[::-1]).v, case.response(t).v[::-1])

    def test_out_is_written_to_and_returned(self):
        case = clackers.case("three-parameter")
        t = np.linspace(0.0, case.end, 11)
        u, v = np.full((11, 2), np.nan), np.full((11, 2), np.nan)
        result = case.response(t, out=(u, v, None))
        expected = case.response(t)
        for given, place in zip(result, (u, v, None)):
            self.assertIs(given, place)
        np.testing.assert_array_equal(u, expected.u)
        np.testing.assert_array_equal(v, expected.v)
        a = np.full((11, 2), np.nan)
        self.assertIs(case.response(t, out=(u, v, a)).a, a)
        np.testing.assert_array_equal(a, expected.a)

    def test_results_outlive_the_case_and_each_other(self):
        case = clackers.case("three-parameter")
        u, v, _ = case.response(np.linspace(0.0, 1.0, 100_000))
        first = u.copy()
        del case
        v[:] = np.nan
        clackers.case("three-parameter").response(np.linspace(1.0, 2.0, 100_000))
        np.testing.assert_array_equal(u, first)
        self.assertTrue(u.flags.writeable and u.flags.c_contiguous)


class Bounds(unittest.TestCase):
    def test_bound_and_envelope_are_above_what_they_bound(self):
        case = clackers.case("three-parameter")
        t = np.linspace(0.0, case.end, 101)
        response, envelope, bound = case.response(t), case.envelope(t), case.error_bound(t)
        for values, amplitudes, errors in zip(response, envelope, bound):
            self.assertTrue((np.abs(values) <= amplitudes * (1 + 1e-15)).all())
            self.assertTrue(((0 < errors) & (errors < 1e-14 * amplitudes.max())).all())
        self.assertEqual(case.error_bound(1.0).u.shape, (2,))

    def test_envelope_decays_with_the_damping(self):
        case = clackers.case("sdof", xi1=0.05)
        u = case.envelope([0.0, 10.0]).u[:, 0]
        self.assertAlmostEqual(u[1] / u[0], math.exp(-0.5), delta=1e-15)


def settings(parameters):
    return ["--set", ",".join(f"{name}={value!r}" for name, value in parameters.items())] if parameters else []


if __name__ == "__main__":
    unittest.main()
