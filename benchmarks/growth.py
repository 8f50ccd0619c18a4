#!/usr/bin/python3
"""How the cost of whole commands grows: a table with fitted exponents, as Markdown.

    growth.py PROGRAM

PROGRAM is the command clackers. Each cell is its processor time in seconds less that of its start, the least of three runs; the
exponent is the slope of its logarithm over that of the size, by least squares. Ranks need mpirun.
"""
import math
import os
import resource
import shutil
import subprocess
import sys
import tempfile

TURNS = 3
LADDER = ["--levels", "4", "--jobs", "1", "--budget", "0"]
CAMPAIGN = 'methods = ["newmark", "rk4"]\n[ladder]\nlevels = 4\n[[cases]]\ncase = "stop"\n' \
    "set = { xi1 = { from = 0.0, to = 0.1, points = 100 } }\n"


def seconds_of(words):
    """Least processor time of a command and of what it started; any exit code of a verdict passes."""
    least = math.inf
    for _ in range(TURNS):
        begin = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, check=False)
        end = resource.getrusage(resource.RUSAGE_CHILDREN)
        if done.returncode not in (0, 1, 3):
            raise SystemExit(f"growth: {' '.join(words)} failed: {done.stderr.decode()}")
        least = min(least, end.ru_utime - begin.ru_utime + end.ru_stime - begin.ru_stime)
    return least


def exponent(sizes, seconds):
    x, y = [math.log(size) for size in sizes], [math.log(max(second, 1e-4)) for second in seconds]
    mean_x, mean_y = sum(x) / len(x), sum(y) / len(y)
    return sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y)) / sum((a - mean_x) ** 2 for a in x)


def series(program, folder):
    """Title, sizes and the command of a size."""
    listed = subprocess.run([program, "list", "pairs", "--format", "csv"], capture_output=True, check=True, text=True).stdout
    names = [line.split(",")[0].strip("\"") for line in listed.splitlines()[1:]]

    def rows(count):
        path = f"{folder}/{count}.npy"
        if not os.path.exists(path):
            subprocess.run([program, "respond", "three-parameter", "--samples", str(count), "--format", "npy", "--out", path], check=True,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        return [program, "check", path]

    def ranks(count):
        database = f"{folder}/ranks.db"
        if os.path.exists(database):
            os.remove(database)
        return ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", str(count), program, "campaign", "run",
                f"{folder}/spec.toml", "--database", database, "--quiet"]

    yield ("steps of a run", [12500, 25000, 50000, 100000, 200000],
           lambda n: [program, "verify", "rk4", "--coarsest", repr(20 / n), "--levels", "1", "--samples-per-level", "1",
                      "--jobs", "1"])
    yield ("impacts of a motion, N", [10, 100, 1000, 10000],
           lambda n: [program, "respond", "stop", "--set", f"t_end={math.pi * n},xi1=0", "--collisions"])
    yield ("frequency ratio X", [9, 33, 129, 513],
           lambda x: [program, "verify", "rk4", "newmark", "--case", "synchronized-pair", "--set", f"X={x}", *LADDER])
    yield ("masses of a row", [6, 12, 24, 48],
           lambda n: [program, "verify", "rk4", "newmark", "--case", "row", "--set", f"masses={n}", *LADDER])
    yield "rows of a file", [10000, 100000, 1000000], rows
    yield "methods", [4, 8, 16, 32], lambda n: [program, "verify", *names[::5][:n], *LADDER]
    if shutil.which("mpirun"):
        with open(f"{folder}/spec.toml", "w", encoding="utf-8") as file:
            file.write(CAMPAIGN)
        yield "ranks of a campaign of 200 tasks", [1, 2, 4, 8], ranks


def main(program):
    start = seconds_of([program, "--version"])
    print(f"Start of the command: {1e3 * start:.1f} ms.\n\n| what grows | sizes | seconds | exponent |\n| --- | --- | --- | ---: |")
    with tempfile.TemporaryDirectory() as folder:
        for title, sizes, words in series(program, folder):
            seconds = [max(seconds_of(words(size)) - start, 0.0) for size in sizes]
            print(f"| {title} | {', '.join(f'{size:,}' for size in sizes)} | "
                  f"{', '.join(f'{second:.3g}' for second in seconds)} | {exponent(sizes, seconds):.2f} |", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
