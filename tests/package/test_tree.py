"""What is installed, and what must not be."""
import re
import subprocess
import unittest

import installed

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"](clackers/[^>"]+)[>"]', re.MULTILINE)


def setUpModule():
    global tree
    tree = installed.Tree()


def tearDownModule():
    tree.close()


class InstalledTree(unittest.TestCase):
    def headers(self, pattern="*.hpp"):
        return {str(p.relative_to(tree.prefix / "include")) for p in (tree.prefix / "include").rglob(pattern)}

    def test_command_runs(self):
        text = installed.run(tree.prefix / "bin/clackers", "--version")
        self.assertRegex(text, r"\d+\.\d+\.\d+")

    def test_included_headers_are_installed(self):
        here = self.headers("*.h*")
        self.assertGreater(len(here), 40)
        for header in sorted(here):
            text = (tree.prefix / "include" / header).read_text()
            for wanted in INCLUDE.findall(text):
                self.assertIn(wanted, here, f"{header} includes it")

    def test_headers_of_tests_are_not_installed(self):
        sources = [p for folder in ["clackers", "cli", "bindings"] for p in (installed.ROOT / folder).rglob("*.[ch]pp")
                   if not p.name.endswith("_test.cpp")]
        wanted = {w for p in sources for w in INCLUDE.findall(p.read_text())}
        # A header whose own source stands beside it is there for users, included by others or not.
        own = {h for h in self.headers() if (installed.ROOT / h).with_suffix(".cpp").exists()}
        self.assertEqual(sorted(self.headers() - wanted - own), [])

    def test_headers_include_no_test_library(self):
        for header in sorted(self.headers()):
            self.assertNotRegex((tree.prefix / "include" / header).read_text(), "gtest|rapidcheck", header)

    def test_files_do_not_name_the_build_tree(self):
        for path in tree.prefix.rglob("*"):
            if path.suffix in {".cmake", ".pc", ".h", ".hpp"}:
                for folder in [installed.ROOT, installed.BUILD, tree.folder / "first"]:
                    self.assertNotIn(str(folder), path.read_text(), path)

    def test_targets_have_no_warning_flags(self):
        for path in tree.prefix.rglob("*.cmake"):
            self.assertNotRegex(path.read_text(), "-Werror|-Wall|-fsanitize", path)

    def test_license_is_installed(self):
        found = sorted(p.parent.name for p in tree.prefix.rglob("copyright"))
        python = ["python3-clackers"] if list(tree.prefix.rglob("clackers/_core.*.so")) else []
        self.assertEqual(found, ["clackers", "clackers-doc", "libclackers-dev", "libclackers0", *python])


class FindPackage(unittest.TestCase):
    def configure(self, name, line, language="C"):
        source = tree.folder / name
        source.mkdir()
        (source / "CMakeLists.txt").write_text(
            f"cmake_minimum_required(VERSION 3.25)\nproject(it LANGUAGES {language})\n{line}\n")
        return subprocess.run([installed.CMAKE, "-S", source, "-B", source / "build",
                               f"-DCMAKE_PREFIX_PATH={tree.prefix}"], capture_output=True, text=True)

    def test_newer_version_is_not_found(self):
        done = self.configure("newer", "find_package(clackers 99.0 REQUIRED COMPONENTS c)")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("99.0", done.stderr)

    def test_unknown_component_is_not_found(self):
        done = self.configure("unknown", "find_package(clackers REQUIRED COMPONENTS fortran)")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn('has no component "fortran"; there are c and cpp.', " ".join(done.stderr.split()))

    def test_c_library_needs_neither_cxx_nor_its_libraries(self):
        done = self.configure("only_c", "find_package(clackers REQUIRED COMPONENTS c)\n"
                              "if(NOT TARGET clackers::c OR TARGET clackers::clackers OR Eigen3_FOUND)\n"
                              "  message(FATAL_ERROR \"not the C library alone\")\nendif()")
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
