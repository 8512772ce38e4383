"""Parent of all processes that a test starts; it leaves none of them behind.

    guard.py FOLDER

Reads one JSON list of arguments per line from standard input, starts that process and prints its id.
When standard input ends, because the test is over or was killed, it kills all descendants of these
processes, daemons included, and removes FOLDER.
"""

import ctypes
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

PR_SET_PDEATHSIG = 1
PR_SET_CHILD_SUBREAPER = 36
libc = ctypes.CDLL(None, use_errno=True)


END_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


def prepare():
    """In a child: it does not outlive the guard, and the signals that the guard ignores end it."""
    libc.prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
    for number in END_SIGNALS:
        signal.signal(number, signal.SIG_DFL)


def start(arguments, folder):
    """Starts a child with its own log."""
    log = folder / (pathlib.Path(arguments[0]).name + '.out')
    with open(log, 'ab') as output:
        return subprocess.Popen(arguments, stdin=subprocess.DEVNULL, stdout=output, stderr=output,
                                preexec_fn=prepare)


def descendants():
    parents = {}
    for entry in pathlib.Path('/proc').iterdir():
        if entry.name.isdigit():
            try:
                after_name = (entry / 'stat').read_text().rpartition(')')[2].split()
                parents[int(entry.name)] = int(after_name[1])
            except OSError:
                pass  # the process has ended
    found, new = set(), {os.getpid()}
    while new:
        new = {pid for pid, parent in parents.items() if parent in new} - found
        found |= new
    return found


def reap():
    """Reaps every child that has ended. Returns whether there are others."""
    try:
        while os.waitpid(-1, os.WNOHANG)[0]:
            pass
    except ChildProcessError:
        return False
    return True


def kill_all():
    """Kills all descendants. Orphans become the guard's children, so none is left when it has none."""
    for _ in range(200):
        for pid in descendants():
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        if not reap():
            return
        time.sleep(0.05)


def main():
    folder = pathlib.Path(sys.argv[1])
    libc.prctl(PR_SET_CHILD_SUBREAPER, 1)
    for number in END_SIGNALS:
        signal.signal(number, signal.SIG_IGN)  # standard input ends then too
    signal.signal(signal.SIGCHLD, lambda *_: reap())
    try:
        for line in sys.stdin:
            print(start(json.loads(line), folder).pid, flush=True)
    finally:
        kill_all()
        shutil.rmtree(folder, ignore_errors=True)


if __name__ == '__main__':
    main()
