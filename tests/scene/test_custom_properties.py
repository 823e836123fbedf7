# SPDX-License-Identifier: GPL-3.0-or-later
"""What Blender data keeps in custom properties can be edited by hand: what reads it then says so in a sentence."""

import numpy as np
import pytest
from support.bearing_decks import deck_text
from support.checkout import SMALL, TESTS
from support.long_cases import long_but

from bridge_demolition_addon.errors import DemolitionError, SimulationError
from bridge_demolition_addon.model.scenario.file import scenario_from_text
from bridge_demolition_addon.model.sequence.checked_model import checked_model

EVERYTHING = TESTS / "simulation" / "everything.toml"
WRONG = (
    "",
    "nonsense",
    -1,
    5,
    1e300,
    float("nan"),
    [],
    [1.0],
    {"a": 1},
    {"1": 1},
    ["a"],
    "{}",
    "[[1]]",
    "5",
    '{"a": 1}',
)


ON_PAIRS_OF_COLUMNS = """
[scenario]
title = "Two spans on pairs of columns"
seed = 1

[time]
duration_s = 1.0

[bridge]
density_kg_m3 = 2500
span_lengths_m = [12.0, 12.0]

[bridge.deck]
width_m = 5.5
thickness_m = 0.65

[bridge.piers]
columns = 2
column_length_m = 0.7
column_width_m = 0.7
height_m = 4.8

[fracture]
shards = 20

[connections]
type = "FIXED"
method = "face"
material = "reinforced concrete slab"
"""


def read_all(scene):
    """Read all that a recording reads of a scene when it begins."""
    from bridge_demolition_addon.scene.as_built import changed_bodies, manual_edits
    from bridge_demolition_addon.scene.blast.charges import blast_of, charges_of
    from bridge_demolition_addon.scene.blast.force_fields import force_objects
    from bridge_demolition_addon.scene.bodies import bodies_of, terrain_facts
    from bridge_demolition_addon.scene.connections.constraints import breaking_of, connections_of, rewrite_thresholds
    from bridge_demolition_addon.scene.rendering.surroundings import points_in_view
    from bridge_demolition_addon.scene.run_setup import run_setup_of
    from bridge_demolition_addon.scene.tools.ball import lifts_of

    bodies, connections = bodies_of(scene), connections_of(scene)
    points_in_view(scene)
    terrain_facts(scene)
    changed_bodies(scene)
    charges_of(scene)
    force_objects(scene)
    blast_of(scene)
    breaking_of(scene, connections)
    rewrite_thresholds(scene)
    setup = run_setup_of(scene)
    _ = setup.events
    manual_edits(scene, setup)
    for body in bodies:
        lifts_of(body)


ON_SOIL = deck_text(
    spans=(10.0,),
    shards=6,
    are_held=False,
    more="""
[[foundations]]
member = "pier"
soil = "medium dense sand"
footing_m = [2.0, 4.0]

[ground_motion]
directions = ["along"]

[ground_motion.spectrum]
acceleration_m_s2 = 1.0
ground_type = "C"
""",
)
SCENARIOS = {
    "ball": SMALL.read_text(encoding="utf-8"),
    "strength": EVERYTHING.read_text(encoding="utf-8"),
    "soil": ON_SOIL,
}
OWN_KEYS = ("bda_mass_kg", "bda_explosive", "bda_delay_s", "bda_burst")
"""Properties of charges, whose messages name the key of the scenario."""


@pytest.mark.parametrize("name", long_but(["ball"], SCENARIOS))
def test_every_property_may_be_edited(blender, name):
    from bridge_demolition_addon.scene.connections.constraints import set_strength
    from bridge_demolition_addon.scene.demolition import build_demolition

    scenario, scene, refused = scenario_from_text(SCENARIOS[name]), blender.context.scene, 0
    build_demolition(scene, scenario, checked_model(scenario))
    connection = next(obj for obj in blender.data.objects if obj.rigid_body_constraint)
    set_strength(connection, None)
    shard = next(obj for obj in blender.data.objects if obj.rigid_body)
    shard["bda_lifts"] = "[[3, [0.0, 1.0], [0.0, 0.0, 1.0]]]"
    scene.view_layers[0].update()
    read_all(scene)
    others = [
        next((obj for obj in blender.data.objects if name in obj), None)
        for name in ("bda_mass_kg", "bda_soil", "bda_pads")
    ]
    for holder in filter(None, (scene, shard, connection, *others)):
        for name in [name for name in holder.keys() if name.startswith("bda_")]:  # noqa: SIM118
            before = holder[name].to_list() if hasattr(holder[name], "to_list") else holder[name]
            for wrong in WRONG:
                holder[name] = wrong
                try:
                    read_all(scene)
                except DemolitionError as error:
                    refused += 1
                    assert holder.name in str(error)
                    assert name in str(error) or name in OWN_KEYS
            holder[name] = before
    assert refused > 50


def test_soil_that_was_edited_is_named_with_its_object(blender):
    from bridge_demolition_addon.scene.connections.constraints import connections_of
    from bridge_demolition_addon.scene.connections.elasticity import soil_of
    from bridge_demolition_addon.scene.demolition import build_demolition

    scenario, scene = scenario_from_text(ON_SOIL), blender.context.scene
    build_demolition(scene, scenario, checked_model(scenario))
    scene.view_layers[0].update()
    connection = next(obj for obj in connections_of(scene) if "bda_soil" in obj)
    for wrong in (5, 0.5, "nonsense", "1234", [1.0, 2.0, 3.0], [float("nan")] * 8, {"a": 1}):
        connection["bda_soil"] = wrong
        with pytest.raises(
            SimulationError, match=f"{connection.name}: its custom property bda_soil was edited: expected"
        ):
            soil_of(connections_of(scene))


def test_a_slab_on_columns_runs_though_a_stiffness_of_its_lattice_is_less_than_nothing_by_rounding(blender):
    """Shear within the slab is 0 at some of its faces; turned, one of them had -5e-7 N/m beside 2.5e10 N/m."""
    from bridge_demolition_addon.scene.connections.constraints import connections_of
    from bridge_demolition_addon.scene.connections.elasticity import elasticity_of
    from bridge_demolition_addon.scene.demolition import build_demolition

    scenario, scene = scenario_from_text(ON_PAIRS_OF_COLUMNS), blender.context.scene
    model = checked_model(scenario)
    build_demolition(scene, scenario, model)
    scene.view_layers[0].update()
    connections = connections_of(scene)
    diagonals = np.diagonal(elasticity_of(scene, connections).stiffness.matrices, axis1=1, axis2=2)
    row = int(diagonals.min(axis=1).argmin())
    assert 0.0 > diagonals[row].min() > -1e-12 * diagonals[row].max()
    numbers = connections[row]["bda_stiffness"].to_list()
    numbers[0] = -1e-9 * diagonals[row].max()  # the first on the diagonal
    connections[row]["bda_stiffness"] = numbers
    with pytest.raises(SimulationError, match="bda_stiffness was edited: expected"):
        elasticity_of(scene, connections)
