"""IfcOpenShell, which reads IFC: an extra of the installation, or what another extension of Blender has brought."""

from __future__ import annotations

import importlib
from importlib.util import find_spec
from types import ModuleType

from ..errors import MissingLibraryError

_OLDEST = (0, 8)
"""Version from which on the settings of its geometry have names."""

_HOW = (
    "install it with pip install 'bridge-demolition-addon[ifc]'; Blender has it where its extension Bonsai is "
    "installed, and can load the scenario that bda import makes elsewhere"
)


def library(part: str = "") -> ModuleType:
    """Return IfcOpenShell, or a part of it such as ``util.unit``."""
    try:
        whole = importlib.import_module("ifcopenshell")
        module = importlib.import_module(f"ifcopenshell.{part}") if part else whole
    except ImportError as error:
        if missing := missing_reason():
            raise MissingLibraryError(missing) from error
        raise MissingLibraryError(f"IfcOpenShell cannot be loaded ({error}): {_HOW}") from error
    version = tuple(int(digits) for digits in str(whole.version).split(".")[:2] if digits.isdigit())
    if version < _OLDEST:
        raise MissingLibraryError(f"IfcOpenShell {whole.version} is too old, 0.8 is needed: {_HOW}")
    return module


def missing_reason() -> str | None:
    """Return why IFC cannot be read here, in a sentence, or None where IfcOpenShell is installed."""
    return None if find_spec("ifcopenshell") else f"IFC is read by IfcOpenShell: {_HOW}"
