"""Documents that stand elsewhere in the tree and belong to the manual as they are."""


def pages(root, links):
    """Texts by page."""
    taken = {"verdicts.md": "docs/verdicts.md", "equations.md": "docs/equations.md",
             "paper.md": "docs/paper.md", "contributing.md": "CONTRIBUTING.md"}
    decisions = sorted((root / "docs" / "decisions").glob("[0-9]*.md"))
    taken.update({f"decisions/{path.stem}.md": f"docs/decisions/{path.name}" for path in decisions})
    texts = {page: links.rewrite((root / path).read_text(), root / path, page) for page, path in taken.items()}
    # GitHub's fence for mathematics is a directive of MyST.
    texts = {page: text.replace("\n```math\n", "\n```{math}\n") for page, text in texts.items()}
    texts["decisions/index.md"] = (
        "# Decisions\n\nWhy things are as they are: the question, the choice, what was refused, and what would "
        "change it.\n\n```{toctree}\n:maxdepth: 1\n\n" + "\n".join(path.stem for path in decisions) + "\n```\n")
    return texts
