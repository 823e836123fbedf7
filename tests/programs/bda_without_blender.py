# SPDX-License-Identifier: GPL-3.0-or-later
"""Be the command line where Blender's modules cannot be imported. Usage: … ARGUMENTS OF BDA"""

import sys

from absent_blender import hide_blender

hide_blender()

from bridge_demolition_addon.cli.main import main  # noqa: E402

sys.exit(main(sys.argv[1:]))
