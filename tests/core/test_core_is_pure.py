"""The engineering in `core` works where Blender is not installed."""

import subprocess
import sys
from pathlib import Path

from places import ROOT

import bridge_demolition_addon.core

IMPORT_WITHOUT_BLENDER = """
import importlib, sys
for name in ("bpy", "mathutils", "bmesh", "gpu"):
    sys.modules[name] = None
refused = []
for name in sys.argv[1:]:
    try:
        importlib.import_module(name)
    except ImportError as error:
        refused.append(f"{name}: {error}")
sys.exit("\\n".join(refused) or 0)
"""


def module_names():
    folder = Path(bridge_demolition_addon.core.__file__).parent
    paths = [path.relative_to(ROOT).with_suffix("") for path in sorted(folder.rglob("*.py"))]
    return [".".join(path.parts).removesuffix(".__init__") for path in paths]


def test_every_module_of_core_imports_without_blender():
    assert "bridge_demolition_addon.core.scenario" in module_names()
    command = [sys.executable, "-c", IMPORT_WITHOUT_BLENDER, *module_names()]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")
