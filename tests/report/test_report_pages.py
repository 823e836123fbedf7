# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages of the PDF, measured: nothing outside the margins, nothing over anything else, nothing cut off."""

import itertools
import re
import zlib

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from support.long_cases import long_but
from support.run_folders import flying_shards, keep_run
from support.study_folders import told_runs

from bridge_demolition_addon.charts.style import PAGE_WIDTH_MM
from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.report import write as writing
from bridge_demolition_addon.report.document import page as page_style
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
from bridge_demolition_addon.report.document.drawings import drawings
from bridge_demolition_addon.report.document.html import write_html
from bridge_demolition_addon.report.document.page import PAGE_MM, Font, width_mm
from bridge_demolition_addon.report.document.pdf import write_pdf
from bridge_demolition_addon.report.ensemble.study import study_document

# Letters may be a little wider than their advance.
SLACK_MM = 0.6

BEGINNING = "bridge_of_three_long_spans_"
ENDS = ("near_end", "neighbouring_deck", "between_decks", "mid_span", "without_ball")


@pytest.fixture(scope="module", params=long_but(["one run", "five runs"], ["one run", "five runs", "study"]))
def report(request, tmp_path_factory):
    """The document of a run with everything in it, of several with long names, or of a study; and its drawings."""
    if request.param == "study":
        document = study_document(told_runs(ends={17: "crashed"}), "0", ["study_plan.dxf"])
        return document, drawings(document)
    folders = [tmp_path_factory.mktemp("runs") / f"{BEGINNING}{end}" for end in ENDS]
    folders = folders[:1] if request.param == "one run" else folders
    for folder in folders:
        keep_run(folder, flying_shards())
    kept = []
    patch = pytest.MonkeyPatch()
    patch.setattr(writing, "write_html", lambda document, drawn, *_: kept.append((document, drawn)))
    patch.setattr(writing, "write_pdf", lambda *_: None)
    output = None if len(folders) == 1 else tmp_path_factory.mktemp("side by side")
    writing.write_report(folders, output, trajectories=True, progress=Silence())
    patch.undo()
    return kept[0]


def measured_mm(lines):
    """Left, top, right and bottom of lines of text, as matplotlib measures them when it draws them."""
    figure = Figure(figsize=[side / 25.4 for side in PAGE_MM], dpi=288)  # fine enough not to round to pixels
    FigureCanvasAgg(figure)
    mm = 25.4 / figure.dpi
    for line in lines:
        position = line.left_mm / PAGE_MM[0], 1.0 - line.base_mm / PAGE_MM[1]
        font = {"size": line.font.size_pt, "weight": line.font.weight, "family": line.font.family}
        box = figure.text(*position, line.text, va="baseline", parse_math=False, **font).get_window_extent()
        yield box.x0 * mm, PAGE_MM[1] - box.y1 * mm, box.x1 * mm, PAGE_MM[1] - box.y0 * mm


def boxes_mm(page):
    """Left, top, right and bottom of every line and drawing on a page."""
    yield from measured_mm(page.lines)
    for placed in page.drawings:
        left, top = placed.left_mm, placed.top_mm
        yield (left, top, *(np.array([left, top]) + 25.4 * placed.scale * placed.drawn.get_size_inches()))


def test_nothing_is_beside_the_page_or_over_anything_else(report):
    for number, page in enumerate(pdf.laid_out(*report), start=1):
        boxes = list(boxes_mm(page))
        assert boxes
        for left, top, right, bottom in boxes:
            assert left >= page_style.LEFT_MM - SLACK_MM and right <= page_style.LEFT_MM + PAGE_WIDTH_MM + SLACK_MM, (
                number
            )
            assert top >= page_style.TOP_MM - SLACK_MM and bottom <= page_style.FOOT_MM + 5.0, number
        for first, second in itertools.combinations(boxes, 2):
            over = (
                min(first[2], second[2]) - max(first[0], second[0]),
                min(first[3], second[3]) - max(first[1], second[1]),
            )
            assert min(over) < SLACK_MM, (number, first, second)


def test_no_heading_stands_at_the_foot_of_a_page(report):
    for number, page in enumerate(pdf.laid_out(*report), start=1):
        headings = [line.base_mm for line in page.lines if line.font == page_style.HEADING]
        below = [
            line.base_mm
            for line in page.lines
            if line.font != page_style.HEADING and line.base_mm < page_style.BOTTOM_MM + 1.0
        ]
        below += [placed.top_mm for placed in page.drawings]
        assert not headings or max(below, default=0.0) > max(headings), number


def test_no_page_stands_half_empty(report):
    """But for the last one, and before a drawing that is higher than half a page and that no text follows."""
    middle_mm = (page_style.TOP_MM + page_style.BOTTOM_MM) / 2.0
    for number, (page, following) in enumerate(itertools.pairwise(pdf.laid_out(*report)), start=1):
        lowest_mm = max(bottom for _, _, _, bottom in boxes_mm(page) if bottom < page_style.FOOT_MM)
        highest_mm = max((placed.size_mm[1] for placed in following.drawings), default=0.0)
        assert lowest_mm > middle_mm or highest_mm > middle_mm - page_style.TOP_MM, number


def test_a_picture_that_does_not_fit_lets_the_text_after_it_go_first():
    def picture(title):
        return Picture(lambda figure: figure.add_subplot(), title, 150.0)

    blocks = (picture("first"), picture("second"), Paragraph("after both"), picture("third"))
    document = Document("", "", (Section("One", blocks),))
    pages = [[line.text for line in page.lines] for page in pdf.laid_out(document, drawings(document))]
    named = [[text for text in texts if text in ("first", "second", "after both", "third")] for texts in pages]
    assert named == [["first", "after both"], ["second"], ["third"]]


def test_no_picture_is_cut_off(report):
    _, drawn = report
    assert len(drawn) >= 4
    for picture, figure in drawn.items():
        box = figure.get_tightbbox()
        size = figure.get_size_inches()
        assert size * 25.4 == pytest.approx([PAGE_WIDTH_MM, picture.height_mm])
        slack = SLACK_MM / 25.4
        assert box.x0 >= -slack and box.y0 >= -slack, picture.title
        assert box.x1 <= size[0] + slack and box.y1 <= size[1] + slack, picture.title


@pytest.mark.parametrize("report", ["one run", "five runs"], indirect=True)
def test_every_axis_of_a_run_says_what_it_shows_with_its_unit(report):
    _, drawn = report
    for picture, figure in drawn.items():
        for axes in figure.axes:
            labels = [axes.get_xlabel(), axes.get_ylabel()]
            unit = re.compile(r"\((m|s|ms|kN|kPa|MPa|MJ|%)\)$")
            is_bar = axes.get_label() == "<colorbar>"
            assert sum(bool(unit.search(label)) for label in labels) == (1 if is_bar else 2), (picture.title, labels)


@pytest.mark.parametrize("report", ["study"], indirect=True)
def test_every_axis_of_a_study_says_what_it_shows_or_has_a_neighbour_that_does(report):
    _, drawn = report
    for picture, figure in drawn.items():
        for axes in figure.axes:
            beside, above = axes.get_shared_y_axes(), axes.get_shared_x_axes()
            names = [text.get_text() for text in (*axes.get_xticklabels(), *axes.get_yticklabels())]
            is_named = any(name.startswith("charges") for name in names)  # rows and columns of a map
            assert is_named or any(get_sibling.get_ylabel() for get_sibling in beside.get_siblings(axes)), picture.title
            assert is_named or any(get_sibling.get_xlabel() for get_sibling in above.get_siblings(axes)), picture.title


def test_lines_that_differ_differ_without_colour(report):
    _, drawn = report
    for picture, figure in drawn.items():
        for axes in figure.axes:
            lines = [line for line in axes.lines if not line.get_label().startswith("_")]
            looks = [(str(line._unscaled_dash_pattern), line.get_linewidth(), line.get_marker()) for line in lines]
            assert len(set(looks)) == len(looks), picture.title


@pytest.mark.parametrize("words, scale", [(150, 1.0), (660, 0.9)])
def test_a_drawing_is_on_its_page_and_nowhere_else(tmp_path, words, scale):
    """Also what is drawn as dots: a map of heights, and its colour bar; made smaller where little room is left."""

    def draw(figure):
        axes = figure.add_subplot()
        figure.colorbar(axes.imshow(np.eye(4)), ax=axes)

    picture = Picture(draw, "Dots", 60.0)
    document = Document("", "", (Section("One", (Paragraph("word " * words), picture)),))
    drawn = drawings(document)
    write_pdf(document, drawn, tmp_path / "page.pdf")
    (placed,) = pdf.laid_out(document, drawn)[0].drawings
    left_mm, top_mm = placed.left_mm, placed.top_mm
    assert placed.scale == pytest.approx(scale, abs=0.09 if scale < 1.0 else 0.0)
    scale = placed.scale
    frame = [left_mm, PAGE_MM[1] - top_mm - scale * 60.0, left_mm + scale * PAGE_WIDTH_MM, PAGE_MM[1] - top_mm]
    images = list(image_boxes_mm((tmp_path / "page.pdf").read_bytes()))
    assert len(images) == 2
    for box in images:
        assert (np.array(box[:2]) >= frame[:2]).all() and (np.array(box[2:]) <= frame[2:]).all()


def image_boxes_mm(content):
    """Left, bottom, right and top of every image on the pages of a PDF, by the matrices that lead to it."""
    for stream in re.findall(rb"stream\r?\n(.*?)\r?\nendstream", content, re.DOTALL):
        try:
            words = zlib.decompress(stream).decode("latin-1").split()
        except zlib.error:
            continue
        matrix, outer = np.eye(3), []
        for number, word in enumerate(words):
            if word == "q":
                outer.append(matrix)
            elif word == "Q":
                matrix = outer.pop()
            elif word == "cm":
                a, b, c, d, e, f = map(float, words[number - 6 : number])
                matrix = np.array([[a, b, 0.0], [c, d, 0.0], [e, f, 1.0]]) @ matrix
            elif word == "Do" and words[number - 1].startswith("/I"):
                corners = np.array([[0.0, 0.0, 1.0], [1.0, 1.0, 1.0]]) @ matrix
                yield (*corners[0, :2] * 25.4 / 72.0, *corners[1, :2] * 25.4 / 72.0)


def test_long_texts_and_tables_go_on_over_lines_and_pages():
    words = "concrete " * 700 + "w" * 400
    rows = [(f"row {row} " + "x" * (row % 150), float(row)) for row in range(200)]
    table = DataTable("long", "A long table", (Column("text", "text"), Column("number", "number", ".1f")), rows)
    document = Document("T" * 300, "", (Section("One", (Paragraph(words), Paragraph(words[:200], True), table)),))
    pages = pdf.laid_out(document, {})
    assert len(pages) > 5
    texts = [line.text for page in pages for line in page.lines]
    assert sum(text.count("concrete") for text in texts) == 700 + len(re.findall("concrete", words[:200]))
    assert sum(text == "number" for text in texts) == sum(
        "row " in " ".join(line.text for line in page.lines) for page in pages
    )
    assert {f"{row:.1f}" for row in range(200)} <= set(texts)
    for page in pages:
        assert all(box[2] <= page_style.LEFT_MM + PAGE_WIDTH_MM + SLACK_MM for box in measured_mm(page.lines))


def test_a_table_of_many_columns_stays_between_the_margins():
    columns = tuple(Column(f"quantity {letter} (kg/m³)", letter, ".2f") for letter in "abcdefghijklmnop")
    table = DataTable("wide", "A wide table", columns, [tuple(1234.5 + number for number in range(16))] * 3)
    (page,) = pdf.laid_out(Document("", "", (Section("One", (table,)),)), {})
    assert max(box[2] for box in measured_mm(page.lines)) <= page_style.LEFT_MM + PAGE_WIDTH_MM + SLACK_MM


def test_the_last_row_of_a_table_does_not_stand_alone():
    columns = (Column("text", "text"),)
    for rows in range(36, 50):
        table = DataTable("long", "A long table", columns, [(f"row {row}",) for row in range(rows)])
        pages = pdf.laid_out(Document("", "", (Section("One", (table,)),)), {})
        assert all(sum("row" in line.text for line in page.lines) != 1 for page in pages), rows


def test_a_table_is_read_and_is_a_file(tmp_path):
    columns = (Column("speed (m/s)", "speed_m_s", ".1f"), Column("who", "who"))
    table = DataTable("speeds", "Speeds", columns, [(1.23456789, 'a, "b"'), (None, None), (float("nan"), "c")])
    assert table.shown_rows() == [["1.2", 'a, "b"'], ["-", "-"], ["-", "c"]]
    document = Document("", "", (Section("", (table, facts("Read only", [("a", "b")]))),))
    (path,) = write_tables(document.named_tables(), tmp_path)
    assert path.read_text(encoding="utf-8") == 'speed_m_s,who\n1.23456789,"a, ""b"""\n,\nnan,c\n'


def test_markup_in_texts_stays_text(tmp_path):
    document = Document("a < b & c", "", (Section("<i>", (Paragraph("<script>x</script>"),)),))
    write_html(document, {}, tmp_path / "page.html")
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert "<script>" not in page and "<i>" not in page
    assert "&lt;script&gt;x&lt;/script&gt;" in page and "a &lt; b &amp; c" in page


def test_widths_are_those_of_the_letters():
    # DejaVu Sans: a digit is 1303 of 2048 units wide, a space 651.
    font = Font(10.0)
    point_mm = 25.4 / 72
    assert width_mm("0" * 10, font) == pytest.approx(10 * 1303 / 2048 * 10 * point_mm, rel=0.01)
    assert width_mm("0 0", font) == pytest.approx((2 * 1303 + 651) / 2048 * 10 * point_mm, rel=0.01)
    assert width_mm("", font) == 0.0
    assert width_mm("\u6865\U0001f309\u202e", font) >= 0.0  # no letters of this font


def test_letters_that_no_font_has_and_marks_without_any_are_written(tmp_path):
    text = "Br\u00fccke \u202e\u200b \u6865 \U0001f309 a\tb"
    document = Document(text, text, (Section(text, (Paragraph(text),)),))
    write_pdf(document, {}, tmp_path / "report.pdf")
    assert (tmp_path / "report.pdf").read_bytes().startswith(b"%PDF")
