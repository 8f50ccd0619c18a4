"""The Debian packages: made from the built tree, installed, used and removed.

dpkg works on a copy of this machine's list of packages and unpacks into a temporary folder, so that
dependencies are checked against what is really installed while the machine stays as it is. The
packages' own scripts meet an ldconfig that only notes its calls.
"""
import os
import pathlib
import re
import shutil
import tempfile
import unittest

import installed

ADMIN = pathlib.Path("/var/lib/dpkg")


def why_not():
    """What keeps these tests from running here, or nothing."""
    for tool in ["dpkg", "dpkg-shlibdeps", "file"]:
        if not shutil.which(tool):
            return f"there is no {tool} (packages dpkg-dev and file)"
    if os.geteuid() != 0:
        return "dpkg installs for root only"
    if not (ADMIN / "status").exists():
        return f"{ADMIN} holds no list of packages"
    return None


def setUpModule():
    global folder, debs
    if why_not():
        raise unittest.SkipTest(why_not())
    folder = pathlib.Path(tempfile.mkdtemp(prefix="clackers-debian-"))
    cpack = pathlib.Path(installed.CMAKE).with_name("cpack")
    # A stand-in for the manual, which takes minutes to build.
    (folder / "manual/_static").mkdir(parents=True)
    (folder / "manual/index.html").write_text("<title>Clackers</title>")
    (folder / "manual/_static/style.css").write_text("")
    installed.run(cpack, "-G", "DEB", "--config", installed.BUILD / "CPackConfig.cmake", "-B", folder / "made",
                  env={**os.environ, "CLACKERS_MANUAL": str(folder / "manual")})
    debs = {p.name.split("_")[0]: p for p in (folder / "made").glob("*.deb")}


def tearDownModule():
    shutil.rmtree(folder)


def has_python():
    """Whether the build holds the package for Python, which it does where pybind11 is there."""
    return "CLACKERS_PYTHON:BOOL=ON" in (installed.BUILD / "CMakeCache.txt").read_text()


def field(package, name):
    return installed.run("dpkg-deb", "-f", debs[package], name).strip()


class Packages(unittest.TestCase):
    def test_packages_are_made(self):
        self.assertEqual(sorted(debs), ["clackers", "clackers-doc", "libclackers-dev", "libclackers0", *["python3-clackers"] * has_python()])

    def test_python_package_depends_on_its_python_and_is_not_in_the_others(self):
        if not has_python():
            self.skipTest("built without Python")
        depends = field("python3-clackers", "Depends")
        for wanted in [r"\bpython3 \(>= 3\.11\)", r"\bpython3 \(<< 3\.12\)", r"\bpython3-numpy\b", r"\blibc6 \(>= ", r"\blibfmt\d+ \(>= "]:
            self.assertRegex(depends, wanted)
        for package, deb in debs.items():
            contents = installed.run("dpkg-deb", "-c", deb)
            self.assertEqual("dist-packages/clackers/_core.cpython-311" in contents, package == "python3-clackers")
            self.assertNotIn("__pycache__", contents)

    def test_manual_is_a_package_for_every_machine(self):
        self.assertEqual(field("clackers-doc", "Architecture"), "all")
        self.assertEqual(field("clackers", "Suggests"), "clackers-doc, libnetcdf19, libopenmpi3")
        contents = installed.run("dpkg-deb", "-c", debs["clackers-doc"])
        for name in ["html/index.html", "html/_static/style.css", "copyright"]:
            self.assertIn(f"./usr/share/doc/clackers-doc/{name}\n", contents)

    def test_packages_depend_on_the_libraries_they_load(self):
        for package, file in [("clackers", "usr/bin/clackers"), ("libclackers0", "libclackers.so.0")]:
            self.assertRegex(field(package, "Depends"), r"\blibc6 \(>= ")
            self.assertRegex(field(package, "Depends"), r"\blibfmt\d+ \(>= ")
            self.assertIn(file, installed.run("dpkg-deb", "-c", debs[package]))

    def test_development_package_depends_on_its_library_and_on_what_modules_include(self):
        depends = field("libclackers-dev", "Depends")
        self.assertIn(f"libclackers0 (= {field('libclackers0', 'Version')})", depends)
        for name in ["libeigen3-dev", "libfmt-dev", "nlohmann-json3-dev", "libboost-dev", "libhwy-dev",
                     "libsqlite3-dev", "libtomlplusplus-dev"]:
            self.assertIn(name, depends)

    def test_library_package_has_shlibs(self):
        control = folder / "control"
        installed.run("dpkg-deb", "-e", debs["libclackers0"], control)
        version = re.escape(field("libclackers0", "Version"))
        self.assertRegex((control / "shlibs").read_text(), rf"^libclackers 0 libclackers0 \(>= {version}\)")

    def test_command_package_has_no_development_files(self):
        contents = installed.run("dpkg-deb", "-c", debs["clackers"]) + installed.run("dpkg-deb", "-c", debs["libclackers0"])
        self.assertNotRegex(contents, r"\.hpp|\.a\b|\.cmake|libclackers\.so ")

    def test_files_belong_to_root_and_are_below_usr(self):
        for deb in debs.values():
            for line in installed.run("dpkg-deb", "-c", deb).splitlines():
                self.assertRegex(line, r"^\S+ root/root .* \./(usr/.*)?", line)


class InstalledUsedAndRemoved(unittest.TestCase):
    def dpkg(self, root, *arguments):
        path = f"{folder / 'bin'}:/usr/sbin:/usr/bin:/sbin:/bin"
        return installed.run("dpkg", f"--root={root}", "--force-script-chrootless", "--no-triggers",
                             f"--log={folder / 'log'}", *arguments, env={**os.environ, "PATH": path})

    def note_calls(self):
        """A file that gets a line at each call of what the packages' scripts run."""
        calls = folder / "calls"
        calls.touch()
        (folder / "bin").mkdir()
        for name in ["ldconfig", "py3compile", "py3clean"]:
            (folder / "bin" / name).write_text(f'#!/bin/sh\necho {name} "$@" >> {calls}\n')
            (folder / "bin" / name).chmod(0o755)
        return calls

    def test_packages_are_installed_used_and_removed(self):
        root = folder / "root"
        admin = root / "var/lib/dpkg"
        admin.parent.mkdir(parents=True)
        shutil.copytree(ADMIN, admin, symlinks=True)
        calls = self.note_calls()
        before = (ADMIN / "status").read_bytes()

        self.dpkg(root, "-i", *debs.values())
        listed = installed.run("dpkg-query", f"--admindir={admin}", "-W", "-f=${Package} ${db:Status-Status}\n", *debs)
        self.assertEqual(sorted(listed.split()), sorted([*debs, *["installed"] * len(debs)]))
        compiled = ["py3compile -p python3-clackers"] * has_python()
        self.assertEqual(sorted(calls.read_text().splitlines()), ["ldconfig", *compiled])

        self.use(root)

        self.dpkg(root, "-r", *debs)
        removed = ["py3clean -p python3-clackers"] * has_python()
        self.assertEqual(sorted(calls.read_text().splitlines()), ["ldconfig", "ldconfig", *removed, *compiled])
        self.assertEqual([p for p in root.rglob("*") if not p.is_dir() and admin not in p.parents], [])
        self.assertEqual((ADMIN / "status").read_bytes(), before)

    def use(self, root):
        version = installed.run(root / "usr/bin/clackers", "--version")
        self.assertIn(field("clackers", "Version").split("-")[0], version)
        rows = installed.run(root / "usr/bin/clackers", "respond", "three-parameter", "--impacts", "--format", "csv")
        self.assertEqual(len(re.findall(r"^\d", rows, re.MULTILINE)), 6)

        lib = next(root.glob("usr/lib/**/libclackers.so")).parent
        environment = {**os.environ, "PKG_CONFIG_PATH": str(lib / "pkgconfig"), "LD_LIBRARY_PATH": str(lib)}
        flags = installed.run("pkg-config", "--cflags", "--libs", "clackers", env=environment).split()
        installed.run(installed.CC, installed.ROOT / "examples/c/impacts.c", *flags, "-o", folder / "impacts")
        self.assertEqual(len(installed.run(folder / "impacts", env=environment).splitlines()), 7)
        if has_python():
            self.use_python(root / "usr/lib/python3/dist-packages")

    def use_python(self, packages):
        text = installed.run("/usr/bin/python3", "-B", "-c", "import clackers, importlib.metadata as m\n"
                             "print(clackers.__file__, m.version('clackers'), len(clackers.case().impacts()))",
                             cwd=folder, env={**os.environ, "PYTHONPATH": str(packages)})
        version = field("python3-clackers", "Version").split("-")[0]
        self.assertEqual(text.split(), [str(packages / "clackers/__init__.py"), version, "6"])


if __name__ == "__main__":
    unittest.main()
