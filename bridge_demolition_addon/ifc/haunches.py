"""Haunches that files leave out: concrete between the top of a girder and the underside of its deck."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace

import numpy as np
from manifold3d import CrossSection, FillRule, Manifold, Mesh64

from ..engineering.geometry.mesh import TriangleMesh, triangle_areas_and_normals
from ..engineering.geometry.plan_areas import signed_area
from ..engineering.geometry.solids import from_manifold, to_manifold
from ..engineering.terrain.surface import Surface
from ..model.bridge.member import Member
from .bodies import sound_simplified

HIGHEST_M = 0.35
"""Gap up to which a deck is taken to lie on a girder: haunches of prestressed girders with camber are up to so high."""

_TOUCHING_M = 1e-4
_MOSTLY = 0.9
"""Part of the nodes over a girder that have to touch its deck, or to lie within a haunch's height of it."""

_LOOKS_UP = 0.7
_LOW_M = 0.02
_INTO_M = (0.02, 0.013, 0.03, 0.04, 0.05)
"""How far a haunch goes into girder and deck before that is cut off: so that it ends within them in spite of chords.
The others are tried where the first gives no sound solid."""

_INSET_M, _HEALED_M, _STEP_M, _LEAST_M2 = 0.005, 0.01, 0.5, 0.05
_SIMPLER_M = 1e-4


@dataclass(frozen=True, slots=True)
class _Gap:
    """The space between a girder and a deck: a plate of height 1 over its plan, and heights at its nodes (n,), m."""

    plate: TriangleMesh
    top: np.ndarray
    underside: np.ndarray

    @property
    def heights_m(self) -> np.ndarray:
        """Heights (n,) of the space."""
        return self.underside - self.top

    @property
    def is_haunch(self) -> bool:
        """Whether a deck lies over most of the girder's top near enough, and does not touch it already."""
        known = self.heights_m
        near = (known > -_LOW_M) & (known < HIGHEST_M)
        return bool(near.mean() >= _MOSTLY and (np.abs(known) <= _TOUCHING_M).mean() < _MOSTLY)

    def filled(self, into_m: float) -> Manifold:
        """Return the solid of the space, so far into the girder and the deck."""
        nodes = self.plate.vertices
        # Where the plan goes beyond the flange, the face below belongs to another one.
        low = np.maximum(self.top - into_m, self.underside - HIGHEST_M)
        high = np.maximum(self.underside, self.top) + into_m
        heights = low + nodes[:, 2] * (high - low)
        vertices = np.ascontiguousarray(np.column_stack((nodes[:, :2], heights)))
        return Manifold(Mesh64(vertices, np.ascontiguousarray(self.plate.triangles.astype(np.uint64))))


def with_haunches(members: Sequence[Member]) -> tuple[list[Member], list[str]]:
    """Bring girders up to the deck that lies over them; return the members and notes on them."""
    done, notes = list(members), []
    decks = [member for member in members if member.kind == "deck"]
    for index, member in enumerate(members):
        if member.kind != "girder":
            continue
        for deck in decks:
            others = [other.solid for other in members if other is not member and other is not deck]
            made = _haunched(done[index].solid, deck.solid, others)
            if made is None:
                continue
            solid, highest_m = made
            added = solid.volume - done[index].solid.volume
            done[index] = replace(done[index], solid=solid)
            notes.append(
                f"{member.name} has a haunch, up to {1e3 * highest_m:.0f} mm high, under {deck.name}: {added:+.2g} m³"
            )
    return done, notes


def decks_with_haunches(before: Sequence[Member], after: Sequence[Member], bars: Collection[str]) -> list[Member]:
    """Return members where the concrete between bars and deck belongs to the deck.

    A bar of steel has one section: its haunch is of its deck's concrete.
    """
    done = list(after)
    for row, (old, new) in enumerate(zip(before, after, strict=True)):
        if old.name not in bars or new is old:
            continue
        done[row] = old
        grown = to_manifold(new.solid) - to_manifold(old.solid)
        reached = [
            (_shared_m3(grown.translate((0.0, 0.0, _LOW_M)), deck.solid), number)
            for number, deck in enumerate(done)
            if deck.kind == "deck"
        ]
        shared, number = max(reached, default=(0.0, -1))
        if shared <= 0.0:
            continue
        whole = (to_manifold(done[number].solid) + grown).simplify(_SIMPLER_M).decompose()
        sound = sound_simplified(from_manifold(max(whole, key=lambda body: body.volume())))
        if sound is not None:
            done[number] = replace(done[number], solid=sound)
    return done


def _haunched(
    girder: TriangleMesh, deck: TriangleMesh, others: Sequence[TriangleMesh]
) -> tuple[TriangleMesh, float] | None:
    """Return a girder that goes up to a deck, and the height of the haunch; None where it needs none.

    It has none where others take that room, such as girders that lie on one across them.
    """
    if (girder.bounds[0, :2] > deck.bounds[1, :2]).any() or (girder.bounds[1, :2] < deck.bounds[0, :2]).any():
        return None
    if girder.bounds[0, 2] > deck.bounds[1, 2] or girder.bounds[1, 2] + HIGHEST_M < deck.bounds[0, 2]:
        return None
    gap = _gap(girder, deck)
    if gap is None or not gap.is_haunch:
        return None
    if any(_shared_m3(gap.filled(_INTO_M[0]), other) > _LEAST_M2 * _LOW_M for other in others):
        return None
    for into_m in _INTO_M:
        whole = (to_manifold(girder) + gap.filled(into_m)) - to_manifold(deck)
        bodies = whole.simplify(_SIMPLER_M).decompose()
        if not bodies:
            continue
        sound = sound_simplified(from_manifold(max(bodies, key=lambda body: body.volume())))
        if sound is not None:
            return sound, float(min(gap.heights_m.max(), HIGHEST_M))
    return None


def _shared_m3(filled: Manifold, other: TriangleMesh) -> float:
    low_x, low_y, low_z, high_x, high_y, high_z = filled.bounding_box()
    low, high = np.array((low_x, low_y, low_z)), np.array((high_x, high_y, high_z))
    if (other.bounds[0] >= high).any() or (other.bounds[1] <= low).any():
        return 0.0
    return float((filled ^ to_manifold(other)).volume())


def _gap(girder: TriangleMesh, deck: TriangleMesh) -> _Gap | None:
    upper, lower = Surface(girder), Surface(TriangleMesh(deck.vertices * (1.0, 1.0, -1.0), deck.triangles))
    plan = _top_in_plan(girder, upper, lower) ^ to_manifold(deck).project().offset(-_LOW_M)
    parts = [part for part in plan.offset(-_INSET_M).simplify(_INSET_M / 2.0).decompose() if part.area() > _LEAST_M2]
    if not parts:
        return None
    plate = from_manifold(Manifold.extrude(max(parts, key=lambda part: part.area()), 1.0).refine_to_length(_STEP_M))
    top, underside = upper.heights_at(plate.vertices[:, :2]), -lower.heights_at(plate.vertices[:, :2])
    return _Gap(plate, top, underside) if np.isfinite(top).all() and np.isfinite(underside).all() else None


def _top_in_plan(girder: TriangleMesh, upper: Surface, lower: Surface) -> CrossSection:
    """Return the plan of the faces of a girder that look up at a deck near them: a lower flange does not count."""
    corners = girder.corners
    areas, normals = triangle_areas_and_normals(corners)
    middles = corners.mean(axis=1)
    over = -lower.heights_at(middles[:, :2]) - middles[:, 2]
    is_top = (areas > 0.0) & (normals[:, 2] > _LOOKS_UP)
    is_top &= np.abs(upper.heights_at(middles[:, :2]) - middles[:, 2]) <= _TOUCHING_M
    is_top &= ~(over >= HIGHEST_M)  # also where the middle of a long triangle lies off the deck
    rings = corners[is_top][:, :, :2]
    rings = rings[np.abs(signed_area(rings)) > 1e-9]
    plan = CrossSection([ring if signed_area(ring) > 0.0 else ring[::-1] for ring in rings], FillRule.Positive)
    return plan.offset(_HEALED_M).offset(-_HEALED_M)
