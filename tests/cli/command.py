"""Runs the built command for the tests beside this file."""
import csv
import io
import json
import os
import pty
import signal
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = os.environ["CLACKERS"]
# "python3" is the interpreter of the tests: one that a version manager puts first on the path may take 0.4 s to start.
os.environ["PATH"] = os.path.dirname(sys.executable) + os.pathsep + os.environ["PATH"]

# The methods assessed when none is named.
PANEL = ("newmark", "central-difference", "rk4", "generalized-alpha:rho=0.8", "newmark+reversal",
         "newmark+penalty", "moreau-jean")

# A ladder that takes a moment: enough rows to print, too few to judge.
SHORT_LADDER = ("--coarsest", "0.05", "--levels", "2", "--samples-per-level", "1")
# A ladder that takes minutes, to be interrupted.
LONG_LADDER = ("--coarsest", "2e-5", "--levels", "5", "--set", "a_t=20")


def listens_to_signals():
    """Runs in the child: a shell that puts the tests into the background ignores Ctrl-C."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def environment(**changes):
    """The environment of a test: no colours asked or refused unless `changes` say so."""
    env = {k: v for k, v in os.environ.items() if k not in ("NO_COLOR", "COLUMNS")}
    env["TERM"] = "xterm"
    env.update(changes)
    return env


def run(*arguments, stdin="", timeout=60, **more):
    """The finished process, with its texts."""
    return subprocess.run([PROGRAM, *arguments], input=stdin, capture_output=True, text=True,
                          timeout=timeout, env=environment(), **more)


def start(*arguments, **more):
    """A running process that listens to signals."""
    more.setdefault("stdin", subprocess.DEVNULL)
    return subprocess.Popen([PROGRAM, *arguments], env=more.pop("env", environment()),
                            preexec_fn=listens_to_signals, **more)


def read_terminal(descriptor, until=None):
    """What was written to a pseudo-terminal: to its end, or until a text appears."""
    text = b""
    while until is None or until not in text:
        try:
            part = os.read(descriptor, 65536)
        except OSError:  # Linux says EIO when the other end is closed
            break
        if not part:
            break
        text += part
    return text.decode()


def run_on_terminal(*arguments, stream="stdout", env=None):
    """(exit code, what the terminal saw) with one stream on a pseudo-terminal."""
    ours, theirs = pty.openpty()
    streams = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, stream: theirs}
    process = start(*arguments, env=env or environment(), **streams)
    os.close(theirs)
    text = read_terminal(ours)
    os.close(ours)
    return process.wait(60), text


def rows(text):
    """The rows of a csv text as dictionaries."""
    return list(csv.DictReader(io.StringIO(text)))


class CommandTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def text_of(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return file.read()

    def files(self):
        return sorted(os.listdir(self.folder))

    def open_files(self, process):
        """Files of the test's folder that a process has open, those without a name included."""
        found = []
        for number in os.listdir(f"/proc/{process.pid}/fd"):
            try:
                found.append(os.readlink(f"/proc/{process.pid}/fd/{number}"))
            except FileNotFoundError:
                pass
        return [path for path in found if path.startswith(self.folder + "/")]

    def good(self, *arguments, **more):
        """Standard output of a command that must succeed and say nothing else."""
        done = run(*arguments, **more)
        self.assertEqual((done.returncode, done.stderr), (0, ""), arguments)
        return done.stdout

    def json_of(self, *arguments, **more):
        return json.loads(self.good(*arguments, "--format", "json", **more))

    def rows_of(self, *arguments, **more):
        return rows(self.good(*arguments, "--format", "csv", **more))

    def refused(self, *arguments, code, says=(), exit_code=2, **more):
        """A command that must be refused in one line with its code, and print no result."""
        done = run(*arguments, **more)
        self.assertEqual(done.returncode, exit_code, (arguments, done.stdout, done.stderr))
        self.assertEqual(done.stdout, "", arguments)
        self.assertRegex(done.stderr, r"\Aclackers: (?!clackers)[^\n]+ \[%s\]\n\Z" % code, arguments)
        for text in [says] if isinstance(says, str) else says:
            self.assertIn(text, done.stderr, arguments)
        return done.stderr

    def wait_for(self, condition, seconds=30):
        end = time.monotonic() + seconds
        while not condition():
            self.assertLess(time.monotonic(), end, "waited in vain")
            time.sleep(0.01)
