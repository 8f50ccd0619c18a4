"""Draws the modules of layers.txt."""
import re
import subprocess


def read(layers):
    """[(module, modules it may include)] in the order of the file."""
    table = []
    for line in layers.read_text().splitlines():
        if line.startswith("#") or not line.strip():
            continue
        module, named = line.split(":")
        table.append((module, named.split()))
    return table


def purpose(sources, module):
    """The first sentence of the module's README."""
    for folder in (sources / module, sources.parent / module, sources.parent / module / "c"):
        if (folder / "README.md").is_file():
            text = (folder / "README.md").read_text().split("\n", 1)[1].strip()
            text = re.sub(r"\[([^\]]*)\]\([^)]*\)|`", r"\1", text.split("\n\n")[0].replace("\n", " "))
            return re.split(r"(?<=[.:;])\s", text)[0].rstrip(".:;")
    return ""


def wrapped(text, width=30):
    lines, line = [], ""
    for word in text.split():
        if line and len(line) + len(word) + 1 > width:
            lines.append(line)
            line = ""
        line += (" " if line else "") + word
    return lines + [line] if line else lines


def reachable(table):
    """The modules that each module may include through others."""
    named = dict(table)
    return {module: {far for near in modules for far in named.get(near, [])} for module, modules in table}


def dot(table, sources):
    """The graph, without arrows that follow from others."""
    lines = ["digraph modules {", "rankdir=BT; nodesep=0.25; ranksep=0.35; bgcolor=white;",
             'node [shape=box style="rounded,filled" fontname="Helvetica" fontsize=11 color="#1b5e8c" '
             'fillcolor="#eef5fa" margin="0.15,0.08"];', 'edge [color="#5a6b78" arrowsize=0.7];']
    implied = reachable(table)
    for module, named in table:
        lines_below = "".join(f'<br/><font point-size="9">{line}</font>' for line in wrapped(
            purpose(sources, module).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")))
        color = ' fillcolor="#fdf1e3" color="#b5651d"' if module == "methods" else ""
        lines.append(f"{module} [label=<<b>{module}</b>{lines_below}>{color}];")
        lines += [f"{module} -> {other};" for other in named if other not in implied[module]]
    return "\n".join(lines + ["}"])


def draw(layers, sources, to):
    graph = dot(read(layers), sources)
    done = subprocess.run(["dot", "-Tsvg"], input=graph, capture_output=True, text=True, check=True)
    # Remove graphviz's comments, which contain its version.
    to.parent.mkdir(parents=True, exist_ok=True)
    to.write_text(re.sub(r"<!--.*?-->\n?", "", done.stdout, flags=re.DOTALL))
