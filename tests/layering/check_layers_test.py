#!/usr/bin/env python3
"""check_layers.py: small trees with one mistake each."""
import pathlib
import tempfile
import unittest

import check_layers

TABLE = "base:\nmodel: base\nexact: model base\nmethods: model base\ncases: exact model base\ncli: cases base\n"
PAIR, CASE = '#include "clackers/exact/pair/pair.hpp"\n', '#include <clackers/cases/case.hpp>\n'


class Layers(unittest.TestCase):
    def errors(self, name, text, table=TABLE):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder).resolve()
            for file, content in {"clackers/exact/pair/pair.hpp": "", "clackers/cases/case.hpp": "", "layers.txt": table, name: text}.items():
                (root / file).parent.mkdir(parents=True, exist_ok=True)
                (root / file).write_text(content)
            return check_layers.check(root)

    def test_allowed_includes_have_no_error(self):
        for name, text in (("clackers/cases/a.cpp", PAIR + "#include <vector>\n"), ("clackers/model/a_test.cpp", PAIR), ("clackers/model/testing/a.hpp", PAIR),
                           ("cli/commands/verify.cpp", CASE), ("CMakeLists.txt", "clackers_module(exact LINK model base fmt::fmt)\n")):
            self.assertEqual(self.errors(name, text), [], name)

    def test_forbidden_includes_have_one_error(self):
        for name, text, words in (
                ("clackers/model/a.cpp", PAIR, "model may not include exact"),
                ("clackers/model/sub/a.hpp", ' #  include "../../exact/pair/pair.hpp"', "model may not include exact"),
                ("cli/commands/verify.cpp", PAIR, "cli may not include exact"),
                ("clackers/methods/integrators/rk4_test.cpp", CASE, "methods never include the reference"),
                ("clackers/exact/a.cpp", '#include "clackers/exact/testing/oracle.hpp"', "only tests include testing/"),
                ("clackers/attic/a.cpp", "", "lies in no module"),
                ("CMakeLists.txt", "clackers_module(model LINK exact base)\n", "module model links exact")):
            found = self.errors(name, text)
            self.assertEqual(len(found), 1, (name, found))
            self.assertIn(words, found[0])

    def test_row_naming_a_later_module_has_an_error(self):
        self.assertIn("does not stand above it", self.errors("a.txt", "", TABLE.replace("base:\n", "base: model\n"))[0])


if __name__ == "__main__":
    unittest.main()
