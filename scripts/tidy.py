#!/usr/bin/env python3
"""tidy.py <compile_commands.json> [path...]: clang-tidy over every source that the build compiles, or over
those sources and headers that the paths, or folders, name.

clang-tidy spends most of a file's time in headers of libraries, again for every file. So files are
checked together, as one translation unit that includes them, with all of their options. Files that do
not compile after the others of their unit (they define the same private name) form another unit; what
the first pass found in the others counts. Generated sources are skipped.
Tests are units of their own: the speed of a test's code does not matter, so that they are not checked
for it, which is a quarter of the time.
Prints the warnings of clang-tidy; the exit code is 1 if there are any.
"""
import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

FILES_AT_ONCE = 128
NOT_OF_TESTS = ["--checks=-performance-*"]
# Options of g++ only: its precompiled headers, memory, an optimisation, a warning.
OF_GCC = re.compile(r" -(Winvalid-pch|fpch-preprocess|include \S*cmake_pch\.hxx|-param=\S+|fexpensive-optimizations"
                    r"|Wno-restrict)")
# "12 warnings generated." counts hidden warnings in headers of libraries.
NOISE = re.compile(r"^\d+ (warnings?|errors?)( and \d+ errors?)? (generated|treated as errors?)\.?$")


# Options that take the next word as their argument.
WITH_A_WORD = ("-isystem", "-include")


def are_tests(files):
    return files[0].startswith(os.path.abspath("tests") + os.sep)


def batches_of(files):
    """Batches of equal sizes, of tests or of other sources."""
    tests = [file for file in files if are_tests([file])]
    for some in ([file for file in files if file not in tests], tests):
        count = -(-len(some) // FILES_AT_ONCE)
        yield from (some[len(some) * i // count:len(some) * (i + 1) // count] for i in range(count))


def flags_of(entry):
    """The compiler's options, each with its argument, without the source and the object file."""
    words = shlex.split(OF_GCC.sub("", entry["command"]))
    compiler = next(i for i, word in enumerate(words) if word.endswith("c++"))
    words = iter(words[compiler + 1:words.index("-o")])
    return [(word, next(words)) if word in WITH_A_WORD else (word,) for word in words]


def is_dialect(flag):
    return flag[0].startswith("-std=")


def macros_of(flags):
    return dict(word.split("=", 1) for word, *_ in flags if word.startswith("-D") and "=" in word)


def contradict(flags, others):
    """Whether two lists of options differ in the last language standard or in a macro's value."""
    dialects = [[flag for flag in each if is_dialect(flag)][-1:] for each in (flags, others)]
    ours, theirs = macros_of(flags), macros_of(others)
    return dialects[0] != dialects[1] or any(
        ours[name] != theirs[name] for name in ours.keys() & theirs.keys())


def sources_of(entry):
    """The file, or the files of a folder that the build compiles as one (scripts/cmake/TouchdownTargets.cmake)."""
    file = os.path.abspath(os.path.join(entry["directory"], entry["file"]))
    if not file.endswith(".cxx"):
        return [file]
    return re.findall(r'^#include "(.*)"', pathlib.Path(file).read_text(), re.MULTILINE)


def together(flags, files, folder):
    """Writes the unit that includes these files; a single file is its own unit."""
    if len(files) == 1:
        return files[0]
    handle, unit = tempfile.mkstemp(suffix=".cpp", dir=folder)
    with os.fdopen(handle, "w") as stream:
        for file in files:
            stream.write(f'#include "{file}"  // NOLINT(bugprone-suspicious-include)\n')
    return unit


def misfits(files, text):
    """Files in which clang-tidy found errors of the compiler, so that they fit no unit with the others; and whether
    all of the others were read."""
    wrong = set(re.findall(r"^(.*?):\d+:\d+: (?:fatal )?error: .*\[clang-diagnostic-error", text, re.MULTILINE))
    found = [file for file in files if file in wrong]
    if wrong and (": fatal error: " in text or not 0 < len(found) < len(files)):
        return files[len(files) // 2:], False  # checking halves locates the errors
    return found, len(found) == len(wrong)


def without(files, text):
    """The warnings of clang-tidy that are about none of these files."""
    first, *blocks = re.split(r"^(?=\S+:\d+:\d+: (?:fatal )?(?:error|warning): )", text, flags=re.MULTILINE)
    return first + "".join(block for block in blocks if block.split(":", 1)[0] not in files)


def check(flags, files, folder):
    """The warnings of clang-tidy about the files, as text; empty if there are none."""
    unit = together(flags, files, folder)
    warnings = warnings_of(flags, files, unit)
    apart, is_complete = misfits(files, warnings)
    if len(files) > 1 and apart:
        rest = [file for file in files if file not in apart]
        warnings = without(apart, warnings) if is_complete else check(flags, rest, folder)
        warnings += check(flags, apart, folder)
    return warnings


def warnings_of(flags, files, unit):
    """The warnings of clang-tidy about one unit, the given files together."""
    done = subprocess.run(
        # Private names of different files do not shadow each other; the compiler finds real shadowing.
        ["clang-tidy", "--quiet", "--warnings-as-errors=*", *(NOT_OF_TESTS if are_tests(files) else []), unit, "--",
         *flags, "-Wno-shadow", "-ferror-limit=0"],
        capture_output=True, text=True, check=False)
    lines = (done.stdout + done.stderr).splitlines()
    warnings = "\n".join(line for line in lines if line and not NOISE.match(line))
    if done.returncode and not warnings:
        warnings = f"clang-tidy failed on {', '.join(files)} without output"
    return warnings + "\n" if done.returncode else ""


def groups_of(commands, paths):
    """Groups of files that can be checked together: their joined options, and the sorted files. A header has the
    options of the first source of its folder."""
    groups = []
    headers = {path for path in paths if path.endswith(".hpp")}
    for entry in commands:
        flags = flags_of(entry)
        sources = [file for file in sources_of(entry) if not file.startswith(entry["directory"] + os.sep)]
        folders = {os.path.dirname(file) for file in sources}
        files = {file for file in sources if file.startswith(paths)}
        files |= {header for header in headers if os.path.dirname(header) in folders}
        headers -= files
        if not files:
            continue
        for theirs, members in groups:
            if not contradict(flags, theirs):
                theirs += [flag for flag in flags if flag not in theirs and not is_dialect(flag)]
                members |= files
                break
        else:
            groups.append((flags, files))
    return [([word for flag in flags for word in flag], sorted(files)) for flags, files in groups]


def main():
    commands = json.loads(pathlib.Path(sys.argv[1]).read_text())
    paths = tuple(os.path.abspath(path) for path in sys.argv[2:]) or ("/",)
    batches = [(flags, batch) for flags, files in groups_of(commands, paths) for batch in batches_of(files)]
    batches.sort(key=lambda batch: -len(batch[1]))  # the long ones first
    jobs = int(os.environ.get("JOBS") or os.cpu_count())
    # Beside the sources, where clang-tidy looks for its configuration.
    with tempfile.TemporaryDirectory(dir=".", prefix=".tidy-") as folder, \
            concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        folder = os.path.abspath(folder)
        checks = [pool.submit(check, *batch, folder) for batch in batches]
        clean = True
        for done, finished in enumerate(concurrent.futures.as_completed(checks), 1):
            warnings = finished.result()
            clean = clean and not warnings
            print(warnings, end="", flush=True)
            print(f"clang-tidy: {done}/{len(checks)}", file=sys.stderr, flush=True)
    return 0 if clean else 1


if __name__ == "__main__":
    sys.exit(main())
