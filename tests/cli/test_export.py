"""clackers export: the list of formats, folders, scripts whose languages can be parsed here, refusals."""
import ast
import os
import pathlib
import shutil
import subprocess
import unittest
from xml.etree import ElementTree

from command import PROGRAM, CommandTest, rows


class Export(CommandTest):
    def export(self, *words, to):
        self.good("export", *words, "--to", to, "--out", self.path(to), "--quiet")
        return pathlib.Path(self.path(to))

    def test_list_names_every_format(self):
        found = {row["format"]: row for row in rows(self.good("export", "--list", "--format", "csv"))}
        self.assertIn("octave", found["octave"]["run"])
        self.assertEqual(found["julia"]["run"], "no")

    def test_writes_a_model_and_a_script(self):
        folder = self.export("stop", "--set", "eta=0.7", to="scipy")
        self.assertEqual(sorted(os.listdir(folder)), ["model.py", "run"])
        self.assertTrue(os.access(folder / "run", os.X_OK))
        self.assertIn(" check stop --set eta=0.7 ", (folder / "run").read_text().splitlines()[-1])
        ast.parse((folder / "model.py").read_text())

    def test_run_is_a_script_of_every_format(self):
        for row in rows(self.good("export", "--list", "--format", "csv")):
            if row["contact"].startswith("no model"):
                self.refused("export", "--to", row["format"], "--out", self.path("none"), says=row["contact"], code="no-deck")
                continue
            folder = self.export(to=row["format"])
            done = subprocess.run(["sh", "-n", folder / "run"], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""), row["format"])

    def test_models_parse_in_their_language(self):
        ast.parse((self.export(to="opensees-python") / "model.py").read_text())
        model = (self.export("base-excited-pair", to="opensees-tcl") / "model.tcl").read_text()
        self.assertEqual(model.count("{"), model.count("}"))
        if shutil.which("tclsh"):
            # The commands of OpenSees as procedures that do nothing: the script runs to its end.
            script = ('proc load {args} {return 0}\n'
                      'proc unknown {args} {if {[lindex $args 0] eq "pattern"} {uplevel 1 [lindex $args end]}; return 0}\n'
                      f"set argv {{0.1 {self.path('out.csv')}}}\n")
            done = subprocess.run(["tclsh"], input=script + model, capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertEqual(len(self.text_of("out.csv").splitlines()), 202)

        ast.parse((self.export("base-excited-pair", to="code-aster") / "model.comm").read_text())
        model = (self.export("buildings", to="mbdyn") / "model.mbd").read_text()
        begun, ended = ([line[len(word):] for line in model.splitlines() if line.startswith(word)] for word in ("begin", "end"))
        self.assertEqual(begun, ended)
        for kind in ("body", "joint", "structural"):
            count = len([line for line in model.splitlines() if line.startswith(f"  {kind}: ") and "node;" not in line[:20]])
            names = {"body": "rigid bodies", "joint": "joints", "structural": "structural nodes"}
            self.assertIn(f"  {names[kind]}: {count};", model)

    def test_units_keep_the_rules_of_the_standard(self):
        for version, case in ((2, "three-parameter"), (3, "three-parameter"), (2, "sdof"), (3, "sdof")):
            with self.subTest(version=version, case=case):
                root = ElementTree.parse(self.export(case, to=f"fmu{version}") / "modelDescription.xml").getroot()
                self.assertEqual((root.tag, root.get("fmiVersion")), ("fmiModelDescription", f"{version}.0"))
                self.assertTrue(root.get("guid" if version == 2 else "instantiationToken"))
                self.assertEqual([child.tag for child in root], ["ModelExchange", "CoSimulation", "UnitDefinitions", "DefaultExperiment",
                                                                 "ModelVariables", "ModelStructure"])
                variables = list(root.find("ModelVariables"))
                references = [variable.get("valueReference") for variable in variables]
                names = [variable.get("name") for variable in variables]
                self.assertEqual((len(set(references)), len(set(names))), (len(variables), len(variables)))
                units = {unit.get("name") for unit in root.iter("Unit")}
                number = {variable.get("name"): variable.find("Real") if version == 2 else variable for variable in variables}
                derivatives = []
                for variable in variables:
                    kind = variable.get("causality"), variable.get("variability"), variable.get("initial")
                    real = number[variable.get("name")]
                    self.assertIn(kind, {("independent", "continuous", None), ("output", "continuous", "exact"), ("local", "continuous", "calculated")})
                    self.assertEqual(real.get("start") is not None, kind[2] == "exact")
                    self.assertIn(real.get("unit"), units)
                    if real.get("derivative"):
                        # FMI 2 counts variables from 1, FMI 3 names value references.
                        at = int(real.get("derivative")) - 1 if version == 2 else references.index(real.get("derivative"))
                        self.assertEqual(variable.get("name"), f"der({names[at]})")
                        derivatives.append(variable.get("name"))
                structure = root.find("ModelStructure")

                def named(old, new):
                    if version == 2:
                        return [names[int(each.get("index")) - 1] for each in structure.find(old)]
                    return [names[references.index(each.get("valueReference"))] for each in structure.findall(new)]

                self.assertEqual(named("Outputs", "Output"), [name for name in names if name[0] in "uv"])
                self.assertEqual(named("Derivatives", "ContinuousStateDerivative"), derivatives)
                self.assertEqual(named("InitialUnknowns", "InitialUnknown"), derivatives)
                gaps = [name for name in names if name.startswith("gap")]
                self.assertEqual(root.get("numberOfEventIndicators") if version == 2 else str(len(named("", "EventIndicator"))), str(len(gaps)))
        self.refused("export", "penalized-pair", "--to", "fmu2", "--out", self.path("never"), says="one linear motion", code="no-deck")

    def test_a_problem_of_ones_own_goes_along(self):
        problem = self.path("frame.json")
        with open(problem, "w") as file:
            file.write(self.good("show", "piecewise", "--format", "json"))
        folder = self.export("--problem", problem, to="r")
        self.assertIn("--problem problem.json", (folder / "run").read_text())
        self.good("show", "--problem", str(folder / "problem.json"))

    def test_replaces_its_own_folder_only(self):
        folder = self.export("stop", to="scipy")
        self.export("sdof", to="scipy")
        (folder / "mine.txt").write_text("")
        self.refused("export", "stop", "--to", "scipy", "--out", str(folder), says="mine.txt", code="foreign-folder")

    def test_refusals(self):
        out = ("--out", self.path("out"))
        full = subprocess.run(["sh", "-c", 'trap "" XFSZ; ulimit -f 0; exec "$0" "$@"', PROGRAM, "export", "stop", "--to", "scipy",
                               "--out", self.path("full")], capture_output=True, text=True)
        self.assertEqual(full.returncode, 4)
        self.assertRegex(full.stderr, r"cannot write .*/full/[^/]*: File too large")
        self.refused("export", "stop", "--to", "scypi", *out, says='"scipy"', code="unknown-name")
        self.refused("export", "stop", *out, says="--to", code="bad-syntax")
        self.refused("export", "assembly", "--to", "mujoco", *out, says="mass matrix", code="no-deck")
        self.assertFalse(os.path.exists(self.path("out")))


if __name__ == "__main__":
    unittest.main()
