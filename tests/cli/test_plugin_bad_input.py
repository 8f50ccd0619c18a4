"""verify --plugin: files that are no plug-ins, and plug-ins that fail in every way."""
import shutil
import signal
import subprocess
import unittest

from command import start
from test_exec import SHORT, STOP
from test_plugin import HEADER, PluginTest


class Refused(PluginTest):
    def not_a_plugin(self, library, says):
        self.refused("verify", "--plugin", library, *SHORT, code="not-a-plugin", says=says)

    def test_no_file(self):
        for path, says in ((self.path("none.so"), "No such file"), (self.folder, "not a file")):
            self.refused("verify", "--plugin", path, *SHORT, code="cannot-read", exit_code=4,
                         says=(path, says, "a shared library"))

    def test_no_library(self):
        path = self.path("text.so")
        with open(path, "w") as file:
            file.write("no library")
        self.not_a_plugin(path, (path, "a shared library, made with -shared"))

    def test_no_symbol(self):
        self.not_a_plugin(self.compiled("int other;"), ("no function clackers_plugin",
                                                        "clackers_solver.h"))

    def test_needs_a_library_that_is_not_there(self):
        self.not_a_plugin(self.compiled("void nowhere(void); void f(void) { nowhere(); }"),
                          "undefined symbol: nowhere")

    def test_null(self):
        self.not_a_plugin(self.plugin(result="NULL"), "returned null; allowed: a solver")
        self.not_a_plugin(self.plugin(functions="prepare, NULL, release"),
                          "run = null; allowed: a function")

    def test_another_version(self):
        for version in ("2", "0", "-1"):
            self.not_a_plugin(self.plugin(version=version), f"version = {version}; allowed: 1 to 1")

    def test_another_refinement(self):
        self.not_a_plugin(self.plugin(refines="2"), "refines = 2; allowed: CLACKERS_SOLVER_STEP")

    def test_options(self):
        self.refused("verify", "--plugin", "a.so", "--name", "a", "--name", "b", code="wrong-size",
                     says="1 here")
        self.refused("verify", "--fresh", code="bad-syntax", says="--plugin FILE.so")
        library = self.plugin()
        self.refused("verify", "--plugin", library, "--plugin", library, code="bad-syntax",
                     says="--name")


class Failed(PluginTest):
    def test_prepare_fails(self):
        self.breaks("plugin-failed", "prepare: M is not diagonal.",
                    prepare='return host->fail(host, "M is not diagonal")')
        self.breaks("plugin-failed", "prepare: it returned 7, without host->fail.", prepare="return 7")

    def test_what_fails_before_run_is_not_tried_at_every_step(self):
        for place, count in (("load", 13), ("prepare", 13), ("run", 0)):
            subject = self.subject("--plugin", self.plugin(**{place: "raise(SIGKILL)"}), *STOP, "--levels",
                                   "8", "--neighbours", "2", "--jobs", "1", exit_code=4)
            self.assertEqual(sum("not made" in one["failure"] for one in self.runs(subject)), count)

    def test_hang_while_it_is_loaded_is_interrupted(self):
        library = self.plugin(load=f'fclose(fopen("{self.path("loading")}", "w")); for (;;) pause()')
        with start("verify", "--plugin", library, *SHORT, stdout=subprocess.DEVNULL,
                   stderr=subprocess.PIPE) as process:
            self.wait_for(lambda: "loading" in self.files())
            process.send_signal(signal.SIGINT)
            _, error = process.communicate(timeout=20)
        self.assertEqual(process.returncode, 130, error)
        self.assertIn(b"[interrupted]", error)

    def test_run_fails(self):
        self.breaks("plugin-failed", "run: no memory at step 3.",
                    run='if (i == 3) { char text[99]; sprintf(text, "no memory at step %d", (int)i); '
                        "return host->fail(host, text); }")
        self.breaks("plugin-failed", "run: it returned -1, without", after="return -1")

    def test_failure_without_an_error_value(self):
        self.breaks("plugin-failed", "run: not converged.", after='host->fail(host, "not converged")')
        self.breaks("plugin-failed", "run: no reason is given.", after="host->fail(host, NULL)")

    def test_first_failure_counts(self):
        self.breaks("plugin-failed", "run: first.", after='host->fail(host, "first"); '
                    'host->fail(host, "second"); return 5', free="abort()")

    def test_reason_with_control_characters(self):
        self.breaks("plugin-failed", r"run: a\x0ab\x1b\xff.",
                    after='return host->fail(host, "a\\nb\\x1b\\xff")')

    def test_crash(self):
        null = "*(volatile int*)0 = 1"
        for place in ("load", "prepare", "run", "free"):
            self.breaks("plugin-failed", f"{place}: ended by signal 11 (Segmentation fault).",
                        **{place: null})

    def test_crash_after_the_end(self):
        self.breaks("plugin-failed", "end: ended by signal 6 (Aborted).", load="atexit(abort)")

    def test_abort(self):
        row = self.breaks("plugin-failed", "run: ended by signal 6 (Aborted).",
                          run='fputs("matrix is singular\\n", stderr); abort()')
        self.assertEqual(row["printed"], "matrix is singular\n")

    def test_exit(self):
        for call in ("exit(0)", "_exit(0)"):
            self.breaks("plugin-failed", "run: it ended the process, with exit status 0.", run=call)
        self.breaks("plugin-failed", "run: exit status 3.", run="if (i == 2) exit(3)")
        self.breaks("plugin-failed", "prepare: exit status 3.", prepare="exit(3)")

    def test_crash_of_one_step_is_a_row_and_not_the_end(self):
        library = self.plugin(run="if (task->steps > 150) raise(SIGSEGV)")
        runs = self.runs(self.subject("--plugin", library, *STOP, "--coarsest", "0.1", "--levels", "2",
                                      "--neighbours", "1"))
        self.assertEqual([one["finished"] for one in runs], [True, False])

    def test_hang(self):
        for place in ("load", "prepare", "run"):
            self.breaks("program-timeout", f"{place}: still running after 0.3 s", "--timeout", "0.3",
                        **{place: "for (;;) pause()"})

    def test_hang_with_children(self):
        self.breaks("program-timeout", "run: still running", "--timeout", "0.5", "--jobs", "1",
                    run=f'if (system("sleep 1000 & echo $! > {self.path("child")}; wait")) {{}}')
        self.wait_for(lambda: self.is_gone(self.text_of("child").strip()))

    def test_exceptions_of_cxx(self):
        compiler = shutil.which("g++")
        if compiler is None:
            self.skipTest("needs g++")
        library, source = self.path("solver.so"), self.path("solver.cpp")
        for body, says in (('throw std::runtime_error("no mesh");', "run: an exception left it: no mesh."),
                           ("throw 5;", "run: an exception left it."),
                           ("std::terminate();", "run: ended by signal 6 (Aborted).")):
            with open(source, "w") as file:
                file.write("#include <clackers_solver.h>\n#include <exception>\n#include <stdexcept>\n"
                           "static int32_t run(void*, const clackers_solver_problem*, "
                           f"const clackers_solver_run*, clackers_solver_host*) {{ {body} }}\n"
                           'static const clackers_solver solver = {1, 0, "mine", nullptr, run, nullptr};'
                           "\nconst clackers_solver* clackers_plugin() { return &solver; }\n")
            subprocess.run([compiler, "-shared", "-fPIC", "-Wall", "-Wextra", "-pedantic", "-Werror",
                            f"-I{HEADER}", source, "-o", library], check=True)
            subject = self.subject("--plugin", library, *SHORT, exit_code=4)
            self.assertEqual(self.runs(subject)[0]["failure"], says)


class WrongStates(PluginTest):
    def test_none(self):
        self.breaks("program-output", "run: no state; allowed: states from start to end",
                    run="return 0")

    def test_one(self):
        self.breaks("too-short", "run: states at t = 0 only; allowed:", run="if (i > 0) return 0")

    def test_not_finite(self):
        self.breaks("not-finite", "run: host->state: u[0] = nan at t = ", run="if (i == 3) u = NAN")
        self.breaks("not-finite", "run: host->state: v[0] = -inf at t = ",
                    run="if (i == 3) v = -INFINITY")
        self.breaks("not-finite", "run: host->state: t = nan; allowed: finite", run="t = NAN")

    def test_times(self):
        self.breaks("not-sorted", "run: host->state: t = 0 after t = 0.", run="if (i == 3) t = 0")
        self.breaks("three-limits", "run: host->state: a third state at t = 0;", run="t = 0")

    def test_missing(self):
        self.breaks("plugin-failed", "host->state: u = null; allowed: an array of dof numbers.",
                    run="host->state(host, t, NULL, NULL, NULL)")
        self.breaks("plugin-failed", "host->state: v is given, and was not at first; allowed:",
                    run="host->state(host, t, &u, NULL, NULL)")
        self.breaks("plugin-failed", "host->state: a is not given, and was at first; allowed:",
                    run="host->state(host, t, &u, &v, &a)")

    def test_outside_run(self):
        self.breaks("plugin-failed", "prepare: host->state: called outside run; allowed: from run only",
                    prepare="host->state(host, 0, p->u, NULL, NULL)")
        self.breaks("plugin-failed", "prepare: host->collision: called outside run;",
                    prepare="host->collision(host, 0, NAN, NULL, NULL)")

    def test_ignores_that_nothing_more_is_taken(self):
        self.breaks("not-sorted", "t = -1 after t = 0; allowed",
                    run="host->state(host, t, &u, &v, NULL); host->state(host, -1, &u, &v, NULL); "
                        "continue")

    def test_endless(self):
        self.breaks("program-timeout", "run: still running", "--timeout", "0.5",
                    run="for (int k = 0;; ++k) host->state(host, k, &u, &v, NULL)")

    def test_collisions(self):
        call = "if (i == {}) host->collision(host, {}, {}, {}, {})"
        for i, t, impulse, before, after, code, says in (
                (1, "NAN", "NAN", "NULL", "NULL", "not-finite", "t = nan"),
                (1, "1.0", "INFINITY", "NULL", "NULL", "not-finite", "impulse = inf; allowed: a finite"),
                (1, "1.0", "NAN", "&v", "NULL", "plugin-failed", "one of v_before and v_after is null"),
                (1, "(a = NAN)", "NAN", "&v", "&a", "not-finite", "t = nan")):
            self.breaks(code, "run: host->collision: " + says, run=call.format(i, t, impulse, before, after))
        twice = "if (i == 1) host->collision(host, {}), host->collision(host, {})"
        for first, second, code, says in (
                ("1.0, NAN, NULL, NULL", "0.9, NAN, NULL, NULL", "not-sorted", "t = 0.9 after t = 1"),
                ("1.0, NAN, NULL, NULL", "1.1, 2.0, NULL, NULL", "plugin-failed", "impulse is given, and"),
                ("1.0, NAN, &v, &v", "1.1, NAN, NULL, NULL", "plugin-failed", "v_before is not given"),
                ("1.0, NAN, &v, &v", "1.1, NAN, &v, (a = NAN, &a)", "not-finite", "v_after[0] = nan")):
            self.breaks(code, says, run=twice.format(first, second))


if __name__ == "__main__":
    unittest.main()
