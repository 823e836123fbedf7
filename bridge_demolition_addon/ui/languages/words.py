"""Texts of the window in the language that the user has chosen in Blender.

All of them are looked up in a translation context of the add-on's own. So words that Blender translates in another
sense do not get in here, and Blender's own texts stay as they are.
"""

from __future__ import annotations

from inspect import get_annotations

import bpy

CONTEXT = "bda"

_PACKAGE = __name__.partition(".ui.")[0]


def translated(text: str) -> str:
    """Return a text in the user's language; the text itself where the table of the language does not have it.

    A text with values in it is looked up as a pattern, and the values are put in afterwards:
    ``translated("{} frames").format(12)``.
    """
    return bpy.app.translations.pgettext_iface(text, CONTEXT)


def in_own_context(cls: type) -> type:
    """Return a class that is about to be registered, with its label and its properties' labels in this context."""
    if not issubclass(cls, bpy.types.PropertyGroup):
        cls.bl_translation_context = CONTEXT
    for base in cls.__mro__:
        if base.__module__.startswith(_PACKAGE):  # others are Blender's
            for annotation in get_annotations(base).values():
                if hasattr(annotation, "keywords"):  # what bpy.props returns until the class is registered
                    annotation.keywords["translation_context"] = CONTEXT
    return cls
