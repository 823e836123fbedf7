# SPDX-License-Identifier: GPL-3.0-or-later
"""Bars of steel in IFC files as steelwork of a scenario: forces of a truss, nodes, supports, and what is told."""

import csv
from dataclasses import replace

import numpy as np
import pytest
from support.ifc_steel import CHS_168, HEB_200, IPE_300, SteelFile, truss_file, warren_truss
from support.steelwork import truss_forces

from bridge_demolition_addon.engineering.geometry.overlap import hulls, overlaps
from bridge_demolition_addon.engineering.steelwork.catalogue import section_named
from bridge_demolition_addon.engineering.steelwork.resistance import DENSITY_KG_M3
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.errors import IfcError
from bridge_demolition_addon.ifc.bridge import read_bridge
from bridge_demolition_addon.ifc.folder import write_bridge
from bridge_demolition_addon.ifc.settings import ImportSettings
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.structure.equilibrium import loads_of, model_at_rest
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.model.structure.steel_bars import bar_uses

CARRIED_KG = 20_000.0


def imported(made, tmp_path, **settings):
    """Return the lines of the report, the scenario as it is read again, and the folder."""
    path = made.written(tmp_path / "bridge.ifc")
    lines = write_bridge(read_bridge(path, ImportSettings(**settings)), tmp_path / "bridge")
    return lines, read_scenario(tmp_path / "bridge" / "scenario.toml"), tmp_path / "bridge"


def node_at(steelwork, place):
    """Name of the node at a place."""
    return next(node.name for node in steelwork.nodes if np.allclose(node.position_m, place, atol=1e-4))


def bar_between(steelwork, one, other):
    """Name of the bar between two nodes."""
    return next(member.name for member in steelwork.members if set(member.nodes) == {one, other})


@pytest.fixture(scope="module")
def plain_truss(tmp_path_factory):
    return imported(truss_file(), tmp_path_factory.mktemp("truss"))


def test_forces_of_a_truss_of_files_are_those_of_the_method_of_joints(plain_truss):
    """Warren truss of 8 panels, chords of one HEB 200 each, diagonals of tubes that end 0.2 m before the axes.

    20 t hang at each lower node between the supports, 150 times what a bar weighs: bars of nodes that are fixed then
    carry what pinned ones do, but for the bending that plates cause, 0.5 % of the largest force here.
    """
    lines, scenario, _ = plain_truss
    assert "  all axes meet in their nodes" in lines
    places, bars = warren_truss()
    steelwork = scenario.steelwork
    above = min(node.position_m[2] for node in steelwork.nodes)
    names = {name: node_at(steelwork, (x, 0.0, above + z)) for name, (x, z) in places.items()}
    loaded = [names[f"L{number}"] for number in range(1, 8)]
    nodes = tuple(replace(node, mass_kg=CARRIED_KG) if node.name in loaded else node for node in steelwork.nodes)
    scenario = replace(scenario, steelwork=replace(steelwork, nodes=nodes))
    model = build_model(scenario)
    uses = {use.name: use.axial_n for use in bar_uses(scenario, model, model_at_rest(model, scenario.joints))}
    weights_n = {}
    for ends in bars.values():
        section = "HEB 200" if ends[0][0] == ends[1][0] else "CHS 168.3x8"
        length = np.hypot(*np.subtract(places[ends[0]], places[ends[1]]))
        half = 0.5 * STANDARD_GRAVITY_M_S2 * DENSITY_KG_M3 * section_named(section).area_m2 * length
        for end in ends:
            weights_n[end] = weights_n.get(end, 0.0) + half
    for number in range(1, 8):
        weights_n[f"L{number}"] += STANDARD_GRAVITY_M_S2 * CARRIED_KG
    by_statics = truss_forces(
        places, bars, {name: (0.0, -weight) for name, weight in weights_n.items()}, {"L0": "xz", "L8": "z"}
    )
    largest = max(map(abs, by_statics.values()))
    found = {name: uses[bar_between(steelwork, *(names[end] for end in ends))] for name, ends in bars.items()}
    assert found == pytest.approx(by_statics, rel=0.01, abs=0.005 * largest)


def test_supports_of_a_truss_on_nothing_are_under_its_lowest_ends(plain_truss):
    lines, scenario, _ = plain_truss
    held = {
        round(node.position_m[0], 4): (node.support, node.held_by) for node in scenario.steelwork.nodes if node.support
    }
    assert held == {0.0: ("pinned", "ground"), 32.0: ("rocker", "ground")}
    assert any("nothing holds Lower chord" in line and "2 supports on the ground" in line for line in lines)


def test_a_frame_with_clipped_ends_is_joined_at_its_corners(tmp_path):
    """Portal of 6 x 4 m of HEB 200, mitred at its corners, on two footings, and an angle from a foot to a corner."""
    made = SteelFile()
    concrete = made.material("C30/37")
    for number, x in enumerate((0.0, 6.0), start=1):
        made.box("IfcFooting", f"Footing {number}", (1.0, 1.0, 0.5), (x, 0.0, 0.0), "FOUNDATION", material=concrete)
    for name, x, away in (("left", 0.0, -1.0), ("right", 6.0, 1.0)):
        cut = (x, 0.0, 4.5), (away, 0.0, 1.0)
        made.bar(f"Post {name}", HEB_200, (x, 0.0, 0.5), (x, 0.0, 4.8), kind="IfcColumn", cuts=[cut])
    cuts = [((0.0, 0.0, 4.5), (-1.0, 0.0, -1.0)), ((6.0, 0.0, 4.5), (1.0, 0.0, -1.0))]
    made.bar("Beam", HEB_200, (-0.3, 0.0, 4.5), (6.3, 0.0, 4.5), kind="IfcBeam", cuts=cuts)
    made.bar("Brace", ("L", 80.0, 80.0, 8.0), (0.3, 0.0, 0.7), (5.7, 0.0, 4.3))
    lines, scenario, _ = imported(made, tmp_path)
    steelwork = scenario.steelwork
    assert len(steelwork.members) == 4
    assert len(steelwork.nodes) == 4
    feet = [node for node in steelwork.nodes if node.support]
    assert [(node.support, node.held_by) for node in feet] == [("fixed", "Footing 1"), ("fixed", "Footing 2")]
    corners = sorted(node.position_m for node in steelwork.nodes if not node.support)
    # Plates of the feet are 2 mm clear of the footings: hulls that reach into each other are thrown apart in a run.
    # Corners are where axes meet. That of the angle runs 12 mm beside, and moves the node by its share, the square of
    # (12.3 · 0.16) / (78.1 · 0.28), or 0.1 mm.
    model = build_model(scenario)
    lowest = [member.solid.bounds[0, 2] for member in model.members if member.name in {node.name for node in feet}]
    assert min(lowest) == pytest.approx(0.502, abs=1e-4)
    assert max(lowest) < 0.6  # that of the foot from which the angle goes, too, whose plates reach lower
    assert np.array(corners)[:, 2] == pytest.approx(4.5, abs=2e-4)
    assert np.ptp(np.array(corners)[:, 0]) == pytest.approx(6.0, abs=2e-4)
    assert not any("ends free" in line for line in lines)
    assert not len(overlaps(hulls(model.shards)).pairs)
    rest = model_at_rest(model, scenario.joints)
    assert (rest.held[: len(model.shards)] | model.fixed).all()


def test_a_beam_keeps_its_roll_and_its_place(tmp_path):
    """IPE 300 turned by 30°, between two posts, 0.1 m beside their axes: it keeps its own, with eccentricities."""
    made = SteelFile()
    for number, x in enumerate((0.0, 5.0), start=1):
        made.bar(f"Post {number}", ("I", 300.0, 300.0, 11.0, 19.0), (x, 0.0, 0.0), (x, 0.0, 3.0), kind="IfcColumn")
    made.bar("Beam", IPE_300, (0.16, 0.1, 2.0), (4.84, 0.1, 2.0), kind="IfcBeam", roll_deg=30.0)
    lines, scenario, _ = imported(made, tmp_path)
    beam = next(member for member in scenario.steelwork.members if member.name == "Beam")
    assert (beam.section, beam.roll_deg) == ("IPE 300", 30.0)
    # The file has y = 0.1 m in the middle of what carries the road, which is the beam.
    assert np.array(beam.eccentricities_m) == pytest.approx(np.array([(0, 0.1, 0)] * 2, float), abs=1e-4)
    model = build_model(scenario)
    bar = next(member for member in model.members if member.name == "Beam").steel.bar
    assert bar.begin_m[1] == pytest.approx(bar.end_m[1], abs=1e-9)
    assert bar.begin_m[1] == pytest.approx(0.0, abs=1e-4)
    assert "  the axes of 1 elements run beside a node, and are joined to it by plates: Beam by 100 mm" in lines
    assert sorted(node.support for node in scenario.steelwork.nodes if node.support) == ["fixed", "fixed"]


def ladder(**options):
    """Two girders on the six bearings of `ifc_bridges`, with cross beams of half their height, under a deck."""
    made = SteelFile(schema="IFC4X3", **options).substructure().bearings()
    for side, y in (("right", -1.0), ("left", 1.0)):
        ends = (-0.5, y, 4.0), (20.5, y, 4.0)
        made.bar(f"Girder {side}", ("I", 800.0, 300.0, 12.0, 25.0), *ends, kind="IfcBeam", steel="S355")
    for number in range(6):
        x = 4.0 * number
        made.bar(f"Cross beam {number}", IPE_300, (x, -0.99, 4.25), (x, 0.99, 4.25), kind="IfcBeam", steel="S235JR")
    concrete = made.material("Concrete of the deck", 2400.0)
    made.box("IfcSlab", "Carriageway", (21.0, 4.0, 0.2), (10.0, 0.0, 4.4), "DECK", material=concrete)
    return made


@pytest.fixture(scope="module")
def on_bearings(tmp_path_factory):
    return imported(ladder(), tmp_path_factory.mktemp("ladder"), shards=40)


def test_bearings_become_supports_of_nodes_on_what_they_lie_on(on_bearings):
    _, scenario, _ = on_bearings
    held = {(node.position_m[0], node.support, node.held_by) for node in scenario.steelwork.nodes if node.support}
    assert {(round(x, 3), support, below) for x, support, below in held} == {
        (0.5, "rocker", "Abutment 1"),
        (10.5, "pinned", "Crosshead"),
        (20.5, "rocker", "Abutment 2"),
    }
    assert not scenario.bearings
    assert [table.kind for table in scenario.geometry].count("girder") == 0
    grades = {member.name: scenario.steelwork.grade_of(member) for member in scenario.steelwork.members}
    assert grades["Cross beam 3"] == "S235"
    assert grades["Girder left 2"] == "S355"


@pytest.mark.long
def test_a_deck_touches_all_bars_that_it_lies_on(on_bearings):
    """Cross beams keep their place under the deck, 0.25 m above the axes of the girders."""
    _, scenario, _ = on_bearings
    model = build_model(scenario)
    names = np.array([member.name for member in model.members])[model.member_of_shard]
    touching = {
        str(name) for pair in model.connections.pairs.tolist() if "Carriageway" in names[pair] for name in names[pair]
    }
    assert {f"Cross beam {number}" for number in range(6)} <= touching
    assert any(name.startswith("Girder left") for name in touching)
    assert any(name.startswith("Girder right") for name in touching)


def test_supports_bear_all_that_lies_on_them(on_bearings):
    """Masses by hand: the deck's 21 x 4 x 0.2 m³ of 2400 kg/m³, girders of 24 000 mm² and 21 m, cross beams beside."""
    _, scenario, _ = on_bearings
    model = build_model(scenario)
    rest = model_at_rest(model, scenario.joints)
    forces = [bearing.force_n[2] for bearing in model.bearings.forces(loads_of(model, rest))]
    girders_kg = 2 * 7850.0 * (2 * 0.3 * 0.025 + 0.75 * 0.012) * 21.0
    beams_kg = 6 * 7850.0 * section_named("IPE 300").area_m2 * 2.0
    upper_kg = 21.0 * 4.0 * 0.2 * 2400.0 + girders_kg + beams_kg
    assert sum(forces) == pytest.approx(upper_kg * STANDARD_GRAVITY_M_S2, rel=0.005)
    assert min(forces) > 0.0


def test_masses_of_bars_are_those_of_the_file(on_bearings):
    _, _, folder = on_bearings
    with (folder / "elements.csv").open(encoding="utf-8", newline="") as file:
        rows = {row["element"]: row for row in csv.DictReader(file)}
    girder = rows["Girder left"]
    assert girder["became"] == "bar"
    assert float(girder["mass_kg"]) == pytest.approx(7850.0 * 0.024 * 21.0, rel=1e-4)
    assert "I 800x300x12x25, S355" in girder["why"]


@pytest.fixture(scope="module")
def odd_truss(tmp_path_factory):
    """The truss with a bar that meets nothing, one that misses a node, and plates at seven joints."""
    made = truss_file()
    made.bar("Stray", CHS_168, (10.0, 0.0, 6.5), (12.0, 1.5, 6.0))
    made.bar("Short", CHS_168, (4.1, 0.1, 5.0), (5.0, 1.6, 5.0))
    for number in range(1, 8):
        plate = (0.4, 0.01, 0.3), (4.0 * number, 0.0, 5.12)
        made.box("IfcPlate", f"Gusset {number}", *plate, "SUPERSTRUCTURE", material=made.steel())
    return imported(made, tmp_path_factory.mktemp("odd"))


@pytest.mark.long
def test_bars_that_meet_nothing_are_named_and_do_not_fall_silently(odd_truss):
    lines, scenario, _ = odd_truss
    assert "Stray" not in {member.name for member in scenario.steelwork.members}
    assert any("would fall at once" in line and "IfcMember" in line for line in lines)
    (line,) = (line for line in lines if line.startswith("  Stray: meets no other bar, and nothing holds it"))
    # Its first end is 1.5 m above the lower chord, and 1 m beside the middle of a diagonal, by 1.5 / √13.
    assert line.endswith("m is nearest to an axis, 0.42 m off") or "m off" in line


def test_a_diagonal_that_misses_a_node_is_said_to_end_free(odd_truss):
    lines, _, _ = odd_truss
    (line,) = (line for line in lines if "ends free" in line)
    assert line.startswith("  Short ends free at x = ")
    assert "m off" in line


def test_plates_at_joints_are_mass_on_nodes(plain_truss, odd_truss):
    lines, scenario, _ = odd_truss
    _, without, _ = plain_truss
    assert not scenario.geometry
    mass = sum(node.mass_kg for node in scenario.steelwork.nodes)
    # To 0.1 kg for each of seven nodes.
    assert mass == pytest.approx(7 * 7850.0 * 0.4 * 0.01 * 0.3, abs=0.4)
    assert sum(node.mass_kg for node in without.steelwork.nodes) == 0.0
    assert any("7 plates and stubs at joints are left out" in line for line in lines)


def test_without_bars_all_is_cut_into_shards_as_before(tmp_path):
    lines, scenario, _ = imported(ladder(), tmp_path, bars=False, shards=40)
    assert scenario.steelwork is None
    assert [table.kind for table in scenario.geometry].count("girder") == 8
    assert "Bars of steel" not in lines
    assert len(scenario.bearings) == 6


def test_strict_takes_no_bars_and_refuses_to_be_asked_for_them(tmp_path):
    made = ladder()
    _, scenario, _ = imported(made, tmp_path, strict=True)
    assert scenario.steelwork is None
    with pytest.raises(IfcError, match="bars and strict are both asked for"):
        ImportSettings(strict=True, bars=True)
