"""What the tests share: the program, a short run with flights, a folder of their own."""
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
    """To be copied by who writes into it."""
    return touchdown.simulate(HOP, overrides=SHORT)


def program(*arguments, check=True):
    """What the program says, called from where the test stands."""
    return subprocess.run([PROGRAM, *map(str, arguments)], check=check, capture_output=True, text=True)


class InFolder(unittest.TestCase):
    """Every test stands in an empty folder."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="touchdown_")
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        self.folder = pathlib.Path(folder.name)
