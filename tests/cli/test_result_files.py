"""Result files of other programs in check: the exact motion plays the part of CalculiX."""
import ctypes
import os
import shutil
import struct
import subprocess
import unittest

from command import CommandTest

PYTHON = "/usr/bin/python3"


def has_module(name):
    return subprocess.run([PYTHON, "-c", f"import {name}"], capture_output=True).returncode == 0


def has_library(name):
    try:
        return bool(ctypes.CDLL(name))
    except OSError:
        return False


HAS_NETCDF = has_library("libnetcdf.so.19")


class ResultFiles(CommandTest):
    def setUp(self):
        super().setUp()
        self.rows = [row for row in self.rows_of("respond", "three-parameter", "--step", "0.01") if row["side"] != "-"]

    def write(self, name, data):
        with open(self.path(name), "wb") as file:
            file.write(data)
        return self.path(name)

    def calculix(self, nodes):
        text = ""
        for row in self.rows:
            for kind, letter in (("displacements", "u"), ("velocities", "v")):
                text += f"\n {kind} (vx,vy,vz) for set ALL and time {float(row['t']):14.7E}\n\n"
                for node, mass in nodes.items():
                    value = float(row[letter + mass]) if mass else 0.0
                    text += f"{node:10d} {value:13.6E}  0.000000E+00  0.000000E+00\n"
        return self.write("run.dat", text.encode())

    def test_calculix_agrees(self):
        self.assertIn("Within the tolerance", self.good("check", self.calculix({1: "1", 2: "2"}), "--tolerance", "1e-5"))

    def test_nodes_are_chosen(self):
        file = self.calculix({7: "2", 12: "1", 99: ""})
        self.refused("check", file, says="--node", code="no-column")
        self.good("check", file, "--node", "12,7", "--tolerance", "1e-5")

    def test_matlab_4_agrees(self):
        data = b""
        for name, values in (("t", [row["t"] for row in self.rows]), ("u", [row[u] for u in ("u1", "u2") for row in self.rows])):
            count = len(self.rows)
            data += struct.pack("<5i", 0, count, len(values) // count, 0, 2) + name.encode() + b"\0"
            data += struct.pack(f"<{len(values)}d", *map(float, values))
        self.good("check", self.write("run.mat", data), "--tolerance", "1e-9")
        self.refused("check", self.write("cut.mat", data[:-3]), says="cut.mat", code="not-an-array")

    def written_by(self, command, script):
        """Files that a program wrote with t, u and v; CSV is the path of the exact rows."""
        path = self.path("exact.csv")
        with open(path, "w") as file:
            file.writelines(",".join(row[name] for name in ("t", "u1", "u2", "v1", "v2")) + "\n" for row in self.rows)
        done = subprocess.run(command, input=script, capture_output=True, text=True, cwd=os.path.dirname(path), env={**os.environ, "CSV": path})
        self.assertEqual(done.returncode, 0, done.stderr)

    def agree(self, *names):
        for name in names:
            with self.subTest(name):
                self.assertIn("Within the tolerance", self.good("check", self.path(name), "--tolerance", "1e-9"))

    @unittest.skipUnless(shutil.which("octave-cli"), "needs octave")
    def test_files_of_octave(self):
        self.written_by(["octave-cli", "-q"], """x = csvread(getenv('CSV')); t = x(:, 1); u = x(:, 2:3); v = x(:, 4:5); s.a = 1; c = 'text';
            save('-v4', 'o4.mat', 't', 'u', 'v'); save('-v6', 'o6.mat', 's', 't', 'u', 'v', 'c'); save('-v7', 'o7.mat', 't', 'u', 'v', 's');
            save('-hdf5', 'o.h5', 't', 'u', 'v', 's')""")
        self.agree("o4.mat", "o6.mat", "o7.mat", *(["o.h5"] if HAS_NETCDF else []))

    @unittest.skipUnless(has_module("scipy.io"), "needs python3-scipy")
    def test_files_of_scipy(self):
        self.written_by([PYTHON, "-"], """import os, numpy, scipy.io
x = numpy.loadtxt(os.environ["CSV"], delimiter=",")
parts = {"t": x[:, 0], "u": x[:, 1:3], "v": x[:, 3:]}
scipy.io.savemat("s5.mat", parts)
scipy.io.savemat("s7.mat", parts, do_compression=True)
with scipy.io.netcdf_file("s.nc", "w") as file:
    file.createDimension("time", None)
    file.createDimension("mass", 2)
    for name, values in parts.items():
        file.createVariable(name, "d", ("time", "mass")[:values.ndim])[:] = values
""")
        self.agree("s5.mat", "s7.mat", *(["s.nc"] if HAS_NETCDF else []))

    @unittest.skipUnless(HAS_NETCDF and has_module("h5py"), "needs python3-h5py and libnetcdf19")
    def test_files_of_h5py(self):
        self.written_by([PYTHON, "-"], """import os, numpy, h5py
x = numpy.loadtxt(os.environ["CSV"], delimiter=",")
with h5py.File("h.h5", "w") as file:
    file.create_dataset("run/u", data=x[:, 1:3], compression="gzip")
    file["run/t"], file["v"], file["note"] = x[:, 0], x[:, 3:], "a text"
with h5py.File("m.mat", "w", userblock_size=512) as file:  # as MATLAB does with -v7.3
    file["t"], file["u"], file["v"] = x[None, :, 0], x[:, 1:3].T, x[:, 3:].T
""")
        self.agree("h.h5", "m.mat")
        with open(self.path("h.h5"), "rb") as file:
            whole = file.read()
        for length in (8, 60, 100, len(whole) // 2):
            self.refused("check", self.write("cut.h5", whole[:length]), says="cut.h5", code="not-an-array")

    def test_recorders_are_joined(self):
        for name, letter in (("disp-h0.01.out", "u"), ("vel-h0.01.out", "v")):
            self.write(name, "".join(f"{row['t']} {row[letter + '1']} {row[letter + '2']}\n" for row in self.rows).encode())
        joined = self.path("disp-h0.01.out") + "+" + self.path("vel-h0.01.out")
        self.assertIn("Within the tolerance", self.good("check", joined, "--columns", "t,u1,u2+t,v1,v2", "--tolerance", "1e-9"))
        self.refused("check", joined + "x", "--columns", "t,u1,u2+t,v1,v2", says="vel-h0.01.outx", code="cannot-read", exit_code=4)

    def test_sets_of_result_files_are_compared(self):
        ours, theirs = self.calculix({7: "2", 12: "1", 99: ""}), self.path("other.dat")
        shutil.copy(ours, theirs)
        self.good("check", ours, "--against", theirs, "--node", "12,7", "--reader", "calculix-dat", "--tolerance", "1e-12")
        self.refused("check", ours, "--against", theirs, "--node", "12,8", says="8", code="no-column")

    def test_options_are_checked(self):
        file = self.calculix({1: "1", 2: "2"})
        self.refused("check", file, "--reader", "nodou", says='"nodout"', code="unknown-name")
        self.refused("check", file, "--component", "4", says="--component", code="out-of-range")
        self.refused("check", self.write("a.parquet", b"PAR1"), says="csv instead", code="not-text")


if __name__ == "__main__":
    unittest.main()
