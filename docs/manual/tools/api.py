#!/usr/bin/env python3
"""The public headers: their list for Doxygen, and a page a module for Breathe."""
import pathlib

ROOT = pathlib.Path(__file__).resolve().parents[3]
MODULES = {
    "model": ("The model", "Impact problems, states, runs and the interface of a reference solution.",
              ["system", "impact_problem", "motion", "run", "sink", "trajectory"]),
    "cases": ("Cases", "Named problems with their reference solutions.", ["case"]),
    "exact": ("Reference solutions", "Exact motions in closed form.",
              ["parameters", "closed_form", "admissibility", "quantities", "energy", "sensitivity", "spectrum"]),
    "methods": ("Methods", "Time integrators and contact treatments, and the interface of a new method.",
                ["method", "registry"]),
}
C_HEADERS = ["bindings/c/clackers.h", "bindings/c/clackers_main.h"]


def header(module, stem):
    """The path of a header of a module, wherever in it."""
    found = sorted((ROOT / "clackers" / module).rglob(f"{stem}.hpp"))
    if len(found) != 1:
        raise SystemExit(f"docs/manual/tools/api.py: {len(found)} headers {stem}.hpp in {module}")
    return found[0].relative_to(ROOT).as_posix()


def headers():
    return [header(module, stem) for module, (_, _, stems) in MODULES.items() for stem in stems] + C_HEADERS


def pages():
    """Texts by page."""
    texts = {}
    for module, (title, words, stems) in MODULES.items():
        named = ", ".join(f"`{header(module, stem)}`" for stem in stems)
        texts[f"reference/api/{module}.md"] = (
            f"# {title}\n\n{words} Headers: {named}.\n\n"
            f"```{{doxygennamespace}} clackers::{module}\n:content-only:\n:members:\n```\n")
    sections = "innerclass enum func typedef var public*"
    texts["reference/api/c.md"] = (
        "# The C library\n\nC99, for every language that can call C. pkg-config knows `clackers.h` as `clackers`.\n\n"
        f"```{{doxygenfile}} clackers.h\n:sections: {sections}\n```\n")
    texts["reference/api/main.md"] = (
        "# Programs of step functions\n\nThe header that makes a program for `clackers verify --exec` of a "
        "[step function](../../how-to/judge-a-step-function.md).\n\n"
        f"```{{doxygenfile}} clackers_main.h\n:sections: {sections}\n```\n")
    return texts


if __name__ == "__main__":
    print(" ".join(headers()))
