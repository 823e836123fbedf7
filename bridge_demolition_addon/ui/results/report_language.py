"""The language that reports are made in from the window."""

import bpy
from bpy.props import EnumProperty, StringProperty

from ...report.languages.table import ENGLISH, language_names

_OWN_NAMES = {"en": "English", "de": "Deutsch", "es": "Español", "fr": "Français", "zh_hans": "简体中文"}
"""What speakers call the languages."""

_BEFORE_4 = {"zh_cn": "zh_hans"}
"""What versions of Blender before 4.0 call a language, where they call it otherwise."""


def language_of_blender(locale: str) -> str:
    """Return the language of reports for what Blender calls its own, such as ``de_DE``; English without a table."""
    name = locale.lower()
    name = _BEFORE_4.get(name, name)
    return next((known for known in language_names() if name in (known, f"{known}_{name[len(known) + 1 :]}")), ENGLISH)


def shown_language(settings: bpy.types.PropertyGroup) -> str:
    """Return the language that reports of a scene are made in: the one chosen, or at first that of Blender."""
    return settings.chosen_report_language or language_of_blender(bpy.app.translations.locale or "")


def _shown(settings: bpy.types.PropertyGroup) -> int:
    return language_names().index(shown_language(settings))


def _choose(settings: bpy.types.PropertyGroup, number: int) -> None:
    settings.chosen_report_language = language_names()[number]


class ReportProperties:
    """Settings of reports."""

    chosen_report_language: StringProperty(
        options={"HIDDEN"}, description="Language that was chosen for reports; none for that of Blender"
    )
    report_language: EnumProperty(
        name="Language",
        description="Language of the report. At first that of Blender where reports have a table for it, else English",
        items=[(name, _OWN_NAMES.get(name, name), "") for name in language_names()],
        get=_shown,
        set=_choose,
    )
