# SPDX-License-Identifier: GPL-3.0-or-later
"""Every text that reports make has a translation in every language: a release refuses a sentence that has none.

And every quantity in it can be read, and put into US customary units.
"""

import re

import pytest
from support.long_cases import long_but
from support.reports_of_many_kinds import reports
from support.untranslated import OF_RELEASE, warn_of

from bridge_demolition_addon.engineering.unit_systems import IMPERIAL, UnitSystem
from bridge_demolition_addon.model.scenario.recording import REPORT_LANGUAGES
from bridge_demolition_addon.report.document.blocks import DataTable, Paragraph
from bridge_demolition_addon.report.document.drawings import drawings
from bridge_demolition_addon.report.languages.translated_report import NOTE, translated_document
from bridge_demolition_addon.report.languages.translation import ENGLISH, Translation, language_names, language_table
from bridge_demolition_addon.texts import Text

NAMES_WITH_UNITS = ("z = 2.45 m", "y = 0.00 m", "41 m", "house <5 kPa")
"""Names of bodies, of cases of the validation, and of a criterion."""

LANGUAGES = [name for name in language_names() if name != ENGLISH]


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """Reports of many kinds."""
    return list(reports(tmp_path_factory.mktemp("reports")))


@pytest.mark.parametrize("language", long_but(["de"], LANGUAGES))
def test_all_texts_of_all_kinds_of_reports_are_translated(made, language):
    for report in made:
        translation = Translation.into(language)
        for document in (report.document, *report.single_pages.values()):
            translated_document(document, translation)
        warn_of(translation.missing, translation.table.name)


@pytest.mark.long
def test_all_texts_in_drawings_are_translated(made):
    for report in made:
        translation = Translation.into("de")
        drawings(translated_document(report.document, translation), translation=translation)
        warn_of(translation.missing, translation.table.name)


def test_a_new_sentence_would_be_missed():
    translation = Translation.into("de")
    new = Text("The bridge will be rebuilt by noon.")
    assert translation.text(new) == new and translation.missing == [new]


def test_a_text_without_a_translation_is_a_warning_that_a_release_refuses(monkeypatch):
    monkeypatch.delenv(OF_RELEASE, raising=False)
    with pytest.warns(UserWarning, match="de lacks 1 texts, the first is Rebuilt"):
        warn_of([Text("Rebuilt")], "de")
    monkeypatch.setenv(OF_RELEASE, "1")
    warn_of([], "de")
    with pytest.raises(AssertionError):
        warn_of([Text("Rebuilt")], "de")


@pytest.mark.parametrize("language", long_but(["en"], REPORT_LANGUAGES))
def test_no_quantity_of_any_kind_of_report_stays_metric_in_us_units(made, language):
    for report in made:
        translation = Translation.into(language, UnitSystem.IMPERIAL)
        for document in (report.document, *report.single_pages.values()):
            measured = translated_document(document, translation)
            assert [text for text in texts_of(measured) if is_metric(text)] == []


def texts_of(document):
    """Yield all texts of a report but for captions."""
    for block in document.blocks():
        if isinstance(block, Paragraph):
            yield block.text
        elif isinstance(block, DataTable) and block.name != "rank_correlations":  # whose numbers have no unit
            yield from (block.title, *(column.heading for column in block.columns))
            yield from (cell for row in block.shown_rows() for cell in row)


def is_metric(text):
    """Return whether a text has a metric unit behind a number or in brackets, but where it has to."""
    text = re.sub(r"v = .*?\)\^-[\d.]+|^\s*[a-z]\S* = .*|\w+_kg \(kg\)|\d CFR \S+", "", text)
    for name in NAMES_WITH_UNITS:
        text = text.replace(name, "")
    units = "|".join(re.escape(unit) for unit in IMPERIAL)
    return re.search(rf"\d\S? (?:{units})(?![\w²³·/^])|[(\uff08](?:{units})[,)\uff09]", text) is not None


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_note_on_units_and_names_of_units_are_translated(language):
    texts = language_table(language).texts
    assert {NOTE, *(conversion.unit for conversion in IMPERIAL.values() if " " in conversion.unit)} <= texts.keys()


def test_scenarios_can_ask_for_every_language():
    assert language_names() == REPORT_LANGUAGES


def test_all_tables_have_the_same_texts():
    first, *others = (language_table(language).texts for language in LANGUAGES)
    for other in others:
        assert list(other) == list(first)
