"""Small files of strangers (problems, specifications, times, records): bounded, and waited for only as long as asked."""
import os
import signal
import unittest

from command import CommandTest, run, start


def readers(path):
    """A command for each kind of small file."""
    return (("respond", "--problem", path, "--samples", "3"), ("verify", "rk4", "--problem", path),
            ("campaign", "plan", path), ("campaign", "run", path), ("atlas", "--specification", path),
            ("respond", "stop", "--times", path), ("verify", "rk4", "--baseline", path))


class SmallFiles(CommandTest):
    def test_that_never_end_are_refused_at_once(self):
        for command in readers("/dev/zero"):
            done = run(*command, timeout=10, cwd=self.folder)
            self.assertIn(done.returncode, (2, 4), command)
            self.assertIn("/dev/zero", done.stderr)

    def test_that_cannot_be_read_are_named_with_the_reason(self):
        for path, reason in ((self.path("none"), "No such file or directory"), (self.folder, "Is a directory"),
                             ("/proc/self/mem", "Input/output error")):
            for command in readers(path):
                self.refused(*command, code="cannot-read", says=(f"cannot read {path}: {reason}.",), exit_code=4,
                             cwd=self.folder)

    def test_of_a_name_that_leads_nowhere_are_refused_with_advice(self):
        os.symlink("ring", self.path("ring"))
        for command in (("campaign", "status", self.path("ring")), ("engines", "run", "--all", "--engines", self.path("ring"))):
            done = run(*command, cwd=self.folder)
            self.assertEqual(done.returncode, 4)
            self.assertRegex(done.stderr, r"ring.*Too many levels of symbolic links.* (Name|Give) ")

    def test_that_are_waited_for_end_with_one_interrupt(self):
        os.mkfifo(self.path("pipe"))
        for command in readers(self.path("pipe")):
            with start(*command, stdout=-1, stderr=-1, cwd=self.folder) as process:
                self.wait_for(lambda p=process: self.is_asleep(p))
                process.send_signal(signal.SIGINT)
                try:
                    out, error = process.communicate(timeout=10)
                finally:
                    process.kill()
            self.assertEqual((process.returncode, out), (130, b""), (command, error))

    def is_asleep(self, process):
        with open(f"/proc/{process.pid}/stat") as file:
            state = file.read().rpartition(")")[2].split()[0]
        with open(f"/proc/{process.pid}/status") as file:
            return state == "S" and "SigCgt:\t0000000000000000" not in file.read()

    def test_of_deep_keys_are_refused(self):
        with open(self.path("deep.toml"), "w") as file:
            file.write("a" + ".a" * 1000000 + " = 1\n")
        for command in readers(self.path("deep.toml"))[:5]:
            self.refused(*command, code="bad-syntax", says="deep.toml:1: a key has more than 16 parts", cwd=self.folder)


if __name__ == "__main__":
    unittest.main()
