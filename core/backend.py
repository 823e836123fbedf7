# SPDX-License-Identifier: GPL-3.0-or-later
"""How pip builds the package (PEP 517): by setuptools, after the compiled core.

`--config-setting platform=NAME --config-setting library=FILE` puts a core that was built before into a wheel for
another machine.
"""

import shutil
from collections.abc import Mapping
from typing import Any

import build_core
from setuptools import build_meta
from setuptools.build_meta import (  # noqa: F401  which pip calls
    build_sdist,
    get_requires_for_build_sdist,
    prepare_metadata_for_build_editable,
    prepare_metadata_for_build_wheel,
)

Settings = Mapping[str, Any] | None


def get_requires_for_build_wheel(config_settings: Settings = None) -> list[str]:
    """Return what setuptools needs, and a compiler where there is none and no library is given."""
    compiler = [] if "library" in (config_settings or {}) else build_core.get_requires_for_build_wheel()
    return [*build_meta.get_requires_for_build_wheel(), *compiler]


def get_requires_for_build_editable(config_settings: Settings = None) -> list[str]:
    """Return what setuptools needs, and a compiler where there is none."""
    return [*build_meta.get_requires_for_build_editable(), *build_core.get_requires_for_build_wheel()]


def build_wheel(wheel_directory: str, config_settings: Settings = None, metadata_directory: str | None = None) -> str:
    """Build the wheel for one system, as it holds a library of it."""
    settings = config_settings or {}
    platform = build_core.PLATFORMS[settings["platform"]] if "platform" in settings else build_core.here()
    if "library" in settings:
        shutil.copy(settings["library"], build_core.ROOM / platform.library)
    else:
        build_core.update(platform=platform)
    options = {"--build-option": f"--plat-name={platform.tag}"}
    return build_meta.build_wheel(wheel_directory, options, metadata_directory)


def build_editable(
    wheel_directory: str, config_settings: Settings = None, metadata_directory: str | None = None
) -> str:
    """Build the core into the checkout, and the wheel that leads there."""
    build_core.update()
    return build_meta.build_editable(wheel_directory, config_settings, metadata_directory)
