"""What the tests beside this file share: a folder, the command, and mpirun."""
import os
import shutil
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["CLACKERS"]
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
    if not MPIRUN:
        raise unittest.SkipTest("no mpirun: scripts/setup test")
    return run(*mpi_command(ranks, *command), **more)


class ClusterTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def text_of(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return file.read()
