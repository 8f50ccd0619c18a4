#!/usr/bin/env python3
"""Compiles every header of the project alone: check_headers.py ROOT CACHE COMPILER FLAGS...

The builds use precompiled headers, so they cannot show that a header lacks an include. CACHE is a json
file of the headers that compiled, each with a digest of its text and of all headers of ours that it
includes; only headers with another digest are compiled.
"""
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)


def headers_of(root):
    return sorted(path for folder in ("clackers", "cli", "bindings") for path in (root / folder).rglob("*.h*")
                  if path.suffix in (".h", ".hpp"))


def closure(header, root, known):
    """The header and all headers of ours that it includes."""
    if header not in known:
        known.add(header)
        for include in INCLUDE.findall(header.read_text()):
            for base in (root, header.parent):
                if (base / include).is_file():
                    closure((base / include).resolve(), root, known)
                    break
    return known


def digest(header, root, command):
    text = " ".join(command) + "".join(path.read_text() for path in sorted(closure(header, root, set())))
    return hashlib.sha256(text.encode()).hexdigest()


def errors_of(header, command, root):
    run = subprocess.run(command, input=f'#include "{header.relative_to(root)}"\n', capture_output=True, text=True, cwd=root)
    return run.stderr if run.returncode else ""


def main(root, cache, *command):
    root, cache = pathlib.Path(root).resolve(), pathlib.Path(cache)
    command = [*command, "-std=c++20", "-I.", "-fsyntax-only", "-x", "c++", "-"]
    digests = {str(header): digest(header, root, command) for header in headers_of(root)}
    if len(digests) < 20:
        sys.exit(f"found only {len(digests)} headers below {root}")
    compiled = json.loads(cache.read_text()) if cache.is_file() else {}
    changed = [header for header, value in digests.items() if compiled.get(header) != value]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = dict(zip(changed, pool.map(lambda header: errors_of(pathlib.Path(header), command, root), changed)))
    cache.write_text(json.dumps({header: value for header, value in digests.items() if not found.get(header)}))
    failed = [text for text in found.values() if text]
    print("".join(failed), end="")
    print(f"{len(digests)} headers, {len(changed)} compiled, {len(failed)} do not compile alone")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main(*sys.argv[1:])
