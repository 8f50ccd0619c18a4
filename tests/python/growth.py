"""Many calls of every public function leave the process as large as it was: growth.py [CALLS], 10000 by default, fewer
of slow ones."""
import ctypes
import gc
import os
import sys
import tempfile
import time

import matplotlib
import numpy as np

import clackers

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402  the backend is chosen first

ROUNDS = 3
MOST = 40  # bytes a call in the best round: an array or an object that stays is larger
OF_A_FIGURE = 20_000  # bytes; a figure of matplotlib with five lines leaves 5,000 to 15,000 by itself
LONGEST = 0.4  # of a round [s]; a slow function leaves more where it leaks, so that fewer calls show it
FEWEST = 10  # calls of a round
NOISE = 30_000  # bytes of a round

CASE = clackers.case("stop")
PAIR = clackers.case("three-parameter")
BARS = clackers.case("bar-wall")
T = np.linspace(0.0, CASE.end, 50)
Y = CASE.problem.y0
HISTORY = (T, *CASE.response(T))
SHORT = {"case": "stop", "levels": 1, "samples_per_level": 1}
RECORD = clackers.verify("rk4", case="stop", levels=3, samples_per_level=2)
TABLE = RECORD.table()
FOLDER = tempfile.TemporaryDirectory()
PATH = os.path.join(FOLDER.name, "record.json")
FINE = np.linspace(0.0, CASE.end, 2001)


def refused(call):
    def refuse():
        try:
            call()
        except clackers.Error:
            return
        raise AssertionError("nothing is refused")

    return refuse


def solver(problem, h):
    t = np.linspace(0.0, problem.end, round(problem.end / h) + 1)
    return t, *CASE.response(t)


def drawn(draw):
    def call():
        draw()
        pyplot.close("all")

    return call


CALLS = {
    "case": lambda: clackers.case("stop", eta=0.5), "admissibility": lambda: clackers.admissibility(9.0, 0.5),
    "refused case": refused(lambda: clackers.case("stpo")), "refused value": refused(lambda: CASE.response("x")),
    "explain": lambda: clackers.explain("irregular"), "catalogue": lambda: clackers.catalogue("cases"),
    "Case.response": lambda: CASE.response(T), "Case.envelope": lambda: CASE.envelope(T),
    "Case.error_bound": lambda: CASE.error_bound(T), "Case.impact_count": lambda: CASE.impact_count(1.0),
    "Case.impacts": lambda: CASE.impacts(1, 5), "Case.impact_table": CASE.impact_table, "Case.collisions": CASE.collisions,
    "Case.energies": lambda: CASE.energies(T), "Case.points": lambda: BARS.points(T[:2], [0.0, 0.5]), "Case.sensitivity": lambda: PAIR.sensitivity("k2", T),
    "Case.forces": lambda: CASE.forces(T), "Case.digits": lambda: CASE.digits(30, T[:2]), "Case.accumulates": lambda: CASE.accumulates,
    "Case.mesh": lambda: BARS.mesh,
    "Case.spectrum": lambda: CASE.spectrum(10, 5.0), "Case.tables": CASE.tables,
    "Case.indicators": lambda: clackers.case("stop").indicators, "Case.constants": lambda: CASE.constants,
    "Problem.load": lambda: CASE.problem.load(0.5), "Problem.rhs": lambda: CASE.problem.rhs(0.5, Y),
    "Problem.gap": lambda: CASE.problem.gap(0.5, Y), "Problem.impact": lambda: CASE.problem.impact(Y),
    "Problem.events": lambda: CASE.problem.events, "Record.from_json": lambda: clackers.Record.from_json(RECORD.to_json()),
    "Record.to_json": RECORD.to_json, "Record.table": RECORD.table, "Record.to_pandas": RECORD.to_pandas,
    "Record.figure": lambda: RECORD.figure("convergence"), "Record.figures": lambda: RECORD.figures, "Record.keys": RECORD.keys,
    "Record.save": lambda: RECORD.save(PATH), "load": lambda: clackers.load(PATH),
    "Table.head": lambda: TABLE.head(1), "Table.to_pandas": TABLE.to_pandas, "Table.to_xarray": TABLE.to_xarray,
    "repr": lambda: (repr(CASE), repr(RECORD), repr(TABLE), str(RECORD)),
    "verify method": lambda: clackers.verify("rk4", **SHORT), "verify callable": lambda: clackers.verify(solver, case="stop", steps=[0.1]),
    "verify raising": refused(lambda: clackers.verify(lambda problem, h: 1 / 0, **SHORT)),
    "verify program": lambda: clackers.verify(clackers.Program("echo t,u1; echo 0,1; echo 20,{h}", fresh=True), **SHORT),
    "check": lambda: clackers.check(*HISTORY, case=CASE), "check refused": refused(lambda: clackers.check(T, T[:3])),
    "compare": lambda: clackers.compare((FINE, *CASE.response(FINE)), (FINE[::4], *CASE.response(FINE[::4])), step=[FINE[1], FINE[4]]),
    "plot.response": drawn(lambda: clackers.plot.response(CASE)), "plot.energies": drawn(lambda: clackers.plot.energies(CASE)),
    "plot.spectrum": drawn(lambda: clackers.plot.spectrum(CASE)),
    "plot.convergence": drawn(lambda: clackers.plot.convergence(RECORD)),
    "plot.history": drawn(lambda: clackers.plot.history(RECORD)), "Record._repr_html_": lambda: RECORD._repr_html_(),
}


class Heap(ctypes.Structure):
    """What glibc's mallinfo2 gives."""
    _fields_ = [(name, ctypes.c_size_t) for name in "arena ordblks smblks hblks hblkhd usmblks fsmblks uordblks fordblks keepcost".split()]


def in_use():
    """Bytes that are allocated and not freed: pages that the allocator keeps for later are none of them."""
    gc.collect()
    heap = MALLINFO()
    return heap.uordblks + heap.hblkhd


MALLINFO = ctypes.CDLL(None).mallinfo2
MALLINFO.restype = Heap


def growth(call, most):
    """Calls of a round, and the growth in bytes of the round that grew least: what leaks grows in each."""
    began = time.monotonic()
    for _ in range(FEWEST):
        call()
    count = round(min(most, max(FEWEST, LONGEST * FEWEST / (time.monotonic() - began))))
    for _ in range(count // 10):
        call()
    found = []
    for _ in range(ROUNDS):
        before = in_use()
        for _ in range(count):
            call()
        found.append(in_use() - before)
    return count, min(found)


def public():
    """What must be called: functions, and methods and functions of the classes that have state."""
    names = {name for name in clackers.__all__ if callable(getattr(clackers, name)) and name.islower()}
    for kind in (clackers.Case, clackers.Record, clackers.Problem, clackers.Table):
        names |= {f"{kind.__name__}.{name}" for name, value in vars(kind).items() if name.islower() and name[0] != "_"
                  and callable(value)}
    return names


def main():
    most = -(-int(sys.argv[1] if len(sys.argv) > 1 else 10_000) // ROUNDS)
    bad = [f"{name} is not called" for name in sorted(public() - {name.split(" ")[0] for name in CALLS} - {"Table.keys"})]
    for name, call in CALLS.items():
        count, grown = growth(call, most)
        print(f"{name:20} {ROUNDS * count:6} calls, {grown:9} bytes in the best of {ROUNDS} rounds", flush=True)
        if grown > max((OF_A_FIGURE if name.startswith("plot.") else MOST) * count, NOISE):
            bad.append(f"{name} grows by {grown} bytes in {count} calls")
    print(*bad, sep="\n")
    return bool(bad)


if __name__ == "__main__":
    if os.environ.get("PYTHONMALLOC") != "malloc":  # every object is to be one of malloc's
        os.execve(sys.executable, [sys.executable, *sys.argv], {**os.environ, "PYTHONMALLOC": "malloc"})
    sys.exit(main())
