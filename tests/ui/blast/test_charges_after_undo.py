# SPDX-License-Identifier: GPL-3.0-or-later
"""Where charges are after undo, which takes away what Blender has worked out of places."""

import pytest

from bridge_demolition_addon.scene.blast.charges import charge_collection, charge_objects, charges_of

PLACES = [(0.0, 0.0, 1.0), (13.0, 0.0, 1.0), (6.5, 0.0, 3.5)]
"""Of the charges in the preset."""


@pytest.fixture
def built(extension, settings):
    extension.ops.bda.load_preset(preset="span_of_2019_explosives")
    settings.scenario.fracture.shards = 20
    extension.ops.bda.build_scenario()
    return extension


@pytest.mark.parametrize("hidden", [False, True])
def test_charges_are_where_they_were(built, hidden):
    """Blender works the places out again only of what it shows, and only when it draws again."""
    built.context.view_layer.layer_collection.children[
        charge_collection(built.context.scene).name
    ].hide_viewport = hidden
    built.ops.ed.undo_push(message="before")
    built.context.scene.bda.scenario.seed = 5
    built.ops.ed.undo_push(message="after")
    built.ops.ed.undo()
    assert built.context.scene.bda.scenario.seed == 0
    assert [charge.position_m for charge in charges_of(built.context.scene)] == PLACES


def test_a_charge_that_was_moved_just_now_is_where_it_was_moved_to(built):
    charge_objects(built.context.scene)[2].location.x = 3.0
    assert charges_of(built.context.scene)[2].position_m == (3.0, 0.0, 3.5)


def test_a_charge_that_hangs_on_something_moves_with_it(built):
    scene = built.context.scene
    holder = built.data.objects.new("Holder", None)
    scene.collection.objects.link(holder)
    charge_objects(scene)[2].parent = holder
    holder.location.y = 2.0
    built.context.view_layer.update()
    assert charges_of(scene)[2].position_m == (6.5, 2.0, 3.5)
