#!/usr/bin/env python3
"""The checker itself: pages built to be wrong in one way each, and the real page."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

import check_equations

ROOT = pathlib.Path(__file__).resolve().parents[2]
FUNCTION = "[`Pair::omega`](../clackers/pair.hpp)"
TEST = "[`Pairs.Oscillate`](../clackers/pair_test.cpp)"
FILES = {
    "clackers/pair.hpp": "struct Pair { double omega; };  // not gone\n",
    "clackers/pair_test.cpp": "TEST(Pairs, Oscillate) {}\n  TEST_F(Pairs,\n       Collide) {}\n"
                              "TEST_P(Many, Swing) {}\n// TEST(Pairs, Rest)\n/*\nTEST(Pairs, Stop) {}\n*/\nMY_TEST(Pairs, Fall) {}\n",
    "tests/cli/test_show.py": "",
}


class Equations(unittest.TestCase):
    def errors(self, change=lambda rows: rows, **cells):
        """Faults of a sound page after `change` of its rows, or with cells of (7) replaced."""
        row = {"says": "a mass", "function": FUNCTION, "test": TEST, "note": "[1](#1-why-not)", **cells}
        plain = {"says": "a mass", "function": FUNCTION, "test": TEST, "note": ""}
        rows = [" | ".join(["| " + number, *(row if number == "(7)" else plain).values()]) + " |"
                for number in check_equations.EQUATIONS]
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder).resolve()
            for name, text in {**FILES, "docs/equations.md": "\n".join([*change(rows), "## 1. Why not?"])}.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text)
            return check_equations.check(root)

    def assert_refused(self, words, change=lambda rows: rows, **cells):
        found = self.errors(change, **cells)
        self.assertEqual(len(found), 1, found)
        self.assertIn(words, found[0])

    def test_a_sound_page_has_no_fault(self):
        self.assertEqual(self.errors(), [])

    def test_an_equation_that_is_missing_or_stands_twice(self):
        for place, number in [(0, "(1)"), (37, "(38)"), (38, "(A.1)"), (55, "(A.18)")]:
            self.assert_refused(f"{number} stands in 0 rows", lambda rows: rows[:place] + rows[place + 1:])
            self.assert_refused(f"{number} stands in 2 rows", lambda rows: rows + [rows[place]])

    def test_an_equation_that_the_paper_does_not_have(self):
        for number in ["(39)", "(A.19)", "(0)"]:
            self.assert_refused(f"no {number}", lambda rows: rows + [rows[0].replace("(1)", number)])

    def test_a_header_that_does_not_exist(self):
        self.assert_refused("no header", function=FUNCTION.replace("pair.hpp", "gone.hpp"))
        self.assert_refused("no header", function="[`Pair`](../clackers)")
        self.assert_refused("no header", function="[`etc`](../../../../../../etc/passwd)")

    def test_a_name_that_does_not_stand_in_its_header(self):
        self.assert_refused("xi does not stand", function=FUNCTION.replace("omega", "xi"))
        self.assert_refused("Pai does not stand", function=FUNCTION.replace("Pair", "Pai"))
        self.assert_refused("gone does not stand", function="[`gone`](../clackers/pair.hpp)")

    def test_every_link_of_a_cell_is_looked_at(self):
        self.assert_refused("xi does not stand", function=FUNCTION + ", " + FUNCTION.replace("omega", "xi"))
        self.assert_refused("no such test", test=TEST + "<br>" + TEST.replace("Oscillate", "Rest"))

    def test_no_function_needs_a_reason(self):
        self.assertEqual(self.errors(function="not realized: a definition of words"), [])
        for cell in ["", "-", "not realized", "not realized: ", "`Pair`"]:
            self.assert_refused("names no function", function=cell)

    def test_a_test_that_does_not_exist(self):
        self.assert_refused("no file", test=TEST.replace("pair_test", "gone_test"))
        for name in ["Pairs.Rest", "Pairs.Stop", "Pairs.Fall", "Pair.Oscillate", "Pairs.Oscillat", "Oscillate.Pairs"]:
            self.assert_refused("no such test", test=TEST.replace("Pairs.Oscillate", name))
        self.assert_refused("no such test", test="[`Pairs.Oscillate`](../clackers)")
        for cell in ["", "by eye", "`Pairs.Oscillate`"]:
            self.assert_refused("names no test", test=cell)

    def test_every_kind_of_test_is_seen(self):
        for name in ["Pairs.Collide", "Many.Swing"]:
            self.assertEqual(self.errors(test=TEST.replace("Pairs.Oscillate", name)), [])

    def test_files_of_tests_are_named_by_their_path(self):
        self.assertEqual(self.errors(test="[`tests/cli/test_show.py`](../tests/cli/test_show.py)"), [])
        self.assertEqual(self.errors(test="[`tests/cli`](../tests/cli)"), [])
        self.assert_refused("neither", test="[`tests/show`](../tests/cli/test_show.py)")
        self.assert_refused("neither", test="[`clackers/pair.hpp`](../clackers/pair.hpp)")

    def test_a_note_leads_to_a_heading(self):
        self.assertEqual(self.errors(note=""), [])
        self.assert_refused("no heading", note="[1](#1-why)")
        self.assert_refused("no heading", note="[1](notes.md)")
        self.assert_refused("no heading", note="[1](x1-why-not)")
        self.assert_refused("without a link", note="1")

    def test_a_row_has_five_cells(self):
        self.assert_refused("has 6 cells", note="| [1](#1-why-not)")
        self.assert_refused("does not say", says="")

    def test_the_exit_code_tells(self):
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "docs" / "equations.md"
            page.parent.mkdir()
            page.write_text("")
            for root, code in [(folder, 1), (ROOT, 0)]:
                run = subprocess.run([sys.executable, check_equations.__file__, str(root)], capture_output=True, check=False)
                self.assertEqual(run.returncode, code, run.stdout)

    def test_the_project_keeps_its_own_table(self):
        self.assertEqual(check_equations.check(ROOT), [])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
