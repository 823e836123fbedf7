# SPDX-License-Identifier: GPL-3.0-or-later
"""Girder bridges with a deck of concrete, and transformed sections of theory to hold them against."""

import math
from dataclasses import dataclass

import numpy as np

from bridge_demolition_addon.engineering.steelwork.catalogue import section_named
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.scenario import Scenario
from bridge_demolition_addon.model.scenario.file import scenario_from_text
from bridge_demolition_addon.model.structure.equilibrium import at_rest, held_motions, inertias_of
from bridge_demolition_addon.model.structure.model import Model

STEEL_PA, STEEL_SHEAR_PA = 210e9, 210e9 / 2.6
CONCRETE_PA, CONCRETE_SHEAR_PA = 34e9, 34e9 / 2.4

GIRDERS, SPACING_M, WIDTH_M, THICKNESS_M = 2, 2.0, 4.0, 0.2
SECTION = "PG 1000x12x300x20x400x30"
HEIGHT_M, WEB_M, TOP_M, BOTTOM_M = 1.0, 0.012, (0.3, 0.02), (0.4, 0.03)

STUDS = "studs_per_m = 10\nstud_strength_n = 9e4\nstud_uplift_n = 4e4"
STIFF_STUDS = f"{STUDS}\nstud_stiffness_n_m = 1e10"
"""Studs that hardly slip."""

_TEXT = """
[scenario]
title = "Composite girders"
seed = {seed}

[time]
duration_s = 1.0

[fracture]
shards = {shards}

[connections]
type = "FIXED"
method = "face"
material = "concrete"
stiffness = "elastic"

[steelwork]
pieces = {pieces}

[[steelwork.girders]]
position_m = [0.0, 0.0, 8.0]
span_lengths_m = {spans}
girders = 2
spacing_m = 2.0
section = "PG 1000x12x300x20x400x30"
fields = [{fields}]
cross_frames = "HEA 200"
deck_thickness_m = 0.2
deck_width_m = 4.0
{studs}
"""


def composite_scenario(
    spans: tuple[float, ...] = (24.0,),
    *,
    fields: int = 4,
    pieces: int = 4,
    shards: int = 60,
    studs: str = STUDS,
    tables: str = "",
    seed: int = 1,
) -> Scenario:
    """Return two girders of 1 m, 2 m apart, under a deck of 4 m × 0.2 m, with further tables as text."""
    own = {"seed": seed, "shards": shards, "pieces": pieces, "spans": list(spans), "fields": fields, "studs": studs}
    return scenario_from_text(_TEXT.format(**own) + tables)


@dataclass(frozen=True)
class Composed:
    """Half of the bridge, one girder with 2 m of deck, as transformed by the modulus of steel; heights from below."""

    concrete_pa: float = CONCRETE_PA

    @property
    def parts(self) -> list[tuple[float, float, float]]:
        """Area by the modulus of steel, middle and second moment about that, of the plates and of the deck."""
        ratio = self.concrete_pa / STEEL_PA
        web = HEIGHT_M - TOP_M[1] - BOTTOM_M[1]
        plates = [
            (BOTTOM_M[0], BOTTOM_M[1], 0.5 * BOTTOM_M[1]),
            (WEB_M, web, BOTTOM_M[1] + 0.5 * web),
            (TOP_M[0], TOP_M[1], HEIGHT_M - 0.5 * TOP_M[1]),
            (ratio * WIDTH_M / GIRDERS, THICKNESS_M, HEIGHT_M + 0.5 * THICKNESS_M),
        ]
        return [(wide * deep, middle, wide * deep**3 / 12.0) for wide, deep, middle in plates]

    @property
    def centre_m(self) -> float:
        return math.fsum(area * z for area, z, _ in self.parts) / math.fsum(area for area, _, _ in self.parts)

    @property
    def bending_nm2(self) -> float:
        """E I of both together."""
        return STEEL_PA * math.fsum(area * (z - self.centre_m) ** 2 + own for area, z, own in self.parts)

    @property
    def shear_n(self) -> float:
        """G A_v of both together: what is stored by shear stresses V S / I b (Jourawski), summed over the height."""
        count = 4000
        edges = np.linspace(0.0, HEIGHT_M + THICKNESS_M, count + 1)
        z, deep = 0.5 * (edges[1:] + edges[:-1]), edges[1] - edges[0]
        is_deck, is_top, is_bottom = z > HEIGHT_M, z > HEIGHT_M - TOP_M[1], z < BOTTOM_M[1]
        wide = np.select([is_deck, is_top, is_bottom], [WIDTH_M / GIRDERS, TOP_M[0], BOTTOM_M[0]], WEB_M)
        young = np.where(is_deck, self.concrete_pa, STEEL_PA)
        shear = np.where(is_deck, self.concrete_pa / 2.4, STEEL_SHEAR_PA)
        flow = np.cumsum(young * wide * (z - self.centre_m) * deep) / self.bending_nm2  # q / V
        return 1.0 / float((flow**2 / (shear * wide) * deep).sum())

    def stress_pa(self, moment_nm: float, z_m: float, young_pa: float = STEEL_PA) -> float:
        """Stress at a height under a moment that pulls the bottom, tension positive."""
        return young_pa * moment_nm * (self.centre_m - z_m) / self.bending_nm2

    @property
    def flow_1_m(self) -> float:
        """Shear flow between deck and girder, by the shear force: S / I."""
        area, z, _ = self.parts[3]
        return STEEL_PA * area * (z - self.centre_m) / self.bending_nm2


def steel_alone() -> tuple[float, float]:
    """E I and G A of a girder by itself, A of its web between the middles of flanges."""
    section = section_named(SECTION)
    return STEEL_PA * float(section.shape.second_moments_m4[0, 0]), STEEL_SHEAR_PA * float(section.shear_areas_m2[1])


def deck_loads(model: Model, n_per_m: float) -> np.ndarray:
    """Return an even load on the deck (6, n), by length of each girder."""
    on_deck = shards_of(model, "span deck")
    loads = np.zeros((6, len(model.shards)))
    whole = float(np.ptp(model.members[0].solid.vertices[:, 0])) * GIRDERS * n_per_m
    loads[2, on_deck] = -whole * model.masses_kg[on_deck] / model.masses_kg[on_deck].sum()
    return loads


def rest_of(model: Model, scenario: Scenario, loads: np.ndarray, *, weight: bool = False):
    """Return a model at rest under loads (6, n), with its own weight or without."""
    return at_rest(
        model.connections,
        model.stiffness,
        model.masses_kg,
        inertias_of(model),
        model.centres_m,
        held_motions(model, scenario.joints),
        (0.0, 0.0, -STANDARD_GRAVITY_M_S2 if weight else 0.0),
        loads,
        model.bearings.springs,
    )


def shards_of(model: Model, name: str) -> np.ndarray:
    """Return the shards of a member."""
    index = [member.name for member in model.members].index(name)
    return np.flatnonzero(model.member_of_shard == index)


def deflection_of(model: Model, rest, name: str) -> float:
    """Return by how much a node has gone down."""
    (shard,) = shards_of(model, name)
    return float(model.centres_m[shard, 2] - rest.positions_m[2, shard])


def deck_section(model: Model, loads: np.ndarray, along_m: float) -> tuple[float, float]:
    """Return the force in the deck across a plane where it is cut, tension positive, and its moment, which pulls below.

    `loads` (6, m) are those of connections on their first shards.
    """
    deck = shards_of(model, "span deck")
    pairs, points = model.connections.pairs, model.connections.points
    rows = np.flatnonzero(np.isin(pairs, deck).all(axis=1) & (abs(points[:, 0] - along_m) < 1e-6))
    rows = rows[abs(model.connections.normals[rows, 0]) > 0.999]
    signs = np.sign(model.connections.normals[rows, 0])
    forces, moments = signs * loads[:3, rows], signs * loads[3:, rows]
    middle = 8.0 + 0.5 * THICKNESS_M
    about = moments[1] + forces[0] * (points[rows, 2] - middle)
    return float(forces[0].sum()), -float(about.sum())
