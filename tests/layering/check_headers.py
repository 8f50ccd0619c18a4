#!/usr/bin/env python3
"""Every header of the project must compile alone: check_headers.py ROOT COMPILER FLAGS...

A header that a source of a library includes before all else was compiled alone by the build, which
gives libraries no precompiled headers. The others are compiled here.
"""
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys


def first_include(source):
    """What the source includes before all else, as it is written."""
    found = re.search(r'^#include ["<]([^">]+)', source.read_text(), re.MULTILINE)
    return found and found[1]


def compiled_first(sources):
    """The headers that the build has compiled alone."""
    return {first_include(s) for s in sources if not s.name.endswith("_test.cpp")}


def errors_of(header, command, root):
    text = f'#include "{header.relative_to(root)}"\n'
    run = subprocess.run(command, input=text, capture_output=True, text=True, cwd=root)
    return run.stderr if run.returncode else ""


def main(root, compiler, flags):
    root = pathlib.Path(root).resolve()
    modules = [root / top for top in ("clackers", "cli", "bindings")]
    headers = sorted(p for module in modules for p in module.rglob("*") if p.suffix in (".h", ".hpp"))
    if len(headers) < 20:
        sys.exit(f"found only {len(headers)} headers below {root}")
    built = compiled_first(p for module in modules for p in module.rglob("*.cpp"))
    alone = [h for h in headers if str(h.relative_to(root)) not in built]
    command = [compiler, *flags, "-std=c++20", "-I.", "-fsyntax-only", "-x", "c++", "-"]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = [e for e in pool.map(lambda h: errors_of(h, command, root), alone) if e]
    print("".join(found), end="")
    print(f"{len(headers)} headers, {len(headers) - len(alone)} compiled by the build, "
          f"{len(found)} of the others do not compile alone")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], sys.argv[3:])
