"""list, show and explain."""
import csv
import io
import json
import unittest

from command import PANEL, CommandTest, rows

KINDS = ("cases", "integrators", "contacts", "methods", "pairs", "metrics")
CASES = ("sdof", "stop", "symmetric-pair", "one-parameter", "two-parameter", "three-parameter",
         "synchronized-pair", "exact-data-pair", "buildings", "row", "alternating", "assembly", "cradle",
         "forced-pair", "base-excited-pair", "penalized-pair", "piecewise", "ball",
         "pressed-oscillator", "plastic-pair", "billiard", "circle-billiard", "slider", "belt", "forced-slider", "oblique-disk", "pendulum", "duffing-stop", "two-pendula", "pendulum-cradle",
         "bar-wall", "bar-between-stops", "bouncing-bar", "two-bars", "mass-on-bar", "string-over-point", "string-on-obstacle")


class List(CommandTest):
    def names(self, kind):
        return [row[0] for row in self.json_of("list", kind)["rows"]]

    def test_has_the_cases_of_the_grammar(self):
        self.assertEqual(sorted(self.names("cases")), sorted(CASES))

    def test_has_the_default_panel(self):
        title = " ".join(self.good("list", "methods").split("\nname")[0].split())
        self.assertTrue(title.endswith("Default panel: " + ", ".join(PANEL)), title)

    def test_methods_are_integrators_contacts_and_what_stands_alone(self):
        contacts = [name for name in self.names("contacts") if ":" not in name]
        joined = self.names("integrators") + contacts
        self.assertEqual(self.names("methods")[:len(joined)], joined)
        self.assertIn("moreau-jean", self.names("methods")[len(joined):])

    def test_contacts_have_a_row_for_every_compliant_law(self):
        laws = [name for name in self.names("contacts") if name.startswith("penalty:law=")]
        self.assertGreaterEqual(len(laws), 7)
        for law in laws:
            self.assertIn("newmark+" + law, self.names("pairs"))
            self.assertIn(law.split("=")[1], self.good("show", law))

    def test_shows_every_kind_in_every_format_at_80_columns(self):
        for kind in KINDS:
            names = self.names(kind)
            self.assertTrue(names)
            table = self.good("list", kind)
            for line in table.splitlines():
                self.assertLessEqual(len(line), 80, line)
            first = list(csv.reader(io.StringIO(self.good("list", kind, "--format", "csv"))))
            self.assertEqual([row[0] for row in first[1:]], names)
            self.assertRegex(self.json_of("list", kind)["schema"], r"\Aclackers/[a-z]+/\d+\Z")

    def test_without_a_kind_shows_all_but_what_repeats_it(self):
        together = ("cases", "methods", "metrics")
        self.assertEqual(self.good("list"), "\n".join(self.good("list", kind) for kind in together))
        whole = self.json_of("list")
        self.assertEqual(whole["schema"], "clackers/list/1")
        self.assertEqual([s["schema"] for s in whole["sheets"]],
                         [self.json_of("list", kind)["schema"] for kind in together])

    def test_refuses_an_unknown_kind(self):
        self.refused("list", "integrator", code="unknown-name", says='Did you mean "integrators"?')


class Show(CommandTest):
    def test_a_case_in_every_format_at_80_columns(self):
        for name in CASES:
            for line in self.good("show", name).splitlines():
                self.assertLessEqual(len(line), 80, line)
            whole = self.json_of("show", name)
            self.assertEqual(whole["schema"], "clackers/show/1")
            self.assertIn("t_end", json.dumps(whole))

    def test_honours_set_in_one_list_and_repeated(self):
        together = self.good("show", "three-parameter", "--set", "N=3,xi1=0.1")
        apart = self.good("show", "three-parameter", "--set", "N=3", "--set=xi1=1e-1")
        self.assertEqual(together, apart)
        self.assertNotEqual(together, self.good("show", "three-parameter"))

    def test_set_does_not_swallow_the_name_behind_it(self):
        self.assertEqual(self.good("show", "--set", "N=3", "three-parameter"),
                         self.good("show", "three-parameter", "--set", "N=3"))

    def test_a_method_has_its_curves_as_figures_and_as_numbers(self):
        self.assertIn("Period elongation and amplitude decay of newmark", self.good("show", "newmark"))
        sheets = {sheet["schema"]: sheet for sheet in self.json_of("show", "newmark+penalty")["sheets"]}
        decay = sheets["clackers/accuracy/1"]
        self.assertEqual([column["name"] for column in decay["columns"]], ["h/T", "period_elongation", "amplitude_decay"])
        self.assertEqual(len(decay["rows"]), 40)

    def test_writes_a_page(self):
        for name in ("three-parameter", "newmark", "moreau-jean", "penalty"):
            self.good("show", name, "--quiet", "--report", self.path("page.html"))
            page = self.text_of("page.html")
            self.assertRegex(page, f"<h1>{name}")
            self.assertIn("clackers show " + name, page)

    def test_takes_fractions(self):
        self.assertEqual(self.good("show", "sdof", "--set", "xi1=1/10"),
                         self.good("show", "sdof", "--set", "xi1=0.1"))

    def test_takes_numbers_with_a_sign(self):
        self.assertEqual(self.good("show", "sdof", "--set", "xi1=+0.1"),
                         self.good("show", "sdof", "--set", "xi1=0.1"))

    def test_honours_the_threshold(self):
        self.assertNotEqual(self.good("show", "three-parameter", "--threshold", "0.4"),
                            self.good("show", "three-parameter"))
        for bad in ("0", "1", "-0.1", "nan"):
            done = self.refused("show", "three-parameter", "--threshold", bad, code="[a-z-]+")
            self.assertIn("threshold", done)
        self.refused("show", "three-parameter", "--threshold", "low", code="not-a-number")

    def test_a_method_with_its_card(self):
        for name in PANEL + ("newmark:beta=0.25,gamma=0.5+penalty:stiffness=1e6", "penalty"):
            text = self.good("show", name)
            for line in text.splitlines():
                self.assertLessEqual(len(line), 80, line)
        self.assertIn("Source", self.good("show", "rk4"))
        self.assertEqual(self.json_of("show", "rk4")["schema"], "clackers/show/1")

    def test_refuses_unknown_names_looking_at_cases_and_methods(self):
        self.refused("show", "three-paramter", code="unknown-name", says='"three-parameter"')
        self.refused("show", "newmrak", code="unknown-name", says='"newmark"')
        self.refused("show", "moreau-jaen:theta=0.5", code="unknown-name", says='"moreau-jean"')
        self.refused("show", "newmark+penatly", code="unknown-name", says='"penalty"')
        self.refused("show", "newmark:bate=0", code="unknown-name", says='"beta"')

    def test_refuses_what_it_cannot_honour(self):
        self.refused("show", code="bad-syntax", says="needs a CASE or METHOD")
        self.refused("show", "newmark", "--set", "N=2", code="bad-syntax", says="newmark:beta=0.25")
        self.refused("show", "rk4", "--threshold", "0.2", code="bad-syntax")
        self.refused("show", "newmark:beta=2", code="out-of-range", says=("beta = 2", "1/2"))


class Explain(CommandTest):
    def test_tells_one_code(self):
        text = self.good("explain", "stagnating")
        self.assertIn("stops shrinking", " ".join(text.split()))

    def test_alone_lists_all_at_80_columns(self):
        text = self.good("explain")
        for line in text.splitlines():
            self.assertLessEqual(len(line), 80, line)
        listed = rows(self.good("explain", "--format", "csv"))
        codes = [row["code"] for row in listed]
        self.assertEqual(len(codes), len(set(codes)))
        for code in ("proper", "agrees", "bad-syntax", "cannot-write", "interrupted"):
            self.assertIn(code, codes)
            self.assertIn(code, text)

    def test_refuses_an_unknown_code(self):
        self.refused("explain", "stagnatng", code="unknown-name", says='"stagnating"')


if __name__ == "__main__":
    unittest.main()
