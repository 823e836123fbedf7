"""Modules that need Blender, loaded only when a command needs them."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType

from ..errors import SimulationError
from ..system.signals import interrupted_afterwards


def simulation_module(name: str) -> ModuleType:
    """Return a module of `simulation`: scenarios can be read and checked where Blender is not installed."""
    try:
        with interrupted_afterwards():
            return import_module(f"...simulation.{name}", __name__)
    except ModuleNotFoundError as error:
        if error.name != "bpy":
            raise
        raise SimulationError("Blender is not there: install the bpy package or run inside Blender") from error
