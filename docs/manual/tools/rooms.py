"""The picture of the rooms, from layers.txt."""
import re
import subprocess


def read(layers):
    """[(room, rooms it may include)] in the order of the file."""
    table = []
    for line in layers.read_text().splitlines():
        if line.startswith("#") or not line.strip():
            continue
        room, named = line.split(":")
        table.append((room, named.split()))
    return table


def purpose(sources, room):
    """The first sentence of the room's README."""
    for folder in (sources / room, sources.parent / room, sources.parent / room / "c"):
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
    """Rooms that a room may include through others that it may include."""
    named = dict(table)
    return {room: {far for near in rooms for far in named.get(near, [])} for room, rooms in table}


def dot(table, sources):
    """The graph, without arrows that others imply."""
    lines = ["digraph rooms {", "rankdir=BT; nodesep=0.25; ranksep=0.35; bgcolor=white;",
             'node [shape=box style="rounded,filled" fontname="Helvetica" fontsize=11 color="#1b5e8c" '
             'fillcolor="#eef5fa" margin="0.15,0.08"];', 'edge [color="#5a6b78" arrowsize=0.7];']
    implied = reachable(table)
    for room, named in table:
        said = "".join(f'<br/><font point-size="9">{line}</font>' for line in wrapped(
            purpose(sources, room).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")))
        color = ' fillcolor="#fdf1e3" color="#b5651d"' if room == "methods" else ""
        lines.append(f"{room} [label=<<b>{room}</b>{said}>{color}];")
        lines += [f"{room} -> {other};" for other in named if other not in implied[room]]
    return "\n".join(lines + ["}"])


def draw(layers, sources, to):
    graph = dot(read(layers), sources)
    done = subprocess.run(["dot", "-Tsvg"], input=graph, capture_output=True, text=True, check=True)
    # Without graphviz's comments, which name its version.
    to.parent.mkdir(parents=True, exist_ok=True)
    to.write_text(re.sub(r"<!--.*?-->\n?", "", done.stdout, flags=re.DOTALL))
