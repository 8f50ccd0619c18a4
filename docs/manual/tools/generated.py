"""Reference pages that the command generates: cases, methods, metrics, codes, columns and the commands."""
import os
import pathlib
import re
import subprocess
import tempfile

import gallery

COMMANDS_LINE = re.compile(r"^  clackers ([a-z]+) ", re.MULTILINE)
# Sheets of curves, by their schema, drawn as figures by figures.mjs.
FIGURES = ("accuracy", "spectral-radius", "overshoot")
CARD_WORDS = ("Order", "Stability", "Dissipation", "Memory", "Cost", "Source")


def cell(value):
    """A cell of a table, with Markdown's markup escaped."""
    text = "" if value is None else str(value)
    return re.sub(r"([\\*_<>|`$\[\]~])", r"\\\1", text).replace("\n", " ")


def table(columns, rows, code_column=0):
    lines = ["| " + " | ".join(columns) + " |", "|" + " --- |" * len(columns)]
    for row in rows:
        cells = [f"`{value}`" if i == code_column and value else cell(value) for i, value in enumerate(row)]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def sheet_table(sheet, code_column=0):
    heads = [column["name"] + (f" [{column['unit']}]" if column["unit"] else "") for column in sheet["columns"]]
    return table([cell(head) for head in heads], sheet["rows"], code_column)


def toctree(names):
    return "```{toctree}\n:maxdepth: 1\n\n" + "\n".join(names) + "\n```\n"


def card(text):
    """A card: formulas and words unchanged, the six facts as a table."""
    head, _, facts = text.partition("\nOrder ")
    out, block = [], []
    for paragraph in head.strip("\n").split("\n\n"):
        if paragraph.startswith("    "):
            out.append("```text\n" + re.sub(r"^    ", "", paragraph, flags=re.MULTILINE) + "\n```")
        else:
            out.append(cell(paragraph))
    for line in ("Order " + facts).strip("\n").split("\n"):
        word = line.split(" ", 1)[0]
        if word in CARD_WORDS:
            block.append([word, line[len(word):].strip()])
        else:
            block[-1][1] += " " + line.strip()
    return "\n\n".join(out) + "\n\n" + table(["fact", ""], block, code_column=-1)


def measured(record, name):
    """What `verify --all` measured of the methods with this part: a row each."""
    rows = []
    for subject in record["cases"][0]["subjects"]:
        parts = [part.split(":")[0] for part in subject["name"].split("+")]
        if name in parts and subject.get("assessment"):
            found = subject["assessment"]["displacement"]
            rows.append([subject["name"], found["behaviour"], f"{found['order']:.2f}" if found["has_line"] else "",
                         subject["assessment"]["verdict"]])
    return table(["method", "behaviour", "order", "against its claim"], rows)


def method_page(command, row, record):
    name, kind, _, summary = row
    specification = f"newmark+{name}" if kind == "contact" else name
    sheets = command.json("show", specification)["sheets"]
    shown = f"clackers show {specification}"
    out = [f"# {name}\n\n{cell(summary[0].upper() + summary[1:])}. Kind: {kind}.\n"]
    own = [sheet for sheet in sheets if sheet["schema"] == "clackers/card/1" and sheet["title"].startswith(name + " ")]
    out += [card(sheet["rows"][0][0]) for sheet in own]
    for sheet in sheets:
        if sheet["schema"] == "clackers/parameters/1" and sheet["title"].endswith(" " + name):
            out.append("## Parameters\n\n" + sheet_table(sheet))
        if sheet["schema"] == "clackers/words/1" and sheet["title"].endswith(" of " + name):
            out.append(f"## Words for `{sheet['columns'][0]['name']}`\n\n" + sheet_table(sheet))
        if sheet["schema"] == "clackers/facts/1":
            out.append(f"## Claims of `{sheet['title']}`\n\n" + sheet_table(sheet))
    curves = [sheet for sheet in sheets if sheet["schema"].split("/")[1] in FIGURES]
    if kind == "integrator" and curves:
        out.append("## Free vibration\n")
        out += [f"![{cell(sheet['title'])}]({name}-{sheet['schema'].split('/')[1]}.svg)\n" for sheet in curves]
    out.append("## Measured through impacts\n\nOn the default case, by `clackers verify --all`.\n\n" + measured(record, name))
    out.append(f"`{shown}` prints the same, from the method's card.\n")
    return "\n".join(out)


def methods(command):
    listed = command.json("list", "methods")
    record = command.json("verify", "--all", "--quiet")
    texts = {f"reference/methods/{row[0]}.md": method_page(command, row, record) for row in listed["rows"]}
    pairs = command.json("list", "pairs")
    texts["reference/methods/index.md"] = (
        "# Methods\n\nA method is an integrator and a contact treatment joined by `+`, or a method that needs no separate "
        "treatment. Without `+contact` the treatment is `event-driven`.\n\n" + toctree(row[0] for row in listed["rows"]) +
        "\n## In one table\n\n" + sheet_table(listed) + "\n## All pairs and what they claim\n\n" + sheet_table(pairs))
    texts["reference/gallery.md"] = gallery.page(command, record)
    return texts


# In a page: here stands the drawing of a case.
DRAWING = re.compile(r"<!-- drawing: ([\w-]+) -->")


def with_drawings(page, text):
    """The text of a page with drawings of systems where it asks for them."""
    up = os.path.relpath(".", pathlib.PurePath(page).parent)
    return DRAWING.sub(lambda found: f"![The case {found[1]}: its masses, springs and contacts at the start, or its response]"
                                     f"({up}/_static/{found[1]}-case.svg)", text)


def names(command, kind):
    return [row[0] for row in command.json("list", kind)["rows"]]


def draw_figures(command, names, folder):
    """The figures of `show NAME --report` of methods or cases, in a folder."""
    with tempfile.TemporaryDirectory() as reports:
        pages = [f"{reports}/{name}.html" for name in names]
        for name, page in zip(names, pages):
            command.text("show", name, "--report", page, "--quiet")
        subprocess.run(["node", pathlib.Path(__file__).with_name("figures.mjs"), folder, *pages], check=True)


def cases(command):
    out = ["# Cases\n\nThe meaning of a name never changes. `clackers show CASE` prints everything derived from the "
           "parameters.\n"]
    for name, equations, _, summary in command.json("list", "cases")["rows"]:
        parameters = next(sheet for sheet in command.json("show", name)["sheets"]
                          if "parameter" in [column["name"] for column in sheet["columns"]])
        out.append(f"## {name}\n\n<!-- drawing: {name} -->\n\n{cell(summary)} {cell(equations)}.\n\n" + sheet_table(parameters))
    return {"reference/cases.md": "\n".join(out)}


def metrics(command):
    return {"reference/metrics.md": (
        "# Metrics\n\nThe table begins with the scores of a run of `verify`; the metrics of a whole history follow, which "
        "`check` and the report pages show. u, v, a are the displacement, velocity and acceleration of a history; u\\*, v\\*, "
        "a\\* those of the reference solution; U, V their largest envelopes over the run; T the time between impacts; "
        "g the gap of a contact. A name is QUANTITY-MEASURE, with `-relative` for a value without unit.\n\nA metric is *valid across jumps* if it tends to zero for every history that converges, although its "
        "velocities jump at slightly different times than those of the reference solution. The maximum of velocity errors "
        "is not valid: it compares the two sides of a jump.\n\n" + sheet_table(command.json("list", "metrics")))}


def reference(command):
    overall = command.text("--help")
    names = COMMANDS_LINE.findall(overall.split("\nUsage\n")[1])
    out = ["# Commands\n\nThis page is the output of `--help`. The installation includes man pages (`man clackers-verify`) and "
           "completion for bash and zsh.\n",
           "## clackers\n\n```text\n" + overall + "```\n"]
    out += [f"## clackers {name}\n\n```text\n" + command.text(name, "--help") + "```\n" for name in names]
    return {"reference/commands.md": "\n".join(out)}


def codes(command):
    sheet = command.json("explain")
    out = ["# Codes\n\nA code is the word in brackets at the end of a message. `clackers explain CODE` prints its meaning.\n"]
    for kind in dict.fromkeys(row[1] for row in sheet["rows"]):
        rows = [[row[0], row[2]] for row in sheet["rows"] if row[1] == kind]
        out.append(f"## {kind.capitalize()}\n\n" + table(["code", "meaning"], rows))
    return {"reference/codes.md": "\n".join(out)}


def columns(command):
    """The columns of a run, which output.md includes."""
    return {"reference/columns.md": (
        "# Columns\n\nThe columns of csv and json, in the order of csv. Reports use the same names.\n\n" +
        sheet_table(command.json("list", "columns")))}


def pages(command):
    """Texts by page."""
    return {**methods(command), **cases(command), **metrics(command), **columns(command), **reference(command),
            **codes(command)}
