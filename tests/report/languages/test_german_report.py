# SPDX-License-Identifier: GPL-3.0-or-later
"""A report in German, read back from its page, its PDF and its Word file: no English sentence is left."""

import csv
import re
from html.parser import HTMLParser

import docx
import pytest
from support.run_folders import flying_shards, keep_run

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.report.document import page as page_style
from bridge_demolition_addon.report.document import pdf
from bridge_demolition_addon.report.write import write_report

pytestmark = pytest.mark.long  # test_nothing_is_missing.py shows of every text that it has a translation

ENGLISH = re.compile(r"\b(?:the|of|and|is|are|were|with|without|this|that|which|from|has|have|not|shards?)\b")
"""Words that nearly every English sentence has one of, and no German one has."""

KEPT = re.compile(
    r"\S+[._/]\S+|Hong Kong.*|Code of Practice for Demolition of Buildings|Road <1>.*|School & yard"
    r"|[A-Z][\w. ]+ and [A-Z]\w+|(?:Clancey|Richmond|ASCE|BS|DIN|DGUV|HSE|CDM|3\. SprengV|29 CFR|30 CFR)\b.*",
    re.DOTALL,
)
"""Names of files, keys, sources by their titles, and names that the scenario of the tests has."""


class Texts(HTMLParser):
    """The texts of a page, without style, script and the listing of the scenario."""

    def __init__(self, html):
        super().__init__()
        self.found, self._left_out = [], 0
        self.feed(html)

    def handle_starttag(self, tag, attributes):
        self._left_out += tag in ("style", "script", "pre")

    def handle_endtag(self, tag):
        self._left_out -= tag in ("style", "script", "pre")

    def handle_data(self, data):
        if not self._left_out and data.strip():
            self.found.append(data.strip())


def english_in(texts):
    return [text for text in texts if ENGLISH.search(KEPT.sub(" ", text))]


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """The folder of a run with everything that a report tells of and its German report, and the lines of its PDFs."""
    folder = keep_run(tmp_path_factory.mktemp("runs") / "run", flying_shards())
    lines, sentences, lay_out = [], [], pdf.laid_out
    patch = pytest.MonkeyPatch()

    def noted(*arguments):
        pages = lay_out(*arguments)
        lines.append([line.text for page in pages for line in page.lines if line.font != page_style.LISTING])
        sentences.append(
            [line.text for page in pages for line in page.lines if line.font in (page_style.TEXT, page_style.STRONG)]
        )
        return pages

    patch.setattr(pdf, "laid_out", noted)
    write_report([folder], None, language="de", word=True, pages=("client", "crew"), progress=Silence())
    patch.undo()
    return folder, lines, sentences


@pytest.fixture(scope="module")
def folder(made):
    return made[0]


def test_the_page_is_german(folder):
    html = (folder / "report.html").read_text(encoding="utf-8")
    assert '<html lang="de">' in html
    texts = Texts(html).found
    assert len(texts) > 300 and "Wichtigste Ergebnisse" in texts
    assert english_in(texts) == []


def test_all_pdfs_are_german(made):
    report, client, crew = made[1]
    assert "Seite 1 von" in " ".join(report) and "Bereiche" in report
    assert any("Für den Auftraggeber" in line for line in client) and "Abzuhaken" in crew
    for lines in (client, crew):
        assert english_in(lines) == []
    sentences = made[2][0]  # without tables, whose narrow columns cut words
    assert len(sentences) > 80 and english_in(sentences) == []


def test_the_word_file_is_german(folder):
    file = docx.Document(str(folder / "report.docx"))
    cells = [cell.text for table in file.tables for row in table.rows for cell in row.cells]
    texts = [paragraph.text for paragraph in file.paragraphs if "[scenario]" not in paragraph.text]
    assert english_in([*texts, *cells]) == []
    assert "Seite " in file.sections[0].footer.paragraphs[0].text


def test_tables_as_files_stay_english(folder):
    with (folder / "tables" / "findings.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    assert rows[0] == ["fact", "value"] and rows[1][0] == "Impact of the ball"
