#!/usr/bin/env python3
"""compile_alone.py <compile_commands.json>: compiles every source alone, so that each includes what it uses, and
writes nothing. The build, and clang-tidy, read many sources as one, where another one's include is enough.
Headers that the build has precompiled count as included. The exit code is 1 if a source does not compile."""
import concurrent.futures
import json
import os
import pathlib
import shlex
import subprocess
import sys

from tidy import sources_of


def errors_of(source, command, folder):
    done = subprocess.run([*command, "-fsyntax-only", "-w", source], cwd=folder, capture_output=True, text=True,
                          check=False)
    return "".join(line for line in done.stderr.splitlines(True) if "error: " in line) if done.returncode else ""


def main():
    commands = {}
    for entry in json.loads(pathlib.Path(sys.argv[1]).read_text()):
        words = shlex.split(entry["command"])
        compiler = next(i for i, word in enumerate(words) if word.endswith("c++"))
        for source in sources_of(entry):
            if not source.startswith(entry["directory"] + os.sep):
                commands[source] = (words[compiler:words.index("-o")], entry["directory"])
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        errors = list(pool.map(lambda source: errors_of(source, *commands[source]), commands))
    print("".join(errors), f"{len(commands)} sources, {sum(map(bool, errors))} of them do not compile alone", sep="")
    return 1 if any(errors) else 0


if __name__ == "__main__":
    sys.exit(main())
