"""Tendons, kept with the scene: their lines, what they are, and the bodies and connections that they pass."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields
from typing import Any

import bpy
import numpy as np

from ...engineering.elasticity.tendons import TendonPassages, TendonSteel
from ...model.scenario.kept import values_text
from ...model.structure.tendons import ModelTendons
from ..custom_properties import edited, keep, kept_values

_TENDONS = "bda_tendons"
_WHOLE = ("tendons", "first", "second", "connections")
"""Whole numbers among what is kept of passages."""


def keep_tendons(
    scene: bpy.types.Scene,
    tendons: ModelTendons | None,
    shards: Sequence[bpy.types.Object],
    connections: Sequence[bpy.types.Object],
) -> None:
    """Keep the tendons of a model in the scene, by the names of its shards and connections; none for None."""
    if tendons is None:
        keep(scene, _TENDONS, None)
        return
    passed = {item.name: getattr(tendons.passages, item.name).tolist() for item in fields(TendonPassages)}
    passed["first"], passed["second"] = ([shards[row].name for row in passed[name]] for name in ("first", "second"))
    passed["connections"] = [connections[row].name if row >= 0 else "" for row in passed["connections"]]
    passed["openings_m"] = [opening if np.isfinite(opening) else None for opening in passed["openings_m"]]
    kept = {
        "names": tendons.names,
        "members": tendons.members,
        "steel": {item.name: getattr(tendons.steel, item.name).tolist() for item in fields(TendonSteel)},
        "passages": passed,
        "paths_m": [path.tolist() for path in tendons.paths_m],
    }
    keep(scene, _TENDONS, values_text(kept))


def tendons_of(
    scene: bpy.types.Scene, bodies: Sequence[bpy.types.Object], connections: Sequence[bpy.types.Object]
) -> ModelTendons | None:
    """Return the tendons of a scene with bodies and connections in this order; None without any."""
    kept = kept_values(scene, _TENDONS, {})
    if not kept:
        return None
    rows = {body.name: row for row, body in enumerate(bodies)}
    rows_of_connections = {connection.name: row for row, connection in enumerate(connections)}
    try:
        passed = kept["passages"]
        values: dict[str, Any] = {item.name: passed[item.name] for item in fields(TendonPassages)}
        values["first"], values["second"] = ([rows[name] for name in passed[end]] for end in ("first", "second"))
        values["connections"] = [rows_of_connections.get(name, -1) for name in passed["connections"]]
        values["openings_m"] = [np.inf if opening is None else opening for opening in passed["openings_m"]]
        arrays = {name: np.array(numbers, int if name in _WHOLE else float) for name, numbers in values.items()}
        return ModelTendons(
            tuple(kept["names"]),
            tuple(kept["members"]),
            TendonSteel(**{name: np.array(numbers) for name, numbers in kept["steel"].items()}),
            TendonPassages(**arrays),
            tuple(np.array(path, float) for path in kept["paths_m"]),
        )
    except (KeyError, TypeError, ValueError) as error:
        raise edited(scene, _TENDONS, "the tendons that the add-on wrote, in shards that are all there") from error
