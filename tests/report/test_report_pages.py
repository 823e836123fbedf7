"""Pages of the PDF, measured: nothing outside the margins, nothing over anything else, nothing cut off."""

import itertools
import re

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from run_folders import flying_shards, keep_run

from bridge_demolition_addon.charts.style import PAGE_WIDTH_MM
from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.report import write as writing
from bridge_demolition_addon.report.document import pdf
from bridge_demolition_addon.report.document.blocks import (
    Column,
    DataTable,
    Document,
    Paragraph,
    Picture,
    Section,
    facts,
    write_tables,
)
from bridge_demolition_addon.report.document.html import write_html

# Letters may be a little wider than their advance.
SLACK_MM = 0.6

BEGINNING = "bridge_of_three_long_spans_"
ENDS = ("near_end", "neighbouring_deck", "between_decks", "mid_span", "without_ball")


@pytest.fixture(scope="module", params=["one run", "five runs"])
def document(request, tmp_path_factory):
    """The document of a run with everything in it, or of runs side by side in folders with long names."""
    folders = [tmp_path_factory.mktemp("runs") / f"{BEGINNING}{end}" for end in ENDS]
    folders = folders[:1] if request.param == "one run" else folders
    for folder in folders:
        keep_run(folder, flying_shards())
    kept = []
    patch = pytest.MonkeyPatch()
    patch.setattr(writing, "write_html", lambda document, *_: kept.append(document))
    patch.setattr(writing, "write_pdf", lambda *_: None)
    output = None if len(folders) == 1 else tmp_path_factory.mktemp("side by side")
    writing.write_report(folders, output, trajectories=True, progress=Silence())
    patch.undo()
    return kept[0]


def pages_of(document):
    """All pages, as drawn."""
    pages = pdf.laid_out(document)
    for page in pages:
        FigureCanvasAgg(page)
        page.set_dpi(288)  # letters are as wide as in the PDF, and not rounded to pixels
        page.draw_without_rendering()
    return pages


def boxes_mm(page):
    """Left, top, right and bottom of every text and picture on a page."""
    height = page.bbox.height
    mm = 25.4 / page.dpi
    for artist in [*page.texts, *page.subfigs]:
        box = artist.get_window_extent() if artist in page.texts else artist.bbox
        yield artist, (box.x0 * mm, (height - box.y1) * mm, box.x1 * mm, (height - box.y0) * mm)


def test_nothing_is_beside_the_page_or_over_anything_else(document):
    for number, page in enumerate(pages_of(document), start=1):
        boxes = [box for _, box in boxes_mm(page)]
        assert boxes
        for left, top, right, bottom in boxes:
            assert left >= pdf.LEFT_MM - SLACK_MM and right <= pdf.LEFT_MM + PAGE_WIDTH_MM + SLACK_MM, number
            assert top >= pdf.TOP_MM - SLACK_MM and bottom <= pdf.FOOT_MM + 5.0, number
        for first, second in itertools.combinations(boxes, 2):
            over = (
                min(first[2], second[2]) - max(first[0], second[0]),
                min(first[3], second[3]) - max(first[1], second[1]),
            )
            assert min(over) < SLACK_MM, (number, first, second)


def test_no_picture_is_cut_off_and_every_axis_says_what_it_shows(document):
    pictures = [block for block in document.blocks() if isinstance(block, Picture)]
    assert len(pictures) >= 4
    for picture in pictures:
        figure = Figure(figsize=(PAGE_WIDTH_MM / 25.4, picture.height_mm / 25.4), layout="constrained")
        FigureCanvasAgg(figure)
        picture.draw(figure)
        figure.draw_without_rendering()
        box = figure.get_tightbbox()
        size = figure.get_size_inches()
        slack = SLACK_MM / 25.4
        assert box.x0 >= -slack and box.y0 >= -slack, picture.title
        assert box.x1 <= size[0] + slack and box.y1 <= size[1] + slack, picture.title
        for axes in figure.axes:
            labels = [axes.get_xlabel(), axes.get_ylabel()]
            unit = re.compile(r"\((m|s|ms|kN|kPa|MPa|MJ|%)\)$")
            is_bar = axes.get_label() == "<colorbar>"
            assert sum(bool(unit.search(label)) for label in labels) == (1 if is_bar else 2), (picture.title, labels)


def test_lines_that_differ_differ_without_colour(document):
    for picture in (block for block in document.blocks() if isinstance(block, Picture)):
        figure = Figure(figsize=(6, 4), layout="constrained")
        FigureCanvasAgg(figure)
        picture.draw(figure)
        for axes in figure.axes:
            lines = [line for line in axes.lines if not line.get_label().startswith("_")]
            looks = [(str(line._unscaled_dash_pattern), line.get_linewidth(), line.get_marker()) for line in lines]
            assert len(set(looks)) == len(looks), picture.title


def test_long_texts_and_tables_go_on_over_lines_and_pages():
    words = "concrete " * 700 + "w" * 400
    rows = [(f"row {row} " + "x" * (row % 150), float(row)) for row in range(200)]
    table = DataTable("long", "A long table", (Column("text", "text"), Column("number", "number", ".1f")), rows)
    document = Document("T" * 300, "", (Section("One", (Paragraph(words), Paragraph(words[:200], True), table)),))
    pages = pages_of(document)
    assert len(pages) > 5
    texts = [text.get_text() for page in pages for text in page.texts]
    assert sum(text.count("concrete") for text in texts) == 700 + len(re.findall("concrete", words[:200]))
    assert sum(text == "number" for text in texts) == sum(
        "row " in " ".join(t.get_text() for t in page.texts) for page in pages
    )
    assert {f"{row:.1f}" for row in range(200)} <= set(texts)
    for page in pages:
        assert all(box[2] <= pdf.LEFT_MM + PAGE_WIDTH_MM + SLACK_MM for _, box in boxes_mm(page))


def test_a_table_is_read_and_is_a_file(tmp_path):
    columns = (Column("speed (m/s)", "speed_m_s", ".1f"), Column("who", "who"))
    table = DataTable("speeds", "Speeds", columns, [(1.23456789, 'a, "b"'), (None, None), (float("nan"), "c")])
    assert table.shown_rows() == [["1.2", 'a, "b"'], ["-", "-"], ["-", "c"]]
    document = Document("", "", (Section("", (table, facts("Read only", [("a", "b")]))),))
    (path,) = write_tables(document.named_tables(), tmp_path)
    assert path.read_text(encoding="utf-8") == 'speed_m_s,who\n1.23456789,"a, ""b"""\n,\nnan,c\n'


def test_markup_in_texts_stays_text(tmp_path):
    document = Document("a < b & c", "", (Section("<i>", (Paragraph("<script>x</script>"),)),))
    write_html(document, tmp_path / "page.html")
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert "<script>" not in page and "<i>" not in page
    assert "&lt;script&gt;x&lt;/script&gt;" in page and "a &lt; b &amp; c" in page


def test_widths_are_those_of_the_letters():
    # DejaVu Sans: a digit is 1303 of 2048 units wide.
    assert pdf._width_mm("0" * 10, 10.0) == pytest.approx(10 * 1303 / 2048 * 10 * 25.4 / 72, rel=0.01)
    assert np.isclose(pdf._width_mm("", 10.0), 0.0)
