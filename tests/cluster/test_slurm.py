"""A campaign as a job array of a real Slurm, and under srun."""
import contextlib
import os
import signal
import time
import unittest

from cluster import PROGRAM, CampaignTest
from slurm import slurm


class InSlurm(CampaignTest):
    """One Slurm for all: it takes seconds to start."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        with contextlib.ExitStack() as stack:
            cls.slurm = stack.enter_context(slurm(cls.new_folder(stack)))
            cls.addClassCleanup(stack.pop_all().close)

    def submit(self, *options):
        done = self.slurm.run(PROGRAM, "campaign", "submit", self.specification, "--database",
                              self.path("runs.db"), "--slurm", *options, cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        return [line.split()[2].rstrip(":") for line in done.stderr.splitlines() if line.startswith("Submitted job")]

    def logs(self):
        return {name: self.text_of(name) for name in sorted(os.listdir(self.folder)) if name.endswith(".log")}

    def test_array_and_merge(self):
        array, merge = self.submit("--shards", "4", "--sbatch", "time=00:05:00")
        self.assertEqual(self.slurm.wait(array), ["COMPLETED"], self.logs())
        self.assertEqual(self.slurm.wait(merge), ["COMPLETED"], self.logs())
        for i in range(1, 5):
            self.assertTrue(os.path.exists(self.path(f"runs.db.shard-{i}-of-4")))
        self.assert_complete("runs.db")

    def stop_and_start_again(self, stop, state):
        """An element ends amid its tasks, by `stop`, and then the same one is submitted again."""
        self.submit("--shards", "2", "--dry-run")
        shard, script = self.path("runs.db.shard-1-of-2"), self.path("longer.sbatch")
        with open(script, "w", encoding="utf-8") as file:
            file.write(self.text_of("runs.db.sbatch").replace(self.specification, self.longer))
        job = self.slurm.run("sbatch", "--parsable", "--array=1", script).stdout.strip()
        self.wait_for(lambda: self.has_stored(shard))
        time.sleep(0.7)  # that transaction ends, and half a second later the next
        stop(f"{job}_1")
        self.assertEqual(self.slurm.wait(job), [state], self.logs())
        before = self.timings(shard)
        self.assertTrue(before)
        again = self.slurm.run("sbatch", "--parsable", "--array=1", script).stdout.strip()
        self.assertEqual(self.slurm.wait(again), ["COMPLETED"], self.logs())
        after = self.timings(shard)
        self.assertEqual({task: after[task] for task in before}, before, "finished tasks are not computed again")
        self.assertGreater(len(after), len(before))

    def test_killed_element_goes_on(self):
        def kill(_):
            for pid in self.processes_of(self.longer):
                os.kill(pid, signal.SIGKILL)
        self.stop_and_start_again(kill, "FAILED")

    def test_cancelled_element_goes_on(self):
        self.stop_and_start_again(lambda element: self.slurm.run("scancel", element), "CANCELLED")

    def test_srun_with_mpi(self):
        done = self.slurm.run("srun", "--mpi=pmix", "-n", "2", PROGRAM, "campaign", "run", self.specification,
                              "--database", self.path("runs.db"), cwd=self.folder, timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_complete("runs.db")

    def test_srun_without_mpi_is_refused(self):
        done = self.slurm.run("srun", "-n", "2", PROGRAM, "campaign", "run", self.specification,
                              "--database", self.path("runs.db"), cwd=self.folder)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("[no-mpi]", done.stderr)
        self.assertFalse(os.path.exists(self.path("runs.db")))

    def test_what_slurm_refuses(self):
        done = self.slurm.run(PROGRAM, "campaign", "submit", self.specification, "--slurm", "--shards", "2",
                              "--sbatch", "partition=none", cwd=self.folder)
        self.assertEqual(done.returncode, 4)
        self.assertRegex(done.stderr, r"partition.*\[scheduler-failed\]\n\Z")


if __name__ == "__main__":
    unittest.main()
