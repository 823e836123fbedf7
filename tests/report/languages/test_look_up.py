# SPDX-License-Identifier: GPL-3.0-or-later
"""Look-up of texts with values in them, what stays as it is, and a table that lacks something."""

import pytest

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.errors import OutputError
from bridge_demolition_addon.report.document.blocks import Column, DataTable, Document, Paragraph, Section
from bridge_demolition_addon.report.languages.letters import pieces
from bridge_demolition_addon.report.languages.table import ReportTexts, check_language
from bridge_demolition_addon.report.languages.translated_report import (
    notes_on_language,
    translated_document,
    with_notes,
)
from bridge_demolition_addon.report.languages.translation import Translation

TEXTS = {
    "{} of {} shards": "{1} Stücke, davon {0}",
    "{} and {}": "{} und {}",
    "span {}": "Feld {}",
    "{} came down": "unten: {}",
    "It stands.": "Es steht.",
    "road": "Straße",
}


def german(*names, **texts):
    return Translation(ReportTexts("de", "de", False, TEXTS | texts), names)


@pytest.mark.parametrize(
    ("english", "own"),
    [
        ("3 of 40 shards", "40 Stücke, davon 3"),
        ("span 1 and span 2 came down", "unten: Feld 1 und Feld 2"),
        ("It stands. 3 of 40 shards.", "Es steht. 40 Stücke, davon 3."),
        ("road", "Straße"),
        ("12.5 kN", "12.5 kN"),
        ("see time.duration_s", "see time.duration_s"),
    ],
)
def test_values_are_put_where_the_translation_has_them(english, own):
    assert german().text(english) == own


def test_names_of_users_stay():
    translation = german("road")
    assert translation.text("road") == "road" and translation.missing == []


def test_what_is_missing_stays_english_and_is_said_at_the_head():
    rows = [("It stands.", 1.0), ("It leans.", 2.0)]
    table = DataTable("t", "road", (Column("road", "a"), Column("", "b", ".1f")), rows)
    document = Document("Title", "", (Section("road", (Paragraph("It fell."), table)),))
    translation = german("Title")
    own = translated_document(document, translation)
    assert translation.missing == ["It fell", "It leans"]
    (section,) = own.sections
    assert section.title == "Straße" and section.blocks[1].shown_rows() == [["Es steht.", "1.0"], ["It leans.", "2.0"]]
    (note,) = notes_on_language(translation, can_draw=True)
    assert "2" in note and "It fell; It leans" in note
    assert with_notes(own, [note]).summary[0] == Paragraph(note, is_notice=True)


def test_a_report_in_english_is_the_document_itself():
    document = Document("Title", "", ())
    assert translated_document(document, Translation.into("en")) is document


def test_an_unknown_language_is_refused_with_those_that_there_are(tmp_path, capfd):
    with pytest.raises(OutputError, match="is 'xx': expected en, de, es, fr, zh_hans"):
        check_language("xx")
    assert main(["report", str(tmp_path), "--language", "xx"]) != 0
    assert "zh_hans" in capfd.readouterr().err


def test_lines_of_chinese_end_between_letters_and_not_before_a_full_stop():
    assert list(pieces("桥 Bridge站。x")) == [(" ", "桥"), (" ", "Bridge"), ("", "站。"), ("", "x")]
