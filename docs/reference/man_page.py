#!/usr/bin/env python3
"""Makes the man page from the program's own --help.

    man_page.py PROGRAM > docs/simdbezier.1      writes it
    man_page.py PROGRAM --check docs/simdbezier.1   exit 1 where the file says something else
"""
import re
import subprocess
import sys

COMMANDS = ('tessellate', 'evaluate', 'info', 'convert', 'plan', 'join')


def help_of(program, *command):
    return subprocess.run([program, *command, '--help'], check=True, text=True,
                          stdout=subprocess.PIPE).stdout


def roff(text):
    text = text.replace('\\', '\\e').replace('-', '\\-')
    return re.sub(r"(?m)^(?=[.'])", '\\\\&', text)


def section(text, title):
    """The lines under `title:`, up to the next empty line."""
    found = re.search(rf'(?m)^{title}:\n((?:  .*\n)+)', text)
    return found.group(1) if found else ''


def terms(lines):
    """Pairs of a term and what it means: meanings begin in column 24 or on a line of their own."""
    pairs = []
    for line in lines.splitlines():
        if line.startswith(' ' * 24):
            pairs[-1][1].append(line.strip())
        else:
            term, meaning = line[2:24].rstrip(), line[24:].strip()
            if len(line) > 24 and line[22:24] != '  ':
                term, meaning = line.strip(), ''
            pairs.append((term, [meaning] if meaning else []))
    return pairs


def listed(lines):
    return ''.join(f'.TP\n.B {roff(term)}\n{roff(" ".join(meaning))}\n'
                   for term, meaning in terms(lines))


def page(program):
    version = subprocess.run([program, '--version'], check=True, text=True,
                             stdout=subprocess.PIPE).stdout.split()[-1]
    whole = help_of(program)
    text = f'.TH SIMDBEZIER 1 "" "simdbezier {version}" "User Commands"\n'
    text += '.SH NAME\nsimdbezier \\- evaluates and tessellates Bézier patches\n.SH SYNOPSIS\n'
    helps = {command: help_of(program, command) for command in COMMANDS}
    for command, help_text in helps.items():
        usage = re.match(r'usage: simdbezier \S+ (.*)', help_text).group(1)
        text += f'.B simdbezier {command}\n{roff(usage)}\n.br\n'
    text += '.SH DESCRIPTION\n' + roff(
        'Bézier patches of degrees 1 to 15, with or without weights, are read from a file and '
        'evaluated at many parameters in one call, with published error bounds, watertight edges '
        'and bits that do not depend on threads or machine.') + '\n'
    for command, help_text in helps.items():
        purpose = help_text.split('\n\n')[1]
        text += f'.SS {command}\n{roff(purpose)}\n' + listed(section(help_text, 'Options'))
    text += '.SH EXAMPLES\n.nf\n'
    for help_text in helps.values():
        text += roff(''.join(line[2:] + '\n' for line in section(help_text, 'Examples').splitlines()))
    text += '.fi\n'
    exit_codes = re.search(r'Exit codes: (.*)', whole).group(1)
    text += f'.SH "EXIT STATUS"\n{roff(exit_codes)}\n'
    environment = whole[whole.index('SIMDBEZIER_ISA='):]
    text += f'.SH ENVIRONMENT\n{roff(environment)}'
    return text


def main():
    program = sys.argv[1]
    text = page(program)
    if len(sys.argv) == 2:
        sys.stdout.write(text)
    elif open(sys.argv[3], encoding='utf-8').read() != text:
        sys.exit(f'{sys.argv[3]} is not what the program says of itself: write it anew with '
                 f'docs/reference/man_page.py')


if __name__ == '__main__':
    main()
