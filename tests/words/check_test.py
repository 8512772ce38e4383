"""The check of words itself, on trees that break it on purpose."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
CHECK = ROOT / 'scripts' / 'words' / 'check.py'


def check(files, *options):
    """The check's exit code and output for a tree of these files."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            path = pathlib.Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding='utf-8')
        done = subprocess.run([sys.executable, CHECK, *options, folder], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout.splitlines()


class Check(unittest.TestCase):
    def assert_found(self, name, text, form, line=1):
        code, lines = check({name: text})
        self.assertEqual(code, 1, text)
        self.assertTrue(any(found.startswith(f'{name}:{line}: {form}: use ') for found in lines), lines)

    def test_finds_parts_of_identifiers(self):
        self.assert_found('core/a.hpp', 'struct HeardRun {};\n', 'heard')
        self.assert_found('core/a.hpp', 'int steps_heard_ = 0;\n', 'heard')
        self.assert_found('core/a.cpp', 'void listenTo();\n', 'listen')
        self.assert_found('core/a.cpp', 'constexpr int MOST_GUESTS = 3;\n', 'guests')

    def test_finds_comments_messages_and_documents(self):
        self.assert_found('core/a.hpp', 'int a;\n\n/// What it is told.\n', 'told', 3)
        self.assert_found('core/a.cpp', 'throw Error("the passport is gone");\n', 'passport')
        self.assert_found('docs/a.md', '# A\n\nNobody knows.\n', 'nobody', 3)
        self.assert_found('experiments/a.yaml', '# who steers the robot\n', 'steers')
        self.assert_found('Makefile', '# Somebody builds\n', 'somebody')

    def test_finds_phrases_across_punctuation_and_names(self):
        self.assert_found('docs/a.md', 'the learned ceiling\n', 'learned ceiling')
        self.assert_found('core/a.hpp', 'double bits_left = 0.0;\n', 'bits left')
        self.assert_found('docs/a.md', 'ends with the learned\nworst moment.\n', 'worst moment', 2)

    def test_leaves_other_words_alone(self):
        code, lines = check({'core/a.hpp': 'int shear, essay, retelling_, sayonara; // a hearty loudspeaker\n',
                             'docs/a.md': 'The wheel is in contact. The ceiling is high. The worst segment.\n'})
        self.assertEqual((code, lines), (0, []))

    def test_leaves_out_what_past_versions_were_called(self):
        self.assertEqual(check({'CHANGELOG.md': 'heard\n', 'build/a.md': 'heard\n', '.git/a.md': 'heard\n'}), (0, []))

    def test_names_the_term_to_use(self):
        self.assertEqual(check({'docs/a.md': 'A guest.\n'})[1], ['docs/a.md:1: guest: use external estimator'])

    def test_counts_by_word(self):
        code, lines = check({'docs/a.md': 'It says\nwhat was said and said.\n'}, '--count')
        self.assertEqual((code, [line.split() for line in lines]),
                         (1, [['2', 'said'], ['1', 'says'], ['3', 'in', '2', 'lines']]))


if __name__ == '__main__':
    unittest.main()
