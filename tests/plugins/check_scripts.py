#!/usr/bin/env python3
"""Other people's evaluators in what reads benchmarks: measure.py, ratios.py, report.py, plots.py.

    check_scripts.py SOURCE BENCH FOLDER

FOLDER holds the plug-ins, and receives what the scripts write.
"""
import importlib.util
import json
import pathlib
import subprocess
import sys

SOURCE, BENCH, FOLDER = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
PLUGINS = [f'--evaluator={FOLDER / name}.so' for name in ('de_casteljau', 'shader_horner')]
ROW = 'grid/position/f32/%s/8x8/cache/threads:1'


def run(code, script, *arguments):
    """What a script prints; its exit code has to be `code`."""
    done = subprocess.run([sys.executable, '-B', SOURCE / 'bench' / script, *arguments], text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    if done.returncode != code:
        sys.exit(f'{script}: expected exit code {code}, found {done.returncode}: {done.stdout}')
    return done.stdout


def expect(text, *words):
    missing = [word for word in words if word not in text]
    if missing:
        sys.exit(f'expected {missing} in\n{text}')


def check_measured():
    results = FOLDER / 'measured.json'
    part = f'^{ROW % "(scalar|avx2|neon64|my_de_casteljau|shader_horner)"}(/layout:aos)?$'
    run(0, 'measure.py', '--rounds=1', f'--filter={part}', *PLUGINS, BENCH, results)
    kept = json.loads(results.read_text(encoding='utf-8'))
    expect(kept['context']['evaluators'], 'my_de_casteljau', 'shader_horner')
    expect(kept['rows']['grid/position/f32'], 'shader_horner/8x8/cache/threads:1',
           'my_de_casteljau/8x8/cache/threads:1/layout:aos')
    expect(run(1, 'measure.py', '--filter=nothing', BENCH, results),
           "--filter: no published row's name matches 'nothing'")
    expect(run(1, 'measure.py', f'--evaluator={FOLDER}/missing.so', BENCH, results), 'missing.so')


def check_refused():
    """What cannot be measured or read is said in one line, and results from before stay."""
    results = FOLDER / 'measured.json'
    before = results.read_bytes()
    for arguments, words in ((('--rounds=0', BENCH, results), '--rounds: expected 1 or more'),
                             (('--core=9999', BENCH, results), '--core: this process may not'),
                             ((BENCH, FOLDER / 'missing' / 'results.json'), 'expected a folder')):
        expect(run(1, 'measure.py', *arguments), words)
    if results.read_bytes() != before:
        sys.exit('measure.py: a run without results has changed a file')
    listed = FOLDER / 'list.json'
    listed.write_text('[]', encoding='utf-8')
    found = run(1, 'report.py', '-o', FOLDER / 'report.html', '--speed', listed)
    if not found.startswith('report.py: ') or found.count('\n') != 1:
        sys.exit(f'report.py: expected one line, found {found}')


def made_up():
    """Rows whose ratios are known, as measure.py writes them."""
    rows = {'grid/position/f32': {}, 'limit/fma/f32': {'avx2': [400000, 1, 3]}}
    for who, layout, rate in (('avx2', '', 4000), ('scalar', '', 500), ('mine', '', 1000),
                              ('autovectorised', '', 2000), ('avx2', '/layout:aos', 3000),
                              ('de_casteljau', '', 100), ('mine', '/layout:aos', 1500)):
        rows['grid/position/f32'][f'{who}/16x16/cache/threads:1{layout}'] = [rate, 1, 3]
    path = FOLDER / 'made_up.json'
    path.write_text(json.dumps({'context': {'evaluators': 'mine'}, 'rows': rows}), encoding='utf-8')
    return path


def check_drawn():
    path = made_up()
    lines = [line.split() for line in run(0, 'ratios.py', path, '/mine/').splitlines()]
    found = {line[0]: line[-2:] for line in lines if line and 'mine' in line[0]}
    name = ROW.replace('8x8', '16x16') % 'mine'
    if found != {name: ['0.25x', '0.50x'], f'{name}/layout:aos': ['0.50x', '15.00x']}:
        sys.exit(f'ratios.py: {lines}')
    expect(run(1, 'ratios.py', path, 'nothing'), "no row's name matches 'nothing'")
    run(0, 'report.py', '-o', FOLDER / 'report.html', '--speed', path)
    expect((FOLDER / 'report.html').read_text(encoding='utf-8'), 'x y z triples', '>mine<')
    if importlib.util.find_spec('matplotlib'):
        run(0, 'plots.py', path, path, FOLDER)
        for plot in ('speed_by_size.svg', 'roofline.svg'):
            expect((FOLDER / plot).read_text(encoding='utf-8'), '>mine<')


check_measured()
check_refused()
check_drawn()
