#!/usr/bin/env python3
"""Derives the polynomials of clackers/numerics/simd: `tools/polynomials.py` prints them.

Each is the best polynomial p on [0, a] for a weighted difference w (p - f), found by Remez's exchange with
60 digits. Then its coefficients become doubles, the lowest one by one, and the higher ones are fitted again
after each, so that a rounding is made good by its neighbours. Standard library only.
"""
from decimal import Decimal as D, getcontext

getcontext().prec = 60
PI = D("3.14159265358979323846264338327950288419716939937510582097494459")
LN2 = D("0.693147180559945309417232121458176568075500134360255254120680")


def series(x, first, ratio):
    """first * (1 + ratio(1) + ratio(1) ratio(2) + ...), a sum of falling terms."""
    term, total, n = first, D(0), 1
    while abs(term) > D(10) ** -58:
        total += term
        term *= ratio(n)
        n += 1
    return total


def solve(rows):
    """The solution of a square system by elimination with pivots; the last column is the right side."""
    rows = [list(r) for r in rows]
    n = len(rows)
    for i in range(n):
        p = max(range(i, n), key=lambda k: abs(rows[k][i]))
        rows[i], rows[p] = rows[p], rows[i]
        for k in range(i + 1, n):
            q = rows[k][i] / rows[i][i]
            for j in range(i, n + 1):
                rows[k][j] -= q * rows[i][j]
    x = [D(0)] * n
    for i in reversed(range(n)):
        x[i] = (rows[i][n] - sum(rows[i][j] * x[j] for j in range(i + 1, n))) / rows[i][i]
    return x


def cos_decimal(x):
    return series(x, D(1), lambda n: -x * x / ((2 * n) * (2 * n - 1)))


def remez(f, w, low, high, powers, rounds=12, grid=1500):
    """Coefficients of x^k, k in powers, that make the largest |w (p - f)| on [low, high] smallest; and that."""
    n = len(powers)
    points = [(low + high) / 2 + (high - low) / 2 * -cos_decimal(PI * D(2 * i + 1) / (2 * n + 2)) for i in range(n + 1)]
    xs = [low + (high - low) * D(i) / grid for i in range(grid + 1)]
    fs, ws = [f(x) for x in xs], [w(x) for x in xs]
    pw = [[x**k if k else D(1) for k in powers] for x in xs]
    for _ in range(rounds):
        rows = [[x**k if k else D(1) for k in powers] + [D((-1) ** i) / w(x), f(x)] for i, x in enumerate(points)]
        c = solve(rows)
        error = [wi * (sum(a * b for a, b in zip(c, p)) - fi) for wi, p, fi in zip(ws, pw, fs)]
        # One extreme of each run of equal signs.
        best = []
        for x, e in zip(xs, error):
            if best and (best[-1][1] > 0) == (e > 0):
                if abs(e) > abs(best[-1][1]):
                    best[-1] = (x, e)
            else:
                best.append((x, e))
        if len(best) < n + 1:
            break
        while len(best) > n + 1:
            best.pop(0 if abs(best[0][1]) < abs(best[-1][1]) else -1)
        points = [x for x, _ in best]
    return c[:n], max(abs(e) for e in error)


def fit(name, f, w, low, high, degree, alone=5):
    """Prints the double coefficients of a polynomial of this degree for f, lowest first.

    The first `alone` are rounded one by one, the others, which matter less, together.
    """
    fixed, first = [], None
    while len(fixed) <= degree:
        def rest(x):
            return f(x) - sum(D(c) * x**i if i else D(c) for i, c in enumerate(fixed))
        found, error = remez(rest, w, low, high, list(range(len(fixed), degree + 1)))
        first = error if first is None else first
        fixed += map(float, found[:1] if len(fixed) < alone else found)
    step = [low + (high - low) * D(i) / 3000 for i in range(3001)]
    final = max(abs(w(x) * (sum(D(c) * x**i if i else D(c) for i, c in enumerate(fixed)) - f(x))) for x in step)
    print(f"// {name}: weighted difference at most {float(final) * 2.0**52:.3g} * 2^-52 "
          f"({float(first) * 2.0**52:.3g} before rounding)")
    for c in fixed:
        print(f"    {c.hex()},  // {c!r}")


def split(name, value, parts):
    """Prints a constant as an unevaluated sum of doubles."""
    out = []
    for _ in range(parts):
        out.append(float(value))
        value -= D(out[-1])
    print(f"// {name}: " + " + ".join(f"{x!r}" for x in out))


def sine_tail(x):
    """(sin(pi z)/z - pi) / x in x = z^2."""
    y = PI * PI * x
    return PI**3 * series(x, D(-1) / 6, lambda n: -y / ((2 * n + 2) * (2 * n + 3)))


def cosine_tail(x):
    """(cos(pi z) - 1) / x in x = z^2."""
    y = PI * PI * x
    return PI**2 * series(x, D(-1) / 2, lambda n: -y / ((2 * n + 1) * (2 * n + 2)))


def power_tail(r):
    """(2^r - 1 - r ln 2) / r^2."""
    y = LN2 * r
    return LN2**2 * series(r, D(1) / 2, lambda n: y / (n + 2))


if __name__ == "__main__":
    split("pi", PI, 2)
    split("ln 2", LN2, 2)
    # The sine and cosine of pi z for |z| <= 1/4, in x = z^2.
    least, most = D(10) ** -12, D(1) / 16
    fit("sine", sine_tail, lambda x: x * x.sqrt(), least, most, 5)
    fit("cosine", cosine_tail, lambda x: x, least, most, 6)
    # A weight r^2 would be 0 inside the interval; its largest value bounds it. Rounded together: with the
    # lowest fixed, no other can change the difference at 0.
    fit("power", power_tail, lambda r: D(1) / 4, D(-1) / 2, D(1) / 2, 9, alone=0)
