"""A bar of solid elements by CalculiX, on finer and finer meshes against the bar itself."""
import json
import os
import shutil
import unittest

import calculix
from peers import HERE, PeerTest, run

PROGRAM = os.path.join(HERE, "calculix_bar.py")


@unittest.skipUnless(shutil.which("ccx"), "needs calculix-ccx")
class CalculixBar(PeerTest):
    @classmethod
    def setUpClass(cls):
        calculix.on_one_processor()

    def test_converges_along_a_path_as_linear_elements_do(self):
        # Strains of 1e-3. ALPHA is the default of CalculiX; without that damping the contact gains energy.
        command = f"python3 {PROGRAM} {{case}} {{h}} {{out}} -0.05"
        done = run("verify", "--exec", command, "--case", "bar-wall", "--set", "mass=consistent,elements=8,V=1e-3,d=0.25e-3",
                   "--path", "0.45", "--levels", "3", "--samples-per-level", "4", "--work", self.path("runs"), "--format", "json")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        orders, finest, *_ = json.loads(done.stdout)["sheets"]
        self.assertEqual([row[-1] for row in orders["rows"]], ["as expected"])
        [row] = [dict(zip([column["name"] for column in finest["columns"]], row)) for row in finest["rows"]]
        self.assertLess(row["e_total"], row["e_space"])
        self.assertLess(abs(row["energy"]), 0.02)


if __name__ == "__main__":
    unittest.main()
