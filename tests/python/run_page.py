"""Runs the Python of a page as it stands there: run_page.py PAGE.md"""
import pathlib
import re
import sys

blocks = re.findall(r'^```python\n(.*?)^```', pathlib.Path(sys.argv[1]).read_text(), re.M | re.S)
if not blocks:
    sys.exit(f'{sys.argv[1]} has no Python')
for block in blocks:
    exec(compile(block, sys.argv[1], 'exec'), {})
