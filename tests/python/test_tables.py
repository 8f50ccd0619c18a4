"""Tables: quantities over time and frequency, the catalogue, and how tables show themselves."""
import collections.abc
import os
import subprocess
import sys
import unittest
from unittest import mock

import numpy as np

import clackers
from command import rows_of_command


class Quantities(unittest.TestCase):
    def check(self, table, *arguments):
        rows = rows_of_command(*arguments)
        self.assertEqual([column.name for column in table.columns], list(rows.columns))
        self.assertEqual(len(table.rows), len(rows))
        for name in rows.columns:
            if name == "side":
                self.assertEqual([{-1: "-", 0: "", 1: "+"}[side] for side in table["side"]], list(rows["side"]))
            else:
                np.testing.assert_array_equal(table[name] + 0.0, rows[name], name)

    def test_energies_are_those_of_the_command(self):
        case = clackers.case("synchronized-pair", eta=0.5)
        t = np.linspace(0.0, case.end, 301)
        self.check(case.energies(t), "respond", "synchronized-pair", "--set", "eta=0.5", "--samples", "301", "--energy")

    def test_points_are_those_of_the_command(self):
        t = np.linspace(0.0, 6.0, 25)
        self.check(clackers.case("two-bars").points(t, [-0.5, 0.0, 2.0]), "respond", "two-bars", "--samples", "25", "--at=-0.5,0,2")

        changes = clackers.case("bouncing-bar").points(None, 0.0)
        self.check(changes, "respond", "bouncing-bar", "--impacts", "--at", "0")

    def test_forces_are_those_of_the_command(self):
        case = clackers.case("belt")
        self.check(case.forces(np.linspace(0.0, case.end, 41)), "respond", "belt", "--samples", "41", "--forces")
        self.assertTrue(clackers.case("ball").accumulates)
        self.assertFalse(case.accumulates)

    def test_digits_are_those_of_the_command(self):
        case = clackers.case("synchronized-pair", eta=0.5)
        text = subprocess.run([os.environ["CLACKERS"], "respond", "synchronized-pair", "--set", "eta=0.5", "--digits", "40", "--impacts", "--format", "csv"],
                              check=True, capture_output=True, text=True).stdout
        impacts = case.digits(40)
        self.assertEqual([",".join(map(str, row)) for row in impacts.rows], text.splitlines()[1:])
        self.assertEqual(impacts["k"].dtype, np.int64)
        t = case.impacts().t[0]
        state = case.digits(40, [0.0, t])
        np.testing.assert_array_equal(state["side"], [0, -1, 1])
        v = case.response([t], side="left").v
        np.testing.assert_array_equal([float(state["v1"][1]), float(state["v2"][1])], v[0])
        with self.assertRaisesRegex(clackers.InputError, "1 <= digits <= 1000"):
            case.digits(1001)

    def test_sensitivity_is_that_of_the_command(self):
        case = clackers.case("three-parameter")
        t = np.linspace(0.0, case.end, 101)
        for name in ("xi1", "k2"):
            self.check(case.sensitivity(name, t), "respond", "three-parameter", "--samples", "101", "--sensitivity", name)

    def test_spectrum_is_that_of_the_command(self):
        self.check(clackers.case("stop").spectrum(201, 20.0), "respond", "stop", "--spectrum", "--samples", "201", "--highest", "20")

    def test_impacts_are_those_of_the_command(self):
        table = clackers.case("synchronized-pair", eta=0.5).impact_table()
        self.check(table, "respond", "synchronized-pair", "--set", "eta=0.5", "--impacts")
        self.assertEqual(table["k"].dtype, np.int64)

    def test_two_rows_stand_at_an_impact(self):
        case = clackers.case("synchronized-pair", eta=0.5)
        t = case.impacts().t[0]
        table = case.energies([t, 0.0])
        np.testing.assert_array_equal(table["t"], [t, t, 0.0])
        np.testing.assert_array_equal(table["side"], [-1, 1, 0])
        self.assertEqual(table["side"].dtype, np.int8)
        self.assertLess(table["kinetic"][1], table["kinetic"][0])

    def test_no_times_make_no_rows(self):
        table = clackers.case("stop").energies([])
        self.assertEqual((table.rows, table["total"].dtype), ([], np.float64))
        self.assertEqual(repr(table), "Energy of stop")

    def test_columns_have_units_and_meanings(self):
        for column in clackers.case("stop").energies([0.0]).columns:
            self.assertTrue(column.meaning)
            self.assertEqual(column.unit, {"t": "s", "side": "", "momentum": "kg m/s"}.get(column.name, "J"))


class Catalogue(unittest.TestCase):
    def test_every_kind_is_the_list_of_the_command(self):
        for kind, table in clackers.catalogue().items():
            rows = rows_of_command("list", kind)
            self.assertEqual([column.name for column in table.columns], list(rows.columns), kind)
            self.assertEqual(len(table.rows), len(rows), kind)
            self.assertEqual(list(map(str, table[table.columns[0].name])), list(map(str, rows.iloc[:, 0])), kind)

    def test_every_case_can_be_made(self):
        for name in clackers.catalogue("cases")["name"]:
            case = clackers.case(name)
            self.assertEqual(case.name, name)
            self.assertTrue(case.summary.endswith("."))
            self.assertTrue(case.equations)
            self.assertIsInstance(case.constants, dict)

    def test_codes_are_those_of_the_command(self):
        self.assertEqual(list(clackers.explain()["code"]), list(rows_of_command("explain")["code"]))
        self.assertEqual(clackers.explain("irregular")["kind"].tolist(), ["behaviour"])

    def test_tables_of_a_case_are_those_of_the_command(self):
        case = clackers.case("synchronized-pair", threshold=0.25, eta=0.5)
        tables = case.tables()
        self.assertEqual(list(tables), ["parameters", "constants", "indicators", "impacts", "harmonics", "conditioning"])
        self.assertEqual(dict(zip(tables["parameters"]["parameter"], tables["parameters"]["value"])), case.parameters)
        self.assertEqual(dict(zip(tables["constants"]["name"], tables["constants"]["value"])), case.constants)
        self.assertEqual(dict(zip(tables["indicators"]["name"], tables["indicators"]["value"])), case.indicators)
        self.assertEqual(case.indicators["threshold"], 0.25)
        self.assertEqual(case._repr_html_().count("<table>"), 6)

    def test_admissibility_is_that_of_the_constants(self):
        case = clackers.case("synchronized-pair", X=9, r=3)
        self.assertEqual(clackers.admissibility(9, 3), (case.constants["r*"], case.constants["margin"]))

    def test_a_number_that_is_not_there_is_nan_and_a_text_none(self):
        pairs = clackers.catalogue("pairs")
        self.assertEqual(pairs["order"].dtype, np.float64)
        self.assertTrue(np.isnan(pairs["order"]).any())
        self.assertIn(None, clackers.catalogue("diagnoses")["unit"].tolist())


class Show(unittest.TestCase):
    def setUp(self):
        self.case = clackers.case("three-parameter")

    def test_table_prints_as_the_command_does(self):
        table = self.case.energies([0.0, self.case.impacts().t[0]])
        lines = repr(table).splitlines()
        self.assertEqual(lines[0], "Energy of three-parameter")
        self.assertIn("[kg m/s]", lines[2])
        self.assertEqual(len(lines), 4 + 3)
        self.assertRegex(lines[5], r"^1\.57276  -  ")
        self.assertRegex(lines[6], r"^1\.57276  \+  ")
        self.assertLessEqual(max(map(len, lines)), 80)

    def test_long_table_prints_its_beginning(self):
        table = self.case.energies(np.linspace(0.0, 1.0, 1000))
        self.assertEqual(repr(table).splitlines()[-1], "... and 940 more rows")
        self.assertLess(len(repr(table).splitlines()), 70)
        self.assertIn("<p>... and 940 more rows</p>", table._repr_html_())

    def test_html_is_escaped_and_has_a_row_a_row(self):
        table = clackers.Table("s/1", "a < b", [("x<y", "m", 'a "quoted" meaning'), ("text", "", "")],
                               [np.array([1.0, np.nan]), np.array(["<b>", None], dtype=object)])
        page = table._repr_html_()
        self.assertIn("a &lt; b", page)
        self.assertIn("x&lt;y<br>[m]", page)
        self.assertIn("a &quot;quoted&quot; meaning", page)
        self.assertIn("<td>1</td><td>&lt;b&gt;</td>", page)
        self.assertEqual(page.count("<tr>"), 3)
        self.assertEqual(page.count("<td></td>"), 1)

    def test_rows_and_columns_are_reached_by_key(self):
        table = self.case.energies([0.0, 1.0])
        self.assertEqual(table.rows[1][0], 1.0)
        self.assertEqual([type(cell) for cell in table.rows[0][:2]], [float, int])
        with self.assertRaises(clackers.InputError) as raised:
            table["kinetik"]
        self.assertIn('Did you mean "kinetic"?', str(raised.exception))
        self.assertIsInstance(raised.exception, KeyError)
        self.assertEqual(len(table.head(1).rows), 1)

    def test_a_table_is_a_mapping_from_columns(self):
        table = self.case.energies([0.0, 1.0])
        names = [column.name for column in table.columns]
        self.assertIsInstance(table, collections.abc.Mapping)
        self.assertEqual((list(table), list(table.keys()), len(table)), (names, names, len(names)))
        self.assertIs(dict(table)["kinetic"], table["kinetic"])
        self.assertEqual(("kinetic" in table, "kinetik" in table, 3 in table, table.get("kinetik")), (True, False, False, None))
        for key in (0, None, "\udcff"):
            with self.assertRaises(clackers.InputError) as raised:
                table[key]
            self.assertEqual(raised.exception.code, "not-text")

    def test_table_becomes_a_data_frame(self):
        table = self.case.energies([0.0, 1.0])
        frame = table.to_pandas()
        self.assertEqual(list(frame.columns), list(table))
        np.testing.assert_array_equal(frame["kinetic"], table["kinetic"])
        self.assertEqual((frame.attrs["units"]["kinetic"], frame.attrs["schema"]), ("J", "clackers/energy/1"))

    def test_a_record_becomes_a_data_frame_of_its_runs(self):
        record = clackers.verify("rk4", case="stop", levels=2, samples_per_level=1)
        self.assertEqual(record.to_pandas()["u_error"].tolist(), record.table()["u_error"].tolist())

    def test_table_becomes_a_dataset(self):
        table = self.case.energies([0.0, 1.0])
        data = table.to_xarray()
        self.assertEqual([*data.coords, *data.data_vars], list(table))
        np.testing.assert_array_equal(data["kinetic"].values, table["kinetic"])
        self.assertEqual(data["kinetic"].dims, ("row",))
        self.assertEqual((data["kinetic"].attrs["units"], data.attrs["schema"]), ("J", "clackers/energy/1"))
        for each in (*clackers.catalogue().values(), clackers.catalogue("cases").head(0)):
            self.assertEqual(set(each.to_xarray().variables), set(each))

    def test_without_a_package_an_error_says_what_to_install(self):
        table = self.case.energies([0.0])
        for name, convert in (("pandas", table.to_pandas), ("xarray", table.to_xarray)):
            with mock.patch.dict(sys.modules, {name: None}), self.assertRaises(ImportError) as raised:
                convert()
            self.assertIn(f"python3-{name}", str(raised.exception))


if __name__ == "__main__":
    unittest.main()
