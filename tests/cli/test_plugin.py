"""verify --plugin: solvers in shared libraries, and the example plug-ins."""
import json
import os
import re
import shutil
import subprocess
import unittest

from command import run
from test_exec import ROOT, SHORT, STOP, ExecTest

HEADER = os.path.join(ROOT, "clackers", "study", "plugin")
EXAMPLES = os.path.join(ROOT, "examples", "plugins")
STRICT = ("-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror")

# A plug-in for one mass that ignores contacts: Euler's method.
SOURCE = r"""
#include <clackers_solver.h>
#include <locale.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#define STEP(x) (p->start + (p->end - p->start) * (double)(x) / (double)task->steps)
static int32_t prepare(const clackers_solver_problem* p, clackers_solver_host* host, void** state) {
  (void)p, (void)host, (void)state;
  @prepare@;
  return 0;
}
static int32_t run(void* state, const clackers_solver_problem* p, const clackers_solver_run* task,
                   clackers_solver_host* host) {
  double u = p->u[0], v = p->v[0], h = task->step;
  (void)state;
  for (int64_t i = 0; i <= task->steps; ++i) {
    double t = STEP(i), a = -(p->C[0] * v + p->K[0] * u) / p->M[0];
    @run@;
    if (host->state(host, t, &u, &v, NULL)) return 1;
    u += h * v, v += h * a;
  }
  @after@;
  return 0;
}
static void release(void* state) { (void)state; @free@; }
static const clackers_solver solver = {@version@, @refines@, @name@, @functions@};
const clackers_solver* clackers_plugin(void) { @load@; return @result@; }
"""
PARTS = {"prepare": "", "run": "", "after": "", "free": "", "load": "", "result": "&solver",
         "name": '"mine"', "version": "CLACKERS_SOLVER_VERSION", "refines": "CLACKERS_SOLVER_STEP",
         "functions": "prepare, run, release"}


class PluginTest(ExecTest):
    def setUp(self):
        super().setUp()
        self.compiler = shutil.which("gcc")
        if self.compiler is None:
            self.skipTest("needs gcc")

    def compiled(self, source, name="solver"):
        """A shared library from C."""
        file, library = self.path(f"{name}.c"), self.path(f"{name}.so")
        with open(file, "w") as out:
            out.write(source)
        subprocess.run([self.compiler, "-O1", "-w", "-shared", "-fPIC", f"-I{HEADER}", file, "-o",
                        library], check=True)
        return library

    def plugin(self, file="solver", **parts):
        return self.compiled(re.sub("@(.*?)@", lambda found: {**PARTS, **parts}[found[1]], SOURCE),
                             file)

    def breaks(self, code, says, *options, **parts):
        """A plug-in of which every run fails; returns the first row."""
        done = run("verify", "--plugin", self.plugin(**parts), *SHORT, *options, "--format", "json")
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertRegex(done.stderr, r"\[%s\]\n\Z" % code)
        subject, = json.loads(done.stdout)["cases"][0]["subjects"]
        self.assertEqual(subject["kind"], "plugin")
        runs = self.runs(subject)
        self.assertEqual({one["failure_code"] for one in runs}, {code})
        for text in [says] if isinstance(says, str) else says:
            self.assertIn(text, runs[0]["failure"])
            self.assertIn(text, done.stderr)
        return runs[0]


class Examples(PluginTest):
    def agrees(self, library, name):
        for case in (("stop",), ("three-parameter", "--set", "N=1")):
            subject = self.subject("--plugin", library, "--expect", "proper:2", "--case", *case,
                                   "--levels", "6", "--neighbours", "2", exit_code=0)
            self.assertEqual((subject["kind"], subject["name"]), ("plugin", name))
            assessment = subject["assessment"]
            self.assertEqual(assessment["verdict"], "agrees")
            self.assertAlmostEqual(assessment["displacement"]["order"], 2.0, delta=0.1)
            for one in self.runs(subject):  # collisions were read, too
                self.assertEqual((one["impacts"]["missed"], one["impacts"]["extra"]), (0, 0))

    def test_c(self):
        library = self.path("newmark.so")
        subprocess.run([self.compiler, *STRICT, "-O2", "-shared", "-fPIC", f"-I{HEADER}",
                        os.path.join(EXAMPLES, "newmark.c"), "-o", library], check=True)
        self.agrees(library, "newmark-c")

    def test_fortran(self):
        compiler = shutil.which("gfortran")
        if compiler is None:
            self.skipTest("needs gfortran")
        library = self.path("central_difference.so")
        sources = [os.path.join(EXAMPLES, name + ".f90")
                   for name in ("clackers_solver", "central_difference")]
        subprocess.run([compiler, "-std=f2018", "-Wall", "-Wno-unused-dummy-argument", "-Werror",
                        "-O2", "-shared", "-fPIC",
                        *sources, "-o", library], check=True, cwd=self.folder)
        self.agrees(library, "central-difference-f90")


    def test_of_the_manual(self):
        with open(os.path.join(ROOT, "docs", "manual", "how-to", "write-a-plug-in.md")) as file:
            source, = re.findall(r"```\{code-block\} c\n(.*?)```", file.read(), re.DOTALL)
        subject = self.subject("--plugin", self.compiled(source, "euler"), "--case", "stop",
                               "--expect", "irregular:1", exit_code=0)
        self.assertEqual((subject["name"], subject["assessment"]["verdict"]), ("euler", "agrees"))
        done = run("verify", "--plugin", self.path("euler.so"), "--case", "symmetric-pair")
        self.assertEqual(done.returncode, 4)
        self.assertIn("prepare: one mass and one contact, please. [plugin-failed]", done.stderr)

    def test_runs_under_a_debugger_as_the_manual_says(self):
        library = self.plugin()
        work = self.path("work")
        self.record("--plugin", library, *STOP, "--levels", "1", "--neighbours", "1", "--work", work)
        folder, = (os.path.join(work, name) for name in os.listdir(work))
        done = run("--plugin-run", library, "report.txt", "problem.txt", "0.05", "160", "0", "out.npy",
                   "events.npy", cwd=folder)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        size = os.path.getsize(os.path.join(folder, "out.npy"))
        self.assertEqual(size % 64, 161 * 3 * 8 % 64)  # a header of blocks, then t, u and v
        self.assertGreater(size, 161 * 3 * 8)


class Good(PluginTest):
    def finished(self, *arguments):
        subject = self.subject(*arguments)
        self.assertTrue(all(one["finished"] for one in self.runs(subject)), subject)
        return subject

    def test_name_is_its_own_or_given_or_that_of_the_file(self):
        library = self.plugin()
        self.assertEqual(self.finished("--plugin", library, *SHORT)["name"], "mine")
        self.assertEqual(self.finished("--plugin", library, "--name", "yours", *SHORT)["name"],
                         "yours")
        rude = self.plugin("rude", name=r'"a\nb"')
        self.assertEqual(self.finished("--plugin", rude, *SHORT)["name"], r"a\x0ab")
        unnamed = self.plugin("file name", name="NULL")
        self.assertEqual(self.finished("--plugin", unnamed, *SHORT)["name"], "file name")

    def test_stands_beside_methods_programs_and_other_plugins(self):
        record = self.record("rk4", "--plugin", self.plugin(), "--exec", "echo {h}", "--plugin",
                             self.plugin("other"), "--name", "a", "--name", "b", "--name", "c",
                             *SHORT)
        self.assertEqual([(one["name"], one["kind"]) for one in record["cases"][0]["subjects"]],
                         [("rk4", "method"), ("a", "program"), ("b", "plugin"), ("c", "plugin")])

    def test_path_with_blanks_quotes_and_braces(self):
        folder = self.path("it's {h} $HOME")
        os.mkdir(folder)
        shutil.copy(self.plugin(), os.path.join(folder, "{{out}}.so"))
        done = run("verify", "--plugin", "{{out}}.so", *SHORT, "--format", "json", cwd=folder)
        subject, = json.loads(done.stdout)["cases"][0]["subjects"]
        self.assertTrue(all(one["finished"] for one in self.runs(subject)), done.stdout)

    def test_is_handed_the_problem_and_the_run(self):
        seen = self.path("seen")
        report = (f'FILE* out = fopen("{seen}", "w");'
                  'fprintf(out, "%d %d %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g", '
                  "p->dof, p->contacts, p->M[0], p->C[0], p->K[0], p->direction[0], p->gap[0], "
                  "p->restitution[0], p->start, p->end, p->u[0], p->v[0]); fclose(out)")
        self.finished("--plugin", self.plugin(prepare=report), *STOP, "--levels", "1",
                      "--neighbours", "1", "--set", "eta=0.5")
        problem = json.loads(run("show", *STOP[1:], "--set", "eta=0.5", "--format", "json").stdout)
        problem = problem["problem"]
        contact, start = problem["contacts"][0], problem["start"]
        self.assertEqual([float(x) for x in self.text_of("seen").split()],
                         [1, 1, problem["M"][0][0], problem["C"][0][0], problem["K"][0][0],
                          contact["direction"][0], contact["gap"], contact["restitution"],
                          start["t"], problem["end"], start["u"][0], start["v"][0]])

    def test_matrices_are_stored_by_rows_and_contacts_may_be_none(self):
        seen = self.path("seen")
        report = (f'FILE* out = fopen("{seen}", "w"); for (int i = 0; i < 4; ++i) '
                  'fprintf(out, "%.17g ", p->K[i]); fclose(out); return host->fail(host, "enough")')
        self.record("--plugin", self.plugin(prepare=report), "--case", "three-parameter",
                    "--levels", "1", "--neighbours", "1")
        shown = json.loads(run("show", "three-parameter", "--format", "json").stdout)
        self.assertEqual([float(x) for x in self.text_of("seen").split()],
                         sum(shown["problem"]["K"], []))

    def test_state_goes_from_prepare_to_run_and_free(self):
        log = self.path("log")

        def note(text):
            return f'{{ FILE* out = fopen("{log}", "a"); fprintf(out, "{text} "); fclose(out); }}'

        def calls(prepare="", after=""):
            open(log, "w").close()
            library = self.plugin(
                prepare="*state = malloc(1); *(char*)*state = 'x'; " + note("prepare") + prepare,
                run="if (*(char*)state != 'x') abort(); if (i == 0) " + note("run"), after=after,
                free="if (*(char*)state != 'x') abort(); free(state); " + note("free"))
            self.subject("--plugin", library, *STOP, "--levels", "1", "--neighbours", "1")
            return self.text_of("log").split()
        self.assertEqual(calls(), ["prepare", "run", "free"])
        self.assertEqual(calls(after="return 1"), ["prepare", "run", "free"])
        self.assertEqual(calls(prepare="return 1"), ["prepare", "free"])

    def test_prepare_and_free_may_be_null(self):
        self.finished("--plugin", self.plugin(functions="NULL, run, NULL"), *SHORT)

    def test_tolerances_are_levels_of_those_that_refine_by_them(self):
        library = self.plugin(refines="CLACKERS_SOLVER_TOLERANCE",
                              run="if (!(task->tolerance > 0)) return 1")
        subject = self.finished("--plugin", library, *STOP, "--tolerances", "1e-1:1e-3")
        self.assertEqual(subject["resolution"], "tolerance")
        self.assertEqual([one["step"] for one in self.runs(subject)], [0.1, 0.01, 0.001])
        steps = self.plugin("steps", run="if (task->tolerance != 0) return 1")
        self.assertEqual(self.finished("--plugin", steps, *SHORT)["resolution"], "step")

    def test_what_it_prints_is_no_part_of_the_history(self):
        quiet = self.finished("--plugin", self.plugin("quiet"), *SHORT)
        loud = self.finished("--plugin", self.plugin(
            "loud", load='puts("t,u1"); setvbuf(stdout, NULL, _IONBF, 0)',
            run='printf("0,1\\n"); fprintf(stderr, "0,1\\n"); if (write(3, "0,1\\n", 4)) {}'), *SHORT)
        self.assertEqual([one["u_error"] for one in self.runs(quiet)],
                         [one["u_error"] for one in self.runs(loud)])

    def test_may_close_files_change_the_folder_and_the_locale(self):
        self.finished("--plugin", self.plugin(
            load='if (chdir("/")) {} setlocale(LC_ALL, ""); for (int i = 0; i < 99; ++i) close(i)'), *SHORT)

    def test_collisions_are_read(self):
        def impacts(call):
            subject = self.finished("--plugin", self.plugin(run=call), *SHORT)
            return self.runs(subject)[0]["impacts"]["found"]
        once = "if (i == 1 && host->collision(host, 1.5707963, {}, {}, {})) return 1"
        self.assertEqual(impacts(""), 0)
        self.assertEqual(impacts(once.format("NAN", "NULL", "NULL")), 1)
        self.assertEqual(impacts(once.format("2.0", "&v", "&v")), 1)

    def test_runs_are_made_once(self):
        log = self.path("log")
        note = f'if (i == 0) {{ FILE* out = fopen("{log}", "a"); fputs("x", out); fclose(out); }}'

        def count(*options):
            open(log, "w").close()
            self.finished("--plugin", library, *SHORT, *options)
            return len(self.text_of("log"))
        library = self.plugin(run=note)
        self.assertEqual([count(), count(), count("--fresh")], [2, 0, 2])
        library = self.plugin(run=note)  # compiled anew
        self.assertEqual(count(), 2)


if __name__ == "__main__":
    unittest.main()
