#!/usr/bin/env python3
"""Runs every command line of README.md that begins with build/simdbezier, as it stands there.

    readme_commands.py SOURCE PROGRAM SCRATCH

In a scratch folder with the files that they name. Each has to succeed, without a word on stderr, and
leave the file that it promises.
"""
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

source, program, scratch = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
text = (source / 'README.md').read_text().replace('\\\n', ' ')
lines = [line.split(' # ')[0] for line in re.findall(r'^    build/simdbezier .*$', text, re.M)]
if len(lines) < 5:
    sys.exit(f'README.md has only {len(lines)} command lines of the program')

shutil.rmtree(scratch, ignore_errors=True)
scratch.mkdir(parents=True)
shutil.copytree(source / 'examples' / 'data', scratch / 'examples' / 'data')
failed = 0
for line in lines:
    words = shlex.split(line)
    done = subprocess.run([program, *words[1:]], cwd=scratch, text=True, check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    outputs = [scratch / words[k + 1] for k, word in enumerate(words[:-1]) if word == '-o']
    missing = [path.name for path in outputs if not path.exists() or path.stat().st_size == 0]
    if done.returncode != 0 or done.stderr or missing or not (outputs or done.stdout):
        failed += 1
        print(f'{line.strip()}\n  exit {done.returncode}, missing {missing}\n  {done.stderr}')
sys.exit(1 if failed else 0)
