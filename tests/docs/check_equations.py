#!/usr/bin/env python3
"""Checks docs/manual/explanation/equations.md, the table of the paper's equations, against the sources.

    check_equations.py ROOT      prints each fault, exits 1 if there is one

A row is `| (n) | what it says | function | test | note |`. Each of (1)-(38) and (A.1)-(A.18) has
exactly one row. A function is a link [`Name`](header) to a header that contains every word of Name
outside comments; otherwise the cell is `not realized: reason`. A test is a link [`Suite.Name`](source)
to a source with that GoogleTest, or [`path`](path) to a file or folder of tests/. A note links to a
heading of the page.
"""
import pathlib
import re
import sys

PAGE = pathlib.PurePosixPath("docs/manual/explanation/equations.md")
EQUATIONS = [f"({n})" for n in range(1, 39)] + [f"(A.{n})" for n in range(1, 19)]
ROW = re.compile(r"^\| (\((?:A\.)?\d+\)) \|(.*)\|$")
LINK = re.compile(r"\[(`?)([^\]`]+)\1\]\(([^)\s]+)\)")
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
HEADING = re.compile(r"^#+ (.*)$", re.MULTILINE)
REFUSAL = re.compile(r"not realized: \S.*")


def slug(heading):
    """The anchor of a heading on GitHub."""
    kept = re.sub(r"[^\w\- ]", "", heading.strip().lower())
    return kept.replace(" ", "-")


def file_of(root, target):
    """The file or folder that a link leads to, or None."""
    path = (root / PAGE.parent / target).resolve()
    return path if path.is_relative_to(root) and path.exists() else None


def check_function(root, cell):
    links = LINK.findall(cell)
    if not links and not REFUSAL.fullmatch(cell):
        yield f"names no function and no reason: `{cell}`"
    for _, name, target in links:
        header = file_of(root, target)
        if header is None or not header.is_file():
            yield f"{name}: no header {target}"
            continue
        code = COMMENT.sub("", header.read_text(encoding="utf-8"))
        for word in name.split("::"):
            if not re.search(rf"\b{re.escape(word)}\b", code):
                yield f"{name}: {word} does not stand in {target}"


def check_test(root, cell):
    links = LINK.findall(cell)
    if not links:
        yield f"names no test: `{cell}`"
    for _, name, target in links:
        source = file_of(root, target)
        if source is None:
            yield f"{name}: no file {target}"
        elif re.fullmatch(r"\w+\.\w+", name):
            suite, test = name.split(".")
            written = rf"^\s*TEST(?:_F|_P)?\(\s*{suite}\s*,\s*{test}\s*\)"
            text = COMMENT.sub("", source.read_text(encoding="utf-8")) if source.is_file() else ""
            if not re.search(written, text, re.MULTILINE):
                yield f"{name}: {target} has no such test"
        elif not source.is_relative_to(root / "tests") or name != source.relative_to(root).as_posix():
            yield f"{name}: neither Suite.Name nor the path of {target} in tests/"


def check_row(root, cells, headings):
    if len(cells) != 4:
        yield f"has {len(cells) + 1} cells; wanted: equation, what it says, function, test, note"
        return
    says, function, test, note = cells
    if not says:
        yield "does not say what the equation says"
    yield from check_function(root, function)
    yield from check_test(root, test)
    if note and not LINK.findall(note):
        yield f"note without a link: `{note}`"
    for _, name, target in LINK.findall(note):
        if not target.startswith("#") or target[1:] not in headings:
            yield f"note {name}: no heading {target}"


def check_numbers(found):
    for equation in EQUATIONS:
        if found.count(equation) != 1:
            yield f"{PAGE}: {equation} stands in {found.count(equation)} rows, wanted 1"
    for equation in found:
        if equation not in EQUATIONS:
            yield f"{PAGE}: the paper has no {equation}"


def check(root):
    root = root.resolve()
    text = (root / PAGE).read_text(encoding="utf-8")
    headings = {slug(heading) for heading in HEADING.findall(text)}
    errors, found = [], []
    for number, line in enumerate(text.splitlines(), 1):
        row = ROW.match(line)
        if row:
            found.append(row.group(1))
            cells = [cell.strip() for cell in row.group(2).split("|")]
            errors += [f"{PAGE}:{number}: {row.group(1)} {fault}" for fault in check_row(root, cells, headings)]
    return errors + list(check_numbers(found))


def main():
    errors = check(pathlib.Path(sys.argv[1]))
    for error in errors:
        print(error)
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
