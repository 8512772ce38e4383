#!/usr/bin/env python3
"""tidy.py <compile_commands.json> [path prefix...]: clang-tidy over every source that the build compiles.

clang-tidy spends most of a file's time in other people's headers, again for every file. So files that
are compiled alike are checked together, as one translation unit that includes them; where they do not
go together (two of them define the same private name), the unit is cut in half until they do.
Prints what clang-tidy has to say; the exit code is 1 if that is anything.
"""
import collections
import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

FILES_AT_ONCE = 16
# What g++ alone knows: how it reads its precompiled headers, which clang cannot, and an optimisation.
OF_GCC = re.compile(r" -(Winvalid-pch|fpch-preprocess|include \S*cmake_pch\.hxx|fexpensive-optimizations)")
# "12 warnings generated." counts what was hidden in other people's headers.
NOISE = re.compile(r"^\d+ (warnings?|errors?)( and \d+ errors?)? (generated|treated as errors?)\.?$")


def flags_of(entry):
    """The compiler's options, without the file and where its object goes."""
    words = shlex.split(OF_GCC.sub("", entry["command"]))
    compiler = next(i for i, word in enumerate(words) if word.endswith("c++"))
    words = words[compiler + 1:]
    output = words.index("-o")
    return tuple(words[:output])


def sources_of(entry):
    """The file, or the files of a room that the build compiles as one (cmake/TouchdownTargets.cmake)."""
    file = os.path.abspath(os.path.join(entry["directory"], entry["file"]))
    if not file.endswith(".cxx"):
        return [file]
    return re.findall(r'^#include "(.*)"', pathlib.Path(file).read_text(), re.MULTILINE)


def together(flags, files, folder):
    """Writes the unit that includes these files; a file alone is its own unit."""
    if len(files) == 1:
        return files[0]
    handle, unit = tempfile.mkstemp(suffix=".cpp", dir=folder)
    with os.fdopen(handle, "w") as stream:
        for file in files:
            stream.write(f'#include "{file}"  // NOLINT(bugprone-suspicious-include)\n')
    return unit


def compiles(flags, unit):
    command = ["clang++", *flags, "-w", "-fsyntax-only", unit]
    return subprocess.run(command, capture_output=True, check=False).returncode == 0


def check(flags, files, folder):
    """What clang-tidy says of the files, as text; empty if nothing."""
    unit = together(flags, files, folder)
    if len(files) > 1 and not compiles(flags, unit):
        middle = len(files) // 2
        return check(flags, files[:middle], folder) + check(flags, files[middle:], folder)
    done = subprocess.run(
        # A private name of one file does not shadow another file's; the compiler looks for real ones.
        ["clang-tidy", "--quiet", "--warnings-as-errors=*", unit, "--", *flags, "-Wno-shadow"],
        capture_output=True, text=True, check=False)
    lines = (done.stdout + done.stderr).splitlines()
    said = "\n".join(line for line in lines if line and not NOISE.match(line))
    if done.returncode and not said:
        said = f"clang-tidy failed on {', '.join(files)} without a word"
    return said + "\n" if done.returncode else ""


def main():
    commands = json.loads(pathlib.Path(sys.argv[1]).read_text())
    prefixes = tuple(os.path.abspath(path) for path in sys.argv[2:])
    alike = collections.defaultdict(list)
    for entry in commands:
        for file in sources_of(entry):
            if "cmake_pch" not in file and file.startswith(prefixes or ("/",)):
                alike[flags_of(entry)].append(file)
    batches = [(flags, files[start:start + FILES_AT_ONCE])
               for flags, unsorted in alike.items() for files in [sorted(set(unsorted))]
               for start in range(0, len(files), FILES_AT_ONCE)]
    batches.sort(key=lambda batch: -len(batch[1]))  # the long ones first
    jobs = int(os.environ.get("JOBS") or os.cpu_count())
    # Beside the sources, where clang-tidy looks for its configuration.
    with tempfile.TemporaryDirectory(dir=".", prefix=".tidy-") as folder, \
            concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        folder = os.path.abspath(folder)
        checks = [pool.submit(check, *batch, folder) for batch in batches]
        clean = True
        for done, finished in enumerate(concurrent.futures.as_completed(checks), 1):
            said = finished.result()
            clean = clean and not said
            print(said, end="", flush=True)
            print(f"clang-tidy: {done}/{len(checks)}", file=sys.stderr, flush=True)
    return 0 if clean else 1


if __name__ == "__main__":
    sys.exit(main())
