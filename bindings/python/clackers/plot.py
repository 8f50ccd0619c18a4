"""Figures for a paper, drawn by matplotlib.

Each function draws one figure and returns its ``Axes``, to change or to save:

>>> import clackers, os
>>> axes = clackers.plot.response(clackers.case("three-parameter", N=2))
>>> axes.figure.savefig(os.devnull, format="pdf")

Without ``ax`` the figure is new, ``width`` inches wide: ``COLUMN`` by default, or ``PAGE``. Its letters have
7 and 8 points. With ``ax`` the settings of that figure hold. Series differ in colour, which the colour-blind can
tell apart, and in dashes and markers. matplotlib is imported by the first call; without it ImportError is raised.
"""
from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from clackers import _core
from clackers._case import Case
from clackers._case import case as make_case
from clackers._record import Record

if TYPE_CHECKING:
    from matplotlib.axes import Axes  # type: ignore[import]

COLUMN = 3.4
"""Width of a column of a journal [in]."""
PAGE = 7.0
"""Width of a page of a journal [in]."""

_HEIGHT = 0.65  # without the legend, of the width of a column
_DPI = 200
_SAMPLES = 2001
_MOST_LINES = 60  # more impacts than that are ticks instead of lines
_NEAR_FLOOR = 1e3  # the floor is drawn where an error comes as close as this
_GREY = "#707070"

_SETTINGS: dict[str, Any] = {
    "font.size": 8, "axes.labelsize": 8, "xtick.labelsize": 7, "ytick.labelsize": 7, "legend.fontsize": 7,
    "lines.linewidth": 1.1, "lines.markersize": 4, "axes.linewidth": 0.6, "xtick.major.width": 0.6,
    "ytick.major.width": 0.6, "xtick.minor.width": 0.4, "ytick.minor.width": 0.4,
}  # fmt: skip


class _Look(NamedTuple):
    color: str
    dash: Any
    marker: str


# Okabe and Ito's colours without the yellow, which is too light for a line.
_COLORS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#000000", "#56B4E9", "#E69F00")
_DASHES = ("-", (0, (6, 2)), (0, (1.5, 1.5)), (0, (6, 1.5, 1.5, 1.5)))
_MARKERS = ("o", "s", "D", "^", "v", "P", "X", "<", ">")


def response(
    case: Case | str, t: npt.ArrayLike | None = None, *, ax: Axes | None = None, width: float = COLUMN
) -> Axes:
    """The exact displacements of the masses against time; thin lines mark the impacts.

    More than 60 impacts are ticks at the bottom.

    Parameters
    ----------
    case : Case or str
        A case, or the name of one with its default parameters.
    t : array_like, optional
        Times [s]; default 2001 over the run and those of the impacts.
    ax : Axes, optional
        Where to draw; default a new figure.
    width : float
        Of a new figure [in].

    Returns
    -------
    Axes

    Raises
    ------
    InputError
        As ``Case.response`` does.

    Examples
    --------
    >>> import clackers
    >>> axes = clackers.plot.response(clackers.case("three-parameter"), width=clackers.plot.PAGE)
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('time $t$ [s]', 'displacement [m]')
    """
    case = _case("response", case)
    times, hits = _times(case, t)
    u = case.response(times).u
    with _axes(ax, width) as axes:
        for mass in range(case.dof):
            axes.plot(times, u[:, mass], label=_indexed("u", mass, case.dof), **_line(_look(mass)))
        _mark(axes, hits)
        axes.set(xlabel="time $t$ [s]", ylabel="displacement [m]")
        axes.margins(x=0)
        _legend(axes)
    return axes


def energies(case: Case | str, t: npt.ArrayLike | None = None, *, ax: Axes | None = None, width: float = COLUMN) -> Axes:
    """Where the energy is against time: kinetic, potential, dissipated, lost in impacts, work and total, as far as
    ``Case.energies`` has them.

    Where a time is that of an impact, the limits of both sides are drawn.

    Parameters
    ----------
    case : Case or str
        A case, or the name of one with its default parameters.
    t : array_like, optional
        Times [s]; default 2001 over the run and those of the impacts.
    ax : Axes, optional
        Where to draw; default a new figure.
    width : float
        Of a new figure [in].

    Returns
    -------
    Axes

    Raises
    ------
    InputError
        As ``Case.energies`` does.

    Examples
    --------
    >>> import clackers
    >>> axes = clackers.plot.energies(clackers.case("stop", eta=0.8))
    >>> [line.get_label() for line in axes.lines]
    ['kinetic', 'potential', 'dissipated', 'lost', 'total']
    """
    case = _case("energies", case)
    times, hits = _times(case, t)
    table = case.energies(times)
    with _axes(ax, width) as axes:
        for number, name in enumerate(("kinetic", "potential", "dissipated", "lost", "work", "total")):
            if name in table:
                axes.plot(table["t"], table[name], label=name, **_line(_look(number)))
        _mark(axes, hits)
        axes.set(xlabel="time $t$ [s]", ylabel="energy [J]")
        axes.margins(x=0)
        _legend(axes)
    return axes


def spectrum(
    case: Case | str, highest: float = 30.0, n: int = 1001, *, ax: Axes | None = None, width: float = COLUMN
) -> Axes:
    """The modulus of the Fourier transform of the displacements over the run at frequencies up to ``highest``.

    The vertical axis is logarithmic.

    Parameters
    ----------
    case : Case or str
        A case, or the name of one with its default parameters.
    highest : float
        [rad/s]
    n : int
        Number of frequencies.
    ax : Axes, optional
        Where to draw; default a new figure.
    width : float
        Of a new figure [in].

    Returns
    -------
    Axes

    Raises
    ------
    InputError
        As ``Case.spectrum`` does.

    Examples
    --------
    >>> import clackers
    >>> axes = clackers.plot.spectrum(clackers.case("stop"), highest=20)
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('frequency $\\\\omega$ [rad/s]', 'modulus of the spectrum [m s]')
    """
    case = _case("spectrum", case)
    table = case.spectrum(n, highest)
    with _axes(ax, width) as axes:
        for mass in range(case.dof):
            modulus = np.hypot(table[f"re{mass + 1}"], table[f"im{mass + 1}"])
            axes.plot(table["omega"], modulus, label=_indexed("u", mass, case.dof), **_line(_look(mass)))
        axes.set(xlabel=r"frequency $\omega$ [rad/s]", ylabel="modulus of the spectrum [m s]", yscale="log")
        axes.margins(x=0)
        _legend(axes)
    return axes


def convergence(
    record: Record,
    case: str | None = None,
    *,
    floor: bool | None = None,
    ax: Axes | None = None,
    width: float = COLUMN,
) -> Axes:
    """The largest error in u of every run against its step or tolerance, both axes logarithmic.

    Faint points are runs; a line joins the largest errors of the levels of a subject. Thin grey lines have the
    slopes of the orders beside them. Runs without a finite positive error are not drawn.

    Parameters
    ----------
    record : Record
    case : str, optional
        The name of one of several cases; default the first.
    floor : bool, optional
        Whether the error that rounding explains is drawn, dotted; default where an error is less than a thousand times
        larger.
    ax : Axes, optional
        Where to draw; default a new figure.
    width : float
        Of a new figure [in].

    Returns
    -------
    Axes

    Raises
    ------
    InputError
        Where no run has a finite positive error.

    Examples
    --------
    >>> import clackers
    >>> record = clackers.verify("rk4", "newmark+reversal", case="three-parameter", levels=3, samples_per_level=4)
    >>> axes = clackers.plot.convergence(record)
    >>> [text.get_text() for text in axes.get_legend().get_texts()]
    ['rk4', 'newmark+reversal']
    """
    data = _datasets(record, "convergence", case)
    runs = [row for row in data["runs"] if row["finished"] == "yes" and _is_drawable(row["u_error"])]
    levels = [row for row in data["levels"] if _is_drawable(row["u_error"])]
    with _axes(ax, width) as axes:
        _draw_slopes(axes, data.get("slopes", ()))
        for number, method in enumerate(dict.fromkeys(row["method"] for row in runs)):
            look = _look(number)
            own = [row for row in runs if row["method"] == method]
            axes.plot(
                list(map(_resolution, own)), _column(own, "u_error"), label=f"_runs of {method}", linestyle="none", marker=".",
                markersize=3, markeredgewidth=0, color=look.color, alpha=0.4,
            )
            own = [row for row in levels if row["method"] == method]
            axes.plot(_column(own, "step"), _column(own, "u_error"), label=method, marker=look.marker, **_line(look))
        _draw_floor(axes, runs, floor)
        kinds = {"step $h$ [s]" if row["tolerance"] is None else "tolerance" for row in runs}
        axes.set(xscale="log", yscale="log", xlabel=" or ".join(sorted(kinds)), ylabel=r"largest error in $u$ / largest envelope")
        _legend(axes)
    return axes


def history(
    record: Record, mass: int = 1, case: str | None = None, *, ax: Axes | None = None, width: float = COLUMN
) -> Axes:
    """The error in u of a mass, counted from 1, against time: the finest run of each subject.

    The vertical axis is logarithmic; each point is the largest error of a short interval.

    Parameters
    ----------
    record : Record
    mass : int
        From 1.
    case : str, optional
        The name of one of several cases; default the first.
    ax : Axes, optional
        Where to draw; default a new figure.
    width : float
        Of a new figure [in].

    Returns
    -------
    Axes

    Raises
    ------
    InputError
        Where there is no history, or no such mass.

    Examples
    --------
    >>> import clackers
    >>> record = clackers.verify("rk4", "newmark", case="three-parameter", levels=3, samples_per_level=4)
    >>> clackers.plot.history(record, mass=2).get_ylabel()
    '|error in $u_2$| / largest envelope'
    """
    rows = _datasets(record, "history", case)["history"]
    masses = sorted({int(row["mass"]) for row in rows})
    chosen = [row for row in rows if row["mass"] == _core.read_whole("plot.history", "mass", mass)]
    if rows and not chosen:
        _core.refuse("plot.history", "mass", str(mass), " or ".join(map(str, masses)))
    if not any(_is_drawable(error) for row in chosen for error in row["error"]):
        _refuse_empty("history", "one with a run of a finite positive error")
    runs = record.table()
    by_tolerance = set(runs["method"][~np.isnan(runs["tolerance"])])
    steps = [f"tolerance {row['step']:.3g}" if row["method"] in by_tolerance else f"$h$ = {row['step']:.3g} s" for row in chosen]
    is_common = len(set(steps)) == 1
    with _axes(ax, width) as axes:
        for number, row in enumerate(chosen):
            look = _look(number)
            # An error of zero has no place on a logarithmic axis: the line has a gap there.
            error = [value if _is_drawable(value) else np.nan for value in row["error"]]
            apart = max(len(error) // 8, 1)
            axes.plot(
                row["t"], error, marker=look.marker, markevery=(number * apart // 4 % apart, apart),
                label=row["method"] if is_common else f"{row['method']}, {steps[number]}", **_line(look),
            )
        axes.set(
            yscale="log", xlabel="time $t$ [s]",
            ylabel=f"|error in {_indexed('u', mass - 1, len(masses))}| / largest envelope",
        )
        axes.margins(x=0)
        _legend(axes, steps[0] if is_common else None)
    return axes


# Axes.


@contextmanager
def _axes(ax: Axes | None, width: float) -> Iterator[Axes]:
    """The axes to draw on; those of a new figure are drawn with the settings of this module."""
    try:
        import matplotlib  # type: ignore[import]
        import matplotlib.pyplot as pyplot  # type: ignore[import]
    except ImportError as error:
        raise ImportError(
            "clackers.plot needs matplotlib: apt-get install python3-matplotlib, or pip install matplotlib"
        ) from error
    if ax is not None:
        yield ax
        return
    inches = _core.read_number("plot", "width", width)
    if not 1.0 <= inches <= 100.0:
        _core.refuse("plot", "width", f"{inches:g}", "1 to 100, in inches", "clackers.plot.COLUMN is 3.4, PAGE is 7.")
    height = _HEIGHT * min(inches, COLUMN + (inches - COLUMN) / 4)
    # Outside of rc_context, which would undo what the backend of a notebook sets when it is loaded.
    figure = pyplot.figure(figsize=(inches, height), dpi=_DPI, layout="constrained")
    with matplotlib.rc_context(_SETTINGS):
        axes = figure.add_subplot()
        yield axes
        legend = axes.get_legend()
        if legend is not None:  # above the axes, not at their cost
            figure.set_figheight(height + legend.get_window_extent().height / figure.dpi)


def _look(number: int) -> _Look:
    return _Look(_COLORS[number % len(_COLORS)], _DASHES[number % len(_DASHES)], _MARKERS[number % len(_MARKERS)])


def _line(look: _Look) -> dict[str, Any]:
    return {"color": look.color, "linestyle": look.dash}


def _legend(axes: Axes, title: str | None = None) -> None:
    """Above the axes, where it covers no line, with as many columns as fit."""
    room = 1.1 * axes.get_window_extent().width
    for columns in range(len(axes.get_legend_handles_labels()[1]), 0, -1):
        legend = axes.legend(
            loc="lower left", bbox_to_anchor=(0, 1), ncol=columns, frameon=False, handlelength=3, columnspacing=1.2,
            title=title, alignment="left", title_fontsize="small",
        )
        if legend.get_window_extent().width <= room:
            break


def _indexed(symbol: str, mass: int, dof: int) -> str:
    return f"${symbol}_{mass + 1}$" if dof > 1 else f"${symbol}$"


# Data of a case.


def _case(figure: str, case: Case | str) -> Case:
    if isinstance(case, str):
        return make_case(case)
    if not isinstance(case, Case):
        _core.refuse(f"plot.{figure}", "case", _core.description(case), "a clackers.Case, or the name of one")
    return case


def _times(case: Case, t: npt.ArrayLike | None) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """The times to draw, and those of the impacts among them."""
    hits = case.impacts().t if case.impact_count() else np.empty(0)
    if t is None:
        return np.union1d(np.linspace(0.0, case.end, _SAMPLES), hits), hits
    times = np.atleast_1d(_core.read_array("plot", "t", t))
    return times, hits[(hits >= times.min(initial=np.inf)) & (hits <= times.max(initial=-np.inf))]


def _mark(axes: Axes, hits: npt.NDArray[np.float64]) -> None:
    if len(hits) == 0:
        return
    from matplotlib.collections import LineCollection  # type: ignore[import]

    height = 1.0 if len(hits) <= _MOST_LINES else 0.04
    marks = LineCollection(
        [[(hit, 0.0), (hit, height)] for hit in hits], transform=axes.get_xaxis_transform(), colors="#b0b0b0",
        linewidths=0.5, zorder=0.5, label="impacts",
    )
    axes.add_collection(marks, autolim=False)  # heights are shares of the axes, no data


# Data of a record.


def _datasets(record: Record, figure: str, case: str | None) -> dict[str, Any]:
    """The data of a figure of the report, so that both show the same numbers."""
    if not isinstance(record, Record):
        _core.refuse(f"plot.{figure}", "record", _core.description(record), "a clackers.Record")
    drawn = {name: figures for name, _, figures in reversed(record._cases)}
    chosen = record.cases[0] if case is None else case
    if chosen in drawn and figure not in drawn[chosen]:
        _refuse_empty(figure, "one with finished runs")
    data = record.figure(figure, case).spec["datasets"]
    assert isinstance(data, dict)
    return data


def _refuse_empty(figure: str, allowed: str) -> None:
    _core.refuse(f"plot.{figure}", "record", "a record with nothing to draw", allowed, "", "wrong-size")


def _is_drawable(value: float | None) -> bool:
    return value is not None and 0.0 < value < np.inf


def _resolution(run: dict[str, Any]) -> float:
    """The step or tolerance of a run."""
    found: float = run["step"] if run["tolerance"] is None else run["tolerance"]
    return found


def _column(rows: Sequence[dict[str, Any]], name: str) -> list[float]:
    return [row[name] for row in rows]


def _draw_slopes(axes: Axes, slopes: Sequence[dict[str, Any]]) -> None:
    for slope in slopes:
        axes.plot(slope["step"], slope["u_error"], label="_slope", color=_GREY, linewidth=0.6, zorder=1)
        corner = slope["corner"].index(2)
        axes.annotate(
            slope["order"], (slope["step"][corner], slope["u_error"][corner]), xytext=(3, 0),
            textcoords="offset points", va="center", color=_GREY, fontsize="small", annotation_clip=True,
        )


def _draw_floor(axes: Axes, runs: Sequence[dict[str, Any]], wanted: bool | None) -> None:
    known = [row for row in runs if _is_drawable(row["rounding_floor"])]
    if wanted is None:
        wanted = any(row["u_error"] < _NEAR_FLOOR * row["rounding_floor"] for row in known)
    if not wanted or not known:
        return
    largest: dict[float, float] = {}
    for row in known:
        largest[_resolution(row)] = max(row["rounding_floor"], largest.get(_resolution(row), 0.0))
    steps = sorted(largest)
    axes.plot(
        steps, [largest[step] for step in steps], label="rounding", color=_GREY, linestyle=":", linewidth=0.9, zorder=1
    )
