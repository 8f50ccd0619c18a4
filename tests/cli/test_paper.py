"""clackers paper: the folder it writes, and what it does without the programs that draw."""
import csv
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import time
import unittest
import xml.etree.ElementTree

from command import PROGRAM, CommandTest, environment, run, start

CAN_DRAW = shutil.which("node") and shutil.which("rsvg-convert")
ROOT = pathlib.Path(__file__).resolve().parents[2]
MANUAL_PAGE = ROOT / "docs" / "manual" / "explanation" / "claims.md"
CLAIMS = ROOT / "paper" / "claims" / "claims.json"
FILES = ["fig12.csv", "fig12.pdf", "fig12.svg", "fig12.vl.json", "index.html", "paper.json"]


def run_with_path(path, *arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=60,
                          env=environment(PATH=path))


class Folder(CommandTest):
    def written(self, name="figures"):
        return sorted(os.listdir(self.path(name)))

    def read(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return file.read()

    @unittest.skipUnless(CAN_DRAW, "node and rsvg-convert draw")
    def test_one_figure_is_written_whole_with_page_numbers_and_pictures(self):
        done = run("paper", "fig12", "--out", self.path("figures"))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr, f"Wrote {self.path('figures')}\n")
        self.assertEqual(self.written(), FILES)
        self.assertEqual(self.files(), ["figures"])
        root = xml.etree.ElementTree.fromstring(self.read("figures/fig12.svg"))
        self.assertTrue(root.tag.endswith("svg"))
        texts = "".join(root.itertext())
        for text in ("(a)  the first mass", "time t [s]", "displacement u [m]", "without impacts"):
            self.assertIn(text, texts)
        with open(self.path("figures/fig12.pdf"), "rb") as file:
            self.assertEqual(file.read(5), b"%PDF-")
        self.assertIn("data:image/svg+xml,%3Csvg", self.read("figures/index.html"))

    @unittest.skipUnless(CAN_DRAW, "node and rsvg-convert draw")
    def test_every_figure_is_drawn_and_every_claim_is_that_of_the_manual(self):
        done = run("paper", "--out", self.path("figures"), "--format", "json", timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        listed = [row["name"] for row in json_rows(self.good("list", "figures", "--format", "json"))]
        self.assertEqual(len(listed), 16)
        for name in listed:
            self.assertIn(f"{name}.pdf", self.written())
        claims = json_rows(done.stdout)
        self.assertGreater(len(claims), 60)
        self.assertEqual(len({claim["claim"] for claim in claims}), len(claims))
        page = manual_page(claims)
        if os.environ.get("CLACKERS_APPROVE"):
            MANUAL_PAGE.write_text(page, encoding="utf-8")
        self.assertEqual(MANUAL_PAGE.read_text(encoding="utf-8"), page,
                         "CLACKERS_APPROVE=1 in the environment of this test writes the page")
        self.numbers_stay_whole(self.read("figures/index.html"), claims)

    def numbers_stay_whole(self, page, claims):
        """Numbers with an exponent stand in elements that do not wrap."""
        spans = re.findall(r'<span class="n">(.*?)</span>', page)
        numbers = {number for claim in claims for number in re.findall(r"[\d.]+e-\d+", claim["measured"])}
        self.assertGreater(len(numbers), 20)
        for number in numbers:
            self.assertTrue(any(number in span for span in spans), number)

    def test_curves_of_fig_12_coincide_in_the_csv(self):
        run_with_path("", "paper", "fig12", "--out", self.path("figures"))
        table = list(csv.DictReader(self.read("figures/fig12.csv").splitlines()))
        self.assertEqual({row["panel"] for row in table}, {"a", "b"})
        for panel in ("a", "b"):
            curves = {}
            for row in table:
                if row["panel"] == panel:
                    curves.setdefault(row["series"], {})[row["x"]] = float(row["y"])
            ghost = curves.pop("without impacts")
            points = curves.pop("coincidence")
            (actual,) = curves.values()
            self.assertEqual(len(points), 3)
            for t, u in points.items():
                near = min(actual, key=lambda x: abs(float(x) - float(t)))
                self.assertAlmostEqual(actual[near], u, 12)
                self.assertAlmostEqual(ghost[near], u, 12)

    def test_without_node_numbers_specifications_and_page_are_written(self):
        done = run_with_path("", "paper", "fig12", "--out", self.path("figures"))
        self.assertEqual(done.returncode, 4)
        self.assertIn("no program node on the PATH", done.stderr.replace("\n", " "))
        self.assertIn("[no-renderer]", done.stderr)
        self.assertEqual(self.written(), ["fig12.csv", "fig12.vl.json", "index.html", "paper.json"])

    def test_an_earlier_folder_is_replaced_and_a_foreign_one_refused(self):
        for names in (("fig12", "fig2"), ("fig2",)):
            done = run_with_path("", "paper", *names, "--out", self.path("figures"))
            self.assertEqual(done.returncode, 4)
        self.assertEqual(self.written(), ["fig2.csv", "fig2.vl.json", "index.html", "paper.json"])
        with open(self.path("figures/mine.txt"), "w"):
            pass
        self.refused("paper", "fig2", "--out", self.path("figures"), code="foreign-folder",
                     says="mine.txt")
        self.assertIn("mine.txt", self.written())

    def started(self, figure="fig2"):
        """A run that replaces a folder of an earlier one, while it works."""
        run_with_path("", "paper", figure, "--out", self.path("figures"))
        process = start("paper", "--out", self.path("figures"), stdout=subprocess.DEVNULL,
                        stderr=subprocess.DEVNULL, env=environment(PATH=""))
        self.wait_for(lambda: len(self.files()) == 2)
        return process

    def test_what_comes_into_the_folder_meanwhile_is_kept(self):
        run_with_path("", "paper", "fig2", "--out", self.path("figures"))
        process = start("paper", "fig12", "fig10", "--out", self.path("figures"), stdout=subprocess.DEVNULL,
                        stderr=subprocess.DEVNULL, env=environment(PATH=""))
        self.wait_for(lambda: len(self.files()) == 2)
        process.send_signal(signal.SIGSTOP)
        with open(self.path("figures/mine.txt"), "w") as file:
            file.write("mine")
        os.mkdir(self.path("figures/folder"))
        process.send_signal(signal.SIGCONT)
        self.assertEqual(process.wait(60), 4)
        self.assertEqual(self.read("figures/mine.txt"), "mine")
        self.assertEqual(self.written(), ["fig10.csv", "fig10.vl.json", "fig12.csv", "fig12.vl.json", "folder",
                                          "index.html", "mine.txt", "paper.json"])
        self.assertEqual(self.files(), ["figures"])

    def test_a_second_signal_leaves_the_old_folder_and_nothing_else(self):
        process = self.started()
        before = self.written()
        process.send_signal(signal.SIGSTOP)
        process.send_signal(signal.SIGINT)
        process.send_signal(signal.SIGTERM)
        process.send_signal(signal.SIGCONT)
        self.assertEqual(process.wait(10), 130)
        self.assertEqual((self.files(), self.written()), (["figures"], before))

    def test_other_signals_leave_the_old_folder_and_nothing_else(self):
        for sign in (signal.SIGXCPU, signal.SIGUSR1, signal.SIGALRM):
            process = self.started()
            before = self.written()
            process.send_signal(sign)
            self.assertEqual(process.wait(10), -sign)
            self.assertEqual((self.files(), self.written()), (["figures"], before))

    def test_names_in_an_earlier_list_do_not_reach_other_folders(self):
        run_with_path("", "paper", "fig2", "--out", self.path("figures"))
        with open(self.path("precious"), "w") as file:
            file.write("mine")
        listed = self.read("figures/paper.json").replace("fig2.csv", "../precious")
        os.unlink(self.path("figures/fig2.csv"))
        with open(self.path("figures/paper.json"), "w") as file:
            file.write(listed)
        run_with_path("", "paper", "fig2", "--out", self.path("figures"))
        self.assertEqual(self.read("precious"), "mine")

    def test_an_empty_folder_is_filled_and_a_file_refused(self):
        os.mkdir(self.path("figures"))
        self.assertEqual(run_with_path("", "paper", "fig2", "--out", self.path("figures/")).returncode, 4)
        self.assertIn("fig2.csv", self.written())
        with open(self.path("file"), "w") as file:
            file.write("mine")
        self.refused("paper", "fig2", "--out", self.path("file"), code="cannot-write", exit_code=4)
        self.assertEqual(self.read("file"), "mine")
        self.refused("paper", "fig2", "--out", self.path("nowhere/figures"), code="cannot-write",
                     exit_code=4)
        self.assertEqual(self.files(), ["figures", "file"])

    def test_refusals_in_words(self):
        out = ("--out", self.path("x"))
        self.refused("paper", "figure99", *out, code="unknown-name", says='no figure "figure99"')
        self.refused("paper", "figA", *out, code="unknown-name", says="Did you mean")
        self.refused("paper", "fig1", code="bad-syntax", says="--out FOLDER")
        self.refused("list", "figurs", code="unknown-name", says='Did you mean "figures"?')
        self.assertEqual(self.files(), [])

    def test_ctrl_c_leaves_nothing(self):
        process = start("paper", "--out", self.path("figures"), stdout=subprocess.DEVNULL,
                        stderr=subprocess.DEVNULL)
        self.wait_for(self.files)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(60), 130)
        self.assertEqual(self.files(), [])

    def test_ctrl_c_in_the_validation_stops_at_once(self):
        process = start("paper", "validation", "--out", self.path("figures"), "--quiet",
                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.wait_for(self.files)
        time.sleep(0.5)
        self.assertIsNone(process.poll(), "the validation takes seconds")
        sent = time.monotonic()
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(60), 130)
        self.assertLess(time.monotonic() - sent, 2.0)  # 0.2 s on a machine with nothing else to do
        self.assertEqual(self.files(), [])


HEAD = """# The claims of the paper, measured

What the text of the [paper](paper.md) claims, section by section, and what `clackers paper` found, with
numbers beside the figure that is named. The test `cli.test_paper` compares this page with the command.
"""


def manual_page(claims):
    """docs/manual/explanation/claims.md. The command has the claims by figure."""
    def plain(text):
        return text.replace("*", "\\*")
    order = {row["name"]: i for i, row in enumerate(json.loads(CLAIMS.read_text(encoding="utf-8")))}
    out, section = HEAD, None
    for claim in sorted(claims, key=lambda claim: order[claim["claim"]]):
        if claim["section"] != section:
            section = claim["section"]
            out += f"\n## {section}\n"
        word = " because" if claim["verdict"] == "not measurable" else ""
        found = f"**{claim['verdict'].capitalize()}**" + (f"{word} {plain(claim['condition'])}" if claim["condition"] else "")
        out += f"\n### {claim['claim']}\n\n{plain(claim['says'])} {found} (`{claim['figure']}`).\n"
    return out


def json_rows(text):
    """The rows of a json answer as dictionaries."""
    answer = json.loads(text)
    names = [column["name"] for column in answer["columns"]]
    return [dict(zip(names, row)) for row in answer["rows"]]


if __name__ == "__main__":
    unittest.main()
