"""What the panel of the connections says on strengths: what counts where none is given, and what one force means."""

from __future__ import annotations

import bpy

from ...model.scenario.connections import LARGE_MODEL, MATERIAL_OF_LARGE_MODELS, STRENGTH_KEYS
from .prop import USE


def breaking_note(scenario: bpy.types.PropertyGroup) -> str:
    """Return a sentence on what breaks the connections of a scenario; empty where its values say it."""
    connections, is_large = scenario.connections, scenario.fracture.shards >= LARGE_MODEL
    given = [name for name in STRENGTH_KEYS if getattr(connections, USE + name)]
    if not given:
        if is_large and connections.method == "face":
            return f"With {LARGE_MODEL} shards or more they break by the strength of {MATERIAL_OF_LARGE_MODELS}"
        return "Choose a breaking force, or a material with method face"
    if is_large and "material" not in given:
        return "One force for all: the finer the bridge is cut, the stronger it is. A material does not depend on it"
    return ""
