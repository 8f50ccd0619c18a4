"""SciPy's solve_ivp as a foreign solver: the same lines as solvers.cpp, `method=scipy-DOP853 tolerance=1e-6 ...`."""
import math
import sys

import numpy
from scipy.integrate import solve_ivp


class Problem:
    """M a + C v + K u = loads, G u >= gap: the pair of section 2.2, or of a file (assemblies/problem.hpp)."""

    def __init__(self, number, path):
        if path:
            self.read(path)
        else:
            self.pair(number)
        self.K[-1, -1] *= number.get("k2*", 1.0)
        self.M[0, 0] *= number.get("m1*", 1.0)
        self.C = self.C * number.get("c*", 1.0)
        if "solver-eta" in number:
            self.eta[:] = number["solver-eta"]
        self.loads[:, 1] *= number.get("load*", 1.0)
        self.loads[:, 3] -= self.loads[:, 2] * number.get("load-late", 0.0)
        self.inverse = numpy.linalg.inv(self.M)

    def pair(self, number):
        X, r = number.get("X", 4 * number.get("N", 2) + 1), number.get("r", 3.0)
        xi = number.get("xi1", 0.05)
        sign = 1 if (int(X) - 1) // 2 % 2 == 0 else -1
        self.M = numpy.diag([1.0, 1.0 / r])
        self.C = 2 * xi * self.M
        self.K = numpy.diag([1.0, ((1 - xi * xi) * X * X + xi * xi) / r])
        self.u0 = numpy.array([1.0, -sign * r / X])
        self.v0 = -xi * self.u0
        self.G, self.gap, self.eta = numpy.array([[1.0, -1.0]]), numpy.zeros(1), numpy.array([number.get("eta", 1.0)])
        self.loads, self.end = numpy.zeros((0, 4)), number.get("t_end", 20.0)

    def read(self, path):
        with open(path, encoding="ascii") as file:
            numbers = [float(word) for word in file.read().split()]
        n, contacts, loads, self.end = int(numbers[0]), int(numbers[1]), int(numbers[2]), numbers[3]
        rest = iter(numbers[4:])

        def take(rows, columns):
            return numpy.array([[next(rest) for _ in range(columns)] for _ in range(rows)]).reshape(rows, columns)
        self.M, self.C, self.K = take(n, n), take(n, n), take(n, n)
        self.u0, self.v0 = take(1, n)[0], take(1, n)[0]
        block = take(contacts, n + 2)
        self.G, self.gap, self.eta = block[:, :n], block[:, n], block[:, n + 1]
        self.loads = take(loads, 4)

    def flow(self, t, x):
        n = len(self.u0)
        force = -self.C @ x[n:] - self.K @ x[:n]
        for mass, amplitude, frequency, phase in self.loads:
            force[int(mass) - 1] += amplitude * math.cos(frequency * t + phase)
        return numpy.concatenate([x[n:], self.inverse @ force])

    def strike(self, x, active, one_mass):
        n = len(self.u0)
        G = self.G[active]
        impulse = numpy.linalg.solve(G @ self.inverse @ G.T, -(1 + self.eta[active]) * (G @ x[n:]))
        jump = self.inverse @ G.T @ impulse
        if one_mass:  # as from a wall: restitution is right, momentum is not
            whole = G @ jump
            jump[1:] = 0.0
            jump[0] *= (whole / (G @ jump))[0]
        x[n:] += jump


def run(words):
    """(t, rows of u and v)."""
    path = next((word.partition("=")[2] for word in words if word.startswith("problem=")), "")
    number = {key: float(value or 1) for key, _, value in (word.partition("=") for word in words)
              if key not in ("method", "system", "problem")}
    p = Problem(number, path)
    n, end, tolerance = len(p.u0), p.end, number["tolerance"]
    method = next(word for word in words if word.startswith("method=")).removeprefix("method=scipy-")
    events = []
    for row, gap in zip(p.G, p.gap):
        def event(t, x, row=row, gap=gap):
            return row @ x[:n] - gap
        event.terminal, event.direction = "not-terminal" not in number, 0 if "any-direction" in number else -1
        events.append(event)
    spacing = number.get("spacing", 0.01)
    grid = numpy.arange(0, round(end / spacing) + 1) * spacing
    state = numpy.concatenate([p.u0, p.v0])
    t, times, rows, impacts = 0.0, [], [], 0
    atol = number.get("atol", tolerance * 1e-2)
    while t < end:
        wanted = grid[(grid >= t) & (grid <= end)] if not times else grid[(grid > times[-1]) & (grid <= end)]
        shift = t if "load-restarts" in number else 0.0
        if "dense" in number or "own-steps" in number:
            wanted = None
        answer = solve_ivp(lambda at, x: p.flow(at - shift, x), (t, end), state, method=method,
                           rtol=max(tolerance, 3e-14), atol=atol,
                           events=events if impacts < number.get("most-impacts", math.inf) else None,
                           t_eval=wanted, dense_output="dense" in number)
        if "dense" in number:
            reached = grid[(grid > (times[-1] if times else -1.0)) & (grid <= answer.t[-1])]
            times.extend(reached)
            rows.extend(answer.sol(reached).T if len(reached) else [])
        else:
            times.extend(answer.t)
            rows.extend(answer.y.T if len(answer.t) else [])
        if answer.status != 1 or impacts > 200:
            break
        first = min((found[0], i) for i, found in enumerate(answer.t_events) if len(found))[1]
        t, state = answer.t_events[first][0], answer.y_events[first][0].copy()
        if "last-row" in number:
            state = numpy.array(rows[-1])
        gaps, speeds = p.G @ state[:n] - p.gap, p.G @ state[n:]
        active = [i for i in range(len(gaps)) if i == first or (gaps[i] < 1e-4 + 10 * tolerance and speeds[i] < 0)]
        p.strike(state, active, "one-mass" in number)
        impacts += 1
        if not path:
            state[1] = state[0] - 1e-15 if state[0] <= state[1] else state[1]
    return times, rows


def main():
    for line in sys.stdin:
        path, *words = line.split()
        times, rows = run(words)
        n = len(rows[0]) // 2
        with open(path, "w", encoding="ascii") as file:
            file.write("t," + ",".join(f"u{i + 1},v{i + 1}" for i in range(n)) + "\n")
            for t, row in zip(times, rows):
                file.write(",".join(f"{value:.17g}" for value in (t, *(x for i in range(n) for x in (row[i], row[n + i]))))
                           + "\n")


if __name__ == "__main__":
    main()
