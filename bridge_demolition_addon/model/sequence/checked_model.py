"""Check of planned actions against the model of their scenario, without Blender."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from manifold3d import Manifold

from ...engineering.fracture.gaps import is_cut
from ...engineering.geometry.solids import to_manifold
from ...engineering.geometry.vectors import AXES
from ..actions import Affected, Fact, Place, PlannedAction, Point
from ..as_built import Structure
from ..blast.blast_zones import BlastZone
from ..bridge.member import Member
from ..bridge.preparation import surface_height
from ..changes.zone_firings import ZoneFiring
from ..lifts import Lift, Pick, Sling
from ..results.stability import ZoneLoad
from ..scenario import MemberCut, Scenario
from ..structure.blast_zones import one_member, placed_zone, placed_zones
from ..structure.model import Model, build_model
from ..structure.zone_loads import ZoneFall, facts_of_zones, zone_falls
from .lifts import PlacedLift, model_structure, placed_lift

_SPHERE_FACETS = 64
"""Round enough: the corners are on the sphere, and its sides 0.1 % of the radius within it."""


@dataclass(frozen=True)
class ModelWorksite:
    """The `Worksite` of planned actions: a scenario's bridge by its model."""

    plan: Scenario
    model: Model
    zone_loads: tuple[ZoneLoad, ...] = ()  # what blast zones carry at rest, where it is known

    @cached_property
    def structure(self) -> Structure:
        return model_structure(self.model)

    @cached_property
    def mass_kg(self) -> float:
        return float(self.model.masses_kg.sum())

    def surface_height(self, position_m: Place) -> float:
        return surface_height(self.plan, self.model.members, position_m)

    def ground_height(self, position_m: Place) -> float:
        return float(np.nan_to_num(self.model.ground.heights_at(np.array([position_m]))[0], nan=-np.inf))

    def member_within(self, centre_m: Point, radius_m: float) -> str | None:
        sphere = Manifold.sphere(radius_m, _SPHERE_FACETS).translate(centre_m)
        names = (
            member.name
            for member in self.model.members
            if _meets(member.solid.bounds, centre_m, radius_m)
            and (to_manifold(member.solid, member.name) ^ sphere).volume() > 0.0
        )
        return next(names, None)

    def distance_to_bridge_m(self, point_m: Point) -> float:
        boxes = np.array([member.solid.bounds for member in self.model.members])
        gaps = np.maximum(0.0, np.maximum(boxes[:, 0] - point_m, point_m - boxes[:, 1]))
        return float(np.sqrt((gaps * gaps).sum(axis=1)).min())

    def outer_faces(self, shard: int) -> np.ndarray:
        piece = self.model.shards[shard]
        return piece.corners[~is_cut(piece, self.model.members[self.model.member_of_shard[shard]].solid)]

    def affected_by(self, action: PlannedAction) -> Affected:
        model = self.model
        shards = action.shards(self.structure, self.number_of(action))
        names = sorted({model.members[row].name for row in model.member_of_shard[shards]})
        return Affected(len(shards), float(model.masses_kg[shards].sum()), tuple(names))

    def pick_of(self, lift: Lift) -> Pick:
        return self._placed(lift).pick

    def taken_before(self, lift: Lift) -> Iterator[tuple[str, float]]:
        own = lift.shards(self.structure, 0)
        for other in self.plan.lifts:
            shared = np.intersect1d(own, other.shards(self.structure, 0))
            if other is not lift and other.lift_s <= lift.lift_s and len(shared):
                yield other.name, float(self.model.masses_kg[shared].sum())

    def slings_of(self, lift: Lift) -> Sequence[Sling]:
        return self._placed(lift).slings()

    def _placed(self, lift: Lift) -> PlacedLift:
        return placed_lift(lift, self.model, self.structure)

    def firings_of(self, zone: BlastZone) -> Sequence[ZoneFiring]:
        placed = placed_zone(zone, self.model.members, self.model.layers)
        return (placed.firing(self.plan),) if placed.loosens(self.plan) else ()

    @cached_property
    def _zone_falls(self) -> dict[str, ZoneFall]:
        placed = placed_zones(self.plan, self.model.members, self.model.layers)
        return zone_falls(placed, self.plan, self._loads_of_zones)

    @cached_property
    def _loads_of_zones(self) -> dict[str, ZoneLoad]:
        return {load.zone: load for load in self.zone_loads}

    def facts_of_zone(self, zone: BlastZone) -> Iterator[Fact]:
        placed = placed_zone(zone, self.model.members, self.model.layers)
        yield from placed.facts(self.plan)
        yield from facts_of_zones(placed, self._loads_of_zones, self._zone_falls)

    def check_zone(self, zone: BlastZone) -> None:
        placed = placed_zone(zone, self.model.members, self.model.layers)
        if zone.goes_off:
            placed.firing(self.plan).event(self.structure)

    def check_cut(self, cut: MemberCut) -> None:
        member = one_member(cut, self.model.members)
        lowest, highest = member.solid.bounds[:, AXES.index(cut.along)].tolist()
        if not lowest < cut.position_m < highest:
            raise cut.unexpected(
                "position_m", f"a position in {member.name}, from {lowest:g} to {highest:g} (m) along {cut.along}"
            )
        cut.severing(self.plan).event(self.structure)

    def number_of(self, action: PlannedAction) -> int:
        alike = [other for other in self.plan.actions if type(other) is type(action)]
        return 1 + next(number for number, other in enumerate(alike) if other is action)


def _meets(box_m: np.ndarray, centre_m: Point, radius_m: float) -> bool:
    """Return whether a box (2, 3) meets that around a sphere, which takes far less time than whether a solid does."""
    centre = np.array(centre_m)
    return bool((box_m[0] <= centre + radius_m).all() and (centre - radius_m <= box_m[1]).all())


def checked_model(scenario: Scenario, members: Sequence[Member] | None = None) -> Model:
    """Return the model of a scenario, maybe of prepared members; every planned action has to act on something."""
    model = build_model(scenario, members)
    check_actions(scenario, model)
    return model


def check_actions(scenario: Scenario, model: Model) -> None:
    """Check each planned action against a model."""
    site = ModelWorksite(scenario, model)
    for action in scenario.actions:
        for position in action.starts_above():
            site.surface_height(position)
        action.check_model(site)
