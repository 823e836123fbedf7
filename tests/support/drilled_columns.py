# SPDX-License-Identifier: GPL-3.0-or-later
"""A column under a load of 500 kN, with drill holes in a zone of it."""

from dataclasses import replace
from pathlib import Path

from bridge_demolition_addon.engineering.geometry.solids import box
from bridge_demolition_addon.model.bridge.member import Member
from bridge_demolition_addon.model.scenario import BlastZone, Scenario
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.structure.model import Model, build_model

LOAD_N = 500e3
SIDE_M, HEIGHT_M = 0.7, 4.0

_SCENARIO = """\
[scenario]
title = "A column under 500 kN"
seed = 4

[time]
duration_s = 1.0
substeps_per_frame = 20

[bridge]
mass_kg = 50000
span_lengths_m = [10.0]

[bridge.deck]
width_m = 4.0
thickness_m = 0.5

[bridge.piers]
columns = 1
column_length_m = 0.7
column_width_m = 0.7
height_m = 4.0

[fracture]
shards = 40

[connections]
type = "FIXED"
method = "face"
material = "reinforced concrete column"
stiffness = "elastic"
warm_up_s = 0.1

[shards]
use_deactivation = false
start_deactivated = false

[blast]
start_s = 0.3
"""

ZONE = BlastZone(
    name="zone",
    member="column",
    middle_m=1.5,
    height_m=1.5,
    rows=2,
    holes_a_row=5,
    spacing_m=0.3,
    depth_m=0.45,
    stemming_m=0.2,
    charge_g=73.5,
    explosive="emulsion",
)
"""The worked example: 0.735 m³ with 0.735 kg, 1 kg/m³."""


def column_scenario(folder: Path, *zones: BlastZone, shards: int = 40) -> Scenario:
    """The scenario of the column with zones; its bridge is not built."""
    path = folder / "column.toml"
    path.write_text(_SCENARIO, encoding="utf-8")
    scenario = read_scenario(path)
    return replace(scenario, blast_zones=zones, fracture=replace(scenario.fracture, shards=shards))


def column_members() -> list[Member]:
    """The column, and a block on it that weighs 500 kN with the half of the column above the zone left out."""
    density = 2400.0
    area_m2 = LOAD_N / 9.80665 / density
    return [
        Member("column", "pier", box([SIDE_M, SIDE_M, HEIGHT_M], [0.0, 0.0, HEIGHT_M / 2.0]), density),
        Member("block", "deck", box([area_m2 / 4.0, 4.0, 1.0], [0.0, 0.0, HEIGHT_M + 0.5]), density),
    ]


def column_model(scenario: Scenario) -> Model:
    """The model of the column and its block."""
    return build_model(scenario, column_members())
