"""clackers.verify on methods and callables."""
import functools
import os
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
import unittest.mock

import numpy as np

import clackers
from solvers import event_driven, leapfrog, scipy_flights

FAST = dict(case="stop", levels=3, samples_per_level=1)


def codes(record):
    return [cause.code for cause in record.diagnoses]


class Methods(unittest.TestCase):
    def test_without_subjects_the_default_panel_is_judged(self):
        record = clackers.verify(levels=2, samples_per_level=1)
        self.assertIn("rk4", record)
        self.assertGreater(len(record), 5)

    def test_a_method_is_judged_as_the_command_judges_it(self):
        record = clackers.verify("newmark+reversal", "rk4", levels=4, case="stop", eta=0.5)
        self.assertEqual(list(record), ["newmark+reversal", "rk4"])
        self.assertEqual(record["rk4"].verdict, "agrees")
        self.assertAlmostEqual(record["rk4"].order, 4.0, delta=0.2)

    def test_cases_have_parameters_of_their_own(self):
        record = clackers.verify("rk4", case=[clackers.case("stop", eta=0.5), clackers.case("three-parameter", N=3)],
                                 levels=2, samples_per_level=1)
        self.assertEqual(record.cases, ("stop", "three-parameter"))
        self.assertEqual(record["stop", "rk4"].case, "stop")
        self.assertIn("N = 3", str(record))

    def test_progress_reaches_one(self):
        shares = []
        clackers.verify("rk4", progress=shares.append, **FAST)
        self.assertEqual(shares[-1], 1.0)

    def test_the_line_that_reproduces_it(self):
        record = clackers.verify("rk4", case="stop", levels=2, samples_per_level=1, eta=0.5)
        self.assertEqual(record.provenance["command"],
                         "clackers.verify('rk4', case='stop', levels=2, samples_per_level=1, eta=0.5)")
        again = eval(record.provenance["command"])
        np.testing.assert_array_equal(again.table()["u_error"], record.table()["u_error"])


class Callables(unittest.TestCase):
    def test_a_leapfrog_with_impacts_at_step_ends(self):
        record = clackers.verify(leapfrog, expect="irregular:1")
        self.assertEqual(record.subject.kind, "callable")
        self.assertEqual(record.subject.name, "leapfrog")
        self.assertIn(record.behaviour, ("irregular", "proper"))
        self.assertAlmostEqual(record.order, 1.0, delta=0.2)
        self.assertEqual(record.verdict, "agrees")

    def test_a_wrong_restitution_is_found_with_its_value(self):
        wrong = functools.partial(event_driven, restitution=0.9)
        record = clackers.verify(wrong, steps=[0.05, 0.04, 0.025], expect="exact", case="three-parameter", N=2)
        self.assertEqual(record.verdict, "disagrees")
        self.assertEqual(codes(record)[0], "restitution-differs")
        self.assertAlmostEqual(record.diagnoses[0].value, 0.9, delta=1e-6)
        self.assertIn("[restitution-differs]", str(record))

    def test_a_wrong_mass_is_found_with_its_value(self):
        record = clackers.verify(functools.partial(event_driven, mass=1.1), steps=[0.05, 0.04, 0.025], expect="exact")
        self.assertEqual(record.verdict, "disagrees")
        self.assertIn("mass-ratio-differs", codes(record))

    def test_rk45_of_scipy_converges_with_its_tolerance(self):
        record = clackers.verify(scipy_flights, tolerances="1e-4:1e-9", expect="proper:1")
        self.assertEqual(record.behaviour, "proper")
        self.assertEqual(record.verdict, "agrees")
        self.assertEqual(record["scipy_flights"].runs["impacts_matched"].tolist(), [6] * 6)

    def test_every_form_of_a_result_gives_the_same_errors(self):
        t, u, v = None, None, None

        class Result:
            def __init__(self, t, u, v):
                self.t, self.u, self.v = t, u, v

        forms = {
            "tuple": lambda t, u, v: (t, u, v),
            "transposed": lambda t, u, v: (t, u.T, v.T),
            "lists": lambda t, u, v: (t.tolist(), u.tolist(), v.tolist()),
            "fortran": lambda t, u, v: (t, np.asfortranarray(u), np.asfortranarray(v)),
            "strided": lambda t, u, v: (t, np.repeat(u, 2, axis=0)[::2], np.repeat(v, 2, axis=1)[:, ::2]),
            "read-only": lambda t, u, v: (locked(t), locked(u), locked(v)),
            "swapped": lambda t, u, v: (t.astype(">f8"), u.astype(">f8"), v.astype(">f8")),
            "mapping": lambda t, u, v: {"t": t, "u": u, "v": v},
            "object": lambda t, u, v: Result(t, u, v),
            "y": lambda t, u, v: (t, np.hstack([u, v])),
            "y of solve_ivp": lambda t, u, v: {"t": t, "y": np.hstack([u, v]).T, "t_events": None},
        }

        def locked(array):
            array = array.copy()
            array.flags.writeable = False
            return array

        def solver_of(form):
            return lambda problem, h: forms[form](*event_driven(problem, h))

        solvers = [solver_of(form) for form in forms]
        record = clackers.verify(*solvers, name=list(forms), steps=[0.1, 0.07])
        expected = record["tuple"].runs
        for form in forms:
            with self.subTest(form):
                np.testing.assert_array_equal(record[form].runs["u_error"], expected["u_error"])
                np.testing.assert_array_equal(record[form].runs["v_error"], expected["v_error"])

    def test_single_precision_is_converted(self):
        def solver(problem, h):
            return tuple(np.float32(array) for array in leapfrog(problem, h))

        record = clackers.verify(solver, **FAST)
        self.assertTrue(all(finished == "yes" for finished in record.table()["finished"]))

    def test_one_mass_takes_arrays_of_one_dimension(self):
        def solver(problem, h):
            t, u, v = leapfrog(problem, h)
            return t, u[:, 0], v[:, 0]

        record = clackers.verify(solver, **FAST)
        self.assertTrue(all(finished == "yes" for finished in record.table()["finished"]))

    def test_impacts_are_taken_as_reported(self):
        def solver(problem, h):
            t, u, v = event_driven(problem, h)
            times = t[1:][np.diff(t) == 0]
            return {"t": t, "u": u, "v": v, "impacts": times}

        record = clackers.verify(solver, steps=[0.1, 0.07])
        self.assertEqual(record.table()["impacts_matched"].tolist(), [6, 6])

    def test_no_impacts_reported_are_missed_ones(self):
        def solver(problem, h):
            t, u, v = event_driven(problem, h)
            return {"t": t, "u": u, "v": v, "impacts": []}

        record = clackers.verify(solver, steps=[0.1, 0.07])
        self.assertEqual(record.table()["impacts_found"].tolist(), [0, 0])

    def test_methods_stand_beside_callables(self):
        record = clackers.verify("rk4", leapfrog, **FAST)
        self.assertEqual([subject.kind for subject in record.subjects], ["method", "callable"])

    def test_it_is_called_in_the_thread_of_the_caller_one_at_a_time(self):
        seen = []

        def solver(problem, h):
            seen.append(threading.get_ident())
            return leapfrog(problem, h)

        clackers.verify(solver, jobs=4, **FAST)
        self.assertEqual(set(seen), {threading.get_ident()})

    def test_the_problem_of_a_case_is_one_object(self):
        problems = set()

        def solver(problem, h):
            problems.add(problem)
            return leapfrog(problem, h)

        clackers.verify(solver, **FAST)
        self.assertEqual(len(problems), 1)

    def test_inside_a_callable_another_study_can_run(self):
        inner = []

        def solver(problem, h):
            inner.append(clackers.verify(leapfrog, **FAST).verdict)
            return leapfrog(problem, h)

        clackers.verify(solver, **FAST)
        self.assertEqual(len(inner), 3)

    def test_from_another_thread(self):
        records = []
        threads = [threading.Thread(target=lambda: records.append(clackers.verify(leapfrog, **FAST))) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len({str(record.table()["u_error"]) for record in records}), 1)

    def test_arrays_are_released(self):
        import gc
        import weakref


        alive = []

        def solver(problem, h):
            t, u, v = leapfrog(problem, h)
            alive.append(weakref.ref(u))
            return t, u, v

        clackers.verify(solver, **FAST)
        gc.collect()
        self.assertEqual([array() for array in alive], [None] * 3)

    def test_the_five_lines_end_in_a_verdict_with_its_diagnosis(self):
        def my_solver(problem, h):
            return event_driven(problem, h, restitution=0.5)

        text = str(clackers.verify(my_solver, case="three-parameter", N=2))
        self.assertIn("Stagnates", text)
        self.assertIn("Verdict: disagrees.", text)
        self.assertIn("[restitution-differs]", text)


class Programs(unittest.TestCase):
    """Of others, as of the command's --exec."""

    def setUp(self):
        self.folder = self.enterContext(tempfile.TemporaryDirectory())
        t = np.linspace(0.0, 20.0, 401)
        u, v, _ = clackers.case("stop").response(t)
        np.savetxt(os.path.join(self.folder, "exact.csv"), np.column_stack([t, u, v]), delimiter=",", header="t,u1,v1", comments="")

    def program(self, command, **options):
        return clackers.Program(command.replace("exact", os.path.join(self.folder, "exact")), work=self.folder, **options)

    def test_stand_beside_methods_and_callables_in_their_order(self):
        exact = self.program("cp exact.csv {out}; : {h}")
        record = clackers.verify("rk4", exact, leapfrog, name=["copy", "leapfrog"], **FAST, expect="exact")
        self.assertEqual([(each.name, each.kind) for each in record.subjects],
                         [("rk4", "method"), ("copy", "program"), ("leapfrog", "callable")])
        self.assertLess(record["copy"].levels["u_error"][0], 1e-12)

    def test_are_named_for_their_file_and_take_steps_and_tolerances(self):
        record = clackers.verify(self.program("/bin/cp exact.csv {out}; : {h}"), case="stop", steps=[0.1, 0.3])
        self.assertEqual((record.subject.name, list(record.subject.runs["step"])), ("exact", [0.3, 0.1]))
        record = clackers.verify(self.program("cp exact.csv {out}; : {tolerance}"), case="stop", tolerances=[1e-3, 1e-5])
        self.assertEqual(list(record.subject.runs["tolerance"]), [1e-3, 1e-5])

    def test_that_fail_are_named_with_what_they_printed(self):
        with self.assertRaises(clackers.SolverError) as caught:
            clackers.verify(self.program("echo no licence >&2; exit 3; : {h}"), **FAST)
        self.assertRegex(str(caught.exception), r"exit status 3\..*no licence")
        with self.assertRaises(clackers.SolverError) as caught:
            clackers.verify(self.program("sleep 60; : {h}", timeout=0.1), **FAST)
        self.assertEqual(caught.exception.code, "program-timeout")

    def test_runs_are_reused_unless_the_environment_differs(self):
        for word, fresh, expected in (("a", False, "no"), ("a", False, "yes"), ("b", False, "no"), ("b", True, "no")):
            with unittest.mock.patch.dict(os.environ, WHICH=word):
                program = self.program("cp exact.csv {out}; : {h}", environment=["WHICH"], fresh=fresh)
                self.assertEqual(set(clackers.verify(program, **FAST).subject.runs["reused"]), {expected})

    def test_wrong_values_are_refused(self):
        for program, code in ((clackers.Program(3), "not-text"), (clackers.Program("solver"), "bad-syntax"),
                              (clackers.Program("solver {h}", timeout=-1), "out-of-range"),
                              (clackers.Program("solver {h}", environment=[3]), "not-text")):
            with self.subTest(program), self.assertRaises(clackers.InputError) as caught:
                clackers.verify(program, **FAST)
            self.assertEqual(caught.exception.code, code)


def shapes(problem, h):
    t, u, v = leapfrog(problem, h)
    return t, np.zeros((len(t), 3))


def at_small_steps(problem, h):
    if h < 0.3:
        raise OverflowError("too many")
    return leapfrog(problem, h)


def returns(value):
    return lambda problem, h: value


def with_arrays(change):
    def solver(problem, h):
        return change(*leapfrog(problem, h))
    return solver


def nan_in_the_middle(t, u, v):
    u[len(t) // 2] = np.nan
    return t, u, v


def raising(error):
    def solver(problem, h):
        raise error
    return solver


class Failures(unittest.TestCase):
    """A table: what the solver does, the code of its runs, and words of the message."""

    BAD = {
        "None": (returns(None), "callable-output", "None; allowed: (t, u)"),
        "a text": (returns("done"), "callable-output", "a text"),
        "a number": (returns(3.0), "callable-output", "float"),
        "one array": (with_arrays(lambda t, u, v: u), "callable-output", "array of float64"),
        "five arrays": (with_arrays(lambda t, u, v: (t, u, v, v, v)), "callable-output", "a tuple of 5"),
        "wrong shape": (shapes, "callable-output", "masses"),
        "three dimensions": (with_arrays(lambda t, u, v: (t, u[:, :, None])), "callable-output", "shape ("),
        "0-d": (with_arrays(lambda t, u, v: (t, np.array(1.0))), "callable-output", "shape ()"),
        "times of two dimensions": (with_arrays(lambda t, u, v: (u, u)), "callable-output", "t = "),
        "other length": (with_arrays(lambda t, u, v: (t, u[:-1])), "callable-output", "times"),
        "complex": (with_arrays(lambda t, u, v: (t, u + 0j)), "callable-output", "complex128"),
        "objects": (with_arrays(lambda t, u, v: (t, u.astype(object))), "callable-output", "object"),
        "strings": (with_arrays(lambda t, u, v: (t, u.astype(str))), "callable-output", "real numbers"),
        "masked": (with_arrays(lambda t, u, v: (t, np.ma.array(u))), "callable-output", "masked"),
        "ragged": (with_arrays(lambda t, u, v: ([0.0, 1.0], [[0.0, 1.0], [2.0]])), "callable-output", "equal length"),
        "wrong velocities": (with_arrays(lambda t, u, v: (t, u, v[:, :1])), "callable-output", "v = "),
        "a mapping without u": (with_arrays(lambda t, u, v: {"t": t}), "callable-output", "dict"),
        "an attribute that raises": (returns(type("R", (), {"t": property(lambda self: 1 / 0)})()), "callable-output",
                                     "ZeroDivisionError"),
        "bad impacts": (with_arrays(lambda t, u, v: dict(t=t, u=u, impacts="none")), "callable-output",
                           "impacts"),
        "too few states": (with_arrays(lambda t, u, v: (t[:1], u[:1])), "too-short", "two"),
        "times backwards": (with_arrays(lambda t, u, v: (t[::-1], u)), "not-sorted", "row"),
        "NaN in the middle": (with_arrays(nan_in_the_middle), "not-finite", "u1"),
        "raises": (raising(ValueError("no solution")), "callable-failed", "ValueError: no solution"),
        "calls sys.exit": (lambda problem, h: sys.exit("fatal"), "callable-failed", "SystemExit: fatal"),
        "wrong signature": (lambda problem: None, "callable-failed", "TypeError"),
        "stops an iterator": (raising(StopIteration()), "callable-failed", "StopIteration"),
        "raises an error of ours": (raising(clackers.InputError("mine", "out-of-range")), "callable-failed", "mine"),
    }

    def test_each_is_a_failed_run_with_its_code(self):
        for what, (solver, code, words) in self.BAD.items():
            with self.subTest(what):
                with self.assertRaises(clackers.SolverError) as caught:
                    clackers.verify(solver, case="three-parameter", levels=2, samples_per_level=1)
                self.assertEqual(caught.exception.code, code)
                self.assertIn(words, str(caught.exception))
                self.assertIsInstance(caught.exception, ValueError)
                self.assertEqual(set(caught.exception.record.table()["failure_code"]), {code})

    def test_the_first_exception_is_the_cause(self):
        error = ValueError("no solution")
        with self.assertRaises(clackers.SolverError) as caught:
            clackers.verify(raising(error), **FAST)
        self.assertIs(caught.exception.__cause__, error)

    def test_one_solver_that_never_finishes_is_named_beside_others(self):
        error = ValueError("no solution")
        with self.assertRaisesRegex(clackers.SolverError, "^verify: broken: every run failed.*no solution") as caught:
            clackers.verify("rk4", leapfrog, raising(error), name=["good", "broken"], **FAST)
        self.assertIs(caught.exception.__cause__, error)
        self.assertEqual([each.name for each in caught.exception.record.subjects], ["rk4", "good", "broken"])

    def test_the_end_of_the_traceback_stands_in_the_record(self):
        with self.assertRaises(clackers.SolverError) as caught:
            clackers.verify(raising(ValueError("no solution")), **FAST)
        self.assertIn("in solver / raise error", str(caught.exception.record).replace("\n", " "))

    def test_runs_that_fail_at_small_steps_alone_are_failed_rows(self):
        record = clackers.verify(at_small_steps, case="stop", levels=4, samples_per_level=1)
        self.assertEqual(list(record.table()["finished"]).count("no"), 3)
        self.assertEqual(list(record.table()["finished"]).count("yes"), 1)
        self.assertIn("OverflowError: too many", str(record).replace("\n", " "))

    def test_mistakes_are_not_repeated_at_every_step(self):
        calls = []

        def solver(problem, h):
            calls.append(h)
            return problem.mass

        with self.assertRaises(clackers.SolverError):
            clackers.verify(solver, case="stop", levels=6, jobs=1)
        self.assertEqual(len(calls), 3)

    def test_what_a_callable_prints_goes_where_it_printed(self):
        script = ("import clackers\nfrom solvers import leapfrog\n"
                  "def solver(problem, h):\n    print('step', h)\n    return leapfrog(problem, h)\n"
                  "clackers.verify(solver, case='stop', levels=2, samples_per_level=1)\n")
        done = run(script)
        self.assertEqual(done.stdout.count("step"), 2)
        self.assertEqual(done.returncode, 0)


class Refusals(unittest.TestCase):
    """A table: arguments, and the code of the refusal with words of it."""

    BAD = {
        "unknown method": (("newmrak",), {}, "unknown-name", "newmark"),
        "unknown case": (("rk4",), {"case": "stopp"}, "unknown-name", "stop"),
        "unknown parameter": (("rk4",), {"case": "stop", "mass": 3}, "unknown-name", "mass"),
        "a parameter that is text": (("rk4",), {"case": "stop", "eta": "1"}, "not-a-number", "eta"),
        "case of another type": (("rk4",), {"case": 3}, "not-text", "case"),
        "no case": (("rk4",), {"case": []}, "not-text", "case"),
        "parameters beside a case": (("rk4",), {"case": clackers.case("stop"), "eta": 1}, "bad-syntax", "eta"),
        "a subject of another type": ((3,), {}, "out-of-range", "callable"),
        "two of one name": ((leapfrog, leapfrog), {}, "bad-syntax", "name"),
        "steps and tolerances": ((leapfrog,), {"steps": [1], "tolerances": [1]}, "bad-syntax", "one of them"),
        "steps of methods": (("rk4", leapfrog), {"steps": [0.1]}, "bad-syntax", "only for callables"),
        "steps without a callable": (("rk4",), {"steps": [0.1]}, "bad-syntax", "steps"),
        "a step twice": ((leapfrog,), {"steps": [0.1, 0.1]}, "not-sorted", "steps"),
        "a step of 0": ((leapfrog,), {"steps": [0.0]}, "step-not-positive", "0"),
        "no steps": ((leapfrog,), {"steps": []}, "wrong-size", "steps"),
        "a step that is NaN": ((leapfrog,), {"steps": [float("nan")]}, "not-a-number", "nan"),
        "tolerances in no form": ((leapfrog,), {"tolerances": "1e-3"}, "", ""),
        "levels of 0": (("rk4",), {"levels": 0}, "out-of-range", "levels"),
        "levels that are no whole number": (("rk4",), {"levels": 2.5}, "not-whole", "levels"),
        "coarsest step below 0": (("rk4",), {"coarsest": -1.0}, "step-not-positive", "-1"),
        "jobs of 0": (("rk4",), {"jobs": 0}, "out-of-range", "jobs"),
        "budget below 0": (("rk4",), {"budget": -1}, "out-of-range", "budget"),
        "an unknown behaviour": ((leapfrog,), {"expect": "good"}, "", "good"),
        "an expectation of methods": (("rk4",), {"expect": "proper:4"}, "bad-syntax", "expect"),
        "names of others": ((leapfrog,), {"name": ["a", "b"]}, "wrong-size", "name"),
        "progress of another type": (("rk4",), {"progress": 3}, "out-of-range", "progress"),
    }

    def test_each_is_refused_before_any_work(self):
        for what, (subjects, options, code, words) in self.BAD.items():
            if what == "tolerances in no form":
                options = {"tolerances": "1e-3;1e-4"}
            with self.subTest(what):
                with self.assertRaises(clackers.InputError) as caught:
                    clackers.verify(*subjects, **options)
                if code:
                    self.assertEqual(caught.exception.code, code)
                self.assertIn(words, str(caught.exception))

    def test_an_exception_of_progress_ends_the_study(self):
        def progress(share):
            raise RuntimeError("enough")

        with self.assertRaisesRegex(RuntimeError, "enough"):
            clackers.verify(progress=progress)


def run(script, timeout=60):
    return subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=timeout,
                          cwd=os.path.dirname(os.path.abspath(__file__)))


INTERRUPT = """
import os, signal, threading, time
import clackers
from solvers import leapfrog
threading.Timer(1.0, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
start = time.time()
try:
    {study}
except KeyboardInterrupt as error:
    record = error.record
    print(type(error).__name__, time.time() - start < 3.0, record.interrupted, record.verdict, len(record.table().rows) > 0)
"""


class Interrupts(unittest.TestCase):
    EXPECTED = "Interrupted True True interrupted True\n"

    def test_in_a_slow_callable(self):
        done = run("import time\ndef slow(problem, h):\n    time.sleep(0.3)\n    return leapfrog(problem, h)\n"
                   + INTERRUPT.format(study="clackers.verify(slow, case='stop')"))
        self.assertEqual(done.stdout, self.EXPECTED, done.stderr)

    def test_in_the_library(self):
        done = run(INTERRUPT.format(study="clackers.verify('rk4', 'newmark', case='stop', coarsest=0.001, levels=12)"))
        self.assertEqual(done.stdout, self.EXPECTED, done.stderr)

    def test_one_that_the_callable_raises(self):
        calls = []

        def solver(problem, h):
            calls.append(h)
            if len(calls) == 3:
                raise KeyboardInterrupt
            return leapfrog(problem, h)

        with self.assertRaises(clackers.Interrupted) as caught:
            clackers.verify(solver, case="stop", levels=4, samples_per_level=1, jobs=1)
        self.assertEqual(len(calls), 3)
        self.assertTrue(caught.exception.record.interrupted)
        self.assertEqual(list(caught.exception.record.table()["finished"]), ["yes", "yes"])

    def test_one_inside_a_study_inside_a_callable_ends_both(self):
        def inner(problem, h):
            raise KeyboardInterrupt

        def outer(problem, h):
            return clackers.verify(inner, **FAST)

        with self.assertRaises(clackers.Interrupted):
            clackers.verify(outer, **FAST)

    def test_a_handler_of_another_kind_gets_its_exception_through(self):
        done = run("import clackers, os, signal, threading\n"
                   "def handler(*_):\n    raise TimeoutError('late')\n"
                   "signal.signal(signal.SIGALRM, handler)\nsignal.setitimer(signal.ITIMER_REAL, 0.5)\n"
                   "try:\n    clackers.verify('rk4', case='stop', coarsest=0.001, levels=12)\n"
                   "except TimeoutError as error:\n    print(error)\n")
        self.assertEqual(done.stdout, "late\n", done.stderr)

    def test_the_interpreter_ends_well_while_a_daemon_thread_studies(self):
        done = run("import clackers, threading, time\nfrom solvers import leapfrog\n"
                   "threading.Thread(target=lambda: clackers.verify(leapfrog), daemon=True).start()\ntime.sleep(0.5)\n")
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_the_interpreter_ends_well_while_a_callable_of_a_daemon_thread_does_not_end(self):
        done = run("import clackers, threading, time\ndef endless(problem, h):\n    while True:\n        pass\n"
                   "threading.Thread(target=lambda: clackers.verify(endless), daemon=True).start()\ntime.sleep(0.5)\n")
        self.assertEqual((done.returncode, done.stderr), (0, ""))


if __name__ == "__main__":
    unittest.main()
