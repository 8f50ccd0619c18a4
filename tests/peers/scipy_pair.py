"""Two colliding masses by SciPy's solve_ivp, impacts as its terminal events.

    scipy_pair.py CONSTANTS.json METHOD STEP HISTORY EVENTS

STEP is the length of every step of a Runge-Kutta method, or "rtol=1e-9" for its own choice. HISTORY
has a row a step and both limits of each impact; EVENTS the times of the impacts.
"""
import json
import sys

import numpy
from scipy.integrate import solve_ivp


def main(constants, method, step, history, events):
    with open(constants) as file:
        p = json.load(file)

    def motion(_, y):
        return [y[1], -(p["c1"] * y[1] + p["k1"] * y[0]) / p["m1"],
                y[3], -(p["c2"] * y[3] + p["k2"] * y[2]) / p["m2"]]

    def gap(_, y):
        return y[0] - y[2]

    gap.terminal, gap.direction = True, -1
    if step.startswith("rtol="):
        options = {"rtol": float(step[5:]), "atol": 1e-2 * float(step[5:])}
    else:
        # No error can reach these, so that every step has its largest length.
        options = {"rtol": 1.0, "atol": 1e9, "max_step": float(step), "first_step": float(step)}
    t, y = 0.0, numpy.array([p["u1(0)"], p["v1(0)"], p["d2"], p["v2(0)"]])
    rows, hits = [(t, *y)], []
    while t < p["t_end"]:
        if "first_step" in options:
            options["first_step"] = min(float(step), p["t_end"] - t)
        run = solve_ivp(motion, (t, p["t_end"]), y, method=method, events=gap, **options)
        assert run.success, run.message
        rows += [(s, *run.y[:, i]) for i, s in enumerate(run.t)][1:]
        t, y = run.t[-1], run.y[:, -1].copy()
        if run.status == 1:
            impulse = -(1 + p["eta"]) * (y[1] - y[3]) / (1 / p["m1"] + 1 / p["m2"])
            y[1] += impulse / p["m1"]
            y[3] -= impulse / p["m2"]
            # The event's root is good to rounding, on either side; the next event must not be it.
            y[0] = y[2] = 0.5 * (y[0] + y[2])
            hits.append(t)
            rows.append((t, *y))
    numpy.savetxt(history, rows, delimiter=",", header="t,u1,v1,u2,v2")
    numpy.savetxt(events, hits)


if __name__ == "__main__":
    main(*sys.argv[1:])
