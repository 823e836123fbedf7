"""Watching over the simulation of a demolition that is played without being recorded.

Who plays the timeline for a look, and deletes a shard in the middle, has no recording to see to it that Blender does
not crash. So the world of every scene that was built here is known as well as a recording knows it, from the first
frame after the start on. Nothing is read from it but that it is still there.
"""

from __future__ import annotations

import atexit

import bpy
from bpy.app.handlers import persistent

from ...bullet.world import BulletWorld
from ...core.errors import DemolitionError
from ...scene.bodies import bodies_of, is_marked
from ...scene.connections.constraints import connections_of, loose_connections
from ..crash_guards.callbacks import Callbacks
from ..crash_guards.standstill import stand_still, stands_still
from ..crash_guards.world_objects import WorldObjects
from . import handlers


class Watch:
    """Keeps an eye on one scene's world.

    Parameters
    ----------
    scene
        Scene with a rigid-body world.

    Attributes
    ----------
    given_up
        Whether the world cannot be known, up to the start frame.
    """

    def __init__(self, scene: bpy.types.Scene):
        self._scene = scene
        self._objects = WorldObjects(scene)
        bodies, loose = bodies_of(scene), set(loose_connections(scene))
        simulated = [each for each in connections_of(scene) if each not in loose]
        self._world = BulletWorld(scene, bodies, simulated)
        self.given_up = not any(map(is_marked, bodies))

    def has_what_there_is(self) -> bool:
        """Whether nothing was added to the world or taken out of it."""
        world = self._scene.rigidbody_world
        return world is not None and world.collection is not None and self._objects.are_the_same()

    def look(self, depsgraph: bpy.types.Depsgraph) -> None:
        """Know the world that Blender has now."""
        if self.given_up:
            return
        try:
            self._world.bind(depsgraph)
        except DemolitionError:
            self.given_up = True

    def intervene(self) -> None:
        """Let the world stand still where something is being taken out of it."""
        if self.given_up or self.has_what_there_is():
            return
        if self._scene.rigidbody_world and self._objects.any_is_gone():
            stand_still(self._scene, self._world)
        self.release()

    def release(self) -> None:
        """Leave the world to whoever wants it."""
        self._world.release()
        self.given_up = True


_watches: dict[int, Watch] = {}
"""By the numbers that stay a scene's own while Blender runs."""


def register() -> None:
    """Watch from now on."""
    _before_upheaval()
    _callbacks.attach()


def unregister() -> None:
    """Watch no more."""
    _callbacks.detach()
    _before_upheaval()


@persistent
def _before_frame(scene: bpy.types.Scene, _depsgraph: bpy.types.Depsgraph | None = None) -> None:
    watch = _watches.get(scene.session_uid)
    if not watch:
        return
    if _is_recorded(scene):
        watch.release()
        return
    watch.intervene()


@persistent
def _after_frame(scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    world, number = scene.rigidbody_world, scene.session_uid
    if world is None or world.collection is None or world.point_cache.is_baked:
        _watches.pop(number, None)
        return
    if scene.frame_current <= world.point_cache.frame_start:
        watch = _watches.get(number)
        if watch and (watch.given_up or not watch.has_what_there_is()):
            del _watches[number]
        return
    if _is_recorded(scene) or stands_still(scene) or bpy.app.is_job_running("RENDER"):
        return
    if number not in _watches or not _watches[number].has_what_there_is():
        _watches[number] = Watch(scene)
    _watches[number].look(depsgraph)


@persistent
def _before_update(scene: bpy.types.Scene, _depsgraph: bpy.types.Depsgraph | None = None) -> None:
    watch = _watches.get(scene.session_uid)
    if watch:
        watch.intervene()


@persistent
def _before_upheaval(*_: object) -> None:
    """Undo, redo and loading a file free what is watched."""
    for watch in _watches.values():
        watch.release()
    _watches.clear()


def _is_recorded(scene: bpy.types.Scene) -> bool:
    recording = handlers.current()
    return recording is not None and not recording.error and recording.scene == scene


_callbacks = Callbacks(
    frame_change_pre=_before_frame,
    frame_change_post=_after_frame,
    depsgraph_update_pre=_before_update,
    load_pre=_before_upheaval,
    undo_pre=_before_upheaval,
    redo_pre=_before_upheaval,
)

atexit.register(unregister)
