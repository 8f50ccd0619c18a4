"""clackers.plot: what the figures show, and their files."""
import builtins
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

os.environ["MPLBACKEND"] = "Agg"

import matplotlib.pyplot as pyplot
import numpy as np

import clackers
from solvers import scipy_flights

CASE = clackers.case("three-parameter", N=2, xi1=0.05)
RECORD = clackers.verify("rk4", "newmark+reversal", case=CASE, levels=4, samples_per_level=3)
ENERGIES = ("kinetic", "potential", "dissipated", "lost", "work", "total")


def lines(axes):
    return {line.get_label(): line for line in axes.lines}


def with_errors(change):
    """RECORD with the error of every run changed."""
    text = json.loads(RECORD.to_json())

    def walk(part):
        if isinstance(part, dict):
            for key, value in part.items():
                if key == "u_error" and isinstance(value, (int, float)):
                    part[key] = change(value)
                walk(part[key])
        elif isinstance(part, list):
            for value in part:
                walk(value)

    walk(text)
    return clackers.Record.from_json(json.dumps(text))


def history_of(error):
    """Replaces the errors against time of every record."""
    row = {"method": "rk4", "mass": 1, "step": 0.1, "t": [0.1 * i for i in range(len(error))], "error": error}
    figure = clackers.Figure("history", {"datasets": {"history": [row]}})
    return mock.patch.object(clackers.Record, "figure", lambda *_: figure)


class Plots(unittest.TestCase):
    def setUp(self):
        self.addCleanup(pyplot.close, "all")


class OfACase(Plots):
    def test_response_has_the_exact_displacements_also_at_the_impacts(self):
        axes = clackers.plot.response(CASE)
        shown = lines(axes)
        t = shown["$u_1$"].get_xdata()
        self.assertEqual((t[0], t[-1]), (0.0, CASE.end))
        self.assertTrue(set(CASE.impacts().t) <= set(t))
        for mass, name in enumerate(("$u_1$", "$u_2$")):
            np.testing.assert_array_equal(shown[name].get_ydata(), CASE.response(t).u[:, mass])
        self.assertEqual((axes.get_xlabel(), axes.get_ylabel()), ("time $t$ [s]", "displacement [m]"))

    def test_response_marks_every_impact_among_its_times(self):
        for t, expected in ((None, CASE.impacts().t), ([1.0, 5.0], CASE.impacts().t[:2]),
                            ([8.0, 5.0], CASE.impacts().t[2:3])):
            (marks,) = clackers.plot.response(CASE, t).collections
            self.assertEqual([path[0, 0] for path in marks.get_segments()], list(expected))
        self.assertEqual(len(clackers.plot.response(CASE, [0.0, 1.0]).collections), 0)

    def test_limits_are_those_of_the_lines(self):
        for draw in (clackers.plot.response, clackers.plot.energies):
            for case in (clackers.case("buildings"), clackers.case("stop", t_end=400)):
                axes = draw(case)
                drawn = np.concatenate([line.get_ydata() for line in axes.lines])
                margin = 0.06 * np.ptp(drawn)
                low, high = axes.get_ylim()
                self.assertTrue(drawn.min() - margin < low <= drawn.min(), (low, drawn.min()))
                self.assertTrue(drawn.max() <= high < drawn.max() + margin, (high, drawn.max()))

    def test_many_impacts_are_short_ticks(self):
        def height(case):
            return clackers.plot.response(case).collections[0].get_segments()[0][1, 1]

        self.assertEqual(height(CASE), 1.0)
        many = clackers.case("stop", t_end=400)
        self.assertGreater(many.impact_count(), 60)
        self.assertLess(height(many), 0.1)

    def test_a_case_of_one_mass_without_impacts(self):
        axes = clackers.plot.response(clackers.case("sdof"))
        self.assertEqual(list(lines(axes)), ["$u$"])
        self.assertEqual(len(axes.collections), 0)

    def test_energies_have_both_sides_of_an_impact(self):
        case = clackers.case("stop", eta=0.5)
        axes = clackers.plot.energies(case)
        shown = lines(axes)
        t = shown["lost"].get_xdata()
        hit = case.impacts().t[0]
        before, after = shown["lost"].get_ydata()[t == hit]
        self.assertEqual(before, 0.0)
        self.assertGreater(after, 0.1)
        table = case.energies(np.unique(t))
        for name, line in shown.items():
            if name != "impacts":
                np.testing.assert_array_equal(line.get_ydata(), table[name])
        self.assertEqual((axes.get_xlabel(), axes.get_ylabel()), ("time $t$ [s]", "energy [J]"))

    def test_energies_are_those_that_the_case_has(self):
        for name in clackers.catalogue("cases")["name"]:
            case = clackers.case(name)
            axes = clackers.plot.energies(case, np.linspace(0.0, case.end, 11))
            columns = [column.name for column in case.energies([0.0]).columns]
            self.assertEqual([line.get_label() for line in axes.lines], [each for each in columns if each in ENERGIES])
            pyplot.close("all")

    def test_spectrum_is_the_modulus(self):
        axes = clackers.plot.spectrum(CASE, highest=12.0, n=101)
        table = CASE.spectrum(101, 12.0)
        line = lines(axes)["$u_2$"]
        np.testing.assert_array_equal(line.get_xdata(), table["omega"])
        np.testing.assert_allclose(line.get_ydata(), abs(table["re2"] + 1j * table["im2"]), rtol=1e-14)
        self.assertEqual(axes.get_yscale(), "log")
        self.assertEqual((axes.get_xlabel(), axes.get_ylabel()),
                         (r"frequency $\omega$ [rad/s]", "modulus of the spectrum [m s]"))


class OfARecord(Plots):
    def test_convergence_has_every_run_and_the_largest_of_each_level(self):
        axes = clackers.plot.convergence(RECORD)
        shown = lines(axes)
        table = RECORD.table()
        for method in RECORD:
            own = table["method"] == method
            points = shown[f"_runs of {method}"]
            np.testing.assert_array_equal(points.get_xdata(), table["step"][own])
            np.testing.assert_array_equal(points.get_ydata(), table["u_error"][own])
            self.assertEqual(points.get_linestyle(), "None")
            levels = table["level"][own]
            largest = [table["u_error"][own][levels == level].max() for level in np.unique(levels)]
            np.testing.assert_array_equal(shown[method].get_ydata(), largest)
        self.assertEqual((axes.get_xscale(), axes.get_yscale()), ("log", "log"))
        self.assertEqual((axes.get_xlabel(), axes.get_ylabel()),
                         ("step $h$ [s]", "largest error in $u$ / largest envelope"))

    def test_axes_of_tolerances_say_so(self):
        record = clackers.verify(scipy_flights, tolerances=[1e-5, 1e-6, 1e-7], case=CASE)
        axes = clackers.plot.convergence(record, floor=True)
        shown = lines(axes)
        self.assertEqual(axes.get_xlabel(), "tolerance")
        for name in ("_runs of scipy_flights", "scipy_flights"):
            np.testing.assert_array_equal(shown[name].get_xdata(), [1e-5, 1e-6, 1e-7])
        np.testing.assert_array_equal(shown["rounding"].get_xdata(), [1e-7, 1e-6, 1e-5])
        self.assertEqual(clackers.plot.history(record).get_legend().get_title().get_text(), "tolerance 1e-07")

    def test_axes_of_steps_and_tolerances_say_so(self):
        record = clackers.verify("rk4", scipy_flights, tolerances=[1e-5, 1e-6, 1e-7], case=CASE, levels=4)
        axes = clackers.plot.convergence(record)
        self.assertEqual(axes.get_xlabel(), "step $h$ [s] or tolerance")
        np.testing.assert_array_equal(lines(axes)["_runs of scipy_flights"].get_xdata(), [1e-5, 1e-6, 1e-7])
        self.assertEqual([text.get_text().split(", ")[1] for text in clackers.plot.history(record).get_legend().get_texts()],
                         ["$h$ = 0.00625 s", "tolerance 1e-07"])

    def test_errors_that_do_not_fall_have_an_axis_of_a_decade_with_the_triangles_below(self):
        def wrong(problem, h):
            t = np.arange(0.0, problem.end + h / 2, h)
            return t, *clackers.case("stop", eta=0.89).response(t)

        record = clackers.verify(wrong, case="stop", eta=0.9, steps=[0.1, 0.05, 0.02])
        axes = clackers.plot.convergence(record)
        low, high = axes.get_ylim()
        self.assertAlmostEqual(np.log10(high / low), 1.1, delta=0.02)
        slopes = [line.get_ydata() for line in axes.lines if line.get_label() == "_slope"]
        self.assertGreater(min(map(min, slopes)), low)
        self.assertLess(max(map(max, slopes)), record.table()["u_error"].min() / 1.5)

    def test_runs_without_a_positive_error_are_not_drawn(self):
        smallest = RECORD["rk4"].runs["u_error"].min()
        shown = lines(clackers.plot.convergence(with_errors(lambda value: value if value > smallest else 0.0)))
        runs = RECORD["rk4"].runs
        np.testing.assert_array_equal(shown["_runs of rk4"].get_xdata(), runs["step"][runs["u_error"] > smallest])

    def test_a_history_has_a_gap_where_the_error_is_zero(self):
        with history_of([1e-3, 0.0, float("inf"), 1e-2]):
            line = lines(clackers.plot.history(RECORD))["rk4"]
        np.testing.assert_array_equal(line.get_ydata(), [1e-3, np.nan, np.nan, 1e-2])

    def test_grey_lines_have_the_slopes_beside_them(self):
        axes = clackers.plot.convergence(RECORD)
        slopes = [line for line in axes.lines if line.get_label() == "_slope"]
        self.assertEqual(len(slopes), len(axes.texts))
        for line, text in zip(slopes, axes.texts):
            step, error = (np.log(line.get_data()[axis]) for axis in (0, 1))
            rises = np.diff(error)[np.diff(step) > 0], np.diff(step)[np.diff(step) > 0]
            self.assertAlmostEqual(max(rises[0] / rises[1]), float(text.get_text()), places=9)
            self.assertEqual(text.xy, (max(line.get_xdata()), max(line.get_ydata())))

    def test_the_floor_is_drawn_where_errors_come_near(self):
        self.assertNotIn("rounding", lines(clackers.plot.convergence(RECORD)))
        near = clackers.verify("rk4", case=CASE, levels=9, samples_per_level=2)
        line = lines(clackers.plot.convergence(near))["rounding"]
        table = near.table()
        order = np.argsort(table["step"])
        np.testing.assert_array_equal(line.get_data(), (table["step"][order], table["rounding_floor"][order]))
        self.assertNotIn("rounding", lines(clackers.plot.convergence(near, floor=False)))
        self.assertIn("rounding", lines(clackers.plot.convergence(RECORD, floor=True)))

    def test_history_has_the_numbers_of_the_report(self):
        axes = clackers.plot.history(RECORD, mass=2)
        rows = [row for row in RECORD.figure("history").spec["datasets"]["history"] if row["mass"] == 2]
        for row in rows:
            line = lines(axes)[row["method"]]
            np.testing.assert_array_equal(line.get_xdata(), row["t"])
            np.testing.assert_array_equal(line.get_ydata(), row["error"])
        self.assertEqual(axes.get_legend().get_title().get_text(), f"$h$ = {rows[0]['step']:.3g} s")
        self.assertEqual((axes.get_xlabel(), axes.get_ylabel()),
                         ("time $t$ [s]", "|error in $u_2$| / largest envelope"))

    def test_a_case_is_chosen_by_name(self):
        record = clackers.verify("rk4", case=["stop", "three-parameter"], levels=2, samples_per_level=1)
        table = record.table()
        for case in ("stop", "three-parameter"):
            points = lines(clackers.plot.convergence(record, case))["_runs of rk4"]
            np.testing.assert_array_equal(points.get_ydata(), table["u_error"][table["case"] == case])
        for figure in (clackers.plot.convergence, clackers.plot.history):
            with self.assertRaisesRegex(clackers.InputError, "stop, three-parameter"):
                figure(record, case="sdof")

    def test_lines_differ_without_colour(self):
        looks = [clackers.plot._look(number) for number in range(30)]
        self.assertEqual(len({(str(look.dash), look.marker) for look in looks}), 30)


class Refusals(Plots):
    def test_a_record_with_nothing_to_draw(self):
        def failing(problem, h):
            raise RuntimeError("no run")

        with self.assertRaises(clackers.SolverError) as caught:
            clackers.verify(failing, levels=2, samples_per_level=1)
        failed = caught.exception.record
        for record in (failed, with_errors(lambda value: 0.0)):
            with self.assertRaisesRegex(clackers.InputError, "nothing to draw"):
                clackers.plot.convergence(record)
        with self.assertRaisesRegex(clackers.InputError, "nothing to draw"):
            clackers.plot.history(failed)
        with history_of([0.0, 0.0]), self.assertRaisesRegex(clackers.InputError, "nothing to draw"):
            clackers.plot.history(RECORD)
        self.assertEqual(pyplot.get_fignums(), [])

    def test_a_mass_that_is_not_there(self):
        for mass in (0, 3):
            with self.assertRaisesRegex(clackers.InputError, "allowed: 1 or 2"):
                clackers.plot.history(RECORD, mass=mass)
        with self.assertRaises(clackers.InputError):
            clackers.plot.history(RECORD, mass=1.5)

    def test_what_is_no_record_a_width_and_times(self):
        with self.assertRaisesRegex(clackers.InputError, "a clackers.Record"):
            clackers.plot.convergence(CASE)
        for width in (0.5, float("nan"), "wide"):
            with self.assertRaises(clackers.InputError):
                clackers.plot.response(CASE, width=width)
        with self.assertRaises(clackers.InputError):
            clackers.plot.response(CASE, [0.0, 21.0])

    def test_a_case_is_taken_by_its_name_and_nothing_else_is(self):
        for draw in (clackers.plot.response, clackers.plot.energies, clackers.plot.spectrum):
            self.assertGreater(len(draw("stop").lines), 0)
            with self.assertRaisesRegex(clackers.InputError, "a clackers.Case, or the name of one"):
                draw(RECORD)

    def test_without_matplotlib_the_package_to_install_is_named(self):
        plain = builtins.__import__

        def missing(name, *rest):
            if name.startswith("matplotlib"):
                raise ModuleNotFoundError(f"No module named {name!r}")
            return plain(name, *rest)

        with mock.patch("builtins.__import__", missing), self.assertRaisesRegex(ImportError, "python3-matplotlib"):
            clackers.plot.response(CASE)

    def test_importing_clackers_does_not_import_matplotlib(self):
        program = "import sys, clackers; sys.exit('matplotlib' in sys.modules)"
        self.assertEqual(subprocess.run([sys.executable, "-c", program]).returncode, 0)


class Files(Plots):
    def test_figures_have_the_width_of_a_column_or_a_page(self):
        for width in (clackers.plot.COLUMN, clackers.plot.PAGE):
            axes = clackers.plot.convergence(RECORD, width=width)
            self.assertEqual(axes.figure.get_figwidth(), width)
            axes.figure.canvas.draw()
            inside = axes.figure.get_window_extent()
            for part in (axes.get_legend(), axes.xaxis.label, axes.yaxis.label):
                extent = part.get_window_extent()
                self.assertTrue(inside.x0 <= extent.x0 and extent.x1 <= inside.x1, part)
                self.assertTrue(inside.y0 <= extent.y0 and extent.y1 <= inside.y1, part)

    def test_a_long_legend_takes_no_room_from_the_axes(self):
        def measured(record):
            axes = clackers.plot.convergence(record)
            axes.figure.canvas.draw()
            return axes.get_window_extent(), axes.get_legend().get_window_extent(), axes.figure.get_window_extent()

        methods = ("rk4", "newmark", "newmark+reversal", "generalized-alpha", "newmark+penalty")
        short, _, _ = measured(clackers.verify("rk4", case=CASE, levels=3, samples_per_level=2))
        box, legend, inside = measured(clackers.verify(*methods, case=CASE, levels=3, samples_per_level=2))
        self.assertGreater(box.height, 0.95 * short.height)
        self.assertGreater(box.width, 0.9 * short.width)
        self.assertLessEqual(legend.x1, inside.x1)

    def test_given_axes_are_drawn_on(self):
        figure, (left, right) = pyplot.subplots(1, 2)
        self.assertIs(clackers.plot.response(CASE, ax=left), left)
        self.assertIs(clackers.plot.convergence(RECORD, ax=right), right)
        self.assertEqual(pyplot.get_fignums(), [figure.number])

    def test_every_figure_is_saved_as_pdf_and_png(self):
        drawn = [draw(CASE) for draw in (clackers.plot.response, clackers.plot.energies, clackers.plot.spectrum)]
        drawn += [draw(RECORD) for draw in (clackers.plot.convergence, clackers.plot.history)]
        with tempfile.TemporaryDirectory() as folder:
            for axes in drawn:
                for ending, start in (("pdf", b"%PDF-"), ("png", b"\x89PNG")):
                    path = Path(folder, f"figure.{ending}")
                    axes.figure.savefig(path)
                    self.assertEqual(path.read_bytes()[:len(start)], start)
                    self.assertGreater(path.stat().st_size, 5000)


if __name__ == "__main__":
    unittest.main()
