"""What tendons let go from one stage to the next."""

from __future__ import annotations

from dataclasses import dataclass

from ...engineering.elasticity.tendons import LEAST_RELEASED_J
from ..schema import given
from .changed_bridge import ChangedBridge
from .standing import StandingBridge


@dataclass(frozen=True, slots=True)
class ReleasedTendon:
    """A tendon that is cut, and the energy that it lets go."""

    name: str
    released_j: float


def released_tendons(bridge: StandingBridge, before: ChangedBridge, after: ChangedBridge) -> tuple[ReleasedTendon, ...]:
    """Return what the tendons of a bridge let go by changes."""
    first, then = (bridge.tendons(changed.intact, changed.cuts) for changed in (before, after))
    if first is None or then is None:
        return ()
    released_j = (first.stored_j() - then.stored_j()).tolist()
    pairs = zip(given(bridge.model.tendons).names, released_j, strict=True)
    return tuple(ReleasedTendon(name, energy_j) for name, energy_j in pairs if energy_j > LEAST_RELEASED_J)
