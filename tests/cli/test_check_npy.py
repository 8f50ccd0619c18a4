"""check: NumPy files as histories and as impacts, and which of them are refused."""
import array
import os
import struct
import subprocess
import unittest

from command import PROGRAM, CommandTest, environment, rows


def npy(descr, shape, data, fortran=False):
    """A NumPy file, as numpy.save writes it."""
    header = f"{{'descr': {descr}, 'fortran_order': {fortran}, 'shape': {shape}, }}\n".encode()
    return b"\x93NUMPY\x01\0" + struct.pack("<H", len(header)) + header + data


class CheckNpy(CommandTest):
    def setUp(self):
        super().setUp()
        self.csv = self.good("respond", "three-parameter", "--step", "0.01", "--format", "csv")
        self.table = [[float(row[name]) for name in ("t", "u1", "v1", "u2", "v2")]
                      for row in rows(self.csv)]

    def write(self, name, data):
        with open(self.path(name), "wb") as file:
            file.write(data)
        return self.path(name)

    def checked(self, *arguments, stdin=b"", exit_code=0):
        done = subprocess.run([PROGRAM, "check", *arguments, "--format", "csv"], input=stdin,
                              capture_output=True, timeout=60, env=environment())
        self.assertEqual((done.returncode, done.stderr), (exit_code, b""), arguments)
        return [{name: value for name, value in row.items() if name != "file"}
                for row in rows(done.stdout.decode())]

    def doubles(self, rows_of_numbers):
        return array.array("d", [x for row in rows_of_numbers for x in row]).tobytes()

    def test_what_respond_writes_is_checked_like_its_csv(self):
        npy_path, csv_path = self.path("h0.01.npy"), self.path("h0.01.csv")
        for path in (npy_path, csv_path):
            self.good("respond", "three-parameter", "--step", "0.01", "--format", path[-3:],
                      "--out", path, "--quiet")
        hits = {kind: self.path(f"hits.{kind}") for kind in ("npy", "csv")}
        for kind, path in hits.items():
            self.good("respond", "three-parameter", "--impacts", "--format", kind, "--out", path, "--quiet")
        expected = self.checked(csv_path)
        self.assertEqual(self.checked(npy_path), expected)
        self.assertEqual(self.checked(npy_path, "--events", hits["npy"]),
                         self.checked(csv_path, "--events", hits["csv"]))
        with open(npy_path, "rb") as file:
            data = file.read()
        self.assertEqual(self.checked("-", stdin=data), self.checked("-", stdin=self.csv.encode()))

    def test_both_rows_of_a_jump_are_read(self):
        t = rows(self.good("respond", "stop", "--impacts", "--format", "csv"))[0]["t"]
        times = "".join(f"{time}\n" for time in (*(0.01 * i for i in range(100)), t))
        for kind in ("npy", "csv"):
            self.good("respond", "stop", "--times", "-", "--format", kind, "--out", self.path(f"h.{kind}"),
                      "--quiet", stdin=times)
        # The history ends early.
        found, expected = (self.checked(self.path(f"h.{kind}"), "--case", "stop", exit_code=3)
                           for kind in ("npy", "csv"))
        self.assertEqual(found, expected)
        self.assertEqual(expected[0]["rows"], "102")

    def test_plain_arrays_take_their_names_from_the_option(self):
        count, names = len(self.table), ("--columns", "t,u1,v1,u2,v2")
        expected = self.checked(self.write("h.csv", self.csv.encode()))
        by_rows = self.write("h.npy", npy("'<f8'", (count, 5), self.doubles(self.table)))
        by_columns = self.write("f.npy", npy("'<f8'", (count, 5), self.doubles(zip(*self.table)), True))
        self.assertEqual(self.checked(by_rows, *names), self.checked(by_columns, *names))
        self.assertEqual([row["u_error"] for row in self.checked(by_rows, *names)],
                         [row["u_error"] for row in expected])
        self.refused("check", by_rows, code="no-column", says=("5 columns of numbers have no names", "--columns"))
        turned = self.write("turned.npy", npy("'<f8'", (5, count), self.doubles(zip(*self.table))))
        self.refused("check", turned, *names, code="ragged-row", says="save the transposed array")

    def test_names_of_files_give_steps(self):
        for h, every in ((0.02, 2), (0.04, 4)):
            self.write(f"h{h}.npy", npy("[('t', '<f8'), ('u', '<f8', (2,))]", (len(self.table[::every]),),
                                        self.doubles((t, u1, u2) for t, u1, _, u2, _ in self.table[::every])))
        found = self.checked(self.path("h0.02.npy"), self.path("h0.04.npy"))
        self.assertEqual([float(row["step"]) for row in found], [0.04, 0.02])

    def test_single_precision_limits_the_result(self):
        data = b"".join(struct.pack(">5f", *row) for row in self.table)
        fields = "[('t', '>f4'), ('u1', '>f4'), ('v1', '>f4'), ('u2', '>f4'), ('v2', '>f4')]"
        path = self.write("f4.npy", npy(fields, f"({len(self.table)},)", data))
        self.assertIn("single precision", self.good("check", path))

    def test_what_is_no_array_of_numbers_is_refused(self):
        whole = npy("[('t', '<f8'), ('u1', '<f8')]", "(2,)", self.doubles(((0, 1), (1, 1))))
        marker = self.path("unpickled")
        pickled = f"cos\nsystem\n(S'touch {marker}'\ntR.".encode()
        for data, code, says in (
                (whole[:-1], "not-an-array", "ends before the last of its 2 rows"),
                (whole + b"x", "not-an-array", "continues after"),
                (whole[:20], "not-an-array", "ends within its header"),
                (npy("'|O'", "(1,)", pickled), "not-an-array", "never unpickled"),
                (npy("'<c16'", "(1,)", b"x" * 16), "not-an-array", "allowed: floating-point"),
                (npy("'<f8'", "(1, 1, 1)", b"x" * 8), "not-an-array", "(rows, columns)"),
                (npy("[('t', '<f8'), ('u1', '<f8')]", "(0,)", b""), "too-short", "has no rows"),
                (npy("[('t', '<f8'), ('u1', '<f8'), ('u2', '<f8')]", "(2,)",
                     self.doubles(((0, 1, 2), (1, float("nan"), 2)))), "not-finite", "row 1 (from 0): u1 = nan"),
                (b"PK\3\4", "not-text", "npz")):
            self.refused("check", self.write("x.npy", data), code=code, says=says)
        self.assertFalse(os.path.exists(marker))


if __name__ == "__main__":
    unittest.main()
