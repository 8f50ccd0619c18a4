"""A bar of solid elements with penalty springs at its contact end, run by CalculiX.
    calculix_bar.py PROBLEM.json H HISTORY ALPHA"""
import json
import os
import sys
import tempfile

import calculix

CORNERS = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))  # of a section, whose area is 1


def lines_of(ids, fields):
    return [", ".join(map(str, (i, *row))) for i, row in zip(ids, fields)]


def deck(mesh, p, step, alpha):
    """C3D8 without Poisson's ratio that move along x alone: the linear elements of the mesh with consistent mass."""
    nodes, elements, [contact] = mesh["nodes"], mesh["elements"], p["contacts"]
    touching = next(i for i, node in enumerate(nodes) if node["dof"] - 1 == contact["direction"].index(1))
    corners = [[4 * i + c + 1 for c in range(4)] for i in range(len(nodes))]
    ground = [4 * len(nodes) + c + 1 for c in range(4)]
    solids = [sum((corners[i - 1] for i in element["nodes"]), []) for element in elements]
    # As stiff as ten elements: penetration is a part of the error of the mesh.
    stiffness = 10 * elements[0]["stiffness"] / abs(nodes[1]["x"] - nodes[0]["x"]) / 4
    force = ((-stiffness, contact["gap"] - 1.0), (0.0, contact["gap"]), (0.0, contact["gap"] + 1.0))
    speeds = [[(1, p["start"]["v"][node["dof"] - 1])] * 4 for node in nodes]
    return "\n".join([
        "*NODE, NSET=BAR", *lines_of(sum(corners, []), [(node["x"], *place) for node in nodes for place in CORNERS]),
        "*NODE, NSET=GROUND", *lines_of(ground, [(nodes[touching]["x"] - 1.0, *place) for place in CORNERS]),
        "*NSET, NSET=LINE", *(str(first) for first, *_ in corners),
        "*ELEMENT, TYPE=C3D8, ELSET=BAR", *lines_of(range(1, len(solids) + 1), solids),
        "*ELEMENT, TYPE=SPRINGA, ELSET=CONTACT", *lines_of(range(len(solids) + 1, len(solids) + 5), zip(ground, corners[touching])),
        "*MATERIAL, NAME=M", "*ELASTIC", f"{elements[0]['stiffness']}, 0.", "*DENSITY", f"{elements[0]['density']}",
        "*SOLID SECTION, ELSET=BAR, MATERIAL=M",
        "*SPRING, ELSET=CONTACT, NONLINEAR", *(f"{f}, {length}" for f, length in force),
        "*BOUNDARY", "BAR, 2, 3", "GROUND, 1, 3",
        "*INITIAL CONDITIONS, TYPE=VELOCITY", *lines_of(sum(corners, []), sum(speeds, [])),
        "*STEP, INC=10000000", f"*DYNAMIC, DIRECT, ALPHA={alpha}", f"{step}, {p['end']}",
        "*NODE PRINT, NSET=LINE", "U, V", "*END STEP", ""])


def main(problem, h, history, alpha):
    with open(problem) as opened:
        file = json.load(opened)
    mesh, p = file["mesh"], file["problem"]
    step = p["end"] / round(p["end"] / float(h))
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "bar.inp"), "w") as out:
            out.write(deck(mesh, p, step, alpha))
        rows = calculix.run(folder, "bar")
    order = sorted(range(len(mesh["nodes"])), key=lambda i: mesh["nodes"][i]["dof"])
    with open(history, "w") as out:
        print("t", *(f"{q}{k + 1}" for q in "uv" for k in range(len(order))), sep=",", file=out)
        print("0", *(p["start"][q][k] for q in "uv" for k in range(len(order))), sep=",", file=out)
        for t, row in rows.items():
            print(t, *(row[f"{q}{4 * i + 1}"] for q in "uv" for i in order), sep=",", file=out)


main(*sys.argv[1:])
