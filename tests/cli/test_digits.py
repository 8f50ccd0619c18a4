"""respond --digits: correctly rounded values of any length, and what it refuses."""
import decimal
import math
import unittest

from command import CommandTest, run

CASES = ("sdof", "stop", "symmetric-pair", "one-parameter", "two-parameter", "three-parameter",
         "synchronized-pair", "exact-data-pair", "buildings", "row", "alternating", "assembly",
         "cradle", "forced-pair", "base-excited-pair", "circle-billiard", "oblique-disk")
TEXTS = ("t", "side")


def significant(text):
    """The significant digits of a number as they are written."""
    return len(text.split("e")[0].replace("-", "").replace(".", "").lstrip("0"))


class Digits(CommandTest):
    def test_agree_with_the_doubles_of_every_case(self):
        for case in CASES:
            for way in (("--samples", "7"), ("--step", "3.3"), ("--impacts",)):
                plain = self.rows_of("respond", case, *way)
                long = self.rows_of("respond", case, *way, "--digits", "40")
                self.assertEqual(len(plain), len(long))
                for p, l in zip(plain, long):
                    self.assertEqual(list(p), list(l))
                    for name in p:
                        if p[name] in ("", "-", "+") or name in ("k", "contact"):
                            self.assertEqual(p[name], l[name])
                            continue
                        # Half a unit of the envelope, which is below 82 for the default cases.
                        self.assertLess(abs(float(p[name]) - float(l[name])), 82 * 2**-52)
                        if l[name] != "0":
                            self.assertEqual(significant(l[name]), 40, l[name])

    def test_of_a_ball_at_rest_are_zeros(self):
        row = self.rows_of("respond", "ball", "--samples", "2", "--digits", "40")[1]
        self.assertEqual([row["u1"], row["v1"], row["a1"]], ["0", "0", "0"])
        # Close to rest, and at rest, where infinitely many impacts have the same double.
        row = self.rows_of("respond", "ball", "--times", "-", "--digits", "20", stdin="4.0637125\n")[0]
        self.assertEqual(row["u1"], "4.4190296388057991976e-15")
        self.refused("respond", "ball", "--set", "g=2,eta=0.5", "--times", "-", "--digits", "40",
                     stdin="3\n", code="no-enclosure", says=("accumulate",))

    def test_of_the_slow_mass_are_those_of_eq_22_computed_here(self):
        # u1 = e^(-0.05 t) |cos(sqrt(0.9975) t)| for the double 0.05, by series with 120 digits.
        with decimal.localcontext(prec=120):
            xi, t = decimal.Decimal(0.05), decimal.Decimal(7.3)
            phase = (1 - xi * xi).sqrt() * t
            term, cosine = decimal.Decimal(1), decimal.Decimal(0)
            for n in range(0, 200, 2):
                cosine += term
                term *= -phase * phase / ((n + 1) * (n + 2))
            expected = (-xi * t).exp() * abs(cosine)
            for n in (1, 2, 17, 50, 100):
                row = self.rows_of("respond", "three-parameter", "--times", "-", "--digits", str(n),
                                   stdin="7.3\n")[0]
                ours = decimal.Decimal(row["u1"])
                self.assertLessEqual(abs(ours - expected), expected.scaleb(-n) * 5)
                self.assertEqual(significant(row["u1"]), n)

    def test_of_impact_times_are_those_of_pi(self):
        # Without damping and with k1 = m1 the third impact is at 5 pi/2.
        row = self.rows_of("respond", "two-parameter", "--set", "xi1=0", "--impacts",
                           "--digits", "50")[2]
        self.assertEqual(row["t"], "7.8539816339744830961566084581987572104929234984378")
        self.assertEqual((row["k"], row["u1"]), ("3", "0"))
        self.assertEqual(row["v1-"], "-1." + 49 * "0")
        self.assertEqual(row["impulse"], "2." + 49 * "0")

    def test_of_times_read_back_as_the_same_doubles(self):
        plain = self.rows_of("respond", "sdof", "--samples", "8")
        for n in ("1", "17", "60"):
            rows = self.rows_of("respond", "sdof", "--samples", "8", "--digits", n)
            self.assertEqual([float(r["t"]) for r in rows], [float(r["t"]) for r in plain])
        self.assertEqual(rows[-1]["t"], "20." + 58 * "0")

    def test_up_to_1000_and_down_to_1(self):
        for n in (1, 1000):
            row = self.rows_of("respond", "stop", "--samples", "3", "--digits", str(n))[1]
            self.assertEqual(significant(row["v1"]), n)

    def test_beside_an_impact_both_sides_are_told(self):
        hit = self.rows_of("respond", "three-parameter", "--impacts")[1]["t"]
        rows = self.rows_of("respond", "three-parameter", "--times", "-", "--digits", "30",
                            stdin=hit + "\n")
        self.assertEqual([r["side"] for r in rows], ["-", "+"])
        self.assertLess(float(rows[0]["v1"]), 0)
        self.assertGreater(float(rows[1]["v1"]), 0)

    def test_are_texts_in_json(self):
        whole = self.json_of("respond", "three-parameter", "--samples", "3", "--digits", "30")
        self.assertEqual(whole["schema"], "clackers/response-digits/1")
        self.assertIn("30 digits", whole["title"])
        self.assertIsInstance(whole["rows"][0][2], str)
        hits = self.json_of("respond", "stop", "--impacts", "--digits", "30")
        self.assertEqual(hits["schema"], "clackers/impacts-digits/1")
        self.assertEqual(hits["columns"][1]["meaning"], "its time")
        self.assertIsInstance(hits["rows"][0][1], str)

    def test_are_shown_whole_in_a_table_of_80_columns(self):
        text = self.good("respond", "three-parameter", "--samples", "3", "--digits", "50")
        number = self.rows_of("respond", "three-parameter", "--samples", "3", "--digits", "50")[1]["u2"]
        self.assertIn(number, text)
        for line in text.splitlines():
            self.assertLessEqual(len(line), 80)


class Refusals(CommandTest):
    def test_of_numbers_of_digits(self):
        for bad in ("0", "-3", "1001", "1e9"):
            self.refused("respond", "sdof", "--samples", "3", "--digits", bad,
                         code="out-of-range", says=("--digits", "1 to 1000"))
        self.refused("respond", "sdof", "--samples", "3", "--digits", "2.5", code="out-of-range",
                     says="whole number")
        self.refused("respond", "sdof", "--samples", "3", "--digits", "many", code="not-a-number",
                     says="many")

    def test_of_a_picture_and_of_no_times(self):
        self.refused("respond", "sdof", "--samples", "3", "--digits", "20", "--plot",
                     code="bad-syntax", says=("--plot", "--digits"))
        self.refused("respond", "sdof", "--digits", "20", code="bad-syntax", says="needs times")

    def test_of_a_motion_that_decayed_beyond_all_counting(self):
        # exp(-sigma t) with sigma t = 1e16.
        self.refused("respond", "sdof", "--set", "xi1=0.9999999999999999,t_end=1e16", "--times", "-",
                     "--digits", "20", stdin="1e16\n", code="out-of-range", says="decayed")


if __name__ == "__main__":
    unittest.main()
