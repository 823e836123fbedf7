# SPDX-License-Identifier: GPL-3.0-or-later
"""Every name of a library that is written anywhere here exists in the libraries of this Python.

Those of Python 3.11 are older: a name that they lack would be found where it is reached, which only long tests may do.
"""

import ast
import importlib
import importlib.util
import inspect
from collections.abc import Iterator
from functools import cache

import pytest
from support.checkout import ROOT

LIBRARIES = frozenset({"collections", "contextlib", "functools", "itertools", "math", "matplotlib", "numpy", "os"})
LIBRARIES |= {"pathlib", "scipy", "shutil", "statistics", "tempfile", "tomllib", "trimesh", "typing", "zipfile"}
"""Libraries that are installed with the project, and parts of Python that have grown since 3.11."""

FOLDERS = ("bridge_demolition_addon", "core", "scripts", "tests", "validation")

SOURCES = [path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*.py"))]


def test_every_name_of_a_library_exists():
    lacking = [
        f"{path.relative_to(ROOT)}:{line}: {name}"
        for path in SOURCES
        for line, name in names_of_libraries(ast.parse(path.read_bytes()))
        if not exists(name)
    ]
    assert not lacking


@pytest.mark.parametrize(
    ("source", "name"),
    [
        ("import numpy as np\nnp.vecdotted(1)", "numpy.vecdotted"),
        ("import numpy as np\nnp.linalg.normed", "numpy.linalg.normed"),
        ("from itertools import batches", "itertools.batches"),
        ("import os.path\nos.path.splits", "os.path.splits"),
        ("def f():\n    from pathlib import Path\n    Path.walked", "pathlib.Path.walked"),
    ],
)
def test_a_name_that_is_not_there_is_found(source, name):
    assert name in [each for _, each in names_of_libraries(ast.parse(source)) if not exists(each)]


def names_of_libraries(tree: ast.Module) -> Iterator[tuple[int, str]]:
    """Yield lines and full names of what a module takes from libraries, as far as it is written out."""
    nodes = list(ast.walk(tree))
    called: dict[str, str] = {}
    for node in nodes:
        match node:
            case ast.Import():
                for alias in node.names:
                    own = alias.asname or alias.name.partition(".")[0]
                    called[own] = alias.name if alias.asname else own
            case ast.ImportFrom(module=str(module), level=0):
                for alias in node.names:
                    called[alias.asname or alias.name] = f"{module}.{alias.name}"
                    if module.partition(".")[0] in LIBRARIES:
                        yield node.lineno, f"{module}.{alias.name}"
    for node in nodes:
        if isinstance(node, ast.Attribute) and (written := _written(node)):
            first, _, rest = written.partition(".")
            if called.get(first, "").partition(".")[0] in LIBRARIES:
                yield node.lineno, f"{called[first]}.{rest}"


def _written(node: ast.expr) -> str | None:
    match node:
        case ast.Name(id=name):
            return name
        case ast.Attribute(value=value, attr=attribute):
            before = _written(value)
            return before and f"{before}.{attribute}"
    return None


@cache
def exists(name: str) -> bool:
    """Whether modules and classes have what is named in them; what stands further within is not looked for."""
    before, _, last = name.rpartition(".")
    owner = _found(before) if before else None
    if not (inspect.ismodule(owner) or inspect.isclass(owner)):
        return True
    return hasattr(owner, last) or _is_within(owner, name)


@cache
def _found(name: str) -> object:
    before, _, last = name.rpartition(".")
    if not before:
        return importlib.import_module(name)
    owner = _found(before)
    return importlib.import_module(name) if _is_within(owner, name) else getattr(owner, last, None)


def _is_within(owner: object, name: str) -> bool:
    """Whether a name is that of a module in a package, which is loaded only where it is asked for."""
    return hasattr(owner, "__path__") and importlib.util.find_spec(name) is not None
