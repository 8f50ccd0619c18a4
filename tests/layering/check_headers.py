#!/usr/bin/env python3
"""Compiles every header of the project on its own: check_headers.py ROOT CACHE COMPILER FLAGS...

The builds use precompiled headers, so they cannot show that a header lacks an include. To be quick the
headers of others (the standard library, Eigen, ...) are precompiled here, too: the compiler finds a
header of ours that is not included. That <vector> and its like are included, by the header itself or by
a header of ours that it includes, is looked up by name in a table. A lacking header of others that is
not in the table is not found.

A header on its own is one after others that it includes: a process takes a chain of headers, each of which includes the
one before it.

CACHE is a json file of the headers that passed, each with a digest of its text and of all headers of
ours that it includes; only headers with another digest are checked.
"""
import concurrent.futures
import functools
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

OURS = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)
OTHERS = re.compile(r"^\s*#\s*include\s*<([^>]+)>", re.MULTILINE)
COMMENT = re.compile(r"//.*")
# Of a name the headers that may be included for it.
NEEDED = {
    r"std::(vector|string_view|optional|span|array|map|set|atomic|variant|deque|mutex|filesystem)\b": (r"\1",),
    r"std::string\b": ("string",),
    r"std::function\b": ("functional",),
    r"std::(?:unique_ptr|shared_ptr|weak_ptr)\b": ("memory",),
    r"std::(?:ostream|istream)\b": ("iosfwd", "ostream", "istream", "iostream", "sstream", "fstream"),
    r"std::ofstream\b": ("fstream",),
    r"std::thread\b": ("thread",),
    r"std::numeric_limits\b": ("limits",),
    r"std::chrono\b": ("chrono",),
    r"\bEigen::": ("Eigen/Core", "Eigen/Dense", "Eigen/LU", "Eigen/Cholesky", "Eigen/SparseCore"),
    r"\bfmt::": ("fmt/format.h", "fmt/core.h"),
    r"\bpybind11::": ("pybind11/pybind11.h",),
    r"\bnlohmann::": ("nlohmann/json_fwd.hpp", "nlohmann/json.hpp"),
}


@functools.cache
def text_of(path):
    return path.read_text()


def headers_of(root):
    return sorted(path for folder in ("clackers", "cli", "bindings", "paper") for path in (root / folder).rglob("*.h*")
                  if path.suffix in (".h", ".hpp"))


def closure(header, root, known):
    """The header and all headers of ours that it includes."""
    if header not in known:
        known.add(header)
        for include in OURS.findall(text_of(header)):
            for base in (root, header.parent):
                if (base / include).is_file():
                    closure((base / include).resolve(), root, known)
                    break
    return known


def digest(header, root, command):
    text = " ".join(command) + "".join(text_of(path) for path in sorted(closure(header, root, set())))
    return hashlib.sha256((text + pathlib.Path(__file__).read_text()).encode()).hexdigest()


def lacking_others(header, root):
    """A line for each name of the table whose header is included nowhere."""
    included = {other for path in closure(header, root, set()) for other in OTHERS.findall(text_of(path))}
    text = COMMENT.sub("", text_of(header))
    lines = []
    for name, needed in NEEDED.items():
        for match in {found[0]: found for found in re.finditer(name, text)}.values():
            wanted = [match.expand(each) for each in needed]
            if not included.intersection(wanted):
                lines.append(f"{header.relative_to(root)}: {match[0]} without <{wanted[0]}>\n")
    return "".join(lines)


def chains(headers, root):
    """The fewest lists that hold all headers once, each header after one that it includes: a largest matching."""
    below = {header: [other for other in closure(header, root, set()) if other != header and other in headers]
             for header in headers}
    above = {}

    def place(header, seen):
        for other in below[header]:
            if other not in seen:
                seen.add(other)
                if other not in above or place(above[other], seen):
                    above[other] = header
                    return True
        return False

    for header in headers:
        place(header, set())
    for first in set(headers) - set(above.values()):
        chain = [first]
        while chain[-1] in above:
            chain.append(above[chain[-1]])
        yield chain


def errors_of(chain, root, command):
    includes = "".join(f'#include "{header.relative_to(root)}"\n' for header in chain)
    run = subprocess.run([*command, "-fsyntax-only", "-x", "c++", "-"], input=includes, capture_output=True, text=True, cwd=root)
    return "".join(lacking_others(header, root) for header in chain) + (run.stderr if run.returncode else "")


def precompile(headers, folder, root, command):
    """The options that use the headers of others, precompiled."""
    others = sorted({other for header in headers for other in OTHERS.findall(text_of(header))})
    # Highway's depend on macros of the file that includes them.
    text = "".join(f"#include <{other}>\n" for other in others if not other.startswith("hwy/"))
    path = pathlib.Path(folder) / "others.hpp"
    path.write_text(text)
    once = ["-fpch-instantiate-templates"] if "clang" in pathlib.Path(command[0]).name else []
    subprocess.run([*command, *once, "-x", "c++-header", str(path), "-o", f"{path}.gch"], check=True, cwd=root)
    return ["-include", str(path)]


def main(root, cache, *command):
    root, cache = pathlib.Path(root).resolve(), pathlib.Path(cache)
    command = [*command, "-std=c++20", "-I."]
    headers = headers_of(root)
    digests = {str(header): digest(header, root, command) for header in headers}
    if len(digests) < 20:
        sys.exit(f"found only {len(digests)} headers below {root}")
    passed = json.loads(cache.read_text()) if cache.is_file() else {}
    changed = [header for header in headers if passed.get(str(header)) != digests[str(header)]]
    parts, failed = [], set()
    if changed:
        with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            command += precompile(headers, folder, root, command)
            parts = list(chains(changed, root))
            errors = list(pool.map(lambda chain: errors_of(chain, root, command), parts))
            failed = {str(header) for chain, error in zip(parts, errors) if error for header in chain}
            print("".join(errors), end="")
    cache.write_text(json.dumps({header: value for header, value in digests.items() if header not in failed}))
    print(f"{len(digests)} headers, {len(changed)} compiled in {len(parts)} processes" + (", an include is lacking" if failed else ""))
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main(*sys.argv[1:])
