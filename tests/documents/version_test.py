"""One version everywhere: CMakeLists.txt, the program, the citation, the newest release of the changelog, Python.

    version_test.py TOUCHDOWN [PYTHON_PACKAGE]
"""

import os
import pathlib
import re
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = sys.argv.pop(1)
PACKAGE = sys.argv.pop(1) if len(sys.argv) > 1 else ''


def found(pattern, file):
    """What the pattern's group matches first in a file of the project."""
    return re.search(pattern, (ROOT / file).read_text(encoding='utf-8'), re.M)[1]


def printed(*command, **environment):
    return subprocess.run(command, capture_output=True, text=True, check=True,
                          env={**os.environ, **environment}).stdout.strip()


class Version(unittest.TestCase):
    def setUp(self):
        self.version = found(r'^project\(touchdown VERSION ([\d.]+) ', 'CMakeLists.txt')

    def test_is_semantic(self):
        self.assertRegex(self.version, r'^(0|[1-9]\d*)\.(0|[1-9]\d*)\.(0|[1-9]\d*)$')

    def test_of_the_program(self):
        self.assertEqual(printed(PROGRAM, '--version'), f'touchdown {self.version}')

    def test_of_the_citation(self):
        self.assertEqual(found(r'^version: (\S+)$', 'CITATION.cff'), self.version)

    def test_of_the_ros_package(self):
        self.assertEqual(found(r'^  <version>(\S+)</version>$', 'package.xml'), self.version)

    def test_of_the_newest_release(self):
        release, date = re.search(r'^## (\d\S*) – (\d{4}-\d\d-\d\d)$', (ROOT / 'CHANGELOG.md').read_text(encoding='utf-8'),
                                  re.M).groups()
        self.assertEqual(release, self.version)
        self.assertEqual(found(r'^date-released: (\S+)$', 'CITATION.cff'), date)

    @unittest.skipUnless(PACKAGE, 'the Python package is not built')
    def test_of_python(self):
        code = 'import touchdown; print(touchdown.__version__)'
        self.assertEqual(printed('/usr/bin/python3', '-c', code, PYTHONPATH=PACKAGE), self.version)


if __name__ == '__main__':
    unittest.main()
