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
    """Name and function of every function and method that users call."""
    for module in (clackers, clackers.plot):
        for name, value in vars(module).items():
            if name.startswith("_") or not getattr(value, "__module__", "").startswith("clackers."):
                continue
            if inspect.isfunction(value):
                yield name, value
            elif inspect.isclass(value):
                for method, function in inspect.getmembers(value, lambda each: inspect.isfunction(each) or inspect.ismethod(each)):
                    if not method.startswith("_") and function.__module__.startswith("clackers."):
                        yield f"{name}.{method}", function


def sections(text):
    """The sections of a docstring in the form of numpydoc, and their lines."""
    found, name = {}, ""
    lines = inspect.cleandoc(text).splitlines()
    for line, below in zip(lines, [*lines[1:], ""]):
        if below and set(below) == {"-"} and len(below) == len(line):
            name = line
            found[name] = []
        elif name and set(line) != {"-"}:
            found[name].append(line)
    return found


def parameters(lines):
    heads = [line.split(" : ")[0] for line in lines if line and not line.startswith(" ")]
    return [name.strip("*") for head in heads for name in head.split(", ")]


# These hand out what is there already.
RAISE_NOTHING = {"Record.keys", "Record.table", "Record.to_json", "Table.head"}


class Docstrings(unittest.TestCase):
    def test_every_public_function_is_documented_as_numpydoc_asks(self):
        found = dict(public_functions())
        self.assertTrue({"check", "response", "Case.response", "Table.to_xarray", "Record.from_json"} <= set(found))
        for name, function in found.items():
            with self.subTest(name):
                signature = inspect.signature(function)
                given = [each for each in signature.parameters if each != "self"]
                parts = sections(function.__doc__)
                self.assertEqual(parameters(parts.pop("Parameters", [])), given)
                self.assertEqual("Returns" in parts, signature.return_annotation not in (None, "None"))
                self.assertEqual("Raises" in parts, name not in RAISE_NOTHING)
                self.assertIn(">>> ", "".join(parts["Examples"]))
                self.assertLessEqual(set(parts), {"Returns", "Raises", "Examples"})

    def test_the_docstring_of_a_class_of_fields_has_them(self):
        for name in clackers.__all__:
            value = getattr(clackers, name)
            names = getattr(value, "_fields", getattr(value, "__dataclass_fields__", ()))
            if not inspect.isclass(value) or not names:
                continue
            with self.subTest(name):
                parts = sections(value.__doc__)
                self.assertEqual(parameters(parts.get("Attributes") or parts["Parameters"]), [each for each in names if not each.startswith("_")])

    def test_every_public_name_has_a_docstring(self):
        for name in clackers.__all__:
            value = getattr(clackers, name)
            if inspect.isclass(value):
                self.assertTrue(value.__doc__ and not value.__doc__.startswith(f"{name}("), name)
                for member, one in inspect.getmembers(value, lambda one: isinstance(one, property)):
                    self.assertTrue(one.__doc__, f"{name}.{member}")


if __name__ == "__main__":
    unittest.main()
