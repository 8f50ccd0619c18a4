"""Wrong versions of the rules of a module, all in one build: an environment variable chooses one.

Each condition of an `if` is a rule that may never hold or always, each number of a `constexpr` a limit that
may be four times as large. A version of a condition is tried with the tests in which it has another value.
"""
import concurrent.futures
import os
import re
import subprocess
import time

SUPPORT = """#pragma once
#include <cstdio>
#include <cstdlib>
namespace mutants {
struct Chosen {
  int rule = -1, kind = 0;
  unsigned char seen[1 << 13] = {};
  Chosen() {
    if (const char* text = std::getenv("CLACKERS_MUTANT")) std::sscanf(text, "%d %d", &rule, &kind);
  }
  ~Chosen() {
    const char* name = std::getenv("CLACKERS_SEEN");
    std::FILE* file = name ? std::fopen(name, "wb") : nullptr;
    if (file) std::fwrite(seen, 1, sizeof seen, file), std::fclose(file);
  }
};
inline Chosen& chosen() {
  static Chosen one;
  return one;
}
constexpr bool holds(int rule, bool value) {
  if (__builtin_is_constant_evaluated()) return value;
  chosen().seen[rule] |= value ? 1 : 2;
  return chosen().rule == rule ? chosen().kind == 1 : value;
}
template <class Number>
Number limit(int rule, Number value) {
  chosen().seen[rule] |= 3;
  return chosen().rule == rule ? Number(4 * value) : value;
}
}  // namespace mutants
"""
NEVER, ALWAYS, LARGER = range(3)
SLOW = 3.0  # seconds of a test that is tried where all others pass
LIMITS = re.compile(r"(?<!static )\bconstexpr ((?:double|int|std::size_t|long long) [^;]*;)")


def condition(text, start):
    """The text up to the parenthesis that closes the one before `start`."""
    depth, end = 1, start
    while depth:
        depth += {"(": 1, ")": -1}.get(text[end], 0)
        end += 1
    return text[start:end - 1]


class Instrumented:
    """The rules of a module, numbered, and the text of its files with all versions of them."""

    def __init__(self, tree, module):
        self.names, self.files = [], {}
        for path in sorted((tree / "clackers" / module).rglob("*.cpp")):
            if not path.stem.endswith("_test"):
                name = str(path.relative_to(tree))
                self.files[name] = self.changed(name, path.read_text(encoding="utf-8"))

    def changed(self, name, text):
        edits = []
        for found in re.finditer(r"\bif \((?!const |auto )", text):
            old = condition(text, found.end())
            if ";" not in old:
                edits.append((found.end(), old, f"mutants::holds({self.rule(name, text, found.end(), old)}, bool({old}))"))
        for found in LIMITS.finditer(text):
            new = re.sub(r"= ([0-9][0-9.e-]*)(?=[,;])",
                         lambda n: f"= mutants::limit({self.rule(name, text, found.start() + n.start(), found[0][n.start():].split(',')[0], True)}, {n[1]})",
                         found[0])
            if new != found[0] and not re.search(rf"[<\[]{found[1].split()[1]}[>\]]", text):
                new = re.sub(r"\bconstexpr ((?:double|int|std::size_t|long long))", r"static const \1", new)
                edits.append((found.start(), found[0], new))
        for at, old, new in sorted(edits, reverse=True):
            text = text[:at] + new + text[at + len(old):]
        return '#include "clackers/base/mutants.hpp"\n' + text

    def rule(self, name, text, at, old, is_limit=False):
        line = text.count("\n", 0, at) + 1
        self.names.append((f"{name}:{line}", " ".join(old.split()).lstrip("= ").rstrip(";"), is_limit))
        return len(self.names) - 1

    def write(self, copy):
        (copy / "clackers/base/mutants.hpp").write_text(SUPPORT)
        for name, text in self.files.items():
            (copy / name).write_text(text, encoding="utf-8")

    def versions(self):
        """(rule, kind, what it is)."""
        for rule, (place, old, is_limit) in enumerate(self.names):
            for kind in (LARGER,) if is_limit else (NEVER, ALWAYS):
                yield rule, kind, f"{place} {('never', 'always', 'larger')[kind]}: {old}"


class Tests:
    """The tests of a program with what each of them sees of the rules."""

    def __init__(self, program, scratch):
        self.program, self.scratch, self.seen, self.seconds = str(program), scratch, {}, {}
        listed, suite = self.run({}, "--gtest_list_tests").stdout, ""
        for line in listed.splitlines()[1:]:
            suite = suite if line.startswith(" ") else line.split()[0]
            if line.startswith(" ") and not suite.startswith("Slow"):
                self.seen[suite + line.split()[0]] = b""
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            list(pool.map(self.first, enumerate(self.seen)))

    def run(self, variables, *words):
        return subprocess.run([self.program, *words], capture_output=True, text=True, timeout=300, env={**os.environ, **variables})

    def first(self, numbered):
        number, name = numbered
        seen = self.scratch / f"seen{number}"
        start = time.monotonic()
        if self.run({"CLACKERS_SEEN": str(seen)}, f"--gtest_filter={name}").returncode == 0:
            self.seen[name], self.seconds[name] = seen.read_bytes(), time.monotonic() - start

    def noticing(self, rule, kind):
        """(whether a test fails with this version, number of tests that see it)."""
        sees = {NEVER: 1, ALWAYS: 2, LARGER: 3}[kind]
        names = [name for name, seen in self.seen.items() if seen and seen[rule] & sees]
        for slow in (False, True):
            part = [name for name in names if (self.seconds[name] > SLOW) == slow]
            if part and self.fails(rule, kind, part):
                return True, len(names)
        return False, len(names)

    def fails(self, rule, kind, names):
        try:
            return self.run({"CLACKERS_MUTANT": f"{rule} {kind}"}, "--gtest_fail_fast",
                            f"--gtest_filter={':'.join(names)}").returncode != 0
        except subprocess.TimeoutExpired:
            return True
