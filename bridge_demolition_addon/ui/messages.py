"""Messages that stay in the sidebar: what buttons warned of or refused last, until they are pressed again."""

from __future__ import annotations

from dataclasses import dataclass

import bpy

from .sidebar import draw_sentence

_MOST = 6
"""Of the newest that are drawn."""


@dataclass(frozen=True, slots=True)
class Message:
    """A sentence that a button said in a scene."""

    button: str
    scene_uid: int
    level: str
    text: str


_kept: list[Message] = []


def tell(operator: bpy.types.Operator, level: str, text: str) -> None:
    """Report a sentence as Blender does, which shows it for some seconds, and keep it for the sidebar."""
    operator.report({level}, text)
    _kept.append(Message(operator.bl_idname, bpy.context.scene.session_uid, level, text))


def clear(operator: bpy.types.Operator) -> None:
    """Forget what a button said before, as it is pressed again."""
    _kept[:] = [each for each in _kept if each.button != operator.bl_idname]


def clear_all() -> None:
    """Forget all of them."""
    _kept.clear()


def messages_of(scene: bpy.types.Scene) -> list[Message]:
    """Return what there is to say in a scene, oldest first."""
    return [each for each in _kept if each.scene_uid == scene.session_uid][-_MOST:]


def draw_messages(layout: bpy.types.UILayout, context: bpy.types.Context) -> None:
    """Draw what stays to be said, with a button that takes it away."""
    found = messages_of(context.scene)
    if not found:
        return
    box = layout.box()
    for each in found:
        draw_sentence(
            box, context, each.text, icon="CANCEL" if each.level == "ERROR" else each.level.replace("WARNING", "ERROR")
        )
    box.operator("bda.dismiss_messages", icon="X")


class BDA_OT_dismiss_messages(bpy.types.Operator):
    """Take these messages away"""

    bl_idname = "bda.dismiss_messages"
    bl_label = "Dismiss"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if messages_of(context.scene):
            return True
        cls.poll_message_set("There are no messages")
        return False

    def execute(self, _context: bpy.types.Context) -> set[str]:
        clear_all()
        return {"FINISHED"}


CLASSES = (BDA_OT_dismiss_messages,)
