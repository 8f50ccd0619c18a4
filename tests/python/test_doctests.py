"""The examples of all docstrings."""
import doctest
import importlib
import pkgutil
import unittest

import clackers


def modules():
    names = [f"clackers.{module.name}" for module in pkgutil.iter_modules(clackers.__path__)]
    return [clackers, *(importlib.import_module(name) for name in names)]


def load_tests(loader, tests, pattern):
    for module in modules():
        tests.addTests(doctest.DocTestSuite(module, optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE)
                       if module.__name__ != "clackers._core" else unittest.TestSuite())
    return tests


class Examples(unittest.TestCase):
    def test_every_public_function_and_method_has_an_example(self):
        finder = doctest.DocTestFinder()
        found = {test.name: bool(test.examples) for module in modules() if module.__name__ != "clackers._core"
                 for test in finder.find(module)}
        self.assertGreater(len(found), 20)


if __name__ == "__main__":
    unittest.main()
