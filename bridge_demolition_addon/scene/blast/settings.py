"""Whether and how the charges of a scene go off, kept with the scene."""

from __future__ import annotations

import bpy

from ...model.blast.settings import BlastSettings
from ...model.scenario.kept import table_from_values, table_values

_PREFIX = "bda_blast_"
_NO_VALUE = -1.0
"""Of a decay that each pulse has its own of: a property of Blender is never empty."""


def keep_blast(scene: bpy.types.Scene, settings: BlastSettings) -> None:
    """Keep settings in a scene, which is saved with it."""
    for name, value in table_values(settings).items():
        scene[_PREFIX + name] = _NO_VALUE if value is None else value


def blast_of(scene: bpy.types.Scene) -> BlastSettings:
    """Return the settings that a scene keeps; in any other, that nothing goes off."""
    if _PREFIX + "explosion" not in scene:
        return BlastSettings(explosion=False)
    kept = {name: scene.get(_PREFIX + name, _NO_VALUE) for name in table_values(BlastSettings())}
    return table_from_values(BlastSettings, {name: value for name, value in kept.items() if value != _NO_VALUE})
