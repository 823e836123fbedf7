"""The extension's settings, for tests of the sidebar."""

from types import ModuleType

import pytest


@pytest.fixture
def settings(extension: ModuleType):
    """The settings of the scene."""
    return extension.context.scene.bda
