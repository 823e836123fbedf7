# SPDX-License-Identifier: GPL-3.0-or-later
"""The README of the package shows the layers and rooms that the import contracts order, and that the folders are."""

import ast
import re
import tomllib
from collections import Counter
from functools import cache
from itertools import chain
from xml.etree import ElementTree

import pytest
from pictures import layers_picture
from support.checkout import ROOT

PACKAGE = "bridge_demolition_addon"


def contract_of(container):
    """Rows of names of the contract of a package, highest first."""
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    (layers,) = (
        contract["layers"]
        for contract in settings["tool"]["importlinter"]["contracts"]
        if contract.get("containers") == [container]
    )
    return [row.split(" | ") for row in layers]


def drawn(kind):
    """Names of layers or of rooms in the picture with the middle of each, (x, y)."""
    texts = ElementTree.parse(layers_picture.PICTURE).iter("{http://www.w3.org/2000/svg}text")
    return [(text.text, float(text.get("x")), float(text.get("y"))) for text in texts if text.get("class") == kind]


def rows_of(boxes):
    """Names row by row from top to bottom."""
    heights = sorted({y for _, _, y in boxes})
    return [[name for name, _, y in boxes if y == height] for height in heights]


def first_cells(heading):
    """First cells of the table under a heading of the page."""
    text = (ROOT / "bridge_demolition_addon" / "README.md").read_text(encoding="utf-8")
    section = re.search(rf"^## {heading}\n(.*?)(?=^## |\Z)", text, flags=re.S | re.M).group(1)
    return re.findall(r"^\| (\S+) \|", section, flags=re.M)[2:]  # without heading and dashes


def test_the_picture_is_up_to_date():
    made = layers_picture.PICTURE.read_text(encoding="utf-8")
    assert made == layers_picture.picture(), "run: python scripts/pictures/layers_picture.py"


def test_layers_are_drawn_in_the_order_of_their_contract():
    assert rows_of(drawn("layer")) == contract_of(PACKAGE)


ORDERED = ("model", "engineering", "system")
"""Layers of which a contract orders the rooms."""


def rooms_by_layer():
    """Rooms that are drawn inside each layer, as `drawn` gives them."""
    layers = drawn("layer")
    found = {name: [] for name, _, _ in layers}
    for box in drawn("room"):
        row = max(height for _, _, height in layers if height < box[2])
        owner = min((layer for layer in layers if layer[2] == row), key=lambda layer: abs(layer[1] - box[1]))
        found[owner[0]].append(box)
    return found


@pytest.mark.parametrize("layer", ORDERED)
def test_rooms_are_drawn_in_the_order_of_their_contract(layer):
    assert rows_of(rooms_by_layer()[layer]) == contract_of(f"{PACKAGE}.{layer}")


def test_types_of_all_layers_but_the_interface_are_checked():
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["mypy"]
    layers = set(chain.from_iterable(contract_of(PACKAGE))) - {"ui"}
    assert {name.removeprefix(f"{PACKAGE}.") for name in settings["packages"]} == layers
    options = chain.from_iterable([settings, *settings["overrides"]])
    assert "ignore_errors" not in options


def test_rooms_of_other_layers_are_their_folders():
    for layer, rooms in rooms_by_layer().items():
        if layer not in ORDERED:
            folders = {path.parent.name for path in (ROOT / PACKAGE / layer).glob("*/__init__.py")}
            assert {name for name, _, _ in rooms} == folders


@pytest.mark.parametrize(
    "heading, container",
    [("Layers", PACKAGE), *((f"Rooms of `{layer}`", f"{PACKAGE}.{layer}") for layer in ORDERED)],
    ids=["layers", *ORDERED],
)
def test_tables_explain_each_of_them_and_no_other(heading, container):
    names = chain.from_iterable(contract_of(container))
    assert sorted(first_cells(heading)) == sorted(f"`{name}`" for name in names)


def test_no_two_test_modules_have_one_name():
    """pytest would import one of them alone, and end with an error over the other."""
    names = Counter(path.name for path in (ROOT / "tests").rglob("test_*.py"))
    assert {name for name, count in names.items() if count > 1} == set()


@cache
def classes():
    """All classes of the package with their modules."""
    return [
        (path.relative_to(ROOT).as_posix(), node)
        for path in sorted((ROOT / PACKAGE).rglob("*.py"))
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.ClassDef)
    ]


def test_no_two_public_classes_have_one_name():
    modules = {}
    for module, class_ in classes():
        if not class_.name.startswith("_"):
            modules.setdefault(class_.name, []).append(module)
    assert {name: found for name, found in modules.items() if len(found) > 1} == {}


def kinds_of(base):
    return {base.__name__}.union(*map(kinds_of, base.__subclasses__()))


def told_apart(node, kinds):
    """Names of kinds that a node tells apart: by `isinstance`, by a pattern, or by the identity of their class."""
    match node:
        case ast.Call(func=ast.Name(id="isinstance" | "issubclass"), args=[_, asked]):
            found = ast.walk(asked)
        case ast.MatchClass(cls=named):
            found = ast.walk(named)
        case ast.Compare(comparators=right, ops=ops) if any(not isinstance(op, ast.In | ast.NotIn) for op in ops):
            found = [node.left, *right]
        case _:
            return set()
    names = {getattr(part, "id", getattr(part, "attr", None)) for part in found}
    return names & kinds


def test_nothing_tells_kinds_of_actions_apart():
    """Each says all of itself: what asks for its class would have to be changed for another."""
    from bridge_demolition_addon.model.actions import PlannedAction
    from bridge_demolition_addon.model.scenario import Scenario

    kinds = kinds_of(PlannedAction) - {PlannedAction.__name__}
    assert {"Ball", "BlastZone", "Charge", "Lift", "Load", "Pull", "SawCut", "Severing"} < kinds and Scenario
    assert told_apart(ast.parse("isinstance(action, lifts.Lift | Pull)").body[0].value, kinds) == {"Lift", "Pull"}
    assert told_apart(ast.parse("type(action) is Ball").body[0].value, kinds) == {"Ball"}
    found = {
        f"{path.relative_to(ROOT / PACKAGE)}:{node.lineno} {name}"
        for path in sorted((ROOT / PACKAGE).rglob("*.py"))
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        for name in told_apart(node, kinds)
    }
    assert found == set()


def test_what_is_frozen_never_changes_itself():
    sources = (ROOT / PACKAGE).rglob("*.py")
    assert [path for path in sources if "object.__setattr__" in path.read_text(encoding="utf-8")] == []


def test_nothing_resets_the_preferences_of_blender():
    """Blender then deletes the libraries of all extensions from the disk of the user."""
    sources = (ROOT / PACKAGE).rglob("*.py")
    assert [path.name for path in sources if "read_factory_settings(" in path.read_text(encoding="utf-8")] == []
