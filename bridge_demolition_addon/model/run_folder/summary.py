"""The summary of a run: its main numbers, in ``summary.json``."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ...errors import OutputError, UnreadableError
from ...system.disk import write_whole_text
from ...system.reading import MEGABYTE, file_text
from ..results.checks import can_be_written
from ..results.summary import first_hit_s
from ..schema import LARGEST_NUMBER, shown
from .files import SUMMARY_FILE

_MOST_BYTES = 100 * MEGABYTE
"""Size up to which a summary is read, which lists every frame."""


class BodyValue(NamedTuple):
    """A largest value, with its body and its frame; without a frame it is of the last one."""

    value: float
    body: str
    frame: int | None = None


@dataclass(frozen=True, slots=True, eq=False)
class RunSummary:
    """A summary by its keys in the file. Earlier versions wrote less, and only some values are checked."""

    values: Mapping[str, Any]

    @property
    def title(self) -> str | None:
        """Title of the run."""
        return self.values.get("title")

    @property
    def completed(self) -> bool:
        """Whether the run went on for as long as planned."""
        return self.values.get("completed", True)

    @property
    def blender(self) -> str | None:
        """Version of Blender."""
        return self.values.get("blender")

    @property
    def density_kg_m3(self) -> float | None:
        """Density of the bridge."""
        return self.values.get("density_kg_m3")

    @property
    def made_by_hand(self) -> list[str]:
        """Changes made in Blender, which the scenario does not hold."""
        return self.values.get("made_by_hand", [])

    @property
    def terrain(self) -> dict[str, Any] | None:
        """Facts of the terrain; None where the ground is flat."""
        return self.values.get("terrain")

    @property
    def key_frame(self) -> int:
        """Frame of the picture of the run."""
        return self.values["key_frame"]["frame"]

    @property
    def key_frame_reason(self) -> str | None:
        """Why the picture of the run was taken when it was."""
        return self.values.get("key_frame", {}).get("reason")

    @property
    def impact_s(self) -> float | None:
        """End of the frame in which the ball hit; None where it did not, or this is unknown."""
        impact = self.values.get("impact")
        return float(impact["time_s"]) if impact else None

    @property
    def first_hit_s(self) -> float | None:
        """When the ball hit, to a sub-step where its hits were recorded; None as for `impact_s`."""
        return first_hit_s(self.values)

    @property
    def hits_of_the_ball(self) -> list[dict[str, Any]]:
        """Every hit of every ball."""
        return self.values.get("hits_of_the_ball", [])

    @property
    def bearings(self) -> list[dict[str, Any]]:
        """The largest and least that each bearing carried; empty of runs that were recorded before."""
        return self.values.get("bearings", [])

    @property
    def reinforcement(self) -> dict[str, Any] | None:
        """What bars across cracks did; None without them, and of runs that were recorded before."""
        return self.values.get("reinforcement")

    @property
    def tendons(self) -> list[dict[str, Any]]:
        """What each tendon stored at first and let go; empty without tendons, and of runs that were recorded before."""
        return self.values.get("tendons", [])

    @property
    def pulls(self) -> list[dict[str, Any]]:
        """What each cable pulled with; empty without cables, and of runs that were recorded before."""
        return self.values.get("pulls", [])

    @property
    def loads(self) -> list[dict[str, Any]]:
        """What each load did; empty without loads, and of runs that were recorded before."""
        return self.values.get("loads", [])

    @property
    def came_to_rest_s(self) -> float | None:
        """When everything came to rest; None where it did not."""
        return self.values.get("came_to_rest_s")

    @property
    def largest_force_n(self) -> BodyValue | None:
        """Largest resultant on a shard."""
        force = self.values["largest_resultant"]
        return force and BodyValue(force["force_N"], force["body"], force["frame"])

    @property
    def largest_throw_m(self) -> BodyValue | None:
        """Largest throw of a shard."""
        throw = self.values["largest_throw"]
        return throw and BodyValue(throw["throw_m"], throw["body"])

    @property
    def has_blast(self) -> bool:
        """Whether charges loaded the bridge, or were to."""
        return bool(self.values.get("charges") or self.values["blast"])

    @property
    def result_digest(self) -> str:
        """Digest of the results."""
        return self.values["fingerprint"]["result"]


def read_summary(folder: Path) -> RunSummary:
    """Read the summary in a run's folder; errors do not name the file.

    Raises
    ------
    UnreadableError, ValueError
        The file cannot be read, or is no JSON.
    OutputError
        It holds something that no run writes.
    """
    return RunSummary(_checked(_read(folder)))


def write_summary(folder: Path, values: Mapping[str, Any]) -> None:
    """Write a summary, in place of one that is there."""
    write_whole_text(folder / SUMMARY_FILE, json.dumps(values, indent=2) + "\n")


def result_digest_in(folder: Path) -> str | None:
    """Return the digest of the results in a folder; None if unreadable."""
    try:
        return _read(folder)["fingerprint"]["result"]
    except (UnreadableError, ValueError, KeyError, TypeError):
        return None


def _read(folder: Path) -> Any:
    try:
        return json.loads(file_text(folder / SUMMARY_FILE, _MOST_BYTES))
    except RecursionError as error:
        raise ValueError(str(error)) from error


def _checked(summary: Any) -> dict[str, Any]:
    """Return a summary after checking all that is read from it again."""
    _check_table("the whole", summary, _SUMMARY, optional=_SUMMARY)
    for name in ("impact", "key_frame"):
        if summary.get(name) is not None:
            _check_table(name, summary[name], {"time_s": _is_number, "reason": _is_text}, optional=("reason",))
    if summary.get("fell_by_itself") is not None:
        _check_table("fell_by_itself", summary["fell_by_itself"], _FALL)
    if summary.get("moving_at_end") is not None:
        _check_table("moving_at_end", summary["moving_at_end"], _MOVING)
    if summary.get("stability") is not None:
        _check_stability(summary["stability"])
    if summary.get("terrain") is not None:
        _check_table("terrain", summary["terrain"], _TERRAIN)
        for number, surface in enumerate(summary["terrain"]["levelled"]):
            _check_table(f"terrain.levelled[{number}]", surface, _LEVELLED)
    if summary.get("creeping") is not None:
        _check_table("creeping", summary["creeping"], _CREEPING)
        for number, shard in enumerate(summary["creeping"]["fastest"]):
            _check_table(f"creeping.fastest[{number}]", shard, _CREEPING_SHARD)
    for number, bearing in enumerate(summary.get("bearings", ())):
        _check_table(f"bearings[{number}]", bearing, _BEARING)
    if summary.get("reinforcement") is not None:
        _check_bars(summary["reinforcement"])
    for number, tendon in enumerate(summary.get("tendons", ())):
        _check_table(f"tendons[{number}]", tendon, _TENDON)
        for other, release in enumerate(tendon["released"]):
            _check_table(f"tendons[{number}].released[{other}]", release, _RELEASE)
    for number, pull in enumerate(summary.get("pulls", ())):
        _check_table(f"pulls[{number}]", pull, _PULL)
    for number, load in enumerate(summary.get("loads", ())):
        _check_table(f"loads[{number}]", load, _LOAD)
    for number, lift in enumerate(summary.get("lifts", ())):
        _check_table(f"lifts[{number}]", lift, _LIFT, optional=("volume_weight_N",))
    for number, event in enumerate(summary.get("events", ())):
        _check_table(f"events[{number}]", event, _EVENT if "cage_pressed_n" in event else {})
    for number, hit in enumerate(summary.get("hits_of_the_ball", ())):
        _check_table(f"hits_of_the_ball[{number}]", hit, _HIT, optional=_ESTIMATES)
    return summary


def _check_table(
    name: str, table: Any, keys: Mapping[str, Callable[[Any], bool]], optional: Mapping[str, Any] | tuple = ()
) -> None:
    if not isinstance(table, dict):
        raise OutputError(f"{name}: is {shown(table)}, expected a table")
    for key, holds in keys.items():
        if key not in table and key not in optional:
            raise OutputError(f"{name}: has no {key}")
        if key in table and not holds(table[key]):
            raise OutputError(f"{key}: is {shown(table[key])}, which no run writes")


def _check_stability(stability: Any) -> None:
    _check_table("stability", stability, _STABILITY, optional=("zones",))
    tables = {"overloaded": _OVERLOADED, "unsupported": _MEMBER_SHARE, "loose": _MEMBER_SHARE, "zones": _ZONE_LOAD}
    for name, keys in tables.items():
        for number, row in enumerate(stability.get(name, ())):
            _check_table(f"stability.{name}[{number}]", row, keys)


def _check_bars(bars: Any) -> None:
    _check_table("reinforcement", bars, _BARS)
    for number, kind in enumerate(bars["by_kind"]):
        _check_table(f"reinforcement.by_kind[{number}]", kind, _BARS_OF_KIND)
    if bars["largest_use"] is not None:
        _check_table("reinforcement.largest_use", bars["largest_use"], _LARGEST_USE)


def _is_number(value: Any) -> bool:
    if isinstance(value, bool) or not isinstance(value, int | float):
        return False
    return -LARGEST_NUMBER <= value <= LARGEST_NUMBER and math.isfinite(value)


def _is_text(value: Any) -> bool:
    return isinstance(value, str) and can_be_written(np.array(value))


def _is_list(value: Any) -> bool:
    return isinstance(value, list)


def _is_table_or_none(value: Any) -> bool:
    return isinstance(value, dict | None)


def _is_number_or_none(value: Any) -> bool:
    return value is None or _is_number(value)


def _are_texts(value: Any) -> bool:
    return isinstance(value, list) and all(map(_is_text, value))


_FALL = {
    "until_s": _is_number_or_none,
    "first_break_s": _is_number_or_none,
    "broken": _is_number,
    "connections": _is_number,
    "largest_move_m": _is_number,
}
_MOVING = {
    "shards": _is_number,
    "of_shards": _is_number,
    "mass_kg": _is_number,
    "fastest_m_s": _is_number,
    "body": _is_text,
    "member": _is_text,
}
_MEMBER_SHARE = {"member": _is_text, "shards": _is_number, "mass_kg": _is_number}
_OVERLOADED = {"member": _is_text, "connections": _is_number, "utilisation": _is_number}
_ZONE_LOAD = {"zone": _is_text, "pressed_n": _is_number, "shear_n": _is_number, "bending_nm": _is_number}
_STABILITY = {
    "verdict": _is_text,
    "reason": _is_text,
    "load_factor": _is_number_or_none,
    "utilisation": _is_number_or_none,
    "used_most": _is_text,
    "deflection_m": _is_number_or_none,
    "cracked": _is_number,
    "overloaded_connections": _is_number,
    "connections": _is_number,
    "overloaded": _is_list,
    "unsupported": _is_list,
    "loose": _is_list,
    "loose_on": _are_texts,
    "zones": _is_list,
    "is_rigid": lambda value: isinstance(value, bool),
    "is_asleep": lambda value: isinstance(value, bool),
}
_CREEPING = {"shards": _is_number, "mass_kg": _is_number, "fastest": lambda value: _is_list(value) and bool(value)}
_CREEPING_SHARD = {"body": _is_text, "member": _is_text, "speed_m_s": _is_number, "moved_m": _is_number}
_TERRAIN = {
    "name": _is_text,
    "heights": _is_number,
    "triangles": _is_number,
    "step_m": _is_number,
    "largest_error_m": _is_number,
    "error_place_m": lambda value: _is_list(value) and len(value) == 2 and all(map(_is_number, value)),
    "common_error_m": _is_number,
    "lowest_m": _is_number,
    "highest_m": _is_number,
    "filled_in_share": _is_number,
    "levelled": _is_list,
}
_BEARING = {
    "name": _is_text,
    "at_rest_up_N": _is_number_or_none,
    "largest_up_N": _is_number,
    "least_up_N": _is_number,
    "largest_horizontal_N": _is_number,
    "largest_moment_y_Nm": _is_number,
    "largest_open_share": _is_number,
    "largest_displacement_m": _is_number,
    "left_share": _is_number,
    "opened": lambda value: isinstance(value, bool),
    "opened_s": _is_number_or_none,
    "gone_s": _is_number_or_none,
    "slid": lambda value: value is None or isinstance(value, bool),
}
_CRACK_COUNTS = {
    name: _is_number
    for name in ("cracked", "held_at_end", "yielded", "ruptured_in_part", "ruptured", "largest_use_share")
}
_BARS = _CRACK_COUNTS | {"with_bars": _is_number, "largest_use": _is_table_or_none, "by_kind": _is_list}
_BARS_OF_KIND = _CRACK_COUNTS | {"kind": _is_text, "largest_use_s": _is_number_or_none}
_LARGEST_USE = {
    "share": _is_number,
    "time_s": _is_number,
    "connection": _is_text,
    "first_member": _is_text,
    "second_member": _is_text,
}
_TENDON = {"name": _is_text, "member": _is_text, "force_N": _is_number, "stored_J": _is_number, "released": _is_list}
_PULL = {
    "name": _is_text,
    "largest_force_N": _is_number,
    "largest_force_s": _is_number,
    "paid_out_s": _is_number_or_none,
    "ended": lambda value: value is None or _is_text(value),
    "ended_s": _is_number_or_none,
    "let_go_J": _is_number_or_none,
    "work_J": _is_number,
}
_LIFT = {
    "name": _is_text,
    "largest_hook_N": _is_number,
    "largest_hook_s": _is_number,
    "weight_N": _is_number,
    "volume_weight_N": _is_number,
}
_EVENT = {
    "zone": _is_text,
    "cage_compression_n": _is_number,
    "cage_pressed_n": _is_number,
    "cage_folded_m": _is_number,
}
"""What is read of a blast zone whose bars stood bare."""
_RELEASE = {"time_s": _is_number, "how": _is_text, "energy_J": _is_number}
_LEVELLED = {"name": _is_text, "dug_m": _is_number, "filled_m": _is_number}
_SUMMARY = {
    "terrain": _is_table_or_none,
    "made_by_hand": _are_texts,
    "changed_bodies": _are_texts,
    "fell_by_itself": _is_table_or_none,
    "plain_concrete": _are_texts,
    "creeping": _is_table_or_none,
    "moving_at_end": _is_table_or_none,
    "stability": _is_table_or_none,
    "title": _is_text,
    "completed": lambda value: isinstance(value, bool),
    "simulated_s": _is_number,
    "ended_before": lambda value: value is None or _is_text(value),
    "blender": _is_text,
    "density_kg_m3": _is_number,
    "impact": _is_table_or_none,
    "key_frame": lambda value: isinstance(value, dict),
    "hits_of_the_ball": _is_list,
    "bearings": _is_list,
    "reinforcement": _is_table_or_none,
    "tendons": _is_list,
    "pulls": _is_list,
    "loads": _is_list,
    "lifts": _is_list,
    "events": lambda value: _is_list(value) and all(isinstance(event, dict) for event in value),
}

_LOAD = {
    "name": _is_text,
    "largest_force_N": _is_number,
    "largest_force_s": _is_number,
    "impulse_Ns": lambda value: _is_list(value) and len(value) == 3 and all(map(_is_number, value)),
    "work_J": _is_number,
}

_ESTIMATES = {"half_sine_peak_force_N": _is_number, "hertz_peak_force_N": _is_number}

_HIT = {
    "ball": _is_text,
    "time_s": _is_number,
    "lasted_s": _is_number,
    "approach_m_s": _is_number,
    "impulse_Ns": _is_number,
    "raw_peak_force_N": _is_number,
    **_ESTIMATES,
}
"""A hit from behind has no estimates."""
