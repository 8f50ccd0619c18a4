"""Files of the source tree as pages that open without a network, and links that lead there."""
import html
import os
import pathlib
import re

from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import get_lexer_for_filename
from pygments.lexers.special import TextLexer
from pygments.util import ClassNotFound

# [text](target) outside of code; the target has no scheme.
LINK = re.compile(r"(?<!!)\[((?:[^\[\]`]|`[^`]*`)+)\]\((?!\w+:)([^)#\s]*)(#[^)\s]*)?\)")
CODE = re.compile(r"(`+)(.+?)\1")
FENCE = re.compile(r"^(```|~~~|:::)", re.MULTILINE)

# Where a document of the tree has a page of its own.
PAGES = {"docs/verdicts.md": "verdicts", "docs/equations.md": "equations",
         "docs/paper.md": "paper", "CONTRIBUTING.md": "contributing", "docs/decisions": "decisions/index"}


def breakable(name):
    """A name that a narrow column may break between its words."""
    return re.sub(r"(::|\.|(?<=[a-z0-9])(?=[A-Z]))", r"\1<wbr>", html.escape(name, quote=False))


def as_html(text):
    """The text of a link as HTML: code spans and nothing else."""
    parts = CODE.split(text)
    return "".join(html.escape(part, quote=False) if i % 3 == 0 else
                   f"<code>{breakable(part)}</code>" if i % 3 == 2 else "" for i, part in enumerate(parts))


class SourcePages:
    def __init__(self, root, folder):
        self.root, self.folder = root, folder

    def rewrite(self, text, at, page):
        """`text`, a document that stands at `at`, with its links to files of the tree as they lead from
        `page`. Throws SystemExit for a link that leads nowhere."""
        def replaced(match):
            words, target, anchor = match[1], match[2], match[3] or ""
            if not target:
                return match[0]
            path = pathlib.Path(os.path.normpath(at.parent / target))
            manual = self.root / "docs" / "manual"
            if path.is_relative_to(manual):
                return match[0]  # Sphinx checks it; some of these pages are yet to be written
            if not path.exists():
                raise SystemExit(f"{at.relative_to(self.root)}: the link to {target} leads nowhere")
            name = path.relative_to(self.root).as_posix()
            up = "../" * (len(pathlib.PurePath(page).parts) - 1)
            if name in PAGES:
                return f"[{words}]({up}{PAGES[name]}.md{anchor})"
            if path.is_dir():
                path, name = path / "README.md", f"{name}/README.md"
            self.write(path, name)
            return f'<a href="{up}{name}.html">{as_html(words)}</a>'
        lines, fenced = [], False
        for line in text.split("\n"):
            if FENCE.match(line):
                fenced = not fenced
            lines.append(line if fenced else LINK.sub(replaced, line))
        return "\n".join(lines)

    def write(self, path, name):
        page = self.folder / (name + ".html")
        if page.exists():
            return
        try:
            lexer = get_lexer_for_filename(path.name)
        except ClassNotFound:
            lexer = TextLexer()
        page.parent.mkdir(parents=True, exist_ok=True)
        page.write_text(highlight(path.read_text(), lexer, HtmlFormatter(full=True, title=name, linenos="table",
                                                                        anchorlinenos=True, lineanchors="L")))
