# SPDX-License-Identifier: GPL-3.0-or-later
"""Bridges on ground that is not flat: columns reach down to it, it is level under them, and what is wrong is said."""

from dataclasses import replace

import numpy as np
import pytest
from support.scenarios import I235
from support.terrain_files import EASTING, HEIGHT, NORTHING, plane, write_asc

from bridge_demolition_addon.engineering.geometry.solids import box
from bridge_demolition_addon.engineering.structure.connections import GROUND
from bridge_demolition_addon.engineering.terrain.surface import Surface
from bridge_demolition_addon.errors import GeometryError, ScenarioError
from bridge_demolition_addon.model.bridge.preparation import prepared_members
from bridge_demolition_addon.model.scenario import Geometry, Ground, GroundSurface
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.model.terrain.built import built_ground

pytestmark = pytest.mark.slow

ORIGIN = (EASTING + 150.0, NORTHING + 150.0, HEIGHT + 37.5)
"""The plane is at height 0 there: 0.2 × 150 + 0.05 × 150 = 37.5."""

BRIDGE = replace(
    I235,
    ball=None,
    fracture=replace(I235.fracture, shards=21),
    connections=replace(I235.connections, search_radius_m=None, method="face"),
)
"""One span of 13 m on two piers with two columns each, 4.9 m high, 2.125 m to either side of the middle."""

COLUMN, RISE_X, RISE_Y = 0.7, 0.2, 0.05
"""Width of a column, m, and the slopes of the plane along and across the road."""


@pytest.fixture(scope="module")
def slope_file(tmp_path_factory):
    return write_asc(tmp_path_factory.mktemp("terrain") / "slope.asc", count=121)


def on_slope(path, **settings):
    return replace(BRIDGE, ground=Ground(**{"file": str(path), "origin": ORIGIN} | settings))


@pytest.fixture(scope="module")
def model(slope_file):
    return build_model(on_slope(slope_file))


def feet_of(model):
    """Middles (n, 3) of the undersides of all columns."""
    boxes = [member.solid.bounds for member in model.members if member.kind == "pier"]
    return np.array([[*box[:, :2].mean(axis=0), box[0, 2]] for box in boxes])


def test_columns_reach_down_to_the_ground_at_their_axes(model):
    feet = feet_of(model)
    assert len(feet) == 4
    np.testing.assert_allclose(feet[:, 2], RISE_X * feet[:, 0] + RISE_Y * feet[:, 1], atol=1e-9)
    flat = {member.name: member.solid.bounds for member in prepared_members(BRIDGE).members}
    for member in model.members:
        top = member.solid.bounds[1] if member.kind == "pier" else member.solid.bounds
        assert np.array_equal(top, flat[member.name][1] if member.kind == "pier" else flat[member.name])


def test_the_ground_is_level_under_columns_and_as_in_the_file_elsewhere(model):
    ground = model.ground.terrain
    for x, y, level in feet_of(model):
        corners = np.array([(x + a * COLUMN / 2, y + b * COLUMN / 2) for a in (-1, 0, 1) for b in (-1, 0, 1)])
        np.testing.assert_allclose(ground.heights_at(corners), level, atol=1e-9)
    far = np.random.default_rng(1).uniform(-40, -5, (50, 2))
    # A plane is made of triangles without any error.
    np.testing.assert_allclose(ground.heights_at(far), RISE_X * far[:, 0] + RISE_Y * far[:, 1], atol=1e-9)


def test_what_was_done_to_the_ground_is_told(model):
    facts = model.ground.facts
    assert facts.largest_error_m < 1e-6 and facts.filled_in_share == 0.0
    # The pads reach up to a cell of the grid beyond the columns, on either side.
    most = (COLUMN / 2 + 2 * facts.step_m) * (RISE_X + RISE_Y)
    assert [pier.name for pier in facts.levelled] == [member.name for member in model.members if member.kind == "pier"]
    for pier in facts.levelled:
        assert 0.35 * RISE_X <= pier.dug_m <= most and 0.35 * RISE_X <= pier.filled_m <= most
    half = model.ground.terrain.bounds[1, 0]
    assert facts.lowest_m == pytest.approx(-half * (RISE_X + RISE_Y), rel=1e-9)


def test_every_column_has_its_foundation(model):
    standing = model.connections.pairs[:, 1] == GROUND
    areas = np.zeros(len(model.members))
    np.add.at(areas, model.member_of_shard[model.connections.pairs[standing, 0]], model.connections.areas[standing])
    kinds = [member.kind for member in model.members]
    expected = [COLUMN * COLUMN if kind == "pier" else 0.0 for kind in kinds]
    np.testing.assert_allclose(areas, expected, rtol=1e-6)
    np.testing.assert_array_equal(model.connections.normals[standing], np.tile([0.0, 0.0, -1.0], (standing.sum(), 1)))


def test_ground_at_height_0_in_a_file_gives_the_bridge_of_flat_ground(tmp_path):
    path = write_asc(tmp_path / "flat.asc", lambda x, y: HEIGHT + 0.0 * x, count=121)
    flat, level = build_model(BRIDGE), build_model(on_slope(path, origin=(*ORIGIN[:2], HEIGHT)))
    np.testing.assert_array_equal(level.connections.pairs, flat.connections.pairs)
    np.testing.assert_array_equal(level.masses_kg, flat.masses_kg)
    assert level.ground.facts.levelled == ()


def test_the_error_is_measured_against_the_file_and_kept_to(tmp_path):
    """Waves of 20 m: what is thinned is within the tolerance, and what is said is what is measured again here."""

    def waves(x, y):
        return HEIGHT + 37.5 + 1.5 * np.sin(0.314 * x) * np.cos(0.314 * y)

    path = write_asc(tmp_path / "waves.asc", waves, count=121)
    members = [("block", box((2.0, 2.0, 2.0), (0.0, 0.0, 30.0)))]
    found = {}
    for tolerance in (0.02, 0.2):
        ground = built_ground(on_slope(path, tolerance_m=tolerance), members, 32.0)
        numbers = 2.5 * np.arange(-12, 13)  # the file's own places on the site
        positions = np.stack(np.meshgrid(numbers, numbers), -1).reshape(-1, 2)
        errors = np.abs(ground.heights_at(positions) - (waves(*(positions + ORIGIN[:2]).T) - ORIGIN[2]))
        assert ground.facts.largest_error_m == pytest.approx(errors.max(), rel=1e-6, abs=1e-9)
        # A node of the grid is nowhere farther than half a step of 0.5 m from a place of the file, across a kink of
        # the file's own bilinear heights: slopes change by up to 1.5 × 0.314² × 2.5 there.
        assert errors.max() <= tolerance + 0.25 * 1.5 * 0.314 * 0.314 * 2.5
        found[tolerance] = ground.facts.triangles
    assert found[0.2] < found[0.02] / 3


def test_ground_is_dug_away_from_what_reaches_into_it(slope_file, tmp_path):
    """A footing of one's own from 2 m below the ground to 1 m above it; beside it the ground stays."""
    from bridge_demolition_addon.model.bridge.mesh_files import exported

    footing = tmp_path / "footing.obj"
    footing.write_bytes(exported(box((3.0, 3.0, 3.0), (-30.0, 0.0, -6.5)), ".obj"))
    part = Geometry(name="footing", file=str(footing), density_kg_m3=2400.0, kind="pier")
    scenario = replace(on_slope(slope_file), bridge=None, geometry=(part,), fracture=replace(BRIDGE.fracture, shards=4))
    model = build_model(scenario)
    ground, step = model.ground.terrain, model.ground.facts.step_m
    under = np.random.default_rng(2).uniform((-31.5, -1.5), (-28.5, 1.5), (100, 2))
    np.testing.assert_allclose(ground.heights_at(under), -8.0, atol=1e-6)
    beside = np.array([[-30.0 - 1.5 - 3 * step, 0.0], [-30.0, 1.5 + 3 * step]])
    np.testing.assert_allclose(ground.heights_at(beside), RISE_X * beside[:, 0] + RISE_Y * beside[:, 1], atol=1e-9)
    (told,) = model.ground.facts.levelled
    deepest = 8.0 + RISE_X * (-30.0 + 1.5) + RISE_Y * 1.5
    assert told.name == "footing" and deepest <= told.dug_m <= deepest + 2 * step * (RISE_X + RISE_Y)
    # STL keeps single precision, in which heights of 8 m are exact, and areas to 1e-7.
    assert model.connections.areas[model.connections.pairs[:, 1] == GROUND].sum() == pytest.approx(9.0, rel=1e-5)


WATER = {"name": "river", "kind": "water", "corners_m": ((-5.0, -10.0), (5.0, -10.0), (5.0, 10.0), (-5.0, 10.0))}


def test_a_level_surface_leaves_room_for_columns(slope_file):
    """Water at 1.5 m around both columns of the first pier: 10 m × 20 m without two squares of 0.7 m and 0.05 m."""
    scenario = on_slope(slope_file, surfaces=(GroundSurface(**WATER, height_m=1.5),))
    (built,) = build_model(scenario).ground.surfaces
    low, high = built.mesh.bounds
    assert (low.tolist(), high.tolist()) == ([-5.0, -10.0, 0.5], [5.0, 10.0, 1.5])
    room = (COLUMN + 2 * 0.05) * (COLUMN + 2 * 0.05)
    assert built.mesh.volume == pytest.approx(200.0 - 2 * room, rel=1e-6)
    heights = Surface(built.mesh).heights_at(np.array([[0.0, 0.0], [0.0, 2.125], [6.0, 0.0]]))
    np.testing.assert_array_equal(heights, [1.5, np.nan, np.nan])


def valley(x, y):
    return plane(x, y) + 30.0


def hole_under(x_m, y_m):
    def height(x, y):
        return np.where((abs(x - ORIGIN[0] - x_m) < 3) & (abs(y - ORIGIN[1] - y_m) < 3), np.nan, plane(x, y))

    return height


REFUSED = {
    "misses": ({"origin": (0.0, 0.0, 0.0)}, plane, r"slope.asc misses the bridge: it covers eastings 448200 to 448500"),
    "wrong unit": ({"scale": 0.001}, plane, r"no data under pier 1 column 1, at .*ground.scale is metres"),
    "no data under a pier": ({}, hole_under(13.0, -2.125), r"no data under pier 2 column 1, at easting 448363"),
    "ground above the piers": ({}, valley, r"The ground is at 29.\d\d m under pier 1 column 1, whose top is at 4.90 m"),
    "surface under the ground": (
        {"surfaces": (GroundSurface(**WATER, height_m=-9.0),)},
        plane,
        "Surface 'river' lies .* m or more under the ground",
    ),
    "surface elsewhere": (
        {"surfaces": (GroundSurface(name="bank", height_m=0.0, corners_m=((1e3, 0), (1.1e3, 0), (1e3, 100))),)},
        plane,
        "Surface 'bank' lies beside the ground",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_ground_that_cannot_be_is_said(tmp_path, name):
    settings, height, message = REFUSED[name]
    path = write_asc(tmp_path / "slope.asc", height, count=121)
    with pytest.raises(GeometryError, match=message):
        build_model(on_slope(path, **settings))


@pytest.mark.parametrize(
    "settings, message",
    [
        ({"name": "a"}, "ground.surfaces has no height_m or file: give one of them"),
        ({"name": "a", "height_m": 1.0}, "expected both, of a level surface"),
        ({"name": "a", "file": "a.obj", "corners_m": WATER["corners_m"]}, "expected both, of a level surface"),
        ({"name": "a", "height_m": 1.0, "corners_m": ((0, 0), (1, 1))}, "has 2 positions: expected at least 3"),
        ({"name": "a", "height_m": 1.0, "corners_m": ((0, 0), (1, 1), (1, 0), (0, 1))}, "sides cross"),
    ],
)
def test_surfaces_that_cannot_be_are_refused(settings, message):
    with pytest.raises(ScenarioError, match=message):
        GroundSurface(**settings)


def test_grounds_that_cannot_be_are_refused():
    with pytest.raises(ScenarioError, match=r"ground.origin is a list of length 2: expected 3 numbers"):
        Ground(origin=(1.0, 2.0))
    twice = tuple(GroundSurface(**WATER, height_m=height) for height in (0.0, 1.0))
    with pytest.raises(ScenarioError, match=r'number 1 and \[\[ground.surfaces\]\] number 2 have one name, "river"'):
        Ground(surfaces=twice)


def test_a_gap_elsewhere_is_filled_in_and_told(tmp_path):
    path = write_asc(tmp_path / "slope.asc", hole_under(-20.0, 20.0), count=121)
    model = build_model(on_slope(path))
    half, step = model.ground.terrain.bounds[1, 0], model.ground.facts.step_m
    # Three by three heights are missing, 2.5 m apart: four by four cells around them are not known, 10 m × 10 m. They
    # are counted by nodes, of which one more or less may fit in along each side.
    missing = model.ground.facts.filled_in_share * (2 * half) * (2 * half)
    assert (10.0 - 2 * step) * (10.0 - 2 * step) < missing < (10.0 + 2 * step) * (10.0 + 2 * step)
    assert np.isfinite(model.ground.heights_at(np.array([[-20.0, 20.0]]))).all()


def test_a_profile_along_the_road_is_the_ground_and_turns_with_skew():
    """Feet stand at the heights of the drawing: a bank with a slope of 1 in 2 under a span of 13 m."""
    profile = ((-2.0, 3.0), (4.0, 0.0), (20.0, -1.6))
    for skew in (0.0, 20.0):
        shift = np.tan(np.radians(skew))
        scenario = replace(BRIDGE, bridge=replace(BRIDGE.bridge, skew_deg=skew), ground=Ground(profile_m=profile))
        model = build_model(scenario)
        feet = feet_of(model)
        # The column of axis 1 stands where 2 m of the slope are gone, that of axis 2 on the gentle one.
        expected = np.where(feet[:, 0] - feet[:, 1] * shift < 6.0, 2.0, -0.9)
        np.testing.assert_allclose(feet[:, 2], expected, atol=1e-9)
        far = np.random.default_rng(3).uniform((-45.0, -20.0), (-12.0, 20.0), (50, 2))
        tolerance = scenario.ground.tolerance_m
        np.testing.assert_allclose(model.ground.terrain.heights_at(far), 3.0, atol=tolerance)
        assert model.ground.facts.name == "profile along the road"


@pytest.mark.parametrize(
    ("settings", "reason"),
    [
        ({"profile_m": ((0.0, 1.0),)}, "two points at least"),
        ({"profile_m": ((0.0, 1.0), (0.0, 2.0))}, "in their order along the road; 0 follows 0"),
        ({"profile_m": ((0.0, 1.0), (9.0, 2.0)), "file": "valley.asc"}, "together: expected one of them"),
    ],
)
def test_profiles_that_are_none_are_refused(settings, reason):
    with pytest.raises(ScenarioError, match=reason):
        Ground(**settings)


def test_a_bank_above_a_support_is_said_with_its_heights():
    with pytest.raises(
        GeometryError, match=r"at 6\.00 m under pier 1 .*, whose top is at 4\.90 m; .*ground\.profile_m"
    ):
        build_model(replace(BRIDGE, ground=Ground(profile_m=((-1.0, 6.0), (4.0, 6.0), (8.0, 0.0)))))
