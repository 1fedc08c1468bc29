#!/usr/bin/env python3
"""The page of bench/report.py is whole: HTML whose elements close, figures that are XML, every row's
name, nothing from elsewhere. Where a browser is installed it opens the page, too.

    check_report.py SOURCE SCRATCH
"""
import html.parser
import json
import pathlib
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree

VOID = {'meta', 'br'}


class Balance(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.open = []

    def handle_starttag(self, tag, attrs):
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        pass

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            sys.exit(f'</{tag}> closes nothing')


def accuracy_row(isa, max_u, ratio):
    return {'family': 'wave', 'deg': [3, 3], 'type': 'f32', 'isa': isa, 'qty': 'P', 'n': 10,
            'max_u': max_u, 'max_ratio': ratio, 'worst': {'net': 7, 'x': '0x1p-1', 'y': '0x1p-2'}}


def main():
    source, scratch = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
    scratch.mkdir(parents=True, exist_ok=True)
    measured = scratch / 'accuracy.json'
    measured.write_text(json.dumps({'failures': ['mine <b>fails</b>'], 'rows': [
        accuracy_row('avx2', 3.25, 0.15), accuracy_row('mine', 40.5, 1.93),
        accuracy_row('infinite', 'infinite', 'infinite')]}))
    page = scratch / 'report.html'
    speed = sorted((source / 'bench' / 'results').glob('*.json'))
    program = [sys.executable, '-B', source / 'bench' / 'report.py']
    subprocess.run([*program, '-o', page, '--speed', *speed, '--accuracy', measured], check=True)
    text = page.read_text(encoding='utf-8')
    balance = Balance()
    balance.feed(text)
    if balance.open:
        sys.exit(f'not closed: {balance.open}')
    figures = re.findall(r'<svg.*?</svg>', text, re.S)
    for figure in figures:
        xml.etree.ElementTree.fromstring(figure)
    expected = ['autovectorised', 'de_casteljau', '16x16', 'limits', 'mine', '40.5', 'wave 7',
                '<span class="over">1.930</span>', '&lt;b&gt;fails']
    missing = [word for word in expected if word not in text]
    if missing or len(figures) < 10:
        sys.exit(f'missing: {missing}; {len(figures)} figures')
    if re.search(r'(?:src|href)=|https?:', text):
        sys.exit('the page loads something from elsewhere')

    refused = subprocess.run([*program, '-o', page, '--accuracy', source / 'README.md'],
                             stderr=subprocess.PIPE, text=True, check=False)
    if refused.returncode != 1 or not refused.stderr.startswith('report.py: '):
        sys.exit(f'of a file that is no result: {refused.returncode}, {refused.stderr}')

    browser = next(filter(None, map(shutil.which, ('chromium', 'chromium-browser'))), None)
    if browser:
        seen = subprocess.run([browser, '--headless', '--no-sandbox', '--disable-gpu',
                               f'--user-data-dir={scratch / "browser"}', '--dump-dom',
                               page.as_uri()], text=True, check=True, timeout=120,
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout
        if seen.count('<svg') != len(figures) or 'wave 7' not in seen:
            sys.exit('the browser shows something else')


if __name__ == '__main__':
    main()
