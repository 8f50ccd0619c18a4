"""What callables and callers may do wrong, threads, fork, the end of the interpreter, and memory that does not grow."""
import copy
import gc
import os
import pickle
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

import numpy as np

import clackers
from solvers import leapfrog

FAST = dict(case="stop", levels=2, samples_per_level=1)
CASE = clackers.case("three-parameter")
T = np.linspace(0.0, CASE.end, 201)
U, V, _ = CASE.response(T)
HERE = os.path.dirname(os.path.abspath(__file__))


def raising(error):
    def solver(problem, h):
        raise error
    return solver


class Mute(Exception):
    def __str__(self):
        raise RuntimeError("no words")

    __repr__ = __str__


class Interrupting(Exception):
    def __str__(self):
        raise KeyboardInterrupt


class NoText(Exception):
    def __str__(self):
        return None


class Hostile:
    def __getattr__(self, name):
        raise ValueError(f"no {name}")

    def __repr__(self):
        raise RuntimeError("no repr")


def noted():
    error = ValueError("wrong sign")
    error.add_note("a note")
    return error


def endless(problem, h):
    return endless(problem, h)


class Exceptions(unittest.TestCase):
    """Of a callable: what is raised, and the sentence of the failed run."""

    ROWS = [
        (Mute(), f"{__name__}.Mute: <exception str() failed>"), (NoText(), f"{__name__}.NoText: <exception str() failed>"),
        (Interrupting(), f"{__name__}.Interrupting: <exception str() failed>"), (SystemExit(), "SystemExit"), (SystemExit(3), "SystemExit: 3"),
        (GeneratorExit(), "GeneratorExit"), (BaseException("base"), "BaseException: base"), (MemoryError(), "MemoryError"),
        (ExceptionGroup("both", [ValueError(), OSError()]), "ExceptionGroup: both (2 sub-exceptions)"),
        (OSError(2, "none", "\udcff"), "FileNotFoundError: [Errno 2] none: '\\udcff'"), (Exception("\ud800\0"), "Exception: ?\0"),
        (Exception("first\n\n second"), "Exception: first /  /  second"), (noted(), "ValueError: wrong sign"),
        (SyntaxError("bad", ("f", 1, 1, "text")), "SyntaxError: bad"), (Exception("x" * 10**6), "Exception: " + 389 * "x"),
    ]

    def test_each_is_a_failed_run_and_the_cause(self):
        for error, sentence in self.ROWS:
            with self.subTest(type(error).__name__):
                with self.assertRaises(clackers.SolverError) as caught:
                    clackers.verify(raising(error), **FAST)
                record = caught.exception.record
                self.assertIs(caught.exception.__cause__, error)
                self.assertEqual(set(record.table()["failure"]), {sentence})
                self.assertEqual(str(pickle.loads(pickle.dumps(record))), str(record))

    def test_keyboard_interrupt_ends_the_study(self):
        with self.assertRaises(clackers.Interrupted):
            clackers.verify(raising(KeyboardInterrupt()), **FAST)

    def test_hostile_results_are_failed_runs(self):
        class Interrupted(dict):
            def __contains__(self, key):
                raise KeyboardInterrupt

        for solver, words in ((endless, "RecursionError"), (lambda problem, h: Hostile(), "ValueError: no t"),
                              (lambda problem, h: {"t": Hostile(), "u": [1.0]}, "RuntimeError|ValueError|t = an object")):
            with self.assertRaisesRegex(clackers.SolverError, words):
                clackers.verify(solver, **FAST)
        with self.assertRaises(clackers.Interrupted):
            clackers.verify(lambda problem, h: Interrupted(), **FAST)


class Callers(unittest.TestCase):
    def test_texts_that_utf8_cannot_hold_are_refused(self):
        for bad in ("\udcff", "a\0b"):
            for call in (
                lambda: clackers.case(bad), lambda: clackers.case("stop", **{bad: 1}), lambda: clackers.case("piecewise", problem=bad),
                lambda: clackers.verify(bad), lambda: clackers.verify(leapfrog, name=bad), lambda: clackers.verify(leapfrog, expect=bad),
                lambda: clackers.verify(leapfrog, tolerances=bad), lambda: clackers.check(T, U, name=bad), lambda: clackers.explain(bad),
                lambda: clackers.check({bad: (T, U)}), lambda: clackers.check(T, U, columns=[bad]), lambda: clackers.check(T, U, case=bad),
                lambda: clackers.Record.from_json(bad), lambda: clackers.catalogue(bad), lambda: CASE.sensitivity(bad, [0.0]),
            ):
                with self.assertRaises(clackers.InputError) as caught:
                    call()
                self.assertEqual(caught.exception.code, "not-text")

    def test_a_path_is_any_bytes_but_nul(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(os.fsdecode(os.fsencode(folder) + b"/\xff.csv"))
            np.savetxt(path, np.column_stack([T, U]), delimiter=",", header="t,u1,u2", comments="")
            self.assertEqual(clackers.check(path, tolerance=1e-9).verdict, "agrees")
            with self.assertRaises(clackers.InputError):
                clackers.check(f"{path}\0.csv")

    def test_a_value_that_cannot_be_shown_is_refused(self):
        class Shy:
            def __repr__(self):
                raise RuntimeError("no repr")

        with self.assertRaisesRegex(clackers.InputError, "eta = an object of type Shy"):
            clackers.case("stop", eta=Shy())

    @np.errstate(over="ignore")
    def test_huge_and_tiny_numbers_raise_or_are_judged(self):
        for scale in (1e308, 1e-308, 5e-324):
            for call in (lambda: clackers.check(T, scale * U), lambda: clackers.check(scale * T, U), lambda: CASE.response(scale * T),
                         lambda: clackers.verify(lambda problem, h: (T, scale * U), case="three-parameter", steps=[0.1, 0.2]),
                         lambda: clackers.verify("rk4", case="stop", coarsest=scale), lambda: CASE.spectrum(3, scale)):
                try:
                    call()
                except clackers.Error as error:
                    self.assertTrue(error.code)

    def test_cases_and_records_are_copied_and_sent_to_other_processes(self):
        case = clackers.case("stop", threshold=0.2, eta=0.5)
        record = clackers.check(T, U)
        for again in (copy.deepcopy(case), pickle.loads(pickle.dumps(case))):
            self.assertEqual((repr(again), again.indicators), (repr(case), case.indicators))
        for again in (copy.deepcopy(record), pickle.loads(pickle.dumps(record))):
            self.assertEqual(again.to_json(), record.to_json())

    def test_another_interpreter_is_refused_in_words(self):
        import _xxsubinterpreters as interpreters

        other = interpreters.create()
        self.addCleanup(interpreters.destroy, other)
        with self.assertRaisesRegex(interpreters.RunFailedError, "ImportError.*one interpreter per process"):
            interpreters.run_string(other, f"import sys; sys.path[:] = {sys.path!r}\nimport clackers")


class Threads(unittest.TestCase):
    def test_all_functions_at_once_have_the_results_of_one_thread(self):
        t = np.linspace(0.0, CASE.end, 20_001)
        calls = [
            lambda: CASE.response(t).u.sum(), lambda: clackers.check(T, U, V).to_json().split('"cases"')[1],
            lambda: str(clackers.verify(leapfrog, "rk4", **FAST).table()["u_error"]), lambda: CASE.impacts().t.sum(),
            lambda: CASE.energies(T)["total"].sum(), lambda: repr(clackers.catalogue("cases")),
        ]
        expected = [call() for call in calls]
        found = {}

        def work(k):
            for i in range(len(calls)):
                place = (i + k) % len(calls)
                found[k, place] = calls[place]()

        threads = [threading.Thread(target=work, args=(k,)) for k in range(6)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(found), 36)
        for (_, place), result in found.items():
            self.assertEqual(result, expected[place])

    def test_a_fork_works_after_and_during_studies_and_in_callables(self):
        def errors():
            return str(clackers.verify(leapfrog, "rk4", **FAST).table()["u_error"])

        def in_child(call):
            child = os.fork()
            if child == 0:
                code = 1
                try:
                    code = 0 if call() else 1
                finally:
                    os._exit(code)
            return os.waitpid(child, 0)[1]

        expected = errors()
        self.assertEqual(in_child(lambda: errors() == expected), 0)
        codes = []

        def forking(problem, h):
            codes.append(in_child(lambda: np.array_equal(CASE.response(T).u, U)))
            return leapfrog(problem, h)

        clackers.verify(forking, **FAST)
        self.assertEqual(codes, [0, 0])
        thread = threading.Thread(target=lambda: clackers.verify(leapfrog, case="stop", levels=4))
        thread.start()
        self.assertEqual(in_child(lambda: errors() == expected), 0)
        thread.join()

    def test_the_interpreter_ends_in_silence_while_daemon_threads_study(self):
        script = (
            "import clackers, sys, threading, time\nfrom solvers import leapfrog\n"
            "def prints(problem, h):\n    print(end='', file=sys.stderr, flush=True)\n    return leapfrog(problem, h)\n"
            "for solver in (leapfrog, prints, 'rk4'):\n"
            "    threading.Thread(target=lambda: clackers.verify(solver, case='stop', coarsest=0.01), daemon=True).start()\n"
            "time.sleep({})\n"
        )
        runs = [subprocess.Popen([sys.executable, "-B", "-c", script.format(0.05 * k)], stdout=subprocess.PIPE,
                                 stderr=subprocess.PIPE, text=True, cwd=HERE) for k in range(int(os.environ.get("CLACKERS_ENDS", 4)))]
        self.assertEqual({(*run.communicate(timeout=250), run.returncode) for run in runs}, {("", "", 0)})


class Interrupts(unittest.TestCase):
    def test_ctrl_c_ends_check_and_compare(self):
        t = np.linspace(0.0, CASE.end, 2_000_001)
        histories = [(t, *CASE.response(t)[:2])] * 4
        for call in (lambda: clackers.check(histories, step=[0.4, 0.3, 0.2, 0.1]), lambda: clackers.compare(histories, histories)):
            threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
            start = time.monotonic()
            with self.assertRaises(KeyboardInterrupt):
                while True:
                    call()
            self.assertLess(time.monotonic() - start, 20.0)


class Memory(unittest.TestCase):
    MOST = 2 << 20  # bytes; a kilobyte a call is 10 MB
    CALLS = int(os.environ.get("CLACKERS_CALLS", 0))  # of all; otherwise those of the table

    def test_no_call_leaves_memory_behind(self):
        def refused():
            try:
                clackers.case("stop", eta=2)
            except ValueError:
                pass

        def failing():
            try:
                clackers.verify(raising(ValueError("no")), case="stop", steps=[1.0])
            except ValueError:
                pass

        t, y = T[:11], np.zeros(4)
        u, record = U[:11], clackers.check(T, U)
        for call, calls in (
            (lambda: CASE.response(t), 10_000), (lambda: CASE.problem.rhs(0.0, y), 10_000), (refused, 10_000), (failing, 100),
            (lambda: clackers.case("stop"), 2000), (lambda: CASE.energies(t), 1000), (lambda: CASE.impact_table(), 1000),
            (lambda: clackers.explain("proper"), 1000), (lambda: clackers.check(T, U), 200), (lambda: clackers.compare((t, u), (t, u)), 200),
            (lambda: clackers.verify(leapfrog, case="stop", steps=[1.0, 0.5]), 100), (lambda: clackers.verify("rk4", **FAST), 100),
            (lambda: (str(record), record.table(), clackers.Record.from_json(record.to_json())), 100),
        ):
            calls = self.CALLS or calls
            for _ in range(max(calls // 10, 20)):
                call()
            before = resident()
            for _ in range(calls):
                call()
            self.assertLess(resident() - before, self.MOST)


def resident():
    gc.collect()
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


if __name__ == "__main__":
    unittest.main()
