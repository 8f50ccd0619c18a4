"""Links between documents of the tree, as they lead from a page of the manual; files of the tree become pages
that open without a network."""
import html
import os
import pathlib
import re
import shutil

from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import get_lexer_for_filename
from pygments.lexers.special import TextLexer
from pygments.util import ClassNotFound

# [text](target) and ![text](target) outside of code; the target has no scheme.
LINK = re.compile(r"(!?)\[((?:[^\[\]`]|`[^`]*`)+)\]\((?!\w+:)([^)#\s]*)(#[^)\s]*)?\)")
CODE = re.compile(r"(`+)(.+?)\1")
FENCE = re.compile(r"^(```|~~~|:::)")
# Generated pages: Sphinx checks that they exist.
GENERATED = ("docs/manual/reference/", "docs/manual/explanation/decisions/")


def breakable(name):
    """A name that a narrow column may break between its words."""
    return re.sub(r"(::|\.|(?<=[a-z0-9])(?=[A-Z]))", r"\1<wbr>", html.escape(name, quote=False))


def as_html(text):
    """The text of a link as HTML: code spans and nothing else."""
    parts = CODE.split(text)
    return "".join(html.escape(part, quote=False) if i % 3 == 0 else
                   f"<code>{breakable(part)}</code>" if i % 3 == 2 else "" for i, part in enumerate(parts))


class Links:
    def __init__(self, root, pages, folder):
        """`pages`: the page of each written document; `folder`: where files of the tree become pages."""
        self.root, self.pages, self.folder, self.pictures = root, pages, folder, set()

    def rewrite(self, source, page):
        """The text of `source` for `page`. Raises SystemExit for a link to nothing."""
        lines, fenced = [], False
        for line in source.read_text().split("\n"):
            if FENCE.match(line):
                fenced = not fenced
            # GitHub's fence for mathematics is a directive of MyST.
            line = "```{math}" if line == "```math" else line
            lines.append(line if fenced else LINK.sub(lambda found: self.replaced(found, source, page), line))
        return "\n".join(lines)

    def replaced(self, found, source, page):
        picture, words, target, anchor = found[1], found[2], found[3], found[4] or ""
        if not target:
            return found[0]
        path = pathlib.Path(os.path.normpath(source.parent / target))
        name = path.relative_to(self.root).as_posix()
        up = os.path.relpath(".", pathlib.PurePath(page).parent)
        if picture:
            self.pictures.add(path)
            return f"![{words}]({up}/_static/{path.name})"
        if path in self.pages:
            return f"[{words}]({up}/{self.pages[path]}{anchor})"
        if name == "docs/decisions":
            return f"[{words}]({up}/explanation/decisions/index.md)"
        if name.startswith(GENERATED):
            return f"[{words}]({up}/{name.removeprefix('docs/manual/')}{anchor})"
        if name.startswith("docs/manual/_static/"):
            return f'<a href="{up}/{name.removeprefix("docs/manual/")}">{as_html(words)}</a>'
        if not path.exists():
            raise SystemExit(f"{source.relative_to(self.root)}: the link to {target} leads nowhere")
        if path.is_dir():
            path, name = path / "README.md", f"{name}/README.md"
        self.write(path, name)
        return f'<a href="{up}/{name}.html">{as_html(words)}</a>'

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

    def copy_pictures(self, out):
        for picture in self.pictures:
            shutil.copy(picture, out / "_static")
