"""Ctrl-C in long work, other threads beside it, and the errors' behaviour as Python objects."""
import copy
import pickle
import signal
import subprocess
import sys
import textwrap
import threading
import time
import unittest

import numpy as np

import clackers

# Seconds of work each, when nothing interrupts.
LONG = {
    "impacts": "clackers.case('three-parameter', a_t=5e7).impacts(first=1, last=20_000_000)",
    "energies": "case.energies(numpy.linspace(0, case.end, 20_000_000))",
    "error_bound": "case.error_bound(numpy.linspace(0, case.end, 100_000_000))",
}


class Interrupts(unittest.TestCase):
    def test_ctrl_c_ends_long_work_with_keyboard_interrupt(self):
        for name in ("energies", "impacts", "error_bound"):
            program = textwrap.dedent(f"""
                import numpy, clackers, time
                case = clackers.case("three-parameter")
                print("ready", flush=True)
                try:
                    {LONG[name]}
                except KeyboardInterrupt:
                    print("interrupted", flush=True)
            """)
            with self.subTest(name), subprocess.Popen([sys.executable, "-B", "-c", program], stdout=subprocess.PIPE, text=True) as run:
                self.assertEqual(run.stdout.readline(), "ready\n")
                time.sleep(1.5)
                start = time.monotonic()
                run.send_signal(signal.SIGINT)
                self.assertEqual(run.stdout.read(), "interrupted\n")
                self.assertEqual(run.wait(), 0)
                self.assertLess(time.monotonic() - start, 5.0)  # 50 ms on a machine at rest

    def test_handler_of_a_signal_runs_during_a_response(self):
        case = clackers.case("three-parameter")
        t = np.linspace(0.0, case.end, 10_000_000)

        def stop(number, frame):
            raise TimeoutError

        before = signal.signal(signal.SIGALRM, stop)
        try:
            signal.setitimer(signal.ITIMER_REAL, 0.05)
            with self.assertRaises(TimeoutError):
                while True:
                    case.response(t)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0.0)
            signal.signal(signal.SIGALRM, before)

    def test_other_threads_run_during_a_response(self):
        case = clackers.case("three-parameter")
        t = np.linspace(0.0, case.end, 5_000_000)
        counts, done = [0], threading.Event()

        def count():
            while not done.is_set():
                counts[0] += 1

        thread = threading.Thread(target=count)
        thread.start()
        try:
            before = counts[0]
            # One call into the module: with the GIL held the count would stand still.
            clackers._core.response(case._core, t, "right", None)
            during = counts[0] - before
        finally:
            done.set()
            thread.join()
        self.assertGreater(during, 100)

    def test_results_of_threads_are_those_of_one(self):
        case = clackers.case("three-parameter")
        t = np.linspace(0.0, case.end, 500_001)
        expected = case.response(t).v
        results = [None] * 4

        def work(k):
            results[k] = case.response(t).v

        threads = [threading.Thread(target=work, args=(k,)) for k in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for result in results:
            np.testing.assert_array_equal(result, expected)


class Errors(unittest.TestCase):
    def test_each_error_is_the_python_error_of_its_kind(self):
        self.assertTrue(issubclass(clackers.InputError, ValueError))
        self.assertTrue(issubclass(clackers.FileError, OSError))
        self.assertTrue(issubclass(clackers.Error, RuntimeError))
        for kind in (clackers.InputError, clackers.FileError):
            self.assertTrue(issubclass(kind, clackers.Error))

    def test_text_and_code_survive_copies(self):
        for kind in (clackers.Error, clackers.InputError, clackers.FileError):
            error = kind("a sentence.", "some-code")
            for again in (error, copy.copy(error), pickle.loads(pickle.dumps(error))):
                self.assertEqual((str(again), again.code, type(again)), ("a sentence.", "some-code", kind))


if __name__ == "__main__":
    unittest.main()
