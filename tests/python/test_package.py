"""What the package promises about itself: doctests, stubs, types."""
import ast
import doctest
import pathlib

import simdbezier

FOLDER = pathlib.Path(simdbezier.__file__).parent


def test_its_examples_are_right():
    failed, attempted = doctest.testmod(simdbezier)
    assert attempted > 10 and failed == 0


def test_stubs_have_every_name():
    tree = ast.parse((FOLDER / '__init__.pyi').read_text())
    named = {node.name: node for node in tree.body
             if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    assert set(simdbezier.__all__) == set(named)
    for name, node in named.items():
        if isinstance(node, ast.ClassDef) and name != 'PatchIndexError':
            methods = {item.name for item in node.body if isinstance(item, ast.FunctionDef)}
            public = {item for item in vars(getattr(simdbezier, name))
                      if not item.startswith('_')} | {'__init__', '__len__', '__getitem__', '__iter__'} & methods
            assert methods == public, name
    assert (FOLDER / 'py.typed').exists()


def test_everything_has_a_description():
    for name in simdbezier.__all__:
        assert getattr(simdbezier, name).__doc__, name


def test_it_knows_its_version_and_machine():
    assert len(simdbezier.__version__.split('.')) == 3
    assert simdbezier.available_isas()
