"""A search in a report: what it found, its curve and its trials."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from ...charts.search_curve import search_curve
from ...model.search.conclusions import sentences
from ...model.search.curve import curve_of
from ...system.progress import Progress
from ..document.blocks import Column, DataTable, Document, Listing, Paragraph, Picture, Report, Section
from ..sections.cover import add_on_version
from .search_folder import FoundSearch


def search_report(found: FoundSearch, _target: Path, _progress: Progress) -> Report:
    """Return the report of a search."""
    sections = (search_section(found), Section("Search file", (Listing(found.search.text),)))
    subtitle = f"Report of a search in a simulated demolition. Bridge Demolition Add-on {add_on_version()}"
    return Report(Document(found.search.study.scenario.title, subtitle, sections))


def search_section(found: FoundSearch) -> Section:
    """Return what a search found."""
    search, trials, answer = found.search, found.trials, found.answer
    said = [Paragraph(text) for text in sentences(search, answer, found.reason)]
    curve = curve_of(search, trials)
    picture = Picture(
        partial(
            search_curve,
            search=search,
            values=found.values,
            successes=trials.successes,
            answer=answer,
            curve=curve,
        ),
        f"All trials, and how likely success is along {search.settings.key}.",
        110.0,
    )
    unit = f" ({search.unit})" if search.unit else ""
    columns = (
        Column("Trial", "trial"),
        Column(f"{search.settings.key}{unit}", "value", ".6g"),
        Column("all criteria", "success"),
    )
    rows = [
        (number, float(value), "met" if success else "not met")
        for number, (value, success) in enumerate(zip(found.values, trials.successes, strict=True), start=1)
    ]
    table = DataTable("trials", "Trials", columns, rows)
    trust = Paragraph(
        "The limit says how the model scatters, with the inputs that vary in it. It does not cover what the model "
        "leaves out."
    )
    return Section("Search", (*said, picture, trust, table))
