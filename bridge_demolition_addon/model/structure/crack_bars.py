"""All bars that hold where connections crack, as a run has them: those in layers, and those that are spread evenly."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...engineering.elasticity.steel_bars import Steel
from ...engineering.mechanics.joint import Joint
from ...engineering.mechanics.reinforcement import FaceBars
from ..scenario import ConnectionSettings


@dataclass(frozen=True, slots=True, eq=False)
class CrackBars:
    """Bars across the faces of m connections, and what they are made of."""

    bars: FaceBars
    steel: Steel


def even_bars_n(
    settings: ConnectionSettings, joints: Sequence[Joint], joint_of_connection: np.ndarray, areas_m2: np.ndarray
) -> np.ndarray:
    """Return the forces (m,) at which bars yield that are spread evenly over faces, by `connections.ductile_share`."""
    tension_pa = np.array([0.0 if joint.strength is None else joint.strength.tension_pa for joint in joints])
    even: np.ndarray = settings.ductile_share * tension_pa[joint_of_connection] * areas_m2
    return even
