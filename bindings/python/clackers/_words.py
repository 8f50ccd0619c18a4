"""The commands and options in the library's texts, as calls and arguments of Python."""
from __future__ import annotations

import re
from collections.abc import Callable
from typing import Union

Replacement = Union[str, Callable[["re.Match[str]"], str]]


def _argument(found: re.Match[str]) -> str:
    """``--budget 60s`` is ``budget=60``, ``--expect proper:2`` is ``expect="proper:2"``."""
    name, space, value = found[1].replace("-", "_"), found[2], found[3]
    end = "" if value.endswith("...") else value[len(value.rstrip(".;)")):]
    value = value[: len(value) - len(end)]
    if re.fullmatch(r"[-+.e\d]+s?", value):
        value = value.rstrip("s")
    else:
        value = f"[{value.replace(',', ', ')}]" if name in {"step", "tolerances"} and "," in value else f'"{value}"'
    return f"{space if space != ' ' else ''}{name}={value}{end}"


_NAME = r"(?<![\w-])--([a-z]+(?:-[a-z]+)*)"
_RULES: list[tuple[str, Replacement]] = [
    (r"clackers verify or check with --format json", "Record.to_json()"),
    (r"clackers verify --help", "help(clackers.Program)"),
    (r"gunzip -c FILE \| clackers check -", "gunzip FILE"),
    (r"clackers list ([a-z]+)", r'clackers.catalogue("\1")'),
    (r"clackers explain\b", "clackers.explain()"),
    (r"clackers show ([\w-]+)", r'clackers.case("\1").tables()'),
    (r"clackers respond ([\w-]+) --impacts", r'clackers.case("\1").impacts()'),
    (r"--set\s+([^\s=;]+=[^\s;]*\w)", r"\1"),
    (r"--set\b", "keyword arguments"),
    (r"--format json", "record.to_json()"),
    (r"--metrics all", "record.table()"),
    (r"--steps\b", "--step"),
    (r"--events\b", "--impacts"),
    (_NAME + r"(\s+)([^\s=]*(?:[\d,:]|[A-Z]{2})[^\s]*)", _argument),
    (_NAME, lambda found: str(found[1]).replace("-", "_")),
]


def in_python(text: str) -> str:
    """``text`` with what the user of the command types as what the user of this package types."""
    for pattern, replacement in _RULES:
        text = re.sub(pattern, replacement, text)
    return text


def html_in_python(html: str) -> str:
    """The same between the tags of html."""
    return re.sub(
        r"<(style|script)\b.*?</\1>|(?<=>)[^<]+(?=<)",
        lambda found: found[0] if found[1] else in_python(found[0]), html, flags=re.DOTALL,
    )
