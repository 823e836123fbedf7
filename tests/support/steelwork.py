# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenarios of steel bars alone, and what statics says of trusses."""

import json

import numpy as np

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.scenario import Scenario
from bridge_demolition_addon.model.scenario.file import scenario_from_text
from bridge_demolition_addon.model.structure.equilibrium import at_rest, held_motions, inertias_of
from bridge_demolition_addon.model.structure.model import Model

_HEAD = """
[scenario]
title = "Steelwork"

[time]
duration_s = 1.0

[fracture]
shards = 1

[connections]
type = "FIXED"
method = "face"
material = "steel"
stiffness = "elastic"
"""


def steel_scenario(nodes: list[dict], members: list[dict], tables: str = "", **steelwork) -> Scenario:
    """Return a scenario of nodes and bars, with further tables as text."""
    parts = [_HEAD, tables, _table("[steelwork]", steelwork)]
    parts += [_table("[[steelwork.nodes]]", node) for node in nodes]
    parts += [_table("[[steelwork.members]]", member) for member in members]
    return scenario_from_text("\n".join(parts))


def node(name: str, x: float, z: float, y: float = 0.0, **keys) -> dict:
    return {"name": name, "position_m": [x, y, z], **keys}


def bar(name: str, begin: str, end: str, section: str, **keys) -> dict:
    return {"name": name, "nodes": [begin, end], "section": section, **keys}


PULLED_COLUMN = """
[[pulls]]
name = "cable"
point_m = [0.0, 0.0, 6.0]
anchor_m = [8.0, 0.0, 0.0]
start_s = 0.5
speed_m_s = 0.1
largest_force_n = 5000.0
breaking_force_n = 20000.0
diameter_mm = 20.0
"""
"""A cable with 5 kN at most, from the head of a column of 6 m to the ground 8 m along the road."""


def pulled_column(pieces: int) -> Scenario:
    """Return a column that a cable pulls at its head."""
    nodes = [node("foot", 0.0, 0.0, support="fixed"), node("head", 0.0, 6.0)]
    return steel_scenario(nodes, [bar("column", "foot", "head", "HEB 300")], PULLED_COLUMN, pieces=pieces)


def blocks_text(deck_width_m: float) -> str:
    """Return a span of concrete on wall piers, beside or on which bars stand."""
    return f"""
[bridge]
span_lengths_m = [8.0]
density_kg_m3 = 2500.0

[bridge.deck]
width_m = {deck_width_m}
thickness_m = 0.5

[bridge.piers]
kind = "wall"
column_length_m = 0.6
column_width_m = 3.0
height_m = 4.0
"""


def rest_under(model: Model, scenario: Scenario, loads_n: dict[str, tuple[float, float, float]], *, weight: bool):
    """Return a model at rest under forces at nodes, with its own weight or without."""
    loads = np.zeros((6, len(model.shards)))
    names = [member.name for member in model.members]
    for name, force in loads_n.items():
        loads[:3, np.flatnonzero(model.member_of_shard == names.index(name))[0]] = force
    return at_rest(
        model.connections,
        model.stiffness,
        np.where(model.fixed, 0.0, model.masses_kg),
        inertias_of(model),
        model.centres_m,
        held_motions(model, scenario.joints),
        (0.0, 0.0, -STANDARD_GRAVITY_M_S2 if weight else 0.0),
        loads,
        model.bearings.springs if model.bearings else None,
    )


def bar_loads(model: Model, rest, name: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return positions along a bar of its joints (j,), forces along it (j,), tension positive, and moments about its y.

    Moments (j,) pull where z is positive.
    """
    steel = model.steel
    index = [member.name for member in model.members].index(name)
    mine = np.flatnonzero(steel.joints.members == index)
    rows, own = steel.rows[mine], model.members[index].steel.bar
    signs = np.where(model.connections.pairs[rows, 0] == steel.joints.pairs[mine, 0], 1.0, -1.0)
    forces, moments = signs * rest.loads[:3, rows], signs * rest.loads[3:, rows]
    order = np.argsort(steel.joints.numbers[mine])
    along, about = own.axes[:, 0] @ forces, own.axes[:, 1] @ moments
    return own.joints_m[steel.joints.numbers[mine]][order], along[order], about[order]


def truss_forces(
    places: dict[str, tuple[float, float]],
    bars: dict[str, tuple[str, str]],
    loads: dict[str, tuple[float, float]],
    held: dict[str, str],
) -> dict[str, float]:
    """Return the forces of bars of a plane truss by the method of joints, tension positive; `held` has axes."""
    rows = [(name, axis) for name in places for axis in "xz"]
    unknown = [*bars, *((name, axis) for name, axes in held.items() for axis in axes)]
    matrix, right = np.zeros((len(rows), len(unknown))), np.zeros(len(rows))
    for column, (one, other) in enumerate(bars.values()):
        along = np.subtract(places[other], places[one])
        along = along / np.hypot(*along)
        for name, sign in ((one, 1.0), (other, -1.0)):
            for axis, share in zip("xz", along, strict=True):
                matrix[rows.index((name, axis)), column] += sign * share
    for column, support in enumerate(unknown[len(bars) :], start=len(bars)):
        matrix[rows.index(support), column] = 1.0
    for name, force in loads.items():
        for axis, value in zip("xz", force, strict=True):
            right[rows.index((name, axis))] -= value
    return dict(zip(bars, np.linalg.solve(matrix, right)[: len(bars)].tolist(), strict=True))


def pratt_truss(panels: int = 8, panel_m: float = 4.0, height_m: float = 4.0):
    """Return places on the plane of a Pratt truss, and its bars: chords, posts, diagonals that are pulled."""
    places = {f"L{number}": (number * panel_m, 0.0) for number in range(panels + 1)}
    places |= {f"U{number}": (number * panel_m, height_m) for number in range(1, panels)}
    bars = {f"L{number}-L{number + 1}": (f"L{number}", f"L{number + 1}") for number in range(panels)}
    bars |= {f"U{number}-U{number + 1}": (f"U{number}", f"U{number + 1}") for number in range(1, panels - 1)}
    bars |= {f"L{number}-U{number}": (f"L{number}", f"U{number}") for number in range(1, panels)}
    bars |= {"L0-U1": ("L0", "U1"), f"L{panels}-U{panels - 1}": (f"L{panels}", f"U{panels - 1}")}
    middle = panels // 2
    for number in range(1, panels):
        if number < middle:
            bars[f"U{number}-L{number + 1}"] = (f"U{number}", f"L{number + 1}")
        elif number > middle:
            bars[f"U{number}-L{number - 1}"] = (f"U{number}", f"L{number - 1}")
    return places, bars


def _table(heading: str, keys: dict) -> str:
    return "\n".join([heading, *(f"{name} = {json.dumps(value)}" for name, value in keys.items()), ""])
