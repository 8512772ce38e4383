"""Follows the tutorials as a new user would, and compares what is printed with the pages.

    tutorials_test.py TOUCHDOWN [PYTHON_PACKAGE]

Blocks of YAML and Python that begin with a file's name are written; commands in blocks of `sh` run one after the
other in a folder of the page's own; every line of a block of `text` must be printed. Left to the reader are
commands that install, compile, or open a window, and what follows `make`; other tests compile the examples. Pages
that run studies are followed in `make nightly` alone, which sets TOUCHDOWN_LONG.
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / 'scripts' / 'documents'))
from pages import blocks  # noqa: E402

LEFT_TO_READERS = re.compile(r'make |export [A-Z]+=|sudo |cmake |cp examples|\$EDITOR|build/|touchdown watch')
STUDY = re.compile(r'^(touchdown run (?!.*--dry-run)|python3 study\.py)', re.M)
PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve()
PACKAGE = str(pathlib.Path(sys.argv.pop(1)).resolve()) if len(sys.argv) > 1 else ''


class Tutorial:
    """One page, followed in a folder."""

    def __init__(self, page, folder):
        self.page, self.folder, self.printed, self.ran = page, folder, '', []
        self.environment = {**os.environ, 'PATH': f'{PROGRAM.parent}{os.pathsep}{os.environ["PATH"]}',
                            'TOUCHDOWN': str(ROOT), 'PYTHONPATH': PACKAGE, 'PYTHONDONTWRITEBYTECODE': '1'}

    def run(self, command):
        if command.startswith('python3'):
            if not PACKAGE:
                return
            command = command.replace('python3', '/usr/bin/python3', 1)
        done = subprocess.run(['bash', '-c', command], cwd=self.folder, env=self.environment, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        self.printed += done.stdout
        self.ran.append(command)
        if done.returncode != 0:
            raise AssertionError(f'{self.page.name}: {command}: exit code {done.returncode}\n{done.stdout}')

    def follow(self):
        for _, language, code in blocks(self.page.read_text(encoding='utf-8')):
            name = re.match(r'# ([\w.]+\.(?:yaml|py))\b', code)
            if language in ('yaml', 'python') and name:
                (self.folder / name[1]).write_text(code, encoding='utf-8')
            elif language == 'sh':
                for line in code.replace('\\\n', ' ').splitlines():
                    if line.startswith('make '):
                        break  # what follows needs what it builds
                    if line.strip() and not LEFT_TO_READERS.match(line):
                        self.run(line)
            elif language == 'text':
                for line in code.splitlines():
                    if line not in self.printed.splitlines():
                        raise AssertionError(f'{self.page.name}: not printed: {line}\nprinted:\n{self.printed}')


class Tutorials(unittest.TestCase):
    def test_each_can_be_followed(self):
        for page in sorted((ROOT / 'docs' / 'tutorials').glob('*.md')):
            if 'TOUCHDOWN_LONG' not in os.environ and STUDY.search(page.read_text(encoding='utf-8')):
                continue
            with self.subTest(page=page.name), tempfile.TemporaryDirectory() as folder:
                Tutorial(page, pathlib.Path(folder)).follow()

    def test_most_have_commands_that_run(self):
        with_commands = 0
        for page in (ROOT / 'docs' / 'tutorials').glob('*.md'):
            lines = [line for _, language, code in blocks(page.read_text(encoding='utf-8')) if language == 'sh'
                     for line in code.splitlines()]
            with_commands += any(not LEFT_TO_READERS.match(line) for line in lines)
        self.assertGreaterEqual(with_commands, 6)

    def follow(self, text):
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder, 'page.md')
            page.write_text(text, encoding='utf-8')
            tutorial = Tutorial(page, pathlib.Path(folder))
            tutorial.follow()
            return tutorial

    def test_a_wrong_page_is_noticed(self):
        with self.assertRaisesRegex(AssertionError, 'exit code'):
            self.follow('```sh\ntouchdown simulate none.yaml -o a.mpack\n```\n')
        with self.assertRaisesRegex(AssertionError, 'not printed: touchdown 0'):
            self.follow('```sh\ntouchdown --version\n```\n```text\ntouchdown 0\n```\n')
        with self.assertRaisesRegex(AssertionError, 'not printed: never'):
            self.follow('```text\nnever\n```\n```sh\necho never\n```\n')

    def test_a_right_page_is_followed(self):
        followed = self.follow('```yaml\n# a.yaml: a file\nname: a\n```\n```sh\ncat a.yaml\nmake nothing\n```\n'
                               '```text\nname: a\n```\n')
        self.assertEqual(followed.ran, ['cat a.yaml'])


if __name__ == '__main__':
    unittest.main()
