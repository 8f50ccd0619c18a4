"""The notebook of examples/python is executed, and ends in the verdicts that its text states."""
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

NOTEBOOK = Path(__file__).resolve().parents[2] / "examples/python/clackers.ipynb"


def executed(folder):
    """The cells of the notebook with their outputs; files that it writes go to the folder."""
    environment = {**os.environ, "HOME": str(folder), "JUPYTER_RUNTIME_DIR": str(folder / "runtime"),
                   "IPYTHONDIR": str(folder / "ipython"), "PYDEVD_DISABLE_FILE_VALIDATION": "1"}
    environment.pop("MPLBACKEND", None)
    (folder / NOTEBOOK.name).write_bytes(NOTEBOOK.read_bytes())
    done = subprocess.run([sys.executable, "-m", "nbconvert", "--to", "notebook", "--execute", NOTEBOOK.name,
                           "--output", "executed.ipynb"], cwd=folder, env=environment, capture_output=True, text=True)
    if done.returncode:
        raise AssertionError(done.stdout + done.stderr)
    return json.loads((folder / "executed.ipynb").read_text())["cells"]


class Notebook(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.cells = executed(cls.folder)

    def outputs(self, words):
        """Texts by their type, of the only cell whose source contains the words."""
        (cell,) = [cell for cell in self.cells if cell["cell_type"] == "code" and words in "".join(cell["source"])]
        found = {}
        for output in cell["outputs"]:
            parts = output.get("data", {"stream": output.get("text", "")})
            for kind, text in parts.items():
                found[kind] = found.get(kind, "") + "".join(text)
        return found

    def test_it_is_committed_without_outputs(self):
        for cell in json.loads(NOTEBOOK.read_text())["cells"]:
            self.assertFalse(cell.get("outputs"))
            self.assertIsNone(cell.get("execution_count"))

    def test_no_cell_writes_to_standard_error(self):
        for cell in self.cells:
            for output in cell.get("outputs", ()):
                self.assertNotEqual(output.get("name"), "stderr", output)

    def test_every_cell_that_plots_shows_its_figure(self):
        plotting = [cell for cell in self.cells if re.search(r"\bplot\.[a-z]+\(", "".join(cell["source"]))
                    and cell["cell_type"] == "code"]
        self.assertGreater(len(plotting), 4)
        for cell in plotting:
            pictures = [output for output in cell["outputs"] if "image/png" in output.get("data", {})]
            self.assertEqual(len(pictures), 1, "".join(cell["source"]))

    def test_impacts_at_step_ends_are_irregular_of_order_one(self):
        text = self.outputs("record = clackers.verify(impact_at_step_end, case=case")["text/plain"]
        self.assertRegex(text, r"order (0\.[89]|1\.[012])")
        self.assertIn("irregular", text)
        self.assertIn("Verdict: disagrees", text)

    def test_located_impacts_restore_the_second_order(self):
        text = self.outputs('record["impact_located"].verdict')["stream"]
        self.assertRegex(text, r"agrees with order (1\.9|2\.0)")

    def test_the_diagnosis_names_the_restitution(self):
        text = self.outputs("eta=0.99")["stream"]
        self.assertIn("[restitution-differs]", text)
        self.assertIn("0.9900", text)
        self.assertIn("disagrees", text)

    def test_scipy_converges_with_its_tolerance(self):
        shown = self.outputs("def rk45")
        self.assertIn("Verdict: agrees", shown["text/plain"])
        self.assertIn("agrees", shown["text/html"])

    def test_the_figure_for_a_paper_is_written(self):
        self.assertTrue((self.folder / "verdict.pdf").read_bytes().startswith(b"%PDF-"))


if __name__ == "__main__":
    unittest.main()
