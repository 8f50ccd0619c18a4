#!/usr/bin/env python3
"""The checkers of documents: sound text without a fault, text with one fault of each kind."""
import os
import pathlib
import stat
import tempfile
import unittest

TOOLS = tempfile.TemporaryDirectory()
PROGRAM = pathlib.Path(TOOLS.name) / "clackers"
PROGRAM.write_text('#!/bin/sh\necho "$@"\necho 2.5e-3 m\nexit "${1:-0}"\n')
PROGRAM.chmod(PROGRAM.stat().st_mode | stat.S_IXUSR)
os.environ["CLACKERS"] = str(PROGRAM)

import check_blocks  # noqa: E402
import check_equations  # noqa: E402
import check_links  # noqa: E402


def faults(check, files):
    """The faults that `check` finds in a tree of these files."""
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder).resolve()
        paths = [root / name for name in files]
        for path, text in zip(paths, files.values()):
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        return list(check(root, paths))


class Checkers(unittest.TestCase):
    def count(self, check, files):
        found = faults(check, files)
        return len(found), found

    def test_block_faults_are_found(self):
        def check(root, paths):
            (root / "work").mkdir()
            return check_blocks.Document(paths[0], root / "work").check()
        for text, number in (
                ("```console\n$ clackers 0 a\n0 a\n2.5e-3 m\n```\n", 0), ("```console\n$ clackers 0 \\\n  a\n...\n2.5... m\n```\n", 0),
                ("```console\n$ clackers 3\n...\n$ echo $?\n3\n```\n", 0), ("```sh\nclackers 0  # words\nscripts/demo\n```\n", 0),
                ("```python\n# it.py\nprint(1)\n```\n```console\n$ python3 it.py\n1\n```\n", 0),
                ("```console\n$ clackers 0 a\n0 a\n```\n", 1), ("```console\n$ clackers 0 a\n0 b\n...\n```\n", 1),
                ("```console\n$ clackers 3\n...\n```\n", 1), ("```sh\nclackers 3\n```\n", 1), ("```fortran\nend\n```\n", 1),
                ("```\noutput of no command\n```\n", 1), ("```c\nint x;\n```\n", 1), ("```sh\nclackers 0\n", 1),
                ("```cpp\nauto all = clackers::cases::no_such();\n```\n", 1)):
            self.assertEqual(self.count(check, {"page.md": text})[0], number, text)

    def test_equation_faults_are_found(self):
        good = "| (n) | a mass | [`Pair`](../../../clackers/pair.hpp) | [`Pairs.Swing`](../../../clackers/pair_test.cpp) | | [eq](claims.md#eq) |"
        for change, number in (
                (("a mass", "a mass"), 0), (("(7)", "(6)"), 2), (("a mass", ""), 1), (("`Pair`", "`Omega`"), 1),
                (("pair.hpp", "gone.hpp"), 1), (("Pairs.Swing", "Pairs.Rest"), 1), (("pair_test.cpp", "gone.cpp"), 1),
                (("| | [", "| [1](#1-no-such) | ["), 1), (("[eq](claims.md#eq)", "eq"), 1)):
            rows = [good.replace("(n)", equation) for equation in check_equations.EQUATIONS]
            rows[6] = rows[6].replace(*change)
            files = {check_equations.PAGE.as_posix(): "\n".join(rows), check_equations.CLAIMS.as_posix(): "### eq\n",
                     "clackers/pair.hpp": "struct Pair;  // Omega\n",
                     "clackers/pair_test.cpp": "TEST(Pairs, Swing) {}\n// TEST(Pairs, Rest)\n"}
            self.assertEqual(self.count(lambda root, _: check_equations.check(root), files)[0], number, change)
            files[check_equations.CLAIMS.as_posix()] += "### eq-2\n"
            self.assertEqual(self.count(lambda root, _: check_equations.check(root), files)[0], number + 1, change)

    def test_link_faults_are_found(self):
        for name, text, number in (
                ("a.md", "[b](b.md#first-part), docs/b.md, `b.md`, clackers/record/1 and clackers/<name>.hpp", 0),
                ("a.cpp", '#include "clackers/gone.hpp"\n// docs/b.md says why.\n', 0), ("a.md", "```sh\ncat docs/gone\n```\n", 0),
                ("a.md", "[b](gone.md)", 1), ("a.md", "[b](b.md#second-part)", 1), ("a.md", "see docs/gone", 1),
                ("a.cpp", "// gone.md, section 2\n", 1), ("a.py", "# docs/gone/b.md\n", 1)):
            files = {f"docs/{name}": text, "docs/b.md": "# First part\n"}
            self.assertEqual(self.count(check_links.check, files)[0], number, text)


if __name__ == "__main__":
    unittest.main()
