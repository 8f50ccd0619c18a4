#!/usr/bin/python3
"""What exact states cost from Python, beside the same calls from C++ in the same run.

    python_samples.py PROGRAM [N]

PROGRAM is the built python_samples.cpp, and the package `clackers` is found on PYTHONPATH. Both sample u, v and a of the
default case at N = 1e7 times, into new memory and into memory that is there, in turns, 15 times each; times are processor
times of the process.
"""
import statistics
import subprocess
import sys
import time

import numpy as np

import clackers

RUNS = 15
LIMIT = 1.2


def main(program, count=10_000_000):
    case = clackers.case()
    t = np.arange(count) * case.end / (count - 1)
    t[-1] = case.end
    kept = tuple(np.zeros((count, case.dof)) for _ in range(3))
    times = {"new": ([], []), "kept": ([], [])}
    with subprocess.Popen([program, str(count)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as peer:
        for _ in range(RUNS + 1):
            for memory, (ours, theirs) in times.items():
                begin = time.process_time_ns()
                case.response(t, out=kept if memory == "kept" else None)
                ours.append(time.process_time_ns() - begin)
                peer.stdin.write(memory + "\n")
                peer.stdin.flush()
                theirs.append(float(peer.stdout.readline()))
        peer.stdin.close()
    print(f"{count} states u, v, a of {case.name}, {case.dof} masses")
    print(f"{'':44}ns/state")
    for memory, name, call in (("new", "new std::vectors", "response(t)"), ("kept", "vectors that are there", "response(t, out)")):
        # The first run finds cold caches.
        ours, theirs = (statistics.median(runs[1:]) for runs in times[memory])
        reached = "reached" if ours <= LIMIT * theirs else "MISSED"
        print(f"{'Motion::sample into ' + name:44}{theirs / count:8.2f}")
        print(f"{'clackers: case.' + call:44}{ours / count:8.2f}  ratio {ours / theirs:.2f} <= {LIMIT}  {reached}")


if __name__ == "__main__":
    main(sys.argv[1], *map(int, sys.argv[2:]))
