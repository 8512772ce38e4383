#!/usr/bin/env python3
"""run_tests.py FILE: the tests in one file; exits with 77, saying so, where there is no NumPy."""
import pathlib
import sys
import unittest

try:
    import numpy  # noqa: F401
except ImportError as error:
    print(f"skipped: the Python package needs NumPy, Debian's python3-numpy, and {sys.executable} says: {error}")
    sys.exit(77)

path = pathlib.Path(sys.argv[1])
sys.path.insert(0, str(path.parent))
unittest.main(module=path.stem, argv=[path.name, "--verbose"])
