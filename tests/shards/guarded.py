"""Shared by the tests of shards: a scratch folder with processes that do not outlive the test."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time


class Guarded:
    """A context manager: a folder, and processes that end with it, even if the test is killed (see
    guard.py)."""

    def __enter__(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix='touchdown_shards_'))
        self.environment = {name: value for name, value in os.environ.items()
                            if not name.startswith(('SLURM', 'SBATCH', 'SQUEUE', 'SINFO', 'SSH_',
                                                    'PARALLEL', 'RSYNC_'))}
        self.prepare()
        self.guard = subprocess.Popen(
            [sys.executable, str(pathlib.Path(__file__).with_name('guard.py')), str(self.folder)],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, start_new_session=True,
            env=self.environment)
        try:
            self.folder.chmod(0o755)
            self.start()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        self.guard.stdin.close()
        self.guard.wait()

    def prepare(self):
        """Sets the environment of all processes, before any is started."""

    def start(self):
        """Starts the processes that the test needs."""

    def process(self, *arguments):
        """Starts a process and returns its id."""
        self.guard.stdin.write(json.dumps([str(a) for a in arguments]) + '\n')
        self.guard.stdin.flush()
        return int(self.guard.stdout.readline())

    def wait_for(self, what, condition, seconds=60.0):
        end = time.monotonic() + seconds
        while not condition():
            if time.monotonic() > end:
                raise RuntimeError(f'waited in vain for {what}\n' + self.logs())
            time.sleep(0.02)

    def logs(self):
        parts = []
        for log in sorted(self.folder.glob('*.log')) + sorted(self.folder.glob('*.out')):
            parts.append(f'--- {log.name}\n' + log.read_text(errors='replace')[-3000:])
        return '\n'.join(parts)
