"""Objects of a scene's rigid-body world, to notice when some are added or removed."""

from __future__ import annotations

from collections.abc import Sequence

import bpy
import numpy as np

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
