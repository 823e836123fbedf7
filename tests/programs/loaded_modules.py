# SPDX-License-Identifier: GPL-3.0-or-later
"""Load the command line or switch the extension on, and say which of the slow libraries came along.

Usage: loaded_modules.py "command line" | extension
"""

import os
import sys

SLOW = {"bpy", "matplotlib", "scipy", "trimesh"}

if sys.argv[1] == "extension":
    import bridge_demolition_addon

    bridge_demolition_addon.register()
else:
    from bridge_demolition_addon.cli.main import main

    main(["--help"])  # loads all commands

print(*sorted(SLOW & sys.modules.keys()), flush=True)
os._exit(0)  # Blender's own end may hang or crash where its handlers are registered.
