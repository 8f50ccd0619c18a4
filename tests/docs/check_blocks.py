#!/usr/bin/env python3
"""Runs the code blocks of documents and compares their output with the documents.

    CLACKERS=build/dev/cli/clackers CLACKERS_BUILD=build/dev check_blocks.py README.md ...
    check_blocks.py --update README.md      also writes output that differs into the document

The blocks of a document run in order in one temporary folder:

sh        every line is a command that must succeed
console   "$ command", continued by "> " lines, and its output; a line "..." matches any lines. After a
          command that fails, "$ echo $?" shows its exit code
c, cpp, python   the first line is a comment that names a file, which is written; a C or C++ program is
          also built under the name without its extension. Without a name, C++ is a fragment that is
          compiled after PREAMBLE
text, json, csv, yaml, math, {directive}   not run
"""
import functools
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import blocks

ROOT = pathlib.Path(__file__).resolve().parents[2]

# Commands that install packages or take minutes, and the test that runs them.
ELSEWHERE = {
    r"scripts/demo": "cli.test_verify runs the command; continuous integration runs the script",
    r"scripts/test": "continuous integration",
    r"scripts/setup( \w+)?": "scripts/test begins with it",
    r"scripts/docs.*": "docs.manual",
    r"scripts/bench.*": "by hand: benchmarks/README.md",
    r"cmake --preset dev && .*": "scripts/test",
    r"cc examples/c/impacts.c .*": "package.test_c",
    r"scripts/package && apt install .*": "package.test_debian",
    r"python3 -m venv --system-site-packages venv && .*": "package.test_wheel",
    r"clackers paper .*": "cli.test_paper",
    r"clackers atlas\b.*": "cli.test_atlas",
    r"clackers verify --exec '\./solver .*": "cli.test_exec",
    r"(cc|gfortran) -O2 .*|\./newmark .*": "cli.test_step_functions",
    r"find_package\(.*": "package.test_cpp",
    r"target_link_libraries\(.*": "package.test_cpp",
}
TO_READ = {"text", "json", "csv", "yaml", "math", "xml", "latex", "toml", "sql"}
NAME = re.compile(r"(?://|#|/\*) ([\w.-]+\.(?:c|cpp|py|sh))\b")
# Precedes a fragment of C++.
PREAMBLE = """#include "clackers/cases/case.hpp"
#include "clackers/methods/registry.hpp"
#include "clackers/model/run.hpp"
[[maybe_unused]] static void fragment() {
"""


@functools.cache
def python_with_numpy():
    for program in (sys.executable, "/usr/bin/python3"):
        if os.path.exists(program) and not subprocess.run([program, "-c", "import numpy"], capture_output=True).returncode:
            return program
    return sys.executable


class Document:
    def __init__(self, path, folder):
        self.path, self.folder, self.problems = path, pathlib.Path(folder), []
        self.name = path.relative_to(ROOT).as_posix() if path.is_relative_to(ROOT) else path.name
        self.last_code = 0
        self.differing = []  # (shown, printed)
        tools = self.folder / ".tools"
        tools.mkdir()
        (tools / "clackers").symlink_to(pathlib.Path(os.environ["CLACKERS"]).resolve())
        (tools / "python3").symlink_to(python_with_numpy())
        self.build = pathlib.Path(os.environ.get("CLACKERS_BUILD", "build/dev")).resolve()
        kept = {k: v for k, v in os.environ.items() if k not in ("COLUMNS", "NO_COLOR")}
        self.environment = {**kept, "PATH": f"{tools}:{os.environ['PATH']}", "LC_ALL": "C.UTF-8",
                            "LD_LIBRARY_PATH": str(self.build / "bindings/c"),
                            "PYTHONPATH": str(self.build / "python"), "PYTHONDONTWRITEBYTECODE": "1"}

    def run(self, command):
        """The output of a command on both streams; keeps its exit code."""
        done = subprocess.run(["bash", "-c", f"(exit {self.last_code}); {command}"], cwd=self.folder,
                              env=self.environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, timeout=120)
        self.last_code = done.returncode
        return done.stdout

    def problem(self, block, text):
        self.problems.append(f"{self.name}:{block.line}: {text}")

    @staticmethod
    def elsewhere(command):
        return any(re.fullmatch(pattern, command) for pattern in ELSEWHERE)

    def check(self):
        try:
            found = blocks.blocks_of(self.path.read_text())
        except ValueError as problem:
            self.problems.append(f"{self.name}: {problem}")
            return self.problems
        for block in found:
            self.check_block(block)
        return self.problems

    def check_block(self, block):
        language = block.language
        if language in TO_READ or language.startswith("{"):
            return
        if language in ("sh", "cmake"):
            self.check_commands(block)
        elif language == "console":
            self.check_console(block)
        elif language in ("c", "cpp", "python"):
            self.check_source(block)
        else:
            self.problem(block, f"no rule for blocks of \"{language}\"")

    def check_commands(self, block):
        for command in blocks.commands_of(block.text):
            if self.elsewhere(command):
                continue
            if block.language == "cmake":
                self.problem(block, f"nothing runs this: {command}")
                continue
            self.last_code = 0
            output = self.run(command)
            if self.last_code:
                self.problem(block, f"{command}: exit code {self.last_code}\n{output}")

    def check_console(self, block):
        try:
            steps = blocks.steps_of(block.text)
        except ValueError as problem:
            self.problem(block, str(problem))
            return
        self.last_code = 0
        for number, step in enumerate(steps):
            output = self.run(step.command)
            if not blocks.matches(step.expected, output):
                self.problem(block, f"$ {step.command}\nshows\n{step.expected}\nand prints\n{output}")
                self.differing.append((step.expected, output))
            shown = number + 1 < len(steps) and steps[number + 1].command == "echo $?"
            if self.last_code and not shown:
                self.problem(block, f"{step.command}: exit code {self.last_code}, which is not shown")

    def check_source(self, block):
        named = NAME.match(block.text)
        if not named:
            if block.language != "cpp":
                self.problem(block, f"{block.language} without a comment that names its file")
                return
            self.compile(block, PREAMBLE + block.text + "}\n", ["c++", "-std=c++20", "-fsyntax-only", "-x", "c++", "-"])
            return
        path = self.folder / named[1]
        path.write_text(block.text)
        if path.suffix == ".c":
            self.compile(block, "", ["cc", "-std=c99", "-pedantic", "-I", ROOT / "bindings/c", path, "-L", self.build / "bindings/c",
                                     "-lclackers", "-lm", "-o", path.with_suffix("")])
        elif path.suffix == ".cpp":
            modules = sorted(self.build.glob("libclackers_*.a"))
            if not modules:
                self.problem(block, f"no libraries in CLACKERS_BUILD, {self.build}")
                return
            self.compile(block, "", ["c++", "-std=c++20", path, "-Wl,--start-group", *modules, "-Wl,--end-group", "-lfmt",
                                     "-lhwy", "-lflint-arb", "-lflint", "-o", path.with_suffix("")])

    def compile(self, block, text, command):
        words = [str(word) for word in command]
        words[1:1] = [] if words[0] == "cc" else ["-Wall", "-Wextra", "-Werror", "-I", str(ROOT), "-isystem", "/usr/include/eigen3"]
        done = subprocess.run(words, input=text, capture_output=True, text=True, cwd=self.folder)
        if done.returncode:
            self.problem(block, f"does not compile:\n{done.stderr}")


def main():
    problems = []
    update = "--update" in sys.argv
    paths = [pathlib.Path(name).resolve() for name in sys.argv[1:] if name != "--update"]
    for path in paths:
        with tempfile.TemporaryDirectory(prefix="clackers-blocks-") as folder:
            document = Document(path, folder)
            problems += document.check()
        if update:
            text = path.read_text()
            for shown, printed in document.differing:
                text = text.replace(shown, printed, 1) if shown else text
            path.write_text(text)
    print("\n\n".join(problems))
    return 1 if problems or not paths else 0


if __name__ == "__main__":
    sys.exit(main())
