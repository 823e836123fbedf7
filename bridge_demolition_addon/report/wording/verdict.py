"""The verdict of a report: one sentence on a run or a study. Distances are rounded up."""

from __future__ import annotations

from collections.abc import Mapping

from ...engineering.units import rounded_up
from ...model.schema import given
from ...model.study.conclusions import DebrisLimit
from ...model.study.criteria import KINDS
from ...texts import Text, distance_to_keep
from .numbers import listed, percent

FALLEN, STANDS = given(KINDS["span down"].share), given(KINDS["span stands"].share)
"""Parts of its height from which on a span is down, and up to which it stands, as criteria of studies have them."""

NO_LIMIT_OF_ONE_RUN = Text("one run gives no limit to plan with")

_NO_FRAMES = Text("No frame of this one run is there, only its logs: it has no verdict.")
_NO_SHARDS = Text("This one run has no shards: there is no bridge to judge.")


def run_verdict(lost: Mapping[str, float], distance_m: float, end: str, *, is_final: bool = True) -> str:
    """Return what one run came out as; where that is not final, no span stood, it had only not come down.

    Parameters
    ----------
    lost
        Parts of their heights that spans have lost at the end, by name.
    distance_m
        How far debris got from the bridge's plan at any time.
    end
        When all was at rest, or what still moved, as a clause.
    """
    return Text("In this one run {}, {}, and {}.", _spans(lost, is_final=is_final), _debris(distance_m), end)


def verdict_so_far(lost: Mapping[str, float], distance_m: float) -> str:
    """Return how far a run without an outcome had got when it ended; arguments are those of `run_verdict`."""
    return Text("Up to then {}, and {}.", _spans(lost, is_final=False), _debris(distance_m))


def verdict_without_frames(has_results: bool) -> str:
    """Return why there is no verdict on a run."""
    return _NO_SHARDS if has_results else _NO_FRAMES


def run_limit(distance_m: float, note: str = "") -> str:
    """Return how far debris of one run got, and that this is no limit; `note` says why it is not final."""
    debris = _debris(distance_m)
    if note:
        return Text("{} in this one run ({}); {}", debris, note, NO_LIMIT_OF_ONE_RUN)
    return Text("{} in this one run; {}", debris, NO_LIMIT_OF_ONE_RUN)


def study_verdict(limit: DebrisLimit, buffer_m: float | None, *, is_final: bool = True) -> str:
    """Return what a study says to plan with, or that it says nothing yet."""
    if not limit.has_enough_runs:
        return Text("These {} runs set no limit yet: it takes {}.", limit.runs, limit.runs_needed)
    if not limit.is_known:
        return Text("These runs set no limit, as {} of {} did not finish.", limit.unfinished, limit.runs)
    around = Text("Debris stays within {} of the bridge's plan", distance_to_keep(rounded_up(limit.limit_m, "0.1")))
    if buffer_m:
        in_all = distance_to_keep(rounded_up(limit.limit_m + buffer_m, "0.1"))
        around = Text("{}, {} with the buffer of {}", around, in_all, distance_to_keep(buffer_m, "g"))
    parts = around, percent(limit.quantile), limit.runs, percent(limit.confidence)
    if is_final:
        return Text("{}, in at least {} of runs like these {}, with {} confidence.", *parts)
    return Text(
        "{}, in at least {} of runs like these {}, with {} confidence, while some of them still moved at their end.",
        *parts,
    )


def _spans(lost: Mapping[str, float], *, is_final: bool) -> str:
    fallen = [name for name, share in lost.items() if share >= FALLEN]
    stood = [name for name, share in lost.items() if share <= STANDS]
    partly = {name: share for name, share in lost.items() if STANDS < share < FALLEN}
    if len(stood) == len(lost) and not is_final:
        return Text("no span had come down")
    if len(stood) == len(lost):
        most = rounded_up(100.0 * max(0.0, *lost.values(), 0.0), "1")
        return Text("the bridge stood, with no more than {} % of a span's height lost", most)
    parts = [Text("{} came down", listed(fallen))] if fallen else []
    parts += [
        Text("{} came down by {} % of its height", name, f"{100.0 * share:.0f}") for name, share in partly.items()
    ]
    parts += [Text("{} stood" if is_final else "{} had not come down", listed(stood))] if stood else []
    return listed(parts)


def _debris(distance_m: float) -> str:
    if distance_m <= 0.0:
        return Text("no debris got beyond the bridge's plan")
    return Text("debris stayed within {} of the bridge's plan", distance_to_keep(rounded_up(distance_m, "0.1")))
