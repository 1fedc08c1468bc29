#!/usr/bin/env python3
"""Writes the C++ and C of documents into files that can be compiled.

    extract_code.py OUT DOCUMENT…

Prints the names of the files, separated by semicolons. A block ```cpp with a main() becomes
NAME_K.cpp, a program as it stands there, and one of ```c NAME_K.c. All other blocks of C++ become
NAME_fragments.cpp: its main() runs them one after the other, each in a scope of its own behind what
prelude.hpp declares.
"""
import pathlib
import re
import sys


def write(path, text):
    """Only where it differs, so that nothing is compiled in vain."""
    if not path.exists() or path.read_text() != text:
        path.write_text(text)
    return path.name


def main():
    out = pathlib.Path(sys.argv[1])
    out.mkdir(parents=True, exist_ok=True)
    names = []
    for argument in sys.argv[2:]:
        document = pathlib.Path(argument)
        name = document.stem.lower()
        fragments = ''
        for number, (language, code) in enumerate(re.findall(r'^```(cpp|c\+\+|c)\n(.*?)^```$',
                                                             document.read_text(), re.M | re.S)):
            if 'int main(' in code:
                ending = 'c' if language == 'c' else 'cpp'
                names.append(write(out / f'{name}_{number}.{ending}', code))
            elif language != 'c':
                fragments += f'  if (const int failed = [&]() -> int {{\n{code}return 0; }}(); failed) {{\n' \
                             f'    return failed;\n  }}\n'
        if fragments:
            text = '#include "tests/consumers/docs/prelude.hpp"\n\nint main() {\n' \
                   '  SIMDBEZIER_DOCS_PRELUDE\n' + fragments + '  return 0;\n}\n'
            names.append(write(out / f'{name}_fragments.cpp', text))
    print(';'.join(names), end='')


if __name__ == '__main__':
    main()
