# SPDX-License-Identifier: GPL-3.0-or-later
"""Draw the layers and rooms of the code from the import contracts in pyproject.toml: docs/pictures/layers.svg.

What stands higher may use what stands lower. Rooms that no contract orders are the folders of their layer, by name.
"""

import tomllib
from html import escape
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PICTURE = ROOT / "docs" / "pictures" / "layers.svg"

WIDTH, GAP, TITLE, ROOM = 860, 8, 30, 26
"""Of the picture, between boxes, of the line with a layer's name, and of a row of rooms, in pixels."""

Row = list[str]
"""Names side by side, which may not use each other."""


def orders() -> dict[str, list[Row]]:
    """Read the rows of each package that a contract orders, highest first, by the package's name."""
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["importlinter"]
    return {
        container: [layer.split(" | ") for layer in contract["layers"]]
        for contract in settings["contracts"]
        if contract["type"] == "layers"
        for container in contract["containers"]
    }


def rooms(package: str, ordered: dict[str, list[Row]]) -> list[Row]:
    """Find the rows of rooms in a package: those of its contract, or one row of all its folders."""
    if package in ordered:
        return ordered[package]
    folders = sorted(path.parent.name for path in ROOT.joinpath(*package.split(".")).glob("*/__init__.py"))
    return [folders] if folders else []


def picture() -> str:
    """Draw all layers below each other, each with its rooms inside."""
    ordered = orders()
    (root,) = (name for name in ordered if "." not in name)
    shapes, y = [], GAP
    for row in ordered[root]:
        inside = {name: rooms(f"{root}.{name}", ordered) for name in row}
        height = TITLE + max(len(row) for row in inside.values()) * (ROOM + GAP)
        for name, (x, width) in zip(row, _columns(len(row), GAP, WIDTH - 2 * GAP), strict=True):
            shapes += _box(x, y, width, height, name, "layer")
            for line, names in enumerate(inside[name]):
                top = y + TITLE + line * (ROOM + GAP)
                for room, (left, across) in zip(names, _columns(len(names), x + GAP, width - 2 * GAP), strict=True):
                    shapes += _box(left, top, across, ROOM, room, "room")
        y += height + GAP
    return "\n".join([*_head(y), *shapes, "</svg>", ""])


def _columns(count: int, left: float, width: float) -> list[tuple[float, float]]:
    """Divide a width evenly: left edge and width of each column."""
    width_of_one = (width - (count - 1) * GAP) / count
    return [(left + number * (width_of_one + GAP), width_of_one) for number in range(count)]


def _box(x: float, y: float, width: float, height: float, name: str, kind: str) -> list[str]:
    baseline = y + (19 if kind == "layer" else 17)
    return [
        f'<rect class="{kind}" x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{height:.1f}" rx="4"/>',
        f'<text class="{kind}" x="{x + width / 2:.1f}" y="{baseline:.1f}">{escape(name)}</text>',
    ]


def _head(height: float) -> list[str]:
    return [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" width="{WIDTH}" height="{height}">',
        "<style>",
        "text { font: 13px sans-serif; text-anchor: middle; fill: #222 }",
        "text.layer { font-weight: bold }",
        "rect.layer { fill: #e8eef5; stroke: #7a8ca3 }",
        "rect.room { fill: #fff; stroke: #b5c0ce }",
        "</style>",
        f'<rect width="{WIDTH}" height="{height}" fill="#fff"/>',
    ]


if __name__ == "__main__":
    PICTURE.write_text(picture(), encoding="utf-8", newline="\n")
