# SPDX-License-Identifier: GPL-3.0-or-later
"""The report of one run in metric and in US customary units, read back from page, PDF and Word file."""

import re
from dataclasses import replace
from decimal import Decimal
from html.parser import HTMLParser

import docx
import pytest
from support.run_folders import TOLD, flying_shards, keep_run

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.engineering.unit_systems import UnitSystem
from bridge_demolition_addon.errors import OutputError
from bridge_demolition_addon.model.scenario import Exclusion, ReportSettings
from bridge_demolition_addon.report.document import page as page_style
from bridge_demolition_addon.report.document import pdf
from bridge_demolition_addon.report.languages.translation import Translation
from bridge_demolition_addon.report.wording.verdict import Flyrock, clearance_rows
from bridge_demolition_addon.report.write import write_report
from bridge_demolition_addon.texts import distance_to_keep

pytestmark = pytest.mark.slow  # two whole reports with their drawings

FOOT_M, SHORT_TON_KG, KIP_N, PSI_PA = 0.3048, 907.18474, 4448.2216, 6894.757
"""By NIST SP 811, appendix B.8."""


class Rows(HTMLParser):
    """The rows of all tables of a page as texts, and all its other texts."""

    def __init__(self, html):
        super().__init__()
        self.rows, self.texts, self._left_out = [], [], 0
        self.feed(html)

    def handle_starttag(self, tag, attributes):
        self._left_out += tag in ("style", "script", "pre")
        if tag == "tr":
            self.rows.append([])
        if tag in ("td", "th"):
            self.rows[-1].append("")

    def handle_endtag(self, tag):
        self._left_out -= tag in ("style", "script", "pre")

    def handle_data(self, data):
        if self._left_out or not data.strip():
            return
        self.texts.append(data)
        if self.lasttag in ("td", "th"):
            self.rows[-1][-1] += data


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """The pages of both reports, the lines of the PDF in US units, and their folders."""
    zone = Exclusion(buffer_m=5, designed_drop_m=1, cordon_m=300)
    scenario = replace(TOLD, exclusion=zone, report=ReportSettings(units="imperial"))
    run = keep_run(tmp_path_factory.mktemp("runs") / "run", flying_shards(), scenario)
    lines, lay_out = [], pdf.laid_out
    patch = pytest.MonkeyPatch()

    def noted(*arguments):
        pages = lay_out(*arguments)
        lines.extend(line.text for page in pages for line in page.lines if line.font != page_style.LISTING)
        return pages

    metric, imperial = run.parent / "metric", run.parent / "imperial"
    write_report([run], metric, units="metric", progress=Silence())  # comes before what the scenario asks for
    patch.setattr(pdf, "laid_out", noted)
    write_report([run], imperial, word=True, progress=Silence())
    patch.undo()
    pages = [Rows((folder / "report.html").read_text(encoding="utf-8")) for folder in (metric, imperial)]
    return *pages, lines, metric, imperial


def value(page, label):
    """The text beside a label in the page."""
    return next(row[1] for row in page.rows if len(row) == 2 and row[0] == label)


def numbers(text):
    return [float(number) for number in re.findall(r"-?\d+(?:\.\d+)?", text)]


@pytest.mark.long
def test_both_pages_say_the_same_in_their_units(made):
    metric, imperial, *_ = made
    for label, unit, own, size in (
        ("Height of the pile", "m", "ft", FOOT_M),
        ("Largest throw", "m", "ft", FOOT_M),
        ("Largest load on a shard", "kN", "kip", KIP_N / 1e3),
        ("Predicted debris area", "m²", "ft²", FOOT_M**2),
        ("Volume of the pile", "m³", "yd³", (3 * FOOT_M) ** 3),
        ("Total charge", "kg", "lb", 0.45359237),
    ):
        before, after = value(metric, label), value(imperial, label)
        assert f" {unit}" in before and f" {own}" in after, label
        assert numbers(after)[0] * size == pytest.approx(numbers(before)[0], rel=2e-3), label


@pytest.mark.long
def test_every_number_of_a_table_is_converted(made):
    metric, imperial, *_ = made
    heads = [row for row in metric.rows if "debris distance (m)" in row]
    assert heads
    for head in heads:
        at = metric.rows.index(head)
        column = head.index("debris distance (m)")
        assert imperial.rows[at][column] == "debris distance (ft)"
        for before, after in zip(metric.rows[at + 1 : at + 4], imperial.rows[at + 1 : at + 4], strict=True):
            assert float(after[column]) * FOOT_M == pytest.approx(float(before[column]), abs=5e-3)
            mass = head.index("mass (kg)")
            assert float(after[mass]) * SHORT_TON_KG / 2000.0 == pytest.approx(float(before[mass]), abs=0.6)


@pytest.mark.long
def test_no_distance_to_keep_is_less_than_in_metres(made):
    metric, imperial, *_ = made
    kept = (
        "Buffer",
        "Designed drop",
        "Farthest from the bridge's plan",
        "Cordon",
        "Debris distance",
    )
    for label in kept:
        assert_no_less_in_feet(value(metric, label), value(imperial, label))


def assert_no_less_in_feet(before, after):
    metres, feet = re.findall(r"(\d[\d.]*) m\b", before), re.findall(r"(\d[\d.]*) ft\b", after)
    assert len(metres) == len(feet) > 0, before
    for number, own in zip(metres, feet, strict=True):
        assert Decimal(number) <= Decimal(own) * Decimal("0.3048") <= Decimal(number) * Decimal("1.002"), before


@pytest.mark.parametrize("largest_m", [77.0, 61.4, 118.0])
def test_no_fragment_flies_less_far_than_in_metres(largest_m):
    sampled = "sampled under their cover up to {}; {}", distance_to_keep(largest_m, ".0f")
    flyrock = Flyrock(sampled, largest_m, 340.1, 200.1)
    rows = dict(clearance_rows(None, flyrock))
    assert set(rows) == {"Fragments (flyrock)", "Cordon"}
    for text in rows.values():
        assert_no_less_in_feet(text, Translation.into("en", UnitSystem.IMPERIAL).text(text))


@pytest.mark.long
def test_pdf_and_word_file_have_the_same_numbers_as_the_page(made):
    _, imperial, lines, _, folder = made
    document = docx.Document(folder / "report.docx")
    words = " ".join(paragraph.text for paragraph in document.paragraphs) + " ".join(
        cell.text for table in document.tables for row in table.rows for cell in row.cells
    )
    printed = " ".join(lines)
    for label in ("Height of the pile", "Farthest from the bridge's plan", "Total charge"):
        assert value(imperial, label).partition(",")[0] in printed, label
        assert value(imperial, label) in words, label
    assert "US customary units" in printed and "US customary units" in words


@pytest.mark.long
def test_no_metric_unit_is_left_but_in_formulas(made):
    _, imperial, lines, *_ = made
    unit = re.compile(r"\d (?:mm|cm|m|m²|m³|kg|t|N|kN|MN|kPa|MPa|J|kJ|MJ|mm/s|m/s|kN·s)(?![\w²³/·])")
    heading = re.compile(r"\((?:mm|cm|m|m²|m³|kg|t|N|kN|MN|kPa|MPa|J|kJ|MJ|mm/s|m/s|kN·s)[,)]")
    left_alone = re.compile(r"Chimney of 41 m|v = .*?\)\^-[\d.]+|Ø \(mm\)")
    for text in (*imperial.texts, " ".join(lines)):
        left = left_alone.sub("", text)
        assert not unit.search(left) and not heading.search(left), text


@pytest.mark.long
def test_files_for_programs_are_the_same_in_both(made):
    *_, metric, imperial = made
    tables = sorted(path.name for path in (metric / "tables").iterdir())
    assert tables == sorted(path.name for path in (imperial / "tables").iterdir())
    for name in tables:
        assert (metric / "tables" / name).read_bytes() == (imperial / "tables" / name).read_bytes(), name
    plan = "exclusion_zone_of_one_run.dxf"
    assert (metric / plan).read_bytes() == (imperial / plan).read_bytes()


def test_units_that_are_not_known_are_refused_with_those_that_are(tmp_path):
    with pytest.raises(OutputError, match=r"units of the report are 'feet': expected metric, imperial"):
        write_report([tmp_path], None, units="feet", progress=Silence())
