"""The reference of tables is that of the program, and its generator notices columns without a meaning.

    tables_test.py TOUCHDOWN
"""

import io
import pathlib
import subprocess
import sys
import unittest
from contextlib import redirect_stderr

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / 'scripts' / 'documents'))
import tables  # noqa: E402

PROGRAM = sys.argv.pop(1)


class Tables(unittest.TestCase):
    def test_are_those_of_the_program(self):
        done = subprocess.run([sys.executable, ROOT / 'scripts' / 'documents' / 'tables.py', PROGRAM],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        page = (ROOT / 'docs' / 'reference' / 'tables.md').read_text(encoding='utf-8')
        self.assertEqual(done.stdout, page, 'write it again: scripts/documents/tables.py PROGRAM > docs/reference/tables.md')

    def test_a_column_without_a_meaning_is_refused(self):
        for names in ({'a', 'b'}, set(), {'b'}):
            with self.assertRaisesRegex(SystemExit, 'columns: without a meaning: '), redirect_stderr(io.StringIO()):
                tables.complete('columns', {'a': 'first'}, names)
        tables.complete('columns', {'a': 'first'}, {'a'})

    def test_each_name_has_one_meaning(self):
        for file in ('tables.tsv', 'columns.tsv'):
            names = [row[0] for row in tables.rows_of(file)]
            self.assertEqual(len(names), len(set(names)), file)
            self.assertTrue(all(len(row) == (3 if file == 'tables.tsv' else 2) for row in tables.rows_of(file)), file)


if __name__ == '__main__':
    unittest.main()
