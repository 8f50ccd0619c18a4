#!/usr/bin/env python3
"""Makes single calls of the C library fail, and ends runs by signals: nothing may be lost or left."""
import argparse
import contextlib
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

sys.path.append(str(pathlib.Path(__file__).parent.parent / "cli"))
import databases  # noqa: E402

EXIT_CODES = (0, 1, 2, 3, 4, 130)
ERRORS = {"malloc": (errno.ENOMEM,), "open": (errno.EMFILE, errno.EACCES, errno.EOPNOTSUPP, errno.EINTR),
          "read": (errno.EIO, errno.EINTR), "write": (errno.ENOSPC, errno.EIO, errno.EINTR),
          "rename": (errno.EACCES, errno.EEXIST, errno.EINVAL), "fsync": (errno.EIO,), "thread": (errno.EAGAIN,),
          "process": (errno.EAGAIN, errno.EMFILE, errno.ENOMEM)}
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
    (("campaign", "run", "spec.toml", "--database", "new.db", "--jobs", "2"), ("new.db",)),
    (("campaign", "run", "spec.toml", "--database", "half.db", "--jobs", "2"), ("half.db",)),
    (("campaign", "merge", "new.db", "part.db.shard-1-of-2", "part.db.shard-2-of-2"), ("new.db",)),
    (("campaign", "status", "whole.db", "--out", "out.csv", "--format", "csv"), ("out.csv",)),
    (("campaign", "export", "whole.db", "--format", "csv", "--out", "out.csv"), ("out.csv",)),
    (("campaign", "export", "whole.db", "--format", "npy", "--out", "out.npy"), ("out.npy",)),
    (("campaign", "query", "whole.db", "SELECT * FROM subjects", "--format", "json", "--out", "out.json"), ("out.json",)),
    (("campaign", "report", "whole.db", "--out", "report.html"), ("report.html",)),
    (("campaign", "submit", "spec.toml", "--slurm", "--shards", "2", "--dry-run", "--database", "new.db"),
     ("new.db.sbatch", "new.db.merge.sbatch")),
    (("atlas", "--specification", "spec.toml", "--out", "atlas", "--merge", "others.db", "--jobs", "2"), ("atlas",)),
    (("atlas", "--specification", "spec.toml", "--submit", "bathe", "--out", "out.db"), ("out.db",)),
    (("verify", "--exec", "/bin/cp history.csv {out}; : {h}", *SHORT, "--jobs", "2", "--format", "json",
      "--out", "out.json"), ("out.json",)),
)
SPECIFICATION = """methods = ["newmark", "rk4"]
[ladder]
levels = 2
samples_per_level = 1
[[cases]]
case = "stop"
set = { eta = [0.5, 1], t_end = { from = 2, to = 4, points = 2 } }
"""
# What a run goes on with: the command that must bring it to its end, whatever happened before.
GO_ON = {"new.db": ("campaign", "run", "spec.toml", "--database", "new.db"),
         "half.db": ("campaign", "run", "spec.toml", "--database", "half.db"),
         "atlas": ("atlas", "--specification", "spec.toml", "--out", "atlas", "--merge", "others.db")}
# Programs that misbehave, as --exec; "good" writes the exact history.
GOOD = "cp $OLDPWD/history.csv {out}"
HOSTILE = (
    'sleep 1000', 'sleep 1000 & wait', 'exec sleep 1000', "trap '' TERM INT HUP QUIT; while :; do sleep 1; done",
    'kill -STOP $$', 'kill -STOP 0', 'kill -TERM $$', 'kill -SEGV $$', 'kill -9 0', 'exit 300', 'exit 128', 'cat',
    'exec 0<&- 1>&- 2>&-; sleep 1000', 'yes >&2', 'yes', 'yes 1,2 > {out}', 'cat /dev/urandom >&2',
    'tail -f /dev/null', 'sleep 1000 &', 'setsid sleep 1000 & ' + GOOD, 'nohup sleep 1000 >/dev/null 2>&1 & ' + GOOD,
    "(setsid sh -c 'setsid sleep 1000 & setsid sleep 1000 &' &) ; " + GOOD,
    'setsid setsid sh -c \'trap "" TERM; sleep 1000\' & sleep 1000',
    'for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do setsid sleep 1000 & done; ' + GOOD,
    "setsid sh -c 'while :; do setsid sleep 1000 & sleep 0.01; done' & sleep 0.2; " + GOOD,
    'setsid kill -STOP $$ & sleep 1000', 'kill -STOP $PPID; sleep 1000', 'kill -TERM $PPID; sleep 1000',
    'kill -9 $PPID; sleep 1000', 'kill -QUIT $PPID; ' + GOOD, 'rm -rf "$PWD"', 'rm -rf "$PWD"; ' + GOOD,
    'rm -rf "$PWD"; mkdir "$PWD"', 'mv "$PWD" "$PWD-moved"; rm -r "$PWD-moved"', 'rm -rf "$PWD"; ln -s / "$PWD"',
    'rm -rf "$PWD"; mkfifo "$PWD"', 'chmod 0 .', 'mkdir -p key.txt/a; ' + GOOD,
    'mkfifo key.txt printed.txt; echo a; ' + GOOD, 'ln -s /etc/passwd key.txt; ' + GOOD,
    'rm -f problem.json .clackers-run; ' + GOOD, 'mkdir -p a/b/c; chmod 0 a/b a; ' + GOOD,
    'i=0; while [ $i -lt 60 ]; do mkdir d; cd d; i=$((i+1)); done',
    'i=0; while [ $i -lt 2000 ]; do : > f$i; i=$((i+1)); done; ' + GOOD, 'touch -t 200001010000 "$PWD"; ' + GOOD,
    'mkfifo {out}', 'mkdir {out}', 'ln -s /dev/zero {out}', 'ln -s /dev/full {out}; echo > {out}',
    'ln -s /proc/self/mem {out}', 'ln -s {out} {out}', 'truncate -s 1T {out}', 'head -c 100000 /dev/urandom > {out}',
    'head -c 3000000 /dev/zero > {out}', "printf 't,u1\\n0,nan\\n1,inf\\n' > {out}",
    "printf 't,u1\\n1,1\\n0,1\\n' > {out}", 'gzip -c $OLDPWD/history.csv > {out}',
    "printf '\\033[2J\\007\\377' >&2; exit 1", 'mkfifo {events}; ' + GOOD, 'ln -s /dev/zero {events}; ' + GOOD,
    'mkdir {events}; ' + GOOD, 'echo $(exit 1); ' + GOOD + '; exit 1', '/nowhere/solver', '/etc/passwd', '/tmp', '(',
    # What is forked, closed, held or limited.
    "(trap '' TERM INT HUP QUIT; sleep 1000) & (trap '' TERM HUP; exec sleep 1000) & wait", 'exec 1>&-; ' + GOOD,
    'exec 2>&-; ' + GOOD, "(setsid sh -c '(setsid sh -c \"sleep 1000 & sleep 1000\" &) &' &); exit 0", 'true',
    "trap 'while :; do echo dying >&2; done' TERM INT; while :; do sleep 1; done", "sh -c 'kill -STOP $$'; " + GOOD,
    'ulimit -v 200000; tail /dev/zero', 'ulimit -f 1; ' + GOOD + '; yes > more', 'ulimit -c unlimited; kill -ABRT $$',
    'ulimit -n 4; ' + GOOD, 'i=0; while [ $i -lt 200 ]; do sleep 1000 & i=$((i+1)); done; ' + GOOD,
    'exec 9>>.clackers-run; flock 9; ' + GOOD, 'kill -ALRM $PPID; ' + GOOD, 'umask 777; ' + GOOD,
    'H=$OLDPWD; cd /; cp $H/history.csv {out}', 'rm -rf "$PWD"/../*; ' + GOOD, 'unset PATH; ' + GOOD, "exec -a '' sleep 1000",
    # What becomes of the file.
    GOOD + '; mv {out} {out}.old', GOOD + '; mv {out} x; mkdir {out}', GOOD + '; chmod 0 {out}',
    GOOD + '; (while :; do echo 1,2 >> {out}; done) &', GOOD + '; touch -d 2100-01-01 {out}', 'ln $OLDPWD/history.csv {out}',
    'ln -s $OLDPWD/history.csv {out}', 'ln -s /dev/stdin {out}', 'ln -s /proc/self/fd/1 {out}',
    'mkfifo {out}; (cat $OLDPWD/history.csv > {out} &)', "printf 't,u1,u2\\n0,0,0\\n' > {out}; sleep 1000",
    "printf 't,u1,u2\\n0,0,0\\n' > {out}; truncate -s 10G {out}",
    # What is in it.
    '(head -n 1 $OLDPWD/history.csv; tail -n +2 $OLDPWD/history.csv | tac) > {out}', "sed '50,$s/[0-9]/nan/' $OLDPWD/history.csv > {out}",
    "head -c 50000000 /dev/zero | tr '\\0' 1 > {out}", "sed 's/$/\\r/' $OLDPWD/history.csv > {out}", "tr . , < $OLDPWD/history.csv > {out}",
    "iconv -t UTF-16 $OLDPWD/history.csv > {out}", "head -c 3000 $OLDPWD/history.csv > {out}", "seq -s, 100000 > {out}",
    "printf '<html>licence expired</html>' > {out}", "printf 't,\\033[2J,u1\\n0,0,0\\n1,0,0\\n' > {out}",
    "(echo t,u1,u2; yes 0,1,1 | head -n 200000) > {out}", "printf 't,u1,u2\\n-5,1e308,1e308\\n9e9,-1e308,5e-324\\n' > {out}",
    "printf '\\223NUMPY\\1\\0v\\0{{}}' > {out}", "printf 't\\nnan\\n' > {events}; " + GOOD, "head -c 9000 /dev/urandom > {events}; " + GOOD,
    "(echo t; seq 1000000) > {events}; " + GOOD,
)
STOPS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT, signal.SIGKILL)


class Failure(Exception):
    pass


def is_whole(path):
    """A complete new output, recognized by its end."""
    if path.suffix == ".npy":
        return path.read_bytes().startswith(b"\x93NUMPY")
    if path.suffix == ".db":
        return path.read_bytes().startswith(b"SQLite format 3\0")
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
        self.survived, self.usual, self.swept = {}, {}, 0
        # No program that draws: the figures' numbers are enough here.
        self.environment = {**os.environ, "PATH": "/nowhere", "XDG_CACHE_HOME": str(self.folder / "cache")}
        history = subprocess.run([command, "respond", "three-parameter", "--step", "0.1", "--format", "csv"],
                                 capture_output=True, check=True)
        (self.folder / "history.csv").write_bytes(history.stdout)
        self.old = {}
        self.make_databases()
        self.inputs = {path.name: path.read_bytes() for path in self.folder.iterdir()}
        self.half = self.inputs.pop("half.db")
        self.expected = self.exported("whole.db")

    def run(self, *arguments):
        return subprocess.run([self.command, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=60,
                              env=self.environment)

    def make_databases(self):
        (self.folder / "spec.toml").write_text(SPECIFICATION)
        for arguments in (("--database", "whole.db"), *(("--database", "part.db", "--shard", f"{i}/2") for i in (1, 2))):
            self.run("campaign", "run", "spec.toml", *arguments)
        self.run("atlas", "--specification", "spec.toml", "--submit", "bathe", "--out", "others.db")
        shutil.copy(self.folder / "whole.db", self.folder / "half.db")
        databases.change(self.folder / "half.db", *(f"DELETE FROM {table} WHERE task % 2 = 1"
                                                    for table in ("subjects", "runs", "timings")))

    def exported(self, database):
        done = [self.run("campaign", "export", database, "--format", "csv", "--table", table) for table in ("subjects", "runs")]
        return [each.stdout for each in done] if not any(each.returncode for each in done) else None

    def go_on(self, what, name):
        """After a fault the same campaign comes to its end, with the rows of one that was not disturbed."""
        done = self.run(*GO_ON[name])
        if done.returncode:
            raise Failure(f"{what}: going on ends with {done.returncode}: {done.stderr}")
        if self.exported("atlas/atlas.db" if name == "atlas" else name) != self.expected:
            raise Failure(f"{what}: {name} has other rows")
        path = self.folder / name
        if path.is_dir():
            found = sorted(str(each.relative_to(path)) for each in path.rglob("*"))
            if found != ["atlas.db", "atlas.toml", "index.html", "results", "results/others.db"]:
                raise Failure(f"{what}: {name} has {found}")

    def close(self):
        shutil.rmtree(self.folder)

    def prepare(self, outputs):
        """Old outputs stand where the new ones go, and nothing else but the inputs."""
        for path in self.folder.iterdir():
            if path.name not in self.inputs:
                shutil.rmtree(path) if path.is_dir() else path.unlink()
        for name, content in self.inputs.items():
            (self.folder / name).write_bytes(content)
        for name in outputs:
            path = self.folder / name
            if name in GO_ON:
                if name == "half.db":
                    path.write_bytes(self.half)
            elif name == "figures":
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
            if name in GO_ON:
                self.go_on(what, name)
                continue
            if not path.exists():
                raise Failure(f"{what}: {name} is gone")
            is_old = snapshot(path) == self.old[name]
            try:
                if not is_old and not is_whole(path):
                    raise Failure(f"{what}: {name} is neither old nor new")
            except (ValueError, OSError) as error:
                raise Failure(f"{what}: {name}: {error}")
        self.check_programs(what)
        for name, content in self.inputs.items():
            path = self.folder / name
            # A shard that is merged may be folded in; the log of a reader is empty.
            if path.read_bytes() != content and (path.suffix in (".csv", ".toml") or self.exported(name) is None):
                raise Failure(f"{what}: {name} has changed")
        left = sorted(each.name for each in self.folder.iterdir()
                      if each.name not in (*outputs, *self.inputs, "cache"))
        if code < 0:  # what the next writer of a shard uses
            left = [name for name in left if not name.endswith((".lock", "-wal", "-shm"))]
        # SIGKILL leaves a folder, or a file in the instant between its getting a name and its place.
        is_killed = code == -signal.SIGKILL and len(left) == 1 and left[0].startswith(".clackers-")
        if left and not is_killed:
            raise Failure(f"{what}: left {left}")
        kind = what.split(":")[0]
        self.survived[kind] = self.survived.get(kind, 0) + 1

    def check_programs(self, what):
        """No program and no folder of a run is left; where the command was killed, a moment later."""
        def left():
            found = [str(each) for each in self.folder.glob("cache/clackers/programs/.running-*")]
            for each in pathlib.Path("/proc").glob("[0-9]*"):
                with contextlib.suppress(OSError):
                    is_here = os.readlink(each / "cwd").startswith(str(self.folder))
                    if is_here and " Z " not in (each / "stat").read_text():
                        found.append((each / "cmdline").read_text())
            return found
        end = time.monotonic() + 10
        while left():
            if time.monotonic() > end:
                raise Failure(f"{what}: left {left()}")
            if what.startswith("SIGKILL") and time.monotonic() > end - 5:
                self.sweep()
            time.sleep(0.01)

    def sweep(self):
        """The next command removes the folders of killed ones when they are old enough."""
        self.swept += 1
        for each in self.folder.glob("cache/clackers/programs/.running-*"):
            os.utime(each, (1, 1))
        subprocess.run([self.command, "verify", "--exec", "exit {n}", *SHORT], env=self.environment, capture_output=True)

    def hostile(self, program, jobs):
        """A program that misbehaves costs its own runs only."""
        self.prepare(("out.json",))
        what = f"hostile: {program} with {jobs} jobs"
        process = self.start(("verify", "rk4", "--exec", program + "\n: {h} {events}", "--name", "hostile", *SHORT,
                              "--timeout", "0.4s", "--jobs", str(jobs), "--format", "json", "--out", "out.json"),
                             PATH=os.environ["PATH"])
        message = process.communicate(timeout=60)[1].decode()
        self.check(f"{what}\n{message}", ("out.json",), process.returncode, (0, 1, 3, 4))
        for subject in json.loads((self.folder / "out.json").read_text())["cases"][0]["subjects"]:
            runs = [run for level in subject["levels"] for run in level["runs"]]
            if len(runs) != 2 or (subject["name"] == "rk4" and not all(run["finished"] for run in runs)):
                raise Failure(f"{what}: runs are lost")
            if any(run["finished"] == bool(run["failure_code"]) for run in runs):
                raise Failure(f"{what}: a run failed without a code")
        if "\x1b" in message:
            raise Failure(f"{what}: controls the terminal")

    def kill(self, sign, jobs):
        """A signal at a random moment while programs run whose children leave their group."""
        program = "setsid sleep 1000 & sleep 0.05; cp history.csv {out}; : {h}"
        arguments = ("verify", "--exec", program, "--coarsest", "0.05", "--levels", "3", "--samples-per-level", "4",
                     "--jobs", str(jobs), "--format", "json", "--out", "out.json")
        self.end(arguments, ("out.json",), (sign,), 0.05 + 0.9 / jobs, PATH=os.environ["PATH"])

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
        if kind == "thread" and "[system-failed]" in message:
            allowed = (4,)  # a campaign needs a second thread
        if "internal-error" in message:
            raise Failure(f"{what}\n{message}")
        self.check(f"{what}\n{message}", outputs, process.returncode, allowed)
        if process.returncode and not message and process.returncode not in (1, 3):
            raise Failure(f"{what}: exit code {process.returncode} without a message")

    def end(self, arguments, outputs, signs, longest, **changes):
        self.prepare(outputs)
        process = self.start(arguments, **changes)
        time.sleep(self.random.random() * longest)
        for sign in signs:
            process.send_signal(sign)
        process.communicate(timeout=60)
        names = "+".join(sign.name for sign in signs)
        allowed = EXIT_CODES if process.returncode >= 0 else tuple(-sign for sign in signs)
        self.check(f"{names}: in {' '.join(arguments)}", outputs, process.returncode, allowed)


def programs(runner, randomness, kills=100):
    """Each hostile program with one job and with four, and kills."""
    faults = [lambda p=program, j=jobs: runner.hostile(p, j) for program in HOSTILE for jobs in (1, 4)]
    faults += [lambda s=STOPS[number % len(STOPS)], j=randomness.randint(1, 8): runner.kill(s, j)
               for number in range(kills)]
    randomness.shuffle(faults)
    return iter(faults)


def plan(runner, randomness, only):
    """Endless: one fault after another, each kind of each command in turn."""
    others = programs(runner, randomness)
    if list(only) == ["programs"]:
        yield from others
        return
    counted = [(arguments, outputs, runner.counts(arguments, outputs)) for arguments, outputs in COMMANDS
               if arguments[0] in only or not only]
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
            yield next(others, lambda: None)
        if not any(todo.values()):
            print("every call of every kind has failed once")
            return


def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--command", required=True, type=os.path.abspath)
    options.add_argument("--library", required=True, type=os.path.abspath)
    options.add_argument("--seconds", type=float, default=25, help="of faults")
    options.add_argument("--seed", type=int, default=20221122)
    options.add_argument("--only", nargs="*", default=(),
                         help="commands: campaign, atlas, ...; or programs: hostile ones and kills, each once")
    options = options.parse_args()
    randomness = random.Random(options.seed)
    runner = Runner(options.command, options.library, randomness)
    end, failures = None, []
    try:
        for fault in plan(runner, randomness, options.only):
            end = end or time.monotonic() + options.seconds  # what comes before the first fault is not counted
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
          + ", ".join(f"{kind} {number}" for kind, number in sorted(runner.survived.items()))
          + f"; after {runner.swept} SIGKILLs the next command removed the folder of a run")
    return 1 if failures or not total else 0


if __name__ == "__main__":
    sys.exit(main())
