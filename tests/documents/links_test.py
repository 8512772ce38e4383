"""The check of links itself, on trees with links that lead nowhere."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
CHECK = ROOT / 'scripts' / 'documents' / 'links.py'


def check(files):
    """The check's exit code and output for a tree of these files."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            path = pathlib.Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding='utf-8')
        done = subprocess.run([sys.executable, CHECK, folder], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout.splitlines()


class Links(unittest.TestCase):
    def assert_missing(self, files, place):
        code, lines = check(files)
        self.assertEqual((code, lines), (1, [place]))

    def assert_complete(self, files):
        self.assertEqual(check(files), (0, []))

    def test_to_missing_files_are_found(self):
        self.assert_missing({'README.md': 'a\n[b](docs/c.md)\n'}, 'README.md:2: docs/c.md: no such file')
        self.assert_missing({'docs/a/b.md': '[x](../c.md) [`y`](b.md)\n'}, 'docs/a/b.md:1: ../c.md: no such file')
        self.assert_missing({'a.md': '![a picture](images/a.png)\n'}, 'a.md:1: images/a.png: no such file')
        self.assert_missing({'a.md': '| [cell](b/) |\n'}, 'a.md:1: b/: no such file')

    def test_to_missing_headings_are_found(self):
        self.assert_missing({'a.md': '[b](#b)\n\n# A\n'}, 'a.md:1: #b: no such heading')
        self.assert_missing({'a.md': '[b](b.md#one)\n', 'b.md': '```\n# one\n```\n'}, 'a.md:1: b.md#one: no such heading')
        self.assert_missing({'a.md': '# A\n[second](#a-1)\n'}, 'a.md:2: #a-1: no such heading')

    def test_to_headings_are_those_of_github(self):
        self.assert_complete({'a.md': '[b](b.md#what-is-it-for-me-x_1-é)\n', 'b.md': '## What is `it`, for me? x_1 (é)\n'})
        self.assert_complete({'a.md': '# A\n# A\n[second](#a-1)\n'})
        self.assert_complete({'a.md': '# A – B\n[b](#a--b)\n'})

    def test_in_code_and_to_the_web_are_not_checked(self):
        self.assert_complete({'a.md': '```\n[b](b.md)\n```\n`[c](c.md)` [d](https://example.org/d.md)\n'})

    def test_names_of_pages_are_checked_in_code_too(self):
        self.assert_missing({'core/a.hpp': '/// See docs/b.md.\n'}, 'core/a.hpp:1: docs/b.md: no such file')
        self.assert_missing({'a.yaml': '# (docs/guides/b.md)\n'}, 'a.yaml:1: docs/guides/b.md: no such file')
        self.assert_complete({'core/a.hpp': '/// See docs/b.md.\n', 'docs/b.md': ''})


if __name__ == '__main__':
    unittest.main()
