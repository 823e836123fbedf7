# SPDX-License-Identifier: GPL-3.0-or-later
"""*Import IFC*: from the file to a bridge that is built and stands."""

import json
import sys

import pytest
from support.ifc_bridges import MASS_KG, whole_bridge

from bridge_demolition_addon.ifc.settings import ImportSettings
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.ui.scenario.prop import default_scenario
from bridge_demolition_addon.ui.scenario.values import scenario_of

_SINGLE = 1e-6
"""Blender keeps masses in single precision, which holds seven digits."""


@pytest.mark.long
def test_an_imported_bridge_is_shown_built_and_stands(extension, settings, tmp_path):
    """No connection breaks and nothing moves: footings are held, and 277 t are within what the members bear."""
    from bridge_demolition_addon.scene.bodies import Kind, bodies_of, kind_of

    path = whole_bridge().written(tmp_path / "two_spans.ifc")
    assert extension.ops.bda.import_ifc(filepath=str(path), shards=20) == {"FINISHED"}
    folder = tmp_path / "two_spans_scenario"
    assert settings.scenario_path == str(folder / "scenario.toml")
    assert scenario_of(settings) == read_scenario(folder / "scenario.toml")
    settings.scenario.shards.start_deactivated = False
    assert extension.ops.bda.build_scenario() == {"FINISHED"}
    scene = extension.context.scene
    shards = [body for body in bodies_of(scene) if kind_of(body) == Kind.SHARD]
    assert sum(shard.rigid_body.mass for shard in shards) == pytest.approx(MASS_KG, rel=_SINGLE)
    start = {shard.name: shard.matrix_world.translation.copy() for shard in shards}
    for frame in range(1, 7):
        scene.frame_set(frame)
    moved = [(shard.matrix_world.translation - start[shard.name]).length for shard in shards]
    assert max(moved) < 0.01  # 5 frames of free fall are 0.21 m


@pytest.mark.long
def test_what_is_left_out_is_shown_as_wire(extension, tmp_path):
    """A block of 1 m³ that touches nothing, 4 m over the deck; it takes no part in the simulation."""
    made = whole_bridge()
    made.box("IfcBeam", "Stray", (1, 1, 1), (10.0, 0.0, 8.0), "DECK", material=made.material("Steel"))
    path = made.written(tmp_path / "stray.ifc")
    settings = json.dumps(ImportSettings(shards=20, kinds=(("Stray", "bracing"),)).as_json())
    for _ in range(2):  # the second import takes the place of the first
        assert extension.ops.bda.import_ifc_file(path=str(path), settings=settings) == {"FINISHED"}
    wires = [found for found in extension.context.scene.objects if found.display_type == "WIRE"]
    assert [wire.name.split(".")[0] for wire in wires] == ["Stray"]
    (wire,) = wires
    heights = [vertex.co.z for vertex in wire.data.vertices]
    assert (min(heights), max(heights)) == pytest.approx((8.0, 9.0))
    assert wire.hide_render and wire.rigid_body is None
    assert extension.ops.bda.build_scenario() == {"FINISHED"}


@pytest.mark.long
def test_importing_again_takes_another_folder(extension, settings, tmp_path):
    path = whole_bridge().written(tmp_path / "bridge.ifc")
    for folder in ("bridge_scenario", "bridge_scenario_2"):
        extension.ops.bda.import_ifc(filepath=str(path), kinds="IfcWall=pier", without="IfcTendon; Deck*;Carriageway")
        assert settings.scenario_path == str(tmp_path / folder / "scenario.toml")


@pytest.mark.parametrize(
    "choices, message",
    [
        ({"filepath": ""}, "no IFC file was given"),
        ({"filepath": "//bridge.ifc"}, "save it or give a full path"),
        ({"kinds": "deck"}, 'kinds has "deck": expected NAME=KIND'),
        ({"kinds": "IfcWall=dock"}, 'kind of "IfcWall" is "dock"'),
        pytest.param({"material": "marzipan"}, "the table of materials does not know", marks=pytest.mark.long),
        ({"own_ground": True, "ground_m": 50.0}, "would cover the bridge"),
    ],
)
def test_what_cannot_be_imported_changes_nothing(choices, message, extension, settings, tmp_path):
    path = whole_bridge(has_materials=False).written(tmp_path / "bridge.ifc")
    with pytest.raises(RuntimeError, match=message):
        extension.ops.bda.import_ifc(**{"filepath": str(path), **choices})
    assert scenario_of(settings) == default_scenario()
    assert [file.name for file in tmp_path.iterdir()] == ["bridge.ifc"]


def test_the_button_is_greyed_with_the_reason_where_nothing_reads_ifc(extension, monkeypatch):
    """Without the folder that IfcOpenShell is in: as where neither the extra nor Bonsai is installed."""
    import ifcopenshell

    from bridge_demolition_addon.errors import MissingLibraryError
    from bridge_demolition_addon.ifc.library import library

    assert extension.ops.bda.import_ifc.poll()
    home = ifcopenshell.__path__[0].rpartition("ifcopenshell")[0].rstrip("/\\")
    monkeypatch.setattr(sys, "path", [folder for folder in sys.path if folder.rstrip("/\\") != home])
    monkeypatch.delitem(sys.modules, "ifcopenshell")
    assert not extension.ops.bda.import_ifc.poll()
    with pytest.raises(RuntimeError, match=r"IFC is read by IfcOpenShell: install it with pip install .*\[ifc\]"):
        extension.ops.bda.import_ifc(filepath="bridge.ifc")
    with pytest.raises(MissingLibraryError, match="Blender has it where its extension Bonsai is installed"):
        library()


def test_elements_are_listed_corrected_and_imported(extension, settings, tmp_path):
    """A column that is taken for an abutment of masonry, and girders that are left out."""
    path = whole_bridge().written(tmp_path / "two_spans.ifc")
    assert not extension.ops.bda.import_ifc_elements.poll()
    assert extension.ops.bda.look_into_ifc(filepath=str(path)) == {"FINISHED"}
    rows = {row.title: row for row in settings.ifc_elements}
    assert len(settings.ifc_elements) == len(rows) == 21
    assert (rows["Column"].kind, rows["Column"].material) == ("pier", "C30/37")
    assert (rows["Railing"].kind, rows["Railing"].why) == ("left out", "it carries nothing")
    rows["Column"].kind, rows["Column"].material = "abutment", "masonry"
    rows["Girder left"].kind = "left out"
    settings.ifc_element_index = list(settings.ifc_elements).index(rows["Girder left"])
    rows["Girder right"].title = "Girder left"
    assert extension.ops.bda.ifc_alike() == {"FINISHED"}
    assert extension.ops.bda.import_ifc_elements() == {"FINISHED"}
    scenario = read_scenario(tmp_path / "two_spans_scenario" / "scenario.toml")
    column = next(table for table in scenario.geometry if table.name == "Column")
    assert (column.kind, column.density_kg_m3) == ("abutment", 2750.0)
    assert not any(table.kind == "girder" for table in scenario.geometry)
    assert scenario_of(settings) == scenario


@pytest.mark.long
def test_a_material_that_the_table_lacks_is_refused(extension, settings, tmp_path):
    extension.ops.bda.look_into_ifc(filepath=str(whole_bridge().written(tmp_path / "two_spans.ifc")))
    settings.ifc_elements[0].material = "marzipan"
    with pytest.raises(RuntimeError, match='is "marzipan", which the table of materials does not know'):
        extension.ops.bda.import_ifc_elements()
