# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure how long the sidebar's panels take to draw, all of them open, with many shards and charges.

Blender draws panels in a window only. Here every panel draws onto a layout that takes down nothing, so this is the
time of our own Python, lists of charges with all their visible rows included; tests/gui/job_sidebar.py takes the time
in Blender's window.
"""

import os
import sys
import time
from types import SimpleNamespace

import bpy
import numpy as np

import bridge_demolition_addon
from bridge_demolition_addon.model.blast.charges import Charge
from bridge_demolition_addon.scene.blast.charges import create_charges
from bridge_demolition_addon.ui.registration import classes
from bridge_demolition_addon.ui.sidebar import SidebarPanel

SHARDS = (100, 1000)
CHARGES = 100
ROUNDS = 50
VISIBLE_ROWS = 3


class Layout:
    """Takes everything that a panel draws, and draws the visible rows of a list as Blender does."""

    def __init__(self, context: SimpleNamespace):
        self._context = context

    def row(self, **_settings: object) -> "Layout":
        return self

    column = box = split = row

    def prop(self, *_names: object, **_settings: object) -> None:
        pass

    label = menu = progress = prop

    def operator(self, _name: str, **_settings: object) -> SimpleNamespace:
        return SimpleNamespace()

    def template_list(self, kind, _identifier, data, name, active, active_name, **_settings: object) -> None:
        drawn = next(each for each in classes() if each.__name__ == kind)
        for index, item in enumerate(getattr(data, name)[:VISIBLE_ROWS]):
            drawn.draw_item(SimpleNamespace(), self._context, self, data, item, 0, active, active_name, index)


def main() -> None:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bridge_demolition_addon.register()
    panels = [each for each in classes() if issubclass(each, SidebarPanel)]
    print(f"{len(panels)} panels, all open, {CHARGES} charges")
    for shards in SHARDS:
        scene = bpy.data.scenes.new(str(shards))
        bpy.context.window.scene = scene
        bpy.ops.bda.new_scenario()
        scene.bda.scenario.fracture.shards = shards
        bpy.ops.bda.build_scenario()
        create_charges(scene, [Charge(name=f"{shards} {n}", place_m=(n, 0, 1), mass_kg=1.0) for n in range(CHARGES)])
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
    drawn = [without_blender(each)(Layout(context)) for each in panels]
    times = []
    for _ in range(ROUNDS):
        began = time.perf_counter()
        for each in drawn:
            each.draw(context)
        times.append(time.perf_counter() - began)
    return 1e3 * float(np.median(times))


def without_blender(panel: type) -> type:
    """A class with all that a panel has of its own, which can be made outside of Blender's drawing."""
    own = [vars(each) for each in reversed(panel.__mro__) if issubclass(each, SidebarPanel)]
    contents = {name: value for found in own for name, value in found.items() if not name.startswith("__")}

    def keep_layout(self, layout: Layout) -> None:
        self.layout = layout

    contents.pop("bl_rna", None)
    return type(panel.__name__, (), contents | {"__init__": keep_layout})


if __name__ == "__main__":
    main()
    sys.stdout.flush()
    os._exit(0)
