# SPDX-License-Identifier: GPL-3.0-or-later
"""Panels that are drawn without a window, onto a layout that keeps nothing."""

from types import SimpleNamespace

from bridge_demolition_addon.ui.registration import classes
from bridge_demolition_addon.ui.sidebar import SidebarPanel

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

    label = menu = operator_menu_enum = progress = template_icon_view = prop

    def operator(self, _name: str, **_settings: object) -> SimpleNamespace:
        return SimpleNamespace()

    def template_list(self, kind, _identifier, data, name, active, active_name, **_settings: object) -> None:
        drawn = next(cls for cls in classes() if cls.__name__ == kind)
        for index, item in enumerate(getattr(data, name)[:VISIBLE_ROWS]):
            drawn.draw_item(SimpleNamespace(), self._context, self, data, item, 0, active, active_name, index)


def texts_drawn(panel: type, blender) -> list[str]:
    """What a panel draws of the scene that Blender shows: texts of labels, and names of buttons, in their order."""
    found: list[str] = []

    class Told(Layout):
        def label(self, **settings: object) -> None:
            found.append(str(settings["text"]))

        def operator(self, name: str, **settings: object) -> SimpleNamespace:
            found.append(name)
            return super().operator(name, **settings)

    context = SimpleNamespace(
        scene=blender.context.scene,
        region=SimpleNamespace(width=100_000),  # a sentence on a line
        preferences=SimpleNamespace(system=SimpleNamespace(ui_scale=1.0)),
    )
    without_blender(panel)(Told(context)).draw(context)
    return found


def without_blender(panel: type) -> type:
    """A class with all that a panel has of its own, which can be made outside of Blender's drawing."""
    own = [vars(base) for base in reversed(panel.__mro__) if issubclass(base, SidebarPanel)]
    contents = {name: value for found in own for name, value in found.items() if not name.startswith("__")}

    def keep_layout(self, layout: Layout) -> None:
        self.layout = layout

    contents.pop("bl_rna", None)
    return type(panel.__name__, (), contents | {"__init__": keep_layout})
