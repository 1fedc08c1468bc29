#!/usr/bin/env python3
"""One page of HTML from results: speed, accuracy, or both.

    report.py -o report.html [--speed RUN.json…] [--accuracy ACCURACY.json]

RUN.json: a run of simdbezier_bench with --benchmark_format=json, or a file of measure.py.
ACCURACY.json: what simdbezier_accuracy writes with --json. The page has no other file: its figures are
SVG, and nothing is loaded from anywhere. Evaluators of plug-ins stand beside the library and its
baselines, by their names.
"""
import argparse
import collections
import html
import json
import math
import pathlib
import sys

sys.dont_write_bytecode = True
import results  # pylint: disable=wrong-import-position

STYLE = """body{font:15px/1.45 sans-serif;max-width:62em;margin:2em auto;padding:0 1em;color:#222}
table{border-collapse:collapse;margin:.6em 0}td,th{padding:.15em .7em;text-align:right;
border-bottom:1px solid #ddd}td:first-child,th:first-child{text-align:left}
svg{display:block;margin:.4em 0 1.4em}.over{color:#b00020;font-weight:bold}"""
COLOURS = ('#1f6f8b', '#99a8b2', '#e07a5f', '#81b29a', '#f2cc8f', '#6d597a', '#3d405b')
WIDTH, LABEL, BAR = 900, 230, 16


def text(value):
    return html.escape(str(value))


def bars(groups, unit):
    """groups: (title, [(label, value, colour)]). Horizontal bars on one common scale, as SVG."""
    longest = max((value for _, rows in groups for _, value, _ in rows if math.isfinite(value)),
                  default=0) or 1
    parts, y = [], 0
    for title, rows in groups:
        y += 22
        parts.append(f'<text x="0" y="{y}" font-weight="bold">{text(title)}</text>')
        y += 6
        for label, value, colour in rows:
            length = (WIDTH - LABEL - 110) * (value / longest if math.isfinite(value) else 1)
            parts.append(f'<text x="{LABEL - 8}" y="{y + 12}" text-anchor="end">{text(label)}</text>'
                         f'<rect x="{LABEL}" y="{y + 2}" width="{length:.1f}" height="{BAR - 4}" '
                         f'fill="{colour}"/><text x="{LABEL + length + 6:.1f}" y="{y + 12}">'
                         f'{value:.3g} {text(unit)}</text>')
            y += BAR
    return (f'<svg width="{WIDTH}" height="{y + 6}" viewBox="0 0 {WIDTH} {y + 6}" font-size="12" '
            f'font-family="sans-serif" role="img">{"".join(parts)}</svg>')


def table(head, rows):
    cells = ''.join(f'<th>{text(cell)}</th>' for cell in head)
    body = ''.join('<tr>' + ''.join(f'<td>{cell}</td>' for cell in row) + '</tr>' for row in rows)
    return f'<table><tr>{cells}</tr>{body}</table>'


class Colours:
    """The same colour for the same name, in order of appearance."""

    def __init__(self):
        self.names = {}

    def of(self, name):
        return COLOURS[self.names.setdefault(name, len(self.names)) % len(COLOURS)]


def speed(path, colours):
    context, rows = results.read(path)
    said = f'<h2>Speed: {text(context.get("cpu", path.name))}</h2>'
    said += table(('', ''), [(text(key), text(context[key])) for key in
                             ('date', 'cpu', 'cores', 'compiler', 'flags', 'isas') if key in context])
    limits, families = [], collections.defaultdict(lambda: collections.defaultdict(list))
    # Triples are shown where a plug-in writes them.
    layouts = ({}, {'layout': 'aos'}) if results.evaluators(context) else ({},)
    for name in sorted(rows, key=results.natural_order):
        if name.startswith('limit/'):
            limits.append((name[6:], rows[name].median / 1e9, colours.of('limit')))
            continue
        row = results.Name(name)
        if row.threads == 1 and row.keys in layouts:
            family = ', '.join((row.call, row.outputs, row.type, row.place,
                                *(['x y z triples'] if row.keys else [])))
            families[family][row.size].append((row.who, rows[name].median / 1e9, colours.of(row.who)))
    for family, sizes in families.items():
        said += f'<h3>{text(family)}</h3>' + bars(list(sizes.items()), '10⁹/s')
    if limits:
        said += '<h3>What the machine can do</h3>' + bars([('limits', limits)], '10⁹/s')
    return said


def number(value):
    """Errors that are infinite or nan are words in the file."""
    return float({'infinite': 'inf'}.get(value, value)) if value is not None else None


def accuracy(path, colours):
    report = json.loads(path.read_text(encoding='utf-8'))
    rows = report['rows']
    said = f'<h2>Accuracy</h2><p>{len(rows)} rows, {len(report.get("failures", []))} failures.</p>'
    for failure in report.get('failures', []):
        said += f'<p class="over">{text(failure)}</p>'
    worst = collections.defaultdict(dict)
    for row in rows:
        if row.get('max_u') is None:
            continue
        row['max_u'], row['max_ratio'] = number(row['max_u']), number(row.get('max_ratio'))
        key = (row['type'], row['qty'])
        best = worst[key].get(row['isa'])
        if best is None or not row['max_u'] <= best['max_u']:
            worst[key][row['isa']] = row
    for (kind, quantity), found in sorted(worst.items()):
        said += f'<h3>{text(quantity)}, {text(kind)}: the largest error, in roundings</h3>'
        said += bars([('', [(name, row['max_u'], colours.of(name))
                            for name, row in sorted(found.items())])], 'u')
        said += table(('evaluator', 'error, u', 'of its bound', 'net', 'degrees', 'at x, y'),
                      [line(name, row) for name, row in sorted(found.items())])
    return said


def line(name, row):
    ratio = row.get('max_ratio')
    over = ratio is not None and not ratio <= 1
    shown = '' if ratio is None else f'{ratio:.3f}'
    at = row.get('worst', {})
    degrees = '×'.join(map(str, row.get('deg', [])))
    return (text(name), f"{row['max_u']:.3g}", f'<span class="over">{shown}</span>' if over else shown,
            text(f"{row['family']} {at.get('net', '')}"), text(degrees),
            text(f"{at.get('x', '')}, {at.get('y', '')}"))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('-o', '--output', type=pathlib.Path, required=True)
    parser.add_argument('--speed', type=pathlib.Path, nargs='*', default=[])
    parser.add_argument('--accuracy', type=pathlib.Path)
    arguments = parser.parse_args()
    if not arguments.speed and not arguments.accuracy:
        parser.error('expected --speed or --accuracy')
    colours, body = Colours(), '<h1>Bézier patch evaluators</h1>'
    try:
        for path in arguments.speed:
            body += speed(path, colours)
        if arguments.accuracy:
            body += accuracy(arguments.accuracy, colours)
        arguments.output.write_text(
            '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
            f'<title>Bézier patch evaluators</title><style>{STYLE}</style></head><body>{body}</body>'
            '</html>\n', encoding='utf-8')
    except (AttributeError, OSError, ValueError, KeyError, TypeError) as error:
        sys.exit(f'report.py: {error!r}')


if __name__ == '__main__':
    main()
