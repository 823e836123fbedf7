"""Bullet's own constraints of footings and pads, which lift off."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...bullet.constraint_rows import ConstraintRows
from ...engineering.elasticity.bearings import Bearings
from ...engineering.foundations import Footings

_NONE = np.zeros(0, int)


class LiftingConstraints:
    """Makes Bullet's own constraints of footings or pads softer as less of them touches."""

    def __init__(self, law: Footings | Bearings):
        self._law, self._touching = law, np.ones(len(law.rows))

    def begin(self) -> None:
        """Take all of them for touching, as constraints are made."""
        self._touching[:] = 1.0

    def follow(self, constraints: ConstraintRows, softness: np.ndarray, intact: Callable[[], np.ndarray]) -> None:
        """Soften constraints (m,) that are intact, of which all (6, m) have a softness where they touch all over."""
        touching, rows = self._law.touching, self._law.rows
        is_other = touching != self._touching
        changed = np.flatnonzero(is_other & intact()[rows]) if is_other.any() else _NONE
        if not len(changed):
            return
        share = touching[changed]
        softness = softness[:, rows[changed]]
        softer = np.divide(softness, share, out=np.full_like(softness, np.inf), where=share > 0.0)
        constraints.soften(rows[changed], softer)
        self._touching[changed] = share
