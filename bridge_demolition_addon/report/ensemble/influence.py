"""What matters: each output against each input that varied."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import fields
from functools import partial

import numpy as np

from ...charts.ensemble_charts import (
    MOST_DOTS,
    InputPanel,
    correlation_map,
    correlation_map_height_mm,
    output_against_inputs,
    output_panels_height_mm,
)
from ...engineering.statistics.ranks import correlation_by_chance, rank_correlation
from ...model.study.distributions import Distribution
from ...model.study.file import Study, Variation
from ...model.study.shown_names import shown
from ...texts import Text, joined
from ..document.blocks import Block, Column, DataTable, Paragraph, Picture, Section
from .reported_ensemble import ReportedEnsemble

_PANELS_AT_ONCE = 20
"""What fits on a page."""


def varied_section(runs: ReportedEnsemble) -> Section:
    """Return what varied, and how."""
    columns = (
        Column("key", "key"),
        Column("distribution", "distribution"),
        Column("lowest", "lowest", ".5g", of_row=True),
        Column("median", "median", ".5g", of_row=True),
        Column("highest", "highest", ".5g", of_row=True),
    )
    rows = [_varied_row(runs, variation) for variation in runs.ensemble.variations]
    words = Text(
        "All inputs are sampled for each run, independently of each other. So is the seed of the fracture, which "
        "decides how the shards are cut."
    )
    blocks: list[Block] = [Paragraph(words)]
    blocks += [DataTable("varied", "What varied", columns, rows)] if rows else []
    return Section("What varied", tuple(blocks))


def influence_section(runs: ReportedEnsemble) -> Section | None:
    """Return which inputs matter for which outputs; None where nothing but the seed varied, or too little finished."""
    finished = int(runs.table.done.sum())
    if not runs.varied or not runs.numbers or finished < 3:
        return None
    by_chance = correlation_by_chance(finished)
    counted = Text("first {} of the {}", MOST_DOTS, finished) if finished > MOST_DOTS else str(finished)
    words = Text(
        "Each dot is one of the {} runs that finished. The rank correlation is 1 where an output always rises "
        "with an input, and -1 where it always falls. Of inputs that do not matter at all one in twenty has by "
        "chance more than {} either way; larger ones are in bold. Small ones may hide an input that pushes both "
        "ways: look at the dots. What no input explains is chance: the fracture, and the course of a collapse.",
        counted,
        f"{by_chance:.2f}",
    )
    if not isinstance(runs.ensemble, Study):
        words = Text(
            "{} Values that the {} chose gather where it looked most: they are not independent.",
            words,
            Text(runs.ensemble.kind),
        )
    blocks: list[Block] = [Paragraph(words)]
    if cells := correlations_of(runs):
        inputs, outputs = (list(dict.fromkeys(column)) for column in list(zip(*cells, strict=True))[:2])
        values = {(name, output): value for name, output, value in cells}
        picture = partial(
            correlation_map,
            inputs=[shown(name) for name in inputs],
            outputs=[shown(name) for name in outputs],
            correlations=np.array([[values.get((name, output), math.nan) for output in outputs] for name in inputs]),
            by_chance=by_chance,
        )
        title = Text("Rank correlation of each output with each input, in the order of the strongest.")
        blocks.append(Picture(picture, title, correlation_map_height_mm(len(inputs))))
    for output in runs.numbers:
        blocks += _panels(runs, output)
    return Section("What matters", tuple(blocks))


def correlations_of(runs: ReportedEnsemble) -> list[tuple[str, str, float]]:
    """Return inputs, outputs and their rank correlations, as far as both change, the strongest first."""
    cells = [
        (name, output, _correlation(runs, name, output))
        for name in runs.varied
        if runs.table.input(name).dtype == float
        for output in (*runs.numbers, *runs.criteria)
    ]
    return sorted((cell for cell in cells if math.isfinite(cell[2])), key=lambda cell: -abs(cell[2]))


def correlation_table(runs: ReportedEnsemble) -> DataTable:
    """Return all rank correlations, for their CSV file."""
    columns = (
        Column("input", "input"),
        Column("output", "output"),
        Column("rank correlation", "rank_correlation", ".2f"),
    )
    return DataTable("rank_correlations", "Rank correlations", columns, correlations_of(runs))


def _varied_row(runs: ReportedEnsemble, variation: Variation) -> tuple:
    values = runs.table.input(variation.key.name) if variation.key.name in runs.table.inputs else np.zeros(0)
    name = Text(type(variation.distribution).__name__.lower())
    how = Text("{}: {}", name, joined("{}, {}", _settings(variation.distribution)))
    if variation.factor:
        how = Text("{}, as a factor", how)
    if values.dtype == object or not len(values):
        return shown(variation.key.name), how, None, None, None
    ends = float(values.min()), float(np.median(values)), float(values.max())
    return shown(variation.key.name), how, *ends


def _settings(distribution: Distribution) -> Iterator[str]:
    """Yield the settings of a distribution, each as text."""
    for item in fields(distribution):
        value = getattr(distribution, item.name)
        if value != item.default:
            yield Text(f"{item.name.replace('_', ' ')} {{}}", _words(value))


def _words(value: object) -> str:
    if isinstance(value, tuple):
        return ", ".join(map(_words, value))
    return f"{value:g}" if isinstance(value, float) else str(value)


def _correlation(runs: ReportedEnsemble, name: str, output: str) -> float:
    values = runs.table.output(output)
    if values.dtype == object:  # truths
        values = np.array([math.nan if value is None else float(bool(value)) for value in values])
    known = runs.table.done & np.isfinite(values)
    if known.sum() < 3:
        return math.nan
    return rank_correlation(runs.table.input(name)[known], values[known])


def _panels(runs: ReportedEnsemble, output: str) -> list[Picture]:
    known = np.flatnonzero(runs.table.done & np.isfinite(runs.table.output(output)))[:MOST_DOTS]
    values = runs.table.output(output)[known]
    panels = []
    for name in runs.varied:
        drawn = runs.table.input(name)
        correlation = None if drawn.dtype == object else _correlation(runs, name, output)
        panels.append(InputPanel(shown(name), drawn[known], correlation))
    panels.sort(key=lambda panel: -abs(panel.correlation or 0.0))
    pages = [panels[first : first + _PANELS_AT_ONCE] for first in range(0, len(panels), _PANELS_AT_ONCE)]
    return [
        Picture(
            partial(output_against_inputs, label=shown(output), values=values, panels=page),
            Text("{} against what varied.", shown(output)),
            output_panels_height_mm(len(page)),
        )
        for page in pages
    ]
