#!/usr/bin/env python3
"""Checks every include of the project against the table of modules in layers.txt.

    check_layers.py ROOT      prints each violation, exits 1 if there is one

A module may include itself and the modules its row names; a row can only name modules above it, so a
cycle cannot be written down. Tests (*_test.cpp) may include any module, except that nothing under
methods/, tests included, may include exact/ or cases/: methods never include the reference. The
CMake target of a module may link what its row names and no other module.
"""
import pathlib
import re
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)
SOURCES = {".cpp", ".hpp", ".h", ".hh", ".cc", ".cxx", ".hxx", ".inl", ".ipp", ".c", ".in"}
FORBIDDEN_FOR_THE_JUDGED = {"exact", "certified", "cases"}


def read_table(text):
    """Modules in order with the modules each may include, and the errors of the table itself."""
    table, errors = {}, []
    for number, line in enumerate(text.splitlines(), 1):
        line = line.split("#")[0].strip()
        if not line:
            continue
        name, colon, allowed = line.partition(":")
        if not colon or not name.strip():
            errors.append(f"layers.txt:{number}: expected `module: modules`, found `{line}`")
            continue
        for module in allowed.split():
            if module not in table:
                errors.append(f"layers.txt:{number}: {name} names {module}, which does not stand above it")
        if name.strip() in table:
            errors.append(f"layers.txt:{number}: {name} stands twice")
        table[name.strip()] = set(allowed.split())
    return table, errors


def module_of(path, table):
    """The module a path (relative to the root) lies in, or None."""
    parts = path.parts
    if len(parts) > 2 and parts[0] == "clackers":
        return parts[1]
    if len(parts) > 1 and parts[0] in table:
        return parts[0]
    return None


def target_of(include, includer, root):
    """The path an include means, relative to the root, or None when it is not ours."""
    for base in (root, root / includer.parent, root / "clackers"):
        candidate = (base / include).resolve()
        if candidate.is_relative_to(root) and candidate.exists():
            return candidate.relative_to(root)
    written = pathlib.PurePosixPath(include)
    if written.parts and written.parts[0] == "clackers":
        return pathlib.Path(include)  # a file made by the build, or a missing one
    return None


def check_includes(root, table):
    errors = []
    files = [p for top in ["clackers", *table] for p in sorted((root / top).rglob("*"))
             if p.suffix in SOURCES and p.is_file()]
    for file in dict.fromkeys(files):
        here = file.relative_to(root)
        module = module_of(here, table)
        if module not in table:
            errors.append(f"{here}: lies in no module of layers.txt")
            continue
        is_test = file.stem.endswith("_test")
        for include in INCLUDE.findall(file.read_text(encoding="utf-8", errors="replace")):
            target = target_of(include, here, root)
            other = module_of(target, table) if target else None
            if other is None or other == module:
                continue
            if module == "methods" and other in FORBIDDEN_FOR_THE_JUDGED:
                errors.append(f"{here}: includes {include}: methods never include the reference")
            elif not is_test and other not in table[module]:
                errors.append(f"{here}: includes {include}: {module} may not include {other}")
    return errors


def check_targets(root, table):
    cmake = root / "CMakeLists.txt"
    if not cmake.exists():
        return []
    errors = []
    for module, arguments in re.findall(r"^clackers_module\((\w+)\s+([^)]*)\)", cmake.read_text(), re.MULTILINE):
        linked = re.search(r"\bLINK\b(.*?)(\bTEST_LINK\b|\bGENERATED\b|$)", arguments, re.DOTALL)
        for other in re.findall(r"\b[a-z]+\b(?!::|_)", linked.group(1) if linked else ""):
            if other in table and other != module and other not in table.get(module, set()):
                errors.append(f"CMakeLists.txt: module {module} links {other}, which its row does not name")
    return errors


def check(root):
    table, errors = read_table((root / "layers.txt").read_text())
    return errors + check_includes(root, table) + check_targets(root, table)


if __name__ == "__main__":
    found = check(pathlib.Path(sys.argv[1]).resolve())
    print("\n".join(found))
    sys.exit(1 if found else 0)
