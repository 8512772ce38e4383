"""Shared by the tests: the program, a short run with flights, an empty folder per test."""
import csv
import functools
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np

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


def estimated(log, *options):
    """The beliefs of the program about a log, row by row."""
    program("estimate", log, *options, "-o", "beliefs.csv")
    with open("beliefs.csv", newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def assert_same(beliefs, rows):
    """Every number of a run in Python is that of the program."""
    for column, values in (("p_contact_left", beliefs["p_contact"][:, 0]), ("p_contact_right", beliefs["p_contact"][:, 1]),
                           ("contact_left", beliefs["contact"][:, 0]), ("contact_right", beliefs["contact"][:, 1]),
                           ("p_any_wheel", beliefs["p_any_wheel"]), ("p_both_wheels", beliefs["p_both_wheels"])):
        np.testing.assert_array_equal(values, [float(row[column]) for row in rows], column)
    assert [touchdown.STATUS[k] for k in beliefs["status"]] == [row["status"] for row in rows]


class InFolder(unittest.TestCase):
    """Every test runs in an empty folder."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="touchdown_")
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        self.folder = pathlib.Path(folder.name)
