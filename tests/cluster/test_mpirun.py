"""Campaigns under mpirun."""
import os
import signal
import subprocess
import unittest

from cluster import PROGRAM, CampaignTest, mpi_command, mpirun


class Mpirun(CampaignTest):
    def test_rows_are_those_of_one_process(self):
        for ranks in (2, 5):
            name = f"ranks{ranks}.db"
            done = mpirun(ranks, PROGRAM, "campaign", "run", self.specification, "--database", self.path(name))
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertEqual(done.stdout.count("finished"), 1, "rank 0 alone prints")
            self.assert_complete(name)

    def test_a_rank_alone_needs_no_messages(self):
        done = mpirun(1, PROGRAM, "campaign", "run", self.specification, "--database", self.path("one.db"))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assert_complete("one.db")

    def test_shards_of_other_ranks_are_picked_up_without_mpi(self):
        self.good("campaign", "run", self.specification, "--database", self.path("part.db"), "--shard", "2/3")
        os.rename(self.path("part.db.shard-2-of-3"), self.path("runs.db.rank-17"))
        self.good("campaign", "run", self.specification, "--database", self.path("runs.db"))
        self.assert_complete("runs.db")

    def test_a_refusal_is_printed_once(self):
        missing = self.path("missing.toml")
        done = mpirun(3, PROGRAM, "campaign", "run", missing, "--database", self.path("runs.db"))
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual(done.stderr.count("clackers: "), 1, done.stderr)
        self.assertIn("[cannot-read]", done.stderr)
        self.assertFalse(os.path.exists(self.path("runs.db")))

    def test_second_start_is_refused(self):
        database = self.path("runs.db")
        first = subprocess.Popen(mpi_command(2, PROGRAM, "campaign", "run", self.endless, "--database", database),
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        try:
            self.wait_for(lambda: os.path.exists(database + ".rank-1"))
            for start in (self.run_command, lambda *words: mpirun(2, PROGRAM, *words)):
                done = start("campaign", "run", self.endless, "--database", database)
                self.assertNotEqual(done.returncode, 0)
                self.assertIn("[database-busy]", done.stderr)
        finally:
            first.send_signal(signal.SIGINT)
            first.communicate(timeout=60)
        self.assertNotEqual(first.returncode, 0)
        self.assertFalse(self.processes_of(database))

    def test_interrupted_keeps_what_is_finished(self):
        database = self.path("runs.db")
        first = subprocess.Popen(mpi_command(3, PROGRAM, "campaign", "run", self.endless, "--database", database),
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.wait_for(lambda: self.finished(database) > 0)
        first.send_signal(signal.SIGINT)
        first.communicate(timeout=60)
        self.assertNotEqual(first.returncode, 0)
        self.assertGreater(self.finished(database), 0)


if __name__ == "__main__":
    unittest.main()
