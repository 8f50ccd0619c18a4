"""verify with several cases: a study each, and a performance profile over all."""
import json
import os
import unittest

import jsonschema  # Debian: python3-jsonschema

from command import CommandTest, run

SCHEMAS = os.path.join(os.path.dirname(__file__), "../../docs/schemas")
CASES = ("--case", "stop", "--case", "symmetric-pair", "--coarsest", "0.1", "--levels", "4",
         "--neighbours", "1", "--set", "t_end=8")


def schema(name):
    with open(os.path.join(SCHEMAS, name)) as file:
        return json.load(file)


class Cases(CommandTest):
    def test_prints_a_table_a_case_then_the_profile(self):
        done = run("verify", "rk4", "newmark", *CASES)
        self.assertIn(done.returncode, (0, 3), done.stderr)
        stop, pair = done.stdout.index("stop ("), done.stdout.index("symmetric-pair (")
        profile = done.stdout.index("Performance profile over 2 cases and ")
        self.assertTrue(stop < pair < profile)
        self.assertRegex(done.stdout, r"\nrk4 +\d+ +\d+ % +\d+ % +\d+/\d+ +0\n")
        self.assertTrue(done.stdout.splitlines()[-1].startswith("Verdict over 2 cases: "))
        self.assertTrue(all(len(line) <= 80 for line in done.stdout.splitlines()))

    def test_json_holds_whole_records_and_is_valid(self):
        done = run("verify", "rk4", "newmark", *CASES, "--format", "json")
        found, one = json.loads(done.stdout), schema("verify-1.json")
        several = schema("verify-cases-1.json")
        # Its references lead to the other file; what stands there is put in their place.
        fields = several["properties"]
        self.assertEqual(fields["records"]["items"], {"$ref": one["$id"]})
        self.assertEqual(fields["profiles"]["items"], {"$ref": one["$id"] + "#/$defs/profile"})
        fields["records"]["items"] = True
        fields["profiles"]["items"] = {"$ref": "#/$defs/profile"}
        several["$defs"] = one["$defs"]
        jsonschema.Draft202012Validator(several).validate(found)
        for record in found["records"]:
            jsonschema.Draft202012Validator(one).validate(record)
        self.assertEqual([record["case"]["name"] for record in found["records"]],
                         ["stop", "symmetric-pair"])
        self.assertGreater(len(found["profiles"][0]["tasks"]),
                           len(found["records"][0]["profiles"][0]["tasks"]))
        # A record taken out of it is a baseline.
        with open(self.path("stop.json"), "w") as file:
            json.dump(found["records"][0], file)
        again = run("verify", "rk4", "newmark", "--case", "stop", *CASES[4:], "--baseline",
                    self.path("stop.json"))
        self.assertRegex(again.stdout, "(?i)nothing changed")

    def test_takes_settings_that_every_case_has(self):
        self.refused("verify", "rk4", "--case", "stop", "--case", "one-parameter", "--set", "eta=0.5",
                     code="unknown-name", says=("eta",))

    def test_refuses_what_has_no_place_for_several_cases(self):
        for extra, says in ((("--report", self.path("r.html")), "--report"),
                            (("--baseline", self.path("b.json")), "--baseline"),
                            (("--format", "csv"), "--format csv"),
                            (("--format", "junit"), "--format junit"),
                            (("--format", "latex"), "--format latex")):
            self.refused("verify", "rk4", *CASES, *extra, code="bad-syntax", says=(says,))
        self.refused("verify", "rk4", "--case", "stop", "--case", "stop", code="bad-syntax",
                     says=("each case once",))
        self.assertFalse(os.path.exists(self.path("r.html")))

    def test_one_case_leaves_the_methods_behind_it_alone(self):
        done = run("verify", "--case", "stop", "rk4", *CASES[4:], "--format", "json")
        self.assertEqual(json.loads(done.stdout)["case"]["name"], "stop")


if __name__ == "__main__":
    unittest.main()
