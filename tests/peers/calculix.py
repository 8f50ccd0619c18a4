"""CalculiX: how the tests run it, and the rows that it prints."""
import os
import pathlib
import subprocess


def on_one_processor():
    """From now on, for what this process starts too: CalculiX starts threads for each task, whose changes of processor
    take longer than small tasks do."""
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})


def run(folder, name):
    """{time: {"u1": ..., "v1": ...}} of `*NODE PRINT` of U and V, as printed, after a run of `name`.inp in the folder."""
    done = subprocess.run(["ccx", "-i", name], cwd=folder, env={**os.environ, "OMP_NUM_THREADS": "1"}, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"CalculiX ended with status {done.returncode}:\n{done.stdout[-2000:]}{done.stderr}")
    rows, kind, time = {}, "", ""
    for words in map(str.split, (pathlib.Path(folder) / f"{name}.dat").read_text(encoding="ascii").splitlines()):
        if words and words[0] in ("displacements", "velocities"):
            kind, time = "v" if words[0] == "velocities" else "u", words[-1]
        elif words:
            rows.setdefault(time, {})[kind + words[0]] = words[1]
    return rows
