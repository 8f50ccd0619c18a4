"""verify --exec: programs of others as methods, good and bad ones, and the example solvers."""
import json
import os
import resource
import shutil
import signal
import subprocess
import unittest

from command import PROGRAM, CommandTest, rows, run, start

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
SOLVERS = os.path.join(ROOT, "examples", "solvers")

# A mass above a stop, for some impacts.
STOP = ("--case", "stop", "--set", "t_end=8")
# Enough runs to be failed.
SHORT = (*STOP, "--levels", "2", "--samples-per-level", "1")
MIDPOINT = f"python3 {SOLVERS}/midpoint.py {{case}} {{h}} {{out}}"


class ExecTest(CommandTest):
    def setUp(self):
        super().setUp()
        self.cache = self.path("cache")
        before = os.environ.get("XDG_CACHE_HOME")
        os.environ["XDG_CACHE_HOME"] = self.cache
        self.addCleanup(lambda: os.environ.pop("XDG_CACHE_HOME") if before is None
                        else os.environ.update(XDG_CACHE_HOME=before))

    def script(self, text, name="solver"):
        """A shell program."""
        path = self.path(name)
        with open(path, "w") as file:
            file.write("#!/bin/sh\n" + text)
        os.chmod(path, 0o755)
        return path

    def record(self, *arguments, exit_code=None):
        done = run("verify", *arguments, "--format", "json")
        if exit_code is not None:
            self.assertEqual(done.returncode, exit_code, done.stderr)
        return json.loads(done.stdout)

    def subject(self, *arguments, exit_code=None):
        subject, = self.record(*arguments, exit_code=exit_code)["cases"][0]["subjects"]
        return subject

    def is_gone(self, number):
        """Whether a process has ended; who inherited it may not have waited for it yet."""
        try:
            with open(f"/proc/{number}/stat") as file:
                return file.read().rpartition(")")[2].split()[0] in "ZX"
        except (FileNotFoundError, ProcessLookupError):  # the second where it ends between open and read
            return True

    def runs(self, subject):
        return [run for level in subject["levels"] for run in level["runs"]]

    def fails(self, command, code, says=(), *options):
        """A program of which every run fails: exit code 4, and a row for every run."""
        done = run("verify", "--exec", command, *SHORT, *options, "--format", "json")
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertRegex(done.stderr, r"\[%s\]\n\Z" % code)
        for text in [says] if isinstance(says, str) else says:
            self.assertIn(text, done.stderr)
        subject, = json.loads(done.stdout)["cases"][0]["subjects"]
        self.assertEqual({run["failure_code"] for run in self.runs(subject)}, {code})
        return self.runs(subject)


class Examples(ExecTest):
    def agrees(self, command, expected, neighbours="2",
               cases=(("stop",), ("three-parameter", "--set", "N=1"))):
        for case in cases:
            subject = self.subject("--exec", command, "--expect", expected, "--case", *case,
                                   "--levels", "6", "--samples-per-level", neighbours, exit_code=0)
            self.assertEqual((subject["kind"], subject["assessment"]["verdict"]),
                             ("program", "agrees"))

    def compiled(self, compiler, source):
        program = shutil.which(compiler)
        if program is None:
            self.skipTest(f"needs {compiler}")
        name = self.path(os.path.splitext(source)[0])
        subprocess.run([program, "-O2", "-o", name, os.path.join(SOLVERS, source)], check=True)
        return name

    def test_python(self):
        self.agrees(MIDPOINT + " {events}", "proper:2")

    def test_c(self):
        self.agrees(self.compiled("gcc", "heun.c") + " {case:text} {n} {out}", "proper:2")

    def test_fortran(self):
        self.agrees(self.compiled("gfortran", "rk4.f90") + " {case:text} {n} {out}", "proper:4")

    def test_octave(self):
        if shutil.which("octave-cli") is None:
            self.skipTest("needs octave-cli")
        self.agrees(f"octave-cli --no-history {SOLVERS}/newmark.m {{case}} {{h}} {{out}}",
                    "irregular:1", "4", [["stop"]])

    def test_elements_of_the_mesh(self):
        command = f"python3 {SOLVERS}/bar.py {{case}} {{h}} {{out}}"
        self.agrees(command, "irregular:1", "4", [["bar-wall", "--set", "elements=4,mass=lumped"],
                                                  ["mass-on-bar", "--set", "elements=4,mass=lumped"]])
        for case, mass in (("bar-wall", "massless"), ("stop", "unknown, since the case has none")):
            done = run("verify", "--exec", command, "--case", case, *SHORT[-4:])
            self.assertIn(f"mass = {mass}; allowed: lumped", done.stderr)

    def test_elements_along_a_path(self):
        command = f"python3 {SOLVERS}/bar.py {{case}} {{h}} {{out}}"
        path = ("--case", "bar-wall", "--path", "0.45", "--levels", "1", "--samples-per-level", "4", "--format", "json")
        done = run("verify", "--exec", command, *path, "--set", "mass=lumped,elements=8")
        self.assertEqual(done.returncode, 0, done.stderr)
        orders, finest, _, runs = json.loads(done.stdout)["sheets"]
        self.assertEqual([row[0] for row in orders["rows"]], ["bar"])
        self.assertLess(finest["rows"][0][1], 0.2)
        self.assertEqual([row[-1] for row in runs["rows"]], [""] * 4)
        done = run("verify", "--exec", command, *path)
        self.assertEqual(done.returncode, 4)
        orders, _ = json.loads(done.stdout)["sheets"]  # and all runs
        self.assertIn("[program-failed]", orders["rows"][0][-1])
        done = run("verify", "--exec", command, *path, "--tolerances", "1e-3:1e-6")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--tolerances", done.stderr)

    def test_are_short(self):
        for name in os.listdir(SOLVERS):
            if name != "README.md":
                with open(os.path.join(SOLVERS, name)) as file:
                    self.assertLess(len(file.readlines()), 60, name)


class Good(ExecTest):
    def test_problem_is_that_of_show(self):
        shown = json.loads(run("show", "stop", "--set", "t_end=8", "--format", "json").stdout)
        run("verify", "--exec", f"cp {{case}} {self.path('seen')}; cp {{case:text}} "
            f"{self.path('text')}; exit {{n}}", *SHORT)
        seen = json.loads(self.text_of("seen"))
        self.assertEqual(seen["problem"], shown["problem"])
        self.assertEqual(seen["case"], "stop")
        self.assertNotIn("mesh", shown)
        mesh = json.loads(run("show", "bar-wall", "--set", "elements=2", "--format", "json").stdout)["mesh"]
        self.assertEqual([node["dof"] for node in mesh["nodes"]], [None, 1, 2])
        lines = dict(line.split("=") for line in self.text_of("text").splitlines())
        self.assertEqual([[float(lines["M1"])]], seen["problem"]["M"])
        self.assertEqual(float(lines["end"]), seen["problem"]["end"])

    def test_stands_beside_methods_under_its_own_name(self):
        record = self.record("newmark", "--exec", MIDPOINT, "--exec", MIDPOINT, "--name", "mine",
                             "--name", "yours", *SHORT)
        subjects = record["cases"][0]["subjects"]
        self.assertEqual([(one["name"], one["kind"]) for one in subjects],
                         [("newmark", "method"), ("mine", "program"), ("yours", "program")])
        self.assertEqual(self.subject("--exec", MIDPOINT, *SHORT)["name"], "midpoint")

    def test_one_process_may_make_all_runs(self):
        log = self.path("log")
        command = "sh " + self.script(
            f"echo start >> {log}\nwhile read h n out; do python3 {SOLVERS}/midpoint.py $1 $h \"$out\"; done < $2"
        ) + " {case} {runs}"
        single = self.subject("--exec", MIDPOINT, *STOP, "--levels", "2", "--samples-per-level", "2", "--budget", "0")
        options = (*STOP, "--levels", "2", "--samples-per-level", "2", "--budget", "0")
        for _ in range(2):
            batch = self.subject("--exec-batch", command, *options)
            self.assertEqual([(run["step"], run["u_error"]) for run in self.runs(batch)],
                             [(run["step"], run["u_error"]) for run in self.runs(single)])
        self.assertEqual(self.text_of("log"), "start\n")
        self.subject("--exec-batch", command, *options, "--fresh")
        self.assertEqual(self.text_of("log"), "start\nstart\n")

    def test_one_process_by_tolerances_reads_them(self):
        command = "cp {runs:tolerance} " + self.path("seen") + "; exit 3"
        subject = self.subject("--exec-batch", command, "--tolerances", "1e-3:1e-5", *STOP)
        self.assertEqual([line.split()[0] for line in self.text_of("seen").splitlines()],
                         ["0.001", "0.0001", "1e-05"])
        self.assertEqual([run["failure"] for run in self.runs(subject)], ["exit status 3."] * 3)

    def test_one_process_that_fails_leaves_what_it_finished(self):
        command = "sh " + self.script(f"""i=0
while read h n out; do i=$((i + 1))
  python3 {SOLVERS}/midpoint.py $1 $h "$out"
  [ $i != 3 ] || {{ echo broken; exit 9; }}
done < $2""") + " {case} {runs}"
        subject = self.subject("--exec-batch", command, *STOP, "--levels", "4", "--samples-per-level", "1", "--budget", "0",
                               "--work", self.path("work"))
        runs = self.runs(subject)
        self.assertEqual([run["finished"] for run in runs], [True, True, False, False])
        self.assertTrue(all(run["failure"].startswith("exit status 9.") for run in runs[2:]))
        # The kept folder and the command that it names make the run again.
        again = runs[3]["failure"].split("Again: ")[1].rstrip(".")
        subprocess.run(again, shell=True, check=True, cwd="/")

    def test_failure_names_the_command_that_repeats_it(self):
        solver = self.script("echo no licence >&2; exit 7")
        done = run("verify", "--exec", solver + " {h} {out}", *SHORT, "--work", self.path("work"))
        self.assertEqual(done.returncode, 4)
        text = " ".join(done.stderr.split())
        self.assertRegex(text, r"solver: every run failed; the first one, at h = [0-9.]+ s: exit status 7\. Again: cd \S+ && ")
        self.assertIn("It printed: no licence", text)

    def test_cost_is_the_programs_own_or_that_of_its_process(self):
        seconds = [run["seconds"] for run in self.runs(self.subject("--exec", MIDPOINT, *SHORT))]
        self.assertTrue(all(0 < one < 60 for one in seconds), seconds)
        again = [run["seconds"] for run in self.runs(self.subject("--exec", MIDPOINT, *SHORT))]
        self.assertEqual(again, seconds)
        command = MIDPOINT + " && echo '# seconds 0.25 steps 40' >> {out}"
        for run_ in self.runs(self.subject("--exec", command, *SHORT)):
            self.assertEqual((run_["seconds"], run_["work"]["steps"]), (0.25, 40))

    def test_labels_stand_in_record_and_table(self):
        words = ("--label", "precision=single", "--label", "springs=force")
        subject = self.subject("--exec", MIDPOINT, *SHORT, *words)
        self.assertEqual(subject["labels"], {"precision": "single", "springs": "force"})
        self.assertIn("midpoint: precision=single, springs=force.", run("verify", "--exec", MIDPOINT, *SHORT, *words).stdout)
        self.good("respond", "stop", "--step", "0.01", "--format", "csv", "--out", self.path("h.csv"), "--quiet")
        done = run("check", self.path("h.csv"), "--case", "stop", "--format", "json", *words)
        self.assertEqual(json.loads(done.stdout)["cases"][0]["subjects"][0]["labels"]["springs"], "force")
        for wrong in (("a",), ("=b",), ("a=1", "--label", "a=2")):
            self.refused("verify", "--exec", MIDPOINT, "--label", *wrong, code="bad-syntax", says="--label")

    def test_history_may_be_standard_output(self):
        command = MIDPOINT.replace("{out}", "/dev/stdout")
        self.assertTrue(all(run["finished"]
                            for run in self.runs(self.subject("--exec", command, *SHORT))))

    def test_paths_with_blanks_and_quotes(self):
        folder = self.path("it's a \"folder\"")
        os.mkdir(folder)
        shutil.copy(os.path.join(SOLVERS, "midpoint.py"), os.path.join(folder, "my solver.py"))
        done = run("verify", "--exec", "python3 'my solver.py' {case} {h} {out}", *SHORT, "--work",
                   os.path.join(folder, "work $HOME"), "--format", "json", cwd=folder)
        subject, = json.loads(done.stdout)["cases"][0]["subjects"]
        self.assertEqual(subject["name"], "my solver")
        self.assertTrue(all(run["finished"] for run in self.runs(subject)), done.stdout)

    def test_tolerances_are_levels(self):
        log = self.path("log")
        self.script(f"echo $1 >> {log}; exec python3 {SOLVERS}/midpoint.py $2 $1 $3")
        subject = self.subject("--exec", f"{self.path('solver')} {{tolerance}} {{case}} {{out}}",
                               *STOP, "--tolerances", "1e-1:1e-3", "--jobs", "1")
        self.assertEqual(self.text_of("log").split(), ["0.1", "0.01", "0.001"])
        self.assertEqual(subject["resolution"], "tolerance")
        self.assertEqual([run["step"] for run in self.runs(subject)], [0.1, 0.01, 0.001])

    def test_runs_are_made_once(self):
        log = self.path("log")
        solver = self.script(f"echo run >> {log}; exec python3 {SOLVERS}/midpoint.py \"$@\"")

        def count(*options):
            open(log, "w").close()
            first = self.subject("--exec", f"{solver} {{case}} {{h}} {{out}}", *SHORT, *options)
            self.assertTrue(all(run["finished"] for run in self.runs(first)))
            return len(self.text_of("log").split())
        self.assertEqual(count(), 2)
        self.assertEqual(count(), 0)
        self.assertEqual(count("--set", "eta=0.5"), 2)
        self.assertEqual(count("--fresh"), 2)
        self.assertEqual(count("--work", self.path("work")), 2)
        self.assertEqual(count("--work", self.path("work")), 0)
        os.utime(solver, (1, 1))
        self.assertEqual(count(), 2)

    def test_reused_runs_are_named(self):
        arguments = ("rk4", "--exec", MIDPOINT, *SHORT)
        for reused in (False, True):
            method, program = self.record(*arguments)["cases"][0]["subjects"]
            self.assertEqual([run["file"] for run in self.runs(method)], [None, None])
            self.assertEqual(["reused" in [note["code"] for note in run["file"]["notes"]]
                              for run in self.runs(program)], [reused] * 2)
        table = run("verify", *arguments, "--report", self.path("page.html")).stdout
        self.assertIn("midpoint: 2 of 2 runs are those of an earlier call; --fresh repeats them.", table)
        self.assertIn("2 of 2 runs are those of an earlier call", self.text_of("page.html"))
        self.assertEqual([row["reused"] for row in rows(run("verify", *arguments, "--format", "csv").stdout)],
                         ["", "", "yes", "yes"])
        self.assertNotIn("earlier call", run("verify", *arguments, "--fresh").stdout)

    def test_variables_of_the_environment_belong_to_a_run(self):
        log = self.path("log")
        command = self.script(f"echo $ETA >> {log}; exec python3 {SOLVERS}/midpoint.py \"$@\"") + " {case} {h} {out}"

        def values(eta, *options):
            open(log, "w").close()
            before, os.environ["ETA"] = os.environ.get("ETA"), eta
            try:
                self.subject("--exec", command, *SHORT, *options)
            finally:
                os.environ.pop("ETA") if before is None else os.environ.update(ETA=before)
            return self.text_of("log").split()
        named = ("--environment", "NOT_SET_ANYWHERE,ETA")
        self.assertEqual(values("1"), ["1", "1"])
        self.assertEqual(values("2"), [])
        self.assertEqual(values("2", *named), ["2", "2"])
        self.assertEqual(values("2", *named), [])
        self.assertEqual(values("3", *named), ["3", "3"])
        self.refused("verify", "--environment", "ETA", code="bad-syntax", says="--exec")
        self.refused("verify", "--exec", "a {h}", "--environment", "A,,B", code="bad-syntax", says="--environment")


class Bad(ExecTest):
    def test_crash(self):
        self.fails("kill -SEGV $$; : {h} {out}", "program-failed", "signal 11 (Segmentation fault)")

    def test_exit_status_with_text(self):
        run, _ = self.fails("echo no mesh >&2; exit {n}1; : {out}", "program-failed", "no mesh")
        self.assertEqual(run["printed"], "no mesh\n")

    def test_hang_with_children(self):
        self.script(f"sleep 1000 & echo $! > {self.path('child')}\nsleep 1000")
        self.fails(f"{self.path('solver')} {{h}} {{out}}", "program-timeout", "after 0.2 s",
                   "--timeout", "0.2s", "--jobs", "1")
        self.wait_for(lambda: self.is_gone(self.text_of("child").strip()))

    def test_hang_is_not_tried_at_every_step(self):
        runs = self.runs(self.subject("--exec", "sleep 1000; : {h}", *STOP, "--levels", "8",
                                      "--samples-per-level", "2", "--timeout", "0.2", "--jobs", "1",
                                      exit_code=4))
        self.assertEqual(sum("not made" in run["failure"] for run in runs), 13)

    def test_no_output(self):
        self.fails("echo {h} {out}", "program-output", "{out}")
        self.fails(": {h}", "program-output", "standard output")

    def test_does_not_exist_or_may_not_be_executed(self):
        self.fails("/nowhere/solver {h} {out}", "program-failed", "not found")
        path = self.script("")
        os.chmod(path, 0o644)
        self.fails(f"{path} {{h}} {{out}}", "program-failed", "ermission denied")

    def test_not_a_number(self):
        self.fails("printf 't,u1\\n0,1\\n1,nan\\n2,nan\\n'; : {h}", "not-finite")

    def test_half_a_row(self):
        self.fails("printf 't,u1,v1\\n0,1,0\\n1,0.5,0\\n2,' > {out}; : {h}", "ragged-row",
                   "history.csv line 4")

    def test_endless_standard_output(self):
        self.fails("yes; : {h} {out}", "program-timeout", "after 0.3 s", "--timeout", "0.3")

    def test_endless_history(self):
        self.fails("yes; : {h}", "program-output", "standard output", "--jobs", "1")

    def test_harm_to_its_folder_costs_that_run_only(self):
        exact = self.path("exact.csv")
        self.good("respond", "stop", "--set", "t_end=8", "--step", "0.1", "--format", "csv", "--quiet", "--out", exact)
        for harm in ('rm -rf "$PWD"', 'mv "$PWD" "$PWD-moved"', 'rm -rf "$PWD"; ln -s /nowhere "$PWD"',
                     'rm -rf "$PWD"; echo > "$PWD"', "ln -sf /dev/full history.csv", "mkdir -p history.csv/a/history.csv",
                     "mkfifo history.csv", "exec 1>&- 2>&-; kill -STOP $$"):
            self.script(f"[ $1 -lt 100 ] || {{ {harm}; }}\nexec cp {exact} $2")
            for place in ((), ("--work", self.path("work"))) if "PWD" in harm else ((),):
                with self.subTest(harm=harm, place=place):
                    done = run("verify", "--exec", f"{self.path('solver')} {{n}} {{out}}", *STOP, "--coarsest", "0.1",
                               "--levels", "2", "--samples-per-level", "1", "--timeout", "1", *place, "--format", "json")
                    subject, = json.loads(done.stdout)["cases"][0]["subjects"]
                    self.assertEqual([run["finished"] for run in self.runs(subject)], [True, False], done.stderr)

    def test_limits_of_the_system_are_failed_runs(self):
        for limit, value, command in ((resource.RLIMIT_NOFILE, 12, MIDPOINT), (resource.RLIMIT_NOFILE, 5, MIDPOINT),
                                      (resource.RLIMIT_FSIZE, 20000, "yes 1,2; : {h}")):
            done = run("verify", "rk4", "--exec", command, *SHORT, "--jobs", "2", "--format", "csv",
                       preexec_fn=lambda: resource.setrlimit(limit, (value, value)))  # noqa: B023
            finished = [row["finished"] for row in rows(done.stdout)]
            self.assertEqual(finished[:2], ["yes", "yes"])
            self.assertEqual(done.returncode, 3 if "yes" in finished[2:] else 4, (limit, value))
            self.assertEqual(": every run failed" in done.stderr, done.returncode == 4)
            codes = {row["failure_code"] for row in rows(done.stdout)[2:]}
            self.assertLessEqual(codes, {"", "cannot-write", "cannot-read", "program-failed"})
            self.assertTrue(limit == resource.RLIMIT_NOFILE or codes == {"cannot-write"}, codes)

    def test_full_disk(self):
        disk = self.path("disk")
        os.mkdir(disk)
        mount = ["unshare", "-m", "sh", "-c", 'mount -t tmpfs -o size=200k disk "$0" && exec "$@"', disk]
        if subprocess.run([*mount, "true"], capture_output=True).returncode:
            self.skipTest("needs a file system of its own: unshare -m")
        for command in ("head -c 1000000 /dev/zero > a; : {h} {out}", "yes 1,2; : {h}"):
            done = subprocess.run([*mount, PROGRAM, "verify", "rk4", "--exec", command, *SHORT, "--work", disk,
                                   "--format", "csv"], capture_output=True, text=True)
            self.assertEqual(done.returncode, 4)
            self.assertRegex(done.stderr, "(head|yes): every run failed")
            finished = [row["finished"] for row in rows(done.stdout)]
            self.assertEqual(finished, ["yes", "yes", "no", "no"])

    def test_that_never_finishes_is_exit_code_4_beside_a_method(self):
        done = run("verify", "newmark", "--exec", "./missing {h}", *STOP, "--levels", "2")
        self.assertEqual(done.returncode, 4)
        self.assertRegex(done.stderr, r"clackers: missing: every run failed; the first one, at h = [0-9.]+ s: exit status 127")

    def test_one_step_is_a_row_and_not_the_end(self):
        self.script(f"[ $2 -lt 150 ] || {{ echo no memory; exit 7; }}\nexec python3 {SOLVERS}/midpoint.py $1 $3 $4")
        arguments = ("--exec", f"{self.path('solver')} {{case}} {{n}} {{h}} {{out}}", *STOP,
                     "--coarsest", "0.1", "--levels", "3", "--samples-per-level", "1")
        runs = self.runs(self.subject(*arguments))
        text = " ".join(run("verify", *arguments).stdout.split())
        self.assertIn("solver: 2 of 3 runs failed, the first at h = 0.05", text)
        self.assertIn("exit status 7. [program-failed] It printed: no memory", text)
        self.assertEqual([run["failure"] for run in runs], ["", "exit status 7.",
                                                                     "exit status 7."])

    def test_ignored_step_is_no_agreement(self):
        subject = self.subject("--exec", MIDPOINT.replace("{h}", "0.01") + " # {h}", *STOP,
                               "--levels", "4", "--samples-per-level", "1", "--expect", "proper:2",
                               "--budget", "0")
        self.assertNotEqual(subject["assessment"]["verdict"], "agrees")

    def test_refusals(self):
        for command, says in (("", "empty"), ("solver {out}", "{h}"),
                              ("solver {h} {our}", 'Did you mean "out"?'),
                              ("solver {h} {Case}", 'Did you mean "case"?'), ("solver {runs} {h}", "{runs}")):
            self.refused("verify", "--exec", command, code="(?:bad-syntax|unknown-name)", says=says)
        self.refused("verify", "--exec", "a {h}", "--exec", "a {h}", code="bad-syntax", says="--name")
        self.refused("verify", "--exec", "a {h}", "--name", "a", "--name", "b", code="wrong-size",
                     says="--name")
        self.refused("verify", "--timeout", "3", code="bad-syntax", says="--exec")
        self.refused("verify", "--exec", "a {tolerance}", "--tolerances", "1e-3:x",
                     code="bad-syntax", says="1e-3:1e-12")


class Apart(ExecTest):
    """Two commands with one number of their process, as in containers."""

    def test_runs_of_two_pid_namespaces_do_not_mix(self):
        space = ["unshare", "-fp", "--mount-proc"]
        if subprocess.run([*space, "true"], capture_output=True).returncode:
            self.skipTest("needs a pid namespace of its own: unshare -fp")
        for name, settings in (("good", "eta=1"), ("bad", "eta=0.5")):
            self.good("respond", "stop", "--set", settings, "--step", "0.1", "--format", "csv", "--quiet",
                      "--out", self.path(name))
        for place in ((), ("--work", self.path("work"))):
            def arguments(name):
                command = f"sleep 0.1; cp {self.path(name)} {{out}}; sleep 0.2; : {{h}}"
                return ["verify", "--exec", command, "--name", name, "--case", "stop", "--levels", "2", "--samples-per-level", "2", "--budget", "0", "--jobs", "2",
                        *place, "--format", "csv"]  # noqa: B023
            started = [subprocess.Popen([*space, PROGRAM, *arguments(name)], stdout=subprocess.PIPE, text=True)
                       for name in ("good", "bad")]
            texts = [process.communicate(timeout=60)[0] for process in started]
            self.assertEqual([process.returncode for process in started], [0, 1])
            for name, expected in (("good", ["yes"] * 4), ("bad", ["yes"] * 4)):
                again = rows(run(*arguments(name)).stdout)
                self.assertEqual([row["reused"] for row in again], expected)
                errors = [float(row["u_error"]) for row in again]
                self.assertTrue(all(error < 1e-12 if name == "good" else error > 0.1 for error in errors), errors)
            self.assertTrue(all(row["finished"] == "yes" for text in texts for row in rows(text)))


class Interrupted(ExecTest):
    def test_signals_leave_neither_processes_nor_folders(self):
        log = self.path("log")
        solver = self.script(f"echo $$ >> {log}\nsetsid sh -c 'echo $$ >> {log}; exec sleep 1000' &\nsleep 1000")
        for sign in (signal.SIGKILL, signal.SIGQUIT, signal.SIGXCPU, signal.SIGTERM):
            open(log, "w").close()
            with start("verify", "--exec", f"{solver} {{h}} {{out}}", *SHORT, "--jobs", "2", stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL) as process:
                self.wait_for(lambda: len(self.text_of("log").split()) == 4)
                process.send_signal(sign)
                process.wait(20)
            self.assertEqual(process.returncode, 130 if sign == signal.SIGTERM else -sign)
            for number in self.text_of("log").split():
                self.wait_for(lambda: self.is_gone(number))  # noqa: B023
            self.wait_for(lambda: not os.listdir(os.path.join(self.cache, "clackers", "programs")))

    def test_keeps_finished_runs_and_leaves_no_process(self):
        log = self.path("log")
        solver = self.script(f"[ $3 -lt 100 ] || {{ echo $$ >> {log}; sleep 1000; }}\n"
                             f"exec python3 {SOLVERS}/midpoint.py $1 $2 $4")
        with start("verify", "--exec", f"{solver} {{case}} {{h}} {{n}} {{out}}", *STOP, "--coarsest",
                   "0.1", "--levels", "3", "--samples-per-level", "2", "--jobs", "1", "--format", "json",
                   stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
            self.wait_for(lambda: os.path.exists(log) and self.text_of("log"))
            process.send_signal(signal.SIGINT)
            out, error = process.communicate(timeout=20)
        self.assertEqual(process.returncode, 130, error)
        self.assertIn(b"[interrupted]", error)
        for number in self.text_of("log").split():
            self.wait_for(lambda: self.is_gone(number))
        record = json.loads(out)
        self.assertTrue(record["interrupted"])
        subject, = record["cases"][0]["subjects"]
        self.assertEqual([run["finished"] for run in self.runs(subject)], [True])
        self.assertFalse([name for name in os.listdir(os.path.join(self.cache, "clackers", "programs"))
                          if name.startswith(".running")])


if __name__ == "__main__":
    unittest.main()
