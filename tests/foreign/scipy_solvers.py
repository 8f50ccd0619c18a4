"""SciPy's solve_ivp as a foreign solver: the same lines as solvers.cpp, `method=scipy-DOP853 tolerance=1e-6 ...`."""
import math
import sys

import numpy
from scipy.integrate import solve_ivp


def run(words):
    """(t, rows of u1 v1 u2 v2) of the pair of section 2.2."""
    number = {key: float(value) for key, _, value in (word.partition("=") for word in words)
              if key not in ("method", "system")}
    X, r = number.get("X", 4 * number.get("N", 2) + 1), number.get("r", 3.0)
    xi, eta, end = number.get("xi1", 0.05), number.get("eta", 1.0), number.get("t_end", 20.0)
    eta = number.get("solver-eta", eta)
    m, sigma = (1.0, 1.0 / r), xi
    w2 = (1 - xi * xi) * X * X + xi * xi
    k = (1.0, m[1] * w2 * number.get("k2*", 1.0))
    method = next(word for word in words if word.startswith("method=")).removeprefix("method=scipy-")
    sign = 1 if (int(X) - 1) // 2 % 2 == 0 else -1
    u2 = -sign * r / X
    state = numpy.array([1.0, -sigma, u2, -sigma * u2])

    def flow(t, x):
        return [x[1], -2 * sigma * x[1] - k[0] / m[0] * x[0], x[3], -2 * sigma * x[3] - k[1] / m[1] * x[2]]

    def gap(t, x):
        return x[0] - x[2]
    gap.terminal, gap.direction = True, -1
    grid = numpy.arange(0, round(end / 0.01) + 1) * 0.01
    t, times, rows = 0.0, [], []
    tolerance = number["tolerance"]
    while t < end:
        wanted = grid[(grid >= t) & (grid <= end)] if not times else grid[(grid > times[-1]) & (grid <= end)]
        answer = solve_ivp(flow, (t, end), state, method=method, rtol=max(tolerance, 3e-14), atol=tolerance * 1e-2,
                           events=gap, t_eval=wanted)
        times.extend(answer.t)
        rows.extend(answer.y.T)
        if answer.status != 1:
            break
        t, state = answer.t_events[0][0], answer.y_events[0][0].copy()
        impulse = -(1 + eta) * (state[1] - state[3]) / (1 / m[0] + 1 / m[1])
        state[1] += impulse / m[0]
        state[3] -= impulse / m[1]
        state[2] = state[0] - 1e-15 if state[0] <= state[2] else state[2]
    return times, rows


def main():
    for line in sys.stdin:
        path, *words = line.split()
        with open(path, "w", encoding="ascii") as file:
            file.write("t,u1,v1,u2,v2\n")
            for t, row in zip(*run(words)):
                file.write(",".join(f"{value:.17g}" for value in (t, *row)) + "\n")


if __name__ == "__main__":
    main()
