#!/usr/bin/env python3
"""links.py [root]: finds links and names of pages that do not exist.

Prints one line per place, `file:line: target: what is missing`, and exits with 1 if there are any. Checked are
the links of every Markdown page, with their anchors, and every `docs/….md` in other text files.
"""

import os
import pathlib
import re
import sys
import unicodedata

from pages import lines_outside_blocks

ENDINGS = {'.cpp', '.hpp', '.h', '.c', '.py', '.yaml', '.yml', '.txt', '.sh', '.cmake', '.in', '.toml', '.cff', '.md'}
LEFT_OUT = ('build', 'runs', 'tests/documents', 'tests/words', 'tests/fuzz')
LINK = re.compile(r'\]\(([^)\s]+)\)')
MENTION = re.compile(r'(?<![\w./-])docs/[\w/]+\.md')


def files_of(root):
    """Every text file of the project, relative to root."""
    for folder, folders, names in os.walk(root):
        place = pathlib.Path(folder).relative_to(root)
        folders[:] = sorted(f for f in folders if not f.startswith('.') and (place / f).as_posix() not in LEFT_OUT)
        for name in sorted(names):
            if pathlib.Path(name).suffix in ENDINGS:
                yield place / name


def anchor_of(heading):
    """The anchor that GitHub gives a heading."""
    text = re.sub(r'\[([^\]]*)\]\([^)]*\)', r'\1', heading).replace('`', '')
    kept = [c for c in text.strip().lower() if c in ' -_' or unicodedata.category(c)[0] in 'LN'
            or unicodedata.category(c) in ('Mn', 'Mc')]
    return ''.join(kept).replace(' ', '-')


def anchors_of(text):
    """The anchors of a page; a repeated heading has a number."""
    found = {}
    for _, line in lines_outside_blocks(text):
        if heading := re.match(r'#{1,6} +(.*?)(?: +#+)? *$', line):
            name = anchor_of(heading[1])
            found[name] = found.get(name, -1) + 1
    return {name if i == 0 else f'{name}-{i}' for name, times in found.items() for i in range(times + 1)}


def missing_targets(root, page, text):
    """Yields (line, target, what is missing) for the links of a page."""
    for number, line in lines_outside_blocks(text):
        for target in LINK.findall(re.sub(r'`[^`]*`', ' ', line)):
            if re.match(r'[a-z]+:', target):
                continue
            path, _, anchor = target.partition('#')
            file = root / (page.parent / path if path else page)
            if not file.exists():
                yield number, target, 'no such file'
            elif anchor and file.suffix == '.md' and anchor not in anchors_of(file.read_text(encoding='utf-8')):
                yield number, target, 'no such heading'


def missing_pages(root, text):
    """Yields (line, page, what is missing) for names of pages."""
    for number, line in enumerate(text.splitlines(), 1):
        for page in MENTION.findall(line):
            if not (root / page).exists():
                yield number, page, 'no such file'


def main(root):
    found = 0
    for file in files_of(root):
        text = (root / file).read_text(encoding='utf-8')
        places = list(missing_pages(root, text))
        if file.suffix == '.md':
            places += missing_targets(root, file, text)
        for number, target, what in sorted(set(places)):
            print(f'{file.as_posix()}:{number}: {target}: {what}')
            found += 1
    return 1 if found else 0


if __name__ == '__main__':
    sys.exit(main(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parents[2])))
