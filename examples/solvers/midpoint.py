"""Implicit midpoint rule, impacts located by bisection: order 2. Standard library only.
    midpoint.py PROBLEM.json H HISTORY [EVENTS]"""
import json
import sys


def dot(x, y):
    return sum(a * b for a, b in zip(x, y))


def solve(A, b):
    """A x = b by Gauss's elimination; A is symmetric positive definite."""
    A, n, x = [[*row, b_i] for row, b_i in zip(A, b)], len(b), [0.0] * len(b)
    for p in range(n):
        for i in range(p + 1, n):
            A[i] = [y - A[i][p] / A[p][p] * z for y, z in zip(A[i], A[p])]
    for i in reversed(range(n)):
        x[i] = (A[i][n] - dot(A[i][i + 1:n], x[i + 1:])) / A[i][i]
    return x


def step(p, u, v, h):
    A = [[m + h / 2 * c + h * h / 4 * k for m, c, k in zip(*rows)]
         for rows in zip(p["M"], p["C"], p["K"])]
    middle = solve(A, [dot(m, v) - h / 2 * dot(k, u) for m, k in zip(p["M"], p["K"])])
    return [x + h * y for x, y in zip(u, middle)], [2 * y - x for x, y in zip(v, middle)]


def closing(p, u, v):
    """A contact with a negative gap that closes further, or None."""
    return next((c for c in p["contacts"] if dot(c["direction"], u) < c["gap"]
                 and dot(c["direction"], v) < 0), None)


def main(problem, h, history, events="/dev/null"):
    p = json.load(open(problem))["problem"]
    t0, u, v = p["start"]["t"], p["start"]["u"], p["start"]["v"]
    n = round((p["end"] - t0) / float(h))
    h, out, hits = (p["end"] - t0) / n, open(history, "w"), open(events, "w")
    print("t", *(f"{q}{k + 1}" for q in "uv" for k in range(len(u))), sep=",", file=out)
    print("t", file=hits)
    for i in range(n + 1):
        print(t0 + i * h, *u, *v, sep=",", file=out)
        left = h
        while contact := closing(p, *(after := step(p, u, v, left))):
            low, high, b = 0.0, left, contact["direction"]
            while low < (mid := (low + high) / 2) < high:
                low, high = (low, mid) if closing(p, *step(p, u, v, mid)) else (mid, high)
            (u, v), left, push = step(p, u, v, low), left - low, solve(p["M"], b)
            impulse = -(1 + contact["restitution"]) * dot(b, v) / dot(b, push)
            v = [x + impulse * y for x, y in zip(v, push)]
            print(t0 + (i + 1) * h - left, file=hits)
        u, v = after


main(*sys.argv[1:])
