"""What tendons let go from one stage to the next."""

from __future__ import annotations

from dataclasses import dataclass

from .changed_bridge import ChangedBridge
from .standing import StandingBridge

_LEAST_J = 1.0


@dataclass(frozen=True, slots=True)
class ReleasedTendon:
    """A tendon that is cut, the energy that it lets go, and the part of it that stays in it."""

    name: str
    released_j: float
    left_share: float


def released_tendons(bridge: StandingBridge, before: ChangedBridge, after: ChangedBridge) -> tuple[ReleasedTendon, ...]:
    """Return what the tendons of a bridge let go by changes."""
    whole, first, then = (
        bridge.tendons(changed.intact, changed.cuts)
        for changed in (ChangedBridge.as_built(bridge.model), before, after)
    )
    tendons = bridge.model.tendons
    if whole is None or first is None or then is None or tendons is None:
        return ()
    columns = zip(
        tendons.names, whole.stored_j().tolist(), first.stored_j().tolist(), then.stored_j().tolist(), strict=True
    )
    return tuple(
        ReleasedTendon(name, had_j - has_j, has_j / whole_j)
        for name, whole_j, had_j, has_j in columns
        if had_j - has_j > _LEAST_J
    )
