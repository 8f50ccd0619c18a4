"""What appears only on a terminal: progress and colours."""
import os
import pty
import re
import signal
import subprocess
import unittest

from command import (LONG_LADDER, SHORT_LADDER, CommandTest, environment, read_terminal, run,
                     run_on_terminal, start)

ESCAPE = "\x1b["


class Progress(CommandTest):
    def interrupted_on_terminal(self, *options):
        """What standard error showed on a terminal, until something appeared there."""
        ours, theirs = pty.openpty()
        process = start("verify", "rk4", *LONG_LADDER, *options, stdout=subprocess.DEVNULL,
                        stderr=theirs)
        os.close(theirs)
        text = read_terminal(ours, until=b"elapsed")
        process.send_signal(signal.SIGINT)
        text += read_terminal(ours)
        os.close(ours)
        self.assertEqual(process.wait(20), 130)
        return text

    def test_shows_share_and_time_on_a_terminal_and_is_erased(self):
        text = self.interrupted_on_terminal()
        self.assertRegex(text, r"\rverify +\d+ %, \d+ s elapsed")
        before, after = text.rsplit("elapsed", 1)
        self.assertRegex(after, r"\A[^\r\n]*\r {79}\rclackers: interrupted")

    def test_estimates_the_rest(self):
        code, text = run_on_terminal("verify", "rk4", "--coarsest", "1e-3", "--levels", "4",
                                     stream="stderr")
        self.assertIn(code, (0, 3))
        shown = re.findall(r"(\d+) %, (\d+) s elapsed, about (\d+) s left", text)
        self.assertTrue(shown)
        for share, elapsed, left in ([int(number) for number in line] for line in shown):
            # All three are rounded to whole numbers.
            def rest(e, s):
                return e * (100 - s) / s
            self.assertGreaterEqual(left + 0.5, rest(elapsed - 0.5, share + 0.5))
            self.assertLessEqual(left - 0.5, rest(elapsed + 0.5, share - 0.5))
        self.assertTrue(text.endswith(" " * 79 + "\r"))
        for line in text.replace("\n", "\r").split("\r"):
            self.assertLess(len(line), 80)

    def test_of_check_is_shown(self):
        history = self.path("h.csv")
        self.good("respond", "three-parameter", "--samples", "20000", "--format", "csv", "--quiet", "--out", history)
        code, text = run_on_terminal("check", history, stream="stderr")
        self.assertEqual(code, 0)
        self.assertRegex(text, r"\rcheck +\d+ %, \d+ s elapsed")
        self.assertTrue(text.endswith(" " * 79 + "\r"))

    def test_is_silent_when_standard_error_is_no_terminal(self):
        done = run("verify", "rk4", *SHORT_LADDER)
        self.assertEqual(done.stderr, "")

    def test_is_silent_when_quiet(self):
        code, text = run_on_terminal("verify", "rk4", *SHORT_LADDER, "--quiet", stream="stderr")
        self.assertEqual((code, text), (3, ""))


class Colours(CommandTest):
    def table(self, *options, env=None):
        code, text = run_on_terminal("verify", "rk4", *SHORT_LADDER, *options, env=env)
        self.assertEqual(code, 3)
        self.assertIn("rk4", text)
        return text

    def test_appear_on_a_terminal(self):
        self.assertIn(ESCAPE, self.table())

    def test_are_refused_in_three_ways(self):
        self.assertNotIn(ESCAPE, self.table("--no-color"))
        self.assertNotIn(ESCAPE, self.table(env=environment(NO_COLOR="1")))
        self.assertNotIn(ESCAPE, self.table(env=environment(TERM="dumb")))

    def test_an_empty_no_color_does_not_count(self):
        self.assertIn(ESCAPE, self.table(env=environment(NO_COLOR="")))

    def test_do_not_enter_pipes_or_files(self):
        self.assertNotIn(ESCAPE, run("verify", "rk4", *SHORT_LADDER).stdout)
        run_on_terminal("verify", "rk4", *SHORT_LADDER, "--out", self.path("x"))
        with open(self.path("x")) as file:
            self.assertNotIn(ESCAPE, file.read())


class Messages(CommandTest):
    def test_are_broken_at_80_columns_on_a_terminal(self):
        code, text = run_on_terminal("respond", "synchronized-pair", "--samples", "3", "--set", "r=5",
                                     stream="stderr")
        self.assertEqual(code, 2)
        lines = text.replace("\r\n", "\n").splitlines()
        self.assertGreater(len(lines), 1)
        for line in lines:
            self.assertLessEqual(len(line), 80)
        self.assertEqual(" ".join(lines), run("respond", "synchronized-pair", "--samples", "3",
                                              "--set", "r=5").stderr.strip())


if __name__ == "__main__":
    unittest.main()
