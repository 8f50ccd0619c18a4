"""`campaign submit`: the scripts it writes and what it refuses. tests/cluster submits them."""
import os
import stat
import subprocess

from command import CommandTest, PROGRAM, environment

SPECIFICATION = """\
methods = ["newmark"]
[[cases]]
case = "stop"
set = { eta = [0.5, 1] }
"""


class Submit(CommandTest):
    def setUp(self):
        super().setUp()
        with open(self.path("spec.toml"), "w", encoding="utf-8") as file:
            file.write(SPECIFICATION)

    def submit(self, *options, path=None):
        """The finished process, which runs in the test's folder."""
        env = environment(**({"PATH": path} if path is not None else {}))
        return subprocess.run([PROGRAM, "campaign", "submit", "spec.toml", "--slurm", *options], cwd=self.folder,
                              capture_output=True, text=True, timeout=60, env=env)

    def fake_sbatch(self, script):
        """A PATH with a program sbatch of ours."""
        os.mkdir(self.path("bin"))
        with open(self.path("bin/sbatch"), "w", encoding="utf-8") as file:
            file.write("#!/bin/sh\n" + script)
        os.chmod(self.path("bin/sbatch"), stat.S_IRWXU)
        return self.path("bin") + ":/usr/bin:/bin"

    def test_scripts(self):
        done = self.submit("--shards", "3", "--jobs", "2", "--sbatch", "time=10", "--sbatch", "partition=a",
                           "--sbatch", "comment=it's \"a\" # b", "--sbatch", "exclusive", "--database", "it's 5%.db", "--dry-run")
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
        array, merge = self.text_of("it's 5%.db.sbatch"), self.text_of("it's 5%.db.merge.sbatch")
        for line in ("#!/bin/sh", "#SBATCH --array=1-3", "#SBATCH --cpus-per-task=2", "#SBATCH --requeue",
                     "#SBATCH --time=10", "#SBATCH --partition=a",
                     '#SBATCH --comment="it\'s \\"a\\" # b"', "#SBATCH --exclusive",
                     f"#SBATCH --output=\"{self.folder}/it's 5%%.db.shard-%a.log\""):
            self.assertIn(line + "\n", array)
        self.assertIn("--time=10", merge)
        self.assertNotIn("--array", merge)
        self.assertFalse(os.path.exists(self.path("it's 5%.db")))

    def test_default_names_are_in_the_current_folder(self):
        os.mkdir(self.path("here"))
        done = subprocess.run([PROGRAM, "campaign", "submit", "../spec.toml", "--slurm", "--shards", "2", "--dry-run"],
                              cwd=self.path("here"), capture_output=True, text=True, timeout=60, env=environment())
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.files(), ["here", "spec.toml"])
        self.assertEqual(sorted(os.listdir(self.path("here"))), ["spec.db.merge.sbatch", "spec.db.sbatch"])

    def test_files_of_others_stay(self):
        for name in ("spec.db.sbatch", "spec.db.merge.sbatch"):
            with open(self.path(name), "w", encoding="utf-8") as file:
                file.write("mine\n")
            self.failed(self.submit("--shards", "2", "--dry-run"), "cannot-write", 4, "another file")
            self.assertEqual(self.text_of(name), "mine\n")
            os.remove(self.path(name))
        self.assertEqual([self.submit("--shards", "2", "--dry-run").returncode for _ in range(2)], [0, 0])

    def test_scripts_are_what_a_shell_runs(self):
        self.submit("--shards", "2", "--database", "it's 5%.db", "--dry-run")
        for shard in "12":
            ran = subprocess.run(["sh", self.path("it's 5%.db.sbatch")], cwd="/", capture_output=True, text=True,
                                 timeout=60, env=environment(SLURM_ARRAY_TASK_ID=shard))
            self.assertEqual((ran.returncode, ran.stderr), (0, ""))
        self.assertTrue(os.path.exists(self.path("it's 5%.db.shard-2-of-2")))
        ran = subprocess.run(["sh", self.path("it's 5%.db.merge.sbatch")], cwd="/", capture_output=True, text=True,
                             timeout=60, env=environment())
        self.assertEqual((ran.returncode, ran.stderr), (0, ""))
        rows = self.rows_of("campaign", "export", self.path("it's 5%.db"), "--table", "subjects")
        self.assertEqual([row["task"] for row in rows], ["0", "1"])

    def test_merging_waits_for_the_array(self):
        path = self.fake_sbatch(f'echo "$@" >> {self.path("calls")}\necho warning >&2\necho "41;cluster"\n')
        done = self.submit("--shards", "2", path=path)
        self.assertEqual(done.returncode, 0, done.stderr)
        calls = self.text_of("calls").splitlines()
        self.assertEqual(calls[0], f"--parsable {self.folder}/spec.db.sbatch")
        self.assertIn("--dependency=afterok:41 ", calls[1])
        self.assertTrue(calls[1].endswith(f"{self.folder}/spec.db.merge.sbatch"))

    def failed(self, done, code, exit_code, text):
        self.assertEqual(done.returncode, exit_code, done.stderr)
        self.assertRegex(done.stderr, r"clackers: [^\n]+ \[%s\]\n\Z" % code)
        self.assertIn(text, done.stderr)

    def test_scheduler_that_refuses(self):
        path = self.fake_sbatch("echo 'sbatch: error: invalid partition' >&2\nexit 1\n")
        self.failed(self.submit("--shards", "2", path=path), "scheduler-failed", 4, "invalid partition")

    def test_scheduler_without_a_number(self):
        path = self.fake_sbatch("echo hello\n")
        self.failed(self.submit("--shards", "2", path=path), "scheduler-failed", 4, "hello")

    def test_no_scheduler(self):
        self.failed(self.submit("--shards", "2", path="/nowhere"), "scheduler-failed", 4, "sbatch")

    def test_refused_options(self):
        spec = self.path("spec.toml")
        for options, text in ((["--shards", "2"], "--slurm"), (["--slurm"], "--shards"),
                              (["--slurm", "--shards", "0"], "--shards"),
                              (["--slurm", "--shards", "2", "--sbatch", "-t"], "--sbatch"),
                              (["--slurm", "--shards", "2", "--sbatch", "time=1\ntime=2"], "several lines")):
            self.failed(self.run_submit(spec, *options), "out-of-range|bad-syntax", 2, text)
        self.refused("campaign", "run", spec, "--slurm", code="bad-syntax", says="--slurm")
        self.assertEqual(self.files(), ["spec.toml"])

    def run_submit(self, spec, *options):
        return subprocess.run([PROGRAM, "campaign", "submit", spec, *options], capture_output=True, text=True,
                              timeout=60, env=environment())

    def test_specification_is_read_before_anything_is_submitted(self):
        with open(self.path("spec.toml"), "a", encoding="utf-8") as file:
            file.write("sett = 1\n")
        done = self.submit("--shards", "2")
        self.assertEqual(done.returncode, 2)
        self.assertIn("sett", done.stderr)
        self.assertEqual(self.files(), ["spec.toml"])
