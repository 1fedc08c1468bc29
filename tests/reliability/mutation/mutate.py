#!/usr/bin/env python3
"""Puts single mutations into a copy of the sources and sees whether the tests notice.

    tests/reliability/mutation/mutate.py N [--seed S] [--after K]   N random ones of shipped code
    tests/reliability/mutation/mutate.py --planted   the faults of planted.txt
    tests/reliability/mutation/mutate.py --check     the planted ones' places exist (no build)

The copy lies in build/mutate and is built without optimisation that takes long: first with the
scalar kernels alone, which most mutations do not survive, then with those vectors that this
machine has as well. A mutation that does not compile, or changes nothing in the library and the
program, is replaced by the next; a planted one of an instruction set that is not here is named.
A verdict begins with the mutation's number; --after K goes on behind number K of the same sources
and the same seed, because many mutations take hours.
Exit code: 0 where at least 19 of 20 were caught (all of the planted ones that change something),
else 1.
"""
import argparse
import difflib
import hashlib
import itertools
import json
import os
import pathlib
import random
import re
import resource
import shutil
import subprocess
import sys
import time

sys.dont_write_bytecode = True # the folder is a part of the sources
from mutators import Mutation, mutations_of # pylint: disable=wrong-import-position

ROOT = pathlib.Path(__file__).resolve().parents[3]
WORK = ROOT / 'build' / 'mutate'
SOURCE = WORK / 'source'
SHIPPED = ('include', 'kernels', 'src', 'tools')
NOT_COPIED = {'.git', 'build', 'out', '__pycache__'}
# Instruction sets beside the scalar one, and what the processor says of itself where it has them.
VECTORS = (('avx2', {'avx2', 'fma'}), ('avx512', {'avx512f', 'avx512bw', 'avx512dq', 'avx512vl'}))
MOST_MEMORY = 1 << 34
# Builds of their own, checks of Release builds only, and of how sources look.
NOT_JUDGES = r'^(same_bits_|installed_tree|packages|wheel|symbols_|mutation|format)|_NOT_BUILT$'
# Tests that are asked first where a file of a folder was changed.
NEAREST = (('tools/', r'^cli\.'), ('kernels/curve/', r'^curves\.'), ('kernels/nets/', r'^nets\.'),
           ('kernels/rates/', r'^mesh\.'), ('src/nets/', r'^nets\.'),
           ('kernels/shape/', r'^shapes\.'),
           ('kernels/derivative/', r'^derivatives\.'), ('kernels/pack/', r'^pack\.'),
           ('src/exact/', r'^(fallback|normals|limits)\.'))


def run(command, **options):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          check=False, **options)


def copy_sources():
    """Only files that differ, so that ninja builds only those."""
    for path in ROOT.rglob('*'):
        part = path.relative_to(ROOT)
        if NOT_COPIED.isdisjoint(part.parts) and path.is_file():
            copy_file(path, SOURCE / part)


def copy_file(path, copy):
    if not copy.exists() or copy.read_bytes() != path.read_bytes():
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path, copy)
        shutil.copymode(path, copy)


def digest_of(paths):
    digest = hashlib.sha256()
    for path in paths:
        digest.update(path.read_bytes())
    return digest.hexdigest()


def stages_here():
    """Names and instruction sets of the two builds; what the first cannot see the second may."""
    flags = set(re.findall(r'\w+', pathlib.Path('/proc/cpuinfo').read_text()))
    vectors = [name for name, needed in VECTORS if needed <= flags]
    return ('scalar', 'scalar'), ('vectors', ';'.join(['scalar', *vectors]))


class Stage:
    """One build of the copy, and the tests that pass in it when nothing is changed."""

    def __init__(self, name, isas):
        self.name = name
        self.folder = WORK / name
        launcher = ['-DCMAKE_CXX_COMPILER_LAUNCHER=ccache'] if shutil.which('ccache') else []
        data = os.environ.get('SIMDBEZIER_SHARED_DATA', '')
        log = run(['cmake', '-S', SOURCE, '-B', self.folder, '-G', 'Ninja',
                   '-DCMAKE_BUILD_TYPE=Release', '-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG',
                   '-DSIMDBEZIER_KERNEL_FLAGS=-O1', f'-DSIMDBEZIER_ISAS={isas}',
                   '-DSIMDBEZIER_BUILD_TESTS=ON', '-DSIMDBEZIER_BUILD_BENCH=OFF',
                   '-DCMAKE_LINK_DEPENDS_NO_SHARED=ON', # tests load the changed library as they are
                   f'-DSIMDBEZIER_SHARED_DATA={data}', *launcher])
        if log.returncode != 0:
            sys.exit(log.stdout)
        if not self.build():
            sys.exit(self.log)
        self.digest = self.binaries()
        self.seconds = self.baseline()

    def build(self):
        done = run(['cmake', '--build', self.folder], timeout=7200)
        self.log = done.stdout[-4000:]
        return done.returncode == 0

    def binaries(self):
        return digest_of(self.folder / name for name in ('libsimdbezier.so', 'simdbezier'))

    def baseline(self):
        """Seconds of each test that passes; those of the last run where nothing has changed since."""
        report = self.folder / 'baseline.xml'
        judged = self.folder / 'baseline.digest'
        sources = digest_of(path for path in sorted(SOURCE.rglob('*')) if path.is_file())
        if not judged.exists() or judged.read_text() != sources:
            run(['ctest', '--test-dir', self.folder, '-E', NOT_JUDGES, '--timeout', '600',
                 '--output-junit', report, '-j', str(os.cpu_count())])
            judged.write_text(sources)
        cases = re.findall(r'<testcase name="([^"]*)"[^>]*time="([^"]*)" status="(\w+)"',
                           report.read_text())
        failed = [name for name, _, status in cases if status == 'fail']
        for name in failed:
            print(f'{self.name}: {name} fails without a mutation and judges nothing')
        return {name: float(seconds) for name, seconds, status in cases if status == 'run'}

    def first_failure(self, path):
        """The name of a test that fails, or None; near and fast ones first."""
        near = next((pattern for prefix, pattern in NEAREST if path.startswith(prefix)), '$.')
        rank = {name: (0 if re.search(near, name) else 1, seconds)
                for name, seconds in self.seconds.items()}
        order = sorted(rank, key=rank.get)
        for batch in batches(order, self.seconds):
            longest = max(self.seconds[name] for name in batch)
            names = '|'.join(map(re.escape, batch))
            done = run(['ctest', '--test-dir', self.folder, '-R', f'^({names})$',
                        '--stop-on-failure', '--timeout', str(int(30 + 20 * longest)),
                        '-j', str(os.cpu_count())])
            failed = re.findall(r'Test +#\d+: (\S+) [.]*\**(?!.*Passed)(?!.*Skipped)', done.stdout)
            if done.returncode != 0:
                return failed[0] if failed else 'a test'
        return None


def batches(order, seconds):
    """Groups of growing total time: the first failure ends it all."""
    batch, total, limit = [], 0, 2
    for name in order:
        batch.append(name)
        total += seconds[name]
        if total > limit:
            yield batch
            batch, total, limit = [], 0, 4 * limit
    if batch:
        yield batch


def judge(mutation, stages):
    """'does not compile', 'changes nothing', 'survived', or 'caught by …'."""
    path = SOURCE / mutation.path
    original = path.read_text()
    path.write_text(mutation.applied_to(original))
    try:
        changed = False
        for stage in stages:
            if not stage.build():
                return 'does not compile'
            if stage.binaries() == stage.digest:
                continue
            changed = True
            if failure := stage.first_failure(mutation.path):
                return f'caught by {failure} ({stage.name})'
        return 'survived' if changed else 'changes nothing'
    finally:
        path.write_text(original)


def diff(mutation):
    original = (ROOT / mutation.path).read_text()
    lines = difflib.unified_diff(original.splitlines(), mutation.applied_to(original).splitlines(),
                                 mutation.path, mutation.path, lineterm='', n=0)
    return '\n'.join(list(lines)[2:])


def place(mutation):
    line = (ROOT / mutation.path).read_text().count('\n', 0, mutation.offset) + 1
    return f'{mutation.path}:{line}'


def random_mutations(seed):
    """All there are, in an order that takes the kinds in turn: half of them are constants."""
    kinds = {}
    for folder in SHIPPED:
        for path in sorted((ROOT / folder).rglob('*.?pp')):
            for mutation in mutations_of(str(path.relative_to(ROOT)), path.read_text()):
                kinds.setdefault(mutation.kind, []).append(mutation)
    for list_of_kind in kinds.values():
        random.Random(seed).shuffle(list_of_kind)
    turns = itertools.zip_longest(*kinds.values())
    return [mutation for turn in turns for mutation in turn if mutation]


def planted_mutations():
    """Rows of planted.txt: name | file | old | new."""
    found = []
    for row in (ROOT / 'tests/reliability/mutation/planted.txt').read_text().splitlines():
        if not row or row.startswith('#'):
            continue
        name, path, old, new = row.split(' | ')
        text = (ROOT / path).read_text()
        if text.count(old) != 1:
            sys.exit(f'{name}: {text.count(old)} places in {path} instead of one: {old}')
        found.append(Mutation(path, text.index(old), old, new, name))
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('count', type=int, nargs='?')
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--after', type=int, default=0)
    parser.add_argument('--planted', action='store_true')
    parser.add_argument('--check', action='store_true')
    arguments = parser.parse_args()
    if arguments.count is None and not (arguments.planted or arguments.check):
        parser.error('expected a number of mutations, --planted or --check')
    planted = planted_mutations()
    if arguments.check:
        print(f'{len(planted)} planted faults have their places')
        return 0
    # A mutated size must not take the machine's memory.
    resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))
    copy_sources()
    stages = [Stage(*stage) for stage in stages_here()]
    mutations = planted if arguments.planted else random_mutations(arguments.seed)
    wanted = len(planted) if arguments.planted else arguments.count
    caught, survivors, not_here = 0, [], []
    for number, mutation in enumerate(mutations[arguments.after:], arguments.after + 1):
        start = time.monotonic()
        verdict = judge(mutation, stages)
        seconds = time.monotonic() - start
        print(f'{number}: {place(mutation)}: {mutation.kind}: {verdict}, {seconds:.0f} s')
        print(diff(mutation), flush=True)
        caught += verdict.startswith('caught')
        if arguments.planted and verdict == 'changes nothing':
            not_here.append(mutation)
        elif verdict == 'survived' or (arguments.planted and not verdict.startswith('caught')):
            survivors.append(mutation)
        if caught + len(survivors) == wanted:
            break
    print(f'{caught} of {caught + len(survivors)} caught')
    for mutation in not_here:
        print(f'changes nothing that runs on this machine: {mutation.kind}')
    for mutation in survivors:
        print(f'survived: {place(mutation)}\n{diff(mutation)}')
    limit = 0 if arguments.planted else wanted // 20
    return 0 if len(survivors) <= limit else 1


if __name__ == '__main__':
    sys.exit(main())
