# SPDX-License-Identifier: GPL-3.0-or-later
"""The language and the units of reports that the window offers, and those that a report is made in."""

import pytest
from support.run_folders import flying_shards, keep_run

from bridge_demolition_addon.report.languages.translation import language_names
from bridge_demolition_addon.ui.results.operator import language_of_blender
from bridge_demolition_addon.ui.scenario.values import scenario_of


@pytest.mark.parametrize(
    ("locale", "language"),
    [
        *(
            ("de_DE", "de"),
            ("es", "es"),
            ("es_ES", "es"),
            ("fr_FR", "fr"),
            ("zh_HANS", "zh_hans"),
            ("zh_CN", "zh_hans"),
        ),
        *(("en_US", "en"), ("zh_HANT", "en"), ("ja_JP", "en"), ("", "en")),
    ],
)
def test_at_first_it_is_that_of_blender_where_there_is_a_table(locale, language):
    assert language_of_blender(locale) == language


@pytest.mark.long
def test_what_is_shown_is_what_a_report_is_made_in(extension, settings, tmp_path):
    assert settings.report_language == "en"  # Blender as a module has no language
    settings.output_directory = str(keep_run(tmp_path / "run", flying_shards()))
    choices = (
        *(("de", "imperial", "Wichtigste Ergebnisse", "US-amerikanischen Einheiten"),),
        *(("en", "metric", "Main findings", "together 15.9 t"),),
    )
    for language, units, *texts in choices:
        settings.report_language, settings.report_units = language, units
        assert (settings.report_language, settings.report_units) == (language, units)
        assert extension.ops.bda.make_report() == {"FINISHED"}
        page = (tmp_path / "run" / "report.html").read_text(encoding="utf-8")
        assert [text for text in texts if text not in page] == []


def test_units_are_at_first_those_of_the_scene_and_a_choice_goes_into_the_scenario(extension, settings):
    units = extension.context.scene.unit_settings
    assert settings.report_units == "metric"
    units.system = "IMPERIAL"
    try:
        assert settings.report_units == "imperial"
        settings.report_units = "metric"
        assert settings.report_units == "metric"
        report = scenario_of(settings).report
        assert (report.units, report.language) == ("metric", None)
    finally:
        units.system = "METRIC"


def test_all_languages_can_be_chosen(settings):
    items = settings.bl_rna.properties["report_language"].enum_items
    assert tuple(item.identifier for item in items) == language_names()
