"""Blast in a report: charges, overpressure in plan, and loads at the neighbours."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from manifold3d import CrossSection

from ...charts.blast_maps import WIDEST_PA, neighbour_pressures, overpressure_map
from ...engineering.blast.pulses import BlastModel
from ...engineering.blast.vibration import DAMAGE_LIMIT_M_S, FREE_FACE_AVERAGE
from ...engineering.terrain.surface import RecordedGround
from ...engineering.units import with_digits
from ...model.blast.charges import Charge
from ...model.blast.receptors import ONE_DELAY_S, THRESHOLDS, PlaceLoads, charges_per_delay, loads_at, ring_radii
from ...model.scenario import Scenario
from ...model.schema import given
from ...texts import Quantity, Text
from ..document.blocks import Block, Column, DataTable, Paragraph, Picture, Section, facts


def blast_section(scenario: Scenario, bridge: CrossSection, ground: RecordedGround) -> Section | None:
    """Return the effects of the charges around the bridge; None where the scenario has no charge with a mass."""
    charges = tuple(charge for charge in scenario.charges if charge.mass_kg > 0.0)
    if not charges:
        return None
    model, factor = BlastModel(scenario.blast.model), scenario.blast.pressure_factor
    blocks: list[Block] = []
    if not scenario.blast.explosion:
        blocks.append(
            Paragraph("The charges did not go off in this run: this is their effect otherwise.", is_notice=True)
        )
    if factor != 1.0:
        blocks.append(
            Paragraph(Text("All pressures are taken times blast.pressure_factor, {}.", f"{factor:g}"), is_notice=True)
        )
    blocks += [_charge_table(charges), _totals(charges)]
    blocks.append(
        Picture(
            partial(
                overpressure_map,
                charges=charges,
                bridge=bridge,
                neighbours=scenario.neighbours,
                model=model,
                pressure_factor=factor,
                ground=ground,
            ),
            Text(
                "Peak overpressure on the ground, the largest of any one charge; where waves meet, it can be "
                "more. Rings down to {}; the others are in the table. Free field, without shelter or reflection.",
                Quantity(WIDEST_PA / 1e3, "kPa", "g"),
            ),
            140.0,
        )
    )
    blocks.append(_ring_table(charges, model, factor))
    if scenario.neighbours:
        neighbours = scenario.neighbours
        blocks += _neighbour_blocks(
            [(one.name, loads_at(one.position_m, charges, model, factor)) for one in neighbours]
        )
    else:
        blocks.append(Paragraph("The scenario has no neighbours: add tables [[neighbours]] to see their loads here."))
    return Section("Blast", tuple(blocks))


def _charge_table(charges: Sequence[Charge]) -> DataTable:
    columns = (
        Column("charge", "charge", "", lambda charge: charge.name),
        Column("explosive", "explosive", "", lambda charge: Text(charge.explosive)),
        Column("mass", "mass_kg", ".2f", significant=3, value=lambda charge: charge.mass_kg),
        Column(
            "TNT by pressure",
            "tnt_by_pressure_kg",
            ".2f",
            significant=3,
            value=lambda charge: charge.tnt_for_pressure_kg,
        ),
        Column("x", "x_m", ".2f", lambda charge: charge.position_m[0]),
        Column("y", "y_m", ".2f", lambda charge: charge.position_m[1]),
        Column("z", "z_m", ".2f", lambda charge: charge.position_m[2]),
        Column("delay", "delay_ms", ".0f", lambda charge: 1e3 * charge.delay_s),
        Column("burst", "burst", "", lambda charge: Text(charge.burst)),
    )
    return DataTable.of("charges", "Charges", columns, charges)


def _totals(charges: Sequence[Charge]) -> DataTable:
    groups = charges_per_delay(charges)
    masses = [sum(charge.mass_kg for charge in group) for group in groups]
    largest = groups[masses.index(max(masses))]
    names = ", ".join(given(charge.name) for charge in largest)
    rows = [
        (Text("Total charge"), Quantity(with_digits(sum(masses), 2), "kg")),
        (
            Text("Delays"),
            Text("{}, counting charges within {} ms of each other as one", len(groups), f"{1e3 * ONE_DELAY_S:g}"),
        ),
        (
            Text("Largest charge per delay"),
            Text(
                "{} at {} ms ({})", Quantity(with_digits(max(masses), 2), "kg"), f"{1e3 * largest[0].delay_s:g}", names
            ),
        ),
    ]
    return facts("Total charge and charge per delay", rows, "charge_per_delay")


def _ring_table(charges: Sequence[Charge], model: BlastModel, pressure_factor: float) -> DataTable:
    radii = ring_radii(charges, 0.0, THRESHOLDS, model, pressure_factor).max(axis=1)
    columns = (
        Column("overpressure", "overpressure_kPa", ".2f", lambda threshold, _: threshold.overpressure_pa / 1e3),
        Column("damage", "damage", "", lambda threshold, _: threshold.damage),
        Column("ring", "radius_m", ".1f", lambda _, radius_m: float(radius_m), is_reach=True),
        Column("source", "source", "", lambda threshold, _: threshold.source),
    )
    title = Text("Thresholds of damage, and the largest radius around a charge on the ground")
    return DataTable.of("damage_rings", title, columns, THRESHOLDS, radii)


def _neighbour_blocks(loads: Sequence[tuple[str, PlaceLoads]]) -> list[Block]:
    columns = (
        Column("neighbour", "neighbour", "", lambda name, _: name),
        Column("distance", "distance_m", ".1f", lambda _, load: load.distance_m),
        Column("first wave", "arrival_ms", ".1f", lambda _, load: 1e3 * load.arrival_s),
        Column("peak", "peak_overpressure_kPa", ".3f", lambda _, load: load.peak_pa / 1e3),
        Column("impulse", "impulse_kPa_ms", ".2f", lambda _, load: load.impulse_pa_s, unit="kPa·ms"),
        Column(
            "ground velocity",
            "peak_particle_velocity_mm_s",
            ".1f",
            lambda _, load: 1e3 * load.peak_velocity_m_s,
        ),
    )
    ground = FREE_FACE_AVERAGE
    basis = Text(
        "Vibration by v = {} mm/s (R/√Q)^-{} ({}), of the charges that detonate together; houses resist {} (USBM "
        "Bulletin 656), many codes ask for less. It holds for charges drilled into rock. It does not include the "
        "fall of the bridge, which often shakes the ground more.",
        f"{1e3 * ground.velocity_m_s:g}",
        f"{ground.exponent:g}",
        Text(ground.name),
        Quantity(1e3 * DAMAGE_LIMIT_M_S, "mm/s", "g"),
    )
    names, at_neighbours = zip(*loads, strict=True)
    return [
        DataTable.of("neighbours", "Loads at the neighbours", columns, names, at_neighbours),
        Picture(
            partial(neighbour_pressures, loads=loads),
            "Overpressure at the neighbours, all charges and delays together, incident and in the free field.",
        ),
        Paragraph(basis),
    ]
