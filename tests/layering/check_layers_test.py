#!/usr/bin/env python3
"""The checker itself: trees built to be wrong in one way each, and the real tree."""
import pathlib
import sys
import tempfile
import unittest

import check_layers

ROOT = pathlib.Path(__file__).resolve().parents[2]
TABLE = "base:\nmodel: base\nexact: model base\nmethods: model base\ncases: exact model base\ncli: cases base\n"


class Layers(unittest.TestCase):
    def errors(self, files, table=TABLE):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder).resolve()
            (root / "layers.txt").write_text(table)
            for name in ["base/error.hpp", "model/state.hpp", "exact/pair.hpp", "methods/rk4.hpp", "cases/case.hpp"]:
                self.write(root, "clackers/" + name, "")
            for name, text in files.items():
                self.write(root, name, text)
            return check_layers.check(root)

    @staticmethod
    def write(root, name, text):
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text)

    def assert_refused(self, files, words):
        found = self.errors(files)
        self.assertEqual(len(found), 1, found)
        self.assertIn(words, found[0])

    def test_what_the_table_names_may_be_included(self):
        self.assertEqual(self.errors({"clackers/exact/a.cpp": '#include "clackers/model/state.hpp"\n'
                                                              "#include <clackers/base/error.hpp>\n#include <vector>\n"}), [])

    def test_every_form_of_include_is_seen(self):
        for text in ['#include "clackers/exact/pair.hpp"', "#include <clackers/exact/pair.hpp>",
                     '#include "../exact/pair.hpp"', ' #  include "exact/pair.hpp"']:
            self.assert_refused({"clackers/model/a.cpp": text}, "model may not include exact")

    def test_every_kind_of_file_is_seen(self):
        for suffix in ["cpp", "hpp", "h", "inl"]:
            self.assert_refused({f"clackers/model/a.{suffix}": '#include "clackers/exact/pair.hpp"'}, "model may not")

    def test_front_ends_are_checked_too(self):
        self.assert_refused({"cli/main.cpp": '#include "clackers/methods/rk4.hpp"'}, "cli may not include methods")

    def test_the_judged_never_sees_the_judge_not_even_in_a_test(self):
        for module in ["exact/pair.hpp", "cases/case.hpp"]:
            for name in ["rk4.cpp", "integrators/rk4.hpp", "integrators/rk4_test.cpp"]:
                self.assert_refused({"clackers/methods/" + name: f'#include "clackers/{module}"'}, "the judged never sees")

    def test_other_tests_may_include_any_room(self):
        self.assertEqual(self.errors({"clackers/model/a_test.cpp": '#include "clackers/exact/pair.hpp"'}), [])

    def test_a_file_outside_every_room_is_refused(self):
        self.assert_refused({"clackers/attic/a.cpp": ""}, "lies in no module")

    def test_a_row_cannot_name_a_room_below_it(self):
        self.assertIn("does not stand above it", self.errors({}, TABLE.replace("base:\n", "base: model\n"))[0])

    def test_a_target_links_only_what_its_row_names(self):
        self.assert_refused({"CMakeLists.txt": "clackers_module(model LINK exact base Eigen3::Eigen)\n"},
                            "module model links exact")
        self.assertEqual(self.errors({"CMakeLists.txt": "clackers_module(exact LINK model\n base fmt::fmt TEST_LINK mpfr)\n"}), [])

    def test_the_project_keeps_its_own_table(self):
        self.assertEqual(check_layers.check(ROOT), [])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
