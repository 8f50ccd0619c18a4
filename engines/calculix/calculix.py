"""CalculiX: Newmark's average acceleration, contact as a spring that takes pressure only.
    calculix.py PROBLEM.json RUNS [stiffness=4000]
The program has no restitution, and dampers are Rayleigh's: one ratio C/K for all springs."""
import json
import os
import resource
import subprocess
import sys


def deck(problem, stiffness, step, number):
    mass, spring = ([[*row] for row in problem[name]] for name in "MK")
    u, v = problem["start"]["u"], problem["start"]["v"]
    b = problem["contacts"][0]["direction"]
    n = len(mass)
    ends = [i + 1 for i in range(n) if b[i]]
    text = "*NODE, NSET=ALL\n"
    # The contact's spring is shortened where the gap closes: its nodes are 1 m apart.
    text += "".join(f"{i + 1}, {1.0 if b[i] > 0 else 0.0}, 0., 0.\n" for i in range(n))
    text += f"{n + 1}, {0.0 if len(ends) == 1 and b[ends[0] - 1] > 0 else 1.0}, 0., 0.\n"
    for i in range(n):
        text += f"*ELEMENT, TYPE=MASS, ELSET=M{i}\n{3 * i + 1}, {i + 1}\n*MASS, ELSET=M{i}\n{float(mass[i][i])!r}\n"
        text += f"*ELEMENT, TYPE=SPRING1, ELSET=K{i}\n{3 * i + 2}, {i + 1}\n*SPRING, ELSET=K{i}\n1\n{float(spring[i][i])!r}\n"
        damper = float(problem["C"][i][i])
        text += f"*ELEMENT, TYPE=DASHPOTA, ELSET=C{i}\n{3 * i + 3}, {i + 1}, {number + i}\n*DASHPOT, ELSET=C{i}\n\n{damper!r}\n"
    text = text.replace("*ELEMENT", "".join(f"*NODE\n{number + i}, -9., 0., 0.\n" for i in range(n)) + "*ELEMENT", 1)
    text += f"*ELEMENT, TYPE=SPRINGA, ELSET=CONTACT\n{3 * n + 1}, {ends[-1]}, {ends[0] if len(ends) == 2 else n + 1}\n"
    text += f"*SPRING, ELSET=CONTACT, NONLINEAR\n{-stiffness!r}, -1.\n0., 0.\n0., 10.\n*BOUNDARY\n"
    text += "".join(f"{i + 1}, 2, 3\n{number + i}, 1, 3\n" for i in range(n)) + f"{n + 1}, 1, 3\n"
    text += "*INITIAL CONDITIONS, TYPE=DISPLACEMENT\n" + "".join(f"{i + 1}, 1, {float(u[i])!r}\n" for i in range(n))
    text += "*INITIAL CONDITIONS, TYPE=VELOCITY\n" + "".join(f"{i + 1}, 1, {float(v[i])!r}\n" for i in range(n))
    text += f"*STEP, NLGEOM, INC=10000000\n*DYNAMIC, DIRECT, ALPHA=0.\n{step!r}, {float(problem['end'])!r}\n"
    return text + "*NODE PRINT, NSET=ALL\nU, V\n*END STEP\n"


def move(problem, stiffness, steps, history):
    n = len(problem["M"])
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    with open("deck.inp", "w") as out:
        out.write(deck(problem, stiffness, problem["end"] / steps, 100))
    subprocess.run(["ccx", "-i", "deck"], env={**os.environ, "OMP_NUM_THREADS": "1"}, check=True, stdout=sys.stderr)
    rows, kind = {}, ""
    for line in open("deck.dat"):
        words = line.split()
        if words and words[0] in ("displacements", "velocities"):
            kind, time = words[0][0], words[-1]
        elif words and int(words[0]) <= n:
            rows.setdefault(time, {})[kind + words[0]] = words[1]
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    names = [f"{kind}{i + 1}" for kind in "dv" for i in range(n)]
    with open(history, "w") as out:
        print("t", *(name.replace("d", "u") for name in names), sep=",", file=out)
        for time, row in rows.items():
            print(time, *(row[name] for name in names), sep=",", file=out)
        print(f"# seconds {seconds} steps {steps}", file=out)


def main(file, runs, *words):
    settings = dict(word.split("=") for word in words)
    problem = json.load(open(file))["problem"]
    n = len(problem["M"])
    if any(problem["K"][i][j] for i in range(n) for j in range(n) if i != j):
        sys.exit("this program takes springs between a mass and the ground only")
    for line in open(runs):
        _, steps, history = line.rstrip("\n").split(" ", 2)
        move(problem, float(settings.get("stiffness", 4000)), int(steps), history)


main(*sys.argv[1:])
