# SPDX-License-Identifier: GPL-3.0-or-later
"""The Word file of a report, read again by python-docx: the same headings, tables and pictures as the page."""

import re
import shutil
from datetime import datetime
from html import unescape
from pathlib import Path

import docx
import pytest
from support.run_folders import TOLD, flying_shards, keep_run

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.errors import MissingLibraryError, OutputError
from bridge_demolition_addon.report.document import word_library
from bridge_demolition_addon.report.document.blocks import Document, Listing, Section
from bridge_demolition_addon.report.document.word import write_word
from bridge_demolition_addon.report.write import write_report

pytestmark = pytest.mark.long


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A folder with a report and its Word file, and both read."""
    folder = keep_run(tmp_path_factory.mktemp("runs") / "run", flying_shards(6, 13), TOLD)
    write_report([folder], None, word=True, pages=["crew"], progress=Silence())
    page = (folder / "report.html").read_text(encoding="utf-8")
    return folder, page, docx.Document(str(folder / "report.docx"))


def texts(page, tag):
    return [unescape(text) for text in re.findall(rf"<{tag}[^>]*>(.*?)</{tag}>", page, re.DOTALL)]


def styled(file, name):
    return [paragraph.text for paragraph in file.paragraphs if paragraph.style.name == name]


def test_headings_are_those_of_the_page(made):
    _, page, file = made
    assert styled(file, "Title") == texts(page, "h1") == [TOLD.title]
    assert styled(file, "Heading 1") == texts(page, "h2")
    assert file.core_properties.title == TOLD.title


def test_tables_are_those_of_the_page(made):
    _, page, file = made
    captions = texts(page, "caption")
    assert len(file.tables) == len(captions) and set(captions) <= set(styled(file, "Caption"))
    for written, shown in zip(file.tables, texts(page, "table"), strict=True):
        rows = [
            [unescape(cell) for cell in re.findall(r"<t[dh][^>]*>(.*?)</t[dh]>", row)] for row in texts(shown, "tr")
        ]
        assert [[cell.text for cell in row.cells] for row in written.rows] == rows


def test_pictures_and_their_captions_are_those_of_the_page(made):
    _, page, file = made
    assert len(file.inline_shapes) == page.count("<img ")
    pictures = [text for text in texts(page, "figcaption") if not text.startswith("The run: drag")]
    assert len(pictures) == len(file.inline_shapes) and set(pictures) <= set(styled(file, "Caption"))
    assert all(shape.width.mm <= 170.1 and shape.height.mm <= 220.1 for shape in file.inline_shapes)


def test_notices_of_the_page_are_set_apart(made):
    _, page, file = made
    notices = [unescape(text) for text in re.findall(r'<p class="notice">(.*?)</p>', page)]
    assert styled(file, "Intense Quote") == notices


def test_pages_are_a4_and_have_numbers(made):
    _, _, file = made
    (section,) = file.sections
    assert (round(section.page_width.mm), round(section.page_height.mm)) == (210, 297)
    assert 'w:instr="PAGE"' in section.footer.paragraphs[0]._p.xml


def test_lines_of_a_listing_stay_lines(tmp_path):
    document = Document("A", "", (Section("One", (Listing("a = 1\n  b = 2\n"),)),))
    write_word(document, {}, tmp_path / "a.docx")
    assert "a = 1\n  b = 2" in [paragraph.text for paragraph in docx.Document(str(tmp_path / "a.docx")).paragraphs]


def test_the_command_writes_it_and_the_same_run_gives_the_same_file(made, tmp_path, capsys):
    folder, _, _ = made
    assert main(["report", str(folder), "--output", str(tmp_path), "--docx", "--pages", "crew"]) == 0
    written = [Path(line) for line in capsys.readouterr().out.splitlines() if line.startswith(str(tmp_path))]
    assert tmp_path / "report.docx" in written
    for path in written:
        assert path.read_bytes() == (folder / path.relative_to(tmp_path)).read_bytes(), path.name


def test_a_file_that_was_changed_by_hand_is_not_overwritten(made, tmp_path):
    folder = shutil.copytree(made[0], tmp_path / "run")
    path = folder / "report.docx"
    write_report([folder], None, word=True, progress=Silence())
    file = docx.Document(str(path))
    file.paragraphs[0].text, file.core_properties.modified = "Filled in", datetime(2026, 1, 2)
    file.save(str(path))
    with pytest.raises(OutputError, match="was changed by hand, and would be lost: save it under another name"):
        write_report([folder], None, word=True, progress=Silence())
    assert docx.Document(str(path)).paragraphs[0].text == "Filled in"


def test_without_the_library_the_message_names_it(tmp_path, monkeypatch):
    monkeypatch.setattr(word_library, "WORD_LIBRARY", "no_such_library")
    with pytest.raises(MissingLibraryError, match=r"python-docx, .* pip install 'bridge-demolition-addon\[word\]'"):
        write_report([tmp_path], None, word=True, progress=Silence())
