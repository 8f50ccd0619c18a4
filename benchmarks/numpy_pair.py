"""Times NumPy on Eq. (26), on demand: the other half of exact_batch.cpp.

Reads lines `WAY XI1 X END COUNT REPEATS` and answers each with the processor time of one evaluation of
u1, u2, v1, v2 at COUNT times [ns]; WAY is `plain` or `out`. `version` is answered with NumPy's.
"""
import sys
import time

import numpy as np


def plain(t, xi1, X):
    """As it is printed; each value on its own."""
    w = np.sqrt(1 - xi1**2)
    d2 = -3 / X
    e = np.sign(np.cos(w * t)) * np.exp(-xi1 * t)
    u1 = np.cos(w * t) * e
    u2 = d2 * np.cos(X * w * t) * e
    v1 = -(xi1 * np.cos(w * t) + w * np.sin(w * t)) * e
    v2 = -d2 * (xi1 * np.cos(X * w * t) + X * w * np.sin(X * w * t)) * e
    return u1, u2, v1, v2


class Preallocated:
    """Every sine and cosine once, every result into arrays that are there already."""

    def __init__(self, count):
        self.u1, self.u2, self.v1, self.v2, self.e, self.x = (np.empty(count) for _ in range(6))

    def __call__(self, t, xi1, X):
        w = np.sqrt(1 - xi1**2)
        d2 = -3 / X
        e, x = self.e, self.x
        np.multiply(t, -xi1, out=e)
        np.exp(e, out=e)
        self.mass(t, w, xi1, e, self.u1, self.v1)
        np.sign(self.u1, out=x)
        np.multiply(e, x, out=e)
        np.multiply(self.u1, e, out=self.u1)
        np.multiply(self.v1, e, out=self.v1)
        self.mass(t, X * w, xi1, e, self.u2, self.v2)
        np.multiply(e, d2, out=e)
        np.multiply(self.u2, e, out=self.u2)
        np.multiply(self.v2, e, out=self.v2)
        return self.u1, self.u2, self.v1, self.v2

    def mass(self, t, w, xi1, e, u, v):
        """u = cos(w t), v = -(xi1 cos(w t) + w sin(w t))."""
        x = self.x
        np.multiply(t, w, out=x)
        np.cos(x, out=u)
        np.sin(x, out=v)
        np.multiply(v, -w, out=v)
        np.multiply(u, xi1, out=x)
        np.subtract(v, x, out=v)


def measure(way, xi1, X, end, count, repeats):
    t = np.random.default_rng(1).uniform(0.0, end, count)
    evaluate = plain if way == "plain" else Preallocated(count)
    for a, b in zip(evaluate(t, xi1, X), plain(t, xi1, X)):
        assert np.allclose(a, b, rtol=0, atol=1e-12 * np.abs(b).max()), "the two ways differ"
    begin = time.process_time_ns()
    for _ in range(repeats):
        evaluate(t, xi1, X)
    return (time.process_time_ns() - begin) / repeats


def main():
    for line in sys.stdin:
        words = line.split()
        if words[0] == "version":
            print(np.__version__, flush=True)
        else:
            way, (xi1, X, end), (count, repeats) = words[0], map(float, words[1:4]), map(int, words[4:6])
            print(measure(way, xi1, X, end, count, repeats), flush=True)


if __name__ == "__main__":
    main()
