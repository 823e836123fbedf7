# SPDX-License-Identifier: GPL-3.0-or-later
"""No test and no script reaches into what another module keeps to itself: a name that begins with an underscore."""

import ast
from itertools import chain

import pytest
from support.checkout import ROOT

PACKAGE, OUTSIDE = ROOT / "bridge_demolition_addon", ("tests", "scripts", "validation")


def modules(folder):
    """Paths of all modules in a folder."""
    return sorted((ROOT / folder).rglob("*.py"))


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


@pytest.mark.slow
def test_no_module_outside_the_package_reaches_for_a_private_name():
    owners, reached = {}, {}
    for path in chain.from_iterable(map(modules, (PACKAGE.name, *OUTSIDE))):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        for name in private_names(tree):
            owners.setdefault(name, set()).add(path)
        reached[path] = set() if PACKAGE in path.parents else set(reached_for(tree))
    reaching = {
        path.relative_to(ROOT).as_posix(): found
        for path, names in reached.items()
        if (found := {name for name in names if owners.get(name) and path not in owners[name]})
    }
    assert reaching == {}
