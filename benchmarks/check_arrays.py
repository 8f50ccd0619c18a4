"""clackers.check on arrays beside the command on the same data as npy: seconds and their ratio.

    PYTHONPATH=build/release/python python3 benchmarks/check_arrays.py build/release/clackers [ROWS]

The command's time includes its start and the reading of the file; that of Python neither the start of the
interpreter nor the import. Both take part in turns; the ratio is that of the medians.
"""
import os
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

import clackers

TURNS = 7
BOUND = 1.1


def seconds_of(call):
    start = time.perf_counter()
    call()
    return time.perf_counter() - start


def main(command, rows=1_000_000):
    case = clackers.case()
    t = np.linspace(0.0, case.end, int(rows))
    u, v, _ = case.response(t)
    table = np.empty(len(t), dtype=[(name, float) for name in ("t", "u1", "u2", "v1", "v2")])
    table["t"] = t
    for mass in range(2):
        table[f"u{mass + 1}"], table[f"v{mass + 1}"] = u[:, mass], v[:, mass]
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "history.npy")
        np.save(path, table)

        def by_command():
            subprocess.run([command, "check", path, "--format", "json"], check=True, stdout=subprocess.DEVNULL)

        def by_arrays():
            clackers.check(t, u, v).to_json()

        ours, theirs = [], []
        for _ in range(TURNS):
            theirs.append(seconds_of(by_command))
            ours.append(seconds_of(by_arrays))
    ours, theirs = statistics.median(ours), statistics.median(theirs)
    reached = "reached" if ours <= BOUND * theirs else "missed"
    print(f"{len(t)} rows of t, u, v of two masses, medians of {TURNS}")
    print(f"clackers check history.npy: {theirs:.3f} s")
    print(f"clackers.check(t, u, v):    {ours:.3f} s, ratio {ours / theirs:.2f} <= {BOUND} {reached}")


if __name__ == "__main__":
    main(*sys.argv[1:])
