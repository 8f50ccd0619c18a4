#!/usr/bin/env python3
"""The checker of code blocks itself: documents with one mistake each."""
import os
import pathlib
import stat
import tempfile
import unittest

# A command of our own, so that nothing need be built.
TOOLS = tempfile.TemporaryDirectory()
PROGRAM = pathlib.Path(TOOLS.name) / "clackers"
PROGRAM.write_text('#!/bin/sh\necho "$@"\necho 2.5e-3 m\nexit "${1:-0}"\n')
PROGRAM.chmod(PROGRAM.stat().st_mode | stat.S_IXUSR)
os.environ["CLACKERS"] = str(PROGRAM)

import blocks  # noqa: E402
import check_blocks  # noqa: E402

GOOD = "```console\n$ clackers 0 a\n0 a\n2.5e-3 m\n```\n"


class Blocks(unittest.TestCase):
    def problems(self, text, name="page.md"):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / name
            path.write_text(text)
            with tempfile.TemporaryDirectory() as work:
                return check_blocks.Document(path, work).check()

    def test_sound_documents_pass(self):
        for text in (GOOD, "no blocks\n", "```sh\nclackers 0  # words\n\n# words\nclackers 0 \\\n  b\n```\n",
                     "```text\nanything\n```\n", "  ```sh\n  clackers 0\n  ```\n",
                     "```console\n$ clackers 3\n...\n$ echo $?\n3\n```\n",
                     "```console\n$ clackers 0 \\\n  a\n...\n```\n",
                     "```python\n# it.py\nprint(1)\n```\n```console\n$ python3 it.py\n1\n```\n",
                     "```console\n$ true\n```\n", "```sh\nscripts/demo\n```\n"):
            self.assertEqual(self.problems(text), [], text)

    def test_output_that_differs_is_found(self):
        for shown in ("0 a\n2.6e-3 m\n", "0 a\n", "0 a\n2.5e-3 m\nmore\n", "", "0 b\n...\n", "...\n0 c\n...\n"):
            text = "```console\n$ clackers 0 a\n" + shown + "```\n"
            self.assertEqual(len(self.problems(text)), 1, shown)

    def test_dots_stand_for_lines_and_parts_of_lines(self):
        for shown in ("...\n", "...\n2.5e-3 m\n", "0 a\n...\n", "0 a\n... m\n", "0 a\n2.5...\n", "...\n0 a\n...\n2.5e-3 m\n...\n"):
            self.assertEqual(self.problems("```console\n$ clackers 0 a\n" + shown + "```\n"), [], shown)
        self.assertFalse(blocks.matches("a.c\n", "abc\n"))

    def test_commands_that_fail_are_found(self):
        self.assertEqual(len(self.problems("```sh\nclackers 3\n```\n")), 1)
        self.assertEqual(len(self.problems("```sh\nclackers 3\nclackers 0\n```\n")), 1)
        self.assertEqual(len(self.problems("```console\n$ clackers 3\n...\n```\n")), 1)
        self.assertEqual(len(self.problems("```console\n$ clackers 3\n...\n$ clackers 0\n...\n```\n")), 1)
        self.assertEqual(len(self.problems("```console\n$ clackers 3\n...\n$ echo $?\n4\n```\n")), 1)

    def test_blocks_that_nothing_checks_are_found(self):
        for text in ("```fortran\nend\n```\n", "```cmake\nproject(x)\n```\n", "```\nsome output\n```\n",
                     "```python\nprint(1)\n```\n", "```c\nint x;\n```\n", "```console\noutput\n```\n",
                     "```sh\nclackers 0\n"):
            self.assertEqual(len(self.problems(text)), 1, text)

    def test_sources_are_compiled(self):
        self.assertEqual(self.problems('```cpp\n[[maybe_unused]] auto all = clackers::cases::entries();\n```\n'), [])
        wrong = self.problems("```cpp\nauto all = clackers::cases::no_such();\n```\n")
        self.assertEqual(len(wrong), 1)
        self.assertIn("no_such", wrong[0])

    def test_a_problem_tells_its_line(self):
        self.assertIn("page.md:3:", self.problems("# Page\n\n```console\n$ clackers 0\nno\n```\n")[0])

    def test_documents_do_not_see_each_other(self):
        first = "```python\n# left.py\n```\n"
        self.assertEqual(self.problems(first), [])
        self.assertEqual(len(self.problems("```sh\npython3 left.py\n```\n")), 1)


if __name__ == "__main__":
    unittest.main()
