"""What each lift does to a model as it was built: its part, where slings hold it, what they carry, what still held.

it.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...engineering.elasticity.equations import connected_parts
from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.geometry.solids import box, to_manifold
from ...engineering.geometry.vectors import cross, length, unit
from ...engineering.mechanics.slings import Hanging, hanging, sling_forces_n
from ...engineering.structure.connections import GROUND
from ...engineering.units import STANDARD_GRAVITY_M_S2
from ...texts import Text, joined
from ..as_built import Structure
from ..lifts import Lift, Pick, Sling, radius_m, sling_of
from ..results.frames import Inventory
from ..results.records import EventOfRun, LiftOfRun
from ..schema import given
from ..structure.model import Model
from ..structure.tendons import ModelTendons


def model_structure(model: Model) -> Structure:
    """Return the structure of a model, where all connections to the ground end at one more body after the shards."""
    members = [model.members[member] for member in model.member_of_shard]
    count, held = len(model.shards), np.append(model.fixed, False)
    return Structure(
        centres_m=np.concatenate((model.centres_m, np.zeros((1, 3)))),
        masses_kg=np.append(np.where(model.fixed, 0.0, model.masses_kg), 0.0),
        member_names=np.array([*(member.name for member in members), ""]),
        member_kinds=np.array([*(member.kind for member in members), ""]),
        is_shard=np.append(~model.fixed, False),
        held=held,
        pairs=np.where(model.connections.pairs < 0, count, model.connections.pairs),
        points_m=model.connections.points,
        normals=model.connections.normals,
        bearings=model.bearings.springs.rows if model.bearings else np.zeros(0, int),
        boxes_m=np.concatenate((np.array([shard.bounds for shard in model.shards]), np.zeros((1, 2, 3)))),
        tendons=model.tendons,
    )


def recorded_structure(
    inventory: Inventory,
    bearings: np.ndarray,
    centres_m: np.ndarray,
    boxes_m: np.ndarray,
    tendons: ModelTendons | None = None,
) -> Structure:
    """Return the structure of bodies that are recorded, before anything moves.

    `bearings` (b,) are rows of connections, `centres_m` (n, 3) centres of mass of the bodies, `boxes_m` (n, 2, 3) the
    corners of the boxes around them.
    """
    shards = inventory.body_kinds == "shard"
    return Structure(
        centres_m=centres_m,
        masses_kg=inventory.masses_kg,
        member_names=inventory.body_members,
        member_kinds=inventory.body_member_kinds,
        is_shard=shards & inventory.moves,
        held=shards & ~inventory.moves,
        pairs=inventory.pairs,
        points_m=inventory.points_m,
        normals=inventory.normals,
        bearings=bearings,
        boxes_m=boxes_m,
        tendons=tendons,
    )


_STEEP = math.sqrt(3.0)
"""Height of a hook over its slings by how far they are from it on plan: they are as steep as 60°."""

_LEAST_HEIGHT_M = 3.0
"""Height of the hook over slings that are closer together."""

_GROUND = "ground"


@dataclass(frozen=True, slots=True, eq=False)
class PlacedLift:
    """A lift on the shards of a model as it was built.

    Attributes
    ----------
    shards : (s,) int
        Its part.
    pick : Pick
        What the part weighs.
    centre_m : (3,) float
        Its centre of gravity.
    points_m, hook_m : (k, 3), (3,) float
        Where slings hold the part, and where they end.
    carriers : (k,) int
        Shard that each sling holds.
    """

    lift: Lift
    shards: np.ndarray
    pick: Pick
    centre_m: np.ndarray
    points_m: np.ndarray
    hook_m: np.ndarray
    carriers: np.ndarray

    @property
    def radius_m(self) -> float | None:
        """Radius of the crane; None where its place is not given."""
        return radius_m(self.lift, self.hook_m.tolist())

    @property
    def taken_up_n(self) -> np.ndarray:
        """Forces (k,) of slings that have taken up their share of the weight: upright at the hook."""
        weight_n = self.lift.pretension * STANDARD_GRAVITY_M_S2 * self.pick.shards_kg
        return sling_forces_n(self.points_m, self.hook_m, np.array((0.0, 0.0, weight_n)), self.lift.elastic_n)

    def slings(self) -> tuple[Sling, ...]:
        """Return its slings as cables of a run."""
        return _slings(self.lift, self.points_m, self.hook_m, self.taken_up_n, self.pick)

    def vertical_n(self, forces_n: np.ndarray) -> float:
        """Return what slings with forces (k,) carry upright, as they were placed."""
        return math.fsum((forces_n * unit(self.hook_m - self.points_m)[:, 2]).tolist())

    def hanging(self, held: np.ndarray, model: Model) -> Hanging:
        """Return how its shards (h,) hang that are cut free with slings on them."""
        mass_kg, centre_m = _gravity(model, held)
        weight_n = STANDARD_GRAVITY_M_S2 * mass_kg
        return hanging(self.points_m, self.hook_m, centre_m, weight_n, self.lift.elastic_n)

    def loads(self, model: Model, forces_n: np.ndarray) -> np.ndarray:
        """Return forces and moments (6, n) on the shards by slings with forces (k,)."""
        loads = np.zeros((6, len(model.shards)))
        forces = forces_n[:, None] * unit(self.hook_m - self.points_m)
        moments = cross(self.points_m - model.centres_m[self.carriers], forces)
        for carrier, force, moment in zip(self.carriers.tolist(), forces, moments, strict=True):
            loads[:3, carrier] += force
            loads[3:, carrier] += moment
        return loads

    def on_slings(self, model: Model, intact: np.ndarray) -> np.ndarray:
        """Return which of its shards (h,) hang on a sling by the connections that are intact (m,), within the part."""
        count = len(model.shards)
        moves = np.zeros(count + 1, bool)
        moves[self.shards] = True
        first, second = (model.connections.pairs[intact] % (count + 1)).T
        parts = connected_parts(moves, first, second)
        return self.shards[np.isin(parts[self.shards], parts[self.carriers])]

    def held_by(self, model: Model, intact: np.ndarray, *, when_lifted: bool = False) -> tuple[str, ...]:
        """Return the names of what intact connections (m,) hold the part to; none where it is free.

        When it is lifted, it only lies on bearings that hold no uplift.
        """
        inside = np.append(np.isin(np.arange(len(model.shards)), self.shards), False)
        pairs = model.connections.pairs
        ends = inside[pairs]
        crossing = intact & (ends[:, 0] != ends[:, 1])
        if when_lifted and model.bearings:
            springs = model.bearings.springs
            crossing[springs.rows[~springs.pulls]] = False
        beyond = np.where(ends[crossing, 0], pairs[crossing, 1], pairs[crossing, 0])
        names = (_GROUND if shard == GROUND else model.members[model.member_of_shard[shard]].name for shard in beyond)
        return tuple(sorted(set(names)))


def placed_lifts(lifts: Sequence[Lift], model: Model) -> tuple[PlacedLift, ...]:
    """Return lifts on the shards of a model."""
    structure = model_structure(model) if lifts else None
    return tuple(placed_lift(lift, model, given(structure)) for lift in lifts)


def placed_lift(lift: Lift, model: Model, structure: Structure) -> PlacedLift:
    """Return a lift on the shards of a model with a structure; refuse one whose slings cannot hold its part."""
    shards = lift.shards(structure, 1)
    mass_kg, centre_m = _gravity(model, shards)
    pick = Pick(lift.name, mass_kg, volume_kg(lift, model, structure))
    boxes_m = np.array([model.shards[shard].bounds for shard in shards.tolist()])
    points_m = np.array(lift.sling_points_m or ((*centre_m[:2].tolist(), float(boxes_m[:, 1, 2].max())),))
    aside_m = float(length(points_m[:, :2] - centre_m[:2]).max())
    above_m = float(points_m[:, 2].max()) + max(_STEEP * aside_m, _LEAST_HEIGHT_M)
    hook_m = np.array((*centre_m[:2].tolist(), above_m) if lift.hook_m is None else lift.hook_m)
    slings = _slings(lift, points_m, hook_m, np.ones(len(points_m)), pick)
    carriers = [int(sling.placed(structure, number).bodies[0]) for number, sling in enumerate(slings, start=1)]
    weight_n = STANDARD_GRAVITY_M_S2 * pick.heavier_by * pick.shards_kg
    hangs = hanging(points_m, hook_m, centre_m, weight_n, lift.elastic_n)
    x, y, z = centre_m.tolist()
    pick = replace(pick, centre_m=(x, y, z), slings_n=tuple(hangs.forces_n.tolist()))
    return PlacedLift(lift, shards, pick, centre_m, points_m, hook_m, np.array(carriers))


def volume_kg(lift: Lift, model: Model, structure: Structure) -> float:
    """Return the mass of what of a lift's members lies in its box, however they are cut, but for what is held."""
    meant = lift.of_members(structure)[: len(model.shards)]
    masses_kg = []
    for number, member in enumerate(model.members):
        own = meant & (model.member_of_shard == number)
        if not (own & ~model.fixed).any():
            continue
        held = (model.shards[shard] for shard in np.flatnonzero(own & model.fixed).tolist())
        volume_m3 = _volume_in_box(member.solid, lift) - math.fsum(_volume_in_box(solid, lift) for solid in held)
        masses_kg.append(float(model.masses_kg[own].sum()) * volume_m3 / member.volume_m3)
    return math.fsum(masses_kg)


def _volume_in_box(solid: TriangleMesh, lift: Lift) -> float:
    if lift.box is None:
        return solid.volume
    solid, (low, high) = lift.box.solid_in_own_axes(solid), lift.box.corners_m
    if (solid.bounds[0] >= low).all() and (solid.bounds[1] <= high).all():
        return solid.volume
    return (to_manifold(solid) ^ to_manifold(box(high - low, (low + high) / 2.0))).volume()


def pick_warnings(lifts: Sequence[Lift], model: Model) -> list[str]:
    """Return sentences on picks whose shards weigh otherwise than their volume."""
    return [warning for placed in placed_lifts(lifts, model) if (warning := placed.pick.warning)]


def _slings(
    lift: Lift, points_m: np.ndarray, hook_m: np.ndarray, forces_n: np.ndarray, pick: Pick
) -> tuple[Sling, ...]:
    """Return the slings of a lift, with the forces (k,) that they take up."""
    x, y, z = hook_m.tolist()
    return tuple(
        sling_of(lift, number, (point[0], point[1], point[2]), (x, y, z), force_n, pick)
        for number, (point, force_n) in enumerate(zip(points_m.tolist(), forces_n.tolist(), strict=True), start=1)
    )


def _gravity(model: Model, shards: np.ndarray) -> tuple[float, np.ndarray]:
    """Return mass and centre of gravity (3,) of shards (s,)."""
    masses_kg = model.masses_kg[shards]
    mass_kg = math.fsum(masses_kg.tolist())
    moments = [math.fsum((masses_kg * model.centres_m[shards, axis]).tolist()) for axis in range(3)]
    return mass_kg, np.array(moments) / mass_kg


def held_parts_text(events: Iterable[EventOfRun]) -> str:
    """Return what the events of a run say of them, as a sentence without a full stop; empty for nothing."""
    held = [event for event in events if event.held_by]
    if not held:
        return ""
    parts = [Text("lift {} by {}", repr(event.lift), joined("{}, {}", event.held_by)) for event in held]
    return Text(
        "Parts were still held when the crane lifted them away: {}. The run took them out nevertheless; a crane "
        "cannot. Cut them free before, or lift later",
        joined("{}, and {}", parts),
    )


def pick_texts(lifts: Iterable[LiftOfRun]) -> tuple[str, ...]:
    """Return which parts weigh otherwise by their volume, as sentences without full stops."""
    picks = (
        Pick(lift.name, lift.weight_n / STANDARD_GRAVITY_M_S2, lift.volume_weight_n / STANDARD_GRAVITY_M_S2)
        for lift in lifts
        if lift.volume_weight_n is not None  # earlier versions did not say
    )
    return tuple(pick.warning for pick in picks if pick.warning)
