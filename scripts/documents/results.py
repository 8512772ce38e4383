#!/usr/bin/env python3
"""results.py PROGRAM [--quick]: runs the commands of README.md and docs and compares the numbers of their
tables.

A comment above a table names the command and where its columns are in tables/results.csv of the run:

    <!-- results: touchdown run experiments/stairs.yaml
    2: study=success; simulator=mujoco; noise=1 N·m, 5 m/s²; metric=success / simulator=bullet
    -->

Without a command it is the first one of the block of code above. Column 2 is then compared. Behind " / " or " ± " stands what differs for the second part of a cell "a / b" or "a ± b".
A setting stands last, because it may contain semicolons. `columns: NAME` names such lines that are below.
A row's estimator is the first name in code in its first cell. `row: KEY` takes the first name in code, else the
first cell's text, for another key; with `row: *` it replaces each * of the lines.
Columns of other commands have comments of their own, one below the other. A comment without lines belongs to a
command that prints the table's rows.
A cell's numbers are the estimate, or the estimate with its interval, rounded to the cell's decimals; `%` counts in
percent. Comments that begin with `results quick:` are those of --quick. Runs stay in runs/results and resume.
"""

import argparse
import csv
import hashlib
import pathlib
import re
import shlex
import subprocess
import sys

from pages import blocks

ROOT = pathlib.Path(__file__).resolve().parents[2]
UNSEEN = 'study=benchmark_unseen; robot=upkie; sensors=upkie; metric='
QUIET, NOISY = 'noise=0 N·m, 0 m/s²', 'noise=1 N·m, 5 m/s²'
COLUMNS = {'unseen': [f'2: {UNSEEN}event_f1; {QUIET}', f'3: {UNSEEN}event_f1; {NOISY}'] +  # tables/benchmark_unseen.md
                     [f'{column}: {UNSEEN}{metric}; {QUIET} / {NOISY}' for column, metric in enumerate(
                         ('extra_switches_per_minute', 'long_errors_s_per_minute', 'takeoff_latency_median_ms',
                          'landing_latency_median_ms', 'no_contact_precision', 'mean_balanced_accuracy'), 4)]}
COMMENT = re.compile(r'<!-- results( quick)?:([^\n]*)\n(.*?)-->\n+', re.S)
TABLE = re.compile(r'((?:<!-- results(?: quick)?:(?:(?!-->).)*-->\n+)+)((?:\|[^\n]*\n)+)', re.S)
PARTS = re.compile(r' / | ± ')
NUMBER = re.compile(r'[-−]?\d*\.?\d+')


def filters_of(part):
    items, _, setting = ('; ' + part.strip()).partition('; setting=')
    return dict(item.split('=', 1) for item in items.split('; ')[1:]) | ({'setting': setting} if setting else {})


def command_above(page):
    _, _, code = list(blocks(page))[-1]
    return re.split(r' +#|\n', code)[0]


def checks(page):
    """Yields (quick, command, {column: [filters of its parts]}, key of the rows, rows of cells)."""
    found = [(match, *comment) for match in TABLE.finditer(page) for comment in COMMENT.findall(match[1])]
    for match, quick, command, places in found:
        command = command.strip() or command_above(page[:match.start()])
        columns, key = {}, 'estimator'
        lines = places.strip().splitlines()
        for line in lines:
            name, _, text = line.partition(': ')
            if name == 'columns':
                lines += COLUMNS[text.strip()]
                continue
            if name == 'row':
                key = text.strip()
                continue
            parts = [filters_of(part) for part in PARTS.split(text)]
            columns[int(name)] = [{**parts[0], **part} for part in parts]
        yield bool(quick), command, columns, key, [cells_of(line) for line in match[2].splitlines()[2:]]


def cells_of(line):
    return [cell.strip() for cell in re.split(r'(?<!\\)\|', line)[1:-1]]


def name_of(cell, key):
    code = re.search(r'`([^`]+)`', cell)
    return code[1] if code else None if key == 'estimator' else cell


def agrees(text, value, percent):
    """Whether a number of the page is this value, rounded to its decimals."""
    decimals = len(text.partition('.')[2])
    return abs(float(text.replace('−', '-')) - value * (100 if percent else 1)) <= 0.5 * 10 ** -decimals + 1e-9


def faults_of_part(text, where, results):
    """Yields what is wrong with a part of a cell."""
    found = [row for row in results if all(row[name] == value for name, value in where.items())]
    if len(found) != 1:
        yield f'{len(found)} numbers in results.csv for {where}'
        return
    numbers = NUMBER.findall(text.split('(')[0])
    names = ['estimate'] if len(numbers) == 1 else ['estimate', 'low', 'high']
    if len(numbers) != len(names):
        yield f'expected one number or three, found "{text}"'
        return
    for number, name in zip(numbers, names):
        if found[0][name] in ('', 'nan') or not agrees(number, float(found[0][name]), '%' in text):
            yield f'{number}: the run has {found[0][name]} ({name})'


def faults_of_table(columns, key, rows, results):
    """Yields (first cell, column, what is wrong)."""
    for row in rows:
        name = name_of(row[0], key)
        if name is None:
            continue
        for column, places in columns.items():
            parts = PARTS.split(row[column - 1]) if len(places) > 1 else [row[column - 1]]
            if parts in ([''], ['–']):
                continue
            if len(parts) != len(places):
                yield name, column, f'expected {len(places)} parts, found "{row[column - 1]}"'
                continue
            for part, where in zip(parts, places):
                if part == '–':
                    continue
                where = {field: value.replace('*', name) for field, value in where.items()}
                for fault in faults_of_part(part, where if key == '*' else {key: name, **where}, results):
                    yield name, column, fault


def printed_by(command):
    """The rows of all tables that a command prints."""
    done = subprocess.run(command, shell=True, cwd=ROOT, stdout=subprocess.PIPE, text=True, check=True)
    return [cells_of(line) for line in done.stdout.splitlines()]


def results_of(program, command, runs):
    """Runs a command, or finds its finished run, and returns the rows of its results.csv."""
    words = shlex.split(command)[1:]
    run = runs / hashlib.sha256(command.encode()).hexdigest()[:12]
    done = subprocess.run([program, *words, '--no-pictures', '--out', run], cwd=ROOT, stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, text=True, check=False)
    file = run / 'tables' / 'results.csv'
    if not file.exists():
        sys.exit(f'{command}: {done.stderr.strip()}')
    with file.open(encoding='utf-8', newline='') as rows:
        return list(csv.DictReader(rows))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('program', type=pathlib.Path)
    parser.add_argument('--quick', action='store_true')
    parser.add_argument('--runs', type=pathlib.Path, default=ROOT / 'runs' / 'results')
    parser.add_argument('--page', type=pathlib.Path, nargs='+',
                        default=[ROOT / 'README.md', *sorted((ROOT / 'docs').rglob('*.md'))])
    flags = parser.parse_args()
    failed, compared, known = 0, 0, {}
    pages = ''.join(page.read_text(encoding='utf-8') for page in flags.page)
    for quick, command, columns, key, rows in checks(pages):
        if flags.quick and not quick:
            continue
        if command not in known:
            known[command] = results_of(flags.program.resolve(), command, flags.runs.resolve()) if columns \
                else printed_by(command)
        faults = list(faults_of_table(columns, key, rows, known[command])) if columns else \
            [(row[0], 1, 'the command does not print this row') for row in rows if row not in known[command]]
        print(f'{command}: {len(rows)} rows, {len(faults)} differences')
        for name, column, fault in faults:
            print(f'  {name}, column {column}: {fault}')
        compared += 1
        failed += len(faults)
    if compared == 0:
        sys.exit('no table to compare')
    return 1 if failed else 0


if __name__ == '__main__':
    sys.exit(main())
