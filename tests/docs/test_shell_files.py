#!/usr/bin/env python3
"""Man pages and completion scripts that the built command writes: CLACKERS=build/dev/cli/clackers."""
import os
import pathlib
import pty
import re
import select
import shutil
import subprocess
import tempfile
import time
import unittest

PROGRAM = os.path.abspath(os.environ["CLACKERS"])


# The scripts ask the program, which stands on the PATH where it is installed.
os.environ["PATH"] = os.path.dirname(PROGRAM) + ":" + os.environ["PATH"]


def run(*words, **more):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, **more)


def setUpModule():
    global folder, share, commands
    folder = tempfile.TemporaryDirectory()
    share = pathlib.Path(folder.name) / "share"
    done = run(PROGRAM, "--generate", share)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", ""), done
    usage = run(PROGRAM, "--help").stdout.split("\nUsage\n")[1]
    commands = re.findall(r"^  clackers ([a-z]+) ", usage, re.MULTILINE)


def tearDownModule():
    folder.cleanup()


def help_of(command):
    return run(PROGRAM, command, "--help").stdout


def options_of(command):
    return re.findall(r"^  (?:-h,)?(--[a-z-]+)", help_of(command).split("\nOptions\n")[1], re.MULTILINE)


def words(text):
    """The words, without line breaks and the width of gaps."""
    return " ".join(text.split())


class ManualPages(unittest.TestCase):
    def page(self, name):
        return share / "man/man1" / f"{name}.1"

    def rendered(self, name):
        done = run("groff", "-ww", "-b", "-man", "-Tutf8", "-P-c", "-K", "utf8", self.page(name))
        self.assertEqual((done.returncode, done.stderr), (0, ""), name)
        return re.sub(r".\x08", "", done.stdout)

    def test_program_and_each_command_have_a_page(self):
        self.assertEqual(sorted(path.name for path in (share / "man/man1").iterdir()),
                         sorted(["clackers.1", *(f"clackers-{name}.1" for name in commands)]))
        self.assertGreater(len(commands), 5)

    @unittest.skipUnless(shutil.which("groff"), "needs groff")
    def test_rendered_pages_have_all_sections_and_no_warnings(self):
        for name in ["clackers", *(f"clackers-{command}" for command in commands)]:
            text = self.rendered(name)
            heads = re.findall(r"^[A-Z][A-Z ]+$", text, re.MULTILINE)
            for head in ("NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "EXIT STATUS", "EXAMPLES", "SEE ALSO"):
                self.assertIn(head, heads, name)
            self.assertRegex(text, rf"NAME\n +{name} - \S+ \S+")

    @unittest.skipUnless(shutil.which("groff"), "needs groff")
    def test_pages_contain_the_text_of_help(self):
        for command in commands:
            text = words(self.rendered(f"clackers-{command}"))
            page = self.page(f"clackers-{command}").read_text()
            for part in re.split(r"\n\n|^  (?:-h,)?--[a-z-]+.*?(?:\n|   )|^(?:Options|Examples|Usage|Arguments)\n", help_of(command),
                                 flags=re.MULTILINE):
                for line in (part or "").splitlines():
                    self.assertIn(words(line), text, (command, line))
            for option in options_of(command):
                self.assertIn(option.replace("-", r"\-"), page)

    def test_text_lines_do_not_begin_with_a_groff_request(self):
        for path in (share / "man/man1").iterdir():
            for line in path.read_text().splitlines():
                self.assertRegex(line, r"\A(?:[^.']|\.(?:TH|SH|TP|BR|nf|fi|nh|ad)\b)|\A\Z", path.name)


class Bash(unittest.TestCase):
    def completed(self, line):
        """The words that bash offers at the end of `line`, split as readline splits it."""
        parts = [part for part in re.split(r"\s+|(=)", line) if part]
        if line.endswith((" ", "=")) or not parts:
            parts.append("")
        script = (f"source {share}/bash-completion/completions/clackers\n"
                  f"COMP_WORDS=({' '.join(repr(part) for part in parts)}); COMP_CWORD={len(parts) - 1}\n"
                  "_clackers\nprintf '%s\\n' \"${COMPREPLY[@]}\"")
        done = run("bash", "--norc", "-eu", "-c", script, cwd=folder.name)
        self.assertEqual((done.returncode, done.stderr), (0, ""), line)
        return [word for word in done.stdout.splitlines() if word]

    def test_prefix_of_a_command_gives_commands(self):
        self.assertEqual(self.completed("clackers ver"), ["verify"])
        self.assertEqual(sorted(self.completed("clackers ")), sorted([*commands, "-h", "--help", "--version"]))

    def test_two_dashes_give_the_options_of_the_command(self):
        for command in commands:
            self.assertEqual(sorted(self.completed(f"clackers {command} --")), sorted(options_of(command)), command)
        self.assertEqual(self.completed("clackers verify --lev"), ["--levels"])

    def test_word_after_an_option_without_value_is_completed(self):
        self.assertEqual(self.completed("clackers verify --quiet --lev"), ["--levels"])
        self.assertEqual(self.completed("clackers verify --quiet mor"), ["moreau-jean"])

    def test_place_of_a_case_gives_cases(self):
        self.assertEqual(self.completed("clackers respond sto"), ["stop"])
        self.assertEqual(self.completed("clackers verify --case three"), ["three-parameter"])
        self.assertEqual(self.completed("clackers verify --case=three"), ["three-parameter"])
        self.assertIn("sdof", self.completed("clackers verify --case="))

    def test_place_of_a_method_gives_methods_and_pairs(self):
        self.assertEqual(self.completed("clackers verify newmark+rev"), ["newmark+reversal"])
        self.assertEqual(self.completed("clackers verify newmark mor"), ["moreau-jean"])
        shown = self.completed("clackers show ")
        for name in ("stop", "rk4", "newmark+penalty"):
            self.assertIn(name, shown)

    def test_fixed_words_and_codes_are_completed(self):
        self.assertEqual(self.completed("clackers list metr"), ["metrics"])
        self.assertEqual(self.completed("clackers explain stagn"), ["stagnating"])
        self.assertEqual(self.completed("clackers verify --format js"), ["json"])
        self.assertEqual(self.completed("clackers check x.csv --expect prop"), ["proper"])

    def test_set_gives_the_parameters_of_the_case(self):
        self.assertEqual(self.completed("clackers show --set "), ["N=", "xi1=", "a_t="])
        self.assertEqual(self.completed("clackers show stop --set et"), ["eta="])
        self.assertEqual(self.completed("clackers show stop --set xi1=0.1,et"), ["0.1,eta="])  # '=' splits the word
        self.assertEqual(self.completed("clackers verify --set N"), ["N="])

    def test_place_of_a_file_gives_files(self):
        (pathlib.Path(folder.name) / "history.csv").touch()
        self.assertEqual(self.completed("clackers check hist"), ["history.csv"])
        self.assertEqual(self.completed("clackers verify --report hist"), ["history.csv"])

    def test_place_of_a_number_gives_nothing(self):
        for line in ("clackers verify --levels ", "clackers respond stop --step ", "clackers show stop --threshold "):
            self.assertEqual(self.completed(line), [], line)


@unittest.skipUnless(shutil.which("zsh"), "needs zsh")
class Zsh(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.terminal, theirs = pty.openpty()
        home = pathlib.Path(folder.name) / "home"
        home.mkdir()
        (home / ".zshrc").write_text(
            f"fpath=({share}/zsh/site-functions $fpath)\nautoload -U compinit\ncompinit -u -D\nPS1='ready> '\n"
            "unsetopt zle_bracketed_paste prompt_sp\nLISTMAX=1000\nclackers() { print -r -- \"got:[$*]\"; }\n")
        cls.shell = subprocess.Popen(["zsh", "-i"], stdin=theirs, stdout=theirs, stderr=theirs, start_new_session=True,
                                     cwd=folder.name, env={**os.environ, "ZDOTDIR": str(home), "TERM": "dumb", "HOME": str(home)})
        os.close(theirs)
        cls.read("ready> ")

    @classmethod
    def tearDownClass(cls):
        cls.shell.kill()
        cls.shell.wait()
        os.close(cls.terminal)

    def completed(self, line):
        """The arguments that the command receives after zsh completed `line` and a tab."""
        os.write(self.terminal, f"{line}\t".encode())
        self.read(None)
        os.write(self.terminal, b"\n")
        seen = self.read("ready> ")
        return re.findall(r"got:\[(.*?)\]", seen)

    @classmethod
    def read(cls, until, seconds=30):
        """The output up to a text, or until a second without output."""
        text, end = "", time.monotonic() + seconds
        while time.monotonic() < end and (until is None or until not in text):
            if not select.select([cls.terminal], [], [], 1.0 if until is None else 0.2)[0]:
                if until is None:
                    break
                continue
            text += os.read(cls.terminal, 65536).decode(errors="replace")
        return text

    def test_script_has_no_syntax_error(self):
        done = run("zsh", "-n", share / "zsh/site-functions/_clackers")
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_commands_options_cases_and_methods_are_completed(self):
        for line, made in (("clackers ver", "verify"), ("clackers verify --lev", "verify --levels"),
                           ("clackers verify --case three", "verify --case three-parameter"),
                           ("clackers respond sto", "respond stop"), ("clackers verify newmark+rev", "verify newmark+reversal"),
                           ("clackers explain stagn", "explain stagnating"), ("clackers show stop --set et", "show stop --set eta="),
                           ("clackers show stop --set xi1=0 --set et", "show stop --set xi1=0 --set eta=")):
            self.assertEqual(self.completed(line), [made], line)


if __name__ == "__main__":
    unittest.main()
