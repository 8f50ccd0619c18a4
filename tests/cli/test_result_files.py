"""Result files of other programs in check: the exact motion plays the part of CalculiX."""
import struct
import unittest

from command import CommandTest


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

    def test_options_are_checked(self):
        file = self.calculix({1: "1", 2: "2"})
        self.refused("check", file, "--reader", "nodou", says='"nodout"', code="unknown-name")
        self.refused("check", file, "--component", "4", says="--component", code="out-of-range")
        self.refused("check", self.write("a.parquet", b"PAR1"), says="csv instead", code="not-text")


if __name__ == "__main__":
    unittest.main()
