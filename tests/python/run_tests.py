#!/usr/bin/env python3
"""run_tests.py FILE: runs the tests of one file; exits with 77 and a message if there is no NumPy."""
import pathlib
import sys
import unittest

try:
    import numpy  # noqa: F401
except ImportError as error:
    print(f"skipped: the Python package needs NumPy, Debian's python3-numpy; {sys.executable} reports: {error}")
    sys.exit(77)

path = pathlib.Path(sys.argv[1])
sys.path.insert(0, str(path.parent))
unittest.main(module=path.stem, argv=[path.name, "--verbose"])
