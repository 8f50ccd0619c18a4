#!/usr/bin/env python3
"""Checks that every code of clackers/base/codes.cpp is used by the sources.

    unused_codes.py ROOT      prints each unused code, exits 1 if there is one

A code is used if it is a text literal in a source other than the table and the tests. Verdicts and
behaviours also count where their words are separated by blanks ("not claimed").
"""
import pathlib
import re
import sys

TABLE = pathlib.PurePosixPath("clackers/base/codes.cpp")
NAMES = pathlib.PurePosixPath("clackers/base/codes.hpp")
ROW = re.compile(r'\{"([^"]+)",\s*"(refusal|failure|behaviour|reason|diagnosis|verdict)",')
LITERAL = re.compile(r'"([^"\\\n]*)"')
FOLDERS = ["clackers", "cli", "bindings", "paper"]


def rows(text):
    """Names and kinds of all rows; every row must be understood."""
    body = text[text.index("constexpr auto rows"):]
    body = body[:body.index("});")]
    found = ROW.findall(body)
    starts = len(re.findall(r'^\s*\{"', body, re.MULTILINE))
    if starts != len(found):
        raise ValueError(f"{TABLE}: {starts} rows, {len(found)} understood")
    return found


def literals(root):
    found = set()
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*.[ch]pp")):
            relative = path.relative_to(root).as_posix()
            if relative not in (str(TABLE), str(NAMES)) and not path.name.endswith("_test.cpp"):
                found.update(LITERAL.findall(path.read_text(encoding="utf-8")))
    return found


def unused(root):
    used = literals(root)
    words = {"verdict", "behaviour"}
    return [name for name, kind in rows((root / TABLE).read_text(encoding="utf-8"))
            if name not in used and not (kind in words and name.replace("-", " ") in used)]


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    found = unused(root)
    for name in found:
        print(f"{TABLE}: no source uses the code {name}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
