# SPDX-License-Identifier: GPL-3.0-or-later
"""Python as it is where there is no Blender."""

import sys


def hide_blender() -> None:
    """Let no module of Blender be imported."""
    for name in ("bpy", "mathutils", "bmesh", "gpu"):
        sys.modules[name] = None
