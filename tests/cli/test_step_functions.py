"""Programs that clackers_main.h makes of step functions: the examples, and good and bad ones."""
import csv
import json
import os
import re
import shutil
import subprocess
import unittest

from command import run
from test_exec import ROOT, SHORT, STOP, ExecTest

HEADER = os.path.join(ROOT, "bindings", "c")
EXAMPLES = os.path.join(ROOT, "examples", "step_functions")
STRICT = ("-Wall", "-Wextra", "-pedantic", "-Wshadow", "-Wconversion", "-Werror")
COMMAND = " {case:text} {n} {out}"

# Euler's method for a mass without contacts.
SOURCE = r"""
#include <clackers_main.h>
int clackers_step(clackers_run* run, double t1, double* u, double* v) {
  double h = t1 - run->t, a = -(run->C[0] * *v + run->K[0] * *u) / run->M[0];
  @
  *u += h * *v, *v += h * a;
  return 0;
}
"""

PROBLEM = """dof=2
contacts=1
t=0.5
end=1.5
u=1 2
v=3 4
M1=1 0
M2=0 2
C1=0 0
C2=0 0
K1=5 6
K2=6 7
direction1=1 -1
gap1=-9
restitution1=0.5
load1=2 3 0 0
spring1=1 -1 2 10
"""


class StepFunctions(ExecTest):
    def setUp(self):
        super().setUp()
        self.compiler = shutil.which("gcc")
        if self.compiler is None:
            self.skipTest("needs gcc")

    def built(self, program, *words, compiler=None):
        """The path of a program that is made by these words of a compiler's command."""
        subprocess.run([compiler or self.compiler, "-O1", f"-I{HEADER}", *words, "-lm", "-o", self.path(program)],
                       check=True, cwd=self.folder)
        return self.path(program)

    def compiled(self, body="", name="mine", *options):
        source = self.path(f"{name}.c")
        with open(source, "w") as file:
            file.write(SOURCE.replace("@", body))
        return self.built(name, "-w", *options, source)

    def problem(self):
        with open(self.path("problem.txt"), "w") as file:
            file.write(PROBLEM)
        return "problem.txt"

    def by_hand(self, program, *arguments, exit_code=0, says=""):
        done = subprocess.run([program, *arguments], capture_output=True, text=True, cwd=self.folder, timeout=60)
        self.assertEqual(done.returncode, exit_code, done.stderr)
        self.assertIn(says, done.stderr)

    def rows(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return list(csv.DictReader(file))


class Examples(StepFunctions):
    def agrees(self, program):
        for case in (("stop",), ("three-parameter", "--set", "N=1")):
            # Events behind the command: they belong to the run that follows.
            subject = self.subject("--exec", program + " {case:text} events={events} {n} {out}", "--expect",
                                   "proper:2", "--case", *case, "--levels", "6", "--samples-per-level", "2", exit_code=0)
            self.assertEqual(subject["assessment"]["verdict"], "agrees")
            self.assertAlmostEqual(subject["assessment"]["displacement"]["order"], 2.0, delta=0.1)
            for level in self.runs(subject):  # impacts were read, too
                self.assertEqual((level["impacts"]["missed"], level["impacts"]["extra"]), (0, 0))

    def test_c(self):
        self.agrees(self.built("newmark", "-std=c99", *STRICT, os.path.join(EXAMPLES, "newmark.c")))

    def test_cxx(self):
        compiler = shutil.which("g++")
        if compiler is None:
            self.skipTest("needs g++")
        self.built("newmark", "-x", "c++", "-std=c++17", *STRICT, os.path.join(EXAMPLES, "newmark.c"), compiler=compiler)
        self.by_hand(self.path("newmark"), self.problem(), "1", "a.csv", exit_code=1,
                     says="one-sided springs need an iteration, at t = 0.5")

    def test_fortran(self):
        compiler = shutil.which("gfortran")
        if compiler is None:
            self.skipTest("needs gfortran")
        sources = [os.path.join(EXAMPLES, name + ".f90") for name in ("clackers_main", "central_difference")]
        subprocess.run([compiler, "-c", "-std=f2018", "-Wall", "-Wno-unused-dummy-argument", "-Werror", *sources],
                       check=True, cwd=self.folder)
        self.agrees(self.built("central_difference", *sources, "-x", "c", os.path.join(HEADER, "clackers_main.h"),
                               compiler=compiler))

    def test_of_the_manual(self):
        with open(os.path.join(ROOT, "docs", "manual", "how-to", "judge-a-step-function.md")) as file:
            source, = re.findall(r"```c\n(.*?)```", file.read(), re.DOTALL)
        with open(self.path("euler.c"), "w") as file:
            file.write(source)
        program = self.built("euler", *STRICT, "euler.c")
        subject = self.subject("--exec", program + COMMAND, "--case", "stop", "--expect", "irregular:1", exit_code=0)
        self.assertEqual((subject["name"], subject["assessment"]["verdict"]), ("euler", "agrees"))
        done = run("verify", "--exec", program + COMMAND, "--case", "symmetric-pair")
        self.assertEqual(done.returncode, 4)
        self.assertIn("It printed: only one mass and one contact, at t = 0", done.stderr)


class Good(StepFunctions):
    def test_problem_is_that_of_show(self):
        program = self.compiled(
            'FILE* out = fopen("' + self.path("seen") + '", "w"); fprintf(out, "%d %d %.17g %.17g %.17g %.17g %.17g '
            '%.17g %.17g %.17g %.17g %.17g", run->dof, run->contacts, run->M[0], run->C[0], run->K[0], '
            "run->direction[0], run->gap[0], run->restitution[0], run->start, run->end, run->u[0], run->v[0]); "
            "fclose(out);")
        self.record("--exec", program + COMMAND, *SHORT, "--set", "eta=0.5")
        shown = json.loads(run("show", *STOP[1:], "--set", "eta=0.5", "--format", "json").stdout)["problem"]
        contact, start = shown["contacts"][0], shown["start"]
        self.assertEqual([float(x) for x in self.text_of("seen").split()],
                         [1, 1, shown["M"][0][0], shown["C"][0][0], shown["K"][0][0], contact["direction"][0],
                          contact["gap"], contact["restitution"], start["t"], shown["end"], start["u"][0], start["v"][0]])

    def test_forces_are_loads_and_springs(self):
        # At u = (1, 2): 3 cos(0) on mass 2, and the spring is closed by 3 along (1, -1).
        program = self.compiled("double f[2]; clackers_forces(run, 0.0, u, f); "
                                'fprintf(stderr, "%g %g %g", f[0], f[1], run->K[1]); return 1;')
        self.by_hand(program, self.problem(), "1", "a.csv", exit_code=1, says="30 -27 6")

    def test_ladder_in_a_process(self):
        program = self.compiled("if (run->tolerance != (run->steps < 4 ? 0 : 0.5)) abort(); "
                                "if (run->memory) ++*(int*)run->memory; else run->memory = calloc(1, sizeof(int)); "
                                "clackers_add_impact(run, t1, 2.0, v, v);")
        self.by_hand(program, self.problem(), "1", "a.csv", "events=e.csv", "2", "b=c.csv", "tolerance=0.5", "4", "d.csv")
        self.assertEqual([row["t"] for row in self.rows("b=c.csv")], ["0.5", "1", "1.5"])
        self.assertEqual([len(self.rows(name)) for name in ("a.csv", "d.csv", "e.csv")], [2, 5, 2])
        self.assertEqual(list(self.rows("e.csv")[0]), ["t", "impulse", "v1-", "v2-", "v1+", "v2+"])
        self.assertEqual(list(self.rows("a.csv")[0]), ["t", "u1", "u2", "v1", "v2"])

    def test_history_may_be_without_velocities(self):
        self.by_hand(self.compiled("", "mine", "-DCLACKERS_WITHOUT_V"), self.problem(), "1", "a.csv")
        self.assertEqual(list(self.rows("a.csv")[0]), ["t", "u1", "u2"])

    def test_states_and_impacts_of_which_little_is_known(self):
        program = self.compiled("clackers_add_impact(run, t1, NAN, NULL, NULL); clackers_add_state(run, t1, u, v);")
        self.by_hand(program, self.problem(), "events=e.csv", "1", "a.csv")
        self.assertEqual((self.rows("e.csv"), len(self.rows("a.csv"))), ([{"t": "1.5"}], 3))

    def test_tolerances_are_levels(self):
        program = self.compiled("if (!(run->tolerance > 0)) return 1;")
        subject = self.subject("--exec", program + " {case:text} tolerance={tolerance} {n} {out}", *STOP,
                               "--tolerances", "1e-1:1e-3")
        self.assertEqual(subject["resolution"], "tolerance")
        self.assertTrue(all(level["finished"] for level in self.runs(subject)))


class Bad(StepFunctions):
    def test_step_fails(self):
        self.fails(self.compiled('if (run->t > 1) return clackers_fail(run, "no memory");') + COMMAND, "program-failed",
                   ("exit status 1", "no memory, at t = "))

    def test_no_part_of_a_history_is_taken_for_it(self):
        for end, code in (("exit(0)", "program-output"), ("abort()", "program-failed")):
            self.fails(self.compiled(f"if (run->t > 1) {end};") + COMMAND, code)
        program = self.compiled("return 1;")
        self.by_hand(program, self.problem(), "4", "a.csv", exit_code=1)
        self.assertFalse([name for name in self.files() if "a.csv" in name])

    def test_arguments(self):
        program = self.compiled()
        self.by_hand(program, exit_code=2, says="PROBLEM [tolerance=X] [events=FILE] STEPS OUT ...")
        problem = self.problem()
        for arguments, says in ((("none", "1", "a"), "none: cannot be read"),
                                ((problem, "0.05", "a"), "0.05: not a number of steps"),
                                ((problem, "0", "a"), "0: not a number of steps"),
                                ((problem, "tolerance=x", "1", "a"), "tolerance=x: not a tolerance"),
                                ((problem, "1", "a", "2"), "2: no file for the history"),
                                ((problem, "1", "none/a"), "none/a.part: cannot be written"),
                                ((program, "1", "a"), "dof: not in the problem; give the file of {case:text}")):
            self.by_hand(program, *arguments, exit_code=2, says=says)

    def test_problem(self):
        for old, new, says in (("M2=0 2", "M2=0", "M2: not the numbers"), ("gap1=-9\n", "", "gap1: not in the problem"),
                               ("spring1", "cable1", "cable1: not known"), ("dof=2", "dof=-1", "dof: out of range")):
            with open(self.path("problem.txt"), "w") as file:
                file.write(PROBLEM.replace(old, new))
            self.by_hand(self.compiled(), "problem.txt", "1", "a", exit_code=2, says=says)

    def test_plugin_is_refused(self):
        for command in ("verify", "atlas"):
            self.refused(command, "--plugin", "a.so", code="unknown-name",
                         says=("clackers_main.h", "{case:text} {n} {out}"))


if __name__ == "__main__":
    unittest.main()
