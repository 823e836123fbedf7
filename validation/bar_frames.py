# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames of steel bars that this program and OpenSees calculate: where nodes, bars, masses and supports are."""

import json
import math
from dataclasses import dataclass, replace

PIECES = 16
PLACES = (0.9,)
"""Parts of a bar's length at which its moment is compared: beside its end, where it is far from 0."""

LEAN, SKEW = 0.125, math.tan(math.radians(25.0))

ALONG, DOWN = ("along the road", 0), ("downwards", 2)

HEAD = """
[scenario]
title = "{title}"

[time]
duration_s = 1.0
frames_per_second = 240
substeps_per_frame = 8

[fracture]
shards = 1

[shards]
linear_damping = 0.0
angular_damping = 0.0
start_deactivated = false
use_deactivation = false

[connections]
type = "FIXED"
method = "face"
material = "steel"
stiffness = "elastic"
damping_ratio = 0.0

[steelwork]
grade = "S450"
pieces = {pieces}
"""


@dataclass(frozen=True, slots=True)
class Node:
    """A node with its place, m, and the mass that it carries, kg."""

    position_m: tuple[float, float, float]
    mass_kg: float = 0.0
    is_fixed: bool = False
    held_by: str | None = None


@dataclass(frozen=True, slots=True)
class BarFrame:
    """Nodes by their names, and bars by theirs: begin, end, and section."""

    title: str
    nodes: dict[str, Node]
    bars: dict[str, tuple[str, str, str]]
    watched: str
    """Node whose displacements are compared."""
    ways: tuple[tuple[str, int], ...]
    """Directions of these, with their axes."""
    bent: tuple[str, ...]
    """Bars whose moments are compared."""

    def without_support(self, name: str) -> "BarFrame":
        """Return it with a node that is not held any more."""
        nodes = self.nodes | {name: replace(self.nodes[name], is_fixed=False)}
        return replace(self, title=f"{self.title}, {name} lost", nodes=nodes)

    def on(self, name: str, member: str) -> "BarFrame":
        """Return it with a node that a member holds, not the ground."""
        return replace(self, nodes=self.nodes | {name: replace(self.nodes[name], held_by=member)})

    def scenario(self) -> str:
        """Return it as the text of a scenario."""
        parts = [HEAD.format(title=self.title, pieces=PIECES)]
        for name, node in self.nodes.items():
            held = {"support": "fixed"} if node.is_fixed else {}
            held |= {"held_by": node.held_by} if node.held_by else {}
            carried = {"mass_kg": node.mass_kg} if node.mass_kg else {}
            parts.append(_table("nodes", {"name": name, "position_m": list(node.position_m), **held, **carried}))
        for name, (begin, end, section) in self.bars.items():
            parts.append(_table("members", {"name": name, "nodes": [begin, end], "section": section}))
        return "\n".join(parts)


def _table(heading: str, keys: dict[str, object]) -> str:
    lines = [f"[[steelwork.{heading}]]", *(f"{key} = {json.dumps(value)}" for key, value in keys.items())]
    return "\n".join(lines) + "\n"


def _frame() -> BarFrame:
    """Two bays of 6 m and two storeys, whose columns lean by 1 in 8, so that it sways by its weight."""
    masses = {"B1": 12_000.0, "B2": 16_000.0, "B3": 4_000.0, "C1": 8_000.0, "C2": 6_000.0, "C3": 1_000.0}
    nodes = {
        f"{level}{line}": Node(
            (6.0 * line - 6.0 + LEAN * height, 0.0, height), masses.get(f"{level}{line}", 0.0), level == "A"
        )
        for level, height in (("A", 0.0), ("B", 4.0), ("C", 7.5))
        for line in (1, 2, 3)
    }
    bars = {
        f"{low}{line}-{high}{line}": (f"{low}{line}", f"{high}{line}", "HEB 240")
        for low, high in ("AB", "BC")
        for line in (1, 2, 3)
    }
    bars |= {
        f"{level}{line}-{level}{line + 1}": (f"{level}{line}", f"{level}{line + 1}", "IPE 360")
        for level in "BC"
        for line in (1, 2)
    }
    return BarFrame("frame that sways", nodes, bars, "C1", (ALONG, DOWN), ("A2-B2", "B1-C1", "B1-B2"))


def _grillage() -> BarFrame:
    """Three girders of 16 m and five cross beams at a skew of 25°, with 4 t on an outer girder."""
    girders, rows = (-3.0, 0.0, 3.0), range(5)
    nodes = {
        f"{name}{row}": Node((4.0 * row + SKEW * y, y, 6.0), 4_000.0 if (name, row) == ("a", 2) else 0.0, row in (0, 4))
        for name, y in zip("abc", girders, strict=True)
        for row in rows
    }
    bars = {
        f"{name}{row}-{name}{row + 1}": (f"{name}{row}", f"{name}{row + 1}", "HEB 300")
        for name in "abc"
        for row in range(4)
    }
    bars |= {
        f"{one}{row}-{other}{row}": (f"{one}{row}", f"{other}{row}", "IPE 300")
        for one, other in ("ab", "bc")
        for row in (1, 2, 3)
    }
    return BarFrame("skewed grillage", nodes, bars, "a2", (DOWN,), ("a1-a2", "b1-b2", "a2-b2"))


FRAME, GRILLAGE = _frame(), _grillage()
LOST = "a4"
"""Support of the grillage that is lost."""

FRAMES = (FRAME, GRILLAGE, GRILLAGE.without_support(LOST))
