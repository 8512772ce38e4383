#!/usr/bin/env python3
"""check.py [--count] [root]: finds words that words.tsv replaces, in names, comments, messages and documents.

Prints one line per place, `file:line: word: use ...`, and exits with 1 if there are any. --count prints
one line per word instead. Identifiers count as the words they consist of: `HeardRun` is "heard run".
"""

import collections
import pathlib
import re
import sys

ENDINGS = {'.cpp', '.hpp', '.h', '.py', '.pyi', '.md', '.yaml', '.yml', '.txt', '.sh', '.cmake', '.in', '.cff', '.toml'}
NAMES = {'Makefile', 'Containerfile'}
# What past releases were called, the licence, and test data of other people's files.
LEFT_OUT = ('CHANGELOG.md', 'docs/history.md', 'LICENSE', 'build/', 'runs/', 'tests/fuzz/corpus/', 'scripts/words/',
            'tests/words/')
LONGEST_PHRASE = 3

WORD = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+")


def rules(table):
    """Maps each form to (what to write instead, path prefixes in which the form is right)."""
    found = {}
    for number, line in enumerate(table.read_text(encoding='utf-8').splitlines(), 1):
        if not line or line.startswith('#'):
            continue
        cells = line.split('\t')
        if len(cells) not in (2, 3):
            raise SystemExit(f'{table}:{number}: expected two or three columns, found {len(cells)}')
        prefixes = tuple(p.strip() for p in cells[2].split(',')) if len(cells) == 3 else ()
        for form in cells[0].split(','):
            found[form.strip()] = (cells[1], prefixes)
    return found


def sources(root):
    """Every text file of the project below root, as (path, path relative to root)."""
    for path in sorted(root.rglob('*')):
        relative = path.relative_to(root).as_posix()
        if relative.startswith(LEFT_OUT) or any(part.startswith('.') for part in path.relative_to(root).parts):
            continue
        if (path.suffix in ENDINGS or path.name in NAMES) and path.is_file():
            yield path, relative


def places(root, table):
    """Yields (file, line, form, what to write instead)."""
    instead = rules(table)
    for path, relative in sources(root):
        for number, line in enumerate(path.read_text(encoding='utf-8').splitlines(), 1):
            words = [word.lower() for word in WORD.findall(line)]
            for start in range(len(words)):
                for length in range(1, LONGEST_PHRASE + 1):
                    form = ' '.join(words[start:start + length])
                    if form in instead and len(words) >= start + length:
                        replacement, prefixes = instead[form]
                        if not (prefixes and relative.startswith(prefixes)):
                            yield relative, number, form, replacement


def main(arguments):
    count = '--count' in arguments
    rest = [a for a in arguments if a != '--count']
    here = pathlib.Path(__file__).resolve().parent
    root = pathlib.Path(rest[0]) if rest else here.parent.parent
    found = list(places(root, here / 'words.tsv'))
    if count:
        for form, n in collections.Counter(form for _, _, form, _ in found).most_common():
            print(f'{n:6} {form}')
        print(f'{len(found):6} in {len({(f, l) for f, l, _, _ in found})} lines')
    else:
        for file, number, form, replacement in found:
            print(f'{file}:{number}: {form}: use {replacement}')
    return 1 if found else 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
