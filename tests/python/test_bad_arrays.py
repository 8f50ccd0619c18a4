"""What can be wrong with numbers, arrays and names, a row each: the code of the refusal and its words."""
import unittest
from fractions import Fraction

import numpy as np

import clackers

NAN, INFINITY = float("nan"), float("inf")
CASE = clackers.case("three-parameter")
PROBLEM = CASE.problem
HUGE = clackers.case("three-parameter", a_t=5e7)


def masked():
    return np.ma.masked_array([0.0, 1.0], [False, True])


def read_only():
    array = np.empty((2, 2))
    array.setflags(write=False)
    return array


def unaligned():
    return np.frombuffer(bytearray(33), offset=1, dtype=np.float64).reshape(2, 2)


def out(u, v=None, a=None):
    return lambda: CASE.response([0.0, 1.0], out=(u, np.empty((2, 2)) if v is None else v, a))


def overlapping():
    memory = np.zeros((2, 2))
    return CASE.response(memory[0], out=(memory, np.empty((2, 2)), None))


# what is wrong, code, words of the message, call
ROWS = [
    # Times.
    ("NaN among times", "not-a-number", "t = nan", lambda: CASE.response([0.0, NAN])),
    ("infinite time", "not-finite", "t = inf", lambda: CASE.response([INFINITY])),
    ("time before the start", "time-outside", "t = -0.1", lambda: CASE.response([-0.1])),
    ("time behind the end", "time-outside", "20", lambda: CASE.response(np.linspace(0.0, 20.1, 100))),
    ("time behind the end in a late block", "time-outside", "21", lambda: CASE.response(np.append(np.zeros(200_000), 21.0))),
    ("times in two dimensions", "wrong-size", "shape (2, 1)", lambda: CASE.response([[0.0], [1.0]])),
    ("ragged list", "wrong-size", "equal length", lambda: CASE.response([[0.0], [1.0, 2.0]])),
    ("texts", "not-a-number", "<U3", lambda: CASE.response(["0.0", "1.0"])),
    ("complex numbers", "not-a-number", "complex128", lambda: CASE.response(np.array([0j, 1j]))),
    ("booleans", "not-a-number", "bool", lambda: CASE.response([False, True])),
    ("dates", "not-a-number", "datetime64", lambda: CASE.response(np.array(["2020-01-01"], dtype="datetime64"))),
    ("fractions", "not-a-number", "object", lambda: CASE.response([Fraction(1, 2)])),
    ("records", "not-a-number", "t", lambda: CASE.response(np.zeros(2, dtype=[("t", float)]))),
    ("masked array", "not-a-number", "masked", lambda: CASE.response(masked())),
    ("nothing", "not-a-number", "NoneType", lambda: CASE.response(None)),
    ("generator", "not-a-number", "generator", lambda: CASE.response(t for t in [0.0])),
    ("dictionary", "not-a-number", "dict", lambda: CASE.response({0.0: 1.0})),
    # Sides.
    ("unknown side", "out-of-range", "side = middle", lambda: CASE.response([0.0], side="middle")),
    ("side that is no text", "not-text", "side = 1", lambda: CASE.response([0.0], side=1)),
    # Arrays to write to.
    ("one array to write to", "out-of-range", "tuple of three arrays", lambda: CASE.response([0.0, 1.0], out=np.empty((2, 2)))),
    ("two arrays to write to", "out-of-range", "tuple of three arrays", lambda: CASE.response([0.0, 1.0], out=(1, 2))),
    ("list to write to", "out-of-range", "type list", out([[0.0, 0.0], [0.0, 0.0]])),
    ("single precision to write to", "out-of-range", "float32", out(np.empty((2, 2), dtype=np.float32))),
    ("columns to write to", "out-of-range", "C-contiguous", out(np.empty((2, 2), order="F"))),
    ("every other row to write to", "out-of-range", "C-contiguous", out(np.empty((4, 2))[::2])),
    ("read-only array to write to", "out-of-range", "read-only", out(read_only())),
    ("unaligned array to write to", "out-of-range", "aligned", out(unaligned())),
    ("other bytes to write to", "out-of-range", ">f8", out(np.empty((2, 2), dtype=">f8"))),
    ("array to write to that is too short", "wrong-size", "shape (1, 2)", out(np.empty((1, 2)))),
    ("array to write to that is exchanged", "wrong-size", "shape (2, 3)", out(np.empty((2, 3)))),
    ("flat array to write to", "wrong-size", "shape (4,)", out(np.empty(4))),
    ("second array to write to", "wrong-size", "v of out", out(np.empty((2, 2)), np.empty((3, 2)))),
    ("third array to write to", "wrong-size", "a of out", out(np.empty((2, 2)), np.empty((2, 2)), np.empty((3, 2)))),
    ("times in the array to write to", "out-of-range", "overlap", overlapping),
    # Other functions of time.
    ("NaN for a bound", "not-a-number", "error_bound: t = nan", lambda: CASE.error_bound([NAN])),
    ("late bound", "time-outside", "t = 21", lambda: CASE.error_bound(21)),
    ("late envelope", "time-outside", "t = 21", lambda: CASE.envelope([21])),
    ("late energy", "time-outside", "t = 21", lambda: CASE.energies([21])),
    ("energy in two dimensions", "wrong-size", "energies: t", lambda: CASE.energies([[0.0]])),
    ("NaN for a sensitivity", "not-a-number", "t = nan", lambda: CASE.sensitivity("xi1", [NAN])),
    ("unknown name of a sensitivity", "unknown-name", "k2", lambda: CASE.sensitivity("k22", [0.0])),
    ("name of a sensitivity that is no text", "not-text", "name = 2", lambda: CASE.sensitivity(2, [0.0])),
    ("sensitivity to a whole number", "no-derivative", "whole number", lambda: CASE.sensitivity("N", [0.0])),
    ("one frequency", "out-of-range", "samples = 1", lambda: CASE.spectrum(1, 10.0)),
    ("half a frequency", "not-whole", "n = 2.5", lambda: CASE.spectrum(2.5, 10.0)),
    ("more frequencies than a long holds", "out-of-range", "2^63", lambda: CASE.spectrum(2**63, 10.0)),
    ("NaN for the highest frequency", "not-a-number", "highest = nan", lambda: CASE.spectrum(2, NAN)),
    ("text for the highest frequency", "not-a-number", "highest = '9'", lambda: CASE.spectrum(2, "9")),
    # Impacts.
    ("impact 0", "out-of-range", "first = 0", lambda: CASE.impacts(first=0)),
    ("impact behind the last", "beyond-last-impact", "last <= 6", lambda: CASE.impacts(last=7)),
    ("range that starts behind the last", "beyond-last-impact", "first = 8", lambda: CASE.impacts(first=8)),
    ("range that ends before it starts", "out-of-range", "first = 5", lambda: CASE.impacts(first=5, last=3)),
    ("half an impact", "not-whole", "first = 1.5", lambda: CASE.impacts(first=1.5)),
    ("all of hundreds of millions", "too-many-rows", "impacts(first=1, last=1000)", lambda: HUGE.impact_table()),
    ("table of hundreds of millions", "too-many-rows", "impacts(first=1, last=1000)", lambda: HUGE.impact_table()),
    ("count at NaN", "not-a-number", "t = nan", lambda: CASE.impact_count(NAN)),
    ("count behind the end", "time-outside", "t = 21", lambda: CASE.impact_count(21)),
    ("count at a list", "not-a-number", "t = [1]", lambda: CASE.impact_count([1])),
    # States.
    ("state of another size", "wrong-size", "shape (3,)", lambda: PROBLEM.rhs(0.0, [1.0, 2.0, 3.0])),
    ("state in two dimensions", "wrong-size", "shape (4, 1)", lambda: PROBLEM.rhs(0.0, np.zeros((4, 1)))),
    ("state of texts", "not-a-number", "y = ", lambda: PROBLEM.rhs(0.0, ["1", "2", "3", "4"])),
    ("time of a state that is no number", "not-a-number", "t = '0'", lambda: PROBLEM.rhs("0", np.zeros(4))),
    ("gap of a contact that is not there", "out-of-range", "contact = 1", lambda: PROBLEM.gap(0.0, np.zeros(4), 1)),
    ("gap of contact -1", "out-of-range", "contact = -1", lambda: PROBLEM.gap(0.0, np.zeros(4), -1)),
    ("impact of a contact that opens", "out-of-range", "b . v = 2", lambda: PROBLEM.impact([0.0, 0.0, 1.0, -1.0])),
    ("impact without contact", "out-of-range", "no contact", lambda: clackers.case("sdof").problem.impact([0.0, -1.0])),
    ("load at a text", "not-a-number", "t = '0'", lambda: PROBLEM.load("0")),
    # Cases.
    ("unknown case", "unknown-name", 'Did you mean "stop"', lambda: clackers.case("stpo")),
    ("case that is no text", "not-text", "name = 3", lambda: clackers.case(3)),
    ("unknown parameter", "unknown-name", 'Did you mean "xi1"', lambda: clackers.case("stop", xi2=0.1)),
    ("parameter outside of its range", "out-of-range", "eta = 1.5", lambda: clackers.case("stop", eta=1.5)),
    ("NaN for a parameter", "not-a-number", "xi1 = nan", lambda: clackers.case("stop", xi1=NAN)),
    ("text for a number", "not-a-number", "eta = 0.5;", lambda: clackers.case("stop", eta="0.5")),
    ("list for a parameter", "not-a-number", "eta = ", lambda: clackers.case("stop", eta=[0.5])),
    ("boolean for a parameter", "not-a-number", "eta = True", lambda: clackers.case("stop", eta=True)),
    ("boolean of NumPy for a parameter", "not-a-number", "eta = True", lambda: clackers.case("stop", eta=np.True_)),
    ("array for a parameter", "not-a-number", "eta = array", lambda: clackers.case("stop", eta=np.array([0.5]))),
    ("nothing for a parameter", "not-a-number", "eta = None", lambda: clackers.case("stop", eta=None)),
    ("integer beyond all doubles", "not-finite", "N = ", lambda: clackers.case("three-parameter", N=10**400)),
    ("half of a whole parameter", "not-whole", "N = 1.5", lambda: clackers.case("three-parameter", N=1.5)),
    ("mass ratio beyond the class", "not-admissible", "r", lambda: clackers.case("synchronized-pair", X=9, r=5)),
    ("threshold outside of its range", "out-of-range", "threshold = 1", lambda: clackers.case("stop", threshold=1)),
    ("admissibility of an even ratio", "not-odd", "X = 8", lambda: clackers.admissibility(8, 3)),
    ("admissibility of no mass", "out-of-range", "r = 0", lambda: clackers.admissibility(9, 0)),
    ("admissibility of a text", "not-a-number", "r = '3'", lambda: clackers.admissibility(9, "3")),
    # The catalogue and tables.
    ("unknown code", "unknown-name", 'Did you mean "irregular"', lambda: clackers.explain("iregular")),
    ("code that is no text", "not-text", "code = 1", lambda: clackers.explain(1)),
    ("unknown kind", "unknown-name", 'Did you mean "cases"', lambda: clackers.catalogue("case")),
    ("kind that is no text", "not-text", "kind = 1", lambda: clackers.catalogue(1)),
    ("unknown column", "unknown-name", 'Did you mean "du1"', lambda: CASE.sensitivity("k2", [0.0])["du11"]),
]


class BadInput(unittest.TestCase):
    def test_every_row_is_refused_with_its_code_and_words(self):
        for what, code, words, call in ROWS:
            with self.subTest(what):
                with self.assertRaises(clackers.InputError) as raised:
                    call()
                self.assertIsInstance(raised.exception, ValueError)
                self.assertEqual(raised.exception.code, code, str(raised.exception))
                self.assertIn(words, str(raised.exception))

    def test_names_of_rows_are_unique(self):
        names = [row[0] for row in ROWS]
        self.assertEqual(len(set(names)), len(names))

    def test_numbers_of_other_types_are_taken(self):
        for value in (1, np.int64(1), np.float32(1.0), np.uint8(1), np.longdouble(1)):
            self.assertEqual(clackers.case("stop", eta=value).parameters["eta"], 1.0)
        self.assertEqual(len(CASE.impacts(first=np.int64(1), last=np.uint8(2))), 2)


if __name__ == "__main__":
    unittest.main()
