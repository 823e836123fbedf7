"""The language and the units that reports are made in from the window: what the scenario asks for, else as shown here.

A choice is written into the scenario that the panels show, and so into its file.
"""

import bpy
from bpy.props import EnumProperty

from ...engineering.unit_systems import UnitSystem
from ...report.languages.table import ENGLISH, language_names
from ..scenario.prop import USE

_OWN_NAMES = {"en": "English", "de": "Deutsch", "es": "Español", "fr": "Français", "zh_hans": "简体中文"}
"""What speakers call the languages."""

_BEFORE_4 = {"zh_cn": "zh_hans"}
"""What versions of Blender before 4.0 call a language, where they call it otherwise."""

_SYSTEMS = tuple(UnitSystem)


def language_of_blender(locale: str) -> str:
    """Return the language of reports for what Blender calls its own, such as ``de_DE``; English without a table."""
    name = locale.lower()
    name = _BEFORE_4.get(name, name)
    return next((known for known in language_names() if name in (known, f"{known}_{name[len(known) + 1 :]}")), ENGLISH)


def shown_language(settings: bpy.types.PropertyGroup) -> str:
    """Return the language that reports of a scene are made in: that of the scenario, or else that of Blender."""
    return _asked(settings, "language") or language_of_blender(bpy.app.translations.locale or "")


def shown_units(settings: bpy.types.PropertyGroup) -> str:
    """Return the units that reports of a scene are made in: those of the scenario, or else those of the scene."""
    of_scene = settings.id_data.unit_settings.system
    return _asked(settings, "units") or (UnitSystem.IMPERIAL if of_scene == "IMPERIAL" else UnitSystem.METRIC).value


def _asked(settings: bpy.types.PropertyGroup, name: str) -> str | None:
    report = settings.scenario.report
    return getattr(report, name) if getattr(report, USE + name) else None


def _ask(settings: bpy.types.PropertyGroup, name: str, value: str) -> None:
    setattr(settings.scenario.report, name, value)
    setattr(settings.scenario.report, USE + name, True)


def _shown_language(settings: bpy.types.PropertyGroup) -> int:
    return language_names().index(shown_language(settings))


def _choose_language(settings: bpy.types.PropertyGroup, number: int) -> None:
    _ask(settings, "language", language_names()[number])


def _shown_units(settings: bpy.types.PropertyGroup) -> int:
    return _SYSTEMS.index(UnitSystem(shown_units(settings)))


def _choose_units(settings: bpy.types.PropertyGroup, number: int) -> None:
    _ask(settings, "units", _SYSTEMS[number].value)


class ReportProperties:
    """Settings of reports."""

    report_language: EnumProperty(
        name="Language",
        description="Language of the report. At first that of the scenario, or of Blender where reports have a table "
        "for it, else English. A choice goes into the scenario",
        items=[(name, _OWN_NAMES.get(name, name), "") for name in language_names()],
        get=_shown_language,
        set=_choose_language,
    )
    report_units: EnumProperty(
        name="Units",
        description="Units of the report. At first those of the scenario, or of Blender's scene: imperial where it "
        "shows feet, else metric. A choice goes into the scenario. Tables, logs and site plans stay in SI units",
        items=[
            (UnitSystem.METRIC.value, "Metric", "SI units: m, mm, t, kN, MPa"),
            (UnitSystem.IMPERIAL.value, "Imperial", "US customary units: ft, in, lb, short tons, kip, ksi, psi"),
        ],
        get=_shown_units,
        set=_choose_units,
    )
