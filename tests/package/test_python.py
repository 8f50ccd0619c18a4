"""The Python package in the installed tree."""
import os
import unittest

import installed

PYTHON = "/usr/bin/python3"


def setUpModule():
    global tree
    tree = installed.Tree()


def tearDownModule():
    tree.close()


class InstalledPackage(unittest.TestCase):
    def packages(self):
        return tree.prefix / "lib/python3/dist-packages"

    def python(self, program):
        # -s: no package of the user's own.
        return installed.run(PYTHON, "-s", "-B", "-c", program, cwd=tree.folder,
                             env={**os.environ, "PYTHONPATH": str(self.packages())})

    def test_package_is_imported_from_where_it_was_moved(self):
        path, version = self.python("import clackers\nprint(clackers.__file__, clackers.__version__, sep='\\n')").splitlines()
        self.assertEqual(path, str(self.packages() / "clackers/__init__.py"))
        self.assertIn(version, installed.run(tree.prefix / "bin/clackers", "--version"))

    def test_python_knows_its_version(self):
        text = self.python("import clackers, importlib.metadata as m\nprint(m.version('clackers') == clackers.__version__)")
        self.assertEqual(text.strip(), "True")

    def test_all_files_of_the_package_are_installed_and_no_others(self):
        source = installed.ROOT / "bindings/python/clackers"
        wanted = {p.name for p in source.iterdir() if p.suffix in {".py", ".pyi", ".typed"}}
        here = {p.name for p in (self.packages() / "clackers").iterdir()}
        self.assertEqual({name for name in here if not name.startswith("_core.cpython")}, wanted)
        self.assertEqual(len(here), len(wanted) + 1)


if __name__ == "__main__":
    unittest.main()
