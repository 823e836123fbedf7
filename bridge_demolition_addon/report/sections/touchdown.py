"""The section on how the fall of the bridge shakes the ground."""

from __future__ import annotations

from collections.abc import Sequence

from ...model.debris.touchdown import EXPONENT, LIMITS, TOGETHER_S, VELOCITY_M_S, Shaking, landings, reached, shaking_at
from ...model.results.arrays import Results
from ...model.scenario import Neighbour
from ..document.blocks import Block, Column, DataTable, Paragraph, Section


def touchdown_section(results: Results, neighbours: Sequence[Neighbour]) -> Section | None:
    """How the fall shakes the ground at the neighbours; None where there are none."""
    if not neighbours:
        return None
    landed = landings(results)
    blocks: list[Block] = [Paragraph(_BASIS)]
    shaken = [(neighbour.name, shaking_at(neighbour.place_m, landed)) for neighbour in neighbours]
    if len(landed):
        blocks.append(_table([(name, shaking) for name, shaking in shaken if shaking is not None]))
    else:
        blocks.append(Paragraph("Nothing fell and was stopped in this run."))
    blocks.append(_limit_table())
    return Section("Shaking of the ground by the fall", tuple(blocks))


_BASIS = (
    f"Largest velocity of the ground by v = {100.0 * VELOCITY_M_S:.3g} cm/s (R / (E / 10 kJ)^(1/3))^-{EXPONENT:g} "
    f"(Zhou), with the distance R in m and the kinetic energy E in kJ of what lands within {TOGETHER_S:g} s. It is an "
    "estimate: a factor of two to either side is usual, and soil, ditches and banks change it. "
    "One run is one possible outcome: a study gives the range."
)


def _table(shaken: Sequence[tuple[str, Shaking]]) -> DataTable:
    columns = (
        Column("neighbour", "neighbour", "", lambda name, _: name),
        Column(
            "ground velocity (mm/s)",
            "peak_particle_velocity_mm_s",
            ".2f",
            lambda _, shaking: 1e3 * shaking.velocity_m_s,
        ),
        Column("from (s)", "time_s", ".2f", lambda _, shaking: shaking.time_s),
        Column("mass (t)", "mass_t", ".1f", lambda _, shaking: 1e-3 * shaking.mass_kg),
        Column("energy (kJ)", "energy_kJ", ".0f", lambda _, shaking: 1e-3 * shaking.energy_j),
        Column("distance (m)", "distance_m", ".1f", lambda _, shaking: shaking.distance_m),
        Column("reaches the limit for", "limits", "", lambda _, shaking: _limits_reached(shaking)),
    )
    names, shakings = zip(*shaken, strict=True) if shaken else ((), ())
    return DataTable.of("touchdown", "What the fall does at the neighbours", columns, names, shakings)


def _limits_reached(shaking: Shaking) -> str:
    return ", ".join(limit.building for limit in reached(shaking.velocity_m_s)) or "none"


def _limit_table() -> DataTable:
    columns = (
        Column("building", "building", "", lambda limit: limit.building),
        Column("velocity (mm/s)", "velocity_mm_s", ".0f", lambda limit: 1e3 * limit.velocity_m_s),
        Column("source", "source", "", lambda limit: limit.source),
    )
    return DataTable.of("vibration_limits", "Limits at low frequency, at the foundation", columns, LIMITS)
