"""Modules that need Blender, loaded only when a command needs them."""

from __future__ import annotations

from contextlib import nullcontext
from importlib import import_module
from tempfile import gettempdir
from types import ModuleType

from ..errors import SimulationError
from ..system.processor import on_one_core
from ..system.signals import interrupted_afterwards


def simulation_module(name: str, *, one_thread: bool = False) -> ModuleType:
    """Return a module of `simulation`: scenarios can be read and checked where Blender is not installed.

    A command that renders nothing has it with `one_thread`, where Blender was not loaded before.
    """
    gettempdir()  # a run needs it when it saves its scene: without one it is refused before it begins
    try:
        with interrupted_afterwards(), on_one_core() if one_thread else nullcontext():
            return import_module(f"...simulation.{name}", __name__)
    except ModuleNotFoundError as error:
        if error.name != "bpy":
            raise
        raise SimulationError("Blender is not there: install the bpy package or run inside Blender") from error
