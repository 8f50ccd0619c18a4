"""--out: whole or not at all, whatever the disk does."""
import csv
import os
import resource
import shutil
import signal
import stat
import subprocess
import tempfile
import time
import unittest

from command import LONG_LADDER, PROGRAM, SHORT_LADDER, CommandTest, environment, rows, run, start

ROWS = ("respond", "sdof", "--samples", "2000", "--format", "csv")
# Other work on the machine may delay a process.
SLOW = 5
ENDLESS = ("respond", "three-parameter", "--samples", "1e9", "--format", "csv")


class Written(CommandTest):
    def test_out_holds_what_standard_output_would_and_leaves_nothing_else(self):
        done = run(*ROWS, "--out", self.path("rows.csv"))
        self.assertEqual((done.returncode, done.stdout), (0, ""))
        self.assertEqual(done.stderr, f"Wrote {self.path('rows.csv')}\n")
        self.assertEqual(self.files(), ["rows.csv"])
        self.assertEqual(self.text_of("rows.csv"), self.good(*ROWS))

    def test_quiet_says_nothing(self):
        self.assertEqual(self.good(*ROWS, "--quiet", "--out", self.path("rows.csv")), "")

    def test_relative_names_are_of_the_working_folder(self):
        self.good(*ROWS, "--quiet", "--out", "rows.csv", cwd=self.folder)
        self.assertEqual(self.files(), ["rows.csv"])

    def test_replaces_an_old_file_and_keeps_its_mode(self):
        with open(self.path("old"), "w") as file:
            file.write("x" * 10**6)
        os.chmod(self.path("old"), 0o640)
        self.good("list", "cases", "--quiet", "--out", self.path("old"))
        self.assertEqual(self.text_of("old"), self.good("list", "cases"))
        self.assertEqual(stat.S_IMODE(os.stat(self.path("old")).st_mode), 0o640)

    def test_new_files_respect_the_umask(self):
        self.good("list", "--quiet", "--out", self.path("new"), preexec_fn=lambda: os.umask(0o027))
        self.assertEqual(stat.S_IMODE(os.stat(self.path("new")).st_mode), 0o640)

    def test_follows_a_link(self):
        os.mkdir(self.path("elsewhere"))
        with open(self.path("elsewhere/real"), "w"):
            pass
        os.symlink("elsewhere/real", self.path("link"))
        self.good("list", "cases", "--quiet", "--out", self.path("link"))
        self.assertTrue(os.path.islink(self.path("link")))
        with open(self.path("elsewhere/real")) as file:
            self.assertEqual(file.read(), self.good("list", "cases"))
        self.assertEqual(os.listdir(self.path("elsewhere")), ["real"])

    def test_devices_and_pipes_are_written_directly(self):
        self.good("list", "--quiet", "--out", "/dev/null")
        self.assertTrue(stat.S_ISCHR(os.stat("/dev/null").st_mode))
        self.assertEqual(self.good("list", "cases", "--quiet", "--out", "/dev/stdout"),
                         self.good("list", "cases"))
        os.mkfifo(self.path("pipe"))
        with start("list", "cases", "--quiet", "--out", self.path("pipe")) as process:
            with open(self.path("pipe")) as file:
                self.assertEqual(file.read(), self.good("list", "cases"))
        self.assertEqual(process.returncode, 0)

    def test_dev_stdout_appends_where_the_shell_redirected_it(self):
        with open(self.path("all"), "w") as file:
            subprocess.run(["sh", "-c", 'echo before; "$0" list cases --quiet --out /dev/stdout; echo after',
                            PROGRAM], stdout=file, check=True, env=environment())
        self.assertEqual(self.text_of("all"), "before\n" + self.good("list", "cases") + "after\n")


class NotWritten(CommandTest):
    def cannot_write(self, *arguments, says, **more):
        return self.refused(*arguments, exit_code=4, code="cannot-write", says=says, **more)

    def test_a_folder_that_does_not_exist(self):
        path = self.path("none/rows.csv")
        for command in (ROWS, ("list",), ("show", "stop"), ("explain",), ("verify",)):
            self.cannot_write(*command, "--out", path, says=(path, "No such file", "Create the folder"))
        self.cannot_write("verify", "--report", self.path("none/page.html"), says=self.path("none"))

    def test_a_folder_instead_of_a_file(self):
        self.cannot_write(*ROWS, "--out", self.folder, says=(self.folder, "directory", "Name a file"))
        self.cannot_write("verify", "--report", self.folder, says=self.folder)
        self.cannot_write(*ROWS, "--out", self.path("new/"), says=self.path("new/"))
        self.assertEqual(self.files(), [])

    def test_is_noticed_before_the_work(self):
        for path in (self.folder, self.path("x" * 300), self.path("none/x"), self.path("new/")):
            for option in ("--out", "--report"):
                self.cannot_write("verify", "rk4", *LONG_LADDER, option, path, says=path, timeout=10)

    def test_a_file_as_folder(self):
        with open(self.path("file"), "w"):
            pass
        self.cannot_write(*ROWS, "--out", self.path("file/rows"), says="Not a directory")

    def test_a_name_that_is_too_long(self):
        self.cannot_write(*ROWS, "--out", self.path("x" * 300), says="name too long")
        self.assertEqual(self.files(), [])

    @unittest.skipIf(os.geteuid() == 0, "root may write everywhere")
    def test_without_permission(self):
        os.chmod(self.folder, 0o500)
        self.cannot_write(*ROWS, "--out", self.path("x"), says="Permission denied")
        os.chmod(self.folder, 0o700)
        with open(self.path("kept"), "w"):
            pass
        os.chmod(self.path("kept"), 0o400)
        self.cannot_write(*ROWS, "--out", self.path("kept"), says="Permission denied")

    @unittest.skipIf(os.geteuid() != 0, "only root may become nobody")
    def test_without_permission_as_somebody_else(self):
        def nobody():
            os.setgroups([])
            os.setgid(65534)
            os.setuid(65534)

        # A copy, since the build may lie in a folder that only root may enter.
        reachable = tempfile.TemporaryDirectory()
        self.addCleanup(reachable.cleanup)
        os.chmod(reachable.name, 0o755)
        as_nobody = {"preexec_fn": nobody, "executable": shutil.copy(PROGRAM, reachable.name), "cwd": "/"}
        os.chmod(self.folder, 0o755)
        self.cannot_write("list", "--out", self.path("x"), says="Permission denied", **as_nobody)
        os.chmod(self.folder, 0o777)
        with open(self.path("kept"), "w") as file:
            file.write("kept")
        os.chmod(self.path("kept"), 0o444)
        self.cannot_write("list", "--out", self.path("kept"), says="Permission denied", **as_nobody)
        self.assertEqual(self.text_of("kept"), "kept")
        self.assertEqual(self.files(), ["kept"])

    def test_standard_input_is_no_place(self):
        self.refused("list", "--out", "-", code="bad-syntax", says="standard output")

    def test_a_refused_request_leaves_the_old_file(self):
        with open(self.path("old"), "w") as file:
            file.write("old")
        self.refused("respond", "sdof", "--samples", "1", "--out", self.path("old"),
                     code="out-of-range")
        self.refused("verify", "newmrak", "--out", self.path("old"), code="unknown-name")
        self.assertEqual(self.text_of("old"), "old")
        self.assertEqual(self.files(), ["old"])


class FullDisk(CommandTest):
    def small_files(self):
        resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))

    def test_on_standard_output(self):
        for command in (("list",), ("show", "stop"), ("explain",), ROWS, ("--help",), ("--version",),
                        ("verify", "rk4", *SHORT_LADDER), ("respond", "stop", "--plot")):
            with open("/dev/full", "w") as full:
                done = subprocess.run([PROGRAM, *command], stdout=full, stderr=subprocess.PIPE,
                                      text=True, env=environment())
            self.assertEqual(done.returncode, 4, command)
            self.assertRegex(done.stderr, r"\Aclackers: cannot write standard output: No space left.*"
                                          r" \[cannot-write\]\n\Z")

    def test_on_a_closed_standard_output(self):
        done = subprocess.run(["sh", "-c", '"$0" list >&-', PROGRAM], capture_output=True, text=True)
        self.assertEqual(done.returncode, 4)
        self.assertIn("[cannot-write]", done.stderr)

    def test_on_a_closed_standard_output_does_not_go_into_the_file(self):
        done = subprocess.run(["sh", "-c", '"$0" respond stop --plot --samples 3 --out "$1" >&-', PROGRAM,
                               self.path("rows")], capture_output=True, text=True)
        self.assertEqual(done.returncode, 4)
        self.assertIn("cannot write standard output", done.stderr)
        self.assertEqual(self.text_of("rows"), self.good("respond", "stop", "--samples", "3"))

    def test_on_a_device(self):
        self.refused(*ROWS, "--out", "/dev/full", exit_code=4, code="cannot-write",
                     says=("/dev/full", "No space left", "Free some space"))

    def test_in_a_file_leaves_the_old_one_and_no_half(self):
        with open(self.path("rows.csv"), "w") as file:
            file.write("old")
        self.refused(*ROWS, "--out", self.path("rows.csv"), exit_code=4, code="cannot-write",
                     says=("File too large", "Free some space"), preexec_fn=self.small_files)
        self.assertEqual(self.files(), ["rows.csv"])
        self.assertEqual(self.text_of("rows.csv"), "old")

    def test_in_a_small_file_system(self):
        if os.geteuid() != 0 or subprocess.run(
                ["mount", "-t", "tmpfs", "-o", "size=16k", "none", self.folder],
                capture_output=True).returncode:
            self.skipTest("no right to mount a small file system")
        try:
            self.refused(*ROWS, "--out", self.path("rows.csv"), exit_code=4, code="cannot-write",
                         says="No space left")
            self.assertEqual(self.files(), [])
        finally:
            subprocess.run(["umount", self.folder], check=True)

    def test_does_not_take_the_verdict_with_it(self):
        table = run("verify", "rk4", *SHORT_LADDER).stdout
        for options in (("--out", self.path("x"), "--format", "json"), ("--report", self.path("x")),
                        ("--report", "/dev/full")):
            done = run("verify", "rk4", *SHORT_LADDER, *options, preexec_fn=self.small_files)
            self.assertEqual(done.returncode, 4, done.stderr)
            self.assertRegex(done.stderr, r"\Aclackers: cannot write .* \[cannot-write\]\n\Z")
            self.assertEqual(done.stdout.splitlines()[0], table.splitlines()[0])
            self.assertIn("rk4", done.stdout)
            self.assertEqual(self.files(), [])


class Interrupted(CommandTest):
    def started(self, *arguments, files=1, **more):
        """A process that has its outputs open."""
        process = start(*arguments, **more)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        self.wait_for(lambda: len(self.open_files(process)) >= files)
        return process

    def test_rows_leave_no_file_and_end_within_a_fifth_of_a_second(self):
        for sign in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            with self.started(*ENDLESS, "--out", self.path("rows.csv"),
                              stderr=subprocess.PIPE) as process:
                self.assertNotIn("rows.csv", self.files())
                begin = time.monotonic()
                process.send_signal(sign)
                message = process.stderr.read().decode()
            self.assertLess(time.monotonic() - begin, 0.2 * SLOW)
            self.assertEqual(process.returncode, 130)
            self.assertEqual(message, "clackers: interrupted [interrupted]\n")
            self.assertEqual(self.files(), [])

    def test_while_waiting_for_times(self):
        process = self.started("respond", "stop", "--times", "-", "--out", self.path("x"),
                               stdin=subprocess.PIPE, stderr=subprocess.DEVNULL)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(10), 130)
        process.stdin.close()
        self.assertEqual(self.files(), [])

    def is_opening(self, process):
        """Waits in open() or openat()."""
        with open(f"/proc/{process.pid}/syscall") as file:
            return file.read().split()[0] in ("2", "257")

    def test_while_a_pipe_without_a_partner_is_opened(self):
        os.mkfifo(self.path("pipe"))
        history = self.path("h.csv")
        self.good("respond", "three-parameter", "--step", "0.1", "--format", "csv", "--quiet", "--out", history)
        for command in (("check", self.path("pipe")), ("check", history, "--events", self.path("pipe")),
                        ("respond", "stop", "--times", self.path("pipe")),
                        ("verify", "--baseline", self.path("pipe")),
                        ("list", "--out", self.path("pipe"))):
            process = start(*command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            self.wait_for(lambda: self.is_opening(process))
            process.send_signal(signal.SIGTERM)
            message = process.communicate(timeout=10)[1]
            self.assertEqual((process.returncode, message),
                             (130, "clackers: interrupted [interrupted]\n"), command)
        self.assertEqual(self.files(), ["h.csv", "pipe"])

    def test_twice_ends_at_once_and_leaves_no_file(self):
        process = self.started("verify", "rk4", *LONG_LADDER, "--out", self.path("x"), "--report",
                               self.path("y"), files=2, stderr=subprocess.DEVNULL)
        process.send_signal(signal.SIGSTOP)  # so that both are there when it goes on
        process.send_signal(signal.SIGINT)
        process.send_signal(signal.SIGTERM)
        process.send_signal(signal.SIGCONT)
        self.assertEqual(process.wait(10), 130)
        self.assertEqual(self.files(), [])

    def test_signals_that_end_a_process_leave_the_old_file_alone(self):
        with open(self.path("rows.csv"), "w") as file:
            file.write("old")
        for sign in (signal.SIGKILL, signal.SIGXCPU, signal.SIGUSR1, signal.SIGALRM, signal.SIGPWR,
                     signal.SIGQUIT):
            process = self.started(*ENDLESS, "--out", self.path("rows.csv"))
            process.send_signal(sign)
            self.assertEqual(process.wait(10), -sign)
            self.assertEqual(self.files(), ["rows.csv"])
            with open(self.path("rows.csv")) as file:
                self.assertEqual(file.read(), "old")

    def test_ignored_signals_stay_ignored(self):
        process = subprocess.Popen(["sh", "-c", 'trap "" INT; exec "$0" "$@"', PROGRAM, *ENDLESS,
                                    "--out", self.path("x")], stderr=subprocess.DEVNULL)
        self.wait_for(lambda: self.open_files(process))
        process.send_signal(signal.SIGINT)
        with self.assertRaises(subprocess.TimeoutExpired):
            process.wait(0.3)
        process.terminate()
        self.assertEqual(process.wait(10), 130)


class Safe(CommandTest):
    """Names that others prepared, and names that stand for the same file."""

    def test_two_runs_with_one_process_number_do_not_meet(self):
        if subprocess.run(["unshare", "-fp", "true"], capture_output=True).returncode:
            self.skipTest("no right to make process namespaces")
        counts = (20000, 30000)
        runs = [subprocess.Popen(["unshare", "-fp", PROGRAM, "respond", "stop", "--samples", str(n),
                                  "--format", "csv", "--quiet", "--out", self.path(f"{n}.csv")],
                                 env=environment()) for n in counts]
        for process in runs:
            self.assertEqual(process.wait(60), 0)
        for n in counts:
            with open(self.path(f"{n}.csv")) as file:
                times = [float(row["t"]) for row in csv.DictReader(file)]
            self.assertEqual(times, sorted(times))
            self.assertGreaterEqual(len(times), n)
        self.assertEqual(self.files(), sorted(f"{n}.csv" for n in counts))

    def test_prepared_links_are_not_followed(self):
        with open(self.path("victim"), "w") as file:
            file.write("precious")
        script = ('for n in 1 2 3 4; do ln -s victim .clackers-$$-$n.tmp; done; '
                  'exec "$0" list cases --quiet --out x')
        subprocess.run(["sh", "-c", script, PROGRAM], cwd=self.folder, check=True, env=environment())
        self.assertEqual(self.text_of("victim"), "precious")
        self.assertFalse(os.path.islink(self.path("x")))

    def test_a_link_to_a_file_that_does_not_exist_is_followed(self):
        os.mkdir(self.path("elsewhere"))
        os.symlink("elsewhere/new", self.path("link"))
        self.good("list", "cases", "--quiet", "--out", self.path("link"))
        self.assertTrue(os.path.islink(self.path("link")))
        self.assertEqual(os.listdir(self.path("elsewhere")), ["new"])

    def history(self):
        self.good("respond", "three-parameter", "--step", "0.1", "--format", "csv", "--quiet", "--out",
                  self.path("h.csv"))
        os.link(self.path("h.csv"), self.path("hard"))
        os.symlink("h.csv", self.path("soft"))
        with open(self.path("h.csv")) as file:
            return file.read()

    def test_an_output_that_is_also_read_is_refused(self):
        before = self.history()
        history = self.path("h.csv")
        with open(self.path("other.csv"), "w") as file:
            file.write(before)
        for name in ("h.csv", "hard", "soft", "./../" + os.path.basename(self.folder) + "/h.csv"):
            path = self.path(name)
            for command in (("check", history, "--report", path),
                            ("check", history, "--format", "csv", "--out", path),
                            ("check", self.path("other.csv"), history, "--out", path),
                            ("check", self.path("other.csv"), "--events", history, "--out", path),
                            ("respond", "stop", "--times", history, "--format", "csv", "--out", path),
                            ("verify", "--baseline", history, "--report", path)):
                self.refused(*command, code="bad-syntax", says=(path, "overwrite"))
        with open(history) as file:
            done = subprocess.run([PROGRAM, "check", "-", "--out", history], stdin=file,
                                  capture_output=True, text=True, env=environment())
        self.assertEqual(done.returncode, 2)
        self.assertIn("overwrite", done.stderr)
        self.assertEqual(self.text_of("h.csv"), before)

    def test_a_baseline_may_be_updated(self):
        record = self.path("record.json")
        study = ("verify", "rk4", *SHORT_LADDER, "--quiet", "--format", "json", "--out", record)
        self.assertEqual(run(*study).returncode, 3)
        self.assertEqual(run(*study, "--baseline", record).returncode, 3)

    def test_two_outputs_are_two_files(self):
        before = self.history()
        with open(self.path("real"), "w"):
            pass
        os.symlink("real", self.path("link"))
        os.symlink("nowhere", self.path("dangling"))
        for one, two in (("new", "new"), ("new", "./new"), ("real", "link"), ("nowhere", "dangling")):
            self.refused("check", self.path("h.csv"), "--report", self.path(one), "--out", self.path(two),
                         code="bad-syntax", says="same file")
        self.assertEqual(run("check", self.path("h.csv"), "--report", "/dev/null", "--out", "/dev/null").returncode, 0)
        self.assertEqual(self.text_of("h.csv"), before)


class BrokenPipe(CommandTest):
    def test_ends_quietly(self):
        for command in (ENDLESS, ("list",), ("--help",)):
            read, write = os.pipe()
            os.close(read)
            done = subprocess.run([PROGRAM, *command], stdout=write, stderr=subprocess.PIPE, timeout=30)
            os.close(write)
            self.assertEqual((done.returncode, done.stderr), (0, b""), command)

    def test_keeps_the_verdict_and_the_report(self):
        read, write = os.pipe()
        os.close(read)
        done = subprocess.run([PROGRAM, "verify", "rk4", *SHORT_LADDER, "--quiet", "--report",
                               self.path("x.html")], stdout=write, stderr=subprocess.PIPE, timeout=30)
        os.close(write)
        self.assertEqual((done.returncode, done.stderr), (3, b""))
        self.assertEqual(self.files(), ["x.html"])


if __name__ == "__main__":
    unittest.main()
