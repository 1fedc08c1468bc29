#!/usr/bin/env python3
"""Sums gcovr's JSON by folder.

    folders.py FILE LINES BRANCHES [--uncovered]

Prints a table, and with --uncovered the lines that no test ran. Exit 0 where the library and the
readers reach LINES and BRANCHES per cent each, else 1.

Branches that only an exception takes do not count. A line of the library's templates has a copy of
its branches for every instance and every place where it was inlined, hundreds of them, of which
many can be taken in one direction only: there a line counts once for going on and once for
jumping, run where one of the copies did it. A line of the readers counts every branch.
"""
import collections
import json
import os
import sys

SOURCES = {'library': ('include/', 'kernels/', 'src/'), 'readers': ('tools/',)}
# Runs evaluators of others in a process of their own, which ends without writing its counts.
NO_READER = ('tools/evaluator/evaluator_process.',)


def branches_of(line, folded):
    """Whether each of the line's branches was taken."""
    branches = [branch for branch in line['branches'] if not branch.get('throw')]
    if not folded:
        return [branch['count'] > 0 for branch in branches]
    ways = collections.defaultdict(bool)
    for branch in branches:
        ways[branch['fallthrough']] |= branch['count'] > 0
    return list(ways.values())


def counts_of(file):
    lines = [line for line in file['lines'] if not line.get('gcovr/noncode')]
    folded = file['file'].startswith(SOURCES['library'])
    branches = [taken for line in lines for taken in branches_of(line, folded)]
    return sum(line['count'] > 0 for line in lines), len(lines), sum(branches), len(branches)


def add(total, counts):
    return tuple(map(sum, zip(total, counts)))


def row(name, counts):
    run_lines, lines, run_branches, branches = counts
    return (f'{name:24}{run_lines:8} of {lines:6} lines {100 * run_lines / max(lines, 1):6.1f} %'
            f'{run_branches:8} of {branches:6} branches '
            f'{100 * run_branches / max(branches, 1):6.1f} %')


def ranges(numbers):
    text, first = [], None
    for number, following in zip(numbers, numbers[1:] + [None]):
        first = number if first is None else first
        if following != number + 1:
            text.append(str(first) if first == number else f'{first}-{number}')
            first = None
    return ', '.join(text)


def main():
    path, line_goal, branch_goal = sys.argv[1], float(sys.argv[2]), float(sys.argv[3])
    with open(path, encoding='utf-8') as stream:
        files = json.load(stream)['files']
    folders = collections.defaultdict(lambda: (0, 0, 0, 0))
    parts = collections.defaultdict(lambda: (0, 0, 0, 0))
    for file in files:
        counts = counts_of(file)
        name = os.path.dirname(file['file']) + '/'
        folders[name] = add(folders[name], counts)
        for part, prefixes in SOURCES.items():
            if file['file'].startswith(prefixes) and not file['file'].startswith(NO_READER):
                parts[part] = add(parts[part], counts)
    for name in sorted(folders):
        print(row(name, folders[name]))
    reached = True
    for part, counts in parts.items():
        print(row(part, counts))
        reached &= counts[0] >= line_goal / 100 * counts[1]
        reached &= counts[2] >= branch_goal / 100 * counts[3]
    if '--uncovered' in sys.argv:
        for file in files:
            missed = sorted({line['line_number'] for line in file['lines']
                             if line['count'] == 0 and not line.get('gcovr/noncode')})
            if missed:
                print(f"{file['file']}:{ranges(missed)}")
    return 0 if reached else 1


if __name__ == '__main__':
    sys.exit(main())
