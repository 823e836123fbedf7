"""Keeps Blender from crashing when something is taken out of a rigid-body world in mid-simulation.

Blender frees the Bullet part of a deleted body or connection, but not all that points at it. So the world of every
scene that was built here is watched from the first frame after the start on, recorded or not. When objects are gone,
the world is made safe, and time stops in it until the start frame, where Blender makes a new one. The rest of the scene
can be played and edited meanwhile.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import bpy
import numpy as np

from ...bullet.time_control import stop_time
from ...bullet.world import BulletWorld, WorldState
from ...errors import DemolitionError, LayoutError
from ...model.schema import given
from ...scene.bodies import bodies_of, is_marked
from ...scene.connections.constraints import connections_of, loose_connections


class WorldGuard:
    """Guard of one scene's world; while it stands still, the scene is not simulated until its start frame."""

    def __init__(self) -> None:
        self.stands_still = False
        self._objects: WorldObjects | None = None
        self._world: BulletWorld | None = None  # also None where memory is not as expected up to the start frame
        self._recorded: BulletWorld | None = None
        self._was_edited = False

    def share(self, scene: bpy.types.Scene, world: BulletWorld) -> None:
        """Guard a world that a recording will bind, and until `hand_over` the one that Blender still has."""
        self.check_objects(scene)
        if self._world is None:
            self._objects = WorldObjects(scene)
        self._recorded = world

    def hand_over(self, scene: bpy.types.Scene) -> None:
        """Leave the world of a frame after the start frame to the recording, and guard it as it is bound there."""
        world = scene.rigidbody_world
        if self._recorded and world and scene.frame_current > world.point_cache.frame_start:
            recorded = self._recorded
            self.release()
            self._objects, self._world = WorldObjects(scene), recorded

    def end_sharing(self, depsgraphs: Iterable[bpy.types.Depsgraph]) -> None:
        """Go on guarding the world that a failed recording has released; before its first frame, the earlier one."""
        self._recorded = None
        for depsgraph in depsgraphs:
            self._bind(depsgraph)

    def release(self) -> None:
        """Release the world."""
        if self._world:
            self._world.release()
        self._objects = self._world = self._recorded = None
        self._was_edited = False

    def forget(self) -> None:
        """Release a world that Blender frees now; the next one does not stand still."""
        self.stands_still = False
        self.release()

    def stand_still(self, scene: bpy.types.Scene) -> None:
        """Make a world safe that Blender keeps, while it frees any of its objects; it stands still."""
        if self._world:
            self._stand_still(scene, bodies_stay=False)
        self.release()

    def check_objects(self, scene: bpy.types.Scene) -> str:
        """Return a sentence on objects that were added to the world or removed; empty if there are none.

        To be called before Blender frees removed objects: then the world is made safe, and stands still.
        """
        if self._objects is None:
            return ""
        if not _has_world(scene):
            if self._world and scene.rigidbody_world is None:
                self._world.outlive()
            elif self._world:  # it has lost its collection, and stays until the start frame
                self._stand_still(scene, bodies_stay=False)
            self.release()
            return "the rigid-body world was removed while it was recorded"
        if self._objects.are_the_same():
            return self._take_out_edited()
        changes = self._objects.changes()
        if self._objects.any_is_gone():
            if self._world:
                self._stand_still(scene)
            self.release()
        else:  # Blender adds new objects to the world in the next frame: until then the world is as before
            self._take_out_edited()
            self._objects, self._was_edited = WorldObjects(scene), True
        return f"rigid-body world changed, {changes}: go to the start frame and record again"

    def keep_standing_still(self, scene: bpy.types.Scene) -> None:
        """Stop time before a frame again: Blender takes frames out of its cache, and counts on from there."""
        if not self.stands_still:
            return
        world = scene.rigidbody_world
        self.stands_still = False
        if world and scene.frame_current > world.point_cache.frame_start:
            try:
                stop_time(scene)
                self.stands_still = True
            except LayoutError:
                pass  # a new world, and none of ours

    def look(self, scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
        """Bind the world that Blender has after a frame that is not recorded; at the start frame still the last one."""
        if not _has_world(scene):
            self.release()
            return
        if self.stands_still or bpy.app.is_job_running("RENDER"):
            return
        at_start = scene.frame_current <= scene.rigidbody_world.point_cache.frame_start
        is_known = self._world is not None if at_start else not self._was_edited
        if self._objects is None or not is_known or not self._objects.are_the_same():
            self.release()
            self._objects, self._world = WorldObjects(scene), _world_of(scene)
        self._bind(depsgraph)

    def _bind(self, depsgraph: bpy.types.Depsgraph) -> None:
        """Bind the world with all its present objects; release it if memory is not as expected."""
        if not self._world:
            return
        try:
            known = self._world.bind(depsgraph, to_read=False) is WorldState.KNOWN
            if known and self._world.has_grown():
                self._world.release()
                self._world.bind(depsgraph, to_read=False)
        except (DemolitionError, ReferenceError):  # one of its objects may be deleted
            self._world.release()
            self._world = None

    def _take_out_edited(self) -> str:
        """Take edited connections out of the world, and return a sentence: Blender makes others with the next frame."""
        try:
            edited = self._world.take_out_edited() if self._world else []
        except LayoutError:
            return ""
        if not edited:
            return ""
        self._was_edited = True
        return f"connection {edited[0].name!r} was edited: go to the start frame and record again"

    def _stand_still(self, scene: bpy.types.Scene, *, bodies_stay: bool = True) -> None:
        """Make the world safe and stop time, if memory is as expected."""
        try:
            given(self._world).detach_freed(bodies_stay=bodies_stay)
            stop_time(scene)
            self.stands_still = True
        except LayoutError:
            pass


def _has_world(scene: bpy.types.Scene) -> bool:
    return scene.rigidbody_world is not None and scene.rigidbody_world.collection is not None


def _world_of(scene: bpy.types.Scene) -> BulletWorld | None:
    """Return the world of a scene that was built here, without connections that lack a body; None for other scenes."""
    bodies, loose = bodies_of(scene), set(loose_connections(scene))
    if not any(map(is_marked, bodies)):
        return None
    return BulletWorld(scene, bodies, [connection for connection in connections_of(scene) if connection not in loose])


_MOST_NAMES = 3
"""Names of objects in a message."""


class WorldObjects:
    """The objects of a scene's rigid-body world as they are now."""

    def __init__(self, scene: bpy.types.Scene):
        self._scene = scene
        self._numbers_at_first = self._numbers()
        self._names_at_first = self._names()

    def are_the_same(self) -> bool:
        """Return whether the world still has just these objects."""
        return self._numbers() == self._numbers_at_first

    def any_is_gone(self) -> bool:
        """Return whether an object was removed from the world."""
        return not self._names_at_first.keys() <= self._names().keys()

    def changes(self) -> str:
        """Return the names of objects that were added and removed since."""
        before, now = self._names_at_first, self._names()
        changes = {
            "removed": [name for number, name in before.items() if number not in now],
            "added": [name for number, name in now.items() if number not in before],
        }
        texts = [f"{_some(names)} {change}" for change, names in changes.items() if names]
        return " and ".join(texts) or "its objects are in another order"

    def _numbers(self) -> bytes:
        """Numbers of the objects in the world, for a quick comparison."""
        numbers = []
        for objects in self._collections():
            numbers.append(np.zeros(len(objects), np.int32))
            objects.foreach_get("session_uid", numbers[-1])
        return b"|".join(number.tobytes() for number in numbers)

    def _names(self) -> dict[int, str]:
        """Names of the objects in the world, by the numbers that stay theirs while Blender runs."""
        return {obj.session_uid: obj.name for objects in self._collections() for obj in objects}

    def _collections(self) -> list[bpy.types.bpy_prop_collection]:
        world = self._scene.rigidbody_world
        return [collection.all_objects for collection in (world.collection, world.constraints) if collection]


def _some(names: Sequence[str]) -> str:
    """First few names, and how many more there are."""
    shown = ", ".join(repr(name) for name in names[:_MOST_NAMES])
    return shown + (f" and {len(names) - _MOST_NAMES} more" if len(names) > _MOST_NAMES else "")
