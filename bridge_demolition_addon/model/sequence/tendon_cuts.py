"""Which tendons a cut of tendons meets, and where along them."""

from __future__ import annotations

import json
from collections.abc import Iterator

import numpy as np

from ...engineering.elasticity.tendons import CutTendon
from ...errors import ScenarioError
from ..scenario import TendonCut
from ..structure.tendons import ModelTendons


def cuts_of_tendons(change: TendonCut, tendons: ModelTendons | None) -> tuple[CutTendon, ...]:
    """Return the cuts; refuse a change that meets no tendon, or a bonded one without saying where."""
    cuts = tuple(_cuts(change, tendons)) if tendons else ()
    if not cuts:
        raise ScenarioError(
            f"{change.table} at {change.time_s:g} s: no tendon is there; "
            "expected names, members or a box that meet some"
        )
    return cuts


def cut_text(cuts: tuple[CutTendon, ...], tendons: ModelTendons) -> str:
    """Return which tendons are cut, where, and which energy they let go, of tendons that were whole."""
    released_j = tendons.forces(*_anywhere(tendons)).cut(cuts)
    parts = []
    for number in sorted({cut.tendon for cut in cuts}):
        at = next(cut.distance_m for cut in cuts if cut.tendon == number)
        x, y, z = tendons.point_at(number, at).tolist()
        parts.append(
            f"{tendons.names[number]} in {tendons.members[number]} at ({x:.2f}, {y:.2f}, {z:.2f}) m, "
            f"{released_j[number] / 1000.0:.1f} kJ let go"
        )
    return "; ".join(parts)


def _cuts(change: TendonCut, tendons: ModelTendons) -> Iterator[CutTendon]:
    for number, (name, member) in enumerate(zip(tendons.names, tendons.members, strict=True)):
        if change.tendons is not None and name not in change.tendons:
            continue
        if change.members is not None and member not in change.members:
            continue
        if change.box is None:
            if tendons.steel.bonded[number]:
                raise change.unexpected(
                    "lowest_corner_m",
                    f"both corners of a box, as {json.dumps(name, ensure_ascii=False)} is bonded and lets go only near "
                    "the cut",
                )
            yield CutTendon(number, 0.0)
            continue
        at_m = tendons.within_box(number, change.box)
        if at_m is not None:
            yield CutTendon(number, at_m)


def _anywhere(tendons: ModelTendons) -> tuple[np.ndarray, np.ndarray]:
    """Positions (3, n) and rotations (3, 3, n) of as many bodies as tendons pass."""
    count = int(max(tendons.passages.first.max(), tendons.passages.second.max())) + 1
    return np.zeros((3, count)), np.repeat(np.eye(3)[:, :, None], count, axis=2)
