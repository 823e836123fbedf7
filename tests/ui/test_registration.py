# SPDX-License-Identifier: GPL-3.0-or-later
"""Switching the extension on and off leaves nothing behind."""

import bridge_demolition_addon
from bridge_demolition_addon.ui.scenario.prop import registered_group


def test_registering_twice_leaves_nothing(blender):
    def found():
        bases = (blender.types.PropertyGroup, blender.types.Operator, blender.types.Panel, blender.types.UIList)
        ours = [subclass.__name__ for base in (*bases, blender.types.Menu) for subclass in base.__subclasses__()]
        return [name for name in ours if name.startswith("BDA_") and hasattr(blender.types, name)]

    for _ in range(2):
        bridge_demolition_addon.register()
        assert found()
        bridge_demolition_addon.unregister()
        assert found() == []
        assert not hasattr(blender.types.Scene, "bda")
        assert registered_group("BDA_PG_scenario") is None
