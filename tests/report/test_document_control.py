# SPDX-License-Identifier: GPL-3.0-or-later
"""What identifies a report is on its first page and at the foot of each, in page, PDF and Word file, read back."""

import itertools
import re
from dataclasses import replace

import docx
import pytest
from support.scenarios import I235

from bridge_demolition_addon.model.run_folder.own_code import own_code
from bridge_demolition_addon.model.scenario.file import scenario_from_text, scenario_text
from bridge_demolition_addon.model.scenario.site import Site
from bridge_demolition_addon.report.document import pdf
from bridge_demolition_addon.report.document.blocks import Document, Paragraph, Section
from bridge_demolition_addon.report.document.html import write_html
from bridge_demolition_addon.report.document.pdf import write_pdf
from bridge_demolition_addon.report.document.word import write_word
from bridge_demolition_addon.report.languages.translated_report import translated_document
from bridge_demolition_addon.report.languages.translation import Translation
from bridge_demolition_addon.report.sections.control import document_control
from bridge_demolition_addon.report.single_pages import single_pages

GIVEN = {
    "project": "Overbridge A 5",
    "document_number": "BD-17",
    "client": "County roads",
    "site": "A 5, km 12.3",
    "author": "E. Gineer",
    "checked_by": "C. Hecker",
    "date": "2026-11-29",
    "revision": "B",
    "changed": "Cordon 300 m",
}
FINGERPRINT = {"program": "1a2b3c4d5e6f", "built": "ff7c52ab" + "0" * 56, "result": "aa11bb22" + "0" * 56}
PLANNED = replace(I235, report=replace(I235.report, **GIVEN), site=Site(latitude_deg=41.5, longitude_deg=-93.625))
FOOT = re.compile(r"No\. BD-17; revision B; program [\d.]+, code 1a2b3c4d5e6f; built ff7c52ab; result aa11bb22$")
WORDS = "One sentence that fills a line of a page, more or less, and is not about anything. "
BODY = tuple(Section(f"Part {letter}", (Paragraph(40 * WORDS),)) for letter in "ABCDEFG")


def document_of(scenario=PLANNED, fingerprint=FINGERPRINT):
    control = document_control(scenario, fingerprint)
    return Document("Two spans", "A report", BODY, (Paragraph("Stays: none."),), control)


def lines_of(document):
    return [[str(line.text) for line in page.lines] for page in pdf.laid_out(document, {})]


def objects_of(content):
    """Objects of a PDF that are no streams, by their numbers."""
    found = re.findall(rb"^(\d+) 0 obj\n(.*?)\nendobj", content, flags=re.S | re.M)
    return {int(number): body.decode("latin-1") for number, body in found if b"stream" not in body}


def test_all_that_is_given_stands_on_the_first_page_with_lines_to_sign():
    first, *_ = lines_of(document_of())
    for text in (*GIVEN.values(), "+41.50000° -93.62500°, WGS 84", "Approved by"):
        assert text in first
    assert sum(set(text) == {"_"} for text in first) == 7  # three dates, three signatures, and who approves


def test_every_page_says_which_document_program_and_run_it_is_of():
    pages = lines_of(document_of())
    assert len(pages) > 2
    assert [sum(FOOT.search(text) is not None for text in page) for page in pages] == [1] * len(pages)


def test_without_keys_a_report_has_its_program_and_lines_to_sign_alone():
    plain = document_of(I235, {"program": own_code()})
    first, *_ = lines_of(plain)
    assert plain.control.cover == () and "Prepared by" in first and "Project" not in first
    assert plain.control.foot.endswith(own_code()) and re.fullmatch("[0-9a-f]{12}", own_code())


def test_coordinates_alone_make_no_table():
    placed = replace(I235, site=PLANNED.site)
    assert document_control(placed).cover == () and document_control(PLANNED).cover


def test_contents_give_the_page_on_which_each_section_begins():
    pages = lines_of(document_of())
    begins = {
        text: number
        for number, page in enumerate(pages, start=1)
        for text, after in itertools.pairwise(page)
        if re.match(r"\d Part", text) and after.startswith("One sentence")
    }
    listed = [text for page in pages for text in page if re.match(r"\d Part", text)]
    assert sorted(begins) == sorted(set(listed)) and len(listed) == 2 * len(BODY)
    numbers = [text for page in pages[:2] for text in page if text.isdigit()]
    assert numbers == [str(begins[text]) for text in sorted(begins)]


def test_the_pdf_has_title_author_subject_language_and_a_bookmark_for_each_section(tmp_path):
    write_pdf(document_of(), {}, tmp_path / "report.pdf")
    content = (tmp_path / "report.pdf").read_bytes()
    found = objects_of(content)
    (root,) = (body for body in found.values() if "/Type /Catalog" in body)
    assert "/Lang (en" in root and "/PageMode /UseOutlines" in root
    (about,) = (body for body in found.values() if "/Producer" in body)
    for entry in ("/Title (Two spans)", "/Subject (A report)", "/Author (E. Gineer)"):
        assert entry in about
    outlines = found[int(re.search(r"/Outlines (\d+) 0 R", root)[1])]
    number, titles = int(re.search(r"/First (\d+) 0 R", outlines)[1]), []
    while number:
        entry = found[number]
        titles.append(re.search(r"/Title \((.*?)\)", entry)[1])
        page = int(re.search(r"/Dest \[ (\d+) 0 R", entry)[1])
        assert "/Type /Page" in found[page]
        following = re.search(r"/Next (\d+) 0 R", entry)
        number = int(following[1]) if following else 0
    assert titles == [f"{place} {section.title}" for place, section in enumerate(BODY, start=1)]
    # Every object is where the table at the end says, so that readers find them.
    table = re.search(rb"xref\n0 \d+\n(.*?)trailer", content, flags=re.S)[1].splitlines()
    for place, line in enumerate(table[1:], start=1):
        start = int(line.split()[0])
        assert content[start:].startswith(f"{place} 0 obj".encode())


def test_the_word_file_has_it_too(tmp_path):
    write_word(document_of(), {}, tmp_path / "report.docx")
    file = docx.Document(str(tmp_path / "report.docx"))
    about = file.core_properties
    assert (about.title, about.author, about.subject) == ("Two spans", "E. Gineer", "A report")
    cells = [cell.text for table in file.tables for row in table.rows for cell in row.cells]
    assert set(GIVEN.values()) <= set(cells)
    assert FOOT.search(file.sections[0].footer.paragraphs[-1].text)
    (field,) = (each for each in file.element.iter() if "TOC" in "".join(each.attrib.values()))
    assert all(section.title in "".join(field.itertext()) for section in BODY)


def test_the_page_has_it_too_and_browsers_print_it_at_the_foot_of_each(tmp_path):
    write_html(document_of(), {}, tmp_path / "report.html")
    text = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert '<meta name="author" content="E. Gineer">' in text
    assert all(f"<td>{value}</td>" in text for value in GIVEN.values())
    printed, shown = re.search(r'@bottom-left \{ content: "(.*?)"', text)[1], re.search("<footer>(.*?)<", text)[1]
    assert printed == shown and FOOT.search(shown)


def test_single_pages_say_which_document_they_are_of():
    pages = single_pages(document_of(), PLANNED)
    assert all(FOOT.search(page.control.foot) for page in pages.values())
    assert not any(page.control.cover or page.control.signatures for page in pages.values())


@pytest.mark.parametrize(("language", "role"), [("de", "Geprüft von"), ("fr", "Vérifié par"), ("es", "Revisado por")])
def test_it_is_in_the_language_of_the_report(language, role):
    translation = Translation.into(language)
    translated = translated_document(document_of(), translation)
    assert translated.control.signatures[0].rows[1][:2] == (role, "C. Hecker")
    assert "BD-17" in translated.control.foot
    lacking = [text for text in translation.missing if "Part" not in text and "sentence" not in text]
    assert set(lacking) <= {"Two spans", "A report", "Stays: none."}


def test_a_foot_that_would_end_the_style_of_the_page_is_harmless(tmp_path):
    odd = replace(PLANNED, report=replace(PLANNED.report, document_number='7"; } </style><script>'))
    write_html(document_of(odd), {}, tmp_path / "report.html")
    text = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert text.count("</style>") == 1 and "<script>" not in text


def test_keys_are_kept_in_the_scenario_of_a_run():
    assert scenario_from_text(scenario_text(PLANNED)).report == PLANNED.report
