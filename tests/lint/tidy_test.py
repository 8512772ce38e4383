"""What scripts/tidy.py remembers, with a clang-tidy that finds the word WARN and counts its runs."""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

TIDY = pathlib.Path(__file__).resolve().parents[2] / 'scripts' / 'tidy.py'
CHECKER = '''#!/bin/sh
[ "$1" = --version ] && { echo "${CHECKER_VERSION:-1}"; exit 0; }
echo run >> "$RUNS"
for word; do case "$word" in *.cpp) unit=$word ;; esac; done
g++ -fsyntax-only -I. "$unit" 2>&1 | sed 's/: error: .*/& [clang-diagnostic-error]/' | grep clang-diagnostic && exit 1
g++ -E -C -I. "$unit" | grep WARN && exit 1
exit 0
'''


class Tidy(unittest.TestCase):
    def setUp(self):
        self.scratch = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.scratch)
        programs = self.scratch / 'bin'
        programs.mkdir()
        (programs / 'clang-tidy').write_text(CHECKER, encoding='utf-8')
        (programs / 'clang++').symlink_to(shutil.which('g++'))
        (programs / 'clang-tidy').chmod(0o755)
        self.runs = self.scratch / 'runs'
        self.environment = dict(os.environ, RUNS=str(self.runs), TIDY_CACHE=str(self.scratch / 'cache'),
                                PATH=f'{programs}:{os.environ["PATH"]}')
        self.checkout = self.make_checkout('one')

    def make_checkout(self, name):
        """A checkout of one source with one header, and a program of two sources."""
        checkout = self.scratch / name
        (checkout / 'build').mkdir(parents=True)
        (checkout / '.clang-tidy').write_text('Checks: all\n', encoding='utf-8')
        (checkout / 'a.hpp').write_text('int a();\n', encoding='utf-8')
        (checkout / 'a.cpp').write_text('#include "a.hpp"\n', encoding='utf-8')
        (checkout / 'b.cpp').write_text('int b();\n', encoding='utf-8')
        commands = [{'directory': str(checkout / 'build'), 'file': str(checkout / file),
                     'command': f'/usr/bin/c++ -I{checkout} -DROOT="{checkout}" -o a.o -c {checkout / file}'}
                    for file in ('a.cpp', 'b.cpp')]
        (checkout / 'build' / 'commands.json').write_text(json.dumps(commands), encoding='utf-8')
        return checkout

    def check(self, checkout=None):
        """The exit code, and how many units clang-tidy checked."""
        self.runs.write_text('', encoding='utf-8')
        done = subprocess.run([sys.executable, TIDY, 'build/commands.json'], cwd=checkout or self.checkout,
                              env=self.environment, capture_output=True, text=True, check=False)
        return done.returncode, len(self.runs.read_text(encoding='utf-8').splitlines())

    def test_the_same_unit_is_checked_once(self):
        self.assertEqual(self.check(), (0, 1))
        self.assertEqual(self.check(), (0, 0))

    def test_another_checkout_of_the_same_sources_is_not_checked_again(self):
        self.assertEqual(self.check(), (0, 1))
        self.assertEqual(self.check(self.make_checkout('two')), (0, 0))

    def test_every_change_is_checked(self):
        self.check()
        for file, text in (('a.hpp', 'int a(int);\n'), ('b.cpp', 'int c();\n'), ('.clang-tidy', 'Checks: some\n')):
            (self.checkout / file).write_text(text, encoding='utf-8')
            self.assertEqual(self.check(), (0, 1), file)
        self.environment['CHECKER_VERSION'] = '2'
        self.assertEqual(self.check(), (0, 1))
        commands = self.checkout / 'build' / 'commands.json'
        commands.write_text(commands.read_text(encoding='utf-8').replace('-DROOT', '-DMORE -DROOT'), encoding='utf-8')
        self.assertEqual(self.check(), (0, 1))

    def test_a_warning_is_reported_until_it_is_gone(self):
        (self.checkout / 'a.hpp').write_text('int a();  // WARN\n', encoding='utf-8')
        self.assertEqual(self.check(), (1, 1))
        self.assertEqual(self.check(), (1, 1))
        (self.checkout / 'a.hpp').write_text('int a();\n', encoding='utf-8')
        self.assertEqual(self.check(), (0, 1))

    def test_sources_that_do_not_compile_together_are_remembered_too(self):
        (self.checkout / 'a.cpp').write_text('static int one = 1;\n', encoding='utf-8')
        (self.checkout / 'b.cpp').write_text('static int one = 2;\n', encoding='utf-8')
        self.assertEqual(self.check(), (0, 2))
        self.assertEqual(self.check(), (0, 0))
        (self.checkout / 'b.cpp').write_text('static int one = 2;  // WARN\n', encoding='utf-8')
        self.assertEqual(self.check(), (1, 2))

    def test_an_empty_cache_variable_checks_everything(self):
        self.check()
        self.environment['TIDY_CACHE'] = ''
        self.assertEqual(self.check(), (0, 1))


if __name__ == '__main__':
    unittest.main()
