"""Solvers that the tests judge."""
import numpy as np
from scipy.integrate import solve_ivp


def leapfrog(problem, h, restitution=None, mass=1.0):
    """Symplectic Euler in its staggered form, with Newton's law at the end of the step that closes the gap."""
    n = round(problem.end / h)
    dof = problem.dof
    M = problem.M.copy()
    M[0, 0] *= mass
    inverse = np.linalg.inv(M)
    start, u, v = problem.start
    contacts = [(contact.direction, contact.gap, contact.restitution if restitution is None else restitution)
                for contact in problem.contacts]
    t, us, vs = np.linspace(start, problem.end, n + 1), np.empty((n + 1, dof)), np.empty((n + 1, dof))
    us[0], vs[0] = u, v
    for i in range(n):
        a = inverse @ (problem.load(t[i]) - problem.C @ v - problem.K @ u)
        v = v + h * a
        u = u + h * v
        for b, gap, eta in contacts:
            rate = b @ v
            if b @ u - gap < 0 and rate < 0:
                v = v - (1 + eta) * rate / (b @ inverse @ b) * inverse @ b
        us[i + 1], vs[i + 1] = u, v
    return t, us, vs


def event_driven(problem, h, restitution=None, mass=1.0):
    """Exact flights (matrix exponential) by steps of h, impacts located by bisection within a step."""
    from scipy.linalg import expm

    dof = problem.dof
    M = problem.M.copy()
    M[0, 0] *= mass
    inverse = np.linalg.inv(M)
    A = np.block([[np.zeros((dof, dof)), np.eye(dof)], [-inverse @ problem.K, -inverse @ problem.C]])
    contact = problem.contacts[0]
    b = np.concatenate([contact.direction, np.zeros(dof)])
    eta = contact.restitution if restitution is None else restitution
    step = expm(A * h)
    t, y = problem.start.t, problem.y0
    times, states = [t], [y]
    n = round(problem.end / h)
    for i in range(n):
        end = (i + 1) * h
        left = end - t
        while True:
            new = (step if left == h else expm(A * left)) @ y
            if b @ new - contact.gap >= 0:
                break
            lo, hi = 0.0, left
            while hi - lo > 1e-15 * max(t, 1.0):
                middle = 0.5 * (lo + hi)
                lo, hi = (lo, middle) if b @ (expm(A * middle) @ y) - contact.gap < 0 else (middle, hi)
            y = expm(A * lo) @ y
            t += lo
            left -= lo
            times.append(t), states.append(y)
            rate = contact.direction @ y[dof:]
            y = y.copy()
            y[dof:] -= (1 + eta) * rate / (contact.direction @ inverse @ contact.direction) * (inverse @ contact.direction)
            times.append(t), states.append(y)
        t, y = end, new
        times.append(t), states.append(y)
    states = np.array(states)
    return np.array(times), states[:, :dof], states[:, dof:]


def scipy_flights(problem, tolerance):
    """RK45 of SciPy from impact to impact: a list of the results of the flights."""
    t, y = problem.start.t, problem.y0
    flights = []
    while t < problem.end:
        run = solve_ivp(problem.rhs, (t, problem.end), y, method="RK45", events=problem.events,
                        rtol=tolerance, atol=1e-3 * tolerance)
        flights.append(run)
        t, y = run.t[-1], run.y[:, -1]
        if run.status == 1:
            y = problem.impact(y)
    return flights
