"""The examples of all docstrings."""
import doctest
import importlib
import inspect
import os
import pkgutil
import unittest

os.environ["MPLBACKEND"] = "Agg"

import clackers


def modules():
    names = [f"clackers.{module.name}" for module in pkgutil.iter_modules(clackers.__path__) if module.name != "_core"]
    return [clackers, *(importlib.import_module(name) for name in names)]


def load_tests(loader, tests, pattern):
    for module in modules():
        tests.addTests(doctest.DocTestSuite(module, optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE))
    return tests


def public_functions():
    """Name and docstring of every function and method that users call."""
    for name in clackers.__all__:
        value = getattr(clackers, name)
        if inspect.isfunction(value):
            yield name, value.__doc__
        elif inspect.isclass(value):
            for method, function in inspect.getmembers(value, inspect.isfunction):
                if not method.startswith("_"):
                    yield f"{name}.{method}", function.__doc__


class Docstrings(unittest.TestCase):
    def test_every_public_function_and_method_has_an_example(self):
        found = dict(public_functions())
        self.assertGreater(len(found), 10)
        self.assertEqual([name for name, text in found.items() if ">>> " not in (text or "")], [])

    def test_every_public_name_has_a_docstring(self):
        for name in clackers.__all__:
            value = getattr(clackers, name)
            if inspect.isclass(value):
                self.assertTrue(value.__doc__ and not value.__doc__.startswith(f"{name}("), name)
                for member, one in inspect.getmembers(value, lambda one: isinstance(one, property)):
                    self.assertTrue(one.__doc__, f"{name}.{member}")


if __name__ == "__main__":
    unittest.main()
