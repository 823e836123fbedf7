# SPDX-License-Identifier: GPL-3.0-or-later
"""What the extension leaves in Blender and on disk, for a job to check."""

import csv
import importlib
from collections import Counter
from pathlib import Path
from types import ModuleType
from typing import Any

import bpy
import numpy as np
from person import Person

EXTENSION = "bl_ext.user_default.bridge_demolition_addon"
CHECKOUT = Path(__file__).resolve().parents[2]
SCENARIO = CHECKOUT / "tests" / "gui" / "small.toml"
PRESETS = CHECKOUT / "bridge_demolition_addon" / "ui" / "scenario" / "presets"


def module(name: str) -> ModuleType:
    """A module of the extension."""
    return importlib.import_module(f"{EXTENSION}.{name}")


def scenario_in(file: Path) -> Any:
    """The scenario in a file."""
    return module("model.scenario.file").read_scenario(file)


def scenario_shown(scene: bpy.types.Scene) -> Any:
    """The scenario that the panels show."""
    return module("ui.scenario.values").scenario_of(scene.bda)


def charges(scene: bpy.types.Scene) -> tuple[Any, ...]:
    """The charges of a scene."""
    return module("scene.blast.charges").charges_of(scene)


def colours(person: Person, shown: bool = False) -> np.ndarray:
    """Colours of all bodies, their own or as they are shown."""
    bodies = person.scene.rigidbody_world.collection.all_objects
    graph = person.window.view_layer.depsgraph
    return np.array([(body.evaluated_get(graph) if shown else body).color for body in bodies])


def opened() -> list[str]:
    """What the system's file manager was asked to open."""
    file = Path.home() / "opened.txt"
    return file.read_text(encoding="utf-8").splitlines() if file.exists() else []


def recording_runs() -> bool:
    """Whether a recording runs, or ended early and was not stopped yet."""
    return module("simulation.blender_events").running_recording() is not None


def something_goes_on() -> bool:
    """Whether a recording runs, or its pictures are taken, or anything else shows how far it is."""
    return recording_runs() or module("ui.task_progress").going_on() is not None


def handlers() -> Counter[str]:
    """How often each handler of the extension is registered."""
    lists = {name: getattr(bpy.app.handlers, name) for name in dir(bpy.app.handlers)}
    return Counter(
        f"{name}: {handler.__module__}.{handler.__qualname__}"
        for name, functions in lists.items()
        if isinstance(functions, list)
        for handler in functions
        if handler.__module__.startswith(EXTENSION)
    )


def everything() -> dict[str, list[str]]:
    """Names of all that a file holds and a demolition is made of."""
    kinds = ("scenes", "objects", "meshes", "materials", "collections", "actions")
    return {kind: [data.name for data in getattr(bpy.data, kind)] for kind in kinds}


def rows(log: Path) -> list[dict[str, str]]:
    """A log's lines by the names of its columns.

    Raises
    ------
    ValueError
        A line is not whole.
    """
    text = log.read_text(encoding="utf-8")
    lines = list(csv.reader(text.splitlines()))
    if not text.endswith("\n") or any(len(line) != len(lines[0]) for line in lines):
        raise ValueError(f"{log.name} has a line that is not whole")
    return [dict(zip(lines[0], line, strict=True)) for line in lines[1:]]


def pixels_of(picture: Path) -> np.ndarray:
    """Red, green and blue of a picture, (n, 3) float."""
    image = bpy.data.images.load(str(picture))
    pixels = np.array(image.pixels).reshape(-1, image.channels)[:, :3]
    bpy.data.images.remove(image)
    return pixels
