"""Bars by ratios of steel, without a design."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..bridge.member import Member, members_named, own_axes
from ..materials import BarLayer
from ..scenario import RatiosOfMember
from ..scenario.arch import ARCH_KIND
from ..scenario.bridge_checks import arch_axis
from .design_basis import DesignBasis
from .schedule import ScheduledBars, ScheduledLinks

_MM2 = 1e6
_PERCENT = 0.01
_SIDES = {
    "bottom_percent": ("bottom", "x"),
    "top_percent": ("top", "x"),
    "across_bottom_percent": ("bottom", "y"),
    "across_top_percent": ("top", "y"),
}
_UPRIGHT_SIDES = ("start", "end", "right", "left")
_REASON = "ratio"


def ratio_bars(basis: DesignBasis) -> Iterator[ScheduledBars | ScheduledLinks]:
    """Yield the bars and links of all members that ratios are given for; of the last that names it."""
    tables: dict[int, RatiosOfMember] = {}
    for table in basis.rule.ratios:
        for index in members_named(table.member, basis.members, f"{table.table}.member"):
            tables[index] = table
    for index, table in sorted(tables.items()):
        yield from _of_member(basis, basis.members[index], table)


def _of_member(basis: DesignBasis, member: Member, table: RatiosOfMember) -> Iterator[ScheduledBars | ScheduledLinks]:
    extents = _sizes(basis, member)
    outside = basis.rule.cover_m + basis.link_m + 0.5 * basis.bar_m
    for name, (side, along) in _SIDES.items():
        if ratio := getattr(table, name):
            inside = outside + (basis.bar_m if along == "y" else 0.0)
            yield _layer(basis, member, side, along, inside, _PERCENT * ratio, extents)
    if table.upright_percent and member.directions:
        yield _inclined(basis, member, _PERCENT * table.upright_percent, extents)
    elif table.upright_percent:
        for side in _UPRIGHT_SIDES:
            yield _layer(basis, member, side, "z", outside, 0.25 * _PERCENT * table.upright_percent, extents)
    if table.links_percent:
        yield _links(basis, member, _PERCENT * table.links_percent, extents)


def _sizes(basis: DesignBasis, member: Member) -> np.ndarray:
    """Return length, width and height (3,) of a member without skew; along its own axes of an arch and haunches."""
    if not member.is_in_pieces:
        return np.ptp(member.without_skew(member.solid.vertices), axis=0)
    axes = own_axes(member)
    length = arch_axis(basis.bridge).length_m if member.kind == ARCH_KIND else axes.length_m
    return np.array([length, axes.width_m, axes.height_m])


def _layer(
    basis: DesignBasis, member: Member, side: str, along: str, depth_m: float, ratio: float, extents: np.ndarray
) -> ScheduledBars:
    length = float(extents["xyz".index(along)])
    section = member.volume_m3 / length
    thickness = float(extents[{"bottom": 2, "top": 2, "start": 0, "end": 0}.get(side, 1)])
    if depth_m >= 0.5 * thickness:
        raise basis.rule.unexpected(
            "cover_m",
            f"less: the bars of {member.name}, {thickness:g} m thick, would be {depth_m:.3f} m below its side",
        )
    layer = BarLayer(
        members=(member.name,),
        along=along,
        side=side,
        depth_m=depth_m,
        area_mm2=ratio * section * _MM2,
        yield_n_mm2=basis.yield_pa / _MM2,
        diameter_mm=basis.rule.bar_diameter_mm,
        own_axes=member.is_in_pieces,
    )
    return ScheduledBars(layer, member.kind, None, section, ratio * section, _REASON, length)


def _inclined(basis: DesignBasis, member: Member, ratio: float, extents: np.ndarray) -> ScheduledBars:
    """Return the upright bars of an inclined leg: spread, as of both faces, and as many across its slope."""
    _, up = member.directions[0]
    height = float(extents[2])
    section = member.volume_m3 / height
    layer = BarLayer(
        members=(member.name,),
        along="z",
        spread_mm2_m2=ratio / up * _MM2,
        yield_n_mm2=basis.yield_pa / _MM2,
        diameter_mm=basis.rule.bar_diameter_mm,
    )
    return ScheduledBars(layer, member.kind, None, section, ratio / up * section, _REASON, height)


def _links(basis: DesignBasis, member: Member, ratio: float, extents: np.ndarray) -> ScheduledLinks:
    along = int(np.argmax(extents))
    width, height = sorted(np.delete(extents, along).tolist(), reverse=True)
    area = ratio * width * _MM2
    cover = basis.rule.cover_m
    return ScheduledLinks(
        members=(member.name,),
        kind=member.kind,
        link_area_mm2_per_m=area,
        required_mm2_per_m=area,
        reason=_REASON,
        legs=2,
        diameter_m=0.0,
        spacing_m=0.0,
        width_m=width,
        loop_m=2.0 * (width + height - 4.0 * cover),
        length_m=float(extents[along]),
    )
