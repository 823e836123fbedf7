# SPDX-License-Identifier: GPL-3.0-or-later
"""No test and no script reaches into what another module keeps to itself: a name that begins with an underscore."""

import ast
from functools import cache
from itertools import chain

import pytest
from support.checkout import ROOT

PACKAGE, OUTSIDE = ROOT / "bridge_demolition_addon", ("tests", "scripts", "validation")


@cache
def modules(folder):
    """Path and syntax tree of every module in a folder."""
    return [(path, ast.parse(path.read_text(encoding="utf-8"))) for path in sorted((ROOT / folder).rglob("*.py"))]


def is_private(name):
    return name.startswith("_") and not name.startswith("__") and name != "_"


def private_names(tree):
    """Private names that a module gives to functions, classes, variables and attributes."""
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            names = [node.name]
        elif isinstance(node, ast.Name | ast.Attribute) and isinstance(node.ctx, ast.Store):
            names = [node.id if isinstance(node, ast.Name) else node.attr]
        else:
            continue
        yield from filter(is_private, names)


def name_of(called):
    """The last name of what is called, such as `object` of `patch.object`."""
    return getattr(called, "attr", None) or getattr(called, "id", "")


def reached_for(tree):
    """Private names that a module imports, patches by name, or asks of anything but itself."""
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom):
            yield from (alias.name for alias in node.names if is_private(alias.name))
        elif isinstance(node, ast.Attribute) and is_private(node.attr):
            if not (isinstance(node.value, ast.Name) and node.value.id in ("self", "cls")):
                yield node.attr
        elif isinstance(node, ast.Call) and name_of(node.func) in ("getattr", "setattr", "object"):
            texts = (arg.value for arg in node.args if isinstance(arg, ast.Constant) and isinstance(arg.value, str))
            yield from (name for text in texts for name in text.split(".") if is_private(name))


@pytest.fixture(scope="module")
def kept_private():
    """Private names of all modules, whose owners they are."""
    owners = {}
    for path, tree in chain.from_iterable(map(modules, (PACKAGE.name, *OUTSIDE))):
        for name in private_names(tree):
            owners.setdefault(name, set()).add(path)
    return owners


@pytest.mark.slow
def test_no_module_outside_the_package_reaches_for_a_private_name(kept_private):
    reaching = {}
    for path, tree in chain.from_iterable(map(modules, OUTSIDE)):
        for name in reached_for(tree):
            owners = kept_private.get(name, set())
            if owners and path not in owners:
                reaching.setdefault(path.relative_to(ROOT).as_posix(), set()).add(name)
    assert reaching == {}
