"""Whether what is about to be built is drawn, kept in the scene as part of ``scene.bda``."""

import bpy
from bpy.props import BoolProperty

from ..contours import view as contour_view


def _redraw(_settings: bpy.types.PropertyGroup, _context: bpy.types.Context) -> None:
    contour_view.redraw()


class PreviewProperties:
    """The part of the scene's settings on the preview."""

    show_preview: BoolProperty(
        name="Preview",
        description="While this tab is open, draw bridge and ball as the panels would build them, where nothing is "
        "built or other values were, and show handles to drag the ball's target and the charges",
        default=True,
        update=_redraw,
    )
