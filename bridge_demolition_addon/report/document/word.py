"""Write a report as a Word file, from the same blocks as page and PDF; headings, tables and captions have styles."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Callable, Sequence
from datetime import datetime
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from ...charts.style import PAGE_WIDTH_MM
from ...system.disk import whole_file
from ..languages.translation import IN_ENGLISH, Translation
from .blocks import AnimatedModel, Block, DataTable, Document, Listing, Paragraph, Photo, Picture
from .drawings import Drawings
from .word_library import check_word

_NO_TIME = datetime(2000, 1, 1)
"""When the file says it was made: the same run gives the same bytes."""

_ZIP_TIME = (1980, 1, 1, 0, 0, 0)
_PAGE_MM, _MARGINS_MM = (210.0, 297.0), (20.0, 20.0)
_DOTS_PER_INCH = 200.0
_HIGHEST_MM = 220.0
"""Of a picture, so that its caption stands on the same page."""

_SMALL_PT, _LISTING_PT = 8.0, 7.0
_TABLE_STYLE, _NOTICE_STYLE, _CAPTION_STYLE = "Table Grid", "Intense Quote", "Caption"


def is_as_written(path: Path) -> bool:
    """Return whether a Word file is as it was written here: programs note the time when they save one."""
    import docx
    from docx.opc.exceptions import PackageNotFoundError

    try:
        return bool(docx.Document(str(path)).core_properties.modified.replace(tzinfo=None) == _NO_TIME)
    except (OSError, KeyError, ValueError, zipfile.BadZipFile, PackageNotFoundError):
        return False


def write_word(
    document: Document,
    drawings: Drawings,
    path: Path,
    finished: Callable[[int, int], None] = lambda *_: None,
    translation: Translation = IN_ENGLISH,
) -> None:
    """Write a report; `finished` is called with how many of its sections are written, and how many there are.

    `translation` has the words at the foot of each page.
    """
    check_word()
    written = _Word(drawings, translation)
    written.title(document)
    total = len(document.sections)
    for number, section in enumerate(document.sections, start=1):
        written.heading(f"{number} {section.title}")
        written.add(section.blocks)
        finished(number, total)
    with whole_file(path) as part:
        part.write_bytes(_without_times(written.content()))


class _Word:
    """A Word file that grows from its top."""

    def __init__(self, drawings: Drawings, translation: Translation) -> None:
        import docx
        from docx.shared import Mm, Pt

        self._drawings = drawings
        self._translation = translation
        self._mm, self._pt = Mm, Pt
        self._file: Any = docx.Document()
        page = self._file.sections[0]
        page.page_width, page.page_height = map(Mm, _PAGE_MM)
        page.left_margin = page.right_margin = Mm(_MARGINS_MM[0])
        page.top_margin = page.bottom_margin = Mm(_MARGINS_MM[1])

    def title(self, document: Document) -> None:
        """Write title, summary, and the foot of every page."""
        about = self._file.core_properties
        about.title, about.author, about.comments = document.title[:255], document.control.author[:255], ""
        about.subject = document.subtitle[:255]
        about.created = about.modified = _NO_TIME
        self._file.add_paragraph(document.title, "Title")
        self._file.add_paragraph(document.subtitle, "Subtitle")
        self.add(document.first_page)
        self._contents(document)
        foot = self._file.sections[0].footer.paragraphs[0]
        before, between, after = self._translation.pattern("page {} of {}").split("{}")
        foot.add_run(f"{document.title}\t{before}")
        _add_field(foot, "PAGE")
        foot.add_run(between)
        _add_field(foot, "NUMPAGES")
        foot.add_run(after)
        if document.control.foot:
            self._file.sections[0].footer.add_paragraph(document.control.foot, "Footer")

    def heading(self, text: str) -> None:
        """Write the heading of a section."""
        self._file.add_heading(text, 1)

    def add(self, blocks: Sequence[Block]) -> None:
        """Write blocks below everything so far."""
        for block in blocks:
            match block:
                case Paragraph():
                    self._file.add_paragraph(block.text, _NOTICE_STYLE if block.is_notice else None)
                case Listing():
                    self._listing(block.text)
                case DataTable():
                    self._table(block)
                case Picture():
                    self._picture(_png(self._drawings[block]), block.height_mm / PAGE_WIDTH_MM, block.title)
                case Photo():
                    self._photo(block)
                case AnimatedModel():
                    pass  # the paragraph next to it says where it is

    def _contents(self, document: Document) -> None:
        """Write the list of sections, which Word fills with page numbers once its fields are updated."""
        if not document.sections:
            return
        self._file.add_paragraph(self._translation.pattern("Contents"), _CAPTION_STYLE)
        titles = [f"{number} {section.title}" for number, section in enumerate(document.sections, start=1)]
        _add_field(self._file.add_paragraph(), r'TOC \o "1-1" \h', "\n".join(titles))

    def content(self) -> bytes:
        """Return the file."""
        file = io.BytesIO()
        self._file.save(file)
        return file.getvalue()

    def _listing(self, text: str) -> None:
        lines = self._file.add_paragraph()
        run = lines.add_run(text.rstrip("\n"))
        run.font.name, run.font.size = "Courier New", self._pt(_LISTING_PT)

    def _table(self, table: DataTable) -> None:
        caption = self._file.add_paragraph(table.title, _CAPTION_STYLE)
        caption.paragraph_format.keep_with_next = True
        headings = [column.heading for column in table.columns]
        has_headings = any(headings)
        rows = [*([headings] if has_headings else []), *table.shown_rows()]
        written = self._file.add_table(len(rows), len(headings), _TABLE_STYLE)
        numbers = [bool(column.form) for column in table.columns]
        for row, texts in zip(written.rows, rows, strict=True):
            for cell, text, is_number in zip(row.cells, texts, numbers, strict=True):
                self._cell(cell, text, is_number, bold=has_headings and row is written.rows[0])
        if has_headings:
            _repeat(written.rows[0])
        self._file.add_paragraph()

    def _cell(self, cell: Any, text: str, is_number: bool, *, bold: bool) -> None:
        from docx.enum.text import WD_ALIGN_PARAGRAPH

        paragraph = cell.paragraphs[0]
        paragraph.paragraph_format.space_after = self._pt(0)
        if is_number:
            paragraph.alignment = WD_ALIGN_PARAGRAPH.RIGHT
        run = paragraph.add_run(text)
        run.font.size, run.bold = self._pt(_SMALL_PT), bold

    def _photo(self, photo: Photo) -> None:
        from matplotlib.image import imread

        height, width = imread(photo.path).shape[:2]
        self._picture(photo.path.read_bytes(), height / width, photo.title)

    def _picture(self, png: bytes, height_by_width: float, title: str) -> None:
        width_mm = min(PAGE_WIDTH_MM, _HIGHEST_MM / height_by_width)
        paragraph = self._file.add_paragraph()
        paragraph.paragraph_format.keep_with_next = True
        shape = paragraph.add_run().add_picture(io.BytesIO(png), width=self._mm(width_mm))
        shape._inline.docPr.set("descr", title)  # what is read to who cannot see it
        self._file.add_paragraph(title, _CAPTION_STYLE)


def _png(drawn: Figure) -> bytes:
    file = io.BytesIO()
    drawn.savefig(file, format="png", dpi=_DOTS_PER_INCH, metadata={"Software": None})
    return file.getvalue()


def _add_field(paragraph: Any, name: str, shown: str = "1") -> None:
    """Add what Word works out, such as the number of the page, and what it shows until then."""
    from docx.oxml import OxmlElement
    from docx.oxml.ns import qn

    field = OxmlElement("w:fldSimple")
    field.set(qn("w:instr"), name)
    run = OxmlElement("w:r")
    for number, line in enumerate(shown.split("\n")):
        if number:
            run.append(OxmlElement("w:br"))
        text = OxmlElement("w:t")
        text.text = line
        run.append(text)
    field.append(run)
    paragraph._p.append(field)


def _repeat(row: Any) -> None:
    """Have a row stand again at the top of each page that its table goes on to."""
    from docx.oxml import OxmlElement
    from docx.oxml.ns import qn

    mark = OxmlElement("w:tblHeader")
    mark.set(qn("w:val"), "true")
    row._tr.get_or_add_trPr().append(mark)


def _without_times(content: bytes) -> bytes:
    """Return a zip whose members do not say when they were written."""
    file = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(content)) as read, zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as written:
        for name in read.namelist():
            written.writestr(zipfile.ZipInfo(name, _ZIP_TIME), read.read(name), zipfile.ZIP_DEFLATED)
    return file.getvalue()
