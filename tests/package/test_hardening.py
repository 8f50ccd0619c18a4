"""The hardening that cmake/ClackersTargets.cmake states, read from a program built for use."""
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]

PROJECT = """
cmake_minimum_required(VERSION 3.25)
project(hardened LANGUAGES CXX)
include({targets})
add_executable(hardened hardened.cpp)
set_target_properties(hardened PROPERTIES POSITION_INDEPENDENT_CODE ON)
target_link_libraries(hardened PRIVATE clackers_options)
"""

# Copies to a buffer on the stack what the caller gives.
PROGRAM = """
#include <cstdio>
#include <cstring>
int main(int argc, char** argv) {
  char text[16];
  std::strcpy(text, argv[argc - 1]);
  std::puts(text);
}
"""


def is_for_use(build):
    cache = (pathlib.Path(build) / "CMakeCache.txt").read_text()
    kind = re.search(r"^CMAKE_BUILD_TYPE:\w+=(.*)$", cache, re.MULTILINE)
    return kind is not None and kind[1] in ("Release", "RelWithDebInfo", "MinSizeRel")


class Hardening(unittest.TestCase):
    def check(self, program):
        read = subprocess.run(["readelf", "-Whlds", program], capture_output=True, text=True, check=True,
                              env={**os.environ, "LC_ALL": "C"}).stdout
        for found, what in ((r"Type:\s+DYN", "position-independent code"), (r"GNU_RELRO", "relro"),
                            (r"FLAGS_1.*\bNOW\b|\bBIND_NOW\b", "no late binding"),
                            (r"__stack_chk_fail", "canaries on the stack"), (r"__\w+_chk\b", "checked copies")):
            self.assertRegex(read, found, what)

    def test_a_program_with_our_options_has_it(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "CMakeLists.txt").write_text(PROJECT.format(targets=SOURCE / "cmake/ClackersTargets.cmake"))
            (folder / "hardened.cpp").write_text(PROGRAM)
            for command in (["-S", folder, "-B", folder / "build", "-DCMAKE_BUILD_TYPE=Release",
                             f"-DCMAKE_CXX_COMPILER={os.environ['CXX']}"], ["--build", folder / "build"]):
                subprocess.run([os.environ["CMAKE"], *command], check=True, capture_output=True)
            self.check(folder / "build/hardened")

    def test_no_library_is_searched_for_in_the_current_folder(self):
        build = pathlib.Path(os.environ["CLACKERS_BUILD"])
        files = [build / "cli/clackers", *build.rglob("*.so*")]
        self.assertGreater(len(files), 1)
        for file in files:
            if not file.is_file() or file.read_bytes()[:4] != b"\x7fELF":
                continue
            read = subprocess.run(["readelf", "-Wd", file], capture_output=True, text=True, check=True,
                                  env={**os.environ, "LC_ALL": "C"}).stdout
            for path in re.findall(r"\((?:RPATH|RUNPATH)\).*\[(.*)\]", read):
                for folder in path.split(":"):
                    self.assertRegex(folder, r"\A(/|\$ORIGIN)", f"{file}: {path}")

    def test_the_command_has_it(self):
        build = os.environ["CLACKERS_BUILD"]
        if not is_for_use(build):
            self.skipTest("not a build for use")
        self.check(pathlib.Path(build) / "cli/clackers")


if __name__ == "__main__":
    unittest.main()
