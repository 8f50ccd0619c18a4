"""A real Slurm on this machine, in a folder of its own, for the tests beside this file."""
import contextlib
import os
import pwd
import shutil
import signal
import socket
import subprocess
import time
import unittest

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "srun", "scontrol")
CONFIGURATION = """\
ClusterName=test
SlurmctldHost=localhost
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerType=sched/builtin
SchedulerParameters=batch_sched_delay=0,sched_interval=1,sched_min_interval=1000
EpilogMsgTime=0
KillWait=2
MpiDefault=none
ReturnToService=2
MinJobAge=2
NodeName=localhost CPUs={cpus} RealMemory=1000 State=UNKNOWN
PartitionName=all Nodes=localhost Default=YES MaxTime=INFINITE State=UP
"""
START = 20.0  # seconds until the node is idle, at most
STOP = 2.0  # seconds that the daemons have to end in


def skip_unless_possible():
    if os.geteuid() != 0:
        raise unittest.SkipTest("Slurm's daemons are started by root alone")
    path = os.environ["PATH"] + ":/usr/sbin:/sbin"
    missing = [program for program in PROGRAMS if not shutil.which(program, path=path)]
    if missing:
        raise unittest.SkipTest(f"not installed: {', '.join(missing)}; scripts/setup all")


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for each in sockets:
        each.bind(("localhost", 0))
    ports = [each.getsockname()[1] for each in sockets]
    for each in sockets:
        each.close()
    return ports


def send(pid, number):
    with contextlib.suppress(ProcessLookupError):
        os.kill(pid, number)


def runs(pid):
    """Whether a process is there, and not just unburied."""
    try:
        with open(f"/proc/{pid}/stat", encoding="utf-8") as file:
            return file.read().rpartition(")")[2].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):  # the second where it ends between open and read
        return False


class Slurm:
    """Its daemons' files, and its commands."""

    def __init__(self, folder):
        self.folder = folder
        self.configuration = os.path.join(folder, "slurm.conf")
        self.environment = dict(os.environ, SLURM_CONF=self.configuration,
                                PATH=os.environ["PATH"] + ":/usr/sbin:/sbin")

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def run(self, *command, timeout=30, **more):
        """The finished process, with its texts."""
        return subprocess.run(command, env=self.environment, capture_output=True, text=True,
                              timeout=timeout, **more)

    def _must(self, *command, **more):
        done = self.run(*command, **more)
        if done.returncode:
            raise RuntimeError(f"{' '.join(command)}: {done.stdout}{done.stderr}")

    def _start_munge(self):
        user = pwd.getpwnam("munge")
        folder = self.path("munge")
        os.mkdir(folder)
        with open(self.path("munge", "key"), "wb") as file:
            file.write(os.urandom(128))
        os.chmod(self.path("munge", "key"), 0o600)
        for name in (folder, self.path("munge", "key")):
            os.chown(name, user.pw_uid, user.pw_gid)
        os.chmod(folder, 0o711)
        self._must("munged", "--force", "--key-file", self.path("munge", "key"),
                   "--socket", self.path("munge", "socket"), "--pid-file", self.path("munge", "pid"),
                   "--log-file", self.path("munge", "log"), "--seed-file", self.path("munge", "seed"),
                   user=user.pw_uid, group=user.pw_gid, extra_groups=[], cwd=folder)

    def start(self):
        os.chmod(self.folder, 0o755)
        for name in ("state", "spool"):
            os.mkdir(self.path(name))
        with open(self.configuration, "w", encoding="utf-8") as file:
            file.write(CONFIGURATION.format(folder=self.folder, ports=free_ports(2), cpus=os.cpu_count()))
        self._start_munge()
        self._must("slurmctld", "-f", self.configuration)
        self._must("slurmd", "-N", "localhost", "-f", self.configuration)
        end = time.monotonic() + START
        while self.run("sinfo", "--noheader", "--format=%t").stdout.strip() != "idle":
            if time.monotonic() > end:
                raise RuntimeError(f"Slurm did not start within {START} s: see {self.folder}")
            time.sleep(0.1)

    def _pids(self):
        for name in ("slurmd.pid", "slurmctld.pid", os.path.join("munge", "pid")):
            with contextlib.suppress(FileNotFoundError, ValueError):
                with open(self.path(name), encoding="utf-8") as file:
                    yield int(file.read())

    def stop(self):
        """SIGTERM to the daemons, SIGKILL to those that are still there after a while."""
        pids = list(self._pids())
        for pid in pids:
            send(pid, signal.SIGTERM)
        end = time.monotonic() + STOP
        while any(runs(pid) for pid in pids) and time.monotonic() < end:
            time.sleep(0.05)
        for pid in filter(runs, pids):
            send(pid, signal.SIGKILL)

    def states(self, job):
        """The states of the elements of a job, each once; none once Slurm has forgotten it."""
        shown = self.run("squeue", "--noheader", "--array", "--states=all", f"--jobs={job}", "--format=%T")
        return sorted(set(shown.stdout.split()))

    def wait(self, job, seconds=60.0):
        """Waits until a job has ended; returns the last states that were seen."""
        end, states = time.monotonic() + seconds, []
        while now := self.states(job):
            states = now
            if not {"PENDING", "RUNNING", "CONFIGURING", "COMPLETING"} & set(states):
                break
            if time.monotonic() > end:
                raise RuntimeError(f"job {job} is {states} after {seconds} s")
            time.sleep(0.1)
        return states


@contextlib.contextmanager
def slurm(folder):
    """A Slurm that runs in a folder; skips the test where that cannot be."""
    skip_unless_possible()
    cluster = Slurm(folder)
    try:
        cluster.start()
        yield cluster
    finally:
        cluster.stop()
