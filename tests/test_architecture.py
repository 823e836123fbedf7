# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/architecture.md shows the layers and rooms that the import contracts order, and that the folders are."""

import re
import sys
import tomllib
from collections import Counter
from itertools import chain
from xml.etree import ElementTree

import pytest
from places import ROOT

sys.path.insert(0, str(ROOT / "scripts"))

import layers_picture

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
    return [(each.text, float(each.get("x")), float(each.get("y"))) for each in texts if each.get("class") == kind]


def rows_of(boxes):
    """Names row by row from top to bottom."""
    heights = sorted({y for _, _, y in boxes})
    return [[name for name, _, y in boxes if y == height] for height in heights]


def first_cells(heading):
    """First cells of the table under a heading of the page."""
    text = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    section = re.search(rf"^## {heading}\n(.*?)(?=^## |\Z)", text, flags=re.S | re.M).group(1)
    return re.findall(r"^\| (\S+) \|", section, flags=re.M)[2:]  # without heading and dashes


def test_the_picture_is_up_to_date():
    made = layers_picture.PICTURE.read_text(encoding="utf-8")
    assert made == layers_picture.picture(), "run: python scripts/layers_picture.py"


def test_layers_are_drawn_in_the_order_of_their_contract():
    assert rows_of(drawn("layer")) == contract_of(PACKAGE)


def test_rooms_of_core_are_drawn_in_the_order_of_their_contract():
    (top,) = (y for name, _, y in drawn("layer") if name == "core")
    assert rows_of([box for box in drawn("room") if box[2] > top]) == contract_of(f"{PACKAGE}.core")


def test_rooms_of_other_layers_are_their_folders():
    layers = drawn("layer")
    found = {name: [] for name, _, _ in layers}
    for name, x, y in drawn("room"):
        row = max(height for _, _, height in layers if height < y)
        owner = min((layer for layer in layers if layer[2] == row), key=lambda layer: abs(layer[1] - x))
        found[owner[0]].append(name)
    for layer in set(found) - {"core"}:
        folders = {path.parent.name for path in (ROOT / PACKAGE / layer).glob("*/__init__.py")}
        assert set(found[layer]) == folders


@pytest.mark.parametrize(
    "heading, container", [("Layers", PACKAGE), ("Rooms of `core`", f"{PACKAGE}.core")], ids=["layers", "rooms"]
)
def test_tables_explain_each_of_them_and_no_other(heading, container):
    names = chain.from_iterable(contract_of(container))
    assert sorted(first_cells(heading)) == sorted(f"`{name}`" for name in names)


@pytest.mark.parametrize("heading", ["The way of a charge", "The way of an impulse", "The way of a draw"])
def test_a_way_passes_eight_files_at_most(heading):
    assert 5 <= len(first_cells(heading)) <= 8


def test_no_folder_has_more_modules_than_one_takes_in_at_a_glance():
    folders = {path.parent for path in (ROOT / PACKAGE).rglob("*.py")}
    counts = {
        folder.relative_to(ROOT): sum(path.stem != "__init__" for path in folder.glob("*.py")) for folder in folders
    }
    assert {folder: count for folder, count in counts.items() if count > 15} == {}


def test_no_two_test_modules_have_one_name():
    """pytest would import one of them alone, and end with an error over the other."""
    names = Counter(path.name for path in (ROOT / "tests").rglob("test_*.py"))
    assert {name for name, count in names.items() if count > 1} == set()
