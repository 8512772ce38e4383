"""The check of commands itself, on pages with commands, targets and files that do not exist.

    commands_test.py TOUCHDOWN
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
CHECK = ROOT / 'scripts' / 'documents' / 'commands.py'
PROGRAM = sys.argv.pop(1)


class Commands(unittest.TestCase):
    def faults(self, page):
        """What the check prints about a page, without the place."""
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / 'docs').mkdir()
            (root / 'scenarios').mkdir()
            (root / 'scenarios' / 'stairs.yaml').touch()
            (root / 'Makefile').write_text('build: ## Build\n', encoding='utf-8')
            (root / 'docs' / 'a.md').write_text(page, encoding='utf-8')
            done = subprocess.run([sys.executable, CHECK, PROGRAM, folder], capture_output=True, text=True, check=False)
            lines = done.stdout.splitlines()
            self.assertEqual(done.returncode, 1 if lines else 0, done.stderr)
            return [line.removeprefix('docs/a.md:') for line in lines]

    def test_that_do_not_exist_are_found(self):
        self.assertEqual(self.faults('```\ntouchdown simulat a.yaml\n```\n'), ['2: simulat: no such command'])
        self.assertEqual(self.faults('a `touchdown runn x`\n'), ['1: runn: no such command'])
        self.assertEqual(self.faults('```sh\nbuild/release/touchdown run a.yaml | touchdown fitt\n```\n'),
                         ['2: fitt: no such command'])

    def test_with_unknown_options_are_found(self):
        self.assertEqual(self.faults('```\ntouchdown simulate a.yaml --sede 1\n```\n'), ['2: simulate --sede: no such option'])
        self.assertEqual(self.faults('`touchdown fit a.mpack --robot=b --modell c`\n'), ['1: fit --modell: no such option'])
        self.assertEqual(self.faults('```bash\ntouchdown run a.yaml \\\n  --nothing\n```\n'), ['2: run --nothing: no such option'])

    def test_with_unknown_targets_and_files_are_found(self):
        self.assertEqual(self.faults('`make built`\n'), ['1: make built: no such target'])
        self.assertEqual(self.faults('`scenarios/stair.yaml`\n'), ['1: scenarios/stair.yaml: no such file'])
        self.assertEqual(self.faults('```yaml\nfiles: [scenarios/stairs.yaml, scenarios/step.yaml]\n```\n'),
                         ['2: scenarios/step.yaml: no such file'])

    def test_that_exist_are_right(self):
        self.assertEqual(self.faults('```\ntouchdown simulate scenarios/stairs.yaml --set "a=--b" -o a.mpack  # --c\n'
                                     'make build\n```\n`scenarios/mine.yaml` `touchdown list`\n'), [])


if __name__ == '__main__':
    unittest.main()
