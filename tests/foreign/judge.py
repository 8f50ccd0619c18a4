"""Foreign solvers, right and wrong, judged by `clackers check` and compared with an expert's word.

    judge.py [--only NAME] [--markdown] [--keep FOLDER] [--jobs N] [--list] [--failures]
    judge.py --sweep [COUNT]       correct histories: counts false alarms

Environment: CLACKERS, the command; FOREIGN_SOLVERS, the program of solvers.cpp (else it is compiled).
"""
import argparse
import concurrent.futures
import functools
import json
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import tempfile
import tomllib

import sweep
from comparison import Answer, expert, faults

HERE = pathlib.Path(__file__).resolve().parent


def load(folder=HERE):
    """(systems, sets with one layout each)."""
    systems = tomllib.loads((folder / "systems.toml").read_text())
    sets, named = [], {}
    for file in sorted((folder / "sets").glob("*.toml")):
        for entry in tomllib.loads(file.read_text())["set"]:
            entry = {**named.get(entry.pop("like", None), {}), **entry}
            named[entry["name"]] = entry
            for words, says, *system in entry.pop("vary", [["", 0]]):
                kind = {**entry, "system": (system or [entry["system"]])[0]}
                kind["says"] = entry.get("says", {}) if says == 0 else says
                if words or system:
                    kind["name"] = "-".join([entry["name"], *system, *words.split()])
                    kind["solver"] = f"{entry['solver']} {words}"
                named[kind["name"]] = kind
                for layout in kind.get("layouts", ["5"]):
                    sets.append({**kind, "layout": layout, "group": file.stem, "name": f"{kind['name']}/{layout}"})
    names = [one["name"] for one in sets]
    repeated = {name for name in names if names.count(name) > 1}
    if repeated:
        raise SystemExit(f"names stand twice: {sorted(repeated)}")
    return systems, sets


def step_counts(layout, coarsest, end):
    """Numbers of steps, coarsest first: "20" = 5 octaves of 4, "12" in the ratio sqrt 2, others one an octave."""
    ratio, count = {"20": (4, 20), "12": (2, 12), "40": (8, 40)}.get(layout, (1, int(layout)))
    return [round(end / coarsest * 2 ** (i / ratio)) for i in range(count)]


def files_of(one, system, folder):
    """[(path, step or tolerance, words of the solver)], coarsest first."""
    pattern = one.get("files", "h{h}.csv")
    if one["layout"] == "tolerances":
        pattern = one.get("files", "rtol{h:.0e}.csv")
        values = [10.0 ** -k for k in range(3, 1 + one.get("tightest", 12))]
        return [(folder / pattern.format(h=v, i=i), v, f"tolerance={v!r}")
                for i, v in enumerate(values)]
    end = system["end"]
    files = []
    for i, n in enumerate(step_counts(one["layout"], one.get("coarsest", system["coarsest"]), end)):
        h = end / n
        files.append((folder / pattern.format(h=f"{h:.10g}", n=n, i=i, k=i + 1), h, f"n={n}"))
    return files


def add_problems(systems, wanted, folder, clackers):
    """Writes the problem of each wanted system as numbers (assemblies/problem.hpp); adds `problem` and `end`."""
    for name in sorted(wanted):
        system = systems[name]
        words = shlex.split(system["check"].format(here=HERE))
        system["check"] = shlex.join(words)
        case = [] if "--problem" in words or "--case" in words else ["three-parameter"]
        shown = subprocess.run([clackers, "show", *case, *(w for w in words if w != "--case"), "--format", "json"],
                               capture_output=True, text=True, check=True)
        p = json.loads(shown.stdout)["problem"]
        contacts, loads = p["contacts"], p.get("loads", [])
        rows = [[len(p["M"]), len(contacts), len(loads), p["end"]], *p["M"], *p["C"], *p["K"],
                p["start"]["u"], p["start"]["v"],
                *([*c["direction"], c["gap"], c["restitution"]] for c in contacts),
                *([x["dof"], x["amplitude"], x["frequency"], x["phase"]] for x in loads)]
        path = folder / f"{name}.problem"
        path.write_text("\n".join(" ".join(map(repr, row)) for row in rows))
        system["problem"] = f"problem={path}"
        system.setdefault("end", p["end"])


@functools.cache
def scipy_python():
    """An interpreter that has SciPy; empty for none."""
    for python in (sys.executable, "/usr/bin/python3"):
        if subprocess.run([python, "-c", "import scipy.integrate"], capture_output=True).returncode == 0:
            return python
    return ""


@functools.cache
def programs():
    """The command of each kind of solver beside that of C++; empty where it is not installed."""
    has_r = shutil.which("Rscript") and subprocess.run(["Rscript", "-e", "library(deSolve)"], capture_output=True).returncode == 0
    return {"scipy": [scipy_python(), HERE / "scipy_solvers.py"] if scipy_python() else [],
            "calculix": [sys.executable, HERE / "calculix_solvers.py"] if shutil.which("ccx") else [],
            "octave": ["octave", "--no-gui", "-qf", HERE / "octave_solvers.m"] if shutil.which("octave") else [],
            "r": ["Rscript", HERE / "r_solvers.R"] if has_r else []}


# These start slowly: few runs write all their histories.
SLOW_STARTS = ("octave", "r")


def kind_of(one):
    """The name in programs() of the solver; empty for those of C++."""
    return next((name for name in programs() if f"method={name}-" in one["solver"]), "")


def program_of(one, solvers):
    return programs()[kind_of(one)] if kind_of(one) else [solvers]


def needs_problem(one, systems):
    return "solver" not in systems[one["system"]] or kind_of(one) not in ("", "scipy")


def prepare(one, system, folder):
    """(lines of the solver, command line of check) of a set."""
    folder.mkdir(parents=True, exist_ok=True)
    files = files_of(one, system, folder)
    lines = []
    told = system["problem"] if kind_of(one) not in ("", "scipy") else system.get("solver", system.get("problem"))
    odd, odd_words = one.get("odd", (-1, ""))
    for i, (path, h, words) in enumerate(files):
        events = f" events={path}.events" if one.get("events") else ""
        words = one.get("every-file", words).format(h=h)
        words += f" {odd_words}" if i == odd else ""
        lines.append(f"{path} {words} {told} {one['solver']}{events}\n")
    command = ["check", *(str(path) for path, _, _ in files), *shlex.split(system["check"]),
               *shlex.split(one.get("check", "").replace("{steps}", ",".join(repr(h) for _, h, _ in files))
                           .replace("{reversed}", ",".join(repr(h) for _, h, _ in reversed(files))))]
    for path, _, _ in files if one.get("events") else ():
        command += ["--events", f"{path}.events"]
    return lines, command


def solve(program, lines):
    subprocess.run(program, input="".join(lines), text=True, check=True, timeout=600,
                   env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})


def generate(one, system, folder, solvers):
    """Writes the files of a set; returns the command line of check."""
    lines, command = prepare(one, system, folder)
    solve(program_of(one, solvers), lines)
    return command


def solve_slow_starts(sets, systems, folders, jobs):
    """Histories of all sets whose programs start slowly, by few runs."""
    for kind in SLOW_STARTS:
        lines = [line for one, folder in zip(sets, folders) if kind_of(one) == kind
                 for line in prepare(one, systems[one["system"]], folder)[0]]
        parts = [lines[i::jobs] for i in range(jobs) if lines[i::jobs]]
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            list(pool.map(lambda part: solve(programs()[kind], part), parts))


def judge(one, system, folder, solvers, clackers):
    """(answer, faults) of a set; its files are removed."""
    try:
        command = prepare(one, system, folder)[1] if kind_of(one) in SLOW_STARTS else generate(one, system, folder, solvers)
        done = subprocess.run([clackers, *command, "--format", "json"], capture_output=True, text=True,
                              timeout=300)
    except subprocess.TimeoutExpired as late:
        done = subprocess.CompletedProcess(late.cmd, 124, "", f"no answer in {late.timeout:.0f} s")
    finally:
        if not one.get("keep"):
            shutil.rmtree(folder, ignore_errors=True)
    answer = Answer(done)
    return answer, faults(one, answer)


def compile_solvers(folder):
    program = folder / "solvers"
    subprocess.run([os.environ.get("CXX", "c++"), "-std=c++20", "-O2", "-o", program, HERE / "solvers.cpp"],
                   check=True)
    return str(program)


def report(results, shown, markdown):
    """Prints the table of the shown sets and the counts of all."""
    head = ("solver", "system", "expert", "clackers", "ok")
    lines = [(one["name"], one["system"], expert(one), str(answer), "yes" if not wrong else "NO: " + "; ".join(wrong))
             for one, answer, wrong in shown]
    if markdown:
        print("| " + " | ".join(head) + " |\n|" + " --- |" * len(head))
        for line in lines:
            print("| " + " | ".join(cell.replace("|", "\\|") for cell in line) + " |")
    else:
        for line in lines:
            print("{} ({})\n    expert   {}\n    clackers {}\n    ok       {}".format(*line))
    groups = {}
    for one, _, wrong in results:
        good, count = groups.get(one["group"], (0, 0))
        groups[one["group"]] = (good + (not wrong), count + 1)
    print("\n" + ", ".join(f"{group} {good}/{count}" for group, (good, count) in groups.items()))
    print(f"{sum(not wrong for *_, wrong in results)} of {len(results)} sets judged as the expert does.")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", action="append", help="sets whose name contains this (repeatable)")
    parser.add_argument("--group", action="append", help="sets of this file (repeatable)")
    parser.add_argument("--without", action="store_true", help="all sets but those of --group")
    parser.add_argument("--markdown", action="store_true")
    parser.add_argument("--failures", action="store_true", help="print only sets judged otherwise")
    parser.add_argument("--keep", type=pathlib.Path, help="write the files here and print the commands")
    parser.add_argument("--list", action="store_true", help="names, expert's word and why")
    parser.add_argument("--sweep", nargs="?", type=int, const=0, help="correct histories, at most COUNT")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--least", type=float, default=1.0, help="share below which the exit code is 1")
    options = parser.parse_args()
    systems, sets = load()
    if options.sweep is not None:
        sets = sweep.sets(systems, options.sweep)
    if options.only:
        sets = [one for one in sets if any(word in one["name"] for word in options.only)]
    sets = [one for one in sets if not kind_of(one) or programs()[kind_of(one)]]
    if options.group:
        sets = [one for one in sets if (one["group"] in options.group) != options.without]
    if options.list:
        for one in sets:
            print(f"{one['name']} ({one['system']}): {expert(one)}\n    {one.get('why', '')}")
        print(f"{len(sets)} sets")
        return 0
    clackers = os.environ.get("CLACKERS", str(HERE.parents[1] / "build/dev/cli/clackers"))
    with tempfile.TemporaryDirectory(prefix="foreign-") as temporary:
        scratch = pathlib.Path(temporary)
        solvers = os.environ.get("FOREIGN_SOLVERS") or compile_solvers(scratch)
        place = options.keep or scratch
        place.mkdir(parents=True, exist_ok=True)
        add_problems(systems, {one["system"] for one in sets if needs_problem(one, systems)}, place.resolve(), clackers)
        if options.keep:
            for one in sets:
                command = generate(one, systems[one["system"]], options.keep / one["name"].replace("/", "-"), solvers)
                print(f"# {one['name']}: {expert(one)}\n{shlex.join([clackers, *command])}")
            return 0

        folders = [scratch / str(i) for i in range(len(sets))]
        solve_slow_starts(sets, systems, folders, options.jobs)

        def work(one, folder):
            return (one, *judge(one, systems[one["system"]], folder, solvers, clackers))

        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            results = list(pool.map(work, sets, folders))
    shown = [result for result in results if result[2]] if options.failures else results
    report(results, shown, options.markdown)
    right = sum(not wrong for *_, wrong in results)
    return 0 if right >= options.least * len(results) else 1


if __name__ == "__main__":
    sys.exit(main())
