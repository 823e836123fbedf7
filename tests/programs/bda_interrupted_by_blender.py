# SPDX-License-Identifier: GPL-3.0-or-later
"""Run the command line; Ctrl-C reaches it whenever Blender loads a file or its factory settings."""

import os
import signal

import bpy

from bridge_demolition_addon.cli.main import entry


@bpy.app.handlers.persistent
def interrupt(*_):
    os.kill(os.getpid(), signal.SIGINT)


bpy.app.handlers.load_pre.append(interrupt)
entry()
