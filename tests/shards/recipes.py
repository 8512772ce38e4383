"""A folder that runs recipes of docs/guides/shards.md, with the program in the path."""

import os
import pathlib
import signal

import guarded


class Recipes(guarded.Guarded):
    """A context manager."""

    def __init__(self, touchdown):
        self.touchdown = touchdown

    def prepare(self):
        self.bin = self.folder / 'bin'
        self.work = self.folder / 'work'
        self.bin.mkdir()
        self.work.mkdir()
        # No link: the program finds its files and its build relative to its own location.
        self.script('touchdown', f'exec \'{self.touchdown}\' "$@"')
        self.environment['PATH'] = f'{self.bin}:{self.environment["PATH"]}'
        # GNU parallel asks for a citation once in every home, and saves the answer there.
        self.environment['PARALLEL_HOME'] = str(self.folder / 'parallel')
        (self.folder / 'parallel').mkdir()
        (self.folder / 'parallel' / 'will-cite').touch()
        self.count = 0

    def script(self, name, text):
        (self.bin / name).write_text(f'#!/bin/bash\n{text}\n')
        (self.bin / name).chmod(0o755)

    def begin(self, recipe):
        """Starts a recipe as the leader of a process group. Returns its process."""
        self.count += 1
        name = f'recipe_{self.count}'
        (self.folder / f'{name}.sh').write_text(recipe)
        self.script(name, f'cd \'{self.work}\'\nbash \'{self.folder}/{name}.sh\'\n'
                    f'echo $? > \'{self.folder}/{name}.part\'\n'
                    f'mv \'{self.folder}/{name}.part\' \'{self.folder}/{name}.status\'')
        return self.process('/usr/bin/setsid', '--wait', self.bin / name)

    def end(self):
        """Waits for the last recipe. Returns its exit status and its output."""
        status = self.folder / f'recipe_{self.count}.status'
        self.wait_for('the recipe', status.exists, 200)
        # The guard names a log after its program, and appends.
        log = self.folder / 'setsid.out'
        output = log.read_text(errors='replace')
        log.rename(self.folder / f'recipe_{self.count}.log')
        print(output, end='')
        return int(status.read_text()), output

    def run(self, recipe, fails=False):
        """Runs a recipe and returns the output of all its commands."""
        self.begin(recipe)
        status, output = self.end()
        if (status != 0) != fails:
            raise AssertionError(f'ended with {status}\n{output}')
        return output


def processes_in(folder):
    """Processes of the program with a working directory in this folder or below it."""
    found = []
    for entry in pathlib.Path('/proc').iterdir():
        try:
            inside = pathlib.Path(os.readlink(entry / 'cwd')).is_relative_to(folder)
            if entry.name.isdigit() and inside and b'\0--shard\0' in (entry / 'cmdline').read_bytes():
                found.append(int(entry.name))
        except OSError:
            pass  # the process has ended, or belongs to another user
    return found


def interrupt(process):
    """Stops a recipe of `begin`, as Ctrl-C in its terminal does."""
    children = pathlib.Path(f'/proc/{process}/task/{process}/children').read_text().split()
    for leader in children or [process]:
        os.killpg(os.getpgid(int(leader)), signal.SIGTERM)
