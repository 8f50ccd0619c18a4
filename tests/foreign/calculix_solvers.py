"""CalculiX's direct dynamics of masses on springs of their own as a foreign solver; contacts are stiff springs."""
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "peers"))
import calculix  # noqa: E402


def read(path):
    """(masses, stiffnesses, displacements, velocities, contact or None, end) of undamped masses that are not coupled."""
    numbers = [float(word) for word in pathlib.Path(path).read_text(encoding="ascii").split()]
    n, contacts, _, end = int(numbers[0]), int(numbers[1]), numbers[2], numbers[3]
    rest = numbers[4:]
    m, k = [rest[i * (n + 1)] for i in range(n)], [rest[2 * n * n + i * (n + 1)] for i in range(n)]
    at = 3 * n * n
    return m, k, rest[at:at + n], rest[at + n:at + 2 * n], rest[at + 2 * n:at + 3 * n] if contacts else None, end


def deck(word):
    """The input of a run: Hilber, Hughes and Taylor's method, Newmark's with alpha = 0."""
    m, k, u, v, contact, end = read(word["problem"])
    k[-1] *= float(word.get("knn*", 1))
    m[-1] *= float(word.get("mnn*", 1))
    n = len(m)
    lines = ["*NODE, NSET=ALL"]
    # A contact spring is as long as the distance of its nodes; node 9 is the ground.
    lines += [f"{i + 1}, {1.0 - i!r}, 0., 0." for i in range(n)] + ["9, 0., 0., 0."]
    for i in range(n):
        lines += [f"*ELEMENT, TYPE=MASS, ELSET=M{i}", f"{i + 1}, {i + 1}", f"*MASS, ELSET=M{i}", repr(m[i]),
                  f"*ELEMENT, TYPE=SPRING1, ELSET=K{i}", f"{i + 11}, {i + 1}", f"*SPRING, ELSET=K{i}", "1", repr(k[i])]
    if contact and "spring" in word:
        lines += ["*ELEMENT, TYPE=SPRINGA, ELSET=C", f"21, {2 if n > 1 else 9}, 1", "*SPRING, ELSET=C, NONLINEAR",
                  f"{-float(word['spring'])!r}, -1.", "0., 0.", "0., 10."]
    lines += ["*BOUNDARY", *(f"{i + 1}, 2, 3" for i in range(n)), "9, 1, 3"]
    for kind, values in (("DISPLACEMENT", u), ("VELOCITY", v)):
        lines += [f"*INITIAL CONDITIONS, TYPE={kind}", *(f"{i + 1}, 1, {value!r}" for i, value in enumerate(values))]
    lines += ["*STEP, NLGEOM, INC=10000000", f"*DYNAMIC, DIRECT, ALPHA={float(word.get('alpha', 0))!r}",
              f"{end / int(word['n'])!r}, {end!r}", "*NODE PRINT, NSET=ALL", "U, V", "*END STEP"]
    return "\n".join(lines) + "\n", n


def main():
    for line in sys.stdin:
        path, *words = line.split()
        word = {key: value for key, _, value in (text.partition("=") for text in words)}
        job = pathlib.Path(path).with_suffix(".job")
        job.mkdir()
        text, n = deck(word)
        (job / "masses.inp").write_text(text, encoding="ascii")
        rows = [[t, *(row[f"{kind}{i + 1}"] for i in range(n) for kind in "uv")] for t, row in calculix.run(job, "masses").items()]
        header = ",".join(["t", *(f"{kind}{i + 1}" for i in range(n) for kind in "uv")])
        pathlib.Path(path).write_text("\n".join([header, *(",".join(row) for row in rows), ""]), encoding="ascii")


if __name__ == "__main__":
    main()
