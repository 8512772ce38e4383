"""What stands in the Markdown pages: blocks of code, commands, names of files."""

import re


def blocks(text):
    """Yields (line number of the first line, language, text) of every fenced block of code."""
    lines = text.split('\n')
    start = None
    for number, line in enumerate(lines, 1):
        fence = re.match(r'```(\w*)', line)
        if fence and start is None:
            start, language = number, fence[1]
        elif fence:
            yield start + 1, language, '\n'.join(lines[start:number - 1]) + '\n'
            start = None


def lines_outside_blocks(text):
    """Yields (line number, text) of every line outside blocks of code."""
    in_block = False
    for number, line in enumerate(text.split('\n'), 1):
        if re.match(r'\s*(```|~~~)', line):
            in_block = not in_block
        elif not in_block:
            yield number, line


def spans(text):
    """Yields (line number, text) of every span of code outside blocks."""
    for number, line in lines_outside_blocks(text):
        for code in re.findall(r'`([^`]+)`', line):
            yield number, code


def shell_lines(text):
    """Yields (line number, command) of every command line in blocks without a language, of sh and of bash."""
    for first, language, code in blocks(text):
        if language not in ('', 'sh', 'bash'):
            continue
        joined = code.replace('\\\n', '  ')
        for offset, line in enumerate(joined.split('\n')):
            if line.strip():
                yield first + offset, line.strip()
