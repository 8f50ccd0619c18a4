"""Callables under test."""
from __future__ import annotations

import functools
import traceback
from collections.abc import Callable
from typing import Any

from clackers import _core
from clackers._errors import InputError
from clackers._history import Columns, read_history
from clackers._problem import Problem

Solver = Callable[[Problem, float], object]
"""``solver(problem, h)``, or ``solver(problem, tolerance)``, returns a history; see ``clackers.verify``."""

Failure = tuple[bool, str, str, bool]
"""Whether the callable returned, sentence, last lines of the traceback, and whether smaller steps fail likewise."""

# Mistakes that do not depend on the step.
_MISTAKES = (AttributeError, ImportError, NameError, NotImplementedError, SyntaxError, TypeError)

_LINES_OF_TRACEBACK = 6
_LONGEST = 400  # characters of a sentence


class Runs:
    """Makes the runs of a callable, and turns what it returns or raises into what a study takes."""

    def __init__(self, solver: Solver, name: str) -> None:
        self.name = name
        self.first_error: BaseException | None = None
        self._solver = solver
        self._problems: dict[int, tuple[_core.Problem, Problem]] = {}

    def __call__(self, problem: _core.Problem, resolution: float) -> tuple[Columns, Columns | None] | Failure:
        task = self._problem(problem)
        try:
            result = self._solver(task, resolution)
        except KeyboardInterrupt:
            raise
        except BaseException as error:  # SystemExit among them: it ends only this run
            return self._failed(False, error, isinstance(error, _MISTAKES), error.__traceback__)
        try:
            return read_history(f"{self.name}(problem, {resolution:g})", result, task.dof)
        except Exception as error:  # also what attributes and items of the result raise
            return self._failed(True, error, True, None)

    def _problem(self, core: _core.Problem) -> Problem:
        """The same object for every run of a case, so that a solver can keep what it prepared."""
        if id(core) not in self._problems:
            self._problems[id(core)] = (core, Problem(core))
        return self._problems[id(core)][1]

    def _failed(self, has_returned: bool, error: BaseException, would_repeat: bool, trace: Any) -> Failure:
        if self.first_error is None:
            self.first_error = error
        if isinstance(error, InputError) and has_returned:
            return has_returned, str(error), "", would_repeat
        # Behind the lines of a SyntaxError that show the place.
        whole = next(part for part in traceback.format_exception_only(type(error), error) if not part.startswith(" "))
        # Without the frame of this file.
        lines = "".join(traceback.format_tb(trace.tb_next if trace is not None else None)).splitlines()
        end = "\n".join(line.strip() for line in lines[-_LINES_OF_TRACEBACK:])
        return has_returned, _valid(" / ".join(whole.split("\n")).strip(" /")[:_LONGEST]), _valid(end), would_repeat


def _valid(text: str) -> str:
    """Without halves of surrogate pairs, which names of files may have."""
    return text.encode("utf-8", "replace").decode()


def name_of(solver: Solver) -> str:
    """The name of a function or a class; "solver" where there is none."""
    if isinstance(solver, functools.partial):
        return name_of(solver.func)
    name = getattr(solver, "__name__", type(solver).__name__)
    return "solver" if name == "<lambda>" else str(name)
