"""Callables and programs under test."""
from __future__ import annotations

import functools
import os
import traceback
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Union

from clackers import _core
from clackers._errors import InputError
from clackers._history import Columns, read_history
from clackers._problem import Problem

Solver = Callable[[Problem, float], object]
"""``solver(problem, h)``, or ``solver(problem, tolerance)``, returns a history; see ``clackers.verify``."""

Failure = tuple[bool, str, str, bool]
"""Whether the callable returned, sentence, last lines of the traceback, and whether smaller steps fail likewise."""


@dataclass(frozen=True)
class Program:
    """A program under test, a subject of ``clackers.verify`` as of the command's ``--exec``: each run is a process.

    Parameters
    ----------
    command : str
        For the shell, with ``{h}`` (the step [s]), ``{n}`` (the number of steps) or ``{tolerance}``; ``{case}`` is a
        json file with the problem, ``{case:text}`` the same as lines key=value, ``{out}`` the file for the history
        (without it: standard output), ``{events}`` a file for impacts. Each run has a folder of its own.
    timeout : float
        Time of one run [s]; then it is ended with all that it started.
    work : path
        Folder that keeps all runs; default a cache, where good runs are kept for 14 days and reused.
    fresh : bool
        Runs that were made before are made again.
    environment : list of str
        Variables of the environment that the program reads: other values of them make other runs.

    Examples
    --------
    >>> import clackers
    >>> solver = clackers.Program("echo 't,u1'; echo '0,1'; echo '20,{h}'")
    >>> clackers.verify(solver, case="stop", levels=1, samples_per_level=1).subject.kind
    'program'
    """

    command: str
    timeout: float = 60.0
    work: Union[str, "os.PathLike[str]", None] = None
    fresh: bool = False
    environment: Sequence[str] = ()

    def _arguments(self) -> tuple[str, float, str, bool, list[str]]:
        return (
            _core.read_text("Program", "command", self.command), _core.read_number("Program", "timeout", self.timeout),
            "" if self.work is None else _core.read_text("Program", "work", os.fspath(self.work)), bool(self.fresh),
            [_core.read_text("Program", "environment", each) for each in self.environment],
        )


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
