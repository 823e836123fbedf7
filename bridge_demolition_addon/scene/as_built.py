"""A scene as it was built, kept with it: whether the bridge stands, and what the user changed since."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any
from uuid import uuid4

import bpy
import numpy as np

from ..engineering.geometry.vectors import length
from ..errors import SimulationError
from ..model.scenario.kept import values_text
from .bodies import Kind
from .body_settings import BodySettings, body_settings_of
from .connections.constraints import connections_of
from .custom_properties import edited, keep, kept_number, kept_values
from .run_setup import RunSetup, run_setup_of

_AS_BUILT = "bda_as_built"
_BODIES = "bda_built_bodies"
_CONNECTIONS = "bda_built_connections"
_BUILD = "bda_build"
_COUNT = "bda_built_count"

_FOLLOW_FROM_BODIES = frozenset(
    (
        "which bodies there are",
        "positions, shapes or sizes of bodies",
        "masses of bodies",
        "how bodies move and touch",
        "animation of bodies",
        "which connections there are, and between which bodies",
        "kinds and strengths of connections",
        "velocities that bodies begin with",
        "soil under footings",
        "bearings",
        "tendons",
        "pulls",
    )
)
"""What differs as soon as a body or a connection is missing or added: it is compared as a whole."""

_SAME_M = 1e-3
"""How far a body may be from where it was built: Blender has positions in single precision."""

_SAME_ROTATION = 1e-3
_LEAST_RUBBLE = 3
_RUBBLE_SHARE = 0.1
"""A person moves a few shards, or many alike. Where this many have rotations of their own, a simulation moved them."""


def keep_as_built(scene: bpy.types.Scene) -> None:
    """Remember a scene as it has just been built."""
    scene[_AS_BUILT] = values_text(run_setup_of(scene).compared())


def manual_edits(scene: bpy.types.Scene, setup: RunSetup) -> list[str]:
    """Return short texts on what is no longer as it was built; none where that is not known."""
    before = kept_values(scene, _AS_BUILT, {})
    return [text for text, digest in setup.compared().items() if before.get(text, digest) != digest]


def edits_beside_bodies(by_hand: Sequence[str], changed: Sequence[str]) -> list[str]:
    """Return the texts of `manual_edits` that the sentences of `changed_bodies` do not say already.

    A body or a connection less changes most of what is compared. A sentence that names it says more than that list.
    """
    return [text for text in by_hand if not (changed and text in _FOLLOW_FROM_BODIES)]


def keep_built_bodies(scene: bpy.types.Scene) -> None:
    """Remember which bodies were built, and where, and how many connections."""
    bodies = body_settings_of(scene)
    kept: dict[str, dict[str, list[float]]] = {kind.value: {} for kind in Kind}
    for name, kind, position in zip(bodies.names, bodies.kinds, bodies.own_matrices[:, :3, 3].tolist(), strict=True):
        kept[kind.value][name] = position
    scene[_BODIES] = values_text(kept)
    scene[_CONNECTIONS] = len(connections_of(scene))
    scene[_BUILD], scene[_COUNT] = uuid4().hex, len(scene.rigidbody_world.collection.all_objects)


def build_of(scene: bpy.types.Scene) -> str:
    """Return which building of a demolition a scene shows, also after undo; empty where nothing was built.

    Results belong to the building that they are of: another one has bodies of the same names.
    """
    return str(scene.get(_BUILD, ""))


def has_all_bodies(scene: bpy.types.Scene) -> bool:
    """Return whether a scene has as many bodies as were built; quick enough for each redraw."""
    world = scene.rigidbody_world
    count = len(world.collection.all_objects) if world and world.collection else 0
    return kept_number(scene, _COUNT, count) == count > 0


def forget_built_bodies(scene: bpy.types.Scene) -> None:
    """Forget what was built, as it is removed."""
    keep(scene, _BODIES, None)
    keep(scene, _CONNECTIONS, None)
    keep(scene, _BUILD, None)
    keep(scene, _COUNT, None)


def changed_bodies(scene: bpy.types.Scene) -> list[str]:
    """Return sentences on bodies and connections that are missing, were added or moved since a scene was built."""
    kept, bodies = kept_values(scene, _BODIES, {}), body_settings_of(scene)
    try:
        built = {
            name: np.array(position, float).reshape(3)
            for kind, positions in kept.items()
            if Kind(kind)
            for name, position in positions.items()
        }
    except (AttributeError, TypeError, ValueError) as error:
        raise edited(scene, _BODIES, "the positions of bodies by kind and name") from error
    if built.keys().isdisjoint(bodies.names):  # another demolition, or none that was built here
        return []
    counted = _fewer_connections(scene)
    return [*_missing(kept, bodies), *_added(built, bodies), *_moved(scene, built, bodies), *counted]


def _missing(kept: dict[str, dict[str, list[float]]], bodies: BodySettings) -> Iterator[str]:
    there = set(bodies.names)
    for kind, built in kept.items():
        missing = [name for name in built if name not in there]
        if kind == Kind.SHARD and missing:
            yield f"{_count(missing, 'shard')} missing, such as {missing[0]!r}"
        elif kind != Kind.SHARD and len(bodies.of_kind(Kind(kind))) < len(built):
            yield f"the {kind} of the scenario is missing: {', '.join(map(repr, missing))}"


def _fewer_connections(scene: bpy.types.Scene) -> Iterator[str]:
    """Say how many more or fewer connections there are than were built; nothing where that was not kept."""
    now = len(connections_of(scene))
    built = int(kept_number(scene, _CONNECTIONS, now))
    if now != built:
        count = abs(built - now)
        yield f"{count} connection{'s' * (count > 1)} {'fewer' if now < built else 'more'} than built"


def _added(built: dict[str, np.ndarray], bodies: BodySettings) -> Iterator[str]:
    added = [name for name in bodies.names if name not in built]
    if added:
        yield f"{_count(added, 'body', 'bodies')} added, such as {added[0]!r}"


def _moved(scene: bpy.types.Scene, built: dict[str, np.ndarray], bodies: BodySettings) -> Iterator[str]:
    rows = [row for row in _free_shards(bodies) if bodies.names[row] in built]
    if not rows:
        return
    positions = np.array([built[bodies.names[row]] for row in rows])
    away_m = length(bodies.own_matrices[rows, :3, 3] - positions)
    moved = np.flatnonzero(away_m > _SAME_M)
    if not len(moved):
        return
    farthest = int(away_m.argmax())
    example = f"such as {bodies.names[rows[farthest]]!r} by {away_m[farthest]:.2g} m"
    rotations = bodies.own_matrices[np.array(rows)[moved], :3, :3]
    like_rubble = np.abs(rotations - rotations[0]).max() > _SAME_ROTATION
    if like_rubble and len(moved) >= max(_LEAST_RUBBLE, _RUBBLE_SHARE * len(rows)):
        raise SimulationError(
            f"scene {scene.name!r} begins with rubble: {len(moved)} of {len(rows)} shards are not where they were "
            f"built, {example}; undo what moved them, or build the scenario again"
        )
    yield f"{_count(moved, 'shard')} moved, {example}"


def check_start(setup: RunSetup, positions_m: np.ndarray) -> None:
    """Check that a simulation, with its n bodies at positions (n, 3) before any time, begins as its scene is."""
    bodies = setup.bodies
    rows = _free_shards(bodies)
    away_m = length(positions_m[rows] - bodies.own_matrices[rows, :3, 3])
    moved = np.flatnonzero(away_m > _SAME_M * np.maximum(1.0, length(positions_m[rows]) * _SAME_M))
    if len(moved):
        farthest = int(away_m.argmax())
        raise SimulationError(
            f"the simulation begins with {len(moved)} of {len(rows)} shards elsewhere than the scene has them, such as "
            f"{bodies.names[rows[farthest]]!r} by {away_m[farthest]:.2g} m: go to the start frame and run again, or "
            "build the scenario again"
        )


def _free_shards(bodies: BodySettings) -> list[int]:
    """Return the rows of shards without animation, parent or constraint: their own location is where they are."""
    rows = bodies.of_kind(Kind.SHARD)
    is_held = [bool(obj.parent or len(obj.constraints)) for obj in bodies.objects]
    return [row for row in rows if not (bodies.is_animated[row] or is_held[row])]


def _count(items: Sequence[object] | np.ndarray, one: str, many: str = "") -> str:
    count = len(items)
    return f"1 {one} is" if count == 1 else f"{count} {many or one + 's'} are"


_STABILITY = "bda_stability"


def keep_stability(scene: bpy.types.Scene, stability: Mapping[str, Any] | None) -> None:
    """Keep a verdict as it is stored, or none."""
    keep(scene, _STABILITY, None if stability is None else values_text(dict(stability)))


def kept_stability(scene: bpy.types.Scene) -> dict[str, Any] | None:
    """Return the verdict that is kept with a scene; None where nothing was built, or nothing worked out."""
    return kept_values(scene, _STABILITY, {}) or None
