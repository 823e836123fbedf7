# SPDX-License-Identifier: GPL-3.0-or-later
"""End a process in which Blender holds memory and Python has plans for its own end."""

import atexit

import bpy

from bridge_demolition_addon.cli.console import end_process

bpy.ops.mesh.primitive_cube_add()
atexit.register(print, "Python cleaned up")
print("all was done", flush=True)
end_process(3)
