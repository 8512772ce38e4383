"""Runs a small experiment as an array job on its own Slurm cluster (see cluster.py). During their work
one task is killed, one is requeued, and one runs out of time. Every file must equal that of an
undisturbed run without Slurm.

    slurm_test.py TOUCHDOWN

Exit code 77: there is no Slurm here, it does not start, or this is not root.
"""

import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time

import cluster
import work
from work import check

SUBMIT = pathlib.Path(__file__).resolve().parents[2] / 'scripts' / 'slurm' / 'submit.sh'
SHARDS = 3
PARTS = 80  # of each shard
# A wrapper of the program: a shard's first attempt stops until the test continues it.
PROGRAM = """#!/bin/sh
case "${{SLURM_RESTART_COUNT:-first}} $*" in
  first*--shard*) kill -STOP $$ ;;
esac
exec '{program}' "$@"
"""


def stopped_process_of(shard, folder):
    """The stopped process of the program that computes this shard in this folder, or None."""
    arguments = f'\0--shard\0{shard}/{SHARDS}\0'.encode()
    for entry in pathlib.Path('/proc').iterdir():
        try:
            if (entry.name.isdigit() and os.readlink(entry / 'cwd') == str(folder)
                    and arguments in (entry / 'cmdline').read_bytes()
                    and (entry / 'stat').read_text().rpartition(')')[2].split()[0] == 'T'):
                return int(entry.name)
        except OSError:
            pass  # the process has ended
    return None


class Array:
    """The experiment's array job and the job of its results."""

    def __init__(self, slurm, folder):
        self.slurm, self.folder = slurm, folder
        output = slurm.run(SUBMIT, 'tiny.yaml', SHARDS, '--cpus-per-task=1', cwd=folder).stdout
        print(output, end='')
        self.job, self.last, results = re.search(
            rf'^array +(\d+): {SHARDS} tasks, {PARTS} to {PARTS} of 240 parts each\n'
            r'last +(\d+):.*\nresults +(\S+)\n', output).groups()
        self.results = folder / results

    def parts(self, shard):
        """Number of a shard's parts that are saved."""
        done = {path.name for path in (self.results / 'state' / 'evaluation').glob('[!.]*')}
        every = [f'{engine}_step_test_{run:03}_seed_{seed:04}'
                 for engine in ('mujoco', 'bullet') for run in range(3) for seed in range(40)]
        return len(done.intersection(every[PARTS * (shard - 1):PARTS * shard]))

    def in_the_middle(self, shard):
        """Lets a shard's process work until some parts are saved, and stops it there. Returns the
        process and the number of saved parts."""
        self.slurm.wait_for(f'shard {shard}', lambda: stopped_process_of(shard, self.folder))
        process = stopped_process_of(shard, self.folder)
        while self.parts(shard) < 2:
            os.kill(process, signal.SIGCONT)
            time.sleep(0.05)
            os.kill(process, signal.SIGSTOP)
        self.slurm.wait_for('it to stop', lambda: stopped_process_of(shard, self.folder))
        saved = self.parts(shard)
        check(saved < PARTS, f'shard {shard} was over before it could be disturbed')
        return process, saved

    def wait_for_restart(self, shard):
        task = f'{self.job}_{shard}'
        self.slurm.wait_for(f'task {task} to be requeued',
                            lambda: self.slurm.job(task).get('Restarts') == '1')

    def log(self, name):
        return (self.results / 'logs' / name).read_text()

    def state(self, job):
        return self.slurm.job(job).get('JobState')


def check_errors(slurm, folder):
    """Errors are reported in one line, before anything is submitted."""
    def complaint(*arguments, **environment):
        ended = subprocess.run([str(a) for a in (SUBMIT, *arguments)], cwd=folder, text=True,
                               capture_output=True, env={**slurm.environment, **environment})
        check(ended.returncode in (1, 2) and ended.stderr.count('\n') == 1 and not ended.stdout,
              f'{arguments}: {ended}')
        return ended.stderr

    check('expected EXPERIMENT SHARDS' in complaint('tiny.yaml'), 'no shards')
    check("'0' is no number" in complaint('tiny.yaml', '0'), 'no shards')
    check('tinny.yaml: no such file' in complaint('tinny.yaml', '2'), 'no experiment')
    (elsewhere := slurm.folder / 'elsewhere').mkdir()
    for name in ('bash', 'dirname'):
        (elsewhere / name).symlink_to(shutil.which(name))
    check('no sbatch here' in complaint('tiny.yaml', '2', PATH=str(elsewhere)), 'no sbatch')
    check('build it first' in complaint('tiny.yaml', '2', TOUCHDOWN_PROGRAM='/nowhere/x'), 'no program')
    check(not slurm.run('squeue', '-h').stdout, 'a wrong request was submitted')


def test(slurm, touchdown):
    folder = slurm.folder / 'work'
    folder.mkdir()
    work.write_experiment(folder, runs=3, seeds=40)
    program = slurm.folder / 'touchdown'
    program.write_text(PROGRAM.format(program=touchdown))
    program.chmod(0o755)
    slurm.environment['TOUCHDOWN_PROGRAM'] = str(program)
    check_errors(slurm, folder)

    array = Array(slurm, folder)
    stopped = {shard: array.in_the_middle(shard) for shard in (1, 2, 3)}
    os.kill(stopped[1][0], signal.SIGKILL)
    # As when its node fails, or a job of higher priority takes its place.
    slurm.run('scontrol', 'requeue', f'{array.job}_2')
    # The signal that Slurm sends a minute before a task's time is over.
    slurm.run('scancel', '--batch', '--signal=USR1', f'{array.job}_3')
    for shard in (2, 3):
        try:
            os.kill(stopped[shard][0], signal.SIGCONT)
        except ProcessLookupError:
            pass  # Slurm continued the process before it ended it
    for shard in stopped:
        array.wait_for_restart(shard)

    slurm.wait_for('the results', lambda: array.state(array.last) not in ('PENDING', 'RUNNING'), 200)
    logs = {shard: array.log(f'shard_{array.job}_{shard}.txt') for shard in stopped}
    for shard, (_, saved) in stopped.items():
        print(f'--- shard {shard}, stopped after {saved} parts\n{logs[shard]}', end='')
        computed = int(re.search(rf'shard {shard}/3: {PARTS} parts, (\d+) computed', logs[shard])[1])
        check(0 < computed <= PARTS - saved, f'{computed} were computed, {saved} were saved before')
    check('killed by signal 9; back to the queue' in logs[1], 'the killed task does not report it')
    check('out of time; back to the queue' in logs[3], 'the task out of time does not report it')
    check(array.state(array.last) == 'COMPLETED', array.log(f'results_{array.last}.txt'))

    work.compare_with_local_run(array.results, touchdown, folder)


def main():
    if why := cluster.missing():
        print(f'skipped: {why}')
        return 77
    start = time.monotonic()
    try:
        with cluster.Cluster(cpus=3) as slurm:
            print(f'cluster up after {time.monotonic() - start:.1f} s in {slurm.folder}')
            try:
                test(slurm, sys.argv[1])
            except BaseException:
                print(slurm.logs())
                raise
    except cluster.DoesNotStart as why:
        print(f'skipped: {why}')
        return 77
    print(f'all good after {time.monotonic() - start:.1f} s')
    return 0


if __name__ == '__main__':
    sys.exit(main())
