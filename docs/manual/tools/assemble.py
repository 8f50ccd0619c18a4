#!/usr/bin/env python3
"""Lays out the sources of the manual for Sphinx: hand-written pages, documents that stand elsewhere in
the tree, and pages that the command and the sources write themselves."""
import argparse
import pathlib
import shutil

import api
import command
import documents
import pages
import modules
import source_pages

ROOT = pathlib.Path(__file__).resolve().parents[3]
MANUAL = ROOT / "docs" / "manual"


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--command", required=True, help="a built clackers")
    arguments.add_argument("--out", required=True, type=pathlib.Path, help="a folder, made anew")
    options = arguments.parse_args()
    out = options.out
    shutil.rmtree(out, ignore_errors=True)
    shutil.copytree(MANUAL, out, ignore=shutil.ignore_patterns("tools", "README.md", "__pycache__"))

    links = source_pages.SourcePages(ROOT, out / "files")
    for path in sorted(out.rglob("*.md")):
        page = path.relative_to(out)
        path.write_text(links.rewrite(path.read_text(), MANUAL / page, page))
    texts = {**documents.pages(ROOT, links), **pages.pages(command.Command(options.command)),
             **api.pages()}
    for page, text in texts.items():
        path = out / page
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    modules.draw(ROOT / "layers.txt", ROOT / "clackers", out / "_static" / "modules.svg")


if __name__ == "__main__":
    main()
