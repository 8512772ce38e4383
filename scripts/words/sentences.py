#!/usr/bin/env python3
"""sentences.py FILE...: words a sentence, and subordinate words a sentence, of Markdown pages.

Counts prose alone: no code, tables, headings, links' addresses or pictures. A sentence has three words or
more. Subordinate words open a clause inside a sentence: that, which, who, what, where, when, if, ...
"""

import re
import sys

SUBORDINATE = set('''that which who whom whose what whatever where wherever when whenever while whether how why
if unless until because since although though before after once so'''.split())


def prose(text):
    text = re.sub(r'^```.*?^```', ' ', text, flags=re.S | re.M)
    text = re.sub(r'<!--.*?-->', ' ', text, flags=re.S)
    text = re.sub(r'\$\$.*?\$\$', ' ', text, flags=re.S)
    lines = []
    for line in text.splitlines():
        if re.match(r'\s*(\||#|!\[|<)', line):
            lines.append('\n.\n')
        elif re.match(r'\s*([-*]|\d+\.)\s', line):
            lines.append('\n.\n' + re.sub(r'^\s*([-*]|\d+\.)\s', '', line))
        elif not line.strip():
            lines.append('\n.\n')
        else:
            lines.append(line)
    text = '\n'.join(lines)
    text = re.sub(r'!\[[^\]]*\]\([^)]*\)', ' ', text)
    text = re.sub(r'\[([^\]]*)\]\([^)]*\)', r'\1', text)
    text = re.sub(r'`[^`]*`', 'code', text)
    return re.sub(r'(?<=\d)\.(?=\d)|(?<!\w)\.(?=\d)', ',', text)


def sentences(text):
    for sentence in re.split(r'[.!?]+(?=\s|$)|\n\.\n', prose(text)):
        words = re.findall(r"[A-Za-zÀ-ž][\w'’-]*", sentence)
        if len(words) >= 3:
            yield [word.lower() for word in words]


def main(files):
    total = [0, 0, 0]
    for file in files:
        with open(file, encoding='utf-8') as page:
            found = list(sentences(page.read()))
        row = [len(found), sum(map(len, found)), sum(word in SUBORDINATE for s in found for word in s)]
        total = [a + b for a, b in zip(total, row)]
        show(file, row)
    if len(files) > 1:
        show('all', total)


def show(name, row):
    count = max(row[0], 1)
    print(f'{name}: {row[0]} sentences, {row[1] / count:.1f} words a sentence, '
          f'{row[2] / count:.2f} subordinate words a sentence')


if __name__ == '__main__':
    main(sys.argv[1:])
