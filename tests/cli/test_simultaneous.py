"""Simultaneous impacts: a solver that takes them one by one is told so, the methods of the catalogue
keep their orders, and contact springs diverge as they claim."""
import json
import os
import tempfile
import unittest

from command import CommandTest, run

PAGE = os.path.join(os.path.dirname(__file__),
                    "../../docs/manual/explanation/derivations/assemblies.md")


def rk4(problem, u, v, h):
    """One step of masses on springs of their own."""
    constants = [(problem["M"][i][i], problem["C"][i][i], problem["K"][i][i])
                 for i in range(len(u))]

    def rate(u, v):
        return [-(c * w + k * x) / m for (m, c, k), x, w in zip(constants, u, v)]

    def moved(x, s, y):
        return [a + s * b for a, b in zip(x, y)]

    def mean(a, b, c, d):
        return [(p + 2 * q + 2 * r + s) / 6 for p, q, r, s in zip(a, b, c, d)]

    v1, a1 = v, rate(u, v)
    v2, a2 = moved(v, h / 2, a1), rate(moved(u, h / 2, v1), moved(v, h / 2, a1))
    v3, a3 = moved(v, h / 2, a2), rate(moved(u, h / 2, v2), moved(v, h / 2, a2))
    v4, a4 = moved(v, h, a3), rate(moved(u, h, v3), moved(v, h, a3))
    return moved(u, h, mean(v1, v2, v3, v4)), moved(v, h, mean(a1, a2, a3, a4))


def gap(x, contact):
    return x[contact] - x[contact + 1]


def first_impact(problem, u, v, h):
    """The time until the first contact closes, and its number; nothing where none does."""
    end_u, end_v = rk4(problem, u, v, h)
    best = None
    for contact in range(len(u) - 1):
        if gap(end_u, contact) > -1e-14 or gap(end_v, contact) > 0:
            continue
        low, high = 0.0, 0.0 if gap(u, contact) <= 0 and gap(v, contact) < 0 else h
        while high - low > 1e-15 * h:
            middle = (low + high) / 2
            if middle in (low, high):
                break
            if gap(rk4(problem, u, v, middle)[0], contact) < 0:
                high = middle
            else:
                low = middle
        if best is None or high < best[0]:
            best = (high, contact)
    return best


def one_by_one(problem, steps):
    """Rows of t, u and v; located impacts are applied to one contact after the other."""
    u, v = problem["start"]["u"], problem["start"]["v"]
    h = problem["end"] / steps
    lines = [[0.0] + u + v]
    for k in range(steps):
        left = h
        while (event := first_impact(problem, u, v, left)) is not None:
            s, i = event
            u, v = rk4(problem, u, v, s)
            left -= s
            masses = problem["M"][i][i], problem["M"][i + 1][i + 1]
            impulse = -2 * gap(v, i) / (1 / masses[0] + 1 / masses[1])
            v[i] += impulse / masses[0]
            v[i + 1] -= impulse / masses[1]
        u, v = rk4(problem, u, v, left)
        lines.append([h * (k + 1)] + u + v)
    return lines


class Simultaneous(CommandTest):
    def test_a_solver_that_takes_impacts_one_by_one_is_told_so(self):
        row = ("row", "--set", "masses=3,fast=2,t_end=5")
        problem = json.loads(run("show", *row, "--format", "json").stdout)["problem"]
        with tempfile.TemporaryDirectory() as folder:
            files = []
            for steps in (100, 200, 400, 800):
                files.append(os.path.join(folder, f"N{steps}.csv"))
                with open(files[-1], "w") as file:
                    file.write("t,u1,u2,u3,v1,v2,v3\n")
                    for line in one_by_one(problem, steps):
                        file.write(",".join(map(repr, line)) + "\n")
            done = run("check", *files, "--case", *row, "--expect", "proper:4", "--format", "json")
        subject = json.loads(done.stdout)["cases"][0]["subjects"][0]
        self.assertEqual(subject["assessment"]["reason"], "simultaneous-impacts")
        self.assertEqual(done.returncode, 1)

    def test_balls_that_touch_err_by_impacts_and_not_by_their_steps(self):
        balls = range(5)
        identity = [[float(i == j) for j in balls] for i in balls]
        contacts = "".join(f"[[contacts]]\ndirection = {[float(j == i + 1) - float(j == i) for j in balls]}\n" for i in range(4))
        with open(self.path("balls.toml"), "w") as file:
            file.write(f"M = {identity}\nK = {identity}\nend = 20\n[start]\nu = [-1, 0, 0, 0, 0]\n{contacts}")
        done = run("verify", "rk4", "newmark", "--problem", self.path("balls.toml"), "--format", "json")
        for subject in json.loads(done.stdout)["cases"][0]["subjects"]:
            self.assertEqual(subject["assessment"]["reason"], "simultaneous-impacts", subject["name"])
            [seen] = [found["numbers"] for found in subject["assessment"]["evidence"]]
            self.assertEqual(seen[1], 4)
            self.assertLess(seen[2], 1e-3)
            self.assertGreater(seen[3], 0.5)

    def test_the_table_of_the_manual_shows_what_treatments_do(self):
        with open(PAGE) as file:
            lines = [[cell.strip(" `") for cell in line.strip("|\n ").split("|")]
                     for line in file if line.startswith("| `")]
        self.assertGreater(len(lines), 5)
        for column, case in enumerate(("row", "assembly"), 2):
            done = run("verify", *(line[0] for line in lines), "--case", case, "--budget", "0",
                       "--format", "json")
            found = [(subject["name"], subject["assessment"]["displacement"]["behaviour"])
                     for subject in json.loads(done.stdout)["cases"][0]["subjects"]]
            self.assertEqual(found, [(line[0], line[column]) for line in lines])

    def test_located_impacts_keep_the_order_and_springs_diverge_as_claimed(self):
        done = run("verify", "rk4", "moreau-jean", "tsit5+penalty", "--case", "row",
                   "--budget", "0", "--format", "json")
        found = {subject["name"]: subject["assessment"]
                 for subject in json.loads(done.stdout)["cases"][0]["subjects"]}
        self.assertEqual(found["rk4"]["displacement"]["behaviour"], "proper")
        self.assertAlmostEqual(found["rk4"]["displacement"]["order"], 4.0, delta=0.1)
        self.assertEqual(found["moreau-jean"]["verdict"], "agrees")
        self.assertEqual(found["tsit5+penalty"]["displacement"]["behaviour"], "divergent")
        self.assertEqual(found["tsit5+penalty"]["reason"], "simultaneous-impacts")
        self.assertEqual(found["tsit5+penalty"]["verdict"], "agrees")


if __name__ == "__main__":
    unittest.main()
