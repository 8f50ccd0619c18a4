"""SciPy's solve_ivp with impacts as its terminal events.
    scipy_events.py PROBLEM.json RUNS [method=RK45] [grid=SECONDS] [direction=no]"""
import json
import sys
import time

import numpy
from scipy.integrate import solve_ivp


def move(problem, settings, tolerance, history):
    M, C, K = (numpy.array(problem[name], float) for name in "MCK")
    n, end = len(M), problem["end"]
    A = numpy.block([[numpy.zeros((n, n)), numpy.eye(n)], [-numpy.linalg.solve(M, K), -numpy.linalg.solve(M, C)]])
    events = []
    for contact in problem["contacts"]:
        b = numpy.array(contact["direction"], float)

        def gap(_, y, b=b, contact=contact):
            return b @ y[:n] - contact["gap"]

        gap.terminal, gap.direction = True, 0 if settings.get("direction") == "no" else -1
        events.append(gap)
    t, y = problem["start"]["t"], numpy.array(problem["start"]["u"] + problem["start"]["v"], float)
    rows, before, repeated = [(t, *y)], time.process_time(), 0
    while t < end:
        grid = None
        if "grid" in settings:
            grid = numpy.arange(numpy.ceil(t / float(settings["grid"])), end / float(settings["grid"]) + 0.5) * float(settings["grid"])
            grid = grid[(grid > t) & (grid <= end)]
        run = solve_ivp(lambda _, y: A @ y, (t, end), y, settings.get("method", "RK45"), grid, events=events, rtol=tolerance, atol=tolerance)
        if not run.success:
            sys.exit(run.message)
        rows += [(s, *run.y[:, i]) for i, s in enumerate(run.t)][grid is None:]
        if run.status == 0:
            break
        k = next(k for k, found in enumerate(run.t_events) if len(found))
        contact, t, y = problem["contacts"][k], run.t_events[k][-1], run.y_events[k][-1].copy()
        repeated = repeated + 1 if t - rows[-1][0] < 1e-9 else 0
        if repeated == 50:
            sys.exit(f"50 events at t = {t}")
        b = numpy.array(contact["direction"], float)
        if rows[-1][0] < t:
            rows.append((t, *y))
        push = numpy.linalg.solve(M, b)
        y[n:] -= (1 + contact["restitution"]) * (b @ y[n:]) / (b @ push) * push
        y[:n] -= (b @ y[:n] - contact["gap"]) / (b @ push) * push  # onto the surface: no second event there
        rows.append((t, *y))
    seconds = time.process_time() - before
    header = ",".join(["t", *(f"{name}{i + 1}" for name in "uv" for i in range(n))])
    numpy.savetxt(history, rows, delimiter=",", header=header, comments="", footer=f"# seconds {seconds}")


def main(file, runs, *words):
    settings = dict(word.split("=") for word in words)
    problem = json.load(open(file))["problem"]
    for line in open(runs):
        tolerance, _, history = line.rstrip("\n").split(" ", 2)
        move(problem, settings, float(tolerance), history)


main(*sys.argv[1:])
