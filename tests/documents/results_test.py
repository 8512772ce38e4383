"""The comparison of results with the page, on made-up pages and results, and the quick part of the page itself.

    results_test.py TOUCHDOWN
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / 'scripts' / 'documents'))
import results  # noqa: E402

PROGRAM = sys.argv.pop(1)
PAGE = """
<!-- results: touchdown run a.yaml
2: study=success; metric=success; simulator=mujoco
3: study=success; metric=success; simulator=mujoco / simulator=bullet
-->

| estimator | MuJoCo | both |
|---|---|---|
| **`robust`**, with words | {} | {} |
| always | 1 | 1 / 1 |
"""
RESULTS = [{'study': 'success', 'metric': 'success', 'estimator': 'robust', 'simulator': engine, 'estimate': estimate,
            'low': low, 'high': high} for engine, estimate, low, high in
           (('mujoco', '0.98449', '0.98151', '0.98749'), ('bullet', '0.5', '', ''))]


class Results(unittest.TestCase):
    def faults(self, first, second):
        [(_, command, columns, key, rows)] = results.checks(PAGE.format(first, second))
        self.assertEqual(command, 'touchdown run a.yaml')
        return [(column, fault) for _, column, fault in results.faults_of_table(columns, key, rows, RESULTS)]

    def test_agree_to_the_decimals_of_the_page(self):
        for cell in ('.984', '0.984 [.982, .987]', '**.98**', '98.4 %', '.98449', '1'):
            self.assertEqual(self.faults(cell, '.984 / .5'), [], cell)

    def test_that_differ_are_found(self):
        for cell in ('.985', '.984 [.981, .987]', '.984 [.982, .988]', '98.5 %', '−.984', '.9844'):
            self.assertEqual([column for column, _ in self.faults(cell, '.98 / .50')], [2], cell)
        self.assertEqual([column for column, _ in self.faults('.98', '.98 / .51')], [3])

    def test_in_another_form_are_found(self):
        self.assertEqual(self.faults('.98', '.98'), [(3, 'expected 2 parts, found ".98"')])
        self.assertEqual(self.faults('.98, .97', '.98 / .5'), [(2, 'expected one number or three, found ".98, .97"')])
        [(_, _, columns, key, rows)] = results.checks(PAGE.format('.98', '.98 / .5').replace('robust', 'robbust'))
        faults = [fault for _, _, fault in results.faults_of_table(columns, key, rows, RESULTS)]
        self.assertTrue(all(fault.startswith('0 numbers in results.csv') for fault in faults) and len(faults) == 3)

    def test_of_every_table_of_the_page_name_columns_that_exist(self):
        page = (ROOT / 'docs' / 'results.md').read_text(encoding='utf-8')
        found = list(results.checks(page))
        self.assertEqual(len(found), page.count('<!-- results'))
        for _, command, columns, _, rows in found:
            self.assertTrue(rows and all(max(columns) <= len(row) for row in rows), command)

    def test_of_the_quick_commands_are_those_of_the_page(self):
        with tempfile.TemporaryDirectory() as runs:
            done = subprocess.run([sys.executable, ROOT / 'scripts' / 'documents' / 'results.py', PROGRAM, '--quick',
                                   '--runs', runs], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == '__main__':
    unittest.main()
