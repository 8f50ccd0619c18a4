"""Draws bars-ladders.svg: six methods for the contact of a bar along a path of meshes and on one mesh.

ladders.py COMMAND FILE.svg; prints the rows of the table beside it. Needs matplotlib.
"""
import json
import subprocess
import sys

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams.update({"svg.hashsalt": "clackers", "svg.fonttype": "none", "font.size": 8})
from matplotlib import pyplot, ticker  # noqa: E402

# Label, method, mesh.
ROWS = (
    ("central differences, massless", "central-difference", "mass=massless"),
    ("implicit contact force, lumped", "newmark-implicit-contact", "mass=lumped,eta=1"),
    ("backward Euler, eta = 0", "bdf1", "mass=lumped,eta=0"),
    ("Moreau-Jean 1/2, eta = 0", "moreau-jean", "mass=lumped,eta=0"),
    ("Moreau-Jean 1/2, eta = 1", "moreau-jean", "mass=lumped,eta=1"),
    ("Newmark, contact inside", "newmark-position-multiplier", "mass=lumped,eta=1"),
)
COLORS = ("#0072b2", "#009e73", "#e69f00", "#56b4e9", "#cc79a7", "#d55e00")
MARKS = "osD^vx"


def verified(command, *words):
    done = subprocess.run([command, "verify", *words, "--format", "json"], capture_output=True, text=True)
    if done.returncode not in (0, 1):
        sys.exit(done.stderr)
    return json.loads(done.stdout)


def path_of(command, method, mesh):
    """Orders, the energy of the finest mesh, and steps in units of tau with their errors in u and v."""
    orders, finest, _, runs = verified(command, method, "--path", "0.45", "--set", mesh)["sheets"]
    names = [column["name"] for column in runs["columns"]]
    rows = [dict(zip(names, row)) for row in runs["rows"]]
    points = [(row["step"], row["e_total"], row["v_l1"]) for row in rows if not row["failure"]]
    return orders["rows"][0], finest["rows"][0][-1], points


def ladder_of(command, method, mesh):
    """How u and v converge on 8 elements, and steps with their errors."""
    subject = verified(command, method, "--case", "bar-wall", "--set", mesh + ",elements=8")["cases"][0]["subjects"][0]
    runs = [run for level in subject["levels"] for run in level["runs"] if run["finished"]]
    points = [(run["step"], run["u_error"], run["v_error"]) for run in runs[::3]]
    return subject["assessment"], points


def said(fit):
    return f'{fit["order"]:.2f} ± {fit["spread"]:.2f}' if fit["has_line"] else f'{fit["behaviour"]}, {fit["floor"]:.2g}'


def main(command, file):
    figure, panels = pyplot.subplots(2, 2, sharex="col", figsize=(7.4, 5.6))
    for (label, method, mesh), color, mark in zip(ROWS, COLORS, MARKS):
        (_, u, v1, v2, *_), energy, path = path_of(command, method, mesh)
        assessment, ladder = ladder_of(command, method, mesh)
        for column, points in enumerate((path, ladder)):
            for row in range(2):
                panels[row][column].loglog([p[0] for p in points], [p[row + 1] for p in points], mark, color=color,
                                           markersize=3.5, alpha=0.8, fillstyle="none", label=label)
        print(f"| {label} | {u} | {v1} | {v2} | {energy:+.4f} | {said(assessment['displacement'])} "
              f"| {said(assessment['velocity'])} |")
    panels[0][0].set_title("path: against the bar")
    panels[0][1].set_title("time: 8 elements, against the mesh")
    slopes_of = ((("2/3", 2 / 3), ("2", 2)), (("1/2", 1 / 2), ("2", 2)))
    for row, (slopes, name) in enumerate(zip(slopes_of, ("u, largest", "v, $L_1$"))):
        panels[row][0].set_ylabel("error of " + name)
        for axes, (name_of_slope, slope) in zip(panels[row], slopes):
            axes.grid(True, which="major", color="#dddddd")
            axes.set_ylim(bottom=axes.get_ylim()[0] / 2.0)
            right, bottom = axes.get_xlim()[1], axes.get_ylim()[0]
            x = [right / 4, right / 1.4]
            y = [bottom * 1.2 * (s / x[0]) ** slope for s in x]
            axes.loglog(x, y, color="black", linewidth=0.8)
            axes.xaxis.set_minor_formatter(ticker.NullFormatter())
            axes.yaxis.set_minor_formatter(ticker.NullFormatter())
            axes.annotate(name_of_slope, (x[1], y[1]), textcoords="offset points", xytext=(3, -3))
    for axes in panels[1]:
        axes.set_xlabel("step [s]")
    handles, labels = panels[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncol=3, frameon=False)
    figure.tight_layout(rect=(0, 0.08, 1, 1))
    figure.savefig(file, metadata={"Date": None})


main(*sys.argv[1:])
