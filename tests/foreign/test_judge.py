"""The comparison with the expert's word finds each kind of difference."""
import json
import types
import unittest

import comparison
import judge

WORD = {"name": "x/5", "system": "N2", "solver": "", "behaviour": ["proper"], "order": [3.9, 4.1],
        "verdict": ["agrees"], "says": {"restitution-differs|impact-impulse-wrong": [0.98, 1.0]}}


def answer(behaviour="proper", order=4.0, verdict="agrees", exit_code=0, causes=(("restitution-differs", 0.99, "1"),)):
    subject = {"assessment": {"displacement": {"behaviour": behaviour, "reason": "", "has_line": True, "order": order},
                              "verdict": verdict, "reason": ""},
               "diagnoses": [{"code": c, "value": v, "unit": u} for c, v, u in causes]}
    record = {"cases": [{"subjects": [subject]}]}
    return comparison.Answer(types.SimpleNamespace(returncode=exit_code, stderr="", stdout=json.dumps(record)))


def refusal(code):
    return comparison.Answer(types.SimpleNamespace(returncode=2, stderr=f"clackers: words [{code}]\n", stdout=""))


class Faults(unittest.TestCase):
    def test_the_expected_answer_has_none(self):
        self.assertEqual(comparison.faults(WORD, answer()), [])

    def test_each_difference_is_one(self):
        for wrong in (answer(behaviour="exact"), answer(order=3.5), answer(verdict="not claimed"),
                      answer(exit_code=1), answer(causes=()), answer(causes=[("restitution-differs", "nan", "")]),
                      answer(causes=[("restitution-differs", 0.9, "1")]), refusal("unit-scaled")):
            self.assertEqual(len(comparison.faults(WORD, wrong)), 1, str(wrong))

    def test_a_false_alarm_is_one_and_a_companion_is_none(self):
        right = ("restitution-differs", 0.99, "1")
        self.assertEqual(comparison.faults(WORD, answer(causes=[right, ("time-shifted", 1, "steps")])), ["says time-shifted"])
        for companion in ("wrong-limit", "period-error"):
            self.assertEqual(comparison.faults(WORD, answer(causes=[right, (companion, 1, "1")])), [])

    def test_a_value_in_percent_is_a_share(self):
        word = {**WORD, "says": {"frequency-differs": [0.0045, 0.0055]}}
        self.assertEqual(comparison.faults(word, answer(causes=[("frequency-differs", 0.498, "%")])), [])
        self.assertTrue(comparison.faults(word, answer(causes=[("frequency-differs", 0.498, "1")])))

    def test_a_refusal_needs_its_code(self):
        word = {"refused": ["unit-scaled"]}
        self.assertEqual(comparison.faults(word, refusal("unit-scaled")), [])
        self.assertEqual(comparison.faults(word, refusal("not-this-case")), ["refused [not-this-case]"])
        self.assertEqual(comparison.faults(word, answer()), ["not refused"])


class Sets(unittest.TestCase):
    def test_every_set_names_a_system_and_a_reason(self):
        systems, sets = judge.load()
        for one in sets:
            self.assertIn(one["system"], systems)
            self.assertTrue(one.get("why"), one["name"])

    def test_twenty_files_are_five_octaves_of_four(self):
        counts = judge.step_counts("20", 0.02, 20.0)
        self.assertEqual(counts[::4], [1000, 2000, 4000, 8000, 16000])
        self.assertEqual(len(counts), 20)


if __name__ == "__main__":
    unittest.main()
