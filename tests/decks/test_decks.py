"""Models of clackers export, run by their programs: each script must end with the verdict that it claims."""
import os
import shutil
import subprocess
import sys
import unittest
import zipfile

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "cli"))
from command import PROGRAM, CommandTest  # noqa: E402

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "peers"))
import calculix  # noqa: E402


def works(*command, source=""):
    """Whether a command is there and ends well."""
    try:
        return subprocess.run(command, input=source, capture_output=True, text=True).returncode == 0
    except OSError:
        return False


def python_with_scipy():
    return next((python for python in (sys.executable, "/usr/bin/python3") if works(python, "-c", "import scipy.integrate")), "")


def has_header(name):
    return works(os.environ.get("CC", "cc"), "-E", "-xc", "-", source=f"#include <{name}>\n")


class Deck(CommandTest):
    def agrees(self, to, *words, run=()):
        self.good("export", *words, "--to", to, "--out", self.path(to), "--quiet")
        environment = {**os.environ, "CLACKERS": PROGRAM, "PYTHON": python_with_scipy() or "python3"}
        done = subprocess.run([os.path.join(self.path(to), "run"), *run], capture_output=True, text=True, env=environment)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertTrue(done.stdout.startswith("Agrees: "), done.stdout + done.stderr)
        shutil.rmtree(self.path(to))


class Missing(Deck):
    def test_a_missing_program_is_named(self):
        self.good("export", "stop", "--to", "scipy", "--out", self.path("scipy"), "--quiet")
        done = subprocess.run([self.path("scipy/run")], capture_output=True, text=True, env={**os.environ, "PYTHON": "/bin/false"})
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("apt-get install python3-scipy", done.stderr)


@unittest.skipUnless(python_with_scipy(), "needs python3-scipy")
class Scipy(Deck):
    def test_pair_loads_and_springs(self):
        self.agrees("scipy", "synchronized-pair", "--set", "eta=0.7")
        self.agrees("scipy", "forced-pair")
        self.agrees("scipy", "penalized-pair")


@unittest.skipUnless(has_header("dlfcn.h") and shutil.which("zip"), "needs gcc and zip")
class Fmu(Deck):
    def test_units_are_exact_and_exchange_their_equations(self):
        for to in ("fmu2", "fmu3"):
            with self.subTest(to):
                self.agrees(to, "forced-pair")
                self.agrees(to, "buildings")
                self.agrees(to, "stop", "--set", "eta=0.7", run=["me"])

    def test_units_of_a_method_have_its_order(self):
        self.agrees("fmu2", "buildings", "--method", "rk4")
        self.agrees("fmu3", "forced-pair", "--method", "rk3")

    def test_the_unit_has_its_binary_and_sources(self):
        for to, platform in (("fmu2", "linux64"), ("fmu3", f"{os.uname().machine}-linux")):
            self.good("export", "sdof", "--to", to, "--out", self.path(to), "--quiet")
            subprocess.run([self.path(to) + "/run"], capture_output=True, env={**os.environ, "CLACKERS": PROGRAM}, check=True)
            names = zipfile.ZipFile(self.path(to) + "/Model.fmu").namelist()
            for name in ("modelDescription.xml", "sources/model.c", f"binaries/{platform}/Model.so"):
                self.assertIn(name, names)


@unittest.skipUnless(shutil.which("octave-cli"), "needs octave")
class Octave(Deck):
    def test_stop_and_no_contact(self):
        self.agrees("octave", "stop", "--set", "eta=0.7")
        self.agrees("octave", "sdof", "--set", "t_end=5")


@unittest.skipUnless(works("Rscript", "-e", "library(deSolve)"), "needs r-cran-desolve")
class R(Deck):
    def test_buildings_and_no_contact(self):
        self.agrees("r", "buildings")
        self.agrees("r", "sdof")


@unittest.skipUnless(has_header("cvode/cvode.h"), "needs libsundials-dev")
class Cvode(Deck):
    def test_every_kind_of_problem(self):
        for words in (["three-parameter"], ["sdof"], ["buildings"], ["assembly"], ["cradle"], ["forced-pair"], ["penalized-pair"],
                      ["stop", "--set", "eta=0.7"]):
            with self.subTest(words=words):
                self.agrees("cvode", *words)

    def test_a_problem_of_ones_own(self):
        with open(self.path("frame.json"), "w") as file:
            file.write(self.good("show", "piecewise", "--format", "json"))
        self.agrees("cvode", "--problem", self.path("frame.json"))


@unittest.skipUnless(shutil.which("ccx"), "needs calculix-ccx")
class Calculix(Deck):
    @classmethod
    def setUpClass(cls):
        calculix.on_one_processor()

    def test_contact_and_none(self):
        self.agrees("calculix", "stop")
        self.agrees("calculix", "sdof", "--set", "t_end=8")

    def test_a_bar_that_strikes_a_wall(self):
        self.agrees("calculix", "bar-wall", "--set", "elements=4")


@unittest.skipUnless(has_header("mujoco/mujoco.h"), "needs libmujoco-dev")
class Mujoco(Deck):
    def test_contacts_and_none(self):
        self.agrees("mujoco", "stop", "--set", "eta=0.7")
        self.agrees("mujoco", "sdof")
        self.agrees("mujoco", "forced-pair", "--set", "t_end=20")


if __name__ == "__main__":
    unittest.main()
