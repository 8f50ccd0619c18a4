"""Code blocks of Markdown documents, and the comparison of output with the text of a document."""
import dataclasses
import re

FENCE = re.compile(r"^(?P<indent> *)(?P<fence>`{3,}|~{3,})(?P<language>[^`\n]*)$")
PROMPT = "$ "
MORE = "> "


@dataclasses.dataclass
class Block:
    language: str
    text: str  # with its last newline
    line: int  # of its fence


@dataclasses.dataclass
class Step:
    """One command of a console block and the output below it."""
    command: str
    expected: str


def blocks_of(text):
    """All fenced blocks, in order. Raises ValueError for a fence that is not closed."""
    found, opened, body = [], None, []
    for number, line in enumerate(text.splitlines(), start=1):
        fence = FENCE.match(line)
        if opened is None:
            if fence:
                opened, body = (fence, number), []
            continue
        start = opened[0]
        if fence and not fence["language"].strip() and fence["fence"].startswith(start["fence"]):
            found.append(Block(start["language"].strip(), "".join(part + "\n" for part in body), opened[1]))
            opened = None
        else:
            body.append(line.removeprefix(start["indent"]))
    if opened is not None:
        raise ValueError(f"line {opened[1]}: a block that is not closed")
    return found


def commands_of(text):
    """The commands of a sh block: lines, joined where one ends with a backslash, without comments."""
    lines = re.sub(r"\\\n\s*", "", text).splitlines()
    bare = (re.sub(r"(^|\s)#\s.*$", "", line).strip() for line in lines)
    return [line for line in bare if line]


def steps_of(text):
    """The steps of a console block. Raises ValueError if it does not begin with a command."""
    steps = []
    for line in text.splitlines():
        if line.startswith(PROMPT):
            steps.append(Step(line.removeprefix(PROMPT), ""))
        elif steps and steps[-1].command.endswith("\\") and not steps[-1].expected:
            steps[-1].command = steps[-1].command[:-1] + line.strip()
        elif line.startswith(MORE) and steps and not steps[-1].expected:
            steps[-1].command += "\n" + line.removeprefix(MORE)
        elif steps:
            steps[-1].expected += line + "\n"
        else:
            raise ValueError(f'a console block begins with "{PROMPT}"')
    return steps


def pattern_of(expected):
    """A regular expression: a line of three dots matches any lines, three dots within a line any text."""
    parts = []
    for line in expected.rstrip("\n").split("\n"):
        if line.strip() == "...":
            parts.append(r"(?:[^\n]*\n)*?")
        else:
            parts.append("[^\n]*".join(re.escape(part) for part in line.rstrip().split("...")) + r"[ \t]*\n")
    return "".join(parts)


def matches(expected, actual):
    """Whether `actual` is the output that a document shows."""
    if not expected.strip():
        return not actual.strip()
    return re.fullmatch(pattern_of(expected), actual.rstrip("\n") + "\n") is not None
