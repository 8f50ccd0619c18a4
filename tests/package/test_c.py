"""The C library as a program in C finds it."""
import re
import unittest

import installed

HEADER = installed.ROOT / "bindings/c/clackers.h"
STRICT = ["-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror"]


def setUpModule():
    global tree
    tree = installed.Tree()


def tearDownModule():
    tree.close()


def declared():
    return sorted(re.findall(r"(\bclackers_\w+)\(", "".join(re.findall(r"^CLACKERS_API[^;]*;", HEADER.read_text(), re.MULTILINE))))


def flags(options):
    """What pkg-config prints; the shell reads quoted blanks."""
    text = installed.run("sh", "-c", f'eval "set -- $(pkg-config {options} clackers)"; printf "%s\\n" "$@"',
                         env=tree.environment())
    return list(filter(None, text.split("\n")))


class CLibrary(unittest.TestCase):
    def check(self, text):
        lines = text.splitlines()
        self.assertRegex(lines[0], r"^Clackers \d+\.\d+\.\d+$")
        # X = 5, xi1 = 0.05: t_k = (k - 1/2) pi / sqrt(1 - xi1^2), six of them before 20 s.
        self.assertEqual(len(lines), 7)
        for k, line in enumerate(lines[1:], 1):
            t = (k - 0.5) * 3.141592653589793 / 0.9987492177719089
            found = re.match(rf"{k}  t = (\S+) s  v1 = (\S+) -> (\S+) m/s  v2 = (\S+) -> (\S+) m/s$", line)
            self.assertTrue(found, line)
            self.assertAlmostEqual(float(found[1]), t, delta=1e-13)  # printed to 17 digits, t rounded thrice here
            before, after = float(found[2]) - float(found[4]), float(found[3]) - float(found[5])
            self.assertLess(before, 0.0)
            self.assertAlmostEqual(after, -0.75 * before, delta=2e-6)  # four numbers printed to 0.5e-6

    def test_example_is_built_with_pkg_config(self):
        environment = tree.environment()
        program = tree.folder / "impacts"
        installed.run(installed.CC, *STRICT, installed.ROOT / "examples/c/impacts.c", *flags("--cflags --libs"), "-o", program)
        self.check(installed.run(program, env=environment))

    def test_example_is_built_with_cmake(self):
        source = tree.folder / "with_cmake"
        source.mkdir()
        (source / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.25)\nproject(it LANGUAGES C)\n"
            "find_package(clackers 0.1 REQUIRED COMPONENTS c)\n"
            f"add_executable(impacts {installed.ROOT}/examples/c/impacts.c)\n"
            "target_link_libraries(impacts PRIVATE clackers::c)\n")
        build = tree.configure(source, "with_cmake_build")
        installed.run(installed.CMAKE, "--build", build)
        self.check(installed.run(build / "impacts"))

    def test_pkg_config_has_the_version_of_the_command(self):
        version = installed.run("pkg-config", "--modversion", "clackers", env=tree.environment()).strip()
        self.assertIn(version, installed.run(tree.prefix / "bin/clackers", "--version"))

    def test_library_has_a_soname(self):
        self.assertIn("Library soname: [libclackers.so.0]", installed.run("readelf", "-d", tree.lib / "libclackers.so"))

    def test_exported_functions_are_those_of_the_header_with_their_version(self):
        exported = re.findall(r" T (\S+)$", installed.run("nm", "-D", "--defined-only", tree.lib / "libclackers.so"), re.MULTILINE)
        self.assertGreater(len(exported), 15)
        later = dict.fromkeys(("clackers_case_create_with_words", "clackers_motion_force_count", "clackers_motion_forces"), "0.2")
        self.assertEqual(sorted(exported), [f"{name}@@CLACKERS_{later.get(name, '0.1')}" for name in declared()])

    def test_only_functions_are_exported(self):
        kinds = set(re.findall(r" (\w) \S+$", installed.run("nm", "-D", "--defined-only", tree.lib / "libclackers.so"), re.MULTILINE))
        self.assertLessEqual(kinds, {"T", "A"})

    def test_header_is_c99_and_cxx98(self):
        for language in (["-x", "c", "-std=c99"], ["-x", "c++", "-std=c++98", "-Wno-long-long"]):
            for header in ("clackers.h", "clackers_main.h"):
                installed.run(installed.CC, "-Wall", "-Wextra", "-pedantic", "-Werror", "-fsyntax-only", *language,
                              tree.prefix / "include" / header)

    def test_step_function_is_built_with_pkg_config(self):
        program = tree.folder / "newmark"
        installed.run(installed.CC, *STRICT, *flags("--cflags"), installed.ROOT / "examples/step_functions/newmark.c", "-lm",
                      "-o", program)
        installed.run(tree.prefix / "bin/clackers", "verify", "--exec", f"{program} {{case:text}} {{n}} {{out}}", "--expect",
                      "proper:2", "--case", "stop", "--set", "t_end=8", "--samples-per-level", "1", "--work", tree.folder / "work")


if __name__ == "__main__":
    unittest.main()
