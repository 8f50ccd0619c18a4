#!/usr/bin/env python3
"""The public headers: their list for Doxygen, and a page a module for Breathe."""
ROOMS = {
    "model": ("The model", "What a method sees and how motion is told.",
              ["system", "impact_problem", "motion", "run", "sink", "trajectory"]),
    "cases": ("Cases", "Named problems with their reference.", ["case"]),
    "exact": ("Exact motions", "True motions in closed form.",
              ["synchronized_pair", "single_mass", "closed_form", "admissibility", "indicators", "conditioning",
               "energy", "sensitivity", "spectrum", "batch"]),
    "methods": ("Methods", "What is judged, and the interface of a new method.", ["method", "registry"]),
}
C_HEADER = "bindings/c/clackers.h"


def headers():
    return [f"clackers/{module}/{stem}.hpp" for module, (_, _, stems) in ROOMS.items() for stem in stems] + [C_HEADER]


def pages():
    """Texts by page."""
    texts = {}
    for module, (title, words, stems) in ROOMS.items():
        named = ", ".join(f"`clackers/{module}/{stem}.hpp`" for stem in stems)
        texts[f"api/{module}.md"] = (
            f"# {title}\n\n{words} Headers: {named}.\n\n"
            f"```{{doxygennamespace}} clackers::{module}\n:content-only:\n:members:\n```\n")
    texts["api/c.md"] = ("# The C library\n\nC99, for every language that can call C. `clackers.h`, found by pkg-config "
                         "as `clackers`.\n\n```{doxygenfile} clackers.h\n:sections: innerclass enum func typedef var public*\n```\n")
    return texts


if __name__ == "__main__":
    print(" ".join(headers()))
