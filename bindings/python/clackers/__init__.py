"""Exact motions of colliding structures, and verdicts on time-integration methods.

>>> import clackers
>>> case = clackers.case("three-parameter", N=2, xi1=0.05)
>>> u, v, a = case.response([0.0, 1.0, 2.0])
>>> u.shape
(3, 2)
"""
from clackers import plot
from clackers._case import Admissibility, Case, Impacts, Kinematics, admissibility, case
from clackers._core import version as __version__
from clackers._errors import Error, FileError, InputError, Interrupted, SolverError
from clackers._problem import Contact, GapEvent, Problem, Spring, State
from clackers._record import Diagnosis, Figure, Record, Subject, load
from clackers._solver import Program, Solver
from clackers._study import Comparison, check, compare, verify
from clackers._table import Column, Table, catalogue, explain

__all__ = [
    "Admissibility",
    "Case",
    "Column",
    "Comparison",
    "Contact",
    "Diagnosis",
    "Error",
    "Figure",
    "FileError",
    "GapEvent",
    "Impacts",
    "InputError",
    "Interrupted",
    "Kinematics",
    "Problem",
    "Program",
    "Record",
    "Solver",
    "SolverError",
    "Spring",
    "State",
    "Subject",
    "Table",
    "__version__",
    "admissibility",
    "case",
    "catalogue",
    "check",
    "compare",
    "explain",
    "load",
    "plot",
    "verify",
]
