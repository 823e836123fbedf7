# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure how long the sidebar's panels take to draw, all of them open, with many shards and charges.

Blender draws panels in a window only. Here every panel draws onto a layout that takes down nothing, so this is the
time of our own Python, lists of charges with all their visible rows included; tests/gui/job_sidebar.py takes the time
in Blender's window.
"""

import sys
import time
from pathlib import Path
from types import SimpleNamespace

import bpy
import numpy as np

sys.path.insert(1, str(Path(__file__).resolve().parents[2] / "tests"))

from support.panel_layouts import Layout, without_blender

import bridge_demolition_addon
from bridge_demolition_addon.model.blast.charges import Charge
from bridge_demolition_addon.scene.blast.charges import create_charges
from bridge_demolition_addon.ui.registration import classes
from bridge_demolition_addon.ui.sidebar import SidebarPanel

SIZES = (100, 1000)
CHARGES = 100
ROUNDS = 50


def main(smallest: bool) -> None:
    """Print the time of all panels for each number of shards."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bridge_demolition_addon.register()
    panels = [cls for cls in classes() if issubclass(cls, SidebarPanel)]
    print(f"{len(panels)} panels, all open, {CHARGES} charges")
    for shards in (10,) if smallest else SIZES:
        scene = bpy.data.scenes.new(str(shards))
        bpy.context.window.scene = scene
        bpy.ops.bda.new_scenario()
        scene.bda.scenario.fracture.shards = shards
        bpy.ops.bda.build_scenario()
        create_charges(scene, [Charge(name=f"{shards} {n}", position_m=(n, 0, 1), mass_kg=1.0) for n in range(CHARGES)])
        print(f"{shards} shards: {milliseconds(panels, scene):.2f} ms")
    bridge_demolition_addon.unregister()


def milliseconds(panels: list[type], scene: bpy.types.Scene) -> float:
    """Median time to draw all panels once, ms."""
    system = SimpleNamespace(ui_scale=1.0)
    context = SimpleNamespace(
        scene=scene,
        view_layer=scene.view_layers[0],
        region=SimpleNamespace(width=280),
        preferences=SimpleNamespace(system=system),
    )
    drawn = [without_blender(panel)(Layout(context)) for panel in panels]
    times = []
    for _ in range(ROUNDS):
        began = time.perf_counter()
        for shown in drawn:
            shown.draw(context)
        times.append(time.perf_counter() - began)
    return 1e3 * float(np.median(times))
