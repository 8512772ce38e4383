#!/usr/bin/env python3
"""rows.py BUILD [--only WORD]: prints the rows of the table in docs/reference/performance.md, measured on this machine.

Every command is run once from the checkout's root: seconds by the clock, processor seconds (user) and the largest
memory of a process, beside two references: seconds to compile one fixed source, and a bare engine's step. Processor
seconds hardly depend on other programs; seconds by the clock need a quiet machine. All rows take about half an hour
on two cores; `--only benchmark` measures the rows that contain the word.
"""

import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]


def measured(command):
    """(seconds by the clock, processor seconds, largest megabytes, output) of a command."""
    begin = time.monotonic()
    process = subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    output = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f'{" ".join(map(str, command))}: exit status {os.waitstatus_to_exitcode(status)}')
    return time.monotonic() - begin, usage.ru_utime, usage.ru_maxrss / 1024, output


def counters(build, program, name):
    """The JSON of one benchmark of a program."""
    output = measured([build / program, f'--benchmark_filter={name}', '--benchmark_format=json'])[3]
    return json.loads(output)['benchmarks']


def row(what, clock, user='', memory='', more=''):
    text = [f'{clock:.1f}' if isinstance(clock, float) else clock, f'{user:.0f}' if user else '',
            f'{memory:.0f}' if memory else '', more]
    print(f'| {what} | ' + ' | '.join(text) + ' |', flush=True)


def of_program(build, scratch, what, *words, more=''):
    clock, user, memory, _ = measured([build / 'touchdown', *words, *(['--out', scratch / 'run'] if words[0] == 'run'
                                                                     else ['-o', scratch / 'log.mpack'])])
    shutil.rmtree(scratch / 'run', ignore_errors=True)
    row(what, clock, user, memory, more)
    return user


def compile_reference(build, _):
    clock = min(one['real_time'] for one in counters(build, 'bench_reference', 'compile_reference'))
    row('reference: compile one fixed source', float(clock))


def engines(build, _):
    for engine in ('mujoco', 'bullet'):
        [one] = counters(build, 'bench_simulators', f'^step/{engine}/')
        row(f'reference: a bare step, {engine}', '', more=f'{one["bare_us"]:.1f} µs; a scenario\'s: '
            f'{1 + one["overhead_percent"] / 100:.2f} of it')


def simulate(build, scratch):
    for engine in ('mujoco', 'bullet'):
        of_program(build, scratch, f'`simulate scenarios/stairs.yaml`, {engine}', 'simulate', 'scenarios/stairs.yaml',
                   '--simulator', engine)


def film(build, _):
    for one in counters(build, 'bench_render', '^film/page:[01]/workers:2/'):
        quality = 'page' if 'page:1' in one['name'] else 'draft'
        row(f'film, {quality}, two workers', '', more=f'{one["fps"]:.0f} pictures/s')


def noise_study(build, scratch):
    of_program(build, scratch, '`run experiments/noise_study.yaml --no-pictures`', 'run',
               'experiments/noise_study.yaml', '--no-pictures')
    of_program(build, scratch, '`run experiments/noise_study.yaml`', 'run', 'experiments/noise_study.yaml')


def benchmark(build, scratch):
    of_program(build, scratch, '`run experiments/benchmark.yaml`', 'run', 'experiments/benchmark.yaml')


def benchmark_full(build, scratch):
    of_program(build, scratch, '`run experiments/benchmark_full.yaml`', 'run', 'experiments/benchmark_full.yaml')


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('build', type=pathlib.Path, help='build folder, with bench_* (make everything)')
    parser.add_argument('--only', default='', help='a word in the names: ' + ', '.join(r.__name__ for r in ROWS))
    flags = parser.parse_args()
    print('| what | clock (s) | processor (s) | memory (MB) | |\n|---|---:|---:|---:|---|', flush=True)
    for measure in ROWS:
        if flags.only in measure.__name__:
            with tempfile.TemporaryDirectory() as scratch:
                measure(flags.build.resolve(), pathlib.Path(scratch))


ROWS = (compile_reference, engines, simulate, film, noise_study, benchmark, benchmark_full)

if __name__ == '__main__':
    main()
