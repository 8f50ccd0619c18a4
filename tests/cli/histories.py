"""What tests of check share: files with the exact response, changed as a test needs."""
import json
import math

from command import CommandTest, rows, run

COLUMNS = ("t", "u1", "v1", "u2", "v2")


class CheckTest(CommandTest):
    @classmethod
    def setUpClass(cls):
        """The exact response of the default case every 0.01 s, and its impacts."""
        cls.response = run("respond", "three-parameter", "--step", "0.01", "--format", "csv").stdout
        cls.exact = [{k: row[k] if k == "side" else float(row[k]) for k in row}
                     for row in rows(cls.response)]
        cls.hits = run("respond", "three-parameter", "--impacts", "--format", "csv").stdout

    def write(self, name, text, mode="w", **more):
        path = self.path(name)
        with open(path, mode, **more) as file:
            file.write(text)
        return path

    def history(self, name, digits=17, every=1, columns=COLUMNS, between=",", header=True,
                change=lambda row: row, until=math.inf):
        """A file with the exact response, changed row by row."""
        lines = [between.join(columns)] if header else []
        for row in self.exact[::every]:
            row = change(dict(row))
            if row["t"] > until:
                break
            lines.append(between.join(f"{row[c]:.{digits}g}" for c in columns))
        return self.write(name, "\n".join(lines) + "\n")

    def converging(self, order=2, digits=17, levels=6, factor=1.0):
        """Files of a method of that order: the exact motion with an error factor (8 h)^order."""
        files = []
        for level in range(levels):
            h = 0.01 / 2**level
            def change(row):
                row["u1"] += factor * (8 * h)**order * math.sin(row["t"])
                return row
            files.append(self.history(f"h{h:.10g}.csv", digits, change=change))
        return files

    def checked(self, *arguments, exit_code=0):
        done = run("check", *arguments, "--format", "json")
        if (done.returncode, done.stderr) != (exit_code, ""):
            self.fail(f"{arguments}: {done.returncode} {done.stderr}\n" + run("check", *arguments).stdout)
        return json.loads(done.stdout)

    def runs(self, record):
        """The histories of a record, coarsest first."""
        subject, = record["cases"][0]["subjects"]
        return [run for level in subject["levels"] for run in level["runs"]]

    def assessment(self, record):
        return record["cases"][0]["subjects"][0]["assessment"]

    def notes(self, record):
        """The notes of all histories: numbers and text by code."""
        return {note["code"]: (note["numbers"], note["text"])
                for run in self.runs(record) for note in run["file"]["notes"]}
