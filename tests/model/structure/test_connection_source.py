# SPDX-License-Identifier: GPL-3.0-or-later
"""What connects shards: each connection is of one source, which is asked for all that it knows of its own."""

import numpy as np
import pytest
from support.checkout import EXAMPLES

from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.structure.model import build_model


@pytest.mark.parametrize(
    ("example", "sources"),
    [
        ("steel/composite_span_dropped.toml", {"faces", "steel", "supports", "decks"}),
        ("overbridge/bridge.toml", {"faces", "pads"}),
    ],
)
def test_each_connection_is_of_its_source(example, sources):
    scenario = read_scenario(EXAMPLES / example)
    model, joints = build_model(scenario), list(scenario.named_joints)
    of, kinds = model.origins, np.array([joints[joint].kind for joint in model.joint_of_connection])
    assert set(of) == sources
    kind_of = {"faces": "rule", "steel": "steel", "supports": "steel", "decks": "deck", "pads": "bearing"}
    assert kinds.tolist() == [kind_of[origin] for origin in of.tolist()]
    if model.steel:
        assert np.flatnonzero(np.isin(of, ["steel", "supports"])).tolist() == model.steel.rows.tolist()
        assert np.flatnonzero(of == "decks").tolist() == model.decks.rows.tolist()
    else:
        assert np.flatnonzero(of == "pads").tolist() == model.bearings.springs.rows.tolist()
