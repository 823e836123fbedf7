# SPDX-License-Identifier: GPL-3.0-or-later
"""What Blender data keeps in custom properties can be edited by hand: what reads it then says so in a sentence."""

import pytest
from support.checkout import SMALL, TESTS

from bridge_demolition_addon.errors import DemolitionError
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.sequence.checked_model import checked_model

EVERYTHING = TESTS / "simulation" / "everything.toml"
WRONG = ("", "nonsense", -1, 1e300, [], [1.0], {"a": 1}, "{}", "[[1]]", "5")


def read_all(scene):
    """Read all that a recording reads of a scene when it begins."""
    from bridge_demolition_addon.scene.blast.charges import blast_of, charges_of
    from bridge_demolition_addon.scene.blast.force_fields import force_objects
    from bridge_demolition_addon.scene.bodies import bodies_of
    from bridge_demolition_addon.scene.connections.breaking_settings import breaking_of, rewrite_thresholds
    from bridge_demolition_addon.scene.connections.constraints import connections_of
    from bridge_demolition_addon.scene.run_setup import run_setup_of
    from bridge_demolition_addon.scene.tools.ball import lifts_of

    bodies, connections = bodies_of(scene), connections_of(scene)
    charges_of(scene)
    force_objects(scene)
    blast_of(scene)
    breaking_of(scene, connections)
    rewrite_thresholds(scene)
    _ = run_setup_of(scene).events
    for body in bodies:
        lifts_of(body)


@pytest.mark.parametrize("file", [SMALL, EVERYTHING], ids=["ball", "strength"])
def test_every_property_may_be_edited(blender, file):
    from bridge_demolition_addon.scene.connections.breaking_settings import set_strength
    from bridge_demolition_addon.scene.demolition import build_demolition

    scenario, scene, refused = read_scenario(file), blender.context.scene, 0
    build_demolition(scene, scenario, checked_model(scenario))
    connection = next(obj for obj in blender.data.objects if obj.rigid_body_constraint)
    set_strength(connection, None)
    shard = next(obj for obj in blender.data.objects if obj.rigid_body)
    shard["bda_lifts"] = "[[3, [0.0, 1.0], [0.0, 0.0, 1.0]]]"
    scene.view_layers[0].update()
    read_all(scene)
    for holder in (scene, shard, connection, *(obj for obj in blender.data.objects if "bda_mass_kg" in obj)):
        for name in [name for name in holder.keys() if name.startswith("bda_")]:  # noqa: SIM118
            before = holder[name].to_list() if hasattr(holder[name], "to_list") else holder[name]
            for wrong in WRONG:
                holder[name] = wrong
                try:
                    read_all(scene)
                except DemolitionError:
                    refused += 1
            holder[name] = before
    assert refused > 50
