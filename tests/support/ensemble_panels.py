# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies, searches and optimisations in the sidebar, without a window."""

import time
from types import SimpleNamespace

from support.panel_layouts import Layout, without_blender

from bridge_demolition_addon.ui.ensemble.session import look_in
from bridge_demolition_addon.ui.registration import classes_of

PATIENCE_S = 300.0


def look_in_until(work, is_over=None):
    """Do what Blender's timer does, as there is none without a window; by default until the work has ended."""
    began = time.monotonic()
    while not (is_over() if is_over else work.session is None):
        assert time.monotonic() - began < PATIENCE_S
        look_in()
        assert work.why_ended == ""
        time.sleep(0.02)


def drawn(blender, module):
    """What the panels of a module draw, all of them open: texts of labels, and names of buttons and properties."""
    found = []

    class Recorded(Layout):
        def label(self, **settings):
            found.append(settings["text"])

        def operator(self, name, **settings):
            found.append(name)
            return super().operator(name, **settings)

        def prop(self, _owner, name, **settings):
            found.append(name)

    context = SimpleNamespace(
        scene=blender.context.scene,
        region=SimpleNamespace(width=100_000),  # a sentence on a line
        preferences=SimpleNamespace(system=SimpleNamespace(ui_scale=1.0)),
    )
    for panel in (cls for cls in classes_of(module) if issubclass(cls, blender.types.Panel)):
        without_blender(panel)(Recorded(context)).draw(context)
    return found
