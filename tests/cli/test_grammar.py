"""Names, options, help and versions: what every command has in common."""
import re
import unittest

from command import CommandTest, run

COMMANDS = ("list", "show", "respond", "verify", "check", "campaign", "atlas", "paper", "explain", "help")


class Help(CommandTest):
    def test_begins_with_an_example_that_names_the_command(self):
        for command in COMMANDS:
            for flag in ("--help", "-h"):
                lines = self.good(command, flag).splitlines()
                self.assertEqual(lines[0], "Examples")
                self.assertTrue(lines[1].startswith(f"  clackers {command}"), lines[1])
        self.assertTrue(self.good("--help").startswith("Examples\n  clackers verify"))

    def test_fits_80_columns(self):
        for command in ((),) + tuple((name,) for name in COMMANDS):
            for line in self.good(*command, "--help").splitlines():
                self.assertLessEqual(len(line), 80, line)

    def test_describes_every_option_of_the_grammar(self):
        everywhere = ["--format", "--out", "--quiet", "--no-color", "--help"]
        own = {"list": [], "explain": [], "show": ["--case", "--problem", "--set", "--threshold", "--report"],
               "check": ["--name", "--label", "--against", "--case", "--problem", "--set", "--columns", "--events", "--steps", "--expect",
                         "--tolerance", "--tolerances", "--metrics", "--impacts", "--report", "--require", "--baseline",
                         "--reader", "--node", "--component"],
               "paper": [],
               "campaign": ["--database", "--shard", "--jobs", "--yes", "--slurm", "--shards", "--sbatch", "--dry-run",
                            "--table", "--times"],
               "atlas": ["--jobs", "--specification", "--submit", "--exec", "--expect", "--author",
                         "--merge"],
               "respond": ["--case", "--problem", "--report", "--set", "--samples", "--step", "--times", "--impacts", "--collisions", "--plot",
                           "--digits", "--energy", "--forces", "--at", "--sensitivity", "--spectrum", "--highest", "--film"],
               "verify": ["--all", "--case", "--problem", "--set", "--levels", "--coarsest", "--samples-per-level", "--neighbours",
                          "--budget", "--exec", "--exec-batch", "--name", "--label", "--expect", "--tolerances", "--timeout",
                          "--work", "--fresh", "--environment", "--jobs", "--require", "--baseline", "--only",
                          "--report", "--film", "--path"]}
        for command, options in own.items():
            text = self.good(command, "--help").split("\nOptions\n")[1]
            named = re.findall(r"^  (?:-h,)?(--[a-z-]+)", text, re.M)
            self.assertEqual(sorted(named), sorted(options + everywhere))

    def test_help_of_a_command_is_what_it_prints_for_its_option(self):
        self.assertEqual(self.good("help"), self.good("--help"))
        for command in COMMANDS:
            self.assertEqual(self.good("help", command), self.good(command, "--help"))
        self.refused("help", "verfy", code="unknown-name", says='Did you mean "verify"?')

    def test_without_a_command_is_the_overall_help(self):
        self.assertEqual(self.good(), self.good("--help"))

    def test_examples_of_help_run(self):
        texts = [self.good(*command, "--help") for command in ((), ("list",), ("show",),
                                                               ("explain",), ("respond",))]
        seen = 0
        for text in texts:
            for line in text.split("\n\n")[0].splitlines()[1:]:
                words = re.split(r" {3,}", line.strip())[0].split()
                if words[1] == "verify":
                    continue
                seen += 1
                done = run(*words[1:], cwd=self.folder)
                self.assertEqual(done.returncode, 0, (line, done.stderr))
        self.assertGreaterEqual(seen, 9)


class Version(CommandTest):
    def test_is_one_line(self):
        self.assertRegex(self.good("--version"), r"\Aclackers \d+\.\d+\.\d+\n\Z")


class Names(CommandTest):
    def test_of_commands_get_did_you_mean(self):
        self.refused("verfy", code="unknown-name", says='Did you mean "verify"?')
        self.refused("xyzzyxyzzy", code="unknown-name", says="All names: clackers --help")

    def test_of_options_get_did_you_mean(self):
        for command, given, meant in (("list", "--fromat", "--format"),
                                      ("verify", "--level", "--levels"),
                                      ("verify", "--neighbors", "--neighbours"),
                                      ("respond", "--sample", "--samples"),
                                      ("show", "--treshold", "--threshold"),
                                      ("explain", "--color", "--no-color")):
            self.refused(command, f"{given}=3", code="unknown-name",
                         says=(f'"{given}"', f'Did you mean "{meant}"?', f"clackers {command} --help"))
        self.refused("--versoin", code="unknown-name", says='Did you mean "--version"?')

    def test_of_arguments_are_no_options(self):
        for command, option, says in (("verify", "--method", "clackers verify METHOD"), ("show", "--method", "clackers show METHOD"),
                                      ("check", "--file", "clackers check FILE"), ("explain", "--code", "clackers explain CODE")):
            self.refused(command, option, "newmark", code="unknown-name", says=says)

    def test_of_cases_stand_first_or_behind_an_option_in_every_command(self):
        self.good("respond", "stop", "--samples", "9", "--format", "csv", "--out", self.path("h.csv"), "--quiet")
        for command, rest in (("show", ()), ("respond", ("--samples", "3")), ("check", (self.path("h.csv"),)),
                              ("verify", ("rk4", "--levels", "2", "--samples-per-level", "1", "--format", "csv"))):
            # Times of runs differ: all numbers as small as they are left out.
            run_of = lambda *words: re.sub(r"\d+\.?\d*e-0\d|0\.00\d+", "", run(command, *words).stdout)
            self.assertEqual(run_of("stop", *rest), run_of(*rest, "--case", "stop"), command)
            self.assertGreater(len(run_of("stop", *rest)), 20)
        self.refused("respond", "stop", "--case", "sdof", "--plot", code="bad-syntax", says="leave stop or --case out")
        self.refused("verify", "--case", "newmark", code="bad-syntax", says=("a method, not a case", "verify newmark"))

    def test_of_pages_end_in_html(self):
        for command in (("respond", "stop"), ("show", "rk4"), ("verify", "rk4")):
            self.refused(*command, "--report", self.path("x.pdf"), code="bad-syntax", says=("x.pdf", "FILE.html", "PDF", "SVG"))
        self.assertEqual(self.files(), [])

    def test_of_values_are_completed(self):
        for words, offered in ((("export", "--to", "sc"), ["scipy"]), (("list", "co"), ["contacts", "columns"]),
                               (("check", "--reader", "ta"), ["table"]), (("verify", "--only", "not"), ["not-claimed"]),
                               (("verify", "--require", "or"), ["order:"]), (("verify", "--expect", "st"), ["stagnating"]),
                               (("verify", "--expect", "RE"), [])):
            self.assertEqual([line.split("\t")[0] for line in self.good("--complete", *words).splitlines()], offered, words)

    def test_of_whole_numbers_have_their_range(self):
        for value in ("abc", "2.5", "0", "99"):
            self.refused("verify", "--levels", value, code=("not-a-number" if value == "abc" else "out-of-range"), says="a whole number, 1 to 64")

    def test_of_formats_get_did_you_mean(self):
        for command in (("list",), ("show", "stop"), ("respond", "stop", "--samples", "3"),
                        ("verify",), ("explain",)):
            self.refused(*command, "--format", "jsno", code="unknown-name",
                         says=('Did you mean "json"?', "table, csv, json"))

    def test_of_options_still_to_come_are_unknown(self):
        for command, option in (("show", "--expect"), ("respond", "--baseline")):
            self.refused(command, option, "stop", code="unknown-name", says=f'no option "{option}"')


class Syntax(CommandTest):
    def test_names_the_option_that_lacks_its_value(self):
        self.refused("list", "--out", code="bad-syntax",
                     says=("--out needs a value: --out FILE", "clackers list --help"))
        self.refused("verify", "--levels", code="bad-syntax", says="--levels needs a value")
        self.refused("respond", "stop", "--set", code="bad-syntax", says="--set needs a value")

    def test_refuses_an_empty_value(self):
        self.refused("list", "--out", "", code="bad-syntax", says="--out is given an empty value")
        self.refused("list", "", code="bad-syntax", says="empty value")

    def test_refuses_an_option_given_twice(self):
        self.refused("list", "--format", "csv", "--format", "json", code="bad-syntax",
                     says="--format is given more than once")

    def test_refuses_a_value_for_a_flag(self):
        self.refused("list", "--quiet=3", code="bad-syntax", says="--quiet takes no value")

    def test_refuses_surplus_arguments(self):
        for command in ("list", "cases", "stop"), ("explain", "proper", "exact"), (
                "show", "stop", "sdof"), ("respond", "stop", "sdof", "--plot"):
            self.refused(*command, code="bad-syntax", says="one argument too many")

    def test_refuses_options_before_the_command(self):
        self.refused("--format", "json", "list", code="bad-syntax",
                     says="--format goes after the command")

    def test_a_double_dash_ends_the_options(self):
        self.assertEqual(self.good("list", "--", "cases"), self.good("list", "cases"))
        self.refused("list", "--", "cases", "--quiet", code="bad-syntax",
                     says='one argument too many: "--quiet"')

    def test_a_command_name_as_argument_is_an_argument(self):
        self.refused("explain", "list", code="unknown-name", says='no code "list"')

    def test_quiet_does_not_silence_a_refusal(self):
        self.refused("list", "nothing", "--quiet", code="unknown-name")


if __name__ == "__main__":
    unittest.main()
