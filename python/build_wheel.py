"""Builds the wheel of the Python module: a backend of PEP 517 that runs CMake.

It needs nothing but Python's own library, so that `pip install .` works without a network. The
library is linked statically: the wheel needs a C++ and an OpenMP runtime of the system, no more.

    CMAKE_ARGS="-DSIMDBEZIER_ISAS=avx2" pip install .      passes arguments to CMake
    SIMDBEZIER_WHEEL_BUILD=build pip install .             takes the module of a build folder that is
                                                           there, and its library where it is shared
"""
import base64
import hashlib
import io
import os
import pathlib
import re
import shlex
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent


def version():
    header = (ROOT / 'include/simdbezier/version.hpp').read_text()
    return '.'.join(re.search(rf'VERSION_{part} (\d+)', header).group(1)
                    for part in ('MAJOR', 'MINOR', 'PATCH'))


def metadata():
    project = (ROOT / 'pyproject.toml').read_text()
    description = re.search(r'^description = "(.*)"$', project, re.M).group(1)
    python = re.search(r'^requires-python = "(.*)"$', project, re.M).group(1)
    return (f'Metadata-Version: 2.1\nName: simdbezier\nVersion: {version()}\n'
            f'Summary: {description}\nLicense: MIT\nRequires-Python: {python}\n'
            'Requires-Dist: numpy\nDescription-Content-Type: text/markdown\n\n'
            f'{(ROOT / "README.md").read_text()}')


def tag():
    platform = re.sub(r'[-.]', '_', sysconfig.get_platform())
    python = f'cp{sys.version_info.major}{sys.version_info.minor}'
    return f'{python}-{python}-{platform}'


def run(*command):
    print('+', shlex.join(map(str, command)), flush=True)
    subprocess.run([str(word) for word in command], check=True)


def install(build, prefix, component):
    run('cmake', '--install', build, '--prefix', prefix, '--component', component, '--strip')


def configure(build):
    run('cmake', '-S', ROOT, '-B', build, '-DCMAKE_BUILD_TYPE=Release', '-DBUILD_SHARED_LIBS=OFF',
        '-DSIMDBEZIER_BUILD_PYTHON=ON', '-DSIMDBEZIER_BUILD_TOOLS=OFF',
        f'-DPython_EXECUTABLE={sys.executable}', '-DSIMDBEZIER_PYTHON_DIR=.',
        *shlex.split(os.environ.get('CMAKE_ARGS', '')))


def package_files(build, scratch):
    """Builds and installs the module: a dict from names in the wheel to what they hold."""
    if not (build / 'CMakeCache.txt').exists():
        configure(build)
    run('cmake', '--build', build, '--target', 'simdbezier_python', '--parallel',
        os.cpu_count() or 1)
    install(build, scratch / 'module', 'python')
    modules = list((scratch / 'module').rglob('simdbezier/_core*'))
    suffix = sysconfig.get_config_var('EXT_SUFFIX')
    if len(modules) != 1 or modules[0].name != f'_core{suffix}':
        sys.exit(f'{build} has no module for this Python: expected _core{suffix}, found '
                 f'{[module.name for module in modules]}')
    folder = modules[0].parent
    files = {f'simdbezier/{path.name}': path.read_bytes() for path in sorted(folder.iterdir())
             if path.is_file()}
    # The module looks beside itself first. Of a static library nothing is installed.
    install(build, scratch / 'runtime', 'runtime')
    for library in (scratch / 'runtime').rglob('libsimdbezier.so.*'):
        if library.is_symlink(): # the name that the module asks for
            files[f'simdbezier/{library.name}'] = library.read_bytes()
    return files


def record_line(name, data):
    digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b'=').decode()
    return f'{name},sha256={digest},{len(data)}\n'


def information():
    """What a wheel says about itself: a dict from names in its folder to what they hold."""
    return {'METADATA': metadata().encode(),
            'LICENSE': (ROOT / 'LICENSE').read_bytes(),
            'WHEEL': (f'Wheel-Version: 1.0\nGenerator: simdbezier {version()}\n'
                      f'Root-Is-Purelib: false\nTag: {tag()}\n').encode()}


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    """The hook that spares pip a build where it only wants to know what it will get."""
    folder = pathlib.Path(metadata_directory, f'simdbezier-{version()}.dist-info')
    folder.mkdir()
    for name, data in information().items():
        (folder / name).write_bytes(data)
    return folder.name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """The hook that pip calls; returns the wheel's name."""
    info = f'simdbezier-{version()}.dist-info'
    name = f'simdbezier-{version()}-{tag()}.whl'
    with tempfile.TemporaryDirectory() as scratch:
        build = pathlib.Path(os.environ.get('SIMDBEZIER_WHEEL_BUILD', f'{scratch}/build'))
        files = package_files(build, pathlib.Path(scratch))
    files.update({f'{info}/{name}': data for name, data in information().items()})
    record = ''.join(record_line(path, data) for path, data in files.items())
    files[f'{info}/RECORD'] = f'{record}{info}/RECORD,,\n'.encode()
    with zipfile.ZipFile(pathlib.Path(wheel_directory, name), 'w', zipfile.ZIP_DEFLATED) as wheel:
        for path, data in files.items():
            entry = zipfile.ZipInfo(path)
            entry.external_attr = (0o755 if '.so' in path else 0o644) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            wheel.writestr(entry, data)
    return name


def build_sdist(sdist_directory, config_settings=None):
    """The hook for source archives: what git knows."""
    name = f'simdbezier-{version()}'
    git = subprocess.run(['git', '-C', ROOT, 'ls-files', '-z'], check=False, stdout=subprocess.PIPE)
    if git.returncode != 0:
        sys.exit(f'{ROOT} is no clone: git says what belongs to a source archive')
    listed = git.stdout.decode().split('\0')
    with tarfile.open(pathlib.Path(sdist_directory, f'{name}.tar.gz'), 'w:gz') as archive:
        for path in filter(None, listed):
            archive.add(ROOT / path, f'{name}/{path}')
        entry, data = tarfile.TarInfo(f'{name}/PKG-INFO'), metadata().encode()
        entry.size = len(data)
        archive.addfile(entry, io.BytesIO(data))
    return f'{name}.tar.gz'
