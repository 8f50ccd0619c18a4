"""What the tests beside this file share: the pair's numbers, a folder, and the command."""
import json
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.append(os.path.join(HERE, "..", "cli"))
from command import CommandTest, run  # noqa: E402


def pair(*settings):
    """All constants of the default case by name: m1, k1, c1, "u1(0)", "d2", "v1(0)", eta, t_end, ..."""
    options = ["--set", ",".join(settings)] if settings else []
    shown = run("show", "three-parameter", *options, "--format", "json")
    constants = {}
    for sheet in json.loads(shown.stdout)["sheets"]:
        names = [column["name"] for column in sheet["columns"]]
        if "name" in names and "value" in names:
            for row in sheet["rows"]:
                constants[row[names.index("name")]] = row[names.index("value")]
    return constants


def runs(subject):
    """The runs of a subject, coarsest first."""
    return [run for level in subject["levels"] for run in level["runs"]]


class PeerTest(CommandTest):
    def checked(self, *arguments, exit_code=0):
        """The subject of the record of a check that must end with that exit code."""
        done = run("check", *arguments, "--format", "json")
        self.assertEqual((done.returncode, done.stderr), (exit_code, ""),
                         run("check", *arguments).stdout)
        return json.loads(done.stdout)["cases"][0]["subjects"][0]

    def assert_six_impacts(self, run, time_error):
        """A run has all six impacts and no other, each within `time_error` [s]."""
        impacts = run["impacts"]
        self.assertEqual((impacts["expected"], impacts["matched"], impacts["missed"],
                          impacts["extra"]), (6, 6, 0, 0), run["file"]["notes"])
        self.assertLess(impacts["worst_time_error"], time_error)
