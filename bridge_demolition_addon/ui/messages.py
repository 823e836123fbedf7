"""Messages that stay in the sidebar: warnings and refusals of buttons, until they are pressed again."""

from __future__ import annotations

from dataclasses import dataclass

import bpy

from .languages.words import translated
from .sidebar import draw_sentence

_MOST = 6
"""Newest messages that are drawn."""

_ICONS = {"ERROR": "CANCEL", "WARNING": "ERROR"}


@dataclass(frozen=True, slots=True)
class Message:
    """A message of an operator, in the scene in which it was pressed."""

    button: str
    scene_uid: int
    level: str
    text: str


_kept: list[Message] = []


def tell(operator: bpy.types.Operator, level: str, text: str) -> None:
    """Report a sentence as Blender does, which shows it for some seconds, and keep it for the sidebar.

    For an error Blender opens a window under the mouse, which takes the next click: an error of a button that was
    clicked is reported as a warning, and only scripts get it as one that they can catch.
    """
    was_clicked = operator.options.is_invoke
    operator.report({"WARNING" if was_clicked and level == "ERROR" else level}, text)
    note(bpy.context.scene, operator.bl_idname, level, text)


def note(scene: bpy.types.Scene, button: str, level: str, text: str) -> None:
    """Keep a sentence for the sidebar that belongs to a button, by its id, which is not at work itself."""
    _kept.append(Message(button, scene.session_uid, level, text))


def clear(operator: bpy.types.Operator) -> None:
    """Forget the messages of a button, as it is pressed again."""
    clear_button(operator.bl_idname)


def clear_button(button: str) -> None:
    """Forget the messages of a button, by its id."""
    _kept[:] = [message for message in _kept if message.button != button]


def clear_of(scene: bpy.types.Scene) -> None:
    """Forget the messages of a scene, as they are of what it had before."""
    _kept[:] = [message for message in _kept if message.scene_uid != scene.session_uid]


def clear_all() -> None:
    """Forget all messages."""
    _kept.clear()


def messages_of(scene: bpy.types.Scene) -> list[Message]:
    """Return the newest messages of a scene, oldest first."""
    return [message for message in _kept if message.scene_uid == scene.session_uid][-_MOST:]


def draw_messages(layout: bpy.types.UILayout, context: bpy.types.Context) -> None:
    """Draw the messages, with a button that removes them."""
    kept = messages_of(context.scene)
    if not kept:
        return
    box = layout.box()
    for message in kept:
        draw_sentence(box, context, message.text, icon=_ICONS.get(message.level, message.level))
    box.operator("bda.dismiss_messages", icon="X")


class BDA_OT_dismiss_messages(bpy.types.Operator):
    """Remove these messages"""

    bl_idname = "bda.dismiss_messages"
    bl_label = "Dismiss"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if messages_of(context.scene):
            return True
        cls.poll_message_set(translated("There are no messages"))
        return False

    def execute(self, _context: bpy.types.Context) -> set[str]:
        clear_all()
        return {"FINISHED"}
