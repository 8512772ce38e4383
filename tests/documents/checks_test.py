"""The checks of links and of commands themselves, on trees with faults of every kind.

    checks_test.py TOUCHDOWN
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

CHECKS = pathlib.Path(__file__).resolve().parents[2] / 'scripts' / 'documents'
PROGRAM = sys.argv.pop(1)


def faults(check, files, *arguments):
    """The lines that a check prints about a tree of these files; its exit code states whether there are any."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            path = pathlib.Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding='utf-8')
        done = subprocess.run([sys.executable, CHECKS / check, *arguments, folder], capture_output=True, text=True,
                              check=False)
        assert done.returncode == (1 if done.stdout else 0), done.stderr
        return done.stdout.splitlines()


class Checks(unittest.TestCase):
    def test_of_links_find_what_is_missing(self):
        for files, place in (
                ({'README.md': 'a\n[b](docs/c.md)\n'}, 'README.md:2: docs/c.md: no such file'),
                ({'docs/a/b.md': '[x](../c.md) [`y`](b.md)\n'}, 'docs/a/b.md:1: ../c.md: no such file'),
                ({'a.md': '![a picture](images/a.png)\n'}, 'a.md:1: images/a.png: no such file'),
                ({'a.md': '| [cell](b/) |\n'}, 'a.md:1: b/: no such file'),
                ({'a.md': '[b](#b)\n\n# A\n'}, 'a.md:1: #b: no such heading'),
                ({'a.md': '[b](b.md#one)\n', 'b.md': '```\n# one\n```\n'}, 'a.md:1: b.md#one: no such heading'),
                ({'a.md': '# A\n[second](#a-1)\n'}, 'a.md:2: #a-1: no such heading'),
                ({'core/a.hpp': '/// See docs/b.md.\n'}, 'core/a.hpp:1: docs/b.md: no such file'),
                ({'a.yaml': '# (docs/guides/b.md)\n'}, 'a.yaml:1: docs/guides/b.md: no such file')):
            self.assertEqual(faults('links.py', files), [place])

    def test_of_links_know_the_headings_of_github_and_leave_code_and_the_web_alone(self):
        for files in ({'a.md': '[b](b.md#what-is-it-for-me-x_1-é)\n', 'b.md': '## What is `it`, for me? x_1 (é)\n'},
                      {'a.md': '# A\n# A\n[second](#a-1)\n'}, {'a.md': '# A – B\n[b](#a--b)\n'},
                      {'a.md': '```\n[b](b.md)\n```\n`[c](c.md)` [d](https://example.org/d.md)\n'},
                      {'core/a.hpp': '/// See docs/b.md.\n', 'docs/b.md': ''}):
            self.assertEqual(faults('links.py', files), [])

    def test_of_commands_find_what_does_not_exist(self):
        for page, *found in (
                ('```\ntouchdown simulat a.yaml\n```\n', '2: simulat: no such command'),
                ('a `touchdown runn x`\n', '1: runn: no such command'),
                ('```sh\nbuild/release/touchdown run a.yaml | touchdown fitt\n```\n', '2: fitt: no such command'),
                ('```\ntouchdown simulate a.yaml --sede 1\n```\n', '2: simulate --sede: no such option'),
                ('`touchdown fit a.mpack --robot=b --modell c`\n', '1: fit --modell: no such option'),
                ('```bash\ntouchdown run a.yaml \\\n  --nothing\n```\n', '2: run --nothing: no such option'),
                ('`make built`\n', '1: make built: no such target'),
                ('`scenarios/stair.yaml`\n', '1: scenarios/stair.yaml: no such file'),
                ('```yaml\nfiles: [scenarios/stairs.yaml, scenarios/step.yaml]\n```\n',
                 '2: scenarios/step.yaml: no such file'),
                ('```\ntouchdown simulate scenarios/stairs.yaml --set "a=--b" -o a.mpack  # --c\nmake build\n```\n'
                 '`scenarios/mine.yaml` `touchdown list`\n',)):
            files = {'docs/a.md': page, 'scenarios/stairs.yaml': '', 'Makefile': 'build: ## Build\n'}
            self.assertEqual(faults('commands.py', files, PROGRAM), ['docs/a.md:' + line for line in found])


if __name__ == '__main__':
    unittest.main()
