"""Help for who sees the sidebar for the first time: three sentences, and the walkthrough, which needs no network."""

from __future__ import annotations

from pathlib import Path

import bpy

from .operators import Action
from .results.operator import open_path
from .sidebar import draw_sentence

_PACKAGE = Path(__file__).parents[1]
_PAGES = (_PACKAGE / "walkthrough" / "walkthrough.html", _PACKAGE.parent / "docs" / "walkthrough.md")
"""In the extension, or in a checkout."""

SENTENCES = (
    "A preset fills in all values: change what is different in your bridge below.",
    "Build Scenario cuts the bridge into shards and connects them; charges and the ball can be moved.",
    "Run simulates it, and leaves forces and debris in a folder; Make Report makes a report of it.",
)


class BDA_OT_open_walkthrough(Action, bpy.types.Operator):
    """Open the walkthrough, a demolition by mouse step by step, in the system's browser; it came with the extension"""

    bl_idname = "bda.open_walkthrough"
    bl_label = "Walkthrough"
    changes_scene = False

    def act(self, _context: bpy.types.Context) -> None:
        open_path(walkthrough())


CLASSES = (BDA_OT_open_walkthrough,)


def walkthrough() -> Path:
    """Return the page of the walkthrough."""
    return next((page for page in _PAGES if page.is_file()), _PAGES[0])


def draw_first_help(layout: bpy.types.UILayout, context: bpy.types.Context) -> None:
    """Draw the help, as long as nothing is built in the scene."""
    if context.scene.bda.built_scenario:
        return
    box = layout.box()
    for sentence in SENTENCES:
        draw_sentence(box, context, sentence, icon="DOT")
    box.operator(BDA_OT_open_walkthrough.bl_idname, icon="HELP")
