#!/usr/bin/env python3
"""Checks that the files which documents and comments name exist.

    check_links.py ROOT          prints each name of a missing file, exits 1 if there is one
    check_links.py ROOT --fix    first points links of documents at files that moved, by their name

Checked: relative links and their anchors in *.md; in *.md outside code blocks and in comments, paths that
begin with a top folder (docs/..., clackers/...) and names of Markdown files.
"""
import os
import pathlib
import re
import subprocess
import sys

FENCE = re.compile(r"^ *(```|~~~).*?^ *\1 *$", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\[(?:[^\[\]`]|`[^`]*`)+\]\((?!\w+:)([^)#\s]*)(?:#([^)\s]*))?\)")
HEADING = re.compile(r"^#+ (.*)$", re.MULTILINE)
COMMENT = {"c": re.compile(r"(?<!:)//[^\n]*|/\*.*?\*/", re.DOTALL), "hash": re.compile(r"(?:^|\s)#[^\n]*|\"\"\".*?\"\"\"", re.DOTALL)}
KINDS = {".cpp": "c", ".hpp": "c", ".h": "c", ".c": "c", ".py": "hash", ".cmake": "hash", ".txt": "hash", "": "hash"}
FOLDERS = ("benchmarks", "bindings", "clackers", "cli", "cmake", "docs", "examples", "scripts", "tests", "tools")
PATH = re.compile(rf"(?<![\w./<-])((?:{'|'.join(FOLDERS)})/[\w./+-]*[\w+-])(?![\w(<*{{])")
DOCUMENT = re.compile(r"(?<![\w./*-])([\w-]+\.md)\b")
# Pages that docs/manual/tools writes and Sphinx checks; names with a version, which are no files.
GENERATED = re.compile(r"docs/manual/(reference/(cases|codes|columns|commands|metrics|methods/.*|api/\w+)\.md|explanation/decisions.*)")
VERSIONED = re.compile(r".*/\d+")


def anchors_of(text):
    """The anchors that GitHub and Sphinx give the headings."""
    plain = (re.sub(r"[^\w\- ]", "", heading.strip().lower()) for heading in HEADING.findall(FENCE.sub("", text)))
    return {heading.replace(" ", "-") for heading in plain}


def links_of(root, path, text):
    for target, anchor in LINK.findall(text):
        file = (path.parent / target).resolve() if target else path
        if not file.is_relative_to(root):
            yield f"the link {target} leaves the tree"
        elif not GENERATED.fullmatch(file.relative_to(root).as_posix()):
            if not file.exists():
                yield f"no file {target}"
            elif anchor and file.suffix == ".md" and anchor not in anchors_of(file.read_text(encoding="utf-8")):
                yield f"no heading {target}#{anchor}"


def names_of(root, text, documents):
    for name in PATH.findall(text):
        if not (root / name).exists() and not GENERATED.fullmatch(name) and not VERSIONED.fullmatch(name):
            yield f"no file {name}"
    for name in DOCUMENT.findall(text):
        if name not in documents:
            yield f"no document {name}"


def check(root, files):
    documents = {file.name for file in files if file.suffix == ".md"} | {"commands.md", "cases.md", "codes.md", "columns.md", "metrics.md"}
    for path in files:
        if path.suffix == ".md":
            text = FENCE.sub("", path.read_text(encoding="utf-8"))
            found = [*links_of(root, path, text), *names_of(root, LINK.sub("", text), documents)]
        elif path.suffix in KINDS:
            text = path.read_text(encoding="utf-8", errors="replace")
            found = names_of(root, "\n".join(COMMENT[KINDS[path.suffix]].findall(text)), documents)
        else:
            continue
        yield from (f"{path.relative_to(root)}: {fault}" for fault in dict.fromkeys(found))


def fix(root, files):
    """Links to missing files lead to the only file with the same name."""
    for path in (path for path in files if path.suffix == ".md"):
        def moved(found):
            target = found[1]
            same = [file for file in files if file.name == pathlib.PurePath(target).name]
            if not target or (path.parent / target).exists() or len(same) != 1:
                return found[0]
            return found[0].replace(f"({target}", f"({os.path.relpath(same[0], path.parent)}")
        text = path.read_text(encoding="utf-8")
        fixed = LINK.sub(moved, text)
        if fixed != text:
            path.write_text(fixed, encoding="utf-8")


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    listed = subprocess.run(["git", "-c", "safe.directory=*", "ls-files", "-co", "--exclude-standard"], cwd=root, capture_output=True, text=True, check=False).stdout
    files = [root / name for name in listed.splitlines() if (root / name).is_file()]
    if not files:  # an archive without git
        files = [path for path in sorted(root.rglob("*")) if path.is_file() and path.relative_to(root).parts[0] not in ("build", ".git")]
    if "--fix" in sys.argv[2:]:
        fix(root, files)
    found = list(check(root, files))
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
