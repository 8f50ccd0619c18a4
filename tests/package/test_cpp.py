"""The C++ modules as a program finds them through CMake."""
import re
import unittest

import installed


def setUpModule():
    global tree
    tree = installed.Tree()


def tearDownModule():
    tree.close()


class Modules(unittest.TestCase):
    def test_example_is_built_and_finds_second_order(self):
        build = tree.configure(installed.ROOT / "examples/cpp", "cpp", f"-DCMAKE_CXX_COMPILER={installed.CXX}")
        installed.run(installed.CMAKE, "--build", build)
        text = installed.run(build / "newmark_error")
        errors = [float(e) for e in re.findall(r"largest error of u1 = (\S+) m", text)]
        self.assertEqual(len(errors), 3, text)
        # Newmark with located impacts claims order 2: half the step, a quarter of the error. 10 % of
        # the order is what the project's style allows through impacts: 2^1.8 = 3.5 to 2^2.2 = 4.6.
        for coarse, fine in zip(errors, errors[1:]):
            self.assertGreater(coarse / fine, 3.5)
            self.assertLess(coarse / fine, 4.6)

    def test_every_module_is_a_target_with_a_library(self):
        source = tree.folder / "modules"
        source.mkdir()
        modules = re.findall(r"^clackers_module\((\w+)", (installed.ROOT / "CMakeLists.txt").read_text(), re.MULTILINE)
        self.assertGreater(len(modules), 8)
        (source / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.25)\nproject(it LANGUAGES CXX)\nfind_package(clackers REQUIRED)\n"
            + "".join(f"if(NOT TARGET clackers::{module})\n  message(FATAL_ERROR {module})\nendif()\n"
                      for module in modules + ["clackers", "c"]))
        tree.configure(source, "modules_build")


if __name__ == "__main__":
    unittest.main()
