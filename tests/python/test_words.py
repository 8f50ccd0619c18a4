"""Messages name what a user of Python types, not what a user of the command types."""
import re
import unittest

import numpy as np

import clackers
from clackers._words import html_in_python, in_python

CASE = clackers.case("three-parameter")
T = np.linspace(0.0, CASE.end, 501)
U, V, _ = CASE.response(T)
# A command, or an option.
COMMAND = re.compile(r"clackers (list|show|explain|respond)\b|(?<![\w-])--[a-z]")


def message(call):
    try:
        call()
    except clackers.Error as error:
        return str(error)
    raise AssertionError("nothing is raised")


class Texts(unittest.TestCase):
    ROWS = {
        "All names: clackers list cases": 'All names: clackers.catalogue("cases")',
        "All names: clackers explain": "All names: clackers.explain()",
        "N, xi1 (clackers show stop)": 'N, xi1 (clackers.case("stop").tables())',
        "all: clackers respond stop --impacts": 'all: clackers.case("stop").impacts()',
        "Use more --levels or another --coarsest.": "Use more levels or another coarsest.",
        "The next level takes 4 s: --budget 60s.": "The next level takes 4 s: budget=60.",
        "more --samples-per-level": "more samples_per_level",
        "With --set eta=0.9,xi1=0.1 the case": "With eta=0.9,xi1=0.1 the case",
        "the run with --set; they": "the run with keyword arguments; they",
        "read them with --columns t,u2,u1.": 'read them with columns="t,u2,u1".',
        "(--columns t,u1,... or a header)": '(columns="t,u1,..." or a header)',
        "with --steps h1,h2,... in the order": "with step=[h1, h2, ...] in the order",
        "check: --steps = 2 of them": "check: step = 2 of them",
        "or --expect proper:2": 'or expect="proper:2"',
        "--tolerances 1e-3,1e-5": "tolerances=[1e-3, 1e-5]",
        "leave --expect out": "leave expect out",
        "give the impacts with --events.": "give the impacts with impacts.",
        "as written by clackers verify or check with --format json.": "as written by Record.to_json().",
        "All names: clackers verify --help": "All names: help(clackers.Program)",
        "Decompress it: gunzip -c FILE | clackers check -": "Decompress it: gunzip FILE",
        "42 more: --metrics all.": "42 more: record.table().",
        "the same with --budget\n60s": "the same with \nbudget=60",
        "a file a--b.csv, 3--5, x-- and -- or ---": "a file a--b.csv, 3--5, x-- and -- or ---",
    }

    def test_each_row(self):
        for text, expected in self.ROWS.items():
            self.assertEqual(in_python(text), expected)

    def test_html_is_changed_between_tags_only(self):
        page = '<style>p { color: var(--m1); --m2: red }</style><p title="--levels 3" style="--a: 1">more --levels</p>'
        self.assertEqual(html_in_python(page), page.replace("more --levels", "more levels"))


class Messages(unittest.TestCase):
    def test_no_refusal_names_a_command_or_an_option(self):
        check = clackers.check
        for call in (
            lambda: clackers.case("stpo"), lambda: clackers.case("stop", mass=3), lambda: clackers.explain("iregular"),
            lambda: clackers.verify("newmrak"), lambda: clackers.verify("rk4+revers"), lambda: check(T, U, step=[0.1, 0.2]),
            lambda: check(T, U, step=0.0), lambda: check(T, U, tolerances=[2.0]), lambda: check(T, U, tolerance=-2.0),
            lambda: check(T, 1.1 * U, V), lambda: check(T, U, expect="proper"), lambda: check([(T, U), (T, U)]),
            lambda: clackers.verify(lambda problem, h: None, tolerances="1;2"), lambda: clackers.verify(clackers.Program("a {hh}")), lambda: clackers.Record.from_json("{}"),
            lambda: check({"a": {}, "b": (T, U)}), lambda: check(T, U[:, ::-1], V[:, ::-1]),
        ):
            text = message(call)
            self.assertIsNone(COMMAND.search(text), text)

    def test_a_record_names_arguments(self):
        record = clackers.verify("rk4", levels=3, samples_per_level=2)
        for text in (str(record), record.subject.findings[0], record._repr_html_()):
            self.assertIn("Use more levels or another coarsest", " ".join(text.split()))
        off = clackers.check(T, U, V, case=CASE)
        self.assertNotIn("--", str(off).replace("─", ""))

    def test_tables_name_calls(self):
        for table in (*clackers.catalogue().values(), clackers.explain("too-few-levels"), *CASE.tables().values(),
                      clackers.verify("rk4", levels=2, samples_per_level=1).table()):
            shown = repr(table) + "".join(column.meaning for column in table.columns)
            self.assertIsNone(COMMAND.search(shown), shown)

    def test_a_record_of_the_command_keeps_its_words(self):
        text = clackers.verify("rk4", levels=3, samples_per_level=2).to_json()
        record = clackers.Record.from_json(re.sub(r'"command": ?"clackers\.verify[^)]*\)"', '"command": "clackers verify rk4"', text))
        self.assertIn("Use more --levels", " ".join(str(record).split()))


class Arguments(unittest.TestCase):
    ROWS = {
        "cas of verify": ("case", lambda: clackers.verify("rk4", cas="stop")),
        "samples_per_levels of verify": ("samples_per_level", lambda: clackers.verify("rk4", samples_per_levels=3)),
        "tolerence of check": ("tolerance", lambda: clackers.check(T, U, tolerence=1e-3)),
        "treshold of case": ("threshold", lambda: clackers.case("stop", treshold=0.2)),
        "xi2 of case": ("xi1", lambda: clackers.case("stop", xi2=0.2)),
    }

    def test_a_mistyped_argument_is_corrected(self):
        for what, (meant, call) in self.ROWS.items():
            with self.subTest(what):
                self.assertIn(f'Did you mean "{meant}"?', message(call))

    def test_all_arguments_are_listed(self):
        text = message(lambda: clackers.check(T, U, zzz=1))
        for name in ("case", "tolerance", "xi1", "a_t"):
            self.assertRegex(text, rf"\b{name}\b")
        self.assertNotIn("parameters", text.split("All names")[1])
        self.assertIn("zzz", text)


if __name__ == "__main__":
    unittest.main()
