"""Tables of the stages of a demolition, with a row for each stage, connection or member; and sentences on them."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ...engineering.units import STANDARD_GRAVITY_M_S2, mass_text, with_digits
from ...system.disk import whole_file
from ...system.reading import csv_cell
from ..structure.model import Model
from .lifted import LIFT_COLUMNS, LIFTS_FILE, PressedBars, hook_cells, lift_rows, lift_sentences
from .misfires import MISFIRE_COLUMNS, MISFIRES_FILE, Misfire, misfire_row
from .reactions import SupportPoint, supports_of
from .stages import Criticality, ReleasedTendon, Stage, reactions_n
from .standing import ALONG_SLAB, RESISTANCE, StandingBridge

FILES = STAGES_FILE, REACTIONS_FILE, BEARINGS_FILE, UTILISATION_FILE, CRITICALITY_FILE, _, _ = (
    "stages.csv",
    "reactions.csv",
    "bearings.csv",
    "utilisation.csv",
    "criticality.csv",
    MISFIRES_FILE,
    LIFTS_FILE,
)

STAGE_COLUMNS = (
    "stage",
    "time_s",
    "step",
    "shards",
    "not_held",
    "not_held_kg",
    "equipment",
    "weight_kN",
    "reaction_x_kN",
    "reaction_y_kN",
    "reaction_z_kN",
    "largest_utilisation",
    "governed_by",
    "between",
    "at_x_m",
    "at_y_m",
    "at_z_m",
    "overloaded",
    "cracked",
    "collapse_factor",
    "sag_mm",
    "first_frequency_Hz",
    "bare_bars_used",
    "tendons_released_kJ",
    "on_hooks_kN",
    "hook_used",
    "not_held_of",
)
REACTION_COLUMNS = (
    "stage",
    "time_s",
    "step",
    "support",
    "kind",
    "at_x_m",
    "at_y_m",
    "at_z_m",
    "force_x_kN",
    "force_y_kN",
    "force_z_kN",
    "moment_x_kNm",
    "moment_y_kNm",
    "moment_z_kNm",
    "own_weight_kN",
)
UTILISATION_COLUMNS = (
    "stage",
    "connection",
    "between",
    "x_m",
    "y_m",
    "z_m",
    "utilisation",
    "of_the_face",
    "of_the_section",
    "governed_by",
)
CRITICALITY_COLUMNS = ("member", "stands", "falls_kg", "share_of_the_bridge", "largest_utilisation", "between")

SLOW_COLLAPSE = (
    "without bars a broken face carries nothing here; in a run its two sides press on each other, and what stands on "
    "such cracks may take seconds to come down"
)
"""What is said where a stage does not stand."""

NOT_SOUGHT = "not sought"
"""In place of a collapse load factor that was left out."""

_FULL = 1.0 + 1e-9
"""Utilisation beyond which it is above 1 by more than rounding: bars that yield are used in full."""

_KILO = 1000.0

UPLIFT_KN = 0.1
"""Less than this is the rounding of a solution."""


def write_tables(
    folder: Path,
    stages: Sequence[Stage],
    members: Sequence[Criticality],
    bridge: StandingBridge,
    failures: Sequence[Misfire] = (),
) -> list[dict[str, Any]]:
    """Write all tables to a folder, made if new, and return the rows of stages."""
    rows = write_stages(folder, stages, bridge)
    write_table(
        folder / CRITICALITY_FILE, CRITICALITY_COLUMNS, (criticality_row(effect, bridge.model) for effect in members)
    )
    write_table(folder / MISFIRES_FILE, MISFIRE_COLUMNS, map(misfire_row, failures))
    return rows


def write_stages(folder: Path, stages: Sequence[Stage], bridge: StandingBridge) -> list[dict[str, Any]]:
    """Write the tables of the stages that are done to a folder, made if new, and return the rows of stages."""
    folder.mkdir(parents=True, exist_ok=True)
    rows = [stage_row(number, stage, bridge) for number, stage in enumerate(stages, start=1)]
    write_table(folder / STAGES_FILE, STAGE_COLUMNS, rows)
    write_table(folder / REACTIONS_FILE, REACTION_COLUMNS, all_reaction_rows(stages, bridge.model))
    write_table(folder / BEARINGS_FILE, BEARING_COLUMNS, bearing_rows(stages, bridge.model))
    used = (row for number, stage in enumerate(stages, start=1) for row in utilisation_rows(number, stage, bridge))
    write_table(folder / UTILISATION_FILE, UTILISATION_COLUMNS, used)
    write_table(folder / LIFTS_FILE, LIFT_COLUMNS, lift_rows(stages))
    return rows


def stage_row(number: int, stage: Stage, bridge: StandingBridge) -> dict[str, Any]:
    """Return the row of a stage, from 1 on."""
    model, standing = bridge.model, stage.standing
    there = ~stage.removed & ~model.fixed
    weight_n = STANDARD_GRAVITY_M_S2 * model.masses_kg[standing.held].sum() + stage.equipment_n
    reaction = reactions_n(model, stage) / _KILO
    row = dict.fromkeys(STAGE_COLUMNS)
    row |= {
        "stage": number,
        "time_s": stage.time_s,
        "step": stage.step,
        "shards": int(there.sum()),
        "not_held": int(stage.loose.sum()),
        "not_held_kg": float(model.masses_kg[stage.loose].sum()),
        "not_held_of": ", ".join(_members_of(model, stage.loose)),
        "equipment": ", ".join(stage.equipment),
        "weight_kN": weight_n / _KILO,
        "reaction_x_kN": reaction[0],
        "reaction_y_kN": reaction[1],
        "reaction_z_kN": reaction[2],
        "overloaded": int((standing.used > _FULL).sum()),
        "cracked": int(standing.cracked.sum()),
        "collapse_factor": NOT_SOUGHT if stage.collapse_factor is None else stage.collapse_factor,
        "sag_mm": standing.sag_m * _KILO,
        "first_frequency_Hz": standing.frequency_hz,
        "bare_bars_used": max((bars.used for bars in stage.bars), default=None),
        "tendons_released_kJ": math.fsum(tendon.released_j for tendon in stage.tendons) / _KILO
        if model.tendons
        else None,
        **hook_cells(stage.lifts),
    }
    if most := stage.most_used:
        x, y, z = most.at_m
        row |= {
            "largest_utilisation": most.used,
            "governed_by": most.governed_by,
            "between": " and ".join(most.between),
            "at_x_m": x,
            "at_y_m": y,
            "at_z_m": z,
        }
    return row


def _members_of(model: Model, shards: np.ndarray) -> list[str]:
    """Return the names of the members of shards (n,), in their order."""
    return [model.members[member].name for member in np.unique(model.member_of_shard[shards]).tolist()]


def all_reaction_rows(stages: Sequence[Stage], model: Model) -> list[dict[str, Any]]:
    """Return the rows of the supports, stage by stage."""
    supports = supports_of(model)
    return [
        _reaction_row(number, stage, support) for number, stage in enumerate(stages, start=1) for support in supports
    ]


def _reaction_row(number: int, stage: Stage, support: SupportPoint) -> dict[str, Any]:
    force_n, moment_nm = support.reaction(stage.standing.loads)
    values = number, stage.time_s, stage.step, support.name, support.kind, *support.point_m.tolist()
    values += *(force_n / _KILO).tolist(), *(moment_nm / _KILO).tolist(), support.own_weight_n / _KILO
    return dict(zip(REACTION_COLUMNS, values, strict=True))


def utilisation_rows(number: int, stage: Stage, bridge: StandingBridge) -> Iterable[dict[str, Any]]:
    """Yield the rows of the connections that are there in a stage."""
    model, standing = bridge.model, stage.standing
    governed_by = bridge.governed_by(standing)
    for row in np.flatnonzero(np.isfinite(standing.used)).tolist():
        utilisations = standing.used[row], standing.alone[row], standing.together[row]
        values = number, row, between(model, row), *model.connections.points[row], *utilisations, governed_by[row]
        yield dict(zip(UTILISATION_COLUMNS, values, strict=True))


def criticality_row(effect: Criticality, model: Model) -> dict[str, Any]:
    """Return the row of a member."""
    stands = "true" if effect.falls_kg == 0.0 else "false"
    where = None if effect.most_used is None else between(model, effect.most_used)
    values = effect.member, stands, effect.falls_kg, effect.share, effect.used, where
    return dict(zip(CRITICALITY_COLUMNS, values, strict=True))


def stage_sentences(stage: Stage, row: Mapping[str, Any]) -> list[str]:
    """Return sentences on a stage, by its row in the table: first which it is."""
    sentences = [f"stage {row['stage']}, from {stage.time_s:g} s: {stage.step}"]
    if stage.equipment:
        sentences.append(f"with {row['equipment']}")
    if row["not_held"]:
        part = f"{row['not_held']} shards, {mass_text(row['not_held_kg'], 1)} of {row['not_held_of']}"
        sentences.append(f"{part}, held by no connection to a support")
    if stage.most_used:
        by = "" if stage.most_used.governed_by in (RESISTANCE, ALONG_SLAB) else f" by {row['governed_by']}"
        sentences.append(
            f"used most: {row['largest_utilisation']:z.0%} {stage.most_used.words}{by}, in {row['between']} at "
            f"[{row['at_x_m']:.1f}, {row['at_y_m']:.1f}, {row['at_z_m']:.1f}] m"
        )
    if row["cracked"]:
        sentences.append(f"{row['cracked']} faces are cracked and held by bars")
    sentences += [_of_bare_bars(bars) for bars in stage.bars]
    sentences += [_of_tendon(tendon) for tendon in stage.tendons]
    sentences += lift_sentences(stage.lifts, row["not_held_kg"])
    if stage.collapse_factor is not None:
        sentences.append(factor_in_words(stage.collapse_factor, bool(stage.standing.held.any())))
        if stage.collapse_factor < 1.0:
            sentences.append(SLOW_COLLAPSE)
    return sentences


def _of_bare_bars(bars: PressedBars) -> str:
    how = "pulled" if bars.force_n > 0.0 else "pressed"
    force, resisted = (f"{with_digits(abs(load_n) / _KILO, 0)} kN" for load_n in (bars.force_n, bars.resisted_n))
    return f"bare bars of {bars.zone} are {how} with {force} at rest, and resist {resisted}"


def _of_tendon(tendon: ReleasedTendon) -> str:
    energy = f"{with_digits(tendon.released_j / _KILO, 1)} kJ"
    return f"tendon {tendon.name} lets go {energy} at once: keep everybody off its line and its anchorages"


def criticality_sentences(members: Sequence[Criticality]) -> list[str]:
    """Return what comes down without which member, the most first."""
    falls = sorted((member for member in members if member.falls_kg), key=lambda member: -member.falls_kg)
    sentences = [f"without {fall.member}: {mass_text(fall.falls_kg, 1)} come down, {fall.share:.0%}" for fall in falls]
    if not falls:
        sentences.append("without any one member the others stand")
    standing = [member for member in members if not member.falls_kg and member.used > 0.0]
    if standing:
        worst = max(standing, key=lambda member: member.used)
        which = f"of those without which the others stand, {worst.member}" if falls else worst.member
        sentences.append(f"missed most, {which}: without it the others are used by {worst.used:.0%} before any breaks")
    return sentences


def reaction_sentences(rows: Sequence[Mapping[str, Any]]) -> list[str]:
    """Return what the supports of one stage carry, by their rows in the table: the least and the most, and uplift."""
    if not rows:
        return []
    return [_carried(rows, "support"), *_named("held down against uplift", _pulling(rows), "support")]


def bearing_sentences(rows: Sequence[Mapping[str, Any]]) -> list[str]:
    """Return what the bearings of one stage carry, by their rows in the table, and which lifted off or are gone."""
    there, gone = [row for row in rows if row["left_share"]], [row for row in rows if not row["left_share"]]
    lifted = [row for row in there if abs(row["force_z_kN"]) <= UPLIFT_KN]
    return [
        *([_carried(there, "bearing")] if there else []),
        *_named("held down against uplift", _pulling(there), "bearing"),
        *_named("lifted off", lifted, "bearing"),
        *_named("gone", gone, "bearing"),
    ]


def _carried(rows: Sequence[Mapping[str, Any]], kind: str) -> str:
    least, most = (choose(rows, key=lambda row: row["force_z_kN"]) for choose in (min, max))
    return f"{kind}s carry {_kilonewtons(least)} ({least[kind]}) to {_kilonewtons(most)} ({most[kind]})"


def _pulling(rows: Sequence[Mapping[str, Any]]) -> list[Mapping[str, Any]]:
    return [row for row in rows if row["force_z_kN"] < -UPLIFT_KN]


def _named(what: str, rows: Sequence[Mapping[str, Any]], kind: str) -> list[str]:
    return [f"{what}: {', '.join(row[kind] for row in rows)}"] if rows else []


def _kilonewtons(row: Mapping[str, Any]) -> str:
    return f"{with_digits(row['force_z_kN'], 0)} kN"


def factor_in_words(factor: float, is_held: bool) -> str:
    """Return the collapse load factor of a stage as a sentence, maybe of one in which nothing of the bridge is held."""
    if math.isnan(factor):
        return (
            "no collapse load factor, as part of the bridge is not held"
            if is_held
            else "no connection to a support holds anything"
        )
    return f"comes down at {f'{factor:.2f} times' if math.isfinite(factor) else 'more than 64 times'} its load"


def between(model: Model, row: int) -> str:
    """Return the members that a connection is between, or the one that it is within."""
    return " and ".join(model.between(row))


def write_table(path: Path, columns: Sequence[str], rows: Iterable[dict[str, Any]]) -> None:
    """Write a table as CSV; an unknown value is empty, an infinite one ``inf``."""
    with whole_file(path) as part, part.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(columns)
        for row in rows:
            table.writerow([csv_cell(_cell(row[name])) for name in columns])


def _cell(value: Any) -> str:
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return ""
    return f"{value:.6g}" if isinstance(value, float) else str(value)


BEARING_COLUMNS = (
    "stage",
    "time_s",
    "step",
    "bearing",
    "axis_x_m",
    "axis_y_m",
    "axis_z_m",
    "force_x_kN",
    "force_y_kN",
    "force_z_kN",
    "moment_x_kNm",
    "moment_y_kNm",
    "moment_z_kNm",
    "left_share",
)


def bearing_rows(stages: Sequence[Stage], model: Model) -> Iterator[dict[str, Any]]:
    """Yield the rows of the bearings in every stage; none without `[[bearings]]`.

    Moments are about the middle of the axis. What has lifted off has no force, and what is gone no `left_share`.
    """
    if model.bearings is None:
        return
    for number, stage in enumerate(stages, start=1):
        for index, bearing in enumerate(model.bearings.forces(stage.standing.loads)):
            left = np.isfinite(stage.standing.used[model.bearings.rows_of(index)])
            values = *(bearing.force_n / _KILO).tolist(), *(bearing.moment_nm / _KILO).tolist()
            of_stage = number, stage.time_s, stage.step
            row = *of_stage, bearing.name, *bearing.axis_m.tolist(), *values, float(left.mean()) if len(left) else 0.0
            yield dict(zip(BEARING_COLUMNS, row, strict=True))
