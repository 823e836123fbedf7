"""The section on how the fall of the bridge shakes the ground."""

from __future__ import annotations

from collections.abc import Sequence

from ...model.debris.touchdown import EXPONENT, TOGETHER_S, VELOCITY_M_S, Shaking, landings, shaking_at
from ...model.debris.vibration_limits import LIMITS, reached
from ...model.results.arrays import Results
from ...model.scenario import Neighbour
from ..document.blocks import Block, Column, DataTable, Paragraph, Section


def touchdown_section(results: Results, neighbours: Sequence[Neighbour]) -> Section | None:
    """How the fall shakes the ground at the neighbours; None where there are none."""
    if not neighbours:
        return None
    landed = landings(results)
    blocks: list[Block] = [Paragraph(_BASIS)]
    shaken = [(each.name, shaking_at(each.place_m, landed)) for each in neighbours]
    if len(landed):
        blocks.append(_table([(name, shaking) for name, shaking in shaken if shaking is not None]))
    else:
        blocks.append(Paragraph("Nothing fell and was stopped in this run."))
    blocks.append(_limit_table())
    return Section("Shaking of the ground by the fall", tuple(blocks))


_BASIS = (
    f"Largest velocity of the ground by v = {100.0 * VELOCITY_M_S:.3g} cm/s (R / (E / 10 kJ)^(1/3))^-{EXPONENT:g} "
    f"(Zhou), with the distance R in m and the kinetic energy E in kJ of what lands within {TOGETHER_S:g} s. It is an "
    "estimate: a factor of two to either side is usual, and soil, ditches and banks change it. One run is one draw: a "
    "study gives the range."
)


def _table(shaken: Sequence[tuple[str, Shaking]]) -> DataTable:
    columns = (
        Column("neighbour", "neighbour"),
        Column("ground velocity (mm/s)", "peak_particle_velocity_mm_s", ".2f"),
        Column("from (s)", "time_s", ".2f"),
        Column("mass (t)", "mass_t", ".1f"),
        Column("energy (kJ)", "energy_kJ", ".0f"),
        Column("distance (m)", "distance_m", ".1f"),
        Column("reaches the limit for", "limits"),
    )
    rows = [
        (
            name,
            1e3 * each.velocity_m_s,
            each.time_s,
            1e-3 * each.mass_kg,
            1e-3 * each.energy_j,
            each.distance_m,
            ", ".join(limit.building for limit in reached(each.velocity_m_s)) or "none",
        )
        for name, each in shaken
    ]
    return DataTable("touchdown", "What the fall does at the neighbours", columns, rows)


def _limit_table() -> DataTable:
    columns = (
        Column("building", "building"),
        Column("velocity (mm/s)", "velocity_mm_s", ".0f"),
        Column("source", "source"),
    )
    rows = [(each.building, 1e3 * each.velocity_m_s, each.source) for each in LIMITS]
    return DataTable("vibration_limits", "Limits at low frequency, at the foundation", columns, rows)
