# SPDX-License-Identifier: GPL-3.0-or-later
"""No test and no script reaches into what another module keeps to itself: a name that begins with an underscore."""

import ast

import pytest
from support.checkout import ROOT

PACKAGE, OUTSIDE = ROOT / "bridge_demolition_addon", ("tests", "scripts", "validation")


def modules(*folders):
    """Path and syntax tree of every module in some folders."""
    for folder in folders:
        for path in sorted((ROOT / folder).rglob("*.py")):
            yield path, ast.parse(path.read_text(encoding="utf-8"))


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


def reached_for(tree):
    """Private names that a module imports, patches by name, or asks of anything but itself."""
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom):
            yield from (alias.name for alias in node.names if is_private(alias.name))
        elif isinstance(node, ast.Attribute) and is_private(node.attr):
            if not (isinstance(node.value, ast.Name) and node.value.id in ("self", "cls")):
                yield node.attr
        elif isinstance(node, ast.Call) and ast.unparse(node.func).endswith(("getattr", "setattr", "patch.object")):
            texts = (arg.value for arg in node.args if isinstance(arg, ast.Constant) and isinstance(arg.value, str))
            yield from (name for text in texts for name in text.split(".") if is_private(name))


@pytest.fixture(scope="module")
def kept_private():
    """Private names of all modules, whose owners they are."""
    owners = {}
    for path, tree in modules(PACKAGE.name, *OUTSIDE):
        for name in private_names(tree):
            owners.setdefault(name, set()).add(path)
    return owners


@pytest.mark.slow
def test_no_module_outside_the_package_reaches_for_a_private_name(kept_private):
    reaching = {}
    for path, tree in modules(*OUTSIDE):
        for name in reached_for(tree):
            owners = kept_private.get(name, set())
            if owners and path not in owners:
                reaching.setdefault(path.relative_to(ROOT).as_posix(), set()).add(name)
    assert reaching == {}
