"""Cases: problems together with their exact motions."""
from __future__ import annotations

import functools
import inspect
import json
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, fields
from typing import Any, Literal, NamedTuple, overload

import numpy as np
import numpy.typing as npt

from clackers import _core
from clackers._errors import InputError
from clackers._problem import Array, Problem
from clackers._table import Table

Side = Literal["left", "right"]
"""Which of two flights is meant where they meet: before an impact, or after it."""


class Kinematics(NamedTuple):
    """Displacements, velocities and accelerations, or bounds or amplitudes of them.

    The shape is (time, dof), or (dof,) for a single time.

    Attributes
    ----------
    u : ndarray
        Displacements [m].
    v : ndarray
        Velocities [m/s].
    a : ndarray
        Accelerations [m/s^2].
    """

    u: Array
    v: Array
    a: Array


Buffers = tuple[Array, Array, Array | None]


@dataclass(frozen=True)
class Impacts:
    """Impacts of a motion, a row each: arrays of shape (impact,) and (impact, dof).

    Attributes
    ----------
    index : ndarray of int
        1 for the first.
    t : ndarray
        The double nearest to the true instant [s].
    t_lo : ndarray
        Start of the interval that certainly holds the true instant [s].
    t_hi : ndarray
        End of that interval [s].
    contact : ndarray of int
        Number in ``Problem.contacts``, from 0.
    u : ndarray
        Displacements [m], shape (impact, dof).
    v_before : ndarray
        Velocities just before [m/s], shape (impact, dof).
    v_after : ndarray
        Velocities just after [m/s], shape (impact, dof).
    a_before : ndarray
        Accelerations just before [m/s^2], shape (impact, dof).
    a_after : ndarray
        Accelerations just after [m/s^2], shape (impact, dof).
    impulse : ndarray
        Along the direction of the contact [N s].
    energy_before : ndarray
        Of the whole structure [J].
    energy_after : ndarray
        Of the whole structure [J].
    """

    index: npt.NDArray[np.int64]
    t: Array
    t_lo: Array
    t_hi: Array
    contact: npt.NDArray[np.int64]
    u: Array
    v_before: Array
    v_after: Array
    a_before: Array
    a_after: Array
    impulse: Array
    energy_before: Array
    energy_after: Array

    def __len__(self) -> int:
        return len(self.index)

    def __repr__(self) -> str:
        shown = ", ".join(f"{field.name} {getattr(self, field.name).shape}" for field in fields(self))
        return f"<clackers.Impacts: {shown}>"


class Case:
    """A problem with its exact motion; ``clackers.case()`` makes it.

    Examples
    --------
    >>> import clackers
    >>> case = clackers.case("three-parameter", N=2, xi1=0.05)
    >>> case.dof, case.end
    (2, 20.0)
    >>> case.parameters
    {'N': 2.0, 'xi1': 0.05, 'a_t': 1.0}
    """

    def __init__(self, core: _core.Case, threshold: float | None = None) -> None:
        self._core = core
        self._threshold = threshold
        self._problem = Problem(core.problem)

    @property
    def name(self) -> str:
        """The name in ``clackers.catalogue("cases")``."""
        return self._core.name

    @property
    def summary(self) -> str:
        """What the case is, in a sentence."""
        return self._core.summary

    @property
    def equations(self) -> str:
        """The equations of the paper that define it."""
        return self._core.equations

    @property
    def parameters(self) -> dict[str, float | str]:
        """All parameters with the values in use: numbers, or words such as ``coupling="dense"``."""
        return self._core.parameters

    @property
    def constants(self) -> dict[str, float]:
        """Derived constants by name, for a pair among them ``r*`` and ``margin``, the admissibility margin."""
        return self._core.constants

    @property
    def indicators(self) -> dict[str, float]:
        """Indicators of severity and stiffness by name, with the threshold that they depend on."""
        return self._core.indicators

    @property
    def dof(self) -> int:
        """Number of masses."""
        return self._core.dof

    @property
    def end(self) -> float:
        """End of the run [s]; the motion is known in [0, end]."""
        return self._core.end

    @property
    def accumulates(self) -> bool:
        """Whether infinitely many impacts come before a contact rests; ``impact_count`` is that of the resolved ones."""
        return self._core.accumulates

    @property
    def problem(self) -> Problem:
        """The task that a solver gets."""
        return self._problem

    @property
    def mesh(self) -> dict[str, Any] | None:
        """Of bars and strings the mesh that ``problem`` is made of, as programs get it: mass ("lumped", "consistent" or
        "massless"), nodes (body, x [m], dof or None, fixed) and elements (nodes, stiffness E A [N], density rho A [kg/m]),
        counted from 1."""
        text = self._core.mesh
        return None if text is None else json.loads(text)

    @overload
    def response(
        self, t: npt.ArrayLike, side: Side = "right", out: tuple[Array, Array, Array] | None = None
    ) -> Kinematics: ...

    @overload
    def response(self, t: npt.ArrayLike, side: Side, out: tuple[Array, Array, None]) -> tuple[Array, Array, None]: ...

    @overload
    def response(
        self, t: npt.ArrayLike, side: Side = "right", *, out: tuple[Array, Array, None]
    ) -> tuple[Array, Array, None]: ...

    def response(
        self, t: npt.ArrayLike, side: Side = "right", out: Buffers | None = None
    ) -> Kinematics | tuple[Array, Array, None]:
        """The exact motion at times ``t``.

        Parameters
        ----------
        t : array_like
            Times [s], each in [0, end], in any order; a number is one time. A pair at 320 equidistant times or more
            takes a quarter of the time; one value in ten thousand then has another last bit.
        side : {"right", "left"}
            Which of two flights is evaluated where a time is the double nearest to an impact.
        out : tuple of ndarray, optional
            (u, v, a) to write to and to return: float64, writable and C-contiguous; a may be None.

        Returns
        -------
        Kinematics
            u [m], v [m/s] and a [m/s^2] of shape (time, dof), or (dof,) for a single time.

        Raises
        ------
        InputError
            For times that are NaN, outside of [0, end] or not one-dimensional.

        Examples
        --------
        >>> import clackers, numpy
        >>> case = clackers.case("three-parameter")
        >>> u, v, a = case.response(numpy.linspace(0, case.end, 1001))
        >>> u.shape
        (1001, 2)
        """
        u, v, a = _core.response(self._core, t, side, out)
        return (u, v, None) if a is None else Kinematics(u, v, a)

    def envelope(self, t: npt.ArrayLike) -> Kinematics:
        """The amplitudes that displacements, velocities and accelerations have around ``t``.

        Parameters
        ----------
        t : array_like
            Times [s], each in [0, end], in any order; a number is one time.

        Returns
        -------
        Kinematics
            In u [m], v [m/s] and a [m/s^2].

        Raises
        ------
        InputError
            As ``response`` does.

        Examples
        --------
        >>> import clackers
        >>> clackers.case("sdof", xi1=0).envelope(1.0).u
        array([1.])
        """
        return Kinematics(*_core.envelope(self._core, t))

    def error_bound(self, t: npt.ArrayLike) -> Kinematics:
        """Proved bounds on the error of ``response(t)``.

        Parameters
        ----------
        t : array_like
            Times [s], each in [0, end], in any order; a number is one time.

        Returns
        -------
        Kinematics
            In u [m], v [m/s] and a [m/s^2].

        Raises
        ------
        InputError
            As ``response`` does.

        Examples
        --------
        >>> import clackers
        >>> bool((clackers.case("three-parameter").error_bound([1.0, 2.0]).u < 1e-15).all())
        True
        """
        return Kinematics(*_core.error_bound(self._core, t))

    def impact_count(self, t: float | None = None) -> int:
        """The number of impacts.

        Parameters
        ----------
        t : float, optional
            Those in [0, t], in seconds; default the whole run.

        Returns
        -------
        int

        Raises
        ------
        InputError
            For a time outside of [0, end].

        Examples
        --------
        >>> import clackers
        >>> clackers.case("three-parameter").impact_count()
        6
        """
        return _core.impact_count(self._core, t)

    def impacts(self, first: int = 1, last: int | None = None) -> Impacts:
        """The impacts from number ``first`` to number ``last``, both included, counted from 1.

        Parameters
        ----------
        first : int
            Number of the first; the one behind the last impact gives none.
        last : int, optional
            Number of the last; default all that follow, at most a million.

        Returns
        -------
        Impacts

        Raises
        ------
        InputError
            For a ``last`` beyond the last impact, or a ``first`` beyond the one behind it.

        Examples
        --------
        >>> import clackers
        >>> clackers.case("three-parameter").impacts(last=2).t.round(6)
        array([1.572764, 4.718291])
        """
        return Impacts(**_core.impacts(self._core, first, last))

    def impact_table(self) -> Table:
        """The impacts as a table, at most a million; ``impacts()`` has them as arrays and by range.

        Returns
        -------
        Table
            Columns k, t [s], u1 [m], v1-, v1+ [m/s] and so on, impulse [N s], energy_before, energy_after [J].

        Raises
        ------
        InputError
            For more than a million.

        Examples
        --------
        >>> import clackers
        >>> clackers.case("stop").impact_table()["k"]
        array([1, 2, 3, 4, 5, 6])
        """
        return Table(*_core.impact_table(self._core))

    def collisions(self) -> Table:
        """The former name of ``impact_table``.

        Returns
        -------
        Table

        Raises
        ------
        InputError
            For more than a million.

        Examples
        --------
        >>> import clackers
        >>> len(clackers.case("stop").collisions()["k"])
        6
        """
        return self.impact_table()

    def energies(self, t: npt.ArrayLike) -> Table:
        """Where the energy is at times ``t``.

        Parameters
        ----------
        t : array_like
            Times [s], each in [0, end], in any order; a number is one time.

        Returns
        -------
        Table
            Columns t, side, kinetic, potential, dissipated, lost, total [J] and momentum, and work [J] before the total
            where loads vary or belts move.
            Where a time is the double nearest to an impact two rows stand, side -1 and side 1.

        Raises
        ------
        InputError
            As ``response`` does.

        Examples
        --------
        >>> import clackers
        >>> clackers.case("stop", xi1=0).energies([0.0, 1.0])["total"]
        array([0.5, 0.5])
        """
        return Table(*_core.energies(self._core, t))

    def forces(self, t: npt.ArrayLike) -> Table:
        """Forces of contacts that stay closed, of one-sided springs and of dry friction at times ``t``.

        Parameters
        ----------
        t : array_like
            Times [s], each in [0, end], in any order; a number is one time.

        Returns
        -------
        Table
            Columns t, side, force1 and so on, 0 for open contacts [N], impulse1 and so on from t = 0 on, those of impacts
            among them [N s], then friction1 and so on [N]. Two rows at impacts as in ``energies``.

        Raises
        ------
        InputError
            As ``response`` does, for a case without any of them, and for more than 1e6 impacts.

        Examples
        --------
        >>> import clackers
        >>> clackers.case("pressed-oscillator").forces(20.0)["force1"]
        array([0.5])
        """
        return Table(*_core.forces(self._core, t))

    def digits(self, digits: int, t: npt.ArrayLike | None = None) -> Table:
        """The response at times ``t``, or without them the impacts, correctly rounded to ``digits`` digits.

        Parameters
        ----------
        digits : int
            Significant digits, 1 to 1000.
        t : array_like, optional
            Times [s], each in [0, end], as they stand in doubles.

        Returns
        -------
        Table
            Columns t, side, u1 [m], v1 [m/s], a1 [m/s^2] and so on, or those of ``impact_table``, whose t is then the true
            instant: texts, for ``decimal`` or ``mpmath``.

        Raises
        ------
        InputError
            For a motion without an enclosure, and where the module was built without Arb.

        Examples
        --------
        >>> import clackers
        >>> str(clackers.case("stop").digits(30, t=1.0)["u1"][0])
        '0.514952215250232861108811314440'
        """
        return Table(*_core.digits(self._core, digits, t))

    def points(self, t: npt.ArrayLike | None, at: npt.ArrayLike) -> Table:
        """Points of the case's bars or string at times ``t``: the continuum, of which ``problem`` is a mesh.

        Parameters
        ----------
        t : array_like or None
            Times [s], each in [0, end], in any order; a number is one time. None: those where the contact closes and opens.
        at : array_like
            Places x [m], 0 at the contact (``string-on-obstacle``: at its left end); negative in the left one of two bars.

        Returns
        -------
        Table
            Columns t, side, then u1 [m], v1 [m/s], stress1 [N/m^2] (of a string transverse_force1 [N]) and so on,
            numbered by place, force [N], impulse [N s] of the contact, kinetic, elastic and potential energy [J]. Where
            something jumps two rows stand, side -1 and side 1.

        Raises
        ------
        InputError
            As ``response`` does; for a case with neither, and for places outside of them.

        Examples
        --------
        >>> import clackers
        >>> clackers.case("bar-wall").points([1.0], at=[0.25])["stress1"]
        array([-1.])
        """
        return Table(*_core.points(self._core, t, at))

    def sensitivity(self, name: str, t: npt.ArrayLike) -> Table:
        """The derivative of the motion by a parameter.

        Parameters
        ----------
        name : str
            m1 m2 k1 k2 c1 c2 eta gap u10 u20 v10 v20 with all else fixed, or a parameter of the case with all that
            follows from it; ``class:m1`` where both have the name.
        t : array_like
            Times [s], each in [0, end], in any order; a number is one time.

        Returns
        -------
        Table
            Columns t, side, du1, dv1, da1 and so on.

        Raises
        ------
        InputError
            For an unknown name and where there is no derivative.

        Examples
        --------
        >>> import clackers
        >>> table = clackers.case("sdof").sensitivity("k1", [0.0, 1.0])
        >>> [column.unit for column in table.columns]
        ['s', '', 'm^2/N', 'm^2/N/s', 'm^2/N/s^2']
        """
        return Table(*_core.sensitivity(self._core, name, t))

    def spectrum(self, n: int, highest: float) -> Table:
        """The Fourier transform of the displacements over the run.

        Parameters
        ----------
        n : int
            Number of frequencies, in [2, 1e9].
        highest : float
            They go from 0 to this [rad/s].

        Returns
        -------
        Table
            Columns omega [rad/s], re1, im1 [m s] and so on.

        Raises
        ------
        InputError
            For numbers outside of these ranges.

        Examples
        --------
        >>> import clackers
        >>> clackers.case("stop").spectrum(3, 2.0)["omega"]
        array([0., 1., 2.])
        """
        return Table(*_core.spectrum(self._core, n, highest))

    def tables(self) -> dict[str, Table]:
        """What ``clackers show`` shows of the case.

        Returns
        -------
        dict of Table
            Parameters, constants, indicators, first impacts, and of a pair the harmonics and its conditioning.

        Raises
        ------
        InputError
            For a threshold below which too many harmonics count.

        Examples
        --------
        >>> import clackers
        >>> list(clackers.case("stop").tables())
        ['parameters', 'constants', 'indicators', 'impacts']
        """
        found = [Table(*rows) for rows in _core.case_tables(self._core, self._threshold)]
        return {table.schema.split("/")[1]: table for table in found}

    def __reduce__(self) -> tuple[Callable[[], Case], tuple[()]]:
        return functools.partial(case, self.name, threshold=self._threshold, **self.parameters), ()

    def _repr_html_(self) -> str:
        return "".join(table._repr_html_() for table in self.tables().values())

    def __repr__(self) -> str:
        given = ", ".join(f"{name}={value if isinstance(value, str) else format(value, 'g')}" for name, value in self.parameters.items())
        return f"<clackers.Case {self.name} ({given}): dof {self.dof}, end {self.end:g} s>"


class Admissibility(NamedTuple):
    """How far the masses of a pair stay apart away from equilibrium.

    Attributes
    ----------
    r_star : float
        Limit of slow over fast mass; infinity for equal frequencies.
    margin : float
        Smallest gap between impacts relative to the slow displacement; the closed form holds where it is positive.
    """

    r_star: float
    margin: float


def admissibility(X: float, r: float) -> Admissibility:
    """The admissibility of a pair, admissible or not.

    Parameters
    ----------
    X : float
        Ratio of frequencies, odd or 1 over an odd number.
    r : float
        Ratio of masses m1/m2, in [1e-60, 1e60].

    Returns
    -------
    Admissibility

    Raises
    ------
    InputError
        Outside of these ranges.

    Examples
    --------
    >>> import clackers
    >>> round(clackers.admissibility(X=9, r=3).margin, 6)
    0.320295
    """
    return Admissibility(*_core.admissibility(X, r))


def case(name: str | None = None, /, *, threshold: float | None = None, **parameters: float | str) -> Case:
    """A case of ``clackers.catalogue("cases")`` with its parameters.

    Parameters
    ----------
    name : str, optional
        Default three-parameter.
    threshold : float, optional
        Share of the spectral peak from which a harmonic counts in the indicators, in (0, 1); default 0.1.
    **parameters : float or str
        Those of the case; what is not given keeps its default.

    Returns
    -------
    Case

    Raises
    ------
    InputError
        For unknown names and for values outside of their range.

    Examples
    --------
    >>> import clackers
    >>> clackers.case("synchronized-pair", X=9, r=3, eta=0.8)
    <clackers.Case synchronized-pair (m1=1, k1=1, xi1=0.05, A=1, X=9, r=3, eta=0.8, t_end=20): dof 2, end 20 s>
    >>> clackers.case("assembly", pairs=2, coupling="dense").dof
    4
    """
    with known_arguments(case, name, parameters):
        return Case(_core.Case(name, parameters, threshold), threshold)


@contextmanager
def known_arguments(function: Callable[..., object], name: str | None, parameters: Mapping[str, object]) -> Iterator[None]:
    """A name that is no parameter of a case may be a mistyped argument of the function: the refusal lists both."""
    try:
        yield
        return
    except InputError as error:
        if error.code != "unknown-name":
            raise
        refused = error
    known = list(_core.Case(name or None, {}, None).parameters)
    for given in parameters:
        if given not in known:
            own = [each.name for each in inspect.signature(function).parameters.values() if each.kind is each.KEYWORD_ONLY]
            _core.refuse_name(f"argument of clackers.{function.__name__}", given, [*known, *own])
    raise refused
