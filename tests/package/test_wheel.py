"""`pip wheel .` and `pip install .` without a network, and what is in the wheel."""
import base64
import csv
import hashlib
import io
import os
import pathlib
import platform
import shutil
import tempfile
import unittest
import zipfile

import installed

PYTHON = "/usr/bin/python3"
# No index and no settings of the user: whoever wants to download fails.
OFFLINE = {**os.environ, "PIP_NO_INDEX": "1", "PIP_CONFIG_FILE": os.devnull, "PIP_DISABLE_PIP_VERSION_CHECK": "1",
           "PYTHONDONTWRITEBYTECODE": "1", "PYTHONNOUSERSITE": "1",
           # What is tested here does not depend on optimization, which is most of the time of a build. Clang then takes
           # half of GCC's time.
           "CC": "clang-14", "CXX": "clang++-14", "CXXFLAGS": "-O0"}
FIVE_LINES = """
import clackers
case = clackers.case("three-parameter", N=2, xi1=0.05)
u, v, a = case.response([0.0, 10.0, 20.0])
assert u.shape == (3, 2) and len(case.impacts()) == 6
print(clackers.__file__)
"""


def setUpModule():
    global folder, wheel
    folder = pathlib.Path(tempfile.mkdtemp(prefix="clackers-wheel-"))
    installed.run(PYTHON, "-m", "pip", "wheel", ".", "--wheel-dir", folder / "made", "--no-deps", cwd=installed.ROOT, env=OFFLINE)
    (wheel,) = (folder / "made").iterdir()


def tearDownModule():
    shutil.rmtree(folder)


def files():
    with zipfile.ZipFile(wheel) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


class Wheel(unittest.TestCase):
    def test_name_states_version_and_python(self):
        version = installed.run(installed.BUILD / "cli/clackers", "--version").split()[1]
        self.assertEqual(wheel.name, f"clackers-{version}-cp311-cp311-linux_{platform.machine()}.whl")

    def test_it_holds_the_package_and_nothing_else(self):
        names = {name for name in files() if not name.startswith("clackers-")}
        source = {f"clackers/{p.name}" for p in (installed.ROOT / "bindings/python/clackers").iterdir()
                  if p.suffix in {".py", ".pyi", ".typed"}}
        self.assertEqual({name for name in names if "_core.cpython" not in name}, source)
        self.assertEqual(len(names), len(source) + 1)

    def test_no_file_names_the_machine_that_built_it(self):
        words = [str(installed.ROOT), str(installed.BUILD), str(pathlib.Path.home()) + "/", tempfile.gettempdir() + "/"]
        words += [platform.node()] if len(platform.node()) > 5 else []
        for name, content in files().items():
            for word in words:
                self.assertNotIn(word.encode(), content, f"{name} holds {word}")

    def test_module_is_stripped_and_looks_for_libraries_nowhere_else(self):
        (module,) = (content for name, content in files().items() if "_core.cpython" in name)
        path = folder / "_core.so"
        path.write_bytes(module)
        sections = installed.run("readelf", "-SdW", path)
        self.assertNotRegex(sections, r"\.symtab|\.debug_|RUNPATH|RPATH")
        exported = [line.split()[-1] for line in installed.run("nm", "-D", "--defined-only", path).splitlines()]
        self.assertEqual(exported, ["PyInit__core"])

    def test_record_states_the_files(self):
        here = files()
        (record,) = (content.decode() for name, content in here.items() if name.endswith("/RECORD"))
        rows = {name: (digest, size) for name, digest, size in csv.reader(io.StringIO(record))}
        self.assertEqual(set(rows), set(here))
        for name, (digest, size) in rows.items():
            if name.endswith("/RECORD"):
                continue
            found = base64.urlsafe_b64encode(hashlib.sha256(here[name]).digest()).rstrip(b"=").decode()
            self.assertEqual((digest, size), (f"sha256={found}", str(len(here[name]))), name)

    def test_metadata_needs_numpy_only(self):
        (metadata,) = (content.decode() for name, content in files().items() if name.endswith("/METADATA"))
        needed = [line for line in metadata.splitlines() if line.startswith("Requires-Dist") and "extra" not in line]
        self.assertEqual(needed, ["Requires-Dist: numpy (>=1.24)"])
        self.assertIn("Requires-Python: >=3.11", metadata)

    def test_source_tree_is_left_as_it_was(self):
        listed = installed.run("git", "-c", "safe.directory=*", "status", "--short", "--untracked-files=all", cwd=installed.ROOT)
        self.assertNotRegex(listed, r"egg-info|\.so$|__pycache__")


class Environment(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.venv = folder / "venv"
        installed.run(PYTHON, "-m", "venv", "--system-site-packages", cls.venv)
        installed.run(cls.venv / "bin/pip", "install", ".", cwd=installed.ROOT, env=OFFLINE)

    def test_pip_installs_into_an_environment(self):
        text = installed.run(self.venv / "bin/python", "-c", FIVE_LINES, cwd=folder, env=OFFLINE)
        self.assertTrue(text.startswith(str(self.venv)), text)

    def test_type_checkers_find_the_types(self):
        program = folder / "program.py"
        program.write_text(FIVE_LINES + "count: str = case.dof\n")
        done = installed.subprocess.run([self.venv / "bin/python", "-m", "mypy", "--strict", f"--cache-dir={folder / 'mypy'}", program],
                                        capture_output=True, text=True, env=OFFLINE)
        self.assertIn('expression has type "int", variable has type "str"', done.stdout + done.stderr)
        self.assertIn("Found 1 error in 1 file", done.stdout)

    def test_pip_removes_it(self):
        other = folder / "other"
        shutil.copytree(self.venv, other, symlinks=True)
        installed.run(other / "bin/python", "-m", "pip", "uninstall", "--yes", "clackers", env=OFFLINE)
        self.assertEqual(list(other.glob("lib/python3.11/site-packages/clackers*")), [])


if __name__ == "__main__":
    unittest.main()
