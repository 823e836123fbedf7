"""What stages say, in plain words."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from .stages import Criticality, Stage


def stage_sentences(stage: Stage, row: Mapping[str, Any]) -> list[str]:
    """Return what is said of a stage, by its row in the table: first which it is."""
    told = [f"stage {row['stage']}, from {stage.time_s:g} s: {stage.step}"]
    if stage.equipment:
        told.append(f"with {row['equipment']}")
    if row["not_held"]:
        told.append(
            f"{row['not_held']} shards, {row['not_held_kg'] / 1000.0:.1f} t, held by no connection to a support"
        )
    if row["largest_utilisation"] is not None:
        told.append(
            f"used most: {row['largest_utilisation']:.0%} by {row['governed_by']}, in {row['between']} at "
            f"[{row['at_x_m']:.1f}, {row['at_y_m']:.1f}, {row['at_z_m']:.1f}] m"
        )
    return [*told, factor_in_words(stage.collapse_factor)]


def criticality_sentences(members: Sequence[Criticality]) -> list[str]:
    """Return what comes down without which member, the most first."""
    falls = sorted((each for each in members if each.falls_kg), key=lambda one: -one.falls_kg)
    if not falls:
        return ["without any one member the others stand"]
    return [f"without {each.member}: {each.falls_kg / 1000.0:.1f} t come down, {each.share:.0%}" for each in falls]


def factor_in_words(factor: float) -> str:
    """Return at how many times its load a stage comes down."""
    if math.isnan(factor):
        return "no connection to a support holds anything"
    return f"comes down at {f'{factor:.2f} times' if math.isfinite(factor) else 'more than 64 times'} its load"
