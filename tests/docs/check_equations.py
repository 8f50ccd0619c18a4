#!/usr/bin/env python3
"""Checks docs/manual/explanation/equations.md, the table of the paper's equations, against the sources.

    check_equations.py ROOT          prints each fault, exits 1 if there is one
    check_equations.py ROOT --fix    first points links at the only file that has the name or the test

A row is `| (n) | what it says | function | test | note | claims |`. Each of (1)-(38) and (A.1)-(A.18) has
exactly one row. A function is a link [`Name`](header) to a header that contains every word of Name
outside comments; otherwise the cell is `not realized: reason`. A test is a link [`Suite.Name`](source)
to a source with that GoogleTest, or [`path`](path) to a file or folder of tests/. A note links to a
heading of the page, claims to headings of claims.md, each of which has a link somewhere in the page.
"""
import os
import pathlib
import re
import sys

PAGE = pathlib.PurePosixPath("docs/manual/explanation/equations.md")
CLAIMS = PAGE.with_name("claims.md")
EQUATIONS = [f"({n})" for n in range(1, 39)] + [f"(A.{n})" for n in range(1, 19)]
ROW = re.compile(r"^\| (\((?:A\.)?\d+\)) \|(.*)\|$")
LINK = re.compile(r"\[(`?)([^\]`]+)\1\]\(([^)\s]+)\)")
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
HEADING = re.compile(r"^#+ (.*)$", re.MULTILINE)
CLAIM = re.compile(r"^### (.*)$", re.MULTILINE)
REFUSAL = re.compile(r"not realized: \S.*")


def slug(heading):
    """The anchor of a heading on GitHub."""
    kept = re.sub(r"[^\w\- ]", "", heading.strip().lower())
    return kept.replace(" ", "-")


def file_of(root, target):
    """The file or folder that a link leads to, or None."""
    path = (root / PAGE.parent / target).resolve()
    return path if path.is_relative_to(root) and path.exists() else None


def has_words(header, name):
    """Whether every word of a C++ name stands in a header, outside comments."""
    code = COMMENT.sub("", header.read_text(encoding="utf-8"))
    return all(re.search(rf"\b{re.escape(word)}\b", code) for word in name.split("::"))


def has_test(source, name):
    suite, test = name.split(".")
    written = rf"^\s*TEST(?:_F|_P)?\(\s*{suite}\s*,\s*{test}\s*\)"
    return re.search(written, COMMENT.sub("", source.read_text(encoding="utf-8")), re.MULTILINE) is not None


def is_test_name(name):
    return re.fullmatch(r"\w+\.\w+", name) is not None


def check_function(root, cell):
    links = LINK.findall(cell)
    if not links and not REFUSAL.fullmatch(cell):
        yield f"names no function and no reason: `{cell}`"
    for _, name, target in links:
        header = file_of(root, target)
        if header is None or not header.is_file():
            yield f"{name}: no header {target}"
        elif not has_words(header, name):
            yield f"{name} does not stand in {target}"


def check_test(root, cell):
    links = LINK.findall(cell)
    if not links:
        yield f"names no test: `{cell}`"
    for _, name, target in links:
        source = file_of(root, target)
        if source is None:
            yield f"{name}: no file {target}"
        elif is_test_name(name):
            if not source.is_file() or not has_test(source, name):
                yield f"{name}: {target} has no such test"
        elif not source.is_relative_to(root / "tests") or name != source.relative_to(root).as_posix():
            yield f"{name}: neither Suite.Name nor the path of {target} in tests/"


def fix(root):
    """Links whose file lacks the name lead to the only file that has it."""
    headers = sorted((root / "clackers").rglob("*.hpp"))
    sources = sorted(path for top in ("clackers", "tests") for path in (root / top).rglob("*_test.cpp"))

    def moved(found):
        name, target = found[2], found[3]
        if target.startswith("#") or name.startswith("tests/"):
            return found[0]
        candidates, has = (sources, has_test) if is_test_name(name) else (headers, has_words)
        file = file_of(root, target)
        if file is not None and file.is_file() and has(file, name):
            return found[0]
        having = [candidate for candidate in candidates if has(candidate, name)]
        if len(having) != 1:
            return found[0]
        return found[0].replace(f"({target})", f"({os.path.relpath(having[0], (root / PAGE).parent)})")

    text = (root / PAGE).read_text(encoding="utf-8")
    rows = [LINK.sub(moved, line) if ROW.match(line) else line for line in text.split("\n")]
    (root / PAGE).write_text("\n".join(rows), encoding="utf-8")


def check_row(root, cells, headings):
    if len(cells) != 5:
        yield f"has {len(cells) + 1} cells; wanted: equation, what it says, function, test, note, claims"
        return
    says, function, test, note, claims = cells
    if not says:
        yield "does not say what the equation says"
    yield from check_function(root, function)
    yield from check_test(root, test)
    if note and not LINK.findall(note):
        yield f"note without a link: `{note}`"
    for _, name, target in LINK.findall(note):
        if not target.startswith("#") or target[1:] not in headings:
            yield f"note {name}: no heading {target}"
    if not LINK.findall(claims):
        yield f"names no claim: `{claims}`"


def check_claims(root, text):
    """Every claim has a link; that links lead to claims check_links.py sees."""
    for name in CLAIM.findall((root / CLAIMS).read_text(encoding="utf-8")):
        if f"({CLAIMS.name}#{slug(name)})" not in text:
            yield f"{PAGE}: no link to the claim {name}"


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
    return errors + list(check_numbers(found)) + list(check_claims(root, text))


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    if "--fix" in sys.argv[2:]:
        fix(root)
    errors = check(root)
    for error in errors:
        print(error)
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
