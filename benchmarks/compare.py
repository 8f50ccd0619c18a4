#!/usr/bin/python3
"""What one build costs beside another: the ratio of each row that the benchmarks of both print, and of whole commands.

    compare.py BUILD OTHER

BUILD and OTHER are folders that `scripts/bench --compare` builds. Both run in turns, on the last processor and before all other
programs where that is allowed. A ratio below 1 is a gain; its spread is that of neighbouring runs.
"""
import os
import re
import resource
import statistics
import subprocess
import sys

TURNS = 5
PROGRAMS = ("states", "impacts")
COMMANDS = {
    "clackers --version": ("--version",),
    "clackers verify": ("verify", "--jobs", "1"),
    "clackers verify buildings": ("verify", "--jobs", "1", "--case", "buildings"),
    "clackers respond, 1e6 rows as npy": ("respond", "three-parameter", "--samples", "1000000", "--format", "npy"),
}
ROW = re.compile(r"(\S.*?\S)  +(\d+\.\d+)(?:\s|$)")


def calm():
    words = ["chrt", "--rr", "1", "taskset", "--cpu-list", str(os.cpu_count() - 1)]
    return words if subprocess.run([*words, "true"], capture_output=True).returncode == 0 else []


def rows_of(build, before):
    """Number by name: of a benchmark below its title, of a command its processor time in ms."""
    rows = {}
    for program in PROGRAMS:
        path = f"{build}/benchmarks/clackers_benchmark_{program}"
        if not os.path.exists(path):  # without its peers
            continue
        title = part = ""
        for line in subprocess.run([*before, path], stdout=subprocess.PIPE, check=True, text=True).stdout.splitlines():
            if row := ROW.match(line):
                same, part = row[1].startswith("the same"), part if row[1].startswith("the same") else row[1]
                rows[title, f"{part}; {row[1]}" if same else part] = float(row[2])
            elif line[:1].strip():
                title = line
    for name, words in COMMANDS.items():
        start = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run([*before, f"{build}/cli/clackers", *words], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        if done.returncode not in (0, 1, 3):  # verdicts
            raise SystemExit(f"compare: {name} failed")
        end = resource.getrusage(resource.RUSAGE_CHILDREN)
        rows["whole commands: processor time [ms]", name] = 1e3 * (end.ru_utime - start.ru_utime + end.ru_stime - start.ru_stime)
    return rows


def main(build, other):
    before = calm()
    runs = [(rows_of(build, before), rows_of(other, before)) for _ in range(TURNS)]
    last = ""
    for title, name in runs[0][0]:
        pairs = [(ours[title, name], theirs[title, name]) for ours, theirs in runs if theirs.get((title, name))]
        if not pairs:
            continue
        if title != last:
            print(f"\n{title}\n{'':76}{'now':>10}{'other':>10}{'ratio':>7}  spread")
            last = title
        now, then = (statistics.median(side) for side in zip(*pairs))
        ratios = sorted(a / b for a, b in pairs)
        print(f"{name:76}{now:10.2f}{then:10.2f}{now / then:7.2f}  {ratios[0]:.2f} to {ratios[-1]:.2f}", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
