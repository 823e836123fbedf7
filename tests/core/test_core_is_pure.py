"""The engineering in `core` works where Blender is not installed."""

from pathlib import Path

from places import ROOT
from processes import run_program

import bridge_demolition_addon.core


def module_names():
    folder = Path(bridge_demolition_addon.core.__file__).parent
    paths = [path.relative_to(ROOT).with_suffix("") for path in sorted(folder.rglob("*.py"))]
    return [".".join(path.parts).removesuffix(".__init__") for path in paths]


def test_every_module_of_core_imports_without_blender():
    assert "bridge_demolition_addon.core.scenario" in module_names()
    done = run_program("import_without_blender", *module_names())
    assert (done.returncode, done.stderr) == (0, "")
