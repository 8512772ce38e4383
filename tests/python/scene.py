"""Shared by the tests: the program, a short run with flights, an empty folder per test."""
import functools
import os
import pathlib
import subprocess
import tempfile
import unittest

import touchdown

SOURCE = pathlib.Path(os.environ["TOUCHDOWN_SOURCE"])
PROGRAM = os.environ["TOUCHDOWN_PROGRAM"]
HOP = "scenarios/hop.yaml"
SHORT = {"end.duration": 3.2}  # s: one hop, of both wheels


@functools.cache
def hop() -> touchdown.Recording:
    """A shared run: a test that writes into it copies it first."""
    return touchdown.simulate(HOP, overrides=SHORT)


def program(*arguments, check=True):
    """Runs the program in the current folder and returns its result."""
    return subprocess.run([PROGRAM, *map(str, arguments)], check=check, capture_output=True, text=True)


class InFolder(unittest.TestCase):
    """Every test runs in an empty folder."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="touchdown_")
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        self.folder = pathlib.Path(folder.name)
