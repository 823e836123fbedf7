"""Key figures of two runs side by side, by the findings of their reports."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from ...engineering.unit_systems import UnitSystem
from ...errors import OutputError
from ...model.debris.throws import debris_of
from ...model.results.arrays import results_in
from ...report.findings import IMPACT, Finding, findings
from ...report.run_folder import read_run
from ..languages.words import translated
from ..scene_units import area_text, length_text, mass_text, units_of_texts

_KG_PER_T = 1000.0

_HEADS = {
    IMPACT: "Impact of the ball",
    "Connections cracked, held by bars": "Cracked, held by bars",
    "Connections torn": "Connections torn",
    "Progress of the collapse": "Progress of the collapse",
    "All shards at rest from": "At rest from",
    "Debris": "Debris",
    "Footprint of the debris": "Area of the debris",
    "Height of the pile": "Height of the pile",
    "95 % of the debris's mass thrown up to": "95 % thrown up to",
    "Largest throw": "Largest throw",
    "Debris beyond the bridge's outline, at most": "Debris distance",
    "Largest load on a shard": "Largest load on a shard",
}
"""Names in the panel, by those in a report."""

_kept: dict[Path, tuple[int | None, list[Finding]]] = {}
"""Findings by folder, with the time at which the results were written that they are of."""


class FigureRow(NamedTuple):
    """A figure of both runs as texts."""

    name: str
    this: str
    other: str


def figure_rows(this: Path | None, other: Path) -> list[FigureRow]:
    """Return the key figures of two runs by their folders, without those that neither has.

    Of this one nothing is known where there is no folder yet. A folder that holds no results raises OutputError.
    """
    of_other = findings_of(other)
    of_this = findings_of(this) if this else [None] * len(of_other)
    rows = []
    for mine, theirs in zip(of_this, of_other, strict=True):
        if theirs.value is not None or (mine and mine.value is not None):
            rows.append(FigureRow(translated(_HEADS[theirs.label]), figure_text(mine), figure_text(theirs)))
    return rows


def findings_of(folder: Path) -> list[Finding]:
    """Return the findings of a run, worked out once."""
    written = written_at(folder)
    if folder not in _kept or _kept[folder][0] != written:
        run = read_run(folder)
        if run.results is None:
            raise OutputError(f"{folder}: {' '.join(run.shortcomings)}")
        _kept[folder] = written, findings(run, debris_of(run.recorded))
    return _kept[folder][1]


def written_at(folder: Path) -> int | None:
    """Return when the results in a folder were written, in ns since 1970; None where there are none."""
    try:
        return results_in(folder).stat().st_mtime_ns
    except OSError:
        return None


def figure_text(finding: Finding | None) -> str:
    """Return a figure with its unit, in the units of the scene; a dash where it is not known."""
    if finding is None or finding.value is None:
        return "-"
    value = finding.value
    match finding.unit:
        case "m":
            return length_text(value, ".2f")
        case "m²":
            return area_text(value, ".0f")
        case "t":
            return mass_text(value * _KG_PER_T) if units_of_texts() is UnitSystem.IMPERIAL else f"{value:.1f} t"
        case "1":
            return f"{value:.0f}"
        case "s":
            return f"{value:.2f} s"
        case unit:
            return f"{value:.0f} {unit}"


def forget() -> None:
    """Forget all findings."""
    _kept.clear()
