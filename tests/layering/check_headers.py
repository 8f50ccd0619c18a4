#!/usr/bin/env python3
"""Compiles every header of the project alone: check_headers.py ROOT COMPILER FLAGS..."""
import concurrent.futures
import os
import pathlib
import subprocess
import sys


def errors_of(header, command, root):
    text = f'#include "{header.relative_to(root)}"\n'
    run = subprocess.run(command, input=text, capture_output=True, text=True, cwd=root)
    return run.stderr if run.returncode else ""


def main(root, compiler, flags):
    root = pathlib.Path(root).resolve()
    rooms = [root / top for top in ("clackers", "cli", "bindings")]
    headers = sorted(p for room in rooms for p in room.rglob("*") if p.suffix in (".h", ".hpp"))
    if len(headers) < 20:
        sys.exit(f"found only {len(headers)} headers below {root}")
    command = [compiler, *flags, "-std=c++20", "-I.", "-fsyntax-only", "-x", "c++", "-"]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = [e for e in pool.map(lambda h: errors_of(h, command, root), headers) if e]
    print("".join(found), end="")
    print(f"{len(headers)} headers, {len(found)} do not compile alone")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], sys.argv[3:])
