"""Runs a small experiment by the recipe for GNU parallel in docs/guides/shards.md, on this machine
only: every file must equal that of a single run.

    parallel_test.py TOUCHDOWN

Exit code 77: there is no GNU parallel here.
"""

import pathlib
import shutil
import subprocess
import sys

import recipes
import work
from work import check


def test(folder, touchdown):
    work.write_experiment(folder.work, runs=2, seeds=4)
    output = folder.run(work.recipe('GNU parallel', experiment='tiny.yaml', out='out', shards='3',
                                  hosts=':'))
    for shard in (1, 2, 3):
        check(f'shard {shard}/3: ' in output, output)
    work.compare_with_local_run(folder.work / 'out', touchdown, folder.work)
    output = folder.run(work.recipe('GNU parallel', experiment='tiny.yaml', out='out', shards='3',
                                  hosts=':'))
    check(output.count(' 0 computed now') == 3, f'something was computed twice: {output}')

    # After a failed shard, the results are not made.
    output = folder.run(work.recipe('GNU parallel', experiment='tinny.yaml', out='no', shards='2',
                                  hosts=':'), fails=True)
    check('tinny.yaml: no such file' in output and 'evaluated before' not in output, output)


def main():
    shown = subprocess.run(['parallel', '--version'], capture_output=True, text=True, check=False) \
        if shutil.which('parallel') else None
    if shown is None or 'GNU parallel' not in shown.stdout:
        print('skipped: no GNU parallel here (Debian package parallel)')
        return 77
    touchdown = pathlib.Path(sys.argv[1]).resolve()
    with recipes.Recipes(touchdown) as folder:
        test(folder, touchdown)
    return 0


if __name__ == '__main__':
    sys.exit(main())
