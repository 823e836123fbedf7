# SPDX-License-Identifier: GPL-3.0-or-later
"""What an import assumes and mends where a file is incomplete or damaged: volumes by hand, and all that stands held."""

import re

import numpy as np
import pytest
from support.ifc_bridges import MASS_KG, VOLUMES_M3, IfcBridge, whole_bridge

from bridge_demolition_addon.engineering.geometry.mesh import TriangleMesh, joined_meshes
from bridge_demolition_addon.engineering.geometry.solids import box, cylinder, to_manifold
from bridge_demolition_addon.errors import GeometryError, IfcError
from bridge_demolition_addon.ifc.alignments import curve_of
from bridge_demolition_addon.ifc.bearings import on_plinth
from bridge_demolition_addon.ifc.bridge import read_bridge
from bridge_demolition_addon.ifc.folder import write_bridge
from bridge_demolition_addon.ifc.gaps import lengthened
from bridge_demolition_addon.ifc.settings import ImportSettings
from bridge_demolition_addon.ifc.substitutes import box_around, slab_between_heights, sound_solid
from bridge_demolition_addon.model.bridge.preparation import prepared_members
from bridge_demolition_addon.model.reinforcement.design import bar_schedule
from bridge_demolition_addon.model.scenario import GeometryReinforcement
from bridge_demolition_addon.model.scenario.file import read_scenario


def read(made, tmp_path, **settings):
    return read_bridge(made.written(tmp_path / "bridge.ifc"), ImportSettings(**settings))


def outcome(bridge, name):
    (found,) = (outcome for outcome in bridge.outcomes if outcome.facts.name == name)
    return found


def open_box(missing):
    """A box of 2 m × 1 m × 1 m without some of its 12 triangles."""
    whole = box((2.0, 1.0, 1.0))
    return TriangleMesh(whole.vertices, np.delete(whole.triangles, missing, axis=0))


# Meshes ---------------------------------------------------------------------------------------------------------------


def test_a_body_inside_out_beside_a_sound_one_is_turned():
    """Two boxes apart, 2 m³ and 1 m³, of which the smaller looks inwards."""
    mesh = joined_meshes([box((2, 1, 1)), box((1, 1, 1), (5, 0, 0)).flipped()])
    made = sound_solid(mesh, "x", None)
    assert made.solid.volume == pytest.approx(3.0)
    hollow = joined_meshes([box((4, 4, 4)), box((1, 1, 1)).flipped()])  # a cavity stays one
    assert sound_solid(hollow, "x", None).solid.volume == pytest.approx(63.0)


def test_a_hole_that_is_not_plane_is_closed_where_it_is_small():
    """A cylinder of 24 sides on which a vertex of its rim is missing, with the triangles around it."""
    whole = cylinder(1.0, 4.0, 24)
    gone = np.flatnonzero((whole.triangles == 5).any(axis=1))
    mesh = TriangleMesh(whole.vertices, np.delete(whole.triangles, gone, axis=0))
    with pytest.raises(GeometryError, match="not closed"):
        sound_solid(mesh, "x", 100.0)  # nothing in its place has that volume
    made = sound_solid(mesh, "x", whole.volume)
    assert made.solid.volume == pytest.approx(whole.volume, rel=0.05)
    assert any("of what the file gives" in note for note in made.repairs)


def test_a_hull_or_box_stands_only_for_what_has_its_volume():
    """A box of 2 m³ in which four triangles of its sides are missing: the file says 2 m³, or half of that."""
    mesh = open_box([4, 5, 8])
    made = sound_solid(mesh, "x", 2.0)
    assert made.solid.volume == pytest.approx(2.0, rel=0.05)
    with pytest.raises(GeometryError):
        sound_solid(open_box([0, 3, 5, 8]), "x", 1.0)


def test_a_box_around_a_turned_box_is_that_box():
    turned = box((3.0, 1.0, 0.5))
    angle = np.radians(33.0)
    turn = np.array(((np.cos(angle), -np.sin(angle), 0), (np.sin(angle), np.cos(angle), 0), (0, 0, 1)))
    made = box_around(TriangleMesh(turned.vertices @ turn.T + (100.0, 50.0, 7.0), turned.triangles))
    assert made.volume == pytest.approx(1.5)


def test_a_slab_between_heights_keeps_thickness_and_slope():
    """A plate of 20 m × 6 m × 0.3 m that rises by 1 in 10 along its length: its volume is that of the level one."""
    plate = box((20.0, 6.0, 0.3))
    sheared = TriangleMesh(plate.vertices + plate.vertices[:, :1] * (0.0, 0.0, 0.1), plate.triangles)
    made = slab_between_heights(sheared)
    assert made.volume == pytest.approx(36.0, rel=0.01)
    assert made.bounds == pytest.approx(sheared.bounds, abs=0.03)


def test_what_is_made_longer_keeps_its_section():
    """A cross of 1 m² and 2 m high, longer by 0.1 m at its bottom: 0.1 m³ more, and none beside it."""
    cross = joined_meshes([box((1.0, 0.6, 2.0)), box((0.4, 1.6, 2.0))])
    solid = sound_solid(cross, "x", None).solid  # 0.6 + 0.64 - 0.24 m² in plan
    longer = lengthened(solid, -0.1)
    assert longer.volume == pytest.approx(1.0 * 2.1, rel=1e-6)
    assert longer.bounds[:, 2] == pytest.approx((-1.1, 1.0))


# Members --------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "gap_m, said",
    [(0.007, "to touch Girder left"), (0.014, "to touch Girder left"), (0.03, "a plate up to Girder left")],
)
def test_a_gap_over_a_bearing_is_closed(gap_m, said, tmp_path):
    made = whole_bridge()
    for name in ("Bearing 2 left", "Bearing 2 right"):
        (bearing,) = (element for element in made.file.by_type("IfcBearing") if element.Name == name)
        bearing.Representation.Representations[0].Items[0].Depth = 0.1 - gap_m
    bridge = read(made, tmp_path)
    found = outcome(bridge, "Bearing 2 left")
    assert found.became == "connection"
    assert found.member.volume_m3 == pytest.approx(0.4 * 0.4 * 0.1, rel=1e-6)
    assert said in found.why
    with_gap = read(made, tmp_path, strict=True)
    assert outcome(with_gap, "Bearing 2 left").became == "left out"


def test_a_column_that_ends_above_its_footing_stands_on_it(tmp_path):
    """9 mm of air under a column of 1 m × 1 m: it grows by 0.009 m³."""
    made = whole_bridge()
    (column,) = made.file.by_type("IfcColumn")
    solid = column.Representation.Representations[0].Items[0]
    solid.Position.Location.Coordinates, solid.Depth = (10.0, 0.0, 0.509), 2.391
    bridge = read(made, tmp_path)
    assert outcome(bridge, "Column").member.volume_m3 == pytest.approx(VOLUMES_M3["pier"], rel=1e-6)
    assert any("Column is made longer" in note for note in bridge.notes)
    assert {support.member for support in bridge.scenario.supports} == {"footing"}


def test_a_column_within_a_wall_is_cut_out_of_the_wall(tmp_path):
    made = whole_bridge()
    made.box("IfcColumn", "Stiff", (0.5, 0.5, 2.5), (0.0, 0.0, 0.5), "ABUTMENT", material=made.material("Steel"))
    bridge = read(made, tmp_path)
    names = [table.name for table in bridge.scenario.geometry]
    assert names.index("Stiff") < names.index("Abutment 1")
    assert any("Stiff lies within Abutment 1: it is cut out of that" in note for note in bridge.notes)


@pytest.mark.parametrize("gap_m, has_haunch", [(0.004, True), (0.12, True), (0.5, False)])
def test_a_girder_goes_up_to_its_deck_by_a_haunch(gap_m, has_haunch, tmp_path):
    """Under a deck that lies higher: 0.4 m wide less 5 mm at each side, 21 m long less 2 cm and 5 mm at each end."""
    made = whole_bridge()
    (deck,) = (slab for slab in made.file.by_type("IfcSlab") if slab.Name == "Carriageway")
    deck.Representation.Representations[0].Items[0].Position.Location.Coordinates = (10.0, 0.0, 4.4 + gap_m)
    bridge = read(made, tmp_path)
    girder = outcome(bridge, "Girder left").member
    added = girder.volume_m3 - VOLUMES_M3["girder"] / 2.0
    assert added == pytest.approx(gap_m * (0.4 - 0.01) * (21.0 - 0.05) if has_haunch else 0.0, abs=1e-4)
    if has_haunch:
        top = outcome(bridge, "Carriageway").member.solid
        assert to_manifold(girder.solid).min_gap(to_manifold(top), 1.0) < 1e-6
        assert any("Girder left has a haunch" in note for note in bridge.notes)
    as_it_is = outcome(read(made, tmp_path, strict=True), "Girder left").member
    assert as_it_is.volume_m3 == pytest.approx(VOLUMES_M3["girder"] / 2.0)


def test_light_bracing_is_mass_on_the_girders(tmp_path):
    """A rod of 5 cm × 5 cm × 1.6 m of steel, 31.4 kg, between two girders that have 105.504 t together."""
    made = whole_bridge()
    rod = (0.05, 1.6, 0.05), (5.0, 0.0, 4.0), "SUPERSTRUCTURE"
    made.box("IfcMember", "Rod", *rod, material=made.material("Steel"))
    bridge = read(made, tmp_path, kinds=(("Rod", "bracing"),))
    assert outcome(bridge, "Rod").became == "left out"
    assert outcome(bridge, "Girder left").member.density_kg_m3 == pytest.approx(7850.0 * (1.0 + 31.4 / 105_504.0))
    assert sum(o.member.mass_kg for o in bridge.outcomes if o.member) == pytest.approx(MASS_KG + 31.4)
    assert any("1 parts of bracing" in note for note in bridge.notes)


def test_of_several_spans_without_piers_only_the_beginning_is_pinned(tmp_path):
    """Two spans of 10 m below one deck: with both pinned at their first ends it would be an arch between these."""
    made = IfcBridge()
    concrete = made.material("Concrete")
    for name, along in (("A", 5.0), ("B", 15.1)):
        made.box("IfcBeam", name, (10.0, 0.4, 0.8), (along, 0.0, 3.6), "SUPERSTRUCTURE", material=concrete)
    made.box("IfcSlab", "Plate", (20.1, 2.0, 0.2), (10.05, 0.0, 4.4), "DECK", material=concrete)
    bridge = read(made, tmp_path)
    by_name = {bearing.members[0]: [] for bearing in bridge.scenario.bearings}
    for bearing in bridge.scenario.bearings:
        by_name[bearing.members[0]].append(bearing.kind)
    assert by_name == {"A": ["pinned", "rocker"], "B": ["rocker", "rocker"]}


def test_a_superstructure_without_piers_gets_supports_under_its_ends(tmp_path):
    """Two girders and a deck: the girders touch the deck, so that one group is held, by two supports a girder."""
    bridge = read(IfcBridge().superstructure(), tmp_path)
    added = [outcome.member for outcome in bridge.outcomes if outcome.became == "added"]
    assert len(added) == 4
    assert bridge.ground_m == pytest.approx(3.6 - 5.0)  # 5 m under the girders
    for member in added:
        low, high = member.solid.bounds
        assert (low[2], high[2]) == pytest.approx((0.0, 5.0), abs=1e-6)
        assert min(abs(low[0] - 0.05), abs(high[0] - 20.95)) == pytest.approx(0.0, abs=1e-6)
    kinds = sorted(bearing.kind for bearing in bridge.scenario.bearings)
    assert kinds == ["pinned", "pinned", "rocker", "rocker"]
    assert {support.member for support in bridge.scenario.supports} == {member.name for member in added}


def test_girders_that_end_just_above_what_they_lie_on_get_pads(tmp_path):
    """The bridge without its bearings of 0.1 m: girders of 0.4 m over two abutments and a pier cap, all 1 m long."""
    bridge = read(IfcBridge().substructure().superstructure(), tmp_path)
    pads = [outcome.member for outcome in bridge.outcomes if outcome.became == "connection"]
    assert sorted(pad.name for pad in pads) == ["Abutment 1"] * 2 + ["Abutment 2"] * 2 + ["Crosshead"] * 2
    for pad in pads:
        assert np.ptp(pad.solid.bounds, axis=0) == pytest.approx((0.4, 0.36, 0.1), abs=0.002)  # 0.9 of the girder
        assert pad.solid.bounds[1, 2] == pytest.approx(3.6)
    kinds = {bearing.members: bearing.kind for bearing in bridge.scenario.bearings}
    assert len(kinds) == 6
    assert {below for (_, below), kind in kinds.items() if kind == "pinned"} == {"Abutment 1"}
    assert not [outcome for outcome in bridge.outcomes if outcome.became == "added"]
    assert any("the file has no bearings: 6 pads, up to 101 mm high" in note for note in bridge.notes)
    with_bearings = read(whole_bridge(), tmp_path)
    assert not any("pads" in note for note in with_bearings.notes)


def test_a_bearing_on_nothing_gets_a_support_or_a_plinth(tmp_path):
    made = IfcBridge().substructure().bearings().superstructure()
    for name in ("Abutment 1", "Footing 1"):
        (element,) = (e for e in made.file.by_type("IfcElement") if e.Name == name)
        made.file.remove(element)
    (crosshead,) = (e for e in made.file.by_type("IfcBeam") if e.Name == "Crosshead")
    crosshead.Representation.Representations[0].Items[0].Depth = 0.4  # 0.2 m under the bearings
    bridge = read(made, tmp_path)
    added = [outcome.member for outcome in bridge.outcomes if outcome.became == "added"]
    assert [member.name for member in added] == ["Support under Bearing 1 right", "Support under Bearing 1 left"]
    plinth = outcome(bridge, "Bearing 2 left").member
    assert plinth.volume_m3 == pytest.approx(0.4 * 0.4 * (0.1 + 0.2 + 0.001), rel=1e-3)


def test_a_plinth_stands_with_its_whole_face_on_a_cap_with_crossfall():
    """A bearing of 1 m × 1 m over a top that falls by 5 %: 0.2 m to its highest edge, 0.225 m on average."""
    below = box((3.0, 3.0, 1.0), (0.5, 0.5, 0.5))
    heights = below.vertices[:, 2] * (1.0 - 0.05 * (below.vertices[:, 1] + 0.5))  # 1 m high at y = -0.5
    sloping = TriangleMesh(np.column_stack((below.vertices[:, :2], heights)), below.triangles)
    bearing = box((1.0, 1.0, 0.1), (0.0, 0.0, 1.25))
    solid = on_plinth(bearing, sloping)
    assert solid.volume == pytest.approx(0.1 + 0.2 + 0.5 * 0.05 + 0.001, abs=1e-4)
    touching = to_manifold(TriangleMesh(solid.vertices - (0.0, 0.0, 0.001), solid.triangles)) ^ to_manifold(sloping)
    assert touching.volume() == pytest.approx(0.002, rel=0.02)  # let in by 1 mm, and moved by another


def test_a_member_that_others_cut_through_becomes_two(tmp_path):
    """A brace of 3 m across both girders, which take 2 × 0.4 m of it: 1.6 m between them, and 0.3 m at either side."""
    made = whole_bridge()
    made.box("IfcMember", "Brace", (0.2, 3.0, 0.2), (5.0, 0.0, 4.0), "SUPERSTRUCTURE", material=made.material("Steel"))
    bridge = read(made, tmp_path, kinds=(("Brace", "bracing"),))
    parts = {o.member.name: o.member.volume_m3 for o in bridge.outcomes if o.facts.name == "Brace" and o.member}
    assert parts == pytest.approx(
        {"Brace": 1.6 * 0.04, "Brace part 2": 0.3 * 0.04, "Brace part 3": 0.3 * 0.04}, rel=1e-6
    )


def test_what_touches_nothing_is_left_out_with_its_mass(tmp_path):
    made = whole_bridge()
    made.box("IfcBeam", "Stray", (1, 1, 1), (10.0, 0.0, 8.0), "DECK", material=made.material("Steel"))
    stray = outcome(read(made, tmp_path, kinds=(("Stray", "bracing"),)), "Stray")
    assert stray.became == "left out"
    assert stray.why.endswith("would fall at once; 7.850 t are missing")


# Files ----------------------------------------------------------------------------------------------------------------


def test_of_several_bridges_the_largest_or_that_of_a_name_is_taken(tmp_path):
    made = whole_bridge()
    other = made.root("IfcBridge", "Footbridge")
    made.aggregate(made.site, other)
    made.parts, made.bridge = {}, other
    made.box("IfcSlab", "Plate", (8.0, 2.0, 0.3), (40.0, 0.0, 3.0), "DECK", material=made.material("Concrete"))
    taken = read(made, tmp_path)
    assert taken.scenario.title == "Two spans"
    assert outcome(taken, "Plate").became == "left out"
    assert any("the file holds 2 bridges" in note for note in taken.notes)
    asked = read(made, tmp_path, only="foot*")
    assert asked.scenario.title == "Footbridge"
    assert {o.facts.name for o in asked.outcomes if o.became == "member"} == {"Plate"}
    with pytest.raises(IfcError, match=r'has no bridge "Tower": it has Two spans \(16 members\), Footbridge'):
        read(made, tmp_path, only="Tower")
    with pytest.raises(IfcError, match=r"holds 2 bridges, .*: say which one by --only NAME"):
        read(made, tmp_path, strict=True)


# Alignments -----------------------------------------------------------------------------------------------------------


class Given:
    """An entity as far as an alignment looks at it."""

    def __init__(self, kind, **attributes):
        self._kind = kind
        for name, value in attributes.items():
            setattr(self, name, value)

    def is_a(self, kind=None):
        return self._kind if kind is None else kind == self._kind


def at(x, y, heading=0.0):
    direction = Given("IfcDirection", DirectionRatios=(np.cos(heading), np.sin(heading)))
    return Given("IfcAxis2Placement2D", Location=Given("IfcCartesianPoint", Coordinates=(x, y)), RefDirection=direction)


def segment(parent, placement, length, start=0.0):
    return Given("IfcCurveSegment", ParentCurve=parent, Placement=placement, SegmentLength=length, SegmentStart=start)


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_an_arc_runs_on_its_circle_and_a_parabola_rises_as_it_should(way):
    """A quarter of a circle of 100 m, to the left or the right, from the origin along x; z = 0.02 s - 0.0001 s²."""
    quarter = np.pi / 2.0 * 100.0
    arc = segment(Given("IfcCircle", Radius=100.0), at(0.0, 0.0), way * quarter)
    plan = Given("IfcCompositeCurve", Segments=(arc,))
    parabola = Given("IfcPolynomialCurve", CoefficientsX=(0.0, 1.0), CoefficientsY=(0.0, 0.02, -0.0001))
    gradient = segment(parabola, at(0.0, 5.0, np.arctan(0.02)), quarter)
    curve = curve_of(Given("IfcGradientCurve", BaseCurve=plan, Segments=(gradient,)), 1.0)
    for angle in (0.0, 0.4, 1.2, np.pi / 2.0):
        along = 100.0 * angle
        frame = curve.at(along)
        expected = (100.0 * np.sin(angle), way * 100.0 * (1.0 - np.cos(angle)), 5.0 + 0.02 * along - 1e-4 * along**2)
        assert frame.point == pytest.approx(expected, abs=1e-4)
        assert frame.along[:2] @ frame.left[:2] == pytest.approx(0.0, abs=1e-12)
        assert frame.along[2] / np.hypot(*frame.along[:2]) == pytest.approx(0.02 - 2e-4 * along, abs=1e-9)


def test_a_parabola_may_keep_its_own_slope_in_a_level_placement():
    """As PGSuper writes it: 17.391888 m + 0.05 s - 0.000243876 s², which meets the next part at 41.148 m."""
    line, parabola = Given("IfcLine"), Given("IfcPolynomialCurve", CoefficientsY=(0.0, 0.05, -0.000243875765529308))
    plan = Given("IfcCompositeCurve", Segments=(segment(line, at(0.0, 0.0), 200.0),))
    parts = segment(parabola, at(0.0, 17.391888), 41.148), segment(line, at(41.148, 19.03636782, 0.0299), 100.0)
    curve = curve_of(Given("IfcGradientCurve", BaseCurve=plan, Segments=parts), 1.0)
    assert curve.at(20.0).point[2] == pytest.approx(17.391888 + 1.0 - 0.000243875765529308 * 400.0)
    assert curve.at(41.1479999).point[2] == pytest.approx(19.03636782, abs=1e-5)


def test_a_clothoid_is_that_of_fresnel():
    """With A = 100 m, at its 80th metre: scipy's integrals of Fresnel, scaled by A √π."""
    from scipy.special import fresnel

    spiral = segment(Given("IfcClothoid", ClothoidConstant=100.0), at(0.0, 0.0), 80.0)
    curve = curve_of(Given("IfcCompositeCurve", Segments=(spiral,)), 1.0)
    scale = 100.0 * np.sqrt(np.pi)
    sine, cosine = fresnel(80.0 / scale)
    assert curve.at(80.0).point[:2] == pytest.approx((scale * cosine, scale * sine), abs=1e-4)


def test_a_beam_swept_through_sections_has_the_volume_of_its_frustum(tmp_path):
    """From 1 m × 1 m to 1 m × 2 m over 10 m: 15 m³ between plane sides."""
    made = whole_bridge()
    make = made.file.create_entity
    line = make("IfcPolyline", [made.point(0.0, 0.0, 6.0), made.point(10.0, 0.0, 6.0)])
    profiles, places = [], []
    for along, height in ((0.0, 1.0), (10.0, 2.0)):
        corners = [(-0.5, 0.0), (0.5, 0.0), (0.5, height), (-0.5, height), (-0.5, 0.0)]
        outline = make("IfcPolyline", [make("IfcCartesianPoint", corner) for corner in corners])
        profiles.append(make("IfcArbitraryClosedProfileDef", "AREA", None, outline))
        on = make("IfcPointByDistanceExpression", make("IfcLengthMeasure", along), None, None, None, line)
        places.append(make("IfcAxis2PlacementLinear", on))
    solid = make("IfcSectionedSolidHorizontal", line, profiles, places)
    made.element("IfcBeam", "Swept", solid, "DECK", material=made.material("Concrete"), shape_type="AdvancedSweptSolid")
    bridge = read(made, tmp_path, kinds=(("Swept", "pier"),))
    swept = outcome(bridge, "Swept").member.solid
    assert swept.volume == pytest.approx(15.0)
    assert to_manifold(swept).status().name == "NoError"
    assert swept.bounds[:, 2] == pytest.approx((6.0, 8.0))


# Reinforcement --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("turn_deg", [0.0, 30.0])
def test_reinforcing_bars_are_layers_of_their_members(turn_deg, tmp_path):
    """Ten bars of 20 mm along the deck, 50 mm below its top, eight of them in two lengths of 10.5 m; 6 of 16 mm across.

    π / 4 × 20² × 10 = 3141.6 mm² in each section along; across, 6 × π / 4 × 16² × 3.8 m / 4 m = 1146.1 mm².
    """
    made = whole_bridge(turn_deg=turn_deg)
    make = made.file.create_entity

    def bar(start, end, diameter):
        line = make("IfcPolyline", [made.point(*start), made.point(*end)])
        disk = make("IfcSweptDiskSolid", line, diameter / 2.0)
        bar = made.element("IfcReinforcingBar", "B", disk, "DECK", shape_type="AdvancedSweptSolid")
        bar.NominalDiameter = diameter

    for number in range(10):
        y = -1.8 + 0.4 * number
        parts = ((-0.5, 10.0), (10.0, 20.5)) if number < 8 else ((-0.5, 20.5),)
        for first, last in parts:
            bar((first, y, 4.55), (last, y, 4.55), 0.02)
    for number in range(6):
        bar((1.0 + 3.0 * number, -1.9, 4.43), (1.0 + 3.0 * number, 1.9, 4.43), 0.016)
    bar((0.0, 0.0, 4.45), (1.0, 1.0, 4.45), 0.02)
    bridge = read(made, tmp_path)
    along, across = (layer for layer in bridge.scenario.reinforcement if "Carriageway" in layer.members)
    assert (along.members, along.along, along.side) == (("Carriageway",), "x", "top")
    assert (along.depth_m, along.area_mm2) == pytest.approx((0.05, 3141.6), rel=1e-3)
    assert (across.along, across.side) == ("y", "bottom")
    assert (across.depth_m, across.area_mm2) == pytest.approx((0.03, 1146.1), rel=1e-3)
    assert any("24 reinforcing bars are 2 layers" in note for note in bridge.notes)
    assert any("bent, inclined or in no member" in note for note in bridge.notes)


@pytest.mark.slow
def test_girders_one_above_the_other_are_one_line_under_a_slab(tmp_path):
    """A slab over two lines of girders has the same bars across whether these are of one piece or lie in two layers."""
    required_m2 = []
    for number, layers in enumerate((((3.6, 0.8),), ((3.6, 0.4), (4.0, 0.4)))):
        made = IfcBridge().substructure().bearings()
        concrete = made.material("C30/37")
        for across in (-1.0, 1.0):
            for low_m, high_m in layers:  # give or take some micrometres
                size, position = (21.0, 0.4, high_m), (10.0, across + 1e-6 * low_m, low_m)
                made.box("IfcBeam", f"{across} {low_m}", size, position, "SUPERSTRUCTURE", material=concrete)
        made.box("IfcSlab", "Carriageway", (21.0, 4.0, 0.2), (10.0, 0.0, 4.4), "DECK", material=concrete)
        write_bridge(read(made, tmp_path), tmp_path / f"made_{number}")
        scenario = read_scenario(tmp_path / f"made_{number}" / "scenario.toml")
        rows = bar_schedule(scenario, prepared_members(scenario).members).rows
        layer = [row for row in rows if row.kind == "deck" and (row.layer.side, row.layer.along) == ("top", "y")]
        required_m2.append([row.required_m2 for row in layer])
    assert required_m2[0] and required_m2[1] == pytest.approx(required_m2[0])


def test_members_of_concrete_have_bars_by_rule(tmp_path):
    """Of a bridge of concrete on steel girders: a rule for load model 1, and steel that keeps its strength."""
    path, folder = whole_bridge().written(tmp_path / "bridge.ifc"), tmp_path / "folder"
    lines = write_bridge(read_bridge(path, ImportSettings()), folder)
    scenario = read_scenario(folder / "scenario.toml")
    assert scenario.geometry_reinforcement == GeometryReinforcement(designed_for="LM1")
    assert scenario.connections.ductile_share == 1.0  # of the girders
    (note,) = (line for line in lines if "the file has no bars" in line)
    assert "members of concrete (" in note and "own weight and LM1" in note and "kg/m³" in note
    schedule = bar_schedule(scenario, prepared_members(scenario).members)
    kinds = {row.kind for row in schedule.rows}
    assert {"deck", "pier", "abutment"} <= kinds and "girder" not in kinds


def test_a_strict_import_has_no_bars_by_rule(tmp_path):
    bridge = read(whole_bridge(), tmp_path, strict=True)
    assert bridge.scenario.geometry_reinforcement is None
    assert not any("no bars" in note for note in bridge.notes)


def approached(made):
    """The bridge with a slab of 4 m behind its beginning, that ends on the deck."""
    made.box("IfcSlab", "Approach slab", (4.0, 4.0, 0.3), (-2.0, 0.0, 4.6), "DECK", material=made.material("Concrete"))
    return made


def test_an_approach_slab_on_a_deck_that_moves_is_left_out(tmp_path):
    """It would hold the end of the deck down, as it never moves."""
    slab = outcome(read(approached(whole_bridge()), tmp_path), "Approach slab")
    assert slab.became == "left out"
    assert "would hold down as it never moves" in slab.why and slab.why.endswith("t are missing")


def test_a_long_girder_is_cut_by_its_length(tmp_path):
    """A girder of 21 m × 0.4 m × 0.8 m: at least 21 / (3 × 0.8) = 8.75 shards, though 5 % of 20 are one."""
    fracture = read(whole_bridge(), tmp_path, shards=20).scenario.fracture
    counts = {rule.member: rule.shards for rule in fracture.members}
    assert counts["Girder left"] == counts["Girder right"] == 9
    assert 20 + len(counts) <= fracture.shards <= 20 + sum(counts.values())


# Files that say little ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("schema", ["IFC2X3", "IFC4X3"])
def test_proxies_without_names_are_taken_by_their_shape(schema, tmp_path):
    """Two abutments on footings, girders and a deck, all proxies that are called by numbers, and without materials."""
    made = IfcBridge(schema=schema)
    boxes = {
        "10": ((3.0, 5.0, 0.5), (0.0, 0.0, 0.0), "footing"),
        "11": ((3.0, 5.0, 0.5), (20.0, 0.0, 0.0), "footing"),
        "20": ((1.0, 4.0, 3.1), (0.0, 0.0, 0.5), "wall"),
        "21": ((1.0, 4.0, 3.1), (20.0, 0.0, 0.5), "wall"),
        "30": ((21.0, 0.4, 0.8), (10.0, 1.0, 3.6), "girder"),
        "31": ((21.0, 0.4, 0.8), (10.0, -1.0, 3.6), "girder"),
        "40": ((21.0, 4.0, 0.2), (10.0, 0.0, 4.4), "deck"),
    }
    for name, (size, place, _) in boxes.items():
        made.box("IfcBuildingElementProxy", name, size, place, "NOTDEFINED")
    bridge = read(made, tmp_path)
    assert {o.facts.name: o.member.kind for o in bridge.outcomes if o.member} == {
        name: kind for name, (_, _, kind) in boxes.items()
    }
    assert any("nothing says what 7 elements are" in note for note in bridge.notes)
    assert {support.member for support in bridge.scenario.supports} == {"footing"}
    with pytest.raises(IfcError, match="has no element that is a member of a bridge"):
        read(made, tmp_path, strict=True)


@pytest.mark.parametrize("unit", ["METRE", "MILLI"])
def test_a_unit_that_the_file_lacks_is_guessed(unit, tmp_path):
    made = whole_bridge(unit=unit)
    (assigned,) = made.file.by_type("IfcUnitAssignment")
    assigned.Units = [one for one in assigned.Units if one.UnitType != "LENGTHUNIT"]
    bridge = read(made, tmp_path)
    assert sum(o.member.volume_m3 for o in bridge.outcomes if o.member) == pytest.approx(sum(VOLUMES_M3.values()))
    assert any("has no unit of length that is known: taken for m" in note for note in bridge.notes)


@pytest.mark.parametrize("unit, label, meant", [("METRE", ".MILLI.", "m"), ("MILLI", "$", "mm")])
def test_a_unit_that_is_a_thousand_times_off_is_mended(unit, label, meant, tmp_path):
    """The bridge of 21 m in a file whose unit is exchanged for another: 21 mm or 21 km long by that."""
    path = whole_bridge(unit=unit).written(tmp_path / "bridge.ifc")
    text, count = re.subn(r"(IFCSIUNIT\(\*,\.LENGTHUNIT\.,)[^,]*,", rf"\g<1>{label},", path.read_text())
    path.write_text(text)
    bridge = read_bridge(path, ImportSettings())
    assert count >= 1
    assert sum(o.member.volume_m3 for o in bridge.outcomes if o.member) == pytest.approx(sum(VOLUMES_M3.values()))
    assert any(f"taken for {meant}; --unit says it better" in note for note in bridge.notes)
