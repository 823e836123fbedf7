"""Names of objects that are made by the thousand."""

import time

import pytest


@pytest.fixture
def naming(blender):
    from bridge_demolition_addon.scene import naming

    return naming


def make(blender, naming, names):
    return naming.make_named(blender.data.objects, names, lambda name, _: blender.data.objects.new(name, None))


@pytest.mark.parametrize("count", (0, 1, 511, 512, 513, 1500))
def test_names_are_those_asked_for_in_their_order(blender, naming, count):
    names = naming.numbered_names("Shard", count, blender.data.objects)
    assert names == [f"Shard {number:06d}" for number in range(count)]
    assert [each.name for each in make(blender, naming, names)] == names
    assert sorted(blender.data.objects.keys()) == names


def test_numbers_go_on_behind_those_that_are_taken(blender, naming):
    for name in ("Shard 000007", "Shard 41.002", "Shard", "Shard connection 000900", "A Shard 000800"):
        blender.data.objects.new(name, None)
    blender.data.meshes.new("Shard 000050")
    assert naming.numbered_names("Shard", 1, blender.data.objects) == ["Shard 000042"]
    assert naming.numbered_names("Shard", 2, blender.data.objects, blender.data.meshes)[0] == "Shard 000051"


@pytest.mark.parametrize("behind", (0, 30, 600))
def test_each_takes_less_time_than_in_order(blender, naming, behind):
    """Made in order, each name is compared with 512 others, which takes five times as long as all the rest."""
    for number in range(behind):
        blender.data.objects.new(f"Wrecking ball {number:06d}", None)

    def seconds(way, prefix):
        names = naming.numbered_names(prefix, 4000, blender.data.objects)
        began = time.perf_counter()
        way(names)
        return time.perf_counter() - began

    ours = seconds(lambda names: make(blender, naming, names), "Shard")
    in_order = seconds(lambda names: [blender.data.objects.new(name, None) for name in names], "Tie")
    assert ours < 0.7 * in_order
