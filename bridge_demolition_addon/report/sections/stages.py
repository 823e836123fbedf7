"""Stages in a report: how the bridge stands between the steps of its demolition, and without each of its members."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from ...engineering.units import mass_text
from ...errors import OutputError, UnreadableError
from ...model.lifts import Pick
from ...model.stages.lifted import LIFT_COLUMNS, LIFTS_FILE
from ...model.stages.misfires import MISFIRE_COLUMNS, MISFIRES_FILE
from ...model.stages.stages import STEPS
from ...model.stages.tables import (
    BEARING_COLUMNS,
    BEARINGS_FILE,
    CRITICALITY_COLUMNS,
    CRITICALITY_FILE,
    NOT_SOUGHT,
    REACTION_COLUMNS,
    REACTIONS_FILE,
    STAGE_COLUMNS,
    STAGES_FILE,
    UPLIFT_KN,
)
from ...model.structure.bearing_ranges import ONE_CUT
from ...system.progress import Progress
from ...system.reading import MEGABYTE, csv_rows
from ...texts import Quantity, Text, joined, read
from ...version import VERSION
from ..document.blocks import Block, Column, DataTable, Document, Paragraph, Report, Section
from ..run_folder import shown_name
from .plan_contents import with_plan_contents

_MOST_BYTES = 10 * MEGABYTE
_WORDS = Text(
    "Worked out at rest, by the stiffness of the connections and without a simulation. Utilisation is of the "
    "resistance in bending of sections with bars, or of what links carry between a girder and its slab, and "
    "elsewhere of the strength of a face, which breaks above 100 %. Collapse load factor: times the weight of "
    "everything, equipment included, at which the bridge begins to come down; below 1 the stage does not stand."
)
_COLUMNS = (
    Column("Stage", "stage", "", lambda row: row["stage"]),
    Column("From", "time_s", ".2f", lambda row: _number(row["time_s"])),
    Column("What was done", "step", "", lambda row: read(row["step"], STEPS)),
    Column("On it", "equipment", "", lambda row: Text(row["equipment"]) if row["equipment"] else None),
    Column("Weight", "weight_kN", ".0f", lambda row: _number(row["weight_kN"])),
    Column("Not supported", "not_held_t", ".1f", significant=3, value=lambda row: float(row["not_held_kg"]) / 1e3),
    Column("Utilisation", "largest_utilisation", ".0%", lambda row: _number(row["largest_utilisation"])),
    Column("by", "governed_by", "", lambda row: Text(row["governed_by"]) if row["governed_by"] else None),
    Column("in", "between", "", lambda row: read(row["between"], ("{} and {}",)) if row["between"] else None),
    Column("Collapse load factor", "falls_at", "", lambda row: _falls_at(_number(row["collapse_factor"]))),
    Column("Deflection", "sag_mm", ".1f", lambda row: _number(row["sag_mm"])),
)
_HOOKS = (
    Column("On hooks", "on_hooks_kN", ".1f", lambda row: _number(row["on_hooks_kN"])),
    Column("of the crane", "hook_used", ".0%", lambda row: _number(row["hook_used"])),
)
"""Columns where a crane lifts parts."""

_SUPPORT = (
    Column("Support", "support", "", lambda rows: rows[0]["support"]),
    Column("at x", "at_x_m", ".2f", lambda rows: float(rows[0]["at_x_m"])),
    Column("y", "at_y_m", ".2f", lambda rows: float(rows[0]["at_y_m"])),
    Column("z", "at_z_m", ".2f", lambda rows: float(rows[0]["at_z_m"])),
)
_REACTIONS = Text(
    "Reactions of the supports: least and largest forces (kN) on the bridge over the stages, z upwards, without "
    "the weight of what is held"
)
_MOMENTS = Text("Reactions of the supports: least and largest moments (kN·m) about the point of the support")
_BEARING = (
    Column("Bearing", "bearing", "", lambda rows: rows[0]["bearing"]),
    Column("at x", "axis_x_m", ".2f", lambda rows: float(rows[0]["axis_x_m"])),
    Column("y", "axis_y_m", ".2f", lambda rows: float(rows[0]["axis_y_m"])),
    Column("z", "axis_z_m", ".2f", lambda rows: float(rows[0]["axis_z_m"])),
)
_BEARINGS = Text(
    "Bearings: least and largest forces (kN) on what lies above them over the stages, z upwards. They go on into "
    "the supports, and are no part of their sum"
)
_SINCE_LATER = (
    "cracked",
    "bare_bars_used",
    "tendons_released_kJ",
    "falls_at_most_kg",
    "on_hooks_kN",
    "hook_used",
    "not_held_of",
)
"""Columns that earlier versions did not write."""

_CRITICALITY_AT_FIRST = 4
"""Columns of members that they did write."""

_MISFIRES = Text(
    "The bridge at rest after all changes but one blast zone: masses of what connections to supports held at "
    "first. Bare bars of zones that fired carry up to what EN 1993-1-1, curve c, lets them resist, with their "
    "ends held sideways. At most so much comes down where their load comes upon them at once, which presses them "
    "up to twice as much, and where they hold nothing sideways and the bridge is inclined by 1/200. A bridge that "
    "stands on charges that did not fire must not be approached."
)
_MISFIRE = (
    Column("Fails", "fails", "", lambda row: row["fails"]),
    Column("come down", "falls_t", ".1f", significant=3, value=lambda row: float(row["falls_kg"]) / 1e3),
    Column("of what was held", "falls_share", ".0%", lambda row: float(row["falls_share"])),
    Column("at most", "falls_at_most_t", ".1f", significant=3, value=lambda row: _tonnes(row, "falls_at_most_kg")),
    Column("stand", "stands_t", ".1f", significant=3, value=lambda row: float(row["stands_kg"]) / 1e3),
    Column("Members that stand", "members_that_stand", "", lambda row: row["members_that_stand"] or None),
)
_OF_BEARINGS = Text("Bearings: least and largest moments (kN·m) about the middle of their axes")


def has_stages(folder: Path) -> bool:
    """Return whether a folder holds the tables of stages."""
    return (folder / STAGES_FILE).is_file() and (folder / CRITICALITY_FILE).is_file()


def _tonnes(row: dict[str, str], column: str) -> float | None:
    mass_kg = _number(row.get(column, ""))
    return None if mass_kg is None else mass_kg / 1e3


def stages_report(folder: Path, _target: Path, _progress: Progress) -> Report:
    """Return the report of stages alone."""
    subtitle = Text("Report of the stages of a demolition. Bridge Demolition Add-on {}", VERSION)
    document = Document(shown_name(folder), subtitle, (stages_section(folder),))
    return Report(with_plan_contents(document, None))


def stages_section(folder: Path) -> Section:
    """Return what the tables of stages in a folder say."""
    always = [name for name in STAGE_COLUMNS if name not in _SINCE_LATER]
    stages = _rows(folder / STAGES_FILE, always)
    members = _rows(folder / CRITICALITY_FILE, CRITICALITY_COLUMNS[:_CRITICALITY_AT_FIRST])
    try:
        is_lifting = any(row.get("on_hooks_kN") for row in stages)
        table = DataTable.of("stages", "Stages", (*_COLUMNS, *(_HOOKS if is_lifting else ())), stages)
        falls = [(row["member"], float(row["falls_kg"]) / 1e3, float(row["share_of_the_bridge"])) for row in members]
    except ValueError as error:
        raise OutputError(f"{folder}: the tables of stages are damaged ({error}); run bda stages again") from error
    blocks: list[Block] = [
        Paragraph(_WORDS),
        *_warnings(stages),
        *_released(stages),
        *_picks(folder),
        table,
        *_reaction_blocks(folder),
        *_bearing_blocks(folder),
    ]
    blocks.append(Paragraph(_on_members(falls)))
    if critical := sorted((fall for fall in falls if fall[1] > 0.0), key=lambda fall: -fall[1]):
        columns = (
            Column("Without", "member"),
            Column("come down", "falls_t", ".1f", significant=3),
            Column("of the bridge", "share_of_the_bridge", ".0%"),
        )
        blocks.append(DataTable("criticality", "Members that hold others", columns, critical))
    blocks += _misfire_blocks(folder)
    return Section("Stages", tuple(blocks))


def _released(stages: Sequence[dict[str, str]]) -> list[Block]:
    """Return what tendons let go in each stage; nothing where none do."""
    energies = [(stage["stage"], _number(stage.get("tendons_released_kJ", "")) or 0.0) for stage in stages]
    parts = [Text("{} in stage {}", Quantity(energy, "kJ", ".1f"), stage) for stage, energy in energies if energy > 0.0]
    if not parts:
        return []
    text = "Tendons let go at once, and hurt people along their lines and at their anchorages: {}."
    return [Paragraph(Text(text, joined("{}, {}", parts)), is_notice=True)]


def _picks(folder: Path) -> list[Block]:
    """Return notices of parts whose shards weigh otherwise than their volume; none of what earlier versions wrote."""
    path = folder / LIFTS_FILE
    rows = _rows(path, LIFT_COLUMNS[:-1], may_be_empty=True) if path.is_file() else []
    known = rows and "volume_kg" in rows[0]
    try:
        picks = [Pick(row["lift"], float(row["part_kg"]), float(row["volume_kg"])) for row in rows if known]
    except ValueError as error:
        raise _damaged(path, error) from error
    return [Paragraph(Text("{}.", text), True) for text in dict.fromkeys(pick.warning for pick in picks) if text]


def _misfire_blocks(folder: Path) -> list[Block]:
    """Return what stands if a blast zone fails; nothing without zones, or where an earlier version wrote the tables."""
    path = folder / MISFIRES_FILE
    always = [name for name in MISFIRE_COLUMNS if name not in _SINCE_LATER]
    rows = _rows(path, always, may_be_empty=True) if path.is_file() else []
    if not rows:
        return []
    try:
        table = DataTable.of("misfires", "What stands if a blast zone fails", _MISFIRE, rows)
    except ValueError as error:
        raise _damaged(path, error) from error
    return [Paragraph(_MISFIRES), table]


def _reaction_blocks(folder: Path) -> list[Block]:
    """Return the least and largest reactions of each support; nothing where an earlier version wrote the tables."""
    path = folder / REACTIONS_FILE
    supports = _by_name(path, REACTION_COLUMNS, "support")
    if not supports:
        return []
    try:
        forces = DataTable.of("reaction_forces", _REACTIONS, (*_SUPPORT, *_extremes("force", "kN")), supports)
        moments = DataTable.of("reaction_moments", _MOMENTS, (*_SUPPORT, *_extremes("moment", "kNm")), supports)
        return [*_uplift(supports, "support"), forces, moments]
    except ValueError as error:
        raise _damaged(path, error) from error


def _bearing_blocks(folder: Path) -> list[Block]:
    """Return the least and largest forces of each bearing while it is there; nothing without bearings."""
    path = folder / BEARINGS_FILE
    try:
        bearings = [
            there
            for rows in _by_name(path, BEARING_COLUMNS, "bearing")
            if (there := [row for row in rows if float(row["left_share"]) > 0.0])
        ]
        if not bearings:
            return []
        forces = DataTable.of("bearing_forces", _BEARINGS, (*_BEARING, *_extremes("force", "kN")), bearings)
        moments = DataTable.of("bearing_moments", _OF_BEARINGS, (*_BEARING, *_extremes("moment", "kNm")), bearings)
        return [*_uplift(bearings, "bearing"), *_lifted(bearings), forces, Paragraph(ONE_CUT), moments]
    except ValueError as error:
        raise _damaged(path, error) from error


def _by_name(path: Path, columns: Sequence[str], kind: str) -> list[list[dict[str, str]]]:
    """Return the rows of each support or bearing over the stages; nothing where an earlier version wrote the tables."""
    by_name: dict[str, list[dict[str, str]]] = {}
    for row in _rows(path, columns, may_be_empty=True) if path.is_file() else ():
        by_name.setdefault(row[kind], []).append(row)
    return list(by_name.values())


def _damaged(path: Path, error: ValueError) -> OutputError:
    return OutputError(f"{path}: is damaged ({error}); run bda stages again")


def _lifted(bearings: Sequence[Sequence[dict[str, str]]]) -> list[Block]:
    """Return a notice of the stages in which bearings have lifted off."""
    lifted = [row for rows in bearings for row in rows if abs(float(row["force_z_kN"])) <= UPLIFT_KN]
    return [Paragraph(Text("Stage {}: {} has lifted off.", row["stage"], row["bearing"]), True) for row in lifted]


def _uplift(supports: Sequence[Sequence[dict[str, str]]], kind: str) -> list[Block]:
    """Return a notice of each support or bearing that is held down against uplift."""
    lowest = [min(rows, key=lambda row: float(row["force_z_kN"])) for rows in supports]
    return [
        Paragraph(
            Text(
                "Stage {}: {} is held down with {} against uplift. Make sure that it can be.",
                row["stage"],
                row[kind],
                Quantity(-float(row["force_z_kN"]), "kN", ".1f"),
            ),
            True,
        )
        for row in lowest
        if float(row["force_z_kN"]) < -UPLIFT_KN
    ]


def _extremes(quantity: str, unit: str) -> tuple[Column, ...]:
    """Return columns for the least and the largest value along each axis over the stages, and for their stages."""
    columns = []
    for axis in "xyz":
        key = f"{quantity}_{axis}_{unit}"
        for name, choose in (("least", min), ("largest", max)):
            columns += [
                Column(Text(f"{name} {{}}", axis), f"{name}_{key}", ".1f", partial(_extreme, key, choose, key)),
                Column("stage", f"{name}_{key}_in_stage", "", partial(_extreme, key, choose, "stage")),
            ]
    return tuple(columns)


def _extreme(key: str, choose: Callable[..., dict[str, str]], wanted: str, rows: Sequence[dict[str, str]]) -> Any:
    """Return a cell of the row with the least or largest value of a key."""
    row = choose(rows, key=lambda row: float(row[key]))
    return row[wanted] if wanted == "stage" else float(row[wanted])


def _falls_at(factor: float | None) -> str | None:
    if factor is None:
        return None
    return Text("more than × 64") if math.isinf(factor) else Text("× {}", f"{factor:.2f}")


def _warnings(stages: Sequence[dict[str, str]]) -> list[Block]:
    """Return notices of stages that do not stand, and of parts without support."""
    notices: list[Block] = []
    for row in stages:
        factor = _number(row["collapse_factor"])
        where = row["stage"], f"{float(row['time_s']):g}", read(row["step"], STEPS)
        if factor is not None and factor < 1.0:
            notices.append(
                Paragraph(
                    Text(
                        "Stage {}, from {} s ({}) does not stand: it comes down at {} times its load.",
                        *where,
                        f"{factor:.2f}",
                    ),
                    True,
                )
            )
        elif factor is None and not _number(row["weight_kN"]):
            notices.append(
                Paragraph(Text("Stage {}, from {} s ({}): no connection to a support holds anything.", *where), True)
            )
        if float(row["not_held_kg"]) > 0.0:
            mass = mass_text(float(row["not_held_kg"]), 1)
            notices.append(
                Paragraph(
                    Text("Stage {}, from {} s ({}): {} are held by no connection to a support.", *where, mass), True
                )
            )
    return notices


def _on_members(falls: Sequence[tuple[str, float, float]]) -> str:
    if not any(falls_t for _, falls_t, _ in falls):
        return Text("Each member was taken away by itself from the bridge as it was built: the others stand.")
    return Text(
        "Each member was taken away by itself from the bridge as it was built. Without those below, others come "
        "down: they must not be touched before what they hold."
    )


def _number(cell: str) -> float | None:
    return float(cell) if cell and cell != NOT_SOUGHT else None


def _rows(path: Path, columns: Sequence[str], *, may_be_empty: bool = False) -> list[dict[str, str]]:
    try:
        headings, *lines = list(csv_rows(path, _MOST_BYTES)) or [[]]
    except UnreadableError as error:
        raise OutputError(f"{path}: {error}") from error
    damaged = not set(columns) <= set(headings) or any(len(cells) != len(headings) for cells in lines)
    rows = [] if damaged else [dict(zip(headings, cells, strict=True)) for cells in lines]
    if damaged or not (rows or may_be_empty):
        raise OutputError(f"{path}: expected the columns {', '.join(columns[:3])} … of bda stages; run it again")
    return rows
