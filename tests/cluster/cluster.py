"""What the tests beside this file share: a folder, the command, mpirun, and a campaign."""
import contextlib
import glob
import os
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import unittest

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "cli"))
from command import PROGRAM, CommandTest  # noqa: E402

MPIRUN = shutil.which("mpirun")
# More ranks than cores, and tests run as root.
MPIRUN_OPTIONS = ("--allow-run-as-root", "--oversubscribe", "--bind-to", "none")


def run(*command, timeout=60, **more):
    """The finished process, with its texts."""
    return subprocess.run(command, capture_output=True, text=True, timeout=timeout, **more)


def clackers(*arguments, **more):
    return run(PROGRAM, *arguments, **more)


def mpi_command(ranks, *command):
    return [MPIRUN, *MPIRUN_OPTIONS, "-n", str(ranks), *command]


def mpirun(ranks, *command, **more):
    """The finished process. `mpirun -n 64 true`, too, hangs now and then: then it is started once more."""
    if not MPIRUN:
        raise unittest.SkipTest("no mpirun: scripts/setup all")
    with contextlib.suppress(subprocess.TimeoutExpired):
        return run(*mpi_command(ranks, *command), **more)
    return run(*mpi_command(ranks, *command), **more)


SPECIFICATION = """\
methods = ["newmark", "rk4", "moreau-jean"]

[ladder]
levels = 3
samples_per_level = 1

[[cases]]
case = "three-parameter"
set = { N = [0, 1, 2], xi1 = { from = 0.01, to = 0.2, points = %d } }
"""


class CampaignTest(CommandTest):
    """A campaign of a moment, one of seconds, and one that is always interrupted."""

    @classmethod
    def setUpClass(cls):
        with contextlib.ExitStack() as stack:
            cls.shared = cls.new_folder(stack)
            cls.addClassCleanup(stack.pop_all().close)
        cls.specification = cls.write_specification("spec.toml", 10)
        cls.longer = cls.write_specification("longer.toml", 2000)
        cls.endless = cls.write_specification("endless.toml", 100000)
        database = os.path.join(cls.shared, "expected.db")
        clackers("campaign", "run", cls.specification, "--database", database)
        cls.expected = cls.exported(database)

    @staticmethod
    def new_folder(stack):
        return stack.enter_context(tempfile.TemporaryDirectory())

    @classmethod
    def write_specification(cls, name, points):
        path = os.path.join(cls.shared, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(SPECIFICATION % points)
        return path

    @staticmethod
    def exported(database):
        """Everything deterministic, as text."""
        return [clackers("campaign", "export", database, "--format", "csv", "--table", table).stdout
                for table in ("subjects", "runs")]

    def assert_complete(self, name):
        """The rows of one process; no rank has left a file."""
        exported = self.exported(self.path(name))
        self.assertGreater(len(exported[0].splitlines()), 2)
        self.assertEqual(exported, self.expected)
        self.assertEqual(glob.glob(self.path(name) + ".rank-*"), [])

    def run_command(self, *arguments):
        return clackers(*arguments)

    def good(self, *arguments):
        done = clackers(*arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""), arguments)
        return done.stdout

    @staticmethod
    def select(database, statement):
        """The rows of a database and of the ranks beside it; none before they have tables,
        and none of shards that are being written."""
        rows = []
        for path in [database, *glob.glob(database + ".rank-*")]:
            if not path.endswith(("-wal", "-shm", ".lock")) and os.path.exists(path):
                with contextlib.closing(sqlite3.connect(path, timeout=0)) as connection:
                    with contextlib.suppress(sqlite3.DatabaseError):
                        rows += connection.execute(statement).fetchall()
        return rows

    def finished(self, database):
        return len(set(self.select(database, "SELECT task FROM subjects")))

    @staticmethod
    def has_stored(shard):
        """Whether tasks were stored in a shard that is being written: its log is longer than the schema."""
        return os.path.exists(shard + "-wal") and os.path.getsize(shard + "-wal") > 200_000

    def timings(self, database):
        """The processor time of each finished task, other than that of any other run."""
        return dict(self.select(database, "SELECT task, sum(seconds) FROM timings GROUP BY task"))

    @staticmethod
    def processes_of(word):
        """The numbers of the processes with a word in their command lines."""
        found = []
        for path in glob.glob("/proc/[0-9]*/cmdline"):
            with contextlib.suppress(FileNotFoundError, ProcessLookupError), open(path, "rb") as file:
                if word.encode() in file.read():
                    found.append(int(path.split("/")[2]))
        return found
