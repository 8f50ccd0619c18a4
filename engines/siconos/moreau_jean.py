"""Siconos: Moreau-Jean time stepping with theta = 0.5 and Newton's impact law.
    moreau_jean.py PROBLEM.json RUNS [theta=0.5]"""
import json
import sys
import time

import numpy
import siconos.kernel as sk


def move(problem, theta, steps, history):
    M, C, K = (numpy.array(problem[name], float) for name in "MCK")
    start, end, n = problem["start"], problem["end"], len(M)
    h = (end - start["t"]) / steps
    system = sk.LagrangianLinearTIDS(numpy.array(start["u"], float), numpy.array(start["v"], float), M, K, C)
    model = sk.NonSmoothDynamicalSystem(start["t"], end + h)
    model.insertDynamicalSystem(system)
    for contact in problem["contacts"]:
        relation = sk.LagrangianLinearTIR(numpy.array([contact["direction"]], float), numpy.array([-contact["gap"]], float))
        model.link(sk.Interaction(sk.NewtonImpactNSL(contact["restitution"]), relation), system)
    simulation = sk.TimeStepping(model, sk.TimeDiscretisation(start["t"], h), sk.MoreauJeanOSI(theta), sk.LCP())
    rows, before = [[start["t"], *system.q(), *system.velocity()]], time.process_time()
    for k in range(1, steps + 1):
        simulation.computeOneStep()
        rows.append([end if k == steps else start["t"] + k * h, *system.q(), *system.velocity()])
        simulation.nextStep()
    seconds = time.process_time() - before
    header = ",".join(["t", *(f"{name}{i + 1}" for name in "uv" for i in range(n))])
    numpy.savetxt(history, rows, delimiter=",", header=header, comments="", footer=f"# seconds {seconds} steps {steps}")


def main(file, runs, *words):
    settings = dict(word.split("=") for word in words)
    problem = json.load(open(file))["problem"]
    for line in open(runs):
        _, steps, history = line.rstrip("\n").split(" ", 2)
        move(problem, float(settings.get("theta", 0.5)), int(steps), history)


main(*sys.argv[1:])
