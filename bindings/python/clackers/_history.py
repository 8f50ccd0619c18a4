"""Histories as solvers and programs in Python hold them, read as columns."""
from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, Union

import numpy as np

from clackers import _core
from clackers._problem import Array

Columns = list[tuple[str, Array]]
Source = Union[bytes, tuple[str, Columns]]
"""The path of a file, or columns under a name."""

ALLOWED = "(t, u), (t, u, v), (t, u, v, a), a mapping or an object with t and u (or y = (u, v)), or results of solve_ivp"


class History(NamedTuple):
    """Columns named as in a file: t, u1, v1, a1, u2, ...; events None where none are reported."""

    columns: Columns
    events: Columns | None


def read_history(who: str, value: object, dof: int | None) -> History:
    """A history in any of the forms of ``ALLOWED``; several results of solve_ivp are consecutive flights.

    Without ``dof`` the number of masses is that of the arrays.

    Raises InputError with ``who`` for everything else.
    """
    if isinstance(value, list) and value and all(_is_flight(part) for part in value):
        return _joined([_read_one(who, part, dof) for part in value])
    return _read_one(who, value, dof)


def _is_flight(value: object) -> bool:
    return not isinstance(value, (np.ndarray, tuple, str)) and "t" in _parts(value) and "y" in _parts(value)


def _joined(flights: Sequence[History]) -> History:
    columns = [
        (name, np.concatenate([flight.columns[i][1] for flight in flights]))
        for i, (name, _) in enumerate(flights[0].columns)
    ]
    times = [array for flight in flights for _, array in flight.events or []]
    return History(columns, [("t", np.sort(np.concatenate(times)))] if times else None)


_NAMES = ("t", "u", "v", "a", "y", "impacts", "collisions", "events", "t_events")


def _parts(value: object) -> dict[str, Any]:
    """What a mapping or an object has under the names of a history; None counts as missing."""
    if isinstance(value, Mapping):
        found = {name: value[name] for name in _NAMES if name in value}
    else:
        found = {name: getattr(value, name) for name in _NAMES if hasattr(value, name)}
    return {name: part for name, part in found.items() if part is not None}


def _read_one(who: str, value: object, dof: int | None) -> History:
    if value is None:
        _core.refuse(who, "the result", "None", ALLOWED, "A function without a return statement returns None.")
    if isinstance(value, str):
        _core.refuse(who, "the result", "a text", ALLOWED)
    parts = _parts(value)
    if "t" not in parts or not ("u" in parts or "y" in parts):
        if not isinstance(value, (tuple, list)) or not 2 <= len(value) <= 4:
            _core.refuse(who, "the result", _described(value), ALLOWED)
        parts = {name: part for name, part in zip("tuva", value) if part is not None}
        if not {"t", "u"} <= parts.keys():
            _core.refuse(who, "the result", "None for t or u", ALLOWED)
    t = _core.read_vector(who, "t", parts["t"])
    columns: Columns = [("t", t)]
    if dof is None:
        shape = _core.read_array(who, "u" if "u" in parts else "y", parts.get("u", parts.get("y"))).shape
        width = 1 if len(shape) < 2 else shape[1] if shape[0] == len(t) else shape[0]
        dof = width if "u" in parts else width // 2
    if "u" in parts:
        parts = _with_state_as_u(who, parts, len(t), dof)
    if "y" in parts:
        y = _matrix(who, "y", parts["y"], len(t), 2 * dof, columns_first=True)
        columns += _named("u", y[:, :dof]) + _named("v", y[:, dof:])
    for name in "uva":
        if name in parts and not ("y" in parts and name in "uv"):
            columns += _named(name, _matrix(who, name, parts[name], len(t), dof))
    return History(columns, _read_events(who, parts))


def _with_state_as_u(who: str, parts: dict[str, Any], times: int, dof: int) -> dict[str, Any]:
    """(t, y): a state of 2 dof numbers in the place of u, where it can be nothing else."""
    if "v" in parts or "a" in parts or "y" in parts:
        return {name: part for name, part in parts.items() if name != "y"}
    shape = _core.read_array(who, "u", parts["u"]).shape
    if shape in {(times, dof), (dof, times)} or shape not in {(times, 2 * dof), (2 * dof, times)}:
        return parts
    return {"y" if name == "u" else name: part for name, part in parts.items()}


def _matrix(who: str, name: str, value: object, times: int, width: int, columns_first: bool = False) -> Array:
    """An array of shape (times, width), of that shape or transposed; of one mass also (times,)."""
    array = _core.read_array(who, name, value)
    if array.shape == (times,) and width == 1:
        return array.reshape(times, 1)
    straight, transposed = array.shape == (times, width), array.shape == (width, times)
    if straight or transposed:
        return array.T if transposed and (columns_first or not straight) else array
    shapes = "shape " + " or ".join(dict.fromkeys([f"({times}, {width})", f"({width}, {times})", *([f"({times},)"] if width == 1 else [])]))
    what = "y = (u, v) of" if name == "y" else "mass" if width == 1 else "masses"
    count = width // 2 if name == "y" else width
    _core.refuse(
        who, name, _described(array),
        f"{shapes}: {times} times, {what} {count}" if name == "y" else f"{shapes}: {times} times, {count} {what}",
        "", "wrong-size",
    )


def _named(name: str, matrix: Array) -> Columns:
    """A column a mass; those of only NaN are not known and left out."""
    columns = [(f"{name}{mass + 1}", np.require(matrix[:, mass], requirements="A")) for mass in range(matrix.shape[1])]
    return [(title, column) for title, column in columns if len(column) == 0 or not np.isnan(column).all()]


def _read_events(who: str, parts: dict[str, Any]) -> Columns | None:
    for name in ("impacts", "collisions", "events"):  # the second is the former name
        if name in parts:
            return read_impacts(who, parts[name])
    if "t_events" not in parts:
        return None
    lists = [_core.read_vector(who, "t_events", times) for times in parts["t_events"]]
    return [("t", np.sort(np.concatenate(lists)))] if lists else None


_EVENT_NAMES = {"u": "u{}", "v_before": "v{}-", "v_after": "v{}+"}


def read_impacts(who: str, given: object) -> Columns:
    """Only times, or a mapping or an object with t and what else is known, as ``Case.impacts`` has it."""
    get = given.get if isinstance(given, Mapping) else lambda name: getattr(given, name, None)
    times = get("t")
    if times is None:
        return [("t", _core.read_vector(who, "impacts", given))]
    t = _core.read_vector(who, "t of impacts", times)
    columns: Columns = [("t", t)]
    if (impulse := get("impulse")) is not None:
        columns.append(("impulse", _core.read_vector(who, "impulse of impacts", impulse)))
    for name, title in _EVENT_NAMES.items():
        if (value := get(name)) is None:
            continue
        array = _core.read_array(who, f"{name} of impacts", value)
        array = array.reshape(len(t), 1) if array.shape == (len(t),) else array
        if array.ndim != 2:
            _core.refuse(who, f"{name} of impacts", _described(array), f"shape ({len(t)}, dof)", "", "wrong-size")
        columns += [(title.format(mass + 1), array[:, mass]) for mass in range(array.shape[1])]
    for title, column in columns:
        if len(column) != len(t):
            _core.refuse(who, f"{title} of impacts", _described(column), f"{len(t)} numbers, as t", "", "wrong-size")
    return columns


def _described(value: object) -> str:
    if isinstance(value, (tuple, list)):
        return f"a {type(value).__name__} of {len(value)}"
    return _core.description(value)
