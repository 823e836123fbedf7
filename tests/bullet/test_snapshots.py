# SPDX-License-Identifier: GPL-3.0-or-later
"""Snapshots read connections by a compiled loop as by numpy."""

from dataclasses import fields

import numpy as np
from support.blocks import Blocks

from bridge_demolition_addon.bullet import constraints, snapshots
from bridge_demolition_addon.bullet.constraints import ConstraintTable
from bridge_demolition_addon.bullet.snapshots import SnapshotTaker

WEAK_N = 1.0


def test_connections_are_copied_by_the_compiled_loop_as_by_numpy(blender, tmp_path, monkeypatch):
    blocks, taken, seen = Blocks(), [], []
    ground = blocks.block((0, 0, -0.5))
    upper = [blocks.block((0, 0, 1.5), 100.0), blocks.block((2, 0, 1.5), 50.0)]
    blocks.connect("FIXED", (0, 0, 0.5), ground, upper[0], WEAK_N)
    blocks.connect("FIXED", (1, 0, 1.5), *upper)
    blocks.connect("POINT", (0, 0, 0.5), ground, upper[1]).rigid_body_constraint.enabled = False
    quick, quickly_intact = SnapshotTaker.take, ConstraintTable.intact

    def both_ways(taker, **options):
        found = quick(taker, **options)
        with monkeypatch.context() as without_numba:
            without_numba.setattr(snapshots, "field_loops", lambda: None)
            plain = quick(taker, **options)
        for item in fields(found):
            one, other = getattr(found, item.name), getattr(plain, item.name)
            if isinstance(one, np.ndarray):
                np.testing.assert_array_equal(one, other, err_msg=item.name)
                assert one.dtype == other.dtype
        taken.append(found.intact.tolist())
        return found

    def intact_both_ways(table):
        found = quickly_intact(table)
        with monkeypatch.context() as without_numba:
            without_numba.setattr(constraints, "field_loops", lambda: None)
            assert found.tolist() == quickly_intact(table).tolist()
        seen.append(found.tolist())
        return found

    monkeypatch.setattr(SnapshotTaker, "take", both_ways)
    monkeypatch.setattr(ConstraintTable, "intact", intact_both_ways)
    blocks.play(tmp_path, 6)
    assert seen[0] == [True, True, False] and seen[-1] == taken[-1]
    assert taken[0][1] and not taken[-1][0] and taken[-1][1]
