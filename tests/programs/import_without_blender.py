# SPDX-License-Identifier: GPL-3.0-or-later
"""Import modules where Blender's cannot be imported, and say which of them refuse. Usage: … MODULE…"""

import importlib
import sys

from absent_blender import hide_blender

hide_blender()
refused = []
for name in sys.argv[1:]:
    try:
        importlib.import_module(name)
    except ImportError as error:
        refused.append(f"{name}: {error}")
sys.exit("\n".join(refused) or 0)
