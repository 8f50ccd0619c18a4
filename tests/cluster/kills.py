#!/usr/bin/env python3
"""Ends runs of one campaign by SIGKILL at random moments, starts them again until the campaign is
complete, and compares every row with an undisturbed run; then the next campaign, until there were as
many kills as wanted.

A run is one process with two threads, or mpirun with 2 to 5 ranks. Killed are the process, one rank
(mpirun then ends the others), or mpirun with all ranks at once, as when a node fails. After each kill,
what was finished before is still there; no task is computed again."""
import argparse
import contextlib
import glob
import os
import random
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time

os.environ.setdefault("CLACKERS", "clackers")
from cluster import mpi_command  # noqa: E402

SPECIFICATION = """\
methods = ["newmark", "rk4", "moreau-jean"]

[ladder]
levels = 4
samples_per_level = 2

[[cases]]
case = "three-parameter"
set = { N = [0, 1, 2, 3], xi1 = { from = 0.01, to = 0.2, points = %d } }
"""
KINDS = ("process", "rank", "node")
GRACE = 10.0  # seconds that mpirun has to end the others when one rank is lost
LONGEST = 60.0  # seconds of a run; one that hangs is killed as well
LAUNCH = 0.4  # seconds until the ranks of mpirun begin


class Broken(Exception):
    """Something was lost, computed twice, or is different."""


def children(pid):
    found = []
    for path in glob.glob(f"/proc/{pid}/task/*/children"):
        with contextlib.suppress(FileNotFoundError, ProcessLookupError), open(path, encoding="utf-8") as file:
            found += map(int, file.read().split())
    return found


def kill(pid):
    with contextlib.suppress(ProcessLookupError):
        os.kill(pid, signal.SIGKILL)


class Campaign:
    """One campaign in a folder of its own."""

    def __init__(self, program, folder, points):
        self.program, self.folder = program, folder
        self.tasks = 3 * 4 * points
        self.specification = os.path.join(folder, "spec.toml")
        self.database = os.path.join(folder, "runs.db")
        with open(self.specification, "w", encoding="utf-8") as file:
            file.write(SPECIFICATION % points)

    def command(self, *options):
        return [self.program, "campaign", "run", self.specification, "--database", self.database, "--quiet", *options]

    def files(self):
        return [path for path in [self.database, *glob.glob(self.database + ".rank-*")]
                if not path.endswith(("-wal", "-shm", "-journal", ".lock"))]

    def rows(self):
        """The finished tasks with the times that they took, from the database and all shards. A file
        that was ended while it was made has no tables yet."""
        found = {}
        for path in self.files():
            if not os.path.exists(path):
                continue
            with contextlib.closing(sqlite3.connect(path)) as connection:
                with contextlib.suppress(sqlite3.OperationalError):
                    times = {}
                    for task, run, seconds in connection.execute("SELECT task, run, seconds FROM timings"):
                        times.setdefault(task, []).append((run, seconds))
                    for (task,) in connection.execute("SELECT task FROM subjects"):
                        found.setdefault(task, sorted(times.get(task, [])))
        return found

    def exported(self):
        """Everything deterministic, as text."""
        return [subprocess.run([self.program, "campaign", "export", self.database, "--format", "csv", "--table", table],
                               capture_output=True, text=True, check=True).stdout for table in ("subjects", "runs")]


class Run:
    """A run that is going on."""

    def __init__(self, campaign, kind, chance):
        self.kind = kind
        command = campaign.command("--jobs", "2")
        if kind != "process":
            command = mpi_command(chance.randint(2, 5), *campaign.command())
        self.process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def wait(self, seconds):
        """True when it has ended by itself."""
        try:
            self.process.wait(seconds)
        except subprocess.TimeoutExpired:
            return False
        return True

    def kill(self, chance):
        """Ends it; returns when no process of it is left. Where mpirun does not end the other ranks
        within GRACE, they are killed, too, as a scheduler would do."""
        pids = children(self.process.pid) if self.kind != "process" else []
        everyone = [self.process.pid, *pids]
        for pid in [chance.choice(pids)] if self.kind == "rank" and pids else everyone:
            kill(pid)
        end = time.monotonic() + GRACE
        while self.process.poll() is None or any(os.path.exists(f"/proc/{pid}") for pid in pids):
            if time.monotonic() > end:
                for pid in everyone:
                    kill(pid)
            time.sleep(0.01)
        self.process.stderr.close()

    def check_end(self):
        stderr = self.process.stderr.read()
        self.process.stderr.close()
        if self.process.returncode:
            raise Broken(f"a run ({self.kind}) ended with {self.process.returncode}: {stderr}")


def require_kept(before, after, kind):
    """Nothing that was finished is lost or was computed once more."""
    lost = before.keys() - after.keys()
    again = [task for task in before.keys() & after.keys() if before[task] != after[task]]
    if lost or again:
        raise Broken(f"after SIGKILL of a {kind}: {len(lost)} tasks lost, {len(again)} computed again")


def disturb(campaign, chance, duration, most_kills):
    """Runs a campaign to its end; the number of kills by kind, and of those amid the tasks."""
    kills = dict.fromkeys((*KINDS, "amid"), 0)
    finished = {}
    while True:
        kind = chance.choice(KINDS)
        run = Run(campaign, kind, chance)
        may_kill = sum(kills[each] for each in KINDS) < most_kills
        # From the first instant to the end of most runs.
        latest = duration + (0.0 if kind == "process" else LAUNCH)
        if run.wait(chance.uniform(0.0, latest) if may_kill else LONGEST):
            run.check_end()
            require_kept(finished, campaign.rows(), kind)
            return kills
        run.kill(chance)
        kills[kind] += 1
        now = campaign.rows()
        require_kept(finished, now, kind)
        kills["amid"] += 0 < len(now) < campaign.tasks
        finished = now


def undisturbed(program, folder, points):
    """(rows, seconds) of a run that nobody disturbs."""
    campaign = Campaign(program, folder, points)
    start = time.monotonic()
    subprocess.run(campaign.command("--jobs", "2"), stdout=subprocess.DEVNULL, check=True)
    return campaign.exported(), time.monotonic() - start


@contextlib.contextmanager
def fresh_folder():
    folder = tempfile.mkdtemp(prefix="clackers-kills-")
    try:
        yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def check(program, kills, seed, points, report=lambda line: None):
    """The number of kills by kind, and of those with some, not all, tasks stored; throws Broken."""
    chance = random.Random(seed)
    with fresh_folder() as folder:
        expected, duration = undisturbed(program, folder, points)
    report(f"undisturbed: {duration:.1f} s, {expected[0].count(chr(10)) - 1} tasks, seed {seed}")
    totals, campaigns = dict.fromkeys((*KINDS, "amid"), 0), 0
    while (left := kills - sum(totals[kind] for kind in KINDS)) > 0:
        with fresh_folder() as folder:
            campaign = Campaign(program, folder, points)
            for kind, count in disturb(campaign, chance, duration, left).items():
                totals[kind] += count
            if campaign.exported() != expected:
                raise Broken("rows differ from those of the undisturbed run")
            if leftovers := glob.glob(campaign.database + ".rank-*"):
                raise Broken(f"left behind: {leftovers}")
        campaigns += 1
        report(f"{campaigns} campaigns complete and equal after kills: {totals}")
    return totals


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--command", required=True, help="a built clackers")
    arguments.add_argument("--kills", type=int, default=200)
    arguments.add_argument("--seed", type=int, default=random.randrange(1 << 32))
    arguments.add_argument("--points", type=int, default=240, help="systems of each of four kinds")
    options = arguments.parse_args()
    try:
        check(os.path.abspath(options.command), options.kills, options.seed, options.points, print)
    except Broken as broken:
        sys.exit(f"kills: {broken} (seed {options.seed})")


if __name__ == "__main__":
    main()
