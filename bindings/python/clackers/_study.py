"""Assessing methods, callables and histories."""
from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, TypeGuard, Union

import numpy.typing as npt

from clackers import _core
from clackers._case import Case, known_arguments
from clackers._case import case as make_case
from clackers._errors import Interrupted, SolverError
from clackers._history import Columns, Source, read_impacts, read_history
from clackers._record import Record
from clackers._solver import Program, Runs, Solver, name_of
from clackers._table import Table

Progress = Union[Callable[[float], object], bool, None]
CaseChoice = Union[str, Case, Sequence[Union[str, Case]]]
Path = Union[str, "os.PathLike[str]"]

TOLERANCES = "1e-3:1e-10"
"""Those of a callable that is given tolerances, one a decade."""


def verify(
    *subjects: str | Program | Solver,
    case: CaseChoice | None = None,
    steps: npt.ArrayLike | None = None,
    tolerances: Sequence[float] | str | Literal[True] | None = None,
    levels: int | None = None,
    coarsest: float | None = None,
    samples_per_level: int | None = None,
    expect: str | None = None,
    name: str | Sequence[str] | None = None,
    budget: float | None = None,
    jobs: int | None = None,
    progress: Progress = None,
    neighbours: int | None = None,
    **parameters: float | str,
) -> Record:
    """Assesses methods, callables and programs over a range of steps on a case whose exact motion is known.

    A callable ``solver(problem, h)`` gets a ``clackers.Problem`` and a step [s] and
    returns (t, u), (t, u, v) or (t, u, v, a), u of shape (time, dof) or (dof, time), (time,) for one mass; a
    mapping or an object with t, u, v, a and, where known, impacts (their times, or as ``Case.impacts``
    returns them); or the result of ``scipy.integrate.solve_ivp``, y = (u, v), or a list of such results of
    consecutive flights, whose ``t_events`` are the impacts. A time that appears twice has both limits of
    a jump. Callables are called in the thread of the caller, one at a time. A run that raises, or returns
    something else, is a failed run of its step.

    Parameters
    ----------
    *subjects : str, callable or Program
        Names of methods (``clackers.catalogue("pairs")``), callables and programs; default a panel of methods. What is
        said of callables below holds for programs as well.
    case : str, Case or list of these
        A name with ``parameters``, or cases; default three-parameter.
    steps : array_like
        The steps of callables [s], in any order, instead of a ladder.
    tolerances : array_like, str or True
        Callables are solver(problem, tolerance): a list, "1e-3:1e-10" (one a decade), or True for these.
    levels : int
        Each with half the step of the one before; default 8, 6 with callables.
    coarsest : float
        Largest step [s]; default a fourteenth of the fast period of the case.
    samples_per_level : int
        Steps a level; default 8, 4 with callables.
    expect : str
        What callables should show: "proper:2", "irregular:1", "exact", ...; default nothing.
    name : str or list of str
        Names of callables in the record; default those of the functions.
    budget : float
        Time for further steps of what is undecided [s]; default 20, 0 with levels or steps.
    jobs : int
        Threads; default one per processor.
    progress : callable or bool
        A callable that gets the share that is done, or True for a line on standard error.
    neighbours : int
        The former name of ``samples_per_level``.
    **parameters : float or str
        Those of the case.

    Returns
    -------
    Record

    Raises
    ------
    InputError
        For what cannot be run.
    SolverError
        Where every run of a solver failed, from its first exception; ``record`` has what the others did.
    Interrupted
        After Ctrl-C, a KeyboardInterrupt with the record of what was finished.

    Examples
    --------
    >>> import clackers, numpy
    >>> def leapfrog(problem, h):
    ...     t, u, v = problem.start
    ...     eta = problem.contacts[0].restitution
    ...     times, states, speeds = [t], [u], [v]
    ...     for i in range(round(problem.end / h)):
    ...         v = v + h * problem.rhs(t, [*u, *v])[problem.dof:]
    ...         u = u + h * v
    ...         t = (i + 1) * h
    ...         if problem.gap(t, [*u, *v]) < 0 and v @ problem.contacts[0].direction < 0:
    ...             v = problem.impact([*u, *v])[problem.dof:]
    ...         times.append(t), states.append(u), speeds.append(v)
    ...     return times, states, speeds
    >>> record = clackers.verify(leapfrog, case="stop", levels=3, expect="irregular:1")
    >>> record.subject.kind
    'callable'
    """
    names = [_core.read_text("verify", "method", subject) for subject in subjects if isinstance(subject, str)]
    solvers = [subject for subject in subjects if not isinstance(subject, str)]
    for solver in solvers:
        if not callable(solver) and not isinstance(solver, Program):
            _core.refuse(
                "verify", "subject", f"{solver!r} ({_core.description(solver)})",
                "the name of a method, a callable solver(problem, h), or a Program",
            )
    _refuse_without_solvers(solvers, bool(names), steps, tolerances, expect, name)
    chosen = _cases("verify", case, parameters)
    own_steps = [] if steps is None else _descending("steps", _core.read_vector("verify", "steps", steps).tolist())
    own_tolerances = [] if tolerances is None else _tolerances(tolerances)
    titles = _names(solvers, name)
    runs = [solver if isinstance(solver, Program) else Runs(solver, title) for solver, title in zip(solvers, titles)]
    with _ProgressLine("verify", progress) as report, known_arguments(verify, chosen[0][0], parameters):
        core, stop = _core.verify(
            methods=names,
            solvers=[
                (title, each._arguments() if isinstance(each, Program) else each, own_steps, own_tolerances)
                for title, each in zip(titles, runs)
            ],
            cases=chosen,
            expect=None if expect is None else _core.read_text("verify", "expect", expect),
            options={
                "levels": levels, "coarsest": coarsest, "samples_per_level": samples_per_level, "neighbours": neighbours,
                "budget": budget, "jobs": jobs,
            },
            command=_line(
                "verify", [name_of(each) if callable(each) else repr(each) for each in subjects], parameters,
                case=case, steps=steps, tolerances=tolerances, levels=levels, coarsest=coarsest,
                samples_per_level=neighbours if samples_per_level is None else samples_per_level, expect=expect, name=name,
            ),
            progress=report,
        )
    record = _record(core, stop)
    failure = record._core.failed_solver()
    if failure is not None:
        solver_name, sentence, code, printed = failure
        end = "" if sentence.endswith(".") else "."
        failed = (each for each in runs if isinstance(each, Runs) and each.name == solver_name)
        first = next((each.first_error for each in failed if each.first_error is not None), None)
        if printed and first is None:
            end += f" It printed: {printed}"
        raise SolverError(f"verify: {solver_name}: every run failed; the first one: {sentence}{end}", code, record) from first
    return record


def check(
    t: object,
    u: npt.ArrayLike | None = None,
    v: npt.ArrayLike | None = None,
    a: npt.ArrayLike | None = None,
    *,
    impacts: object = None,
    collisions: object = None,
    step: float | Sequence[float] | None = None,
    tolerances: Sequence[float] | None = None,
    case: str | Case | None = None,
    expect: str | None = None,
    tolerance: float | None = None,
    columns: str | Sequence[str] | None = None,
    reader: str | None = None,
    node: str | Sequence[str | int] | None = None,
    component: int | str | None = None,
    name: str | Sequence[str] | None = None,
    progress: Progress = None,
    **parameters: float | str,
) -> Record:
    """Assesses time histories of any program against the exact motion of a case.

    A time that appears twice has both limits of a jump. Several histories are levels of one method and give an
    order. Several methods are judged in one record; options with one value a history then count over all histories.
    Where no exact motion exists ``clackers.compare`` compares two sets of histories.

    Parameters
    ----------
    t : array_like, path, list or mapping
        Times [s] beside ``u``; alone whatever a callable of ``clackers.verify`` may return, the path of a file (text,
        or NumPy's npy), a list of these, a mapping from steps [s] to them, or from names of methods to the histories
        of each.
    u, v, a : array_like
        Displacements [m], velocities [m/s] and accelerations [m/s^2] of shape (time, dof) or (dof, time), (time,) for
        one mass; the column of a mass that is not known is NaN.
    impacts : array_like, Impacts, path or list
        Times of the impacts, or as ``Case.impacts`` returns them; of a file a path; of several histories a list of
        these; default those found in the history.
    collisions : array_like, Impacts, path or list
        The former name of ``impacts``.
    step : float or list of float
        Step of each history [s]; default the median time between rows.
    tolerances : list of float
        Of an adaptive solver, one a history, instead of steps.
    case : str or Case
        A name with ``parameters``, or a case; default three-parameter.
    expect : str
        What the histories should show: "proper:2", "irregular:1", "exact", ...; default nothing.
    tolerance : float
        Largest error in u over the largest envelope that is allowed.
    columns : str or list of str
        Names of the columns of files where a header lacks or differs: "t,u1,_,v1" or a list.
    reader : str
        Of result files of other programs: "calculix-dat", "table", ...; default the one that knows their first lines.
    node : str or list
        Nodes of a result file, one a mass: "12,7" or [12, 7]; default all, in the order of the file.
    component : int or str
        Direction in a result file, 1 to 3; "coor1" reads the coordinate as u. Default 1.
    name : str or list of str
        Of the history in the record, a list of several.
    progress : callable or bool
        A callable that gets the share that is done, or True for a line on standard error.
    **parameters : float or str
        Those of the case.

    Returns
    -------
    Record

    Raises
    ------
    InputError
        For what is no history, or one of another case.
    FileError
        For a file that cannot be read.
    Interrupted
        After Ctrl-C.

    Examples
    --------
    >>> import clackers, numpy
    >>> case = clackers.case("three-parameter")
    >>> t = numpy.linspace(0, case.end, 2001)
    >>> u, v, a = case.response(t)
    >>> clackers.check(t, u, v, case=case, tolerance=1e-6).verdict
    'agrees'
    """
    chosen = _cases("check", case, parameters)
    if len(chosen) != 1:
        _core.refuse("check", "case", f"{len(chosen)} of them", "one case", "", "wrong-size")
    named: Mapping[str, object] = (
        {_core.read_text("check", "name", key): value for key, value in t.items()} if u is None and _is_named(t) else {"histories": t}
    )
    parts = {title: _histories(histories, u, v, a) for title, histories in named.items()}
    given = [history for histories, _ in parts.values() for history in histories]
    keys = [key for _, steps in parts.values() for key in steps or ()] or None
    if keys is not None and (step is not None or tolerances is not None):
        _core.refuse("check", "step", "steps beside a mapping", "steps as keys, or step and tolerances", "", "bad-syntax")
    titles = _titles(name, len(given))
    events = _one_each("impacts", collisions if impacts is None else impacts, len(given))
    with known_arguments(check, chosen[0][0], parameters):
        dof = (case if isinstance(case, Case) else make_case(case, threshold=None, **parameters)).dof
    sources: list[Source] = []
    reported: list[Source | None] = []
    for history, title, event in zip(given, titles, events):
        source, found = _source("check", history, title, dof)
        sources.append(source)
        if _is_path(event):
            reported.append(_encoded("check", event))
            continue
        if event is not None:
            found = read_impacts("check", event)
        reported.append(None if found is None else (f"impacts of {title}", found))
    if any(each is None for each in reported) and not all(each is None for each in reported):
        _core.refuse("check", "impacts", "those of some histories", "those of all, or of none", "", "wrong-size")
    steps = list(keys or ())
    if step is not None:
        steps = _core.read_vector("check", "step", step).tolist()
    with _ProgressLine("check", progress) as report:
        core, stop = _core.check(
            subjects=[(title, [sources.pop(0) for _ in histories]) for title, (histories, _) in parts.items()],
            events=[each for each in reported if each is not None],
            case=chosen[0],
            steps=steps,
            tolerances=[] if tolerances is None else _core.read_vector("check", "tolerances", tolerances).tolist(),
            columns=[] if columns is None else [_core.read_text("check", "columns", column) for column in _parts(columns)],
            expect=None if expect is None else _core.read_text("check", "expect", expect),
            tolerance=None if tolerance is None else _core.read_number("check", "tolerance", tolerance),
            results=_results("check", reader, node, component),
            command=_line(
                "check", _positional(given, keys, u, v, a) if "histories" in named else ["histories"], parameters, step=step, tolerances=tolerances, case=case,
                expect=expect, tolerance=tolerance, columns=columns, reader=reader, node=node, component=component, name=name,
            ),
            progress=report,
        )
    return _record(core, stop)


@dataclass(frozen=True)
class Comparison:
    """Differences between two sets of histories of one motion, which ``clackers.compare`` found.

    Attributes
    ----------
    differences : Table
        Of each mass: the largest, its time, and the first time of one above 1e-3 of the largest displacement.
    sets : Table
        Of each set by itself: the order with which the differences between its histories fall.
    is_within : bool or None
        Whether all are within ``tolerance``; True without one, None where only a part could be compared and is.
    """

    differences: Table
    sets: Table
    is_within: bool | None

    def __str__(self) -> str:
        return f"{self.differences}\n\n{self.sets}"

    def _repr_html_(self) -> str:
        return self.differences._repr_html_() + self.sets._repr_html_()


def compare(
    first: object,
    second: object,
    *,
    step: Sequence[float] | None = None,
    tolerances: Sequence[float] | None = None,
    tolerance: float | None = None,
    columns: str | Sequence[str] | None = None,
    reader: str | None = None,
    node: str | Sequence[str | int] | None = None,
    component: int | str | None = None,
) -> Comparison:
    """Compares two sets of histories of a motion that nobody knows exactly, at the times that both have.

    Agreement is no proof: both sets may be wrong in the same way.

    Parameters
    ----------
    first, second : history, path, list or mapping
        Histories as ``clackers.check`` takes them; several, in a list or a mapping from steps, are levels of one method.
    step, tolerances : list of float
        Step [s] or tolerance of each history of both sets; default the median time between rows.
    tolerance : float
        Largest difference over the largest displacement that is allowed.
    columns : str or list of str
        Names of the columns of files where a header lacks or differs.
    reader, node, component
        Of result files, as ``clackers.check`` takes them.

    Returns
    -------
    Comparison

    Raises
    ------
    InputError
        For what is no history, and for fewer than ten common times.
    FileError
        For a file that cannot be read.
    Interrupted
        After Ctrl-C.

    Examples
    --------
    >>> import clackers, numpy
    >>> t = numpy.linspace(0, 10, 101)
    >>> found = clackers.compare((t, numpy.sin(t)), (t, 1.001 * numpy.sin(t)), tolerance=1e-2)
    >>> found.is_within, found.differences["relative"].round(6)
    (True, array([0.000999]))
    """
    sources: list[list[Source]] = []
    keys: list[float] = []
    for title, histories in (("first", first), ("second", second)):
        given, own = _histories(histories, None, None, None)
        keys += own or ()
        sources.append([_source("compare", each, name, None)[0] for each, name in zip(given, _titles(None, len(given), title))])
    if keys and (step is not None or tolerances is not None or len(keys) != sum(map(len, sources))):
        _core.refuse("compare", "steps", "a mapping beside others", "mappings from steps, or step, or tolerances", "", "bad-syntax")
    core, stop = _core.compare(
        sources[0],
        sources[1],
        keys if step is None else _core.read_vector("compare", "step", step).tolist(),
        [] if tolerances is None else _core.read_vector("compare", "tolerances", tolerances).tolist(),
        [] if columns is None else [_core.read_text("compare", "columns", column) for column in _parts(columns)],
        None if tolerance is None else _core.read_number("compare", "tolerance", tolerance),
        _results("compare", reader, node, component),
    )
    if core is None:
        raise stop or Interrupted(None)
    differences, sets = (Table(*rows) for rows in core.tables)
    return Comparison(differences, sets, core.is_within)


def _record(core: _core.Record | None, stop: BaseException | None) -> Record:
    record = None if core is None else Record(core)
    if isinstance(stop, KeyboardInterrupt) or (stop is None and (record is None or record.interrupted)):
        raise Interrupted(record) from stop
    if stop is not None:
        raise stop
    assert record is not None
    return record


# Cases.


def _cases(who: str, case: CaseChoice | None, parameters: Mapping[str, float | str]) -> list[tuple[str, dict[str, float | str]]]:
    """Name and parameters of each case; an empty name is the default case."""
    if case is None:
        return [("", dict(parameters))]
    if isinstance(case, (str, Case)):
        case = [case]
    if not isinstance(case, (list, tuple)) or not case:
        _core.refuse(who, "case", _core.description(case), "a name, a clackers.Case, or a list of these", "", "not-text")
    chosen: list[tuple[str, dict[str, float | str]]] = []
    for each in case:
        if isinstance(each, Case):
            if parameters:
                _core.refuse(
                    who, "parameters", ", ".join(parameters), "none beside a clackers.Case, which has its own", "",
                    "bad-syntax",
                )
            chosen.append((each.name, each.parameters))
        else:
            chosen.append((_core.read_text(who, "case", each), dict(parameters)))
    return chosen


# Options of verify.


def _refuse_without_solvers(
    solvers: Sequence[Program | Solver], has_methods: bool, steps: object, tolerances: object, expect: object, name: object
) -> None:
    options = {"steps": steps, "tolerances": tolerances, "expect": expect, "name": name}
    for option, value in options.items():
        if value is not None and not solvers:
            _core.refuse("verify", option, repr(value), "none without a callable, since it is for callables", "", "bad-syntax")
    if steps is not None and tolerances is not None:
        _core.refuse("verify", "steps", "steps and tolerances", "one of them", "", "bad-syntax")
    if has_methods and steps is not None:
        _core.refuse(
            "verify", "steps", "steps beside methods", "steps only for callables",
            "Methods take levels and coarsest, and so do callables beside them.", "bad-syntax",
        )


def _descending(option: str, values: list[float]) -> list[float]:
    if not values:
        _core.refuse("verify", option, "none", "one at least", "", "wrong-size")
    return sorted(values, reverse=True)


def _tolerances(given: Sequence[float] | str | Literal[True]) -> list[float]:
    if given is True:
        return _core.tolerances_from(TOLERANCES)
    if isinstance(given, str):
        return _core.tolerances_from(_core.read_text("verify", "tolerances", given))
    return _descending("tolerances", _core.read_vector("verify", "tolerances", given).tolist())


def _names(solvers: Sequence[Program | Solver], name: str | Sequence[str] | None) -> list[str]:
    if name is None:  # a program is named for its file
        return ["" if isinstance(solver, Program) else name_of(solver) for solver in solvers]
    names = [name] if isinstance(name, str) else list(name)
    if len(names) != len(solvers):
        _core.refuse("verify", "name", f"{len(names)} of them", f"one a callable, {len(solvers)} here", "", "wrong-size")
    return [_core.read_text("verify", "name", each) for each in names]


# Histories of check.


def _is_path(value: object) -> TypeGuard[Path]:
    return isinstance(value, (str, os.PathLike))


def _parts(columns: str | Sequence[str]) -> Sequence[str]:
    return columns.split(",") if isinstance(columns, str) else columns


def _results(
    who: str, reader: str | None, node: str | Sequence[str | int] | None, component: int | str | None
) -> tuple[str, list[str], str]:
    nodes = node.split(",") if isinstance(node, str) else [str(part) for part in node or ()]
    return "" if reader is None else _core.read_text(who, "reader", reader), nodes, "" if component is None else str(component)


def _is_history(value: object) -> bool:
    """Of an entry of a list: no array, and no list of numbers."""
    if _is_path(value) or isinstance(value, (tuple, Mapping)) or hasattr(value, "t"):
        return True
    return isinstance(value, list) and bool(value) and all(hasattr(part, "t") or isinstance(part, Mapping) for part in value)


def _is_named(value: object) -> TypeGuard[Mapping[str, object]]:
    """Histories of several methods: their names are keys, and no name of a column is."""
    return isinstance(value, Mapping) and "t" not in value and bool(value) and all(isinstance(key, str) for key in value)


def _histories(t: object, u: object, v: object, a: object) -> tuple[list[object], list[float] | None]:
    """All histories, and their steps where those are given as keys."""
    if u is not None:
        return [tuple(part for part in (t, u, v, a))], None
    if v is not None or a is not None:
        _core.refuse("check", "u", "None", "displacements beside velocities and accelerations", "", "no-column")
    if isinstance(t, Mapping) and "t" not in t:
        return list(t.values()), [_core.read_number("check", "key of the histories", key) for key in t]
    if isinstance(t, (list, tuple)) and t and all(map(_is_history, t)):
        return list(t), None
    return [t], None


def _source(who: str, history: object, title: str, dof: int | None) -> tuple[Source, Columns | None]:
    """A history, and the impacts that it has itself."""
    if _is_path(history):
        return _encoded(who, history), None
    columns, found = read_history(who, history, dof)
    return (title, columns), found


def _encoded(who: str, path: Path) -> bytes:
    name = os.fsencode(path)
    if b"\0" in name:
        _core.refuse(who, "path", repr(os.fspath(path)), "a path without NUL", "", "not-text")
    return name


def _titles(name: str | Sequence[str] | None, count: int, default: str = "history") -> list[str]:
    if name is None:
        return [default] if count == 1 else [f"{default} {number + 1}" for number in range(count)]
    names = [name] if isinstance(name, str) else list(name)
    if len(names) != count:
        _core.refuse("check", "name", f"{len(names)} of them", f"one a history, {count} here", "", "wrong-size")
    return [_core.read_text("check", "name", each) for each in names]


def _one_each(option: str, value: object, count: int) -> list[object]:
    if value is None or count == 1:
        return [value] * count
    if not isinstance(value, (list, tuple)) or len(value) != count:
        _core.refuse("check", option, _core.description(value), f"a list with one a history, {count} here", "", "wrong-size")
    return list(value)


# The line that does it again.


def _line(command: str, positional: Iterable[str], parameters: Mapping[str, float | str], **options: object) -> str:
    given = [f"{name}={_shown(value)}" for name, value in options.items() if value is not None]
    given += [f"{name}={value!r}" for name, value in parameters.items()]
    return f"clackers.{command}({', '.join([*positional, *given])})"


def _shown(value: object) -> str:
    if isinstance(value, Case):
        arguments = "".join(f", {name}={number!r}" for name, number in value.parameters.items())
        return f"clackers.case({value.name!r}{arguments})"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(_shown, value)) + "]"
    return repr(value.tolist() if hasattr(value, "tolist") else value)


def _positional(given: Sequence[object], keys: object, u: object, v: object, a: object) -> list[str]:
    if u is not None:
        parts = ["t", "u"] + (["v"] if v is not None or a is not None else []) + (["a"] if a is not None else [])
        return ["None" if part == "v" and v is None else part for part in parts]
    if all(map(_is_path, given)) and keys is None:
        paths = [repr(os.fspath(path)) for path in given if _is_path(path)]
        return paths if len(paths) == 1 else [f"[{', '.join(paths)}]"]
    return ["history"] if len(given) == 1 and keys is None else ["histories"]


class _ProgressLine:
    """``progress=True``: a line on standard error that is updated."""

    def __init__(self, command: str, progress: Progress) -> None:
        self._command = command
        self._progress = progress
        self._is_written = False
        if progress is not None and not isinstance(progress, bool) and not callable(progress):
            _core.refuse(command, "progress", _core.description(progress), "a callable, True or None")

    def __enter__(self) -> Callable[[float], object] | None:
        if callable(self._progress):
            return self._progress
        return self._write if self._progress else None

    def __exit__(self, *_: object) -> None:
        if self._is_written:
            sys.stderr.write("\r" + " " * 20 + "\r")
            sys.stderr.flush()

    def _write(self, share: float) -> None:
        self._is_written = True
        sys.stderr.write(f"\r{self._command}: {100 * share:3.0f} %")
        sys.stderr.flush()
