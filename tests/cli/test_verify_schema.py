"""The json of a record is what docs/schemas/record-1.json says, and nothing else is."""
import copy
import json
import os
import unittest

import jsonschema  # Debian: python3-jsonschema

from command import CommandTest, run

SCHEMA = os.path.join(os.path.dirname(__file__), "../../docs/schemas/record-1.json")

# Values that some other field might have; of them a bent record is made.
OTHERS = (None, True, 7, 0.5, "text", [], {})

# Fields that records of earlier versions lack.
ADDED = {"acting_gap", "labels", "integrator", "treatment", "cancel_step", "contact_forces", "departure", "diagnoses", "drawing", "floor_scatter", "floor_step",
         "impact_contacts", "impact_table", "largest_step", "lengths", "lucky_share", "mismatch", "motion", "plane", "printed",
         "refinement", "resolution", "smallest_step", "stable_step", "string", "text", "velocity_order"}


def places(value, path=()):
    """The paths of all values inside json, of each list the first item only."""
    yield path
    if isinstance(value, dict):
        for key in value:
            yield from places(value[key], path + (key,))
    elif isinstance(value, list):
        if value:
            yield from places(value[0], path + (0,))


def holder(record, path):
    for key in path[:-1]:
        record = record[key]
    return record


class Schema(CommandTest):
    @classmethod
    def setUpClass(cls):
        with open(SCHEMA) as file:
            schema = json.load(file)
        jsonschema.Draft202012Validator.check_schema(schema)
        cls.validator = jsonschema.Draft202012Validator(schema)
        # A method that refuses the case, one that does not finish its coarse runs, one that reports
        # no impacts in full.
        done = run("verify", "rk4", "newmark+penalty", "moreau-jean", "--case", "symmetric-pair",
                   "--set", "eta=0.5", "--levels", "2", "--samples-per-level", "2", "--format", "json")
        cls.record = json.loads(done.stdout)
        # Small, so that it can be bent in every place: one method that ran, one that refused.
        cls.whole = copy.deepcopy(cls.record)
        case, = cls.record["cases"]
        del case["subjects"][-1]
        del case["problem"]["constants"][1:]
        for subject in case["subjects"]:
            # The finest level: its first run has the metrics.
            subject["levels"] = subject["levels"][-1:]
            for level in subject["levels"]:
                del level["runs"][1:]
                for found in level["runs"]:
                    del found["metrics"][1:]
                    found["error_history"] = {k: v[:2] for k, v in found["error_history"].items()}
        del case["profiles"][1:]
        case["response"] = {"t": [0.0, 1.0], "y": [[1.0, "nan"], ["inf", "-inf"]]}

    def good_record(self):
        return copy.deepcopy(self.record)

    def is_valid(self, record):
        return self.validator.is_valid(record)

    def test_takes_what_verify_writes(self):
        self.validator.validate(self.whole)
        self.validator.validate(self.record)
        self.assertTrue(any(subject["refusal"] for subject in self.record["cases"][0]["subjects"]))

    def test_takes_the_default_panel_and_every_pair(self):
        for methods in ((), ("--all",)):
            done = run("verify", *methods, "--coarsest", "0.5", "--levels", "1", "--samples-per-level", "1",
                       "--format", "json")
            self.validator.validate(json.loads(done.stdout))

    def test_takes_a_run_that_reports_no_impacts(self):
        record = self.good_record()
        record["cases"][0]["subjects"][0]["levels"][0]["runs"][0]["impacts"] = None
        self.assertTrue(self.is_valid(record))

    def test_the_first_run_of_the_finest_level_has_the_listed_metrics(self):
        subject = self.whole["cases"][0]["subjects"][0]
        listed = {row[0] for row in json.loads(
            run("list", "metrics", "--format", "json").stdout)["rows"]}
        names = [metric["name"] for metric in subject["levels"][-1]["runs"][0]["metrics"]]
        self.assertTrue(names)
        self.assertLessEqual(set(names), listed)
        self.assertIsNotNone(subject["self_convergence"])

    def test_refuses_a_record_without_any_one_of_its_fields(self):
        for path in places(self.record):
            if path and isinstance(path[-1], str) and path[-1] not in ADDED:
                bent = self.good_record()
                del holder(bent, path)[path[-1]]
                self.assertFalse(self.is_valid(bent), path)

    def test_refuses_a_field_that_is_not_known_in_every_object(self):
        for path in places(self.record):
            bent = self.good_record()
            target = holder(bent, path)[path[-1]] if path else bent
            if isinstance(target, dict):
                target["unheard_of"] = 1
                self.assertFalse(self.is_valid(bent), path)

    def test_refuses_a_value_of_another_kind_in_every_place(self):
        for path in places(self.record):
            if not path:
                continue
            was = holder(self.record, path)[path[-1]]
            for other in OTHERS:
                number = isinstance(was, (int, float)) and not isinstance(was, bool)
                number = number or was in ("nan", "inf", "-inf")
                # No estimate is made of an extrapolation; a number may stand there as well.
                open_estimate = path[-2:] == ("extrapolation", "estimate")
                number = number or open_estimate or path[-1] in ("tolerance", "plane")
                same = type(other) is type(was) or (number and type(other) in (int, float))
                if path[-1] in ("impacts", "self_convergence", "file", "tolerance") or open_estimate:
                    same = same or other is None
                # A count is whole; the other numbers need not be.
                if same and not isinstance(other, (list, dict)) and not path[-1] == "schema":
                    continue
                if isinstance(other, list) and isinstance(was, list):
                    continue  # an empty list is a list
                if other == {} and path[-1] == "labels":
                    continue
                bent = self.good_record()
                holder(bent, path)[path[-1]] = other
                self.assertFalse(self.is_valid(bent), (path, other))

    def test_takes_every_behaviour_and_verdict(self):
        for name in ("exact", "proper", "reduced", "irregular", "stagnating", "divergent", "undecided"):
            record = self.good_record()
            record["cases"][0]["subjects"][0]["claim"]["behaviour"] = name
            record["cases"][0]["subjects"][0]["assessment"]["impact_time"]["behaviour"] = name
            self.assertTrue(self.is_valid(record), name)
        for name in ("agrees", "disagrees", "not claimed", "undecided"):
            record = self.good_record()
            record["cases"][0]["subjects"][0]["assessment"]["verdict"] = name
            self.assertTrue(self.is_valid(record), name)

    def test_refuses_other_words_and_counts_that_are_not_whole(self):
        for path, value in ((("schema",), "clackers/verify/1"),
                            (("cases", 0, "subjects", 0, "assessment", "verdict"), "maybe"),
                            (("cases", 0, "subjects", 0, "claim", "behaviour"), "fine"),
                            (("cases", 0, "subjects", 0, "assessment", "velocity", "behaviour"), "agrees"),
                            (("cases", 0, "plan", "levels"), 7.5),
                            (("cases", 0, "plan", "levels"), -1),
                            (("cases", 0, "plan", "samples_per_level"), 65),
                            (("cases", 0, "problem", "impact_count"), -1),
                            (("cases", 0, "problem", "end"), "NaN"),
                            (("cases", 0, "subjects", 0, "levels", 0, "runs", 0, "work", "steps"), 1.5),
                            (("cases", 0, "subjects", 0, "levels", 0, "runs", 0, "impacts", "missed"), -1),
                            (("cases", 0, "response", "y", 0, 0), None)):
            bent = self.good_record()
            holder(bent, path)[path[-1]] = value
            self.assertFalse(self.is_valid(bent), (path, value))

    def test_what_it_refuses_verify_refuses_as_baseline(self):
        for change in ("missing", "unknown", "kind", "schema"):
            bent = self.good_record()
            if change == "missing":
                del bent["cases"][0]["subjects"][0]["claim"]["order"]
            elif change == "unknown":
                bent["cases"][0]["problem"]["extra"] = 1
            elif change == "kind":
                bent["cases"][0]["subjects"][0]["levels"][0]["runs"][0]["seconds"] = [1]
            else:
                bent["schema"] = "clackers/check/1"
            self.assertFalse(self.is_valid(bent))
            with open(self.path("bent.json"), "w") as file:
                json.dump(bent, file)
            self.refused("verify", "--baseline", self.path("bent.json"), code="not-a-record",
                         says=("baseline", "bent.json"))


if __name__ == "__main__":
    unittest.main()
