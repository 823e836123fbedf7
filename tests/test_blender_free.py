# SPDX-License-Identifier: GPL-3.0-or-later
"""Engineering, model and system work where Blender is not installed."""

from support.checkout import ROOT
from support.processes import run_program


def module_names():
    package = ROOT / "bridge_demolition_addon"
    paths = [
        path.relative_to(ROOT).with_suffix("")
        for layer in ("engineering", "model", "system")
        for path in sorted((package / layer).rglob("*.py"))
    ]
    return [".".join(path.parts).removesuffix(".__init__") for path in paths]


def test_every_module_below_the_scene_imports_without_blender():
    assert "bridge_demolition_addon.model.scenario" in module_names()
    done = run_program("import_without_blender", *module_names())
    assert (done.returncode, done.stderr) == (0, "")
