#!/usr/bin/env python3
"""Checks the built pages: internal links lead to existing files and anchors, nothing is loaded from a
network, external addresses are well formed. Sphinx checks only the links that it creates."""
import html.parser
import pathlib
import re
import sys
import urllib.parse

ADDRESS = re.compile(r"https://[a-z0-9.-]+\.[a-z]{2,}(/[^\s]*)?\Z|mailto:[^@\s]+@[^@\s]+\Z")


class Page(html.parser.HTMLParser):
    """The anchors of a page, its links, and the files that it loads."""

    def __init__(self, text):
        super().__init__()
        self.anchors, self.links, self.loads = set(), set(), set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        self.anchors.update(found[name] for name in ("id", "name") if found.get(name))
        if tag == "a" and "href" in found:
            self.links.add(found["href"])
        if tag in ("script", "img", "iframe", "source") and found.get("src"):
            self.loads.add(found["src"])
        if tag == "link" and found.get("href") and "canonical" not in found.get("rel", ""):
            self.loads.add(found["href"])


def problems_of(folder):
    pages = {path: Page(path.read_text()) for path in sorted(folder.rglob("*.html"))
             if "mathjax" not in path.parts}
    problems = []
    for path, page in pages.items():
        for link in sorted(page.links | page.loads):
            where = f"{path.relative_to(folder)}: {link}"
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                if link in page.loads and parts.scheme != "data":
                    problems.append(f"{where} is loaded from a network")
                elif parts.scheme != "data" and not ADDRESS.match(link):
                    problems.append(f"{where} is no address")
                continue
            target = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
            if not target.exists():
                problems.append(f"{where} leads nowhere")
            elif parts.fragment and target in pages and \
                    urllib.parse.unquote(parts.fragment) not in pages[target].anchors:
                problems.append(f"{where}: no such anchor")
    # Without this, an interface that Doxygen did not find gives an empty page and no warning.
    for path in folder.glob("api/*.html"):
        if path.stem != "index" and "sig-name" not in path.read_text():
            problems.append(f"{path.relative_to(folder)}: describes nothing")
    return problems, len(pages)


def main():
    folder = pathlib.Path(sys.argv[1]).resolve()
    problems, count = problems_of(folder)
    print("\n".join(problems), end="\n" if problems else "", file=sys.stderr)
    if problems or not count:
        raise SystemExit(f"{len(problems)} broken links in {count} pages")


if __name__ == "__main__":
    main()
