"""Records: what they show of themselves, and their files."""
import html.parser
import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

import clackers
from solvers import event_driven, leapfrog


def wrong(problem, h):
    return event_driven(problem, h, restitution=0.9)


METHODS = clackers.verify("rk4", "newmark", levels=5, samples_per_level=4)
CALLABLE = clackers.verify(wrong, steps=[0.1, 0.07, 0.05], expect="exact")
CASES = clackers.verify("rk4", case=["stop", "three-parameter"], levels=3, samples_per_level=2)


class Subjects(unittest.TestCase):
    def test_they_are_asked_by_name(self):
        self.assertEqual(METHODS["rk4"].name, "rk4")
        self.assertEqual(len(METHODS), 2)
        self.assertIn("rk4", METHODS)
        self.assertNotIn("euler", METHODS)
        self.assertEqual([METHODS[key].name for key in METHODS], ["rk4", "newmark"])

    def test_an_unknown_name_is_refused_with_those_there_are(self):
        for key in ("euler", ("stop", "rk4")):
            with self.assertRaises(clackers.InputError) as caught:
                METHODS[key]
            self.assertIn("newmark", str(caught.exception))

    def test_of_several_the_record_itself_is_not_asked(self):
        for attribute in ("order", "behaviour", "uncertainty", "claim", "reason", "findings", "diagnoses", "levels"):
            with self.assertRaisesRegex(clackers.InputError, r"record\['rk4'\]"):
                getattr(METHODS, attribute)

    def test_of_several_cases_names_are_pairs(self):
        self.assertEqual(CASES.keys(), (("stop", "rk4"), ("three-parameter", "rk4")))
        self.assertEqual(CASES["stop", "rk4"].case, "stop")
        with self.assertRaisesRegex(clackers.InputError, "Several cases"):
            CASES["rk4"]

    def test_the_numbers_of_a_subject(self):
        subject = METHODS["rk4"]
        self.assertEqual(subject.verdict, "agrees")
        self.assertEqual(subject.behaviour, "proper")
        self.assertEqual(subject.claim, "proper, order 4")
        self.assertAlmostEqual(subject.order, 4.0, delta=0.3)
        self.assertGreater(subject.uncertainty, 0.0)
        self.assertEqual(len(subject.levels.rows), 5)
        self.assertEqual(len(subject.runs.rows), 20)

    def test_the_diagnosis_of_a_callable(self):
        cause = CALLABLE.diagnoses[0]
        self.assertEqual(cause.code, "restitution-differs")
        self.assertAlmostEqual(cause.value, 0.9, delta=1e-6)
        self.assertGreaterEqual(cause.confidence, 0.9)
        self.assertEqual(cause.evidence["expected"], 1.0)
        self.assertGreater(cause.gain, 10)
        self.assertIn("estitution", cause.text)
        self.assertIn(str(cause), CALLABLE.findings)
        self.assertIn("[restitution-differs]", str(cause))


class Texts(unittest.TestCase):
    def test_print_shows_what_the_command_shows(self):
        command = os.environ.get("CLACKERS")
        if not command:
            self.skipTest("CLACKERS names no command")
        shown = subprocess.run([command, "verify", "rk4", "newmark", "--levels", "5", "--samples-per-level", "4"],
                               capture_output=True, text=True).stdout.rstrip("\n").splitlines()
        self.assertEqual(str(METHODS).splitlines()[:-1], shown[:-1])

    def test_the_last_line_says_what_to_type_in_python(self):
        self.assertTrue(str(METHODS).endswith('Next: record.save("report.html")'), str(METHODS)[-80:])
        self.assertTrue(str(CALLABLE).endswith('Next: clackers.explain("restitution-differs")'), str(CALLABLE)[-80:])

    def test_no_line_is_longer_than_80_characters(self):
        for record in (METHODS, CALLABLE, CASES):
            self.assertLessEqual(max(map(len, str(record).splitlines())), 80)

    def test_repr_is_short(self):
        self.assertEqual(repr(CALLABLE), "<clackers.Record verify on three-parameter: disagrees>")


class Notebook(unittest.TestCase):
    def test_html_is_well_formed_without_scripts_or_links_to_nowhere(self):
        class Reader(html.parser.HTMLParser):
            def __init__(self):
                super().__init__()
                self.open, self.text = [], ""

            def handle_starttag(self, tag, attributes):
                if tag not in ("br", "path"):
                    self.open.append(tag)
                assert tag not in ("script", "a"), tag

            def handle_endtag(self, tag):
                if tag not in ("br", "path"):
                    assert self.open.pop() == tag, tag

            def handle_data(self, data):
                self.text += data

        for record, word in ((METHODS, "newmark"), (CALLABLE, "restitution-differs"), (CASES, "stop")):
            reader = Reader()
            reader.feed(record._repr_html_())
            self.assertEqual(reader.open, [])
            self.assertIn(word, reader.text)
            self.assertIn(record.verdict, reader.text)

    def test_mimebundle(self):
        bundle = METHODS._repr_mimebundle_()
        self.assertEqual(bundle["text/plain"], str(METHODS))
        self.assertEqual(bundle["text/html"], METHODS._repr_html_())


class Figures(unittest.TestCase):
    def test_each_holds_its_data_and_no_variables_of_a_style_sheet(self):
        for record in (METHODS, CALLABLE, CASES):
            for name in record.figures:
                spec = record.figure(name).spec
                self.assertNotIn("var(--", json.dumps(spec))
                self.assertNotIn("$", json.dumps(spec).replace("$schema", ""))
                used = set()

                def visit(part):
                    if isinstance(part, dict):
                        if isinstance(part.get("data"), dict):
                            used.add(part["data"]["name"])
                        for value in part.values():
                            visit(value)
                    elif isinstance(part, list):
                        for value in part:
                            visit(value)

                visit({key: value for key, value in spec.items() if key != "datasets"})
                if "data" in spec:
                    used.add(spec["data"]["name"])
                self.assertEqual(set(spec["datasets"]), used)
                for rows in spec["datasets"].values():
                    self.assertTrue(all(isinstance(row, dict) for row in rows))

    def test_convergence_shows_the_runs(self):
        rows = METHODS.figure("convergence").spec["datasets"]["runs"]
        self.assertEqual([row["u_error"] for row in rows], METHODS.table()["u_error"].tolist())

    def test_mimebundle(self):
        figure = METHODS.figure()
        self.assertEqual(figure._repr_mimebundle_()["application/vnd.vegalite.v5+json"], figure.spec)
        self.assertEqual(figure._repr_mimebundle_()["text/plain"], "<clackers.Figure convergence>")

    def test_of_another_case(self):
        first, second = CASES.figure("response"), CASES.figure("response", case="three-parameter")
        self.assertNotEqual(first.spec["datasets"]["response"], second.spec["datasets"]["response"])

    def test_an_unknown_one_is_refused(self):
        with self.assertRaisesRegex(clackers.InputError, "convergence"):
            METHODS.figure("convergense")
        with self.assertRaisesRegex(clackers.InputError, "stop"):
            CASES.figure(case="row")


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_json_reads_back_to_the_same(self):
        for record in (METHODS, CALLABLE, CASES):
            path = self.folder / "record.json"
            record.save(path)
            self.assertEqual(clackers.load(path).to_json(), record.to_json())
            self.assertEqual(str(clackers.load(str(path))), str(record))
        self.assertEqual(clackers.Record.from_json(CALLABLE.to_json()).diagnoses, CALLABLE.diagnoses)

    def test_the_ending_says_what_is_written(self):
        starts = {"a.html": "<!DOCTYPE html>", "a.json": "{", "a.csv": "case,", "a.xml": "<?xml", "a.tex": "%",
                  "a.txt": "Agrees: ", "A.HTML": "<!DOCTYPE html>"}
        for name, start in starts.items():
            with self.subTest(name):
                METHODS.save(self.folder / name)
                self.assertTrue((self.folder / name).read_text().startswith(start),
                                (self.folder / name).read_text()[:40])

    def test_another_ending_is_refused(self):
        for name in ("a.pdf", "record", "html"):
            with self.assertRaisesRegex(clackers.InputError, r"\.html"):
                METHODS.save(self.folder / name)

    def test_a_folder_that_is_not_there(self):
        with self.assertRaises(FileNotFoundError):
            METHODS.save(self.folder / "none" / "a.json")
        with self.assertRaises(FileNotFoundError):
            clackers.load(self.folder / "none.json")

    def test_what_is_no_record_is_refused(self):
        for text in ("", "{}", "[1", "\xff", METHODS.to_json()[:-10]):
            with self.assertRaises(clackers.InputError) as caught:
                clackers.Record.from_json(text)
            self.assertEqual(caught.exception.code, "not-a-record")

    def test_a_file_that_is_no_record_is_named_and_not_quoted_whole(self):
        path = self.folder / "other.json"
        for content in (bytes(range(256)) * 1000, b'"' + 100000 * b"a", b"{}"):
            path.write_bytes(content)
            with self.assertRaisesRegex(clackers.InputError, "other.json") as caught:
                clackers.load(path)
            self.assertEqual(caught.exception.code, "not-a-record")
            self.assertLess(len(str(caught.exception)), 500)

    def test_the_command_compares_with_it(self):
        command = os.environ.get("CLACKERS")
        if not command:
            self.skipTest("CLACKERS names no command")
        path = self.folder / "record.json"
        METHODS.save(path)
        done = subprocess.run([command, "verify", "rk4", "newmark", "--levels", "5", "--samples-per-level", "4",
                               "--baseline", str(path)], capture_output=True, text=True)
        self.assertIn("nothing changed in 2 methods", done.stdout.replace("\n", " "))


class Tables(unittest.TestCase):
    def test_a_row_a_run(self):
        table = METHODS.table()
        self.assertEqual(len(table.rows), 40)
        self.assertEqual(table["method"][0], "rk4")
        self.assertEqual(table["u_error"].dtype, np.float64)

    def test_as_a_data_frame(self):
        try:
            import pandas  # noqa: F401
        except ImportError:
            self.skipTest("pandas is not installed")
        frame = METHODS.table().to_pandas()
        self.assertEqual(len(frame), 40)
        self.assertEqual(frame.attrs["units"]["step"], "s")


if __name__ == "__main__":
    unittest.main()
