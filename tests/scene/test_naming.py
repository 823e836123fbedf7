# SPDX-License-Identifier: GPL-3.0-or-later
"""Names of objects that are made by the thousand."""

import pytest


@pytest.fixture
def naming(blender):

    from bridge_demolition_addon.scene import collections

    return collections


def make(blender, naming, names):
    return naming.make_named(blender.data.objects, names, lambda name, _: blender.data.objects.new(name, None))


@pytest.mark.parametrize("count", (0, 1, 511, 512, 513, 1500))
def test_names_are_those_asked_for_in_their_order(blender, naming, count):
    names = naming.numbered_names("Shard", count, blender.data.objects)
    assert names == [f"Shard {number:06d}" for number in range(count)]
    assert [item.name for item in make(blender, naming, names)] == names
    assert sorted(blender.data.objects.keys()) == names


def test_numbers_go_on_behind_those_that_are_taken(blender, naming):
    for name in ("Shard 000007", "Shard 41.002", "Shard", "Shard connection 000900", "A Shard 000800"):
        blender.data.objects.new(name, None)
    blender.data.meshes.new("Shard 000050")
    assert naming.numbered_names("Shard", 1, blender.data.objects) == ["Shard 000042"]
    assert naming.numbered_names("Shard", 2, blender.data.objects, blender.data.meshes)[0] == "Shard 000051"
