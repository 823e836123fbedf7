"""Bars of decks and girders from files: beams over the supports that they rest on."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ...engineering.arrays import FloatArray
from ...engineering.reinforced_concrete.influence_lines import InfluenceLines, MovingLoad, influence_lines
from ...engineering.reinforced_concrete.least_areas import SECONDARY_SHARE
from ...engineering.reinforced_concrete.resistance import PressedShape, flange_width_m
from ...engineering.reinforced_concrete.traffic import Traffic, lever_rule, strip_widths_m
from ...texts import Text
from ..bridge.member import own_axes
from .design_basis import LEAST, BeamEffects, Tension, beam_effects
from .file_members import ADVICE, FileDesign, LyingSection, Rows, in_own_axes
from .load_paths import Superstructure, carriers_of
from .schedule import ScheduledLinks
from .superstructure import AT_SIMPLE_END, MOST_COVERED, through_and_over_supports, where_above

_KILO = 1e3
_STRIPS = 200
_LEAST_OVERHANG_M = 0.3


@dataclass(frozen=True, slots=True, eq=False)
class FileDeckLine:
    """A superstructure as a beam over its supports, with its traffic and its permanent load by length."""

    part: Superstructure
    lines: InfluenceLines
    traffic: Traffic | None
    permanent_n_m: float

    @property
    def supports_m(self) -> list[float]:
        return [support.station_m for support in self.part.supports]

    @property
    def moving(self) -> Sequence[MovingLoad]:
        return self.traffic.on_whole_width() if self.traffic else ()


def file_deck_line(basis: FileDesign, part: Superstructure) -> FileDeckLine | None:
    """Return a superstructure as a beam; None where it rests on nothing."""
    if not part.supports:
        return None
    rule, length, width = basis.design.rule, part.axes.length_m, part.axes.width_m
    at = [support.station_m for support in part.supports]
    lines = influence_lines(at, min(0.0, at[0]), max(length, at[-1]))
    carriageway = min(rule.carriageway_m or width, width)
    permanent = basis.weight_n(part.all) / length + _KILO * rule.permanent_kn_m2 * carriageway
    return FileDeckLine(part, lines, rule.traffic(carriageway), permanent)


def file_deck_bars(basis: FileDesign, line: FileDeckLine) -> Rows:
    """Yield the bars of decks and girders."""
    girders = [index for index in line.part.girders if basis.members[index].kind == "girder"]
    effects = beam_effects(line.lines, line.permanent_n_m, line.moving)
    if not girders:
        for index in line.part.decks:
            if index in basis.concrete:
                yield from basis.rows_or_least(index, in_own_axes(_slab(basis, line, index, effects)))
        return
    for index in girders:
        if index in basis.concrete:
            yield from basis.rows_or_least(index, in_own_axes(_girder(basis, line, index, girders)))
    for index in line.part.decks:
        if index in basis.concrete:
            rows = in_own_axes(_slab_on_girders(basis, line, index, girders, effects))
            yield from basis.rows_or_least(index, rows)


def _slab(basis: FileDesign, line: FileDeckLine, index: int, effects: BeamEffects) -> Rows:
    """Yield the bars of a slab that spans along the road."""
    design, member = basis.design, basis.members[index]
    section, cover = LyingSection.of(member), design.rule.cover_m
    axes, name = section.axes, member.name
    begin, end = _range(line, basis, index)
    inside = (line.lines.points_m >= begin) & (line.lines.points_m <= end)
    sagging = float(max(effects.largest_nm[inside].max(initial=0.0), 0.0))
    hogging = float(max(-effects.least_nm[inside].min(initial=0.0), AT_SIMPLE_END[True] * sagging))
    height, width, length = axes.height_m, axes.width_m, axes.length_m
    area = member.volume_m3 / length
    outside = cover if section.is_slab else cover + design.link_m

    def below(moment_nm: float) -> Tension:
        return design.tension(
            name,
            moment_nm,
            section.sagging,
            bars_width_m=section.bottom_m,
            outside_m=outside,
            is_slab=section.is_slab,
            advice=ADVICE,
        )

    def above(moment_nm: float) -> Tension:
        return design.tension(
            name, moment_nm, section.hogging, bars_width_m=width, outside_m=cover, is_slab=True, advice=ADVICE
        )

    bottom = basis.as_much_as_fits(name, "the moment in the span", sagging, below)
    top = basis.as_much_as_fits(name, "the moment over a support", hogging, above)
    kind = member.kind
    yield design.scheduled([name], kind, "bottom", "x", bottom, section_m2=area, length_m=length)
    yield from _top_bars(basis, line, index, top, effects, area)
    for side, main, across_nm in (("bottom", bottom, 0.0), ("top", top, _overhang_moment_nm(line, section))):
        found = _across(basis, name, main, across_nm, height, width, length)
        yield design.scheduled([name], kind, side, "y", found, section_m2=height * length, length_m=width)
    depth = height - bottom.depth_m
    shear = effects.shear_beyond_n(line.supports_m, depth)
    yield from _links(basis, index, section, shear, bottom, depth, is_slab=section.is_slab)


def _links(
    basis: FileDesign,
    index: int,
    section: LyingSection,
    shear_n: float,
    bottom: Tension,
    depth_m: float,
    *,
    is_slab: bool,
) -> Rows:
    """Yield the links of a deck or girder, if it needs any."""
    member = basis.members[index]

    def needed(of_shear_n: float) -> ScheduledLinks | None:
        return basis.design.links_for(
            [member.name],
            member.kind,
            of_shear_n,
            width_m=section.sagging.web_m,
            webs=1,
            height_m=section.axes.height_m,
            depth_m=depth_m,
            bars_m2=bottom.choice.area_m2,
            length_m=section.axes.length_m,
            advice=ADVICE,
            is_slab=is_slab,
        )

    if row := basis.as_much_as_fits(member.name, "the shear force", shear_n, needed):
        yield row


def _range(line: FileDeckLine, basis: FileDesign, index: int) -> tuple[float, float]:
    """Return from where to where a member goes along the line of its superstructure."""
    stations = line.part.axes.from_world(basis.members[index].solid.vertices)[:, 0]
    return float(stations.min()) - 1e-6, float(stations.max()) + 1e-6


def _across(
    basis: FileDesign, name: str, main: Tension, moment_nm: float, height_m: float, width_m: float, length_m: float
) -> Tension:
    """Return bars across main ones, inside of these: a part of them, or those for a moment."""
    design = basis.design
    share = SECONDARY_SHARE * main.required_m2 / width_m * length_m
    outside = main.depth_m + 0.5 * main.choice.diameter_m
    if moment_nm <= 0.0:
        return design.least_bars(
            name, height_m, length_m, share, outside, Text("{} of the main bars", f"{SECONDARY_SHARE:.0%}")
        )
    shape = PressedShape.rectangle(height_m, length_m)

    def needed(of_moment_nm: float) -> Tension:
        return design.tension(
            name,
            of_moment_nm,
            shape,
            bars_width_m=length_m,
            outside_m=outside,
            least_m2=lambda _: share,
            is_slab=True,
            preferred_m=design.secondary_m,
            advice=ADVICE,
        )

    return basis.as_much_as_fits(name, "the moment across the road", moment_nm, needed)


def _overhang_moment_nm(line: FileDeckLine, section: LyingSection) -> float:
    """Return the moment of what cantilevers out from the underside, over the whole length of the deck."""
    axes = section.axes
    half, root = 0.5 * axes.width_m, 0.5 * section.bottom_m
    if half - root < _LEAST_OVERHANG_M:
        return 0.0
    by_area = line.permanent_n_m / axes.width_m
    lines = influence_lines([-root, root], -half, half)
    beyond = half - root - (line.traffic.clear_m(2.0 * half) if line.traffic else 0.0)
    _, strip = strip_widths_m(2.0 * root, beyond)
    wheels = line.traffic.wheels_across(strip, 2.0 * half) if line.traffic else ()
    return beam_effects(lines, by_area, wheels).hogging_nm * axes.length_m


def _top_bars(
    basis: FileDesign, line: FileDeckLine, index: int, found: Tension, effects: BeamEffects, area_m2: float
) -> Rows:
    """Yield the bars along the top: half of them all along it, and the others over its supports."""
    member = basis.members[index]
    length, choice = own_axes(member).length_m, found.choice
    through = -(-choice.number // 2)
    share, shift = through / choice.number, 0.5 * 0.9 * 2.5 * (own_axes(member).height_m - found.depth_m)
    parts = where_above(effects.lines.points_m, -effects.least_nm, share * effects.hogging_nm, shift)
    covered = math.fsum(min(end, length) - max(begin, 0.0) for begin, end in parts)
    is_least = found.reason == LEAST or not parts or covered > MOST_COVERED * length
    if is_least or len(line.part.decks) > 1 or len(line.supports_m) < 3 or choice.number < 4:
        yield basis.design.scheduled([member.name], member.kind, "top", "x", found, section_m2=area_m2, length_m=length)
        return
    for part, between in through_and_over_supports(found, through, parts):
        yield basis.design.scheduled(
            [member.name],
            member.kind,
            "top",
            "x",
            part,
            section_m2=area_m2,
            length_m=length if between is None else min(between[1], length) - max(between[0], 0.0),
            between_m=between,
        )


# Girders --------------------------------------------------------------------------------------------------------------


def _girder(basis: FileDesign, line: FileDeckLine, index: int, girders: Sequence[int]) -> Rows:
    """Yield the bars of a girder: a beam between its own supports, with its part of the deck and of the traffic."""
    design, member = basis.design, basis.members[index]
    slab, beside = _slab_thickness_m(basis, line), _abreast(basis, line, index, girders)
    middles: FloatArray = np.array([at for at, _ in beside])
    number = [other for _, other in beside].index(index)
    width = line.part.axes.width_m
    spacing = float(np.diff(middles).min()) if len(middles) > 1 else width
    axes = own_axes(member)
    at = _stations_of_girder(basis, index)
    lines = influence_lines(at, min(0.0, at[0]), max(axes.length_m, at[-1]))
    span = max(np.diff(at).max(initial=0.0), 0.5 * axes.length_m)
    web = axes.web_m
    sides = max(0.5 * (spacing - web), 0.0)
    flange = flange_width_m(web, (sides, sides), float(span)) if slab else 0.0
    section = LyingSection.of(member, slab, flange)
    share = lever_rule(middles, number) if len(middles) > 1 else _whole
    others = [other for other in line.part.all if other not in girders]
    by_area = basis.weight_n(others) / line.part.axes.length_m / width + _KILO * design.rule.permanent_kn_m2
    strip = width / _STRIPS
    across: FloatArray = strip * (np.arange(_STRIPS, dtype=float) + 0.5) - 0.5 * width
    permanent = design.weight_n(member) / axes.length_m + by_area * float(share(across).sum()) * strip
    effects = beam_effects(lines, permanent, line.traffic.on_part(share) if line.traffic else ())
    yield from beam_rows(basis, index, section, effects, at)


def _whole(across_m: np.ndarray) -> np.ndarray:
    return np.ones(np.shape(across_m))


def _abreast(basis: FileDesign, line: FileDeckLine, index: int, girders: Sequence[int]) -> list[tuple[float, int]]:
    """Return the girders abreast of one in its middle, with their positions across the road, from right to left.

    Of girders one above the other one counts, itself among its own.
    """
    axes = line.part.axes
    middle = axes.from_world(basis.members[index].solid.bounds.mean(axis=0)[None])[0]
    found = []
    for other in girders:
        begin, end = _range(line, basis, other)
        if begin <= middle[0] <= end:
            points = axes.from_world(basis.members[other].solid.vertices)
            found.append((float(0.5 * (points[:, 1].min() + points[:, 1].max())), other))
    apart: list[tuple[float, int]] = []
    for at, other in sorted(found):
        if not apart or at - apart[-1][0] >= 0.5 * own_axes(basis.members[other]).web_m:
            apart.append((at, other))
        elif other == index:
            apart[-1] = at, other
    return apart


def _stations_of_girder(basis: FileDesign, index: int) -> list[float]:
    """Return where a girder rests, along itself; its ends where it rests on less than two supports."""
    axes = own_axes(basis.members[index])
    points = [contact.point_m for contact in carriers_of(index, basis.contacts)]
    stations = sorted(axes.from_world(np.array(points).reshape(-1, 3))[:, 0].tolist())
    apart: list[float] = []
    for station in stations:
        if not apart or station - apart[-1] > axes.height_m:
            apart.append(station)
    return apart if len(apart) > 1 else [0.0, axes.length_m]


def _slab_thickness_m(basis: FileDesign, line: FileDeckLine) -> float:
    """Return the mean thickness of the decks of concrete on girders; 0 without one."""
    decks = [basis.members[index] for index in line.part.decks if index in basis.concrete]
    plan = math.fsum(own_axes(deck).length_m * own_axes(deck).width_m for deck in decks)
    return math.fsum(deck.volume_m3 for deck in decks) / plan if decks else 0.0


def beam_rows(
    basis: FileDesign, index: int, section: LyingSection, effects: BeamEffects, supports_m: Sequence[float]
) -> Rows:
    """Yield bars along both sides of a beam, and its links."""
    design, member = basis.design, basis.members[index]
    name, kind, axes = member.name, member.kind, section.axes
    outside = design.rule.cover_m + design.link_m
    area, length = member.volume_m3 / axes.length_m, axes.length_m
    own = PressedShape.rectangle(axes.height_m, section.bottom_m)

    def along(shape: PressedShape, width_m: float) -> Callable[[float], Tension]:
        def needed(moment_nm: float) -> Tension:
            return design.tension(name, moment_nm, shape, bars_width_m=width_m, outside_m=outside, advice=ADVICE)

        return needed

    hogging = max(effects.hogging_nm, AT_SIMPLE_END[False] * effects.sagging_nm)
    bottom = basis.as_much_as_fits(
        name, "the moment in the span", effects.sagging_nm, along(section.sagging, section.bottom_m)
    )
    top_m = axes.width_at_m(0.9 * axes.height_m)
    top = basis.as_much_as_fits(name, "the moment over a support", hogging, along(own, top_m))
    for side, found in (("bottom", bottom), ("top", top)):
        yield design.scheduled([name], kind, side, "x", found, section_m2=area, length_m=length)
    depth = section.sagging.height_m - bottom.depth_m

    yield from _links(basis, index, section, effects.shear_beyond_n(supports_m, depth), bottom, depth, is_slab=False)


def _slab_on_girders(
    basis: FileDesign, line: FileDeckLine, index: int, girders: Sequence[int], effects: BeamEffects
) -> Rows:
    """Yield the bars of a slab that spans across the road, over girders."""
    design, member = basis.design, basis.members[index]
    axes, name, kind = own_axes(member), member.name, member.kind
    width, length = axes.width_m, axes.length_m
    slab = member.volume_m3 / (width * length)
    middles = [at for at, _ in _abreast(basis, line, girders[len(girders) // 2], girders)]
    half = 0.5 * width
    lines = influence_lines(middles, min(-half, middles[0]), max(half, middles[-1]))
    span = float(np.diff(middles).max()) if len(middles) > 1 else 0.0
    beyond = half - middles[-1] - (line.traffic.clear_m(width) if line.traffic else 0.0)
    by_area = design.weight_n(member) / (width * length) + _KILO * design.rule.permanent_kn_m2
    sag, hog = (
        beam_effects(lines, by_area, line.traffic.wheels_across(strip, width) if line.traffic else ())
        for strip in strip_widths_m(span, beyond)
    )
    web = min(own_axes(basis.members[other]).web_m for other in girders)
    moments = {
        "bottom": sag.sagging_nm,
        "top": max(hog.hogging_beyond_nm(middles, 0.5 * web), AT_SIMPLE_END[True] * sag.sagging_nm),
    }
    shape, cover = PressedShape.rectangle(slab, length), design.rule.cover_m
    for side, moment in moments.items():

        def needed(moment_nm: float) -> Tension:
            return design.tension(
                name,
                moment_nm,
                shape,
                bars_width_m=length,
                outside_m=cover,
                is_slab=True,
                preferred_m=design.secondary_m,
                advice=ADVICE,
            )

        across = basis.as_much_as_fits(name, "the moment across the road", moment * length, needed)
        yield design.scheduled([name], kind, side, "y", across, section_m2=slab * length, length_m=width)
        share = SECONDARY_SHARE * across.required_m2 / length * width
        outside = across.depth_m + 0.5 * across.choice.diameter_m
        along = design.least_bars(
            name, slab, width, share, outside, Text("{} of the main bars", f"{SECONDARY_SHARE:.0%}")
        )
        yield design.scheduled([name], kind, side, "x", along, section_m2=slab * width, length_m=length)
