"""Impacts as arrays."""
import dataclasses
import unittest

import numpy as np

import clackers
from command import rows_of_command


class Impacts(unittest.TestCase):
    def test_values_are_the_bits_that_the_command_prints(self):
        rows = rows_of_command("respond", "synchronized-pair", "--set", "eta=0.5", "--impacts")
        impacts = clackers.case("synchronized-pair", eta=0.5).impacts()
        self.assertEqual(len(impacts), len(rows))
        columns = {"k": impacts.index, "t": impacts.t, "u1": impacts.u[:, 0], "impulse": impacts.impulse,
                   "v1-": impacts.v_before[:, 0], "v2-": impacts.v_before[:, 1], "v1+": impacts.v_after[:, 0],
                   "v2+": impacts.v_after[:, 1], "energy_before": impacts.energy_before, "energy_after": impacts.energy_after}
        for name, values in columns.items():
            np.testing.assert_array_equal(values + 0, rows[name], name)

    def test_shapes_and_types(self):
        impacts = clackers.case("three-parameter").impacts()
        for field in dataclasses.fields(impacts):
            array = getattr(impacts, field.name)
            vector = field.name in {"u", "v_before", "v_after", "a_before", "a_after"}
            self.assertEqual(array.shape, (6, 2) if vector else (6,), field.name)
            self.assertEqual(array.dtype, np.int64 if field.name in {"index", "contact"} else np.float64, field.name)

    def test_accelerations_are_those_of_the_equation_of_motion(self):
        case = clackers.case("synchronized-pair", eta=0.5)
        impacts = case.impacts()
        for v, a in ((impacts.v_before, impacts.a_before), (impacts.v_after, impacts.a_after)):
            for k in range(len(impacts)):
                rate = case.problem.rhs(impacts.t[k], np.concatenate([impacts.u[k], v[k]]))
                np.testing.assert_allclose(a[k], rate[2:], rtol=0, atol=1e-14 * np.abs(a).max())

    def test_newtons_law_takes_the_state_before_to_the_state_after(self):
        case = clackers.case("synchronized-pair", eta=0.5)
        impacts = case.impacts()
        for k in range(len(impacts)):
            after = case.problem.impact(np.concatenate([impacts.u[k], impacts.v_before[k]]))
            np.testing.assert_allclose(after[2:], impacts.v_after[k], rtol=0, atol=1e-14)

    def test_enclosures_hold_the_time(self):
        impacts = clackers.case("three-parameter").impacts()
        self.assertTrue(((impacts.t_lo <= impacts.t) & (impacts.t <= impacts.t_hi)).all())
        self.assertTrue((impacts.t_hi - impacts.t_lo <= 2 * np.spacing(impacts.t)).all())

    def test_a_range_is_a_part_of_all(self):
        case = clackers.case("three-parameter")
        every = case.impacts()
        some = case.impacts(first=2, last=4)
        np.testing.assert_array_equal(some.index, [2, 3, 4])
        np.testing.assert_array_equal(some.t, every.t[1:4])
        np.testing.assert_array_equal(case.impacts(first=5).index, [5, 6])
        self.assertEqual(len(case.impacts(first=7)), 0)
        self.assertEqual(len(case.impacts(first=3, last=2)), 0)

    def test_no_impact_is_an_empty_array(self):
        self.assertEqual(clackers.case("sdof").impacts().v_before.shape, (0, 1))

    def test_a_few_of_hundreds_of_millions_are_asked_for_by_number(self):
        case = clackers.case("three-parameter", a_t=5e7)
        total = case.impact_count()
        self.assertGreater(total, 300_000_000)
        last = case.impacts(first=total - 9)
        self.assertEqual(len(last), 10)
        self.assertLessEqual(last.t[-1], case.end)

    def test_count_is_that_of_the_times(self):
        case = clackers.case("three-parameter")
        impacts = case.impacts()
        self.assertEqual(case.impact_count(), 6)
        self.assertEqual([case.impact_count(t) for t in impacts.t_hi], [1, 2, 3, 4, 5, 6])
        self.assertEqual([case.impact_count(t) for t in np.nextafter(impacts.t_lo, 0)], [0, 1, 2, 3, 4, 5])
        self.assertEqual(case.impact_count(0), 0)


if __name__ == "__main__":
    unittest.main()
