# SPDX-License-Identifier: GPL-3.0-or-later
"""Every text that reports make has a translation in every language: a new sentence fails until it has."""

import pytest
from support.long_cases import long_but
from support.reports_of_many_kinds import reports

from bridge_demolition_addon.report.document.drawings import drawings
from bridge_demolition_addon.report.languages.table import ENGLISH, language_names, language_table
from bridge_demolition_addon.report.languages.translated_report import translated_document
from bridge_demolition_addon.report.languages.translation import Translation

LANGUAGES = [name for name in language_names() if name != ENGLISH]


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """Reports of many kinds."""
    return list(reports(tmp_path_factory.mktemp("reports")))


@pytest.mark.parametrize("language", long_but(["de"], LANGUAGES))
def test_all_texts_of_all_kinds_of_reports_are_translated(made, language):
    for report in made:
        translation = Translation.into(language, report.names)
        for document in (report.document, *report.single_pages.values()):
            translated_document(document, translation)
        assert translation.missing == [], report.document.title


@pytest.mark.long
def test_all_texts_in_drawings_are_translated(made):
    for report in made:
        translation = Translation.into("de", report.names)
        drawings(translated_document(report.document, translation), translation=translation)
        assert translation.missing == [], report.document.title


def test_a_new_sentence_would_be_missed(made):
    translation = Translation.into("de", made[0].names)
    assert translation.text("The bridge will be rebuilt by noon.") == "The bridge will be rebuilt by noon."
    assert translation.missing == ["The bridge will be rebuilt by noon"]


def test_all_tables_have_the_same_texts():
    first, *others = (language_table(language).texts for language in LANGUAGES)
    for other in others:
        assert list(other) == list(first)
