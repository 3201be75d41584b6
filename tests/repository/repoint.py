#!/usr/bin/env python3
"""Points links to lines at the lines where the named thing stands now.

  repoint.py DOCUMENT...

A link [`Class::name`](path#L12) whose line 12 has no `name` any more gets the line of `path` that
looks like its definition, else the nearest that has it. What changed is printed: look at it. The
test References (reference_test.cpp) fails where a link is wrong.
"""
import os
import re
import sys


def new_line(text, path, line):
    """The line to point to, or None where the file or the name is gone."""
    names = re.findall(r'[A-Za-z_]\w*', text)
    if not names or not os.path.exists(path):
        return None
    lines = open(path).read().split('\n')
    word = re.compile(r'\b' + names[-1] + r'\b')
    if 0 < line <= len(lines) and word.search(lines[line - 1]):
        return line
    found = [k + 1 for k, text in enumerate(lines) if word.search(text.split('//')[0])]
    # A definition: a name with a type before it that is not a call, at the left or in a class.
    defines = re.compile(r'^( {4})?(?!return\b)\w[\w:<>,*& ]*[ *&:]' + names[-1] + r'\b *[({;]|' +
                         r'\b(class|struct) ' + names[-1] + r'\b(?!;)')
    good = [k for k in found if defines.search(lines[k - 1])] or found
    return min(good, key=lambda k: abs(k - line)) if good else None


def main():
    for document in sys.argv[1:]:
        folder = os.path.dirname(document)

        def pointed(match):
            text, path, line = match[1], match[2], int(match[3])
            new = new_line(text, os.path.join(folder, path), line)
            if new is None:
                print(f'{document}: {text}: not found in {path}')
                return match[0]
            if new != line:
                print(f'{document}: {text}: {path} line {line} -> {new}')
            return f'[{text}]({path}#L{new})'

        old = open(document).read()
        text = re.sub(r'\[([^\]]*)\]\(([^)#]*)#L(\d+)\)', pointed, old)
        if text != old:
            open(document, 'w').write(text)


main()
