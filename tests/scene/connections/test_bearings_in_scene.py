# SPDX-License-Identifier: GPL-3.0-or-later
"""Bearings are kept with the connections at their pads: they come back as they were, and edits by hand are refused."""

from dataclasses import fields

import numpy as np
import pytest
from support.bearing_decks import PINNED_AND_ROCKERS, deck_text

from bridge_demolition_addon.errors import DemolitionError
from bridge_demolition_addon.model.scenario.file import scenario_from_text
from bridge_demolition_addon.model.sequence.checked_model import checked_model

SLIDING = ("pier 1", 'kind = "sliding"\nfriction = 0.05\ntension = true\nbreaking_force_n = 1e6\npads = 2')


def built(blender, text):
    """The model of a scenario, and its connections in an empty scene."""
    from bridge_demolition_addon.scene.connections.constraints import connections_of
    from bridge_demolition_addon.scene.demolition import build_demolition

    scenario = scenario_from_text(text)
    model = checked_model(scenario)
    scene = blender.context.scene
    build_demolition(scene, scenario, model)
    scene.view_layers[0].update()
    return model, connections_of(scene)


def test_bearings_come_back_as_they_were(blender):
    from bridge_demolition_addon.scene.connections.elasticity import bearings_of

    model, connections = built(blender, deck_text((SLIDING, PINNED_AND_ROCKERS[1]), spans=(10.0,), shards=12))
    found, kept = bearings_of(connections), model.bearings
    assert found.names == kept.names
    for item in fields(kept.springs):
        assert np.array_equal(getattr(found.springs, item.name), getattr(kept.springs, item.name)), item.name


def test_bearings_of_rigid_connections_have_names_and_no_springs(blender):
    from bridge_demolition_addon.scene.connections.elasticity import bearings_of

    text = deck_text(spans=(10.0,), shards=12, stiffness="rigid").replace("elastic_modulus_n_mm2 = 30000\n", "")
    model, connections = built(blender, text)
    assert bearings_of(connections) is None
    named = [connections[row]["bda_bearing"] for row in model.bearings.springs.rows.tolist()]
    assert set(named) == {"deck on pier 1", "deck on pier 2"}


@pytest.mark.parametrize(
    "wrong", ["", "nonsense", -1, [], [1.0], {"a": 1}, [0.1, 0.0, 0.2, 1e6, 0.0, 0.0, 1.0, -1.0, 1.0, 1.0]]
)
def test_edits_by_hand_are_refused(blender, wrong):
    from bridge_demolition_addon.scene.connections.elasticity import bearings_of

    model, connections = built(blender, deck_text(spans=(10.0,), shards=12))
    connections[model.bearings.springs.rows[0]]["bda_pads"] = wrong
    with pytest.raises(DemolitionError, match="bda_pads"):
        bearings_of(connections)
