# SPDX-License-Identifier: GPL-3.0-or-later
"""Snapshots of the core are those of numpy."""

import numpy as np
from reference import bullet_fields as reference
from support.blocks import Blocks

from bridge_demolition_addon.bullet.constraints import ConstraintTable
from bridge_demolition_addon.bullet.layout import platform_layout
from bridge_demolition_addon.bullet.snapshots import SnapshotTaker

WEAK_N = 1.0


def test_bodies_and_connections_are_copied_as_by_numpy(blender, tmp_path, monkeypatch):
    blocks, taken, seen, tables = Blocks(), [], [], []
    ground = blocks.block((0, 0, -0.5))
    upper = [blocks.block((0, 0, 1.5), 100.0), blocks.block((2, 0, 1.5), 50.0)]
    blocks.connect("FIXED", (0, 0, 0.5), ground, upper[0], WEAK_N)
    blocks.connect("FIXED", (1, 0, 1.5), *upper)
    blocks.connect("POINT", (0, 0, 0.5), ground, upper[1]).rigid_body_constraint.enabled = False
    made, of_core, intact_of_core = SnapshotTaker.__init__, SnapshotTaker.with_contacts, ConstraintTable.intact

    def note(taker, *parts):
        tables[:] = parts
        made(taker, *parts)

    def both_ways(taker, snapshot):
        (bodies, table, sides), layout = tables, platform_layout()
        found = of_core(taker, snapshot)
        state = np.vstack(
            (reference.components(layout, bodies.addresses), bodies.can_move() * found.body_components[18])
        )
        loads, impulses, intact = reference.connections(layout, table.addresses, table.cracked, table.feedback, sides)
        for one, other in (
            (found.body_components, state),
            (found.load_components, loads),
            (found.applied_impulses, impulses),
            (found.intact, intact),
        ):
            np.testing.assert_array_equal(one, other)
        at_once = taker.take()
        np.testing.assert_array_equal(at_once.body_components, found.body_components)
        np.testing.assert_array_equal(at_once.load_components, found.load_components)
        taken.append(found.intact.tolist())
        return found

    def intact_both_ways(table):
        found = intact_of_core(table)
        *_, expected = reference.connections(
            platform_layout(), table.addresses, table.cracked, table.feedback, np.zeros(0, int)
        )
        assert found.tolist() == expected.tolist()
        seen.append(found.tolist())
        return found

    monkeypatch.setattr(SnapshotTaker, "__init__", note)
    monkeypatch.setattr(SnapshotTaker, "with_contacts", both_ways)
    monkeypatch.setattr(ConstraintTable, "intact", intact_both_ways)
    blocks.play(tmp_path, 6)
    assert seen[0] == [True, True, False] and seen[-1] == taken[-1]
    assert taken[0][1] and not taken[-1][0] and taken[-1][1]
