"""Steel bars of a model at rest: what each carries, by what its section resists and by what it resists as a strut."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ...engineering.elasticity.equilibrium import Equilibrium
from ...engineering.geometry.vectors import dot
from ...engineering.mechanics.section_cuts import ConnectionLoads, section_forces
from ...engineering.steelwork.bars import SteelBar
from ...engineering.steelwork.bolted_ends import BoltedEnd
from ...engineering.steelwork.resistance import (
    Buckling,
    LateralBuckling,
    WebShear,
    buckling,
    lateral_buckling,
    web_shear,
)
from ..actions import Fact
from ..scenario import Scenario
from ..scenario.steelwork import SteelMember, Steelwork
from ..schema import given
from .equilibrium import loads_of
from .model import Model
from .utilisation import Utilisations

MOST_BARS_NAMED = 40

_KILO = 1e3

_WEB_NAMED = 0.05
"""Part of the resistance of a web that buckles from which on it is named."""


@dataclass(frozen=True, slots=True)
class BarUse:
    """What a bar carries, and the part of its resistance that this is.

    Attributes
    ----------
    axial_n : float
        Axial force of the largest size, above 0 in tension.
    bending_nm : float
        Largest moment, about any axis of the section.
    section_used : float
        Axial force, bending and shear of a section by what it resists plastically, as a run judges it.
    buckling_used : float
        Compression by what the bar resists in buckling; 0 for one that is pulled.
    lateral_used : float or None
        Bending about the strong axis by what the bar resists in lateral torsional buckling; None where it is not
        judged.
    web_used : float or None
        Shear along the webs by what these resist as they buckle; None of sections without a web between flanges.
    bolts_used : tuple of float or None
        Force on the farthest bolt of each end, by what a bolt resists; None of ends without a pattern.
    """

    name: str
    section: str
    grade: str
    length_m: float
    axial_n: float
    bending_nm: float
    section_used: float
    buckling_used: float
    buckling: Buckling
    lateral_used: float | None
    lateral: LateralBuckling | None
    web_used: float | None
    web: WebShear | None
    bolts_used: tuple[float | None, float | None]

    @property
    def used(self) -> float:
        by_bolts = [used or 0.0 for used in self.bolts_used]
        return max(self.section_used, self.buckling_used, self.lateral_used or 0.0, self.web_used or 0.0, *by_bolts)


def bar_uses(scenario: Scenario, model: Model, rest: Equilibrium) -> list[BarUse]:
    """Return what each bar of a model at rest carries, the most used first."""
    steel, steelwork = given(model.steel), given(scenario.steelwork)
    loads, judged = loads_of(model, rest), Utilisations(model, scenario.joints)
    whole = np.ones(len(model.connections))
    alone, _ = judged.of(loads, whole > 0.0, whole, judged.parts(whole > 0.0), every_section=False)
    forces = section_forces(judged.axes, loads.forces_n, loads.moments_nm)
    tables = {table.name: table for table in steelwork.all_members}
    uses = []
    rows_of_joints = steel.rows[: len(steel.joints.members)]
    for index in np.unique(steel.joints.members).tolist():
        is_mine = steel.joints.members == index
        rows, numbers = rows_of_joints[is_mine], steel.joints.numbers[is_mine]
        table, bar = tables[model.members[index].name], given(given(model.members[index].steel).bar)
        ends = (rows[numbers == 0], rows[numbers == bar.pieces])
        axial = forces.axial_n[rows]
        largest = float(axial[np.abs(axial).argmax()])
        yield_pa, _ = steelwork.yield_and_ultimate_pa(table)
        about_y, about_z = table.buckling_lengths
        strut = buckling(bar.section, yield_pa, (about_y * bar.length_m, about_z * bar.length_m))
        sideways = lateral_buckling(bar.section, yield_pa, about_z * bar.length_m)
        webs = web_shear(
            bar.section, yield_pa, table.stiffener_spacing_m or bar.length_m, rigid_end_posts=table.rigid_end_posts
        )
        along_web = float(np.abs(dot(loads.forces_n[rows], bar.axes[:, 2])).max())
        about_strong = float(np.abs(dot(loads.moments_nm[rows], bar.axes[:, 1])).max())
        uses.append(
            BarUse(
                name=table.name,
                section=bar.section.name,
                grade=steelwork.grade_of(table),
                length_m=bar.length_m,
                axial_n=largest,
                bending_nm=float(np.sqrt(np.square(forces.bending_nm[rows]).sum(axis=1)).max()),
                section_used=float(alone[rows].max()),
                buckling_used=max(0.0, -float(axial.min())) / strut.resistance_n,
                buckling=strut,
                lateral_used=about_strong / sideways.resistance_nm if sideways else None,
                lateral=sideways,
                web_used=along_web / webs.resistance_n if webs else None,
                web=webs,
                bolts_used=_bolts_used(steelwork, table, bar, loads, ends),
            )
        )
    return sorted(uses, key=lambda use: -use.used)


def steel_facts(scenario: Scenario, model: Model, rest: Equilibrium) -> Iterator[Fact]:
    """Yield what the bars of a model at rest carry, the most used first, and which would buckle."""
    uses = bar_uses(scenario, model, rest)
    mass_kg = float(sum_of_masses(model))
    yield "bars", f"{len(uses)}, {mass_kg / 1000.0:.1f} t of steel and of what nodes carry"
    if buckles := [use for use in uses if use.buckling_used > 1.0]:
        names = ", ".join(use.name for use in buckles[:MOST_BARS_NAMED])
        yield "buckle", f"{names}: pressed by more than EN 1993-1-1, 6.3.1 lets them resist"
    if turns := [use for use in uses if use.lateral_used and use.lateral_used > 1.0]:
        names = ", ".join(use.name for use in turns[:MOST_BARS_NAMED])
        yield (
            "buckle sideways",
            f"{names}: bent by more than EN 1993-1-1, 6.3.2.3 lets them resist; a run does not show it",
        )
    if thin := [use for use in uses if use.web and use.web.buckles and (use.web_used or 0.0) > 1.0]:
        names = ", ".join(use.name for use in thin[:MOST_BARS_NAMED])
        yield "webs buckle", f"{names}: sheared by more than EN 1993-1-5, 5.3 lets them resist; a run does not show it"
    if sheared := [use for use in uses if max(used or 0.0 for used in use.bolts_used) > 1.0]:
        names = ", ".join(use.name for use in sheared[:MOST_BARS_NAMED])
        yield "bolts", f"{names}: a bolt carries more than EN 1993-1-8, table 3.4 lets it resist"
    tables = {table.name: table for table in given(scenario.steelwork).all_members}
    for use in uses[:MOST_BARS_NAMED]:
        yield use.name, _text(use)
        yield from _bolt_facts(given(scenario.steelwork), tables[use.name], use)
    if len(uses) > MOST_BARS_NAMED:
        yield "", f"and {len(uses) - MOST_BARS_NAMED} more, used by {uses[MOST_BARS_NAMED].used:.0%} or less"


def sum_of_masses(model: Model) -> float:
    """Return the total mass of bars and nodes."""
    is_steel = np.array([member.steel is not None for member in model.members])[model.member_of_shard]
    return float(model.masses_kg[is_steel].sum())


def _bolts_used(
    steelwork: Steelwork, table: SteelMember, bar: SteelBar, loads: ConnectionLoads, ends: tuple[np.ndarray, np.ndarray]
) -> tuple[float | None, float | None]:
    """Return the force on the farthest bolt of each end of a bar, whose joints are given, by what a bolt resists."""
    used: list[float | None] = [None, None]
    for end, rows in enumerate(ends):
        joint = steelwork.bolted_end(table, end)
        if joint is not None and len(rows):
            along, across = bar.axes[:, 0], bar.axes[:, 1 + joint.part.along]
            axis = joint.bending_axis
            moment = np.zeros(1) if bar.turns[end, axis] else dot(loads.moments_nm[rows], bar.axes[:, 1 + axis])
            forces = (dot(loads.forces_n[rows], along), dot(loads.forces_n[rows], across), moment)
            used[end] = joint.farthest_bolt_used(*(float(force[0]) for force in forces))
    return used[0], used[1]


def _bolt_facts(steelwork: Steelwork, table: SteelMember, use: BarUse) -> Iterator[Fact]:
    """Yield what the bolts at the ends of a bar resist."""
    _, ultimate_pa = steelwork.yield_and_ultimate_pa(table)
    for end, node in enumerate(table.nodes):
        bolts, by_pattern = table.bolts(end), steelwork.bolted_end(table, end)
        if by_pattern is not None:
            share = steelwork.end_share(table, end)
            yield (
                "",
                f"{given(table.end_bolts)[end]} at {node}: {_pattern_text(by_pattern, share, use.bolts_used[end])}",
            )
        elif bolts is not None:
            net_n = bolts.net_section_n(table.steel_section, ultimate_pa)
            yield (
                "",
                f"{given(table.end_bolts)[end]} at {node}: resist {bolts.shear_n / 1e3:.1f} kN in shear, the section "
                f"between holes {net_n / 1e3:.1f} kN, {steelwork.end_share(table, end):.0%} of the bar",
            )


def _pattern_text(joint: BoltedEnd, share: float, used: float | None) -> str:
    block = "" if joint.block_n == math.inf else f", a block {joint.block_n / _KILO:.1f} kN"
    moment = f" and {joint.moment_nm / _KILO:.2f} kN·m" if joint.moment_nm else ""
    farthest = "" if used is None else f"; the farthest bolt is used by {used:.0%}"
    return (
        f"resist {joint.bolts_n / _KILO:.1f} kN in shear and bearing, the section between holes "
        f"{joint.net_n / _KILO:.1f} kN{block}, {share:.0%} of the bar; across it {joint.shear_n / _KILO:.1f} kN{moment}"
        f"{farthest}"
    )


def _text(use: BarUse) -> str:
    pulled = "pulled" if use.axial_n >= 0.0 else "pressed"
    text = (
        f"{use.section}, {use.grade}, {use.length_m:.2f} m: {pulled} by {abs(use.axial_n) / 1e3:.1f} kN, "
        f"{use.bending_nm / 1e3:.1f} kN·m, {use.section_used:.0%} of its section"
    )
    if use.buckling_used > 0.0:
        strut = use.buckling
        text += (
            f", {use.buckling_used:.0%} of {strut.resistance_n / 1e3:.0f} kN in buckling about {strut.axis}, "
            f"curve {strut.curve}, χ = {strut.reduction:.2f}"
        )
    if use.lateral and use.lateral_used and use.lateral_used > use.section_used:
        text += (
            f", {use.lateral_used:.0%} of {use.lateral.resistance_nm / 1e3:.0f} kN·m in lateral torsional buckling, "
            f"curve {use.lateral.curve}, χ_LT = {use.lateral.reduction:.2f}"
        )
    if use.web and use.web.buckles and (use.web_used or 0.0) >= _WEB_NAMED:
        text += (
            f", {use.web_used:.0%} of {use.web.resistance_n / 1e3:.0f} kN in shear of its web, which buckles, "
            f"λ = {use.web.slenderness:.2f}, χ = {use.web.reduction:.2f}"
        )
    return text
