"""clackers export: the list of formats, folders, scripts whose languages can be parsed here, refusals."""
import ast
import os
import pathlib
import shutil
import subprocess
import unittest

from command import CommandTest, rows


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
        self.refused("export", "stop", "--to", "scypi", *out, says='"scipy"', code="unknown-name")
        self.refused("export", "stop", *out, says="--to", code="bad-syntax")
        self.refused("export", "assembly", "--to", "mujoco", *out, says="mass matrix", code="no-deck")
        self.assertFalse(os.path.exists(self.path("out")))


if __name__ == "__main__":
    unittest.main()
