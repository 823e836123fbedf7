"""A search in a report: what it found, its curve and its trials."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from ...charts.search_curve import search_curve
from ...model.ensemble.folder import read_ensemble
from ...model.search.conclusions import Answer
from ...system.progress import Progress
from ..document.blocks import Column, DataTable, Document, Listing, Paragraph, Picture, Report, Section
from ..sections.cover import add_on_version
from ..wording.search import search_sentences


def read_answer(folder: Path) -> Answer:
    """Read a search, and return its answer."""
    return read_ensemble(folder).result()


def search_report(answer: Answer, _target: Path, _progress: Progress) -> Report:
    """Return the report of a search."""
    sections = (search_section(answer), Section("Search file", (Listing(answer.search.text),)))
    subtitle = f"Report of a search in a simulated demolition. Bridge Demolition Add-on {add_on_version()}"
    return Report(Document(answer.search.scenario.title, subtitle, sections))


def search_section(answer: Answer) -> Section:
    """Return the answer of a search."""
    search, trials = answer.search, answer.trials
    said = [Paragraph(text) for text in search_sentences(answer)]
    picture = Picture(
        partial(search_curve, answer=answer),
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
        for number, (value, success) in enumerate(zip(answer.values, trials.successes, strict=True), start=1)
    ]
    table = DataTable("trials", "Trials", columns, rows)
    trust = Paragraph(
        "The limit says how the model scatters, with the inputs that vary in it. It does not cover what the model "
        "leaves out."
    )
    return Section("Search", (*said, picture, trust, table))
