#!/usr/bin/env python3
"""commands.py PROGRAM [root]: finds commands, options, targets and files in the pages that do not exist.

Prints one line per place, `file:line: text: what is missing`, and exits with 1 if there are any. Checked are
the verbs and options of `touchdown`, the targets of `make`, and the paths of files of the project. Names
with "mine", "my_" or "your" are the reader's own.
"""

import functools
import pathlib
import re
import subprocess
import sys

from pages import blocks, shell_lines, spans

OWN = re.compile(r'mine|my_|your|MODEL|\*|…|<|\bx\.')
PATH = re.compile(r'(?<![\w./:$~-])((?:[a-z_]+/)+[\w.-]+\.(?:cpp|hpp|h|c|py|sh|yaml|npz|xml|cmake|csv))(?![\w/])')
MADE = ('build/', 'tables/', 'figures/', 'state/', 'logs/', 'runs/', 'scenes/', 'signals/', 'videos/', 'models/*', 'name/')


@functools.cache
def verbs_of(program):
    """The program's verbs."""
    text = subprocess.run([program, '--help'], capture_output=True, text=True, check=True).stdout
    return set(re.findall(r'^  ([a-z]+)  +touchdown ', text, re.M))


@functools.cache
def options_of(program, verb):
    """The options of a verb; None if they are another program's, such as the trainer's, which is not built."""
    done = subprocess.run([program, verb, '--help'], capture_output=True, text=True, check=False)
    if f'Usage: touchdown {verb} ' not in done.stdout:
        return None
    return set(re.findall(r'(?<![\w-])(--?[a-z][\w-]*)', done.stdout.partition('Usage:')[2]))


def faults_of_command(program, line):
    """Yields (text, what is missing) for each call of the program in a line of shell."""
    line = re.sub(r"'[^']*'|\"[^\"]*\"", 'quoted', line).split(' #')[0]
    for call in re.findall(r'(?:^|[\s/])touchdown ((?!-)[a-z]+(?: [^|>#;&]*)?)', line):
        words = call.split()
        verb = words[0]
        if verb not in verbs_of(program):
            yield verb, 'no such command'
            continue
        options = options_of(program, verb)
        if options is None:
            continue
        for word in words[1:]:
            name = word.split('=')[0]
            if re.fullmatch(r'--[a-z][\w-]*|-[a-z]', name) and name not in options:
                yield f'{verb} {name}', 'no such option'


def targets_of(makefile):
    return set(re.findall(r'^([a-z][a-z-]*):', makefile, re.M))


def faults_of_page(root, program, targets, text):
    """Yields (line, text, what is missing) of a page."""
    code = list(shell_lines(text)) + [(number, span) for number, span in spans(text)
                                      if re.match(r'(build/release/)?touchdown [a-z]|make [a-z]', span)]
    for number, line in code:
        for fault in faults_of_command(program, line):
            yield number, *fault
        for target in re.findall(r'(?:^|`)make ([a-z][a-z-]*)\b', line):
            if target not in targets:
                yield number, f'make {target}', 'no such target'
    places = [(number, span) for number, span in spans(text)]
    places += [(first + i, line) for first, _, block in blocks(text) for i, line in enumerate(block.split('\n'))]
    for number, place in places:
        for path in PATH.findall(place):
            known = (root / path.split('/')[0]).is_dir() and not path.startswith(MADE)
            if known and not OWN.search(path) and not (root / path).exists():
                yield number, path, 'no such file'


def main(program, root):
    targets = targets_of((root / 'Makefile').read_text(encoding='utf-8'))
    found = 0
    for page in [*sorted((root / 'docs').rglob('*.md')), root / 'README.md', root / 'CONTRIBUTING.md']:
        if not page.exists():
            continue
        for number, text, what in sorted(set(faults_of_page(root, program, targets, page.read_text(encoding='utf-8')))):
            print(f'{page.relative_to(root)}:{number}: {text}: {what}')
            found += 1
    return 1 if found else 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1], pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else pathlib.Path(__file__).parents[2])))
