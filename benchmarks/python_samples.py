#!/usr/bin/python3
"""What exact states cost from Python, beside the same call from C++ in the same run.

    python_samples.py PROGRAM [N]

PROGRAM is the built python_samples.cpp, and the package `clackers` is found on PYTHONPATH. Both sample u, v and a of the
default case at N = 1e7 times into new memory, in turns, 15 times each; times are processor times of the process.
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
    python, cpp = [], []
    with subprocess.Popen([program, str(count)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as peer:
        for run in range(RUNS + 1):
            begin = time.process_time_ns()
            u, v, a = case.response(t)
            python.append(time.process_time_ns() - begin)
            del u, v, a
            peer.stdin.write("\n")
            peer.stdin.flush()
            cpp.append(float(peer.stdout.readline()))
        peer.stdin.close()
    # The first run finds cold caches.
    ours, theirs = statistics.median(python[1:]), statistics.median(cpp[1:])
    reached = "reached" if ours <= LIMIT * theirs else "MISSED"
    print(f"{count} states u, v, a of {case.name}, {case.dof} masses")
    print(f"Motion::sample into std::vector  {theirs / count:6.2f} ns/state")
    print(f"clackers.Case.response           {ours / count:6.2f} ns/state  ratio {ours / theirs:.2f} <= {LIMIT}  {reached}")


if __name__ == "__main__":
    main(sys.argv[1], *map(int, sys.argv[2:]))
