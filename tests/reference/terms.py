# SPDX-License-Identifier: GPL-3.0-or-later
"""Forces across gaps in a sub-step, by numpy: what the compiled core has for cracks, springs and bare bars.

All arrays have their components first.
"""

from __future__ import annotations

import numpy as np
from reference.crack_law import CrackLaw
from reference.spring_law import ReferenceSprings

from bridge_demolition_addon.engineering.elasticity.joint_rows import cross_products, dot_products
from bridge_demolition_addon.engineering.elasticity.steel_bars import Bars
from bridge_demolition_addon.engineering.elasticity.substep import BARE_BARS, CRACKS, Term


class ReferenceTerm:
    """Forces of c connections across q gaps, as a term of the core has them before it is solved."""

    def __init__(self, term: Term, substep_s: float):
        self.rows, self.kind, self.substep_s = term.rows, term.kind, substep_s
        self.arrays = arrays = {name: array.copy() for name, array in term.arrays.items()}
        self.held_sideways = bool(term.held_sideways)
        if self.kind == CRACKS:
            bars = Bars(arrays["yields"], arrays["stiffness"], arrays["modulus"])
            named = (arrays[name] for name in ("slips", "flows", "normals", "directions", "pressed", "rests", "grips"))
            self._law = CrackLaw(bars, *named)
        elif self.kind != BARE_BARS:
            named = ("vertical", "sideways", "capacity", "friction", "pulls", "pressed_by")
            self._law = ReferenceSprings(*(arrays[name] for name in named))

    def linear(self, moved: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the forces (3, q) that pull the sides of gaps together, opened by `moved` (3, q), and tangents."""
        arrays = self.arrays
        if self.kind == CRACKS:
            return self._law.linear(arrays["widths"] + moved)
        if self.kind != BARE_BARS:
            upwards, tangents = self._law.resisted(arrays["widths"] + moved)
            return -upwards, tangents
        directions, holds = arrays["directions"], arrays["holds"]
        along = dot_products(directions, moved)
        trial = arrays["stiffness"] * (arrays["lengths"] - arrays["bared"] + along - arrays["stays"])
        force = holds * np.clip(trial, -arrays["pressed_limits"], arrays["pulled_limits"])
        elastic = holds & (force < arrays["pulled_limits"]) & (force > -arrays["pressed_limits"])
        tangents = np.where(elastic, arrays["stiffness"], 0.0) * (directions[:, None] * directions)
        forces = force * directions
        if self.held_sideways:
            across = np.eye(3)[..., None] - directions[:, None] * directions
            beside = holds * arrays["stiffness"] * across
            forces = forces + np.einsum("ijq,jq->iq", beside, arrays["widths"] - arrays["bared_lines"] + moved)
            tangents = tangents + beside
        return forces, tangents

    def levers(self, bodies: int) -> np.ndarray:
        """Return the matrices (q, 3, 6 n) by which gaps open with the velocities of bodies, one body after another."""
        arrays, count = self.arrays, len(self.arrays["of_gap"])
        found = np.zeros((count, 3, bodies, 6))
        for sign, ends, arms in ((-1.0, "first", "first_arms"), (1.0, "second", "second_arms")):
            for gap in range(count):
                body, arm = arrays[ends][gap], arrays[arms][:, gap]
                found[gap, :, body, :3] += sign * np.eye(3)
                found[gap, :, body, 3:] += sign * np.cross(np.eye(3), arm).T
        return found.reshape(count, 3, 6 * bodies)

    def on_ends(self, pulls: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return what pulls (3, q) of gaps do to the first and second bodies of connections, (6, c) each."""
        arrays, count = self.arrays, len(self.rows)
        ends = np.zeros((2, 6, count))
        for gap, of in enumerate(arrays["of_gap"]):
            turned = "above_first" in arrays and arrays["above_first"][of]
            for number, sign, arms in ((0, 1.0, "first_arms"), (1, -1.0, "second_arms")):
                pull = sign * pulls[:, gap]
                load = np.concatenate((pull, cross_products(arrays[arms][:, gap], pull)))
                ends[1 - number if turned else number, :, of] += load
        return ends[0], ends[1]
