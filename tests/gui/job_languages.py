# SPDX-License-Identifier: GPL-3.0-or-later
"""The window in German, Spanish, French and Chinese: labels, tooltips, sentences; nothing of it once switched off."""

import bpy
from person import Person, Steps
from traces import EXTENSION, module

LABELS = {
    "de_DE": ("Szenario aufbauen", "Lauf starten", "Überbau", "Bruchkraft (N)", "Ganzer Lauf"),
    "es": ("Construir escenario", "Ejecutar", "Tablero", "Fuerza de rotura (N)", "Toda la ejecución"),
    "fr_FR": ("Construire le scénario", "Lancer le calcul", "Tablier", "Force de rupture (N)", "Tout le calcul"),
    "zh_HANS": ("生成场景", "运行", "桥面板", "断裂力 (N)", "整个运行"),
    "en_US": ("Build Scenario", "Run", "Deck", "Breaking Force (N)", "Whole Run"),
}
"""By Blender's name of a language: two buttons, a panel, a value with its unit, and a choice."""


def steps(person: Person) -> Steps:
    yield from person.open_sidebar()
    view = bpy.context.preferences.view
    for language, labels in LABELS.items():
        view.language = language
        yield 0.5
        person.expect(f"labels are right with {language}", found_labels(), labels)
        yield from person.picture(language)
    view.language = "de_DE"
    tooltip = bpy.app.translations.pgettext_tip(operator("run").description)
    person.expect("tooltips are German", tooltip.startswith("Vom ersten Einzelbild bis zum letzten simulieren"))
    own, of_blender = translated("Scale", "bda"), translated("Scale", "*")
    person.expect("Blender's own words stay as they are", (own, of_blender), ("Maßstab", "Skalieren"))
    person.expect("a sentence is German", translated("Choose a picture first", "bda"), "Wählen Sie zuerst ein Bild")
    yield from switch_off_and_on(person)
    view.language = "en_US"
    person.take_reports()


def switch_off_and_on(person: Person) -> Steps:
    """Switch the extension off and on again: Blender keeps its tables from then to then."""
    for text in ("Lauf starten", "Run", "Lauf starten"):
        person.expect("Run is called as it should be", translated("Run", "bda"), text)
        enable = text == "Run"
        if enable:
            bpy.ops.preferences.addon_enable(module=EXTENSION)
        else:
            bpy.ops.preferences.addon_disable(module=EXTENSION)
        yield 0.5
    bpy.ops.preferences.addon_enable(module=EXTENSION)


def found_labels() -> tuple[str, ...]:
    """What the buttons, panel, value and choice of LABELS are called now."""
    force = bpy.context.scene.bda.scenario.connections.bl_rna.properties["breaking_force_n"]
    deck = next(cls for cls in module("ui.registration").classes() if cls.__name__ == "BDA_PT_bridge_deck")
    return (
        *(translated(operator(name).name, operator(name).translation_context) for name in ("build_scenario", "run")),
        translated(deck.bl_label, deck.bl_translation_context),
        translated(force.name, force.translation_context),
        bpy.types.UILayout.enum_item_name(bpy.context.scene.bda, "contour_range", "RUN"),
    )


def operator(name: str) -> bpy.types.Struct:
    """What Blender knows of a button."""
    return getattr(bpy.ops.bda, name).get_rna_type()


def translated(text: str, context: str) -> str:
    """A text as Blender draws it."""
    return bpy.app.translations.pgettext_iface(text, context)
