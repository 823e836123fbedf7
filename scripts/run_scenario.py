# SPDX-License-Identifier: GPL-3.0-or-later
"""``bda run`` inside Blender::

    blender -b --python scripts/run_scenario.py -- SCENARIO.toml --output DIR

The extension is used when it is switched on in that Blender, and else the checkout that this script is part of.
"""

import importlib
import os
import sys
import traceback
from pathlib import Path

PACKAGE = "bridge_demolition_addon"


def package() -> str:
    extensions = (name for name in sys.modules if name.startswith("bl_ext.") and name.endswith(f".{PACKAGE}"))
    if extension := next(extensions, None):
        return extension
    sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
    return PACKAGE


arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
sys.argv = ["bda", "run", *arguments]
# Left to itself, Blender tells of an error and then ends as if all were well.
try:
    importlib.import_module(f"{package()}.cli.main").entry()
except ModuleNotFoundError as error:
    print(
        f"run_scenario: the Python of this Blender has no {error.name}: install the extension's zip, again if it is "
        "there already, by Edit, Preferences, Get Extensions, Install from Disk; or put what pyproject.toml names "
        "into a folder, name it in PYTHONPATH, and start Blender with --python-use-system-env",
        file=sys.stderr,
    )
except Exception:
    traceback.print_exc()
sys.stderr.flush()
os._exit(1)
