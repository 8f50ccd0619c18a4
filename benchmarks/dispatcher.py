#!/usr/bin/env python3
"""Prints how many tasks a second rank 0 of mpirun gives out, one a message, to 1 to 64 ranks on the
cores there are: the limit of the dispatcher, whatever a task costs. The argument is the built
clackers_benchmark_dispatcher."""
import statistics
import subprocess
import sys

RANKS = (1, 2, 4, 8, 16, 32, 64)
REPETITIONS = 5
TASKS, TASKS_ALONE = 100_000, 10_000_000


def rate(program, ranks):
    tasks = TASKS_ALONE if ranks == 1 else TASKS
    command = ["mpirun", "--allow-run-as-root", "--oversubscribe", "--bind-to", "none", "-n", str(ranks),
               program, str(tasks)]
    return tasks / float(subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout)


def main():
    print("empty tasks a second, one a request; median (least, most) of", REPETITIONS)
    for ranks in RANKS:
        rates = [rate(sys.argv[1], ranks) for _ in range(REPETITIONS)]
        print(f"{ranks:3} ranks  {statistics.median(rates):12,.0f}  ({min(rates):,.0f}, {max(rates):,.0f})"
              + ("  without messages" if ranks == 1 else ""))


if __name__ == "__main__":
    main()
