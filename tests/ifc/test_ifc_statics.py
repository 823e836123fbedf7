# SPDX-License-Identifier: GPL-3.0-or-later
"""What bearings of an imported bridge bear, against statics."""

import numpy as np
import pytest
from support.ifc_bridges import DECK_KG_M3, STEEL_KG_M3, VOLUMES_M3, whole_bridge

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.ifc.bridge import read_bridge
from bridge_demolition_addon.ifc.folder import write_bridge
from bridge_demolition_addon.ifc.settings import ImportSettings
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.stages.standing import made_elastic
from bridge_demolition_addon.model.structure.equilibrium import model_at_rest

UPPER_KG = VOLUMES_M3["girder"] * STEEL_KG_M3 + VOLUMES_M3["deck"] * DECK_KG_M3


@pytest.fixture(scope="module")
def bearings(tmp_path_factory):
    """Places (6, 3) in m, and forces and moments (6, 6) in N and N·m, of the six bearings at rest."""
    folder = tmp_path_factory.mktemp("ifc")
    path = whole_bridge().written(folder / "bridge.ifc")
    write_bridge(read_bridge(path, ImportSettings(shards=40)), folder / "bridge")
    scenario = made_elastic(read_scenario(folder / "bridge" / "scenario.toml"))
    model = checked_model(scenario)
    rest = model_at_rest(model, scenario.joints)
    assert (rest.held[: len(model.shards)] | model.fixed).all()
    rows = model.bearings.springs.rows
    return model.connections.points[rows], rest.loads[:, rows].T


def test_each_bearing_is_one_connection_where_it_lies(bearings):
    positions, _ = bearings
    expected = [(0.5 + along, across, 3.6) for along in (0.0, 10.0, 20.0) for across in (-1.0, 1.0)]
    order = np.lexsort(positions.round(6).T[::-1])
    assert positions[order] == pytest.approx(np.array(expected), abs=1e-6)


def test_bearings_bear_all_that_lies_on_them(bearings):
    _, loads = bearings
    assert abs(loads[:, 2].sum()) == pytest.approx(UPPER_KG * STANDARD_GRAVITY_M_S2, rel=1e-6)
    assert len(set(np.sign(loads[:, 2]))) == 1


def test_the_middle_support_bears_between_simple_spans_and_a_beam_on_rigid_supports(bearings):
    """Two spans of 10 m that reach half a metre further, by the three-moment equation.

    The moment over the middle is q (10² / 8 - 0.5² / 4) = 12.44 q m², so that it bears 12.46 q of 21 q; of two simple
    spans it bears 10 q. Random shards, a cap and a column that give way bring it in between.
    """
    positions, loads = bearings
    middle = abs(positions[:, 0] - 10.5) < 0.1
    share = loads[middle, 2].sum() / loads[:, 2].sum()
    assert 10.0 / 21.0 < share < 12.46 / 21.0


def test_what_is_free_bears_nothing(bearings):
    """Rollers, on the abutments: no force along the road. All: no moment about the axis across it, by that at 10 m."""
    positions, loads = bearings
    heaviest = abs(loads[:, 2]).max()
    assert abs(loads[abs(positions[:, 0] - 10.5) > 1.0, 0]).max() < 1e-6 * heaviest
    assert abs(loads[:, 4]).max() < 1e-6 * heaviest * 10.0
