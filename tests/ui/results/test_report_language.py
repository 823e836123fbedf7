# SPDX-License-Identifier: GPL-3.0-or-later
"""The language of reports that the window offers, and the one that a report is made in."""

import pytest
from support.run_folders import flying_shards, keep_run

from bridge_demolition_addon.report.languages.table import language_names
from bridge_demolition_addon.ui.results.report_language import language_of_blender


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


def test_what_is_shown_is_what_a_report_is_made_in(extension, settings, tmp_path):
    assert settings.report_language == "en"  # Blender as a module has no language
    settings.output_directory = str(keep_run(tmp_path / "run", flying_shards()))
    for language, title in (("de", "Wichtigste Ergebnisse"), ("fr", "Principaux résultats"), ("en", "Main findings")):
        settings.report_language = language
        assert settings.report_language == language
        assert extension.ops.bda.make_report() == {"FINISHED"}
        assert title in (tmp_path / "run" / "report.html").read_text(encoding="utf-8")


def test_all_languages_can_be_chosen(settings):
    items = settings.bl_rna.properties["report_language"].enum_items
    assert tuple(item.identifier for item in items) == language_names()
