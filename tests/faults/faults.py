#!/usr/bin/env python3
"""Makes single calls of the C library fail, and ends runs by signals: nothing may be lost or left."""
import argparse
import errno
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

EXIT_CODES = (0, 1, 2, 3, 4, 130)
ERRORS = {"malloc": (errno.ENOMEM,), "open": (errno.EMFILE, errno.EACCES, errno.EOPNOTSUPP, errno.EINTR),
          "read": (errno.EIO, errno.EINTR), "write": (errno.ENOSPC, errno.EIO, errno.EINTR),
          "rename": (errno.EACCES, errno.EEXIST, errno.EINVAL), "fsync": (errno.EIO,), "thread": (errno.EAGAIN,)}
OLD = "old\n"
SHORT = ("--coarsest", "0.05", "--levels", "2", "--samples-per-level", "1")
# Arguments without outputs, and the outputs: names of files, or one folder.
COMMANDS = (
    (("respond", "three-parameter", "--samples", "3000", "--format", "csv", "--out", "out.csv"), ("out.csv",)),
    (("respond", "stop", "--samples", "30", "--digits", "20", "--format", "json", "--out", "out.json"), ("out.json",)),
    (("check", "history.csv", "--format", "csv", "--out", "out.csv", "--report", "report.html"),
     ("out.csv", "report.html")),
    (("verify", "rk4", *SHORT, "--jobs", "4", "--format", "json", "--out", "out.json", "--report", "report.html"),
     ("out.json", "report.html")),
    (("paper", "fig12", "--out", "figures"), ("figures",)),
)


class Failure(Exception):
    pass


def is_whole(path):
    """A complete new output, recognized by its end."""
    if path.is_dir():
        listed = json.loads((path / "paper.json").read_text())["files"]
        if not {each.name for each in path.iterdir()} <= set(listed):
            return False
        return (path / "index.html").read_text().endswith("</html>\n")
    text = path.read_text()
    if path.suffix == ".json":
        json.loads(text)
    return text.endswith("</html>\n") if path.suffix == ".html" else text.endswith("\n") and len(text) > 100


def snapshot(path):
    if not path.is_dir():
        return path.read_bytes()
    return {each.name: each.read_bytes() if each.is_file() else None for each in path.iterdir()}


class Runner:
    def __init__(self, command, library, randomness):
        self.command, self.library, self.random = command, library, randomness
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="clackers-faults-"))
        self.survived, self.usual = {}, {}
        # No program that draws: the figures' numbers are enough here.
        self.environment = {**os.environ, "PATH": "/nowhere"}
        history = subprocess.run([command, "respond", "three-parameter", "--step", "0.1", "--format", "csv"],
                                 capture_output=True, check=True)
        (self.folder / "history.csv").write_bytes(history.stdout)
        self.old = {}

    def close(self):
        shutil.rmtree(self.folder)

    def prepare(self, outputs):
        """Old outputs stand where the new ones go, and nothing else."""
        for path in self.folder.iterdir():
            if path.name != "history.csv":
                shutil.rmtree(path) if path.is_dir() else path.unlink()
        for name in outputs:
            path = self.folder / name
            if name == "figures":
                if "figures" not in self.old:
                    subprocess.run([self.command, "paper", "fig2", "--out", path], env=self.environment,
                                   capture_output=True)
                    self.old["figures"] = snapshot(path)
                shutil.rmtree(path, ignore_errors=True)
                path.mkdir()
                for each, content in self.old["figures"].items():
                    (path / each).write_bytes(content)
            else:
                path.write_text(OLD)
                self.old[name] = snapshot(path)

    def start(self, arguments, **changes):
        return subprocess.Popen([self.command, *arguments], cwd=self.folder, stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, env={**self.environment, **changes})

    def check(self, what, outputs, code, allowed):
        """What must hold after every run."""
        if code not in allowed:
            raise Failure(f"{what}: exit code {code}")
        for name in outputs:
            path = self.folder / name
            if not path.exists():
                raise Failure(f"{what}: {name} is gone")
            is_old = snapshot(path) == self.old[name]
            try:
                if not is_old and not is_whole(path):
                    raise Failure(f"{what}: {name} is neither old nor new")
            except (ValueError, OSError) as error:
                raise Failure(f"{what}: {name}: {error}")
        left = sorted(each.name for each in self.folder.iterdir() if each.name not in (*outputs, "history.csv"))
        # SIGKILL leaves a folder, or a file in the instant between its getting a name and its place.
        is_killed = code == -signal.SIGKILL and len(left) == 1 and left[0].startswith(".clackers-")
        if left and not is_killed:
            raise Failure(f"{what}: left {left}")
        kind = what.split(":")[0]
        self.survived[kind] = self.survived.get(kind, 0) + 1

    def counts(self, arguments, outputs):
        """How many calls of each kind a run makes."""
        self.prepare(outputs)
        file = self.folder.parent / (self.folder.name + ".counts")
        process = self.start(arguments, LD_PRELOAD=self.library, FAIL_CALL_COUNTS=str(file))
        process.communicate(timeout=60)
        self.usual[arguments] = process.returncode
        counts = dict(line.split() for line in file.read_text().splitlines())
        file.unlink()
        return {kind: int(number) for kind, number in counts.items()}

    def fail(self, arguments, outputs, kind, number, error):
        self.prepare(outputs)
        process = self.start(arguments, LD_PRELOAD=self.library, FAIL_CALL=f"{kind}:{number}:{error}")
        what = f"{kind}: call {number} fails with {errno.errorcode[error]} in {' '.join(arguments)}"
        try:
            message = process.communicate(timeout=60)[1].decode()
        except subprocess.TimeoutExpired:
            process.kill()
            raise Failure(f"{what}: does not end")
        # Without a thread the others do its work.
        allowed = (self.usual[arguments],) if kind == "thread" else EXIT_CODES
        self.check(f"{what}\n{message}", outputs, process.returncode, allowed)
        if process.returncode and not message and process.returncode not in (1, 3):
            raise Failure(f"{what}: exit code {process.returncode} without a message")

    def end(self, arguments, outputs, signs, longest):
        self.prepare(outputs)
        process = self.start(arguments)
        time.sleep(self.random.random() * longest)
        for sign in signs:
            process.send_signal(sign)
        process.communicate(timeout=60)
        names = "+".join(sign.name for sign in signs)
        allowed = EXIT_CODES if process.returncode >= 0 else tuple(-sign for sign in signs)
        if signal.SIGTERM in signs and process.returncode == -signal.SIGTERM:
            allowed = (-signal.SIGTERM,)  # before main(), where nothing is open yet
        self.check(f"{names}: in {' '.join(arguments)}", outputs, process.returncode, allowed)


def plan(runner, randomness):
    """Endless: one fault after another, each kind of each command in turn."""
    counted = [(arguments, outputs, runner.counts(arguments, outputs)) for arguments, outputs in COMMANDS]
    todo = {}
    for index, (_, _, counts) in enumerate(counted):
        for kind, number in counts.items():
            todo[index, kind] = [(n, error) for n in range(1, number + 1) for error in ERRORS[kind]]
            randomness.shuffle(todo[index, kind])
    # The last is taken first: calls before main() come at once.
    todo[0, "malloc"].sort(key=lambda fault: fault[0] <= 12)
    while True:
        for index, (arguments, outputs, counts) in enumerate(counted):
            for kind in counts:
                if todo[index, kind]:
                    number, error = todo[index, kind].pop()
                    yield lambda a=arguments, o=outputs, k=kind, n=number, e=error: runner.fail(a, o, k, n, e)
            for signs in ((signal.SIGKILL,), (signal.SIGTERM,), (signal.SIGTERM, signal.SIGTERM), (signal.SIGXCPU,)):
                yield lambda a=arguments, o=outputs, s=signs: runner.end(a, o, s, 0.15)
        if not any(todo.values()):
            print("every call of every kind has failed once")
            return


def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--command", required=True, type=os.path.abspath)
    options.add_argument("--library", required=True, type=os.path.abspath)
    options.add_argument("--seconds", type=float, default=25)
    options.add_argument("--seed", type=int, default=20221122)
    options = options.parse_args()
    randomness = random.Random(options.seed)
    runner = Runner(options.command, options.library, randomness)
    end = time.monotonic() + options.seconds
    failures = []
    try:
        for fault in plan(runner, randomness):
            if time.monotonic() > end:
                break
            try:
                fault()
            except Failure as failure:
                failures.append(str(failure))
                print(f"FAILED {failure}", file=sys.stderr)
    finally:
        runner.close()
    total = sum(runner.survived.values())
    print(f"seed {options.seed}: {total} faults survived, {len(failures)} not: "
          + ", ".join(f"{kind} {number}" for kind, number in sorted(runner.survived.items())))
    return 1 if failures or not total else 0


if __name__ == "__main__":
    sys.exit(main())
