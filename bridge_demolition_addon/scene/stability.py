"""The verdict whether the bridge of a scene stands, kept with the scene: what draws or records it works nothing out."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import bpy

from ..model.scenario.kept import values_text
from .custom_properties import keep, kept_values

_STABILITY = "bda_stability"


def keep_stability(scene: bpy.types.Scene, stability: Mapping[str, Any] | None) -> None:
    """Keep a verdict as it is stored, or none."""
    keep(scene, _STABILITY, None if stability is None else values_text(dict(stability)))


def kept_stability(scene: bpy.types.Scene) -> dict[str, Any] | None:
    """Return the verdict that is kept with a scene; None where nothing was built, or nothing worked out."""
    return kept_values(scene, _STABILITY, {}) or None
