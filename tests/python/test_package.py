import ast
import inspect
import re
import unittest

import touchdown
from scene import SOURCE


class Stubs(unittest.TestCase):
    def test_match_the_module(self):
        tree = ast.parse((SOURCE / "apps/python/touchdown/_touchdown.pyi").read_text(encoding="utf-8"))
        module = touchdown._touchdown
        written = {node.name: node for node in tree.body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}
        self.assertEqual(set(written), {name for name in vars(module) if not name.startswith("_")})
        for name, node in written.items():
            if isinstance(node, ast.FunctionDef):
                self.assertEqual([argument.arg for argument in node.args.args], self.arguments(getattr(module, name)),
                                 name)
                continue
            methods = {inner.name: inner for inner in node.body if isinstance(inner, ast.FunctionDef)}
            public = {key for key in vars(getattr(module, name)) if not key.startswith("_")}
            self.assertEqual({key for key in methods if not key.startswith("_")}, public, name)
            for key in public:
                member = inspect.getattr_static(getattr(module, name), key)
                if not isinstance(member, property):
                    self.assertEqual([argument.arg for argument in methods[key].args.args],
                                     self.arguments(getattr(getattr(module, name), key)), f"{name}.{key}")

    @staticmethod
    def arguments(function):
        """Argument names of a function of the module, from the first line of its docstring."""
        names = re.findall(r"(?:\(|, )(\w+): ", function.__doc__.splitlines()[0])
        return names

    def test_public_names_have_types_and_docstrings(self):
        for name in touchdown.__all__:
            thing = getattr(touchdown, name)
            if not callable(thing) or inspect.isclass(thing) and issubclass(thing, Exception):
                continue
            self.assertTrue(inspect.getdoc(thing), name)
            if inspect.isfunction(thing):
                annotations = inspect.get_annotations(thing)
                self.assertEqual(set(annotations), {*inspect.signature(thing).parameters, "return"}, name)


if __name__ == "__main__":
    unittest.main()
