# SPDX-License-Identifier: GPL-3.0-or-later
"""The tables of languages have all texts of the window and no others, and Blender gets them under the own context."""

import ast
import re
import tomllib
from functools import cache

import pytest
from support.checkout import ROOT
from support.untranslated import warn_of
from window_languages import differences, put_together, texts_in, window_texts

from bridge_demolition_addon.ui.languages import tables
from bridge_demolition_addon.ui.languages.tables import LanguageTable, table_files
from bridge_demolition_addon.ui.languages.words import CONTEXT, translated

UI = ROOT / "bridge_demolition_addon" / "ui"
LANGUAGES = [path.stem for path in table_files()]
PARTS = ("labels", "sentences", "tooltips")
PLACES = re.compile(r"\{[^}]*\}|%\w")
TOOLTIPS_OF_ALL = "*"


@cache
def table(language):
    return LanguageTable.read(tables.FOLDER / f"{language}.toml")


@pytest.fixture
def texts(extension):
    return window_texts()


def test_german_spanish_french_and_chinese_are_there():
    assert LANGUAGES == ["de", "es", "fr", "zh_hans"]
    # As Blender 4.3 names them (bpy.app.translations.locales); before 4.0 it said zh_CN. Without a country, de is all.
    known = {"de_DE", "es", "fr_FR", "zh_HANS"}
    named = {locale for language in LANGUAGES for locale in table(language).locales}
    assert all(locale in named or locale.partition("_")[0] in named for locale in known)


@pytest.mark.parametrize("language", LANGUAGES)
def test_no_label_and_no_sentence_is_missing_in_a_release_and_nothing_is_stale(texts, language):
    for part in PARTS:
        missing, stale = differences(getattr(table(language), part), getattr(texts, part))
        assert stale == [], f"{part} of {language} that the window does not show (any more)"
        warn_of(missing, language)


@pytest.mark.parametrize("language", LANGUAGES)
def test_translations_have_the_places_for_values_of_their_english_texts(language):
    for part in PARTS:
        for english, own in getattr(table(language), part).items():
            assert own.strip(), f"{english!r} has an empty translation"
            assert PLACES.findall(own) == PLACES.findall(english), english


@pytest.mark.parametrize("language", LANGUAGES)
def test_tooltips_end_without_a_full_stop_which_blender_adds(language):
    assert [own for own in table(language).tooltips.values() if own.endswith((".", "。"))] == []


@pytest.mark.parametrize("language", LANGUAGES)
def test_texts_of_a_table_stand_in_order_so_that_a_speaker_finds_them(language):
    parts = tomllib.loads((tables.FOLDER / f"{language}.toml").read_text(encoding="utf-8"))
    for part in PARTS:
        assert list(parts[part]) == sorted(parts[part])


def test_units_stand_behind_translated_labels_of_keys():
    german = table("de").translations()
    assert german[CONTEXT, "Breaking Force (N)"] == "Bruchkraft (N)"
    assert german[CONTEXT, "Row Delay (ms)"] == "Reihenverzögerung (ms)"
    assert german[CONTEXT, "Bridge"] == "Brücke"
    assert table("zh_hans").translations()[CONTEXT, "Breaking Force (N)"] == "断裂力 (N)"


def test_tooltips_of_keys_have_typical_value_name_and_limits():
    english = (
        "Thickness of the slab. Typical: 0.4 m. In a scenario file: bridge.deck.thickness_m, a number from 0.001 to "
        "10000.0 (m)"
    )
    german = table("de").translations()[TOOLTIPS_OF_ALL, english]
    assert (
        german == "Dicke der Platte. Üblich: 0.4 m. In einer Szenariodatei: bridge.deck.thickness_m, 0.001 … 10000.0 m"
    )


def test_every_tooltip_that_blender_asks_for_is_german(extension):
    german = table("de").translations()
    for name in ("deck", "piers", "abutments", "girders"):
        group = getattr(extension.context.scene.bda.scenario.bridge, name)
        for prop in group.bl_rna.properties:
            if not prop.is_hidden and prop.identifier not in ("rna_type", "name"):
                assert (TOOLTIPS_OF_ALL, prop.description) in german
                assert (prop.translation_context, prop.name) in german


def test_panels_buttons_and_properties_have_the_own_context(extension):
    from bridge_demolition_addon.ui.registration import classes

    for cls in classes():
        if hasattr(cls, "bl_label"):
            assert cls.bl_translation_context == CONTEXT
        if issubclass(cls, extension.types.Operator):
            operator = getattr(extension.ops.bda, cls.bl_idname.removeprefix("bda.")).get_rna_type()
            assert operator.translation_context == CONTEXT
            own = [prop for prop in operator.properties if prop.identifier not in ("rna_type", "check_existing")]
            assert {prop.translation_context for prop in own} <= {CONTEXT}, cls


def test_properties_of_the_scene_have_the_own_context(extension):
    def outside(group):
        for prop in group.bl_rna.properties:
            if prop.identifier in ("rna_type", "name"):
                continue
            if prop.translation_context != CONTEXT:
                yield f"{group.bl_rna.identifier}.{prop.identifier}"
            if prop.type == "POINTER":
                yield from outside(getattr(group, prop.identifier))

    assert list(outside(extension.context.scene.bda)) == []


def test_without_a_table_a_text_stays_english(extension):
    assert translated("no such text in any table") == "no such text in any table"


@pytest.mark.parametrize(
    ("code", "found"),
    [
        ('row.operator("bda.run", text="Run it")', ["Run it"]),
        ('column.prop(settings, "path", text="", placeholder=translated("Scenario file"))', ["Scenario file"]),
        ('draw_sentence(layout, context, "Nothing yet", icon="INFO")', ["Nothing yet"]),
        ('text = "Show" if hidden else "Hide"', ["Show", "Hide"]),
        ('translated("{} frames").format(12)', ["{} frames"]),
        ('def reason(context):\n    return None if context else "Go there first"', ["Go there first"]),
        ('blocked_by = (unset("path", "Choose a file first"),)', ["Choose a file first"]),
        ('class Task:\n    task, unit = "Rendering", "pictures"', ["Rendering", "pictures"]),
        ('layout.prop(settings, "contours")', []),
        ('layout.prop(settings, "path", placeholder="Scenario file")', []),  # Blender does not look it up
    ],
)
def test_texts_are_found_where_panels_show_them(code, found):
    assert [text for text in texts_in(ast.parse(code)) if text != "INFO"] == found


def test_what_is_drawn_is_no_text_put_together_which_no_table_can_have():
    found = {str(path): list(put_together(ast.parse(path.read_text(encoding="utf-8")))) for path in UI.rglob("*.py")}
    assert len(found) > 50
    assert {path: texts for path, texts in found.items() if texts} == {}


def test_texts_put_together_are_found():
    code = 'label(text=f"{count} frames")\ndraw_sentence(layout, context, f"Ended: {error}")\nlabel(text=f"{a}: {b}")'
    assert list(put_together(ast.parse(code))) == ["f'{count} frames'", "f'Ended: {error}'"]
