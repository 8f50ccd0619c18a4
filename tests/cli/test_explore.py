"""clackers explore: the page and where its dials stand. What they do is tested in a browser."""
import json
import os
import pathlib
import re
import unittest

from command import CommandTest, run


class Explore(CommandTest):
    def dials(self, *words):
        page = self.path("page.html")
        self.good("explore", *words, "--out", page, "--quiet")
        text = pathlib.Path(page).read_text()
        self.assertNotRegex(text, "<script[^>]* src=")
        return json.loads(re.search(r'id="data">(.*?)</script>', text, re.S)[1])["dials"]

    def test_dials_stand_at_the_parameters_that_are_given(self):
        self.assertEqual(self.dials(), {"X": 9, "xi1": 0.05, "a_t": 1, "r": 3, "eta": 1})
        self.assertEqual(self.dials("three-parameter", "--set", "N=1,xi1=0.1,a_t=2"),
                         {"X": 5, "xi1": 0.1, "a_t": 2, "r": 3, "eta": 1})
        self.assertEqual(self.dials("synchronized-pair", "--set", "X=3,r=2,eta=0.7,t_end=10"),
                         {"X": 3, "xi1": 0.05, "a_t": 0.5, "r": 2, "eta": 0.7})

    def test_without_out_the_page_is_in_the_current_folder(self):
        done = run("explore", cwd=self.path(""))
        self.assertEqual((done.returncode, done.stdout), (0, ""))
        self.assertTrue(os.path.exists(self.path("clackers-explore.html")))

    def test_other_cases_are_refused(self):
        self.refused("explore", "stop", says="clackers respond stop", code="no-closed-form")
        self.refused("explore", "synchronized-pair", "--set", "m1=2", says="m1 = 2", code="out-of-range")
        self.refused("explore", "synchronized-pair", "--set", "eta=0", says="eta above 0", code="out-of-range")
        self.refused("explore", "synchronized-pair", "--set", "r=5", says="r", code="not-admissible")
        self.refused("explore", "--out", self.path("page.pdf"), says=("--out = ", "FILE.html"), code="bad-syntax")
        self.refused("explore", "--out", "/proc/page.html", says="/proc/page.html", code="cannot-write", exit_code=4)


if __name__ == "__main__":
    unittest.main()
