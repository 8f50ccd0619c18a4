"""Recipes of package managers: they parse, and have the project's version; the action's script judges."""
import ast
import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
RECIPES = ROOT / "packaging"
PROGRAM = os.path.abspath(os.path.join(os.environ["CLACKERS_BUILD"], "cli", "clackers"))
VERSION = re.search(r"project\(clackers VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]


def recipe(name):
    return (RECIPES / name).read_text()


class Recipes(unittest.TestCase):
    def test_they_parse(self):
        ast.parse(recipe("spack/package.py"))
        self.assertEqual(json.loads(recipe("vcpkg/vcpkg.json"))["name"], "clackers")
        try:
            import yaml
        except ImportError:
            return
        self.assertEqual(yaml.safe_load(recipe("conda/meta.yaml"))["package"]["version"], VERSION)
        self.assertEqual(yaml.safe_load(recipe("action/action.yml"))["runs"]["using"], "composite")
        citation = yaml.safe_load((ROOT / "CITATION.cff").read_text())
        self.assertEqual(str(citation["version"]), VERSION)

    def test_portfile_is_cmake(self):
        stubs = "".join(f"function({name})\nendfunction()\n" for name in set(re.findall(r"^(vcpkg_\w+)", recipe("vcpkg/portfile.cmake"), re.M)))
        with tempfile.TemporaryDirectory() as folder:
            script = pathlib.Path(folder, "portfile.cmake")
            script.write_text(f"set(CURRENT_PACKAGES_DIR {folder})\n" + stubs + recipe("vcpkg/portfile.cmake"))
            subprocess.run([os.environ.get("CMAKE", "cmake"), "-P", script], check=True)

    def test_versions_are_the_projects(self):
        for name in ("conda/meta.yaml", "spack/package.py", "vcpkg/vcpkg.json", "vcpkg/portfile.cmake", "homebrew/clackers.rb"):
            self.assertEqual(set(re.findall(r"(?<![=@.\d])\d+\.\d+\.\d+(?=\.tar|\"|$)", recipe(name), re.M)), {VERSION}, name)


class BillOfMaterials(unittest.TestCase):
    def test_it_names_the_program_and_its_libraries(self):
        with tempfile.TemporaryDirectory() as parent:
            folder = pathlib.Path(parent, f"clackers-{VERSION}-linux-x86_64")
            (folder / "bin").mkdir(parents=True)
            (folder / "bin" / "clackers").write_text("abc")
            (folder / "share" / "doc" / "clackers").mkdir(parents=True)
            (folder / "share" / "doc" / "clackers" / "libraries.txt").write_text("libfmt9 9.1.0+ds1-2\nlibstdc++6 12.2.0-14\n")
            found = json.loads(subprocess.check_output([ROOT / "tools" / "sbom.py", folder]))
        self.assertEqual([(each["name"], each["versionInfo"]) for each in found["packages"]],
                         [("clackers", VERSION), ("libfmt9", "9.1.0+ds1-2"), ("libstdc++6", "12.2.0-14")])
        self.assertEqual(found["packages"][0]["checksums"][0]["checksumValue"],
                         "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad")
        known = {each["SPDXID"] for each in found["packages"]} | {found["SPDXID"]}
        self.assertEqual({each["relatedSpdxElement"] for each in found["relationships"]} - known, set())


class Action(unittest.TestCase):
    def judge(self, options, make=True):
        with tempfile.TemporaryDirectory() as folder:
            for h in (0.08, 0.04, 0.02, 0.01) if make else ():
                subprocess.run([PROGRAM, "respond", "stop", "--step", str(h), "--format", "csv", "--out", f"{folder}/h{h}.csv", "--quiet"], check=True)
            environment = {**os.environ, "CLACKERS": PROGRAM, "FILES": "h*.csv", "OPTIONS": options,
                           "GITHUB_STEP_SUMMARY": f"{folder}/summary.md", "GITHUB_OUTPUT": f"{folder}/output"}
            done = subprocess.run([RECIPES / "action" / "judge"], cwd=folder, env=environment, capture_output=True, text=True)
            files = {path.name: path.read_text() for path in pathlib.Path(folder).iterdir() if path.suffix != ".csv"}
            return done, files

    def test_agrees(self):
        done, files = self.judge("--case stop --expect exact")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertEqual(files["output"], "verdict=agrees\n")
        self.assertEqual(json.loads(files["badge.json"])["message"], "agrees")
        self.assertTrue(files["summary.md"].startswith("### Clackers: agrees\n"))
        self.assertIn("<testsuites", files["verdict.xml"])
        self.assertIn("<html", files["verdict.html"])

    def test_disagrees_and_errors_are_annotated(self):
        done, files = self.judge("--case stop --set eta=0.7 --expect exact")
        self.assertEqual((done.returncode, files["output"]), (1, "verdict=disagrees\n"))
        self.assertIn("::error title=Clackers::", done.stdout)
        done, files = self.judge("--case stpo")
        self.assertEqual((done.returncode, files["output"]), (2, "verdict=error\n"))
        self.assertIn('Did you mean "stop"?', done.stdout)


if __name__ == "__main__":
    unittest.main()
