"""clackers cite and clackers --version --verbose."""
import re
import unittest

from command import CommandTest, run

ENTRY = re.compile(r"^@(\w+)\{([\w-]+),\n((?:  \w+ = \{.*\},?\n)+)\}$", re.MULTILINE)


def entries(text):
    """Kind and fields by key, of what a reader of BibTeX takes; nothing else may begin with @."""
    found = {key: (kind, dict(re.findall(r"  (\w+) = \{(.*)\},?\n", fields))) for kind, key, fields in ENTRY.findall(text)}
    assert len(found) == text.count("\n@") + text.startswith("@"), text
    return found


class Cite(CommandTest):
    def test_program_and_paper(self):
        found = entries(self.good("cite"))
        self.assertEqual(set(found), {"clackers", "soroushian2018"})
        self.assertEqual(found["clackers"][1]["version"], run("--version").stdout.split()[1])

    def test_methods_bring_the_sources_on_their_cards(self):
        text = self.good("cite", "newmark:beta=0.25+penalty", "rk4", "three-parameter", "stop")
        found = entries(text)
        self.assertEqual(found["newmark1959"][1], {
            "author": "N. M. Newmark", "journal": "J. Eng. Mech. Div. ASCE", "volume": "85", "number": "EM3", "pages": "67--94", "year": "1959"})
        self.assertEqual(found["shampine1991"][1]["author"], "L. F. Shampine and I. Gladwell and R. W. Brankin")
        self.assertEqual(found["wriggers2006"][1]["title"], "Computational Contact Mechanics")
        self.assertIn("% case three-parameter: soroushian2018, Eq. (25)-(26)", text)

    def test_a_law_brings_its_own_source(self):
        found = entries(self.good("cite", "newmark+penalty:law=jankowski,stiffness=1e6", "rk4+penalty:law=kelvin-voigt"))
        self.assertLessEqual({"wriggers2006", "jankowski2006", "anagnostopoulos1988"}, set(found))
        self.assertNotIn("anagnostopoulos2004", found)

    def test_every_method_has_a_source_or_says_that_it_has_none(self):
        names = [row["name"] for row in self.rows_of("list", "methods")]
        text = self.good("cite", *names)
        comments = "\n".join(re.findall(r"^% .*", text, re.MULTILINE))
        for name in names:
            self.assertRegex(comments, rf"[ ,]{re.escape(name)}(,|:|$|\n)")
        for key, (_, fields) in entries(text).items():
            if key != "clackers":
                self.assertRegex(fields["year"], r"^(1[89]|20)\d\d$")
                self.assertTrue("journal" in fields or "title" in fields, key)
                self.assertNotRegex(fields["author"], r"\d|,.*,.*,.*,", key)
        self.assertEqual(re.findall(r"^% (.*): no publication", text, re.MULTILINE), ["reversal"])

    def test_a_record_brings_its_methods_and_cases(self):
        record = self.path("record.json")
        run("verify", "rk4", "newmark+reversal", "--case", "stop", "--levels", "2", "--samples-per-level", "1", "--format", "json", "--out", record, "--quiet")
        found = entries(self.good("cite", "--record", record))
        self.assertEqual(set(found), {"clackers", "soroushian2018", "kutta1901", "shampine1991", "newmark1959"})
        self.assertEqual(entries(self.good("cite", record)), found)
        self.assertEqual(entries(self.good("cite", "rk4", record, "newmark")), found)

    def test_a_file_that_is_no_record_is_refused(self):
        bad = self.path("bad.json")
        with open(bad, "w") as file:
            file.write("{}")
        self.refused("cite", bad, says=f"cite {bad}", code="[a-z-]+")
        self.refused("report", bad, bad, says=f"report {bad}", code="[a-z-]+")

    def test_other_names_are_refused(self):
        self.refused("cite", "newmrak", says="newmark", code="unknown-name")
        self.refused("cite", "--record", "nowhere.json", says="nowhere.json", code="cannot-read", exit_code=4)


class Version(CommandTest):
    def test_verbose_names_compiler_vectors_and_libraries(self):
        lines = dict(line.split(None, 1) for line in self.good("--version", "--verbose").splitlines())
        self.assertRegex(lines["compiler"], r"(GCC|Clang) \d+")
        self.assertIn("SSE4", lines["vectors"])
        self.assertRegex(lines["libraries"], r"Boost [\d.]+, Eigen [\d.]+, fmt [\d.]+, Highway [\d.]+")
        self.refused("--version", "--loud", says="--verbose", code="bad-syntax")


if __name__ == "__main__":
    unittest.main()
