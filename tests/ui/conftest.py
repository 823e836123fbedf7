"""The extension as it is when it is switched on."""

from collections.abc import Iterator
from types import ModuleType

import pytest

import bridge_demolition_addon


@pytest.fixture
def extension(blender: ModuleType) -> Iterator[ModuleType]:
    """The bpy module with an empty scene and the extension on."""
    bridge_demolition_addon.register()
    yield blender
    bridge_demolition_addon.unregister()


@pytest.fixture
def settings(extension: ModuleType):
    """The settings of the scene."""
    return extension.context.scene.bda
