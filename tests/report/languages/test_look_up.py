# SPDX-License-Identifier: GPL-3.0-or-later
"""Texts in a language and in units: values and units go in last, names stay, and a table may lack something."""

import pytest

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.engineering.unit_systems import UnitSystem
from bridge_demolition_addon.errors import OutputError
from bridge_demolition_addon.report.document.blocks import Column, DataTable, Document, Paragraph, Section
from bridge_demolition_addon.report.languages.letters import pieces
from bridge_demolition_addon.report.languages.translated_report import notes_at_head, translated_document, with_notes
from bridge_demolition_addon.report.languages.translation import IN_ENGLISH, ReportTexts, Translation, check_language
from bridge_demolition_addon.texts import DOWN, Quantity, Text, Unit, distance_to_keep, joined, point_text

TEXTS = {
    "{} of {} shards": "{1} Stücke, davon {0}",
    "{} and {}": "{} und {}",
    "span {}": "Feld {}",
    "{} came down": "unten: {}",
    "It stands": "Es steht",
    "energy|let go": "freigesetzt",
    "let go": "losgelassen",
    "road": "Straße",
    "deck": "Überbau",
    "short tons": "US-Tonnen",
}
US = Translation.into("en", UnitSystem.IMPERIAL)


def german(system=UnitSystem.METRIC):
    return Translation(ReportTexts("de", "de", False, TEXTS), system)


@pytest.mark.parametrize(
    ("text", "own"),
    [
        (Text("{} of {} shards", 3, 40), "40 Stücke, davon 3"),
        (
            Text("{} came down", joined("{} and {}", [Text("span {}", 1), Text("span {}", 2)])),
            "unten: Feld 1 und Feld 2",
        ),
        (Text("{} {}", Text("It stands."), Text("{} of {} shards", 3, 40)), "Es steht. 40 Stücke, davon 3"),
        (Text("let go"), "losgelassen"),
        (Text("let go", context="energy"), "freigesetzt"),
        (Quantity(12.5, "kN"), "12.5 kN"),
        ("deck", "Überbau"),
    ],
)
def test_values_are_put_where_the_translation_has_them(text, own):
    translation = german()
    assert translation.text(text) == own and translation.missing == []


def test_names_of_users_stay_though_they_are_words_or_quantities():
    translation = german(UnitSystem.IMPERIAL)
    assert translation.text("road") == "road" and translation.text("Span of 13 m") == "Span of 13 m"
    assert translation.text(Text("{} came down", "road")) == "unten: road" and translation.missing == []


@pytest.mark.parametrize(
    ("metric", "imperial"),
    [
        (Quantity(10, "t", ".1f"), "11.0 short tons"),
        (Quantity(999, "kN"), "224.6 kip"),
        (Text("x = {} to {}", Quantity("-3.11", "m", shown=False), Quantity("12.76", "m")), "x = -10.20 to 41.86 ft"),
        (point_text((6.5, 0)), "(21.3, 0) ft"),
        (Quantity("12 345", "kg"), "27216 lb"),
        (Text("{} = {}", "M_Ed", Quantity(5059, "kN·m")), "M_Ed = 3731 kip·ft"),
        (Text("throw ({})", Unit("m")), "throw (ft)"),
        (Quantity(0.5, "s"), "0.5 s"),
    ],
)
def test_quantities_are_converted(metric, imperial):
    assert US.text(metric) == imperial and IN_ENGLISH.text(metric) == metric


def test_a_distance_to_keep_is_rounded_up_whatever_the_sentence_says():
    """8.3 m are 27.231 ft (0.3048 m each, NIST SP 811)."""
    assert US.text(Text("Keep at least {} away", distance_to_keep("8.3"))) == "Keep at least 27.24 ft away"
    assert US.text(Quantity("8.3", "m", rounding=DOWN)) == "27.23 ft"


def test_words_of_a_unit_are_those_of_the_language():
    assert german(UnitSystem.IMPERIAL).text(Quantity("10.0", "t")) == "11.0 US-Tonnen"


def test_what_is_missing_stays_english_and_is_said_at_the_head():
    rows = [(Text("It stands."), 1.0), (Text("It leans."), 2.0), ("It is a name.", 3.0)]
    table = DataTable("t", "road", (Column("road", "a"), Column("", "b_m", ".1f")), rows)
    document = Document("Title", "", (Section("road", (Paragraph("It fell."), table)),))
    translation = german()
    own = translated_document(document, translation)
    assert translation.missing == ["It fell.", "It leans."]
    (section,) = own.sections
    assert section.title == "Straße"
    assert section.blocks[1].shown_rows() == [["Es steht.", "1.0"], ["It leans.", "2.0"], ["It is a name.", "3.0"]]
    (note,) = notes_at_head(translation, can_draw=True)
    assert "2" in note and "It fell.; It leans." in note
    assert with_notes(own, [note]).summary[0] == Paragraph(note, is_notice=True)


def test_a_column_has_its_unit_behind_its_heading_and_its_numbers_in_it():
    columns = (
        Column("throw", "throw_m", ".2f", is_reach=True),
        Column("", "unit"),
        Column("", "own", ".3g", of_row=True),
    )
    table = DataTable("t", "Throws", columns, [(8.3, Unit("kN"), 999.0), (None, Unit("%"), 5.0)])
    (own,) = translated_document(Document("", "", (), (table,)), US).summary
    assert [column.heading for column in own.columns] == ["throw (ft)", "", ""]
    assert own.shown_rows() == [["27.24", "kip", "224.6"], ["-", "%", "5"]]


def test_an_unknown_language_is_refused_with_those_that_there_are(tmp_path, capfd):
    with pytest.raises(OutputError, match="is 'xx': expected en, de, es, fr, zh_hans"):
        check_language("xx")
    assert main(["report", str(tmp_path), "--language", "xx"]) != 0
    assert "zh_hans" in capfd.readouterr().err


def test_lines_of_chinese_end_between_letters_and_not_before_a_full_stop():
    assert list(pieces("桥 Bridge站。x")) == [(" ", "桥"), (" ", "Bridge"), ("", "站。"), ("", "x")]
