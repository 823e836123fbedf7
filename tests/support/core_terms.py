# SPDX-License-Identifier: GPL-3.0-or-later
"""Laws of the compiled core, tried at some gaps."""

import numpy as np

from bridge_demolition_addon.engineering.core.calls import call
from bridge_demolition_addon.engineering.elasticity.substep import BARE_BARS, CRACKS, SPRINGS, Term


def forces_and_tangents(term, moved):
    """Return forces (d, q) of a term whose gaps have opened further, by (d, q), and tangents (3, 3, q)."""
    moved = np.ascontiguousarray(moved, float)
    forces = np.empty_like(moved)
    call("bda_try_term", term, moved, forces)
    return forces, term.arrays["tangents"]


def term_in_substep(law, chosen, *places):
    """Return what some of a law (c,) do as a sub-step begins with bodies in certain places."""
    term = law.term(chosen)
    term.begin(*places)
    return term


def term_of_law(kind, law, gaps_m, of_gap=None, above_first=None):
    """Return a term with these gaps (3, q) and a law, all of whose gaps are between two bodies."""
    count = gaps_m.shape[1]
    of_gap = np.arange(count) if of_gap is None else of_gap
    rows, none = np.arange(int(of_gap.max()) + 1), np.zeros((3, count))
    settings = {"dowel": law.pop("dowel"), "sheared": law.pop("sheared")} if kind == CRACKS else {}
    if kind == SPRINGS:
        law = law | {"above_first": np.ones(len(rows), bool) if above_first is None else above_first}
    if kind == BARE_BARS:
        settings = {"held_sideways": 0}
    ends = np.zeros(count, int), np.ones(count, int)
    remembered = np.full((12, count), np.nan)
    return Term.of(kind, rows, rows, of_gap, np.arange(count), remembered, ends, (none, none), gaps_m, law, **settings)
