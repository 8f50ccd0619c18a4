#!/usr/bin/env python3
"""Prepares the sources of the manual for Sphinx: the pages of docs/manual, the decisions, CONTRIBUTING,
CHANGELOG, and the reference pages that the built command and the headers generate."""
import argparse
import pathlib
import shutil

import api
import command
import generated
import links
import modules

ROOT = pathlib.Path(__file__).resolve().parents[3]


def sources():
    """The source of each written page, by page."""
    manual, decisions = ROOT / "docs" / "manual", ROOT / "docs" / "decisions"
    found = {path.relative_to(manual).as_posix(): path for path in manual.rglob("*.md") if path.name != "README.md"}
    found.update({f"explanation/decisions/{path.name}": path for path in decisions.glob("[0-9]*.md")})
    found.update({"contributing.md": ROOT / "CONTRIBUTING.md", "changelog.md": ROOT / "CHANGELOG.md"})
    return dict(sorted(found.items()))


def decisions_index(pages):
    names = [pathlib.PurePath(page).stem for page in pages if page.startswith("explanation/decisions/")]
    return ("# Decisions\n\nThe question, the choice, the rejected alternatives, and what would change the choice.\n\n" +
            generated.toctree(names))


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--command", required=True, help="a built clackers")
    arguments.add_argument("--out", required=True, type=pathlib.Path, help="a folder, replaced")
    options = arguments.parse_args()
    out = options.out
    shutil.rmtree(out, ignore_errors=True)
    shutil.copytree(ROOT / "docs" / "manual" / "_static", out / "_static")
    shutil.copy(ROOT / "docs" / "manual" / "conf.py", out)

    pages = sources()
    rewriter = links.Links(ROOT, {path: page for page, path in pages.items()}, out / "files")
    texts = {page: rewriter.rewrite(path, page) for page, path in pages.items()}
    program = command.Command(options.command)
    texts.update(generated.pages(program))
    texts.update(api.pages())
    texts["explanation/decisions/index.md"] = decisions_index(pages)
    for page, text in texts.items():
        (out / page).parent.mkdir(parents=True, exist_ok=True)
        (out / page).write_text(generated.with_drawings(page, text))
    generated.draw_figures(program, generated.names(program, "integrators"), out / "reference" / "methods")
    generated.draw_figures(program, generated.names(program, "cases"), out / "_static")
    rewriter.copy_pictures(out)
    modules.draw(ROOT / "layers.txt", ROOT / "clackers", out / "_static" / "modules.svg")


if __name__ == "__main__":
    main()
