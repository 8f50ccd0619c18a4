"""The task that a solver gets: matrices, contacts, start and end."""
from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from clackers import _core

Array = npt.NDArray[np.float64]


class Contact(NamedTuple):
    """A row of the contact condition g = direction . u - gap >= 0, with Newton's law of restitution.

    Attributes
    ----------
    direction : ndarray
        b, shape (dof,), dimensionless; (1, -1) keeps mass 1 above mass 2.
    gap : float
        [m]; contact happens at b . u = gap.
    restitution : float
        eta in [0, 1]; 1 is elastic. At an impact b . v(+) = -eta b . v(-).
    """

    direction: Array
    gap: float
    restitution: float


class Spring(NamedTuple):
    """A contact with a stiffness: the force ``stiffness * max(gap - direction . u, 0)`` along the direction, on u.

    Attributes
    ----------
    direction : ndarray
        b, shape (dof,), dimensionless.
    gap : float
        [m]; it is in contact where b . u < gap.
    stiffness : float
        Force over overlap [N/m].
    """

    direction: Array
    gap: float
    stiffness: float


class State(NamedTuple):
    """Displacements u [m] and velocities v [m/s] of all masses at time t [s].

    Attributes
    ----------
    t : float
        Time [s].
    u : ndarray
        Displacements [m], shape (dof,).
    v : ndarray
        Velocities [m/s], shape (dof,).
    """

    t: float
    u: Array
    v: Array


class GapEvent:
    """The gap of a contact as an event function of ``scipy.integrate.solve_ivp``.

    ``terminal`` is true and ``direction`` is -1: the integration ends where the gap closes.
    """

    terminal: bool = True
    direction: float = -1.0

    def __init__(self, problem: Problem, contact: int) -> None:
        self._problem = problem
        self.contact = contact
        """Number of the contact, from 0."""

    def __call__(self, t: float, y: npt.ArrayLike) -> float:
        return self._problem.gap(t, y, self.contact)


class Problem:
    """A structure M a + C v + K u = f(t), where it may collide, how it starts and when the run ends.

    All that a solver needs, and nothing of the exact solution. Arrays are read-only. The state of a
    first-order solver is y = (u, v), shape (2 dof,).

    A simulation with SciPy from impact to impact:

    >>> import clackers
    >>> from scipy.integrate import solve_ivp
    >>> problem = clackers.case("stop", eta=0.5).problem
    >>> t, y = problem.start.t, problem.y0
    >>> while t < problem.end:
    ...     run = solve_ivp(problem.rhs, (t, problem.end), y, events=problem.events, rtol=1e-9, atol=1e-12)
    ...     t, y = run.t[-1], run.y[:, -1]
    ...     if run.status == 1:
    ...         y = problem.impact(y)
    >>> round(float(t), 9)
    20.0
    """

    def __init__(self, core: _core.Problem) -> None:
        self._core = core
        self._M = core.mass
        self._C = core.damping
        self._K = core.stiffness
        self._start = State(*core.start)
        self._contacts = tuple(Contact(*row) for row in core.contacts)
        self._springs = tuple(Spring(*row) for row in core.springs)

    @property
    def dof(self) -> int:
        """Number of degrees of freedom."""
        return self._core.dof

    @property
    def M(self) -> Array:
        """Mass matrix [kg], shape (dof, dof), symmetric positive definite."""
        return self._M

    @property
    def C(self) -> Array:
        """Damping matrix [N s/m], shape (dof, dof), symmetric."""
        return self._C

    @property
    def K(self) -> Array:
        """Stiffness matrix [N/m], shape (dof, dof), symmetric."""
        return self._K

    @property
    def contacts(self) -> tuple[Contact, ...]:
        """Where the structure may collide; empty for no contact."""
        return self._contacts

    @property
    def springs(self) -> tuple[Spring, ...]:
        """The contacts that have a stiffness in place of a restitution, such as that of ``penalized-pair``."""
        return self._springs

    @property
    def start(self) -> State:
        """Time [s], displacements [m] and velocities [m/s] at the start."""
        return self._start

    @property
    def end(self) -> float:
        """End of the run [s]."""
        return self._core.end

    @property
    def y0(self) -> Array:
        """(u, v) at the start, shape (2 dof,); a new array."""
        return np.concatenate([self._start.u, self._start.v])

    def load(self, t: float) -> Array:
        """The load f(t); zero where there is none.

        Parameters
        ----------
        t : float
            Time [s].

        Returns
        -------
        ndarray
            [N], shape (dof,).

        Raises
        ------
        InputError
            For a time that is no number.

        Examples
        --------
        >>> import clackers
        >>> clackers.case("three-parameter").problem.load(0.0)
        array([0., 0.])
        """
        return self._core.load(t)

    def rhs(self, t: float, y: npt.ArrayLike) -> Array:
        """dy/dt = (v, M^-1 (f(t) - C v - K u - p(u))) of y = (u, v), while nothing collides.

        p are the forces of ``springs`` and of nonlinear springs.

        Parameters
        ----------
        t : float
            Time [s].
        y : array_like
            Shape (2 dof,).

        Returns
        -------
        ndarray
            Shape (2 dof,).

        Raises
        ------
        InputError
            For another shape.

        Examples
        --------
        >>> import clackers
        >>> clackers.case("sdof", xi1=0).problem.rhs(0.0, [1.0, 0.0])
        array([ 0., -1.])
        """
        return self._core.rhs(t, y)

    def gap(self, t: float, y: npt.ArrayLike, contact: int = 0) -> float:
        """The gap of a contact in the state y = (u, v): open where positive.

        Parameters
        ----------
        t : float
            Not used; solvers pass it to event functions.
        y : array_like
            Shape (2 dof,).
        contact : int
            Number in ``contacts``, from 0.

        Returns
        -------
        float
            [m]

        Raises
        ------
        InputError
            For another shape, or a contact that is not there.

        Examples
        --------
        >>> import clackers
        >>> clackers.case("stop").problem.gap(0.0, [0.25, 1.0])
        0.25
        """
        return self._core.gap(y, contact)

    @property
    def events(self) -> list[GapEvent]:
        """The gaps as event functions of ``scipy.integrate.solve_ivp``, one a contact, terminal."""
        return [GapEvent(self, number) for number in range(len(self._contacts))]

    def impact(self, y: npt.ArrayLike, contact: int | None = None) -> Array:
        """The state after an impact in the state y = (u, v), by Newton's law.

        v(+) = v - (1 + eta) (b . v) / (b . M^-1 b) M^-1 b.

        Parameters
        ----------
        y : array_like
            Shape (2 dof,).
        contact : int, optional
            Number in ``contacts``, from 0; default that whose gap is nearest to 0.

        Returns
        -------
        ndarray
            Shape (2 dof,); a new array.

        Raises
        ------
        InputError
            Where that contact opens, b . v > 0.

        Examples
        --------
        >>> import clackers
        >>> clackers.case("stop", eta=0.5).problem.impact([0.0, -2.0])
        array([0., 1.])
        """
        return self._core.impact(y, contact)

    def __repr__(self) -> str:
        return f"<clackers.Problem: dof {self.dof}, contacts {len(self._contacts)}, end {self.end:g} s>"
