"""Types: the package, a program that uses it and the stub of the extension module, by mypy."""
import pathlib
import subprocess
import sys
import tempfile
import textwrap
import unittest

import clackers

PACKAGE = pathlib.Path(clackers.__file__).parent
USER = pathlib.Path(__file__).with_name("typed_user.py")


def mypy(*arguments):
    return subprocess.run([sys.executable, "-m", *map(str, arguments)], capture_output=True, text=True, cwd=PACKAGE.parent)


class Types(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.strict = ["mypy", "--strict", f"--cache-dir={self.folder}"]

    def test_package_and_a_program_that_uses_it_are_accepted(self):
        done = mypy(*self.strict, "clackers", USER)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_wrong_uses_are_found(self):
        program = self.folder / "wrong.py"
        program.write_text(textwrap.dedent("""
            import clackers
            case = clackers.case("stop", eta=[0.5])
            case.response([0.0], side="middle")
            case.impacts(first="1")
            case.name = "other"
            clackers.catalogue("cases")[1.5]
        """))
        done = mypy(*self.strict, program)
        for line, code in ((3, "arg-type"), (4, "call-overload"), (5, "arg-type"), (6, "misc"), (7, "index")):
            self.assertRegex(done.stdout, rf"wrong\.py:{line}: error: .*\[{code}\]")

    def test_stub_states_what_the_extension_module_has(self):
        done = mypy("mypy.stubtest", "clackers._core", "--allowlist", self.allowed(), "--ignore-unused-allowlist")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def allowed(self):
        # Classes of pybind11 have a metaclass of their own and no signature of __init__.
        path = self.folder / "allowed"
        path.write_text("clackers\\._core\\.[A-Z][A-Za-z]*(\\.__init__)?\n")
        return path


if __name__ == "__main__":
    unittest.main()
