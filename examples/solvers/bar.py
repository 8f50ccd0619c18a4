"""Bars and strings of linear elements, made from the mesh: explicit central differences, nodes stopped by their contacts.
Lumped mass. Standard library only.
    bar.py PROBLEM.json H HISTORY"""
import json
import math
import sys


def main(problem, h, history):
    file = json.load(open(problem))
    mesh, p = file.get("mesh", {"mass": "unknown, since the case has none"}), file["problem"]
    if mesh["mass"] != "lumped":
        sys.exit(f"bar.py: the mesh has mass = {mesh['mass']}; allowed: lumped")
    nodes, dof = mesh["nodes"], len(p["start"]["u"])
    place = [dof if node["fixed"] else node["dof"] - 1 for node in nodes]  # fixed nodes behind the others
    # What no node has is a rigid mass.
    mass = [p["M"][i][i] if i not in place else 0.0 for i in range(dof)] + [math.inf]
    springs = []
    for element in mesh["elements"]:
        left, right = (i - 1 for i in element["nodes"])
        length = nodes[right]["x"] - nodes[left]["x"]
        springs.append((place[left], place[right], element["stiffness"] / length))
        for i in (left, right):
            mass[place[i]] += element["density"] * length / 2
    load = [0.0] * (dof + 1)
    for force in p.get("loads", []):
        load[force["dof"] - 1] += force["amplitude"]

    def acceleration(u):
        force = load[:]
        for i, j, k in springs:
            tension = k * (u[j] - u[i])
            force[i] += tension
            force[j] -= tension
        return [f / m for f, m in zip(force, mass)]

    def stopped(u, v):
        """The velocities after the impacts of closed contacts."""
        for contact in p["contacts"]:
            b = contact["direction"]
            rate = sum(x * y for x, y in zip(b, v))
            if rate < 0 and sum(x * y for x, y in zip(b, u)) <= contact["gap"]:
                impulse = -(1 + contact["restitution"]) * rate / sum(x * x / m for x, m in zip(b, mass))
                v = [y + impulse * x / m for x, y, m in zip([*b, 0], v, mass)]
        return v

    n = round(p["end"] / float(h))
    h, u, v, out = p["end"] / n, [*p["start"]["u"], 0.0], [*p["start"]["v"], 0.0], open(history, "w")
    print("t", *(f"{q}{k + 1}" for q in "uv" for k in range(dof)), sep=",", file=out)
    a = acceleration(u)
    for i in range(n + 1):
        print(i * h, *u[:dof], *v[:dof], sep=",", file=out)
        middle = stopped(u, [x + h / 2 * y for x, y in zip(v, a)])
        u = [x + h * y for x, y in zip(u, middle)]
        a = acceleration(u)
        v = stopped(u, [x + h / 2 * y for x, y in zip(middle, a)])


main(*sys.argv[1:])
