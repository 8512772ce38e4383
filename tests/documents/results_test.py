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

SCRIPT = ROOT / 'scripts' / 'documents' / 'results.py'
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

    def test_of_several_commands_have_columns_of_their_own(self):
        comment = '<!-- results: touchdown run b.yaml\n3: study=other; metric=success\n-->\n'
        page = PAGE.format('.98', '.5').replace('-->\n\n', '-->\n' + comment + '\n')
        found = [(command, sorted(columns), len(rows)) for _, command, columns, _, rows in results.checks(page)]
        self.assertEqual(found, [('touchdown run a.yaml', [2, 3], 2), ('touchdown run b.yaml', [3], 2)])

    def test_of_any_key_may_have_deviations_and_settings_with_semicolons(self):
        page = """```sh
touchdown run c.yaml   # a minute
touchdown run d.yaml
```
<!-- results:
row: *
2: study=latency; metric=*_ms; setting=view=wheels; speed=1 ± metric=*_deviation_ms
-->

| event | delay |
|---|---|
| `takeoff` | 5 ± 13 |
| landing | – ± 2 |
"""
        [(_, command, columns, key, cells)] = results.checks(page)
        self.assertEqual(command, 'touchdown run c.yaml')
        rows = [{'study': 'latency', 'metric': metric, 'setting': setting, 'estimate': estimate, 'low': '', 'high': ''}
                for metric, estimate in (('takeoff_ms', '5.4'), ('takeoff_deviation_ms', '12.6'),
                                         ('landing_ms', '7'), ('landing_deviation_ms', '2.1'))
                for setting in ('view=wheels; speed=1',)]
        self.assertEqual(list(results.faults_of_table(columns, key, cells, rows)), [])
        for row, wrong in ((0, '6'), (1, '14'), (3, '3')):
            worse = [{**one, 'estimate': wrong} if i == row else one for i, one in enumerate(rows)]
            self.assertEqual(len(list(results.faults_of_table(columns, key, cells, worse))), 1, rows[row])

    def test_of_a_command_that_prints_rows_are_those_rows(self):
        for printed, code in (('| `a` | 1 |', 0), ('| `a` | 2 |', 1)):
            with tempfile.TemporaryDirectory() as folder:
                page = pathlib.Path(folder) / 'page.md'
                page.write_text(f"<!-- results: echo '{printed}'\n-->\n\n| x | y |\n|---|---|\n| `a` | 1 |\n",
                                encoding='utf-8')
                done = subprocess.run([sys.executable, SCRIPT, PROGRAM, '--page', page], capture_output=True, text=True,
                                      check=False)
            self.assertEqual(done.returncode, code, done.stdout + done.stderr)

    def test_of_the_benchmarks_table_agree_with_its_markdown(self):
        printed = """| estimator | no added noise | 1 N·m, 5 m/s² | extra switches a minute |
|---|---|---|---|
| `load_filter` | .999 [.998, 1] | 1 | 0.0 / 12.5 | 0.1 / 0.2 | +1.0 / -2.5 | +1.0 / +2.0 | .9 / .8 | .99 / .98 |
"""
        quiet, noisy = '0 N·m, 0 m/s²', '1 N·m, 5 m/s²'
        page = f'<!-- results: touchdown run experiments/benchmark.yaml\ncolumns: unseen\n-->\n\n{printed}'
        rows = [{'study': 'benchmark_unseen', 'robot': 'upkie', 'sensors': 'upkie', 'metric': metric,
                 'estimator': 'load_filter', 'noise': noise, 'estimate': estimate, 'low': low, 'high': high}
                for metric, noise, estimate, low, high in
                (('event_f1', quiet, '0.99904', '0.99823', '1'), ('event_f1', noisy, '0.9997', '', ''),
                 *((metric, noise, estimate, '', '') for metric, *both in
                   (('extra_switches_per_minute', '0.02', '12.46'), ('long_errors_s_per_minute', '0.1', '0.2'),
                    ('takeoff_latency_median_ms', '1', '-2.5'), ('landing_latency_median_ms', '1', '2'),
                    ('no_contact_precision', '0.9', '0.8'), ('mean_balanced_accuracy', '0.99', '0.98'))
                   for noise, estimate in zip((quiet, noisy), both)))]
        [(_, _, columns, key, cells)] = results.checks(page)
        self.assertEqual(list(results.faults_of_table(columns, key, cells, rows)), [])
        rows[3]['estimate'] = '12.6'
        self.assertEqual([column for _, column, _ in results.faults_of_table(columns, key, cells, rows)], [4])

    def test_of_every_table_of_the_pages_name_columns_that_exist(self):
        for page in (ROOT / 'README.md', *(ROOT / 'docs').rglob('*.md')):
            text = page.read_text(encoding='utf-8')
            found = list(results.checks(text))
            self.assertEqual(len(found), text.count('<!-- results'), page)
            for _, command, columns, _, rows in found:
                self.assertTrue(rows and all(max(columns, default=1) <= len(row) for row in rows), command)

    def test_of_the_quick_commands_are_those_of_the_page(self):
        with tempfile.TemporaryDirectory() as runs:
            done = subprocess.run([sys.executable, SCRIPT, PROGRAM, '--quick', '--runs', runs], capture_output=True,
                                  text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == '__main__':
    unittest.main()
