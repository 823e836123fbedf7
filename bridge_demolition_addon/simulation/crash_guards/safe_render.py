"""Renders of what has not been played, without a crash.

A render works on copies of its own, beside those of the window, and both share one Bullet world. Where the render is
the first to simulate, Blender makes bodies of meshes that are not there yet, and crashes, then or at the next step. So
the world of a demolition rests while it is rendered, unless its frames were played before and are known.
"""

from __future__ import annotations

import atexit
from contextlib import suppress

import bpy
from bpy.app.handlers import persistent

from ...scene.bodies import bodies_of, is_marked
from .callbacks import Callbacks

_resting: list[bpy.types.Scene] = []


def register() -> None:
    """Make renders safe from now on."""
    _callbacks.attach()


def unregister() -> None:
    """Leave renders to Blender."""
    _callbacks.detach()
    _after_render()


def frames_are_known(scene: bpy.types.Scene) -> bool:
    """Whether Blender plays frames back that it has simulated, and nothing was changed since."""
    cache = scene.rigidbody_world.point_cache
    return cache.is_baked or bool(cache.info and not cache.is_outdated)


@persistent
def _before_render(scene: bpy.types.Scene, *_: object) -> None:
    world = scene.rigidbody_world
    if not world or not world.collection or not world.enabled or frames_are_known(scene):
        return
    if any(map(is_marked, bodies_of(scene))):
        world.enabled = False
        _resting.append(scene)


@persistent
def _after_render(*_: object) -> None:
    while _resting:
        with suppress(ReferenceError):  # the scene was deleted meanwhile
            _resting.pop().rigidbody_world.enabled = True


_callbacks = Callbacks(render_init=_before_render, render_complete=_after_render, render_cancel=_after_render)

atexit.register(unregister)
