"""Bars of decks: slabs along the road, girders under slabs, and box girders."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ...engineering.reinforced_concrete.influence_lines import (
    InfluenceLines,
    MovingLoad,
    influence_lines,
)
from ...engineering.reinforced_concrete.least_areas import SECONDARY_SHARE, BarChoice
from ...engineering.reinforced_concrete.resistance import PressedShape, flange_width_m
from ...engineering.reinforced_concrete.traffic import lever_rule, strip_widths_m
from ...texts import Text
from ..bridge.layout import deck_ends, pier_axes
from ..bridge.member import Member
from ..schema import given
from .design_basis import LEAST, BeamEffects, DesignBasis, Tension, beam_effects
from .schedule import ScheduledBars, ScheduledLinks

Rows = Iterator[ScheduledBars | ScheduledLinks]

_KILO = 1e3
AT_SIMPLE_END = {True: 0.25, False: 0.15}
"""Moment at an end that is free to turn in design, by that in the span, of slabs and beams: EN 1992-1-1:2004, 9.3.1.2
(2) and 9.2.1.2 (1)."""


_STRIPS = 400
"""Strips of a deck whose weights are shared out to the girders."""

MOST_COVERED = 0.8
"""Part of a deck from which on bars over its supports may as well run all along it."""


@dataclass(frozen=True, slots=True, eq=False)
class DeckLine:
    """A deck as a beam along the road: its members, and the supports that it lies on, by number from 0."""

    deck: Member
    girders: tuple[Member, ...]
    supports: tuple[int, ...]
    supports_m: tuple[float, ...]
    lines: InfluenceLines
    length_m: float

    @property
    def between_zeros_m(self) -> float:
        """Least distance between points where the moment is 0 in a span: EN 1992-1-1:2004, figure 5.2."""
        spans = np.diff(self.supports_m).tolist()
        if len(spans) == 1:
            return float(spans[0])
        return min([0.85 * spans[0], 0.85 * spans[-1], *(0.7 * span for span in spans[1:-1])])


def deck_lines(basis: DesignBasis) -> list[DeckLine]:
    """Return all decks of a bridge, in their order along the road."""
    bridge, axes = basis.bridge, pier_axes(basis.bridge).tolist()
    decks, girders = basis.of_kind("deck"), basis.of_kind("girder")
    ends, number = deck_ends(bridge), bridge.girders.number if bridge.girders else 0
    found = []
    for index, (deck, (begin, end)) in enumerate(zip(decks, ends, strict=True)):
        supports = tuple(range(len(axes))) if len(ends) == 1 else (index, index + 1)
        at = tuple(axes[support] for support in supports)
        lines = influence_lines(at, min(begin, at[0]), max(end, at[-1]))
        own = tuple(girders[index * number : (index + 1) * number])
        found.append(DeckLine(deck, own, supports, at, lines, end - begin))
    return found


def deck_weight_n_m(basis: DesignBasis, line: DeckLine) -> float:
    """Return the permanent load of a deck and its girders by length."""
    weight = math.fsum(basis.weight_n(member) for member in (line.deck, *line.girders))
    return weight / line.length_m + _KILO * basis.rule.permanent_kn_m2 * basis.bridge.deck.width_m


def whole_traffic(basis: DesignBasis) -> Sequence[MovingLoad]:
    return basis.traffic.on_whole_width() if basis.traffic else ()


def deck_bars(basis: DesignBasis, line: DeckLine) -> Rows:
    """Yield the bars and links of a deck and its girders."""
    if basis.bridge.girders:
        yield from _girder_deck(basis, line)
    elif basis.bridge.box_girder:
        yield from _box_girder(basis, line)
    else:
        yield from _slab(basis, line)


def _slab(basis: DesignBasis, line: DeckLine) -> Rows:
    deck, cover = basis.bridge.deck, basis.rule.cover_m
    name, height, width, length = line.deck.name, deck.thickness_m, deck.width_m, line.length_m
    effects = beam_effects(line.lines, deck_weight_n_m(basis, line), whole_traffic(basis))
    shape, advice = PressedShape.rectangle(height, width), "take a larger bridge.deck.thickness_m, or a lighter load"

    def along(moment_nm: float) -> Tension:
        return basis.tension(name, moment_nm, shape, bars_width_m=width, outside_m=cover, is_slab=True, advice=advice)

    bottom, top = along(effects.sagging_nm), along(_top_moment_nm(effects, is_slab=True))
    yield basis.scheduled([name], "deck", "bottom", "x", bottom, section_m2=height * width, length_m=length)
    yield _secondary(basis, name, "bottom", "y", bottom, height, width, length)
    yield from _top_bars(basis, line, top, effects, height, height)
    yield _secondary(basis, name, "top", "y", top, height, width, length)
    yield from _links(basis, [name], "deck", effects, line, bottom, width, 1, height, is_slab=True, advice=advice)


def _top_moment_nm(effects: BeamEffects, *, is_slab: bool) -> float:
    """Return the moment that bars along the top are for: over supports, or at ends that turn less than thought."""
    return max(effects.hogging_nm, AT_SIMPLE_END[is_slab] * effects.sagging_nm)


def _top_bars(
    basis: DesignBasis, line: DeckLine, found: Tension, effects: BeamEffects, height_m: float, slab_m: float
) -> Rows:
    """Yield the bars along the top of a deck: half of them all along it, and the others over its supports.

    These end where half of the largest moment is left, and farther by the shift of 9.2.1.3 (2) with z = 0.9 d and
    cot θ = 2.5. A section with half of the bars resists more than half of the moment, as its lever arm is longer.
    """
    choice, width = found.choice, basis.bridge.deck.width_m
    through = -(-choice.number // 2)
    shift = 0.5 * 0.9 * 2.5 * (height_m - found.depth_m)
    share = through / choice.number
    parts = where_above(effects.lines.points_m, -effects.least_nm, share * effects.hogging_nm, shift)
    ends = line.lines.points_m[0], line.lines.points_m[-1]
    covered = math.fsum(min(end, ends[1]) - max(begin, ends[0]) for begin, end in parts)
    is_least = found.reason == LEAST or not parts or covered > MOST_COVERED * line.length_m
    if is_least or len(line.supports_m) < 3 or choice.number < 4:
        yield basis.scheduled(
            [line.deck.name], "deck", "top", "x", found, section_m2=slab_m * width, length_m=line.length_m
        )
        return
    for part, between in through_and_over_supports(found, through, parts):
        yield basis.scheduled(
            [line.deck.name],
            "deck",
            "top",
            "x",
            part,
            section_m2=slab_m * width,
            length_m=_length_m(between, ends, line.length_m),
            between_m=between,
        )


def through_and_over_supports(
    found: Tension, through: int, parts: Sequence[tuple[float, float]]
) -> Iterator[tuple[Tension, tuple[float, float] | None]]:
    """Yield a number of bars that go all along a deck, and the others for each part in which they lie."""
    choice = found.choice
    room = (choice.number - 1) * choice.spacing_m
    stretches: Sequence[tuple[float, float] | None]
    for number, stretches in ((through, [None]), (choice.number - through, parts)):
        own = BarChoice(number, choice.diameter_m, 1, room / max(number - 1, 1))
        part = Tension(own, found.depth_m, found.required_m2 * number / choice.number, found.reason)
        for between in stretches:
            yield part, between


def where_above(points_m: np.ndarray, values: np.ndarray, limit: float, shift_m: float) -> list[tuple[float, float]]:
    """Return from where to where values are above a limit, each longer by a shift at both ends; what meets is one."""
    parts: list[tuple[float, float]] = []
    above = np.flatnonzero(values > limit)
    runs = np.split(above, np.flatnonzero(np.diff(above) > 1) + 1)
    for run in (run for run in runs if len(run)):
        begin, end = float(points_m[run[0]]) - shift_m, float(points_m[run[-1]]) + shift_m
        if parts and begin <= parts[-1][1]:
            parts[-1] = parts[-1][0], end
        else:
            parts.append((begin, end))
    return parts


def _length_m(between_m: tuple[float, float] | None, ends_m: tuple[float, float], whole_m: float) -> float:
    return whole_m if between_m is None else min(between_m[1], ends_m[1]) - max(between_m[0], ends_m[0])


def _secondary(
    basis: DesignBasis,
    name: str,
    side: str,
    along: str,
    main: Tension,
    height_m: float,
    main_width_m: float,
    width_m: float,
    depth_from: float | None = None,
) -> ScheduledBars:
    """Return the bars of a slab across its main ones, inside of these.

    Main bars lie over `main_width_m`, those across them over `width_m`. With `depth_from` the depth below the side is
    that less the one of the bars in their slab.
    """
    area = SECONDARY_SHARE * main.required_m2 / main_width_m * width_m
    outside = main.depth_m + 0.5 * main.choice.diameter_m
    found = basis.least_bars(
        name, height_m, width_m, area, outside, Text("{} of the main bars", f"{SECONDARY_SHARE:.0%}")
    )
    depth = None if depth_from is None else depth_from - found.depth_m
    return basis.scheduled(
        [name],
        "deck",
        side,
        along,
        found,
        section_m2=height_m * width_m,
        length_m=main_width_m,
        depth_m=depth,
    )


def _links(
    basis: DesignBasis,
    names: Sequence[str],
    kind: str,
    effects: BeamEffects,
    line: DeckLine,
    bars: Tension,
    width_m: float,
    webs: int,
    height_m: float,
    *,
    is_slab: bool,
    advice: str,
) -> Rows:
    """Yield the links for the shear at a distance of d from the supports, EN 1992-1-1:2004, 6.2.1 (8)."""
    depth = height_m - bars.depth_m
    row = basis.links_for(
        names,
        kind,
        effects.shear_beyond_n(line.supports_m, depth),
        width_m=width_m,
        webs=webs,
        height_m=height_m,
        depth_m=depth,
        bars_m2=bars.choice.area_m2,
        length_m=line.length_m,
        advice=advice,
        is_slab=is_slab,
        has_slab=kind == "girder",
    )
    if row:
        yield row


def _girder_deck(basis: DesignBasis, line: DeckLine) -> Rows:
    bridge, girders, cover = basis.bridge, given(basis.bridge.girders), basis.rule.cover_m
    slab, web = bridge.deck.thickness_m, girders.width_m
    height, width, length = girders.depth_m + slab, bridge.deck.width_m, line.length_m
    axes = bridge.girder_spacing_m * (np.arange(girders.number) - (girders.number - 1) / 2.0)
    sides = 0.5 * (bridge.girder_spacing_m - web) if girders.number > 1 else 0.5 * (width - web)
    flange = min(flange_width_m(web, (sides, sides), line.between_zeros_m), width)
    advice = "take a larger bridge.girders.depth_m or width_m, or a lighter load"
    names = [girder.name for girder in line.girders]
    worst = _of_girders(basis, line, axes)

    across_bottom, across_top = _slab_across(basis, line, axes, web)
    sagging = max(effects.sagging_nm for effects in worst)
    bottom = basis.tension(
        names[0],
        sagging,
        PressedShape(height, web, flange, slab),
        bars_width_m=web,
        outside_m=cover + basis.link_m,
        advice=advice,
    )
    yield basis.scheduled(names, "girder", "bottom", "x", bottom, section_m2=web * girders.depth_m, length_m=length)
    strongest = max(worst, key=lambda effects: float(effects.shears_n.max()))
    yield from _links(basis, names, "girder", strongest, line, bottom, web, 1, height, is_slab=False, advice=advice)
    hogging = max(worst, key=lambda effects: _top_moment_nm(effects, is_slab=False))
    yield from _slab_of_beams(
        basis, line, across_bottom, across_top, hogging, PressedShape.rectangle(height, web), girders.number, advice
    )


def _of_girders(basis: DesignBasis, line: DeckLine, axes: np.ndarray) -> list[BeamEffects]:
    """Return the effects on each girder of one half, by the lever rule."""
    width = basis.bridge.deck.width_m
    by_area = basis.weight_n(line.deck) / line.length_m / width + _KILO * basis.rule.permanent_kn_m2
    strip = width / _STRIPS
    across = np.asarray(strip * (np.arange(_STRIPS) + 0.5) - 0.5 * width, np.float64)
    effects = []
    for number in range((len(axes) + 1) // 2):
        share = lever_rule(axes, number)
        own = basis.weight_n(line.girders[number]) / line.length_m
        permanent = own + by_area * float(share(across).sum()) * strip
        moving = basis.traffic.on_part(share) if basis.traffic else ()
        effects.append(beam_effects(line.lines, permanent, moving))
    return effects


def _slab_across(basis: DesignBasis, line: DeckLine, beams_m: np.ndarray, web_m: float) -> tuple[Tension, Tension]:
    """Return the bars across the road at the bottom and the top of a slab on girders or webs."""
    bridge, length, cover = basis.bridge, line.length_m, basis.rule.cover_m
    slab, half = bridge.deck.thickness_m, 0.5 * bridge.deck.width_m
    by_area = bridge_slab_n_m2(basis, line) + _KILO * basis.rule.permanent_kn_m2
    span = float(np.diff(beams_m).max()) if len(beams_m) > 1 else 0.0
    lines = influence_lines(beams_m.tolist(), -half, half)
    beyond = half - float(beams_m[-1]) - (basis.traffic.clear_m(2.0 * half) if basis.traffic else 0.0)
    strips = strip_widths_m(span, beyond)
    sag, hog = (
        beam_effects(lines, by_area, basis.traffic.wheels_across(strip, 2.0 * half) if basis.traffic else ())
        for strip in strips
    )
    shape = PressedShape.rectangle(slab, length)
    hogging = max(hog.hogging_beyond_nm(beams_m.tolist(), 0.5 * web_m), AT_SIMPLE_END[True] * sag.sagging_nm)

    def bars(moment_nm: float) -> Tension:
        return basis.tension(
            f"slab of {line.deck.name}, across the road,",
            moment_nm * length,
            shape,
            bars_width_m=length,
            outside_m=cover,
            is_slab=True,
            preferred_m=basis.secondary_m,
            advice="take a larger bridge.deck.thickness_m, or more girders or webs",
        )

    return bars(sag.sagging_nm), bars(hogging)


def bridge_slab_n_m2(basis: DesignBasis, line: DeckLine) -> float:
    """Return the weight of the slab of a deck by its area."""
    return basis.weight_n(line.deck) / line.deck.volume_m3 * basis.bridge.deck.thickness_m


def _slab_of_beams(
    basis: DesignBasis,
    line: DeckLine,
    across_bottom: Tension,
    across_top: Tension,
    effects: BeamEffects,
    shape: PressedShape,
    beams: int,
    advice: str,
) -> Rows:
    """Yield the bars of a slab on beams: across the road, and along it inside of these.

    `effects` and `shape` are of one beam; bars along the top resist what all of them need.
    """
    name, length, width = line.deck.name, line.length_m, basis.bridge.deck.width_m
    slab, is_box = basis.bridge.deck.thickness_m, basis.bridge.box_girder is not None
    side, below = ("top", slab) if is_box else ("bottom", None)
    for found, of_side, depth_from in ((across_bottom, side, below), (across_top, "top", None)):
        depth = None if depth_from is None else depth_from - found.depth_m
        yield basis.scheduled(
            [name], "deck", of_side, "y", found, section_m2=slab * length, length_m=width, depth_m=depth
        )
    yield _secondary(basis, name, side, "x", across_bottom, slab, length, width, below)
    wide = PressedShape(shape.height_m, beams * shape.web_m, beams * shape.flange_m, shape.flange_depth_m)
    secondary = SECONDARY_SHARE * across_top.required_m2 / length * width

    def least(depth_m: float) -> float:
        return max(basis.of_beam_m2(beams * shape.web_m, depth_m), secondary)

    top = basis.tension(
        f"{name} over its supports",
        beams * _top_moment_nm(effects, is_slab=False),
        wide,
        bars_width_m=width,
        outside_m=basis.rule.cover_m + across_top.choice.diameter_m,
        least_m2=least,
        is_slab=True,
        preferred_m=basis.secondary_m,
        advice=advice,
    )
    yield from _top_bars(basis, line, top, effects, shape.height_m, slab)


def _box_girder(basis: DesignBasis, line: DeckLine) -> Rows:
    bridge, box, cover = basis.bridge, given(basis.bridge.box_girder), basis.rule.cover_m
    name, slab, width, length = line.deck.name, bridge.deck.thickness_m, bridge.deck.width_m, line.length_m
    height, webs = box.depth_m + slab, box.cells + 1
    web = webs * box.web_thickness_m
    zeros, cell, overhang = line.between_zeros_m, 0.5 * box.cell_width_m, 0.5 * (width - box.width_m)
    inner = math.fsum(flange_width_m(0.0, (cell, cell), zeros) for _ in range(box.cells))
    flange = min(web + inner + flange_width_m(0.0, (overhang, overhang), zeros), width)
    advice = "take a larger bridge.box_girder.depth_m or web_thickness_m, or a lighter load"
    effects = beam_effects(line.lines, deck_weight_n_m(basis, line), whole_traffic(basis))
    spacing = box.cell_width_m + box.web_thickness_m
    across = _slab_across(basis, line, spacing * (np.arange(webs) - box.cells / 2.0), box.web_thickness_m)

    bottom = basis.tension(
        name,
        effects.sagging_nm,
        PressedShape(height, web, flange, slab),
        bars_width_m=box.width_m,
        outside_m=cover + basis.link_m,
        least_m2=lambda depth_m: basis.of_beam_m2(web, depth_m),
        advice=advice,
    )
    section = line.deck.volume_m3 / length
    yield basis.scheduled([name], "deck", "bottom", "x", bottom, section_m2=section, length_m=length)
    yield _secondary(basis, name, "bottom", "y", bottom, box.bottom_thickness_m, box.width_m, length)
    below = PressedShape(height, web, min(web + inner, box.width_m), box.bottom_thickness_m)
    yield from _slab_of_beams(basis, line, *across, effects, below, 1, advice)
    yield from _links(basis, [name], "deck", effects, line, bottom, web, webs, height, is_slab=False, advice=advice)
