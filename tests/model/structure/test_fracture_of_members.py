# SPDX-License-Identifier: GPL-3.0-or-later
"""Shards of each member of the I-235 example, cut in ways of their own."""

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from support.scenarios import I235

from bridge_demolition_addon.engineering.geometry.mesh import volumes_and_centres
from bridge_demolition_addon.engineering.geometry.solids import box, hull, union
from bridge_demolition_addon.errors import GeometryError, ScenarioError
from bridge_demolition_addon.model.bridge.preparation import prepared_members
from bridge_demolition_addon.model.scenario import Finer, FracturePoint, FractureSettings, MemberFracture
from bridge_demolition_addon.model.scenario.file import read_scenario, scenario_from_text, scenario_text
from bridge_demolition_addon.model.structure.members import fractured_members
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.model.structure.point_files import points_from_file

pytestmark = pytest.mark.slow

MEMBERS = prepared_members(I235).members
NAMES = [member.name for member in MEMBERS]
MASSES = [member.mass_kg for member in MEMBERS]
VOLUME = 1e-9


def cut(**settings):
    return fractured_members(replace(I235, fracture=FractureSettings(**({"shards": 200} | settings))), MEMBERS)


def counts(parts):
    return dict(zip(NAMES, np.bincount(parts.member_of_shard, minlength=len(NAMES)).tolist(), strict=True))


def test_numbers_of_members_of_their_own():
    rules = [MemberFracture(member="pier", shards=7), MemberFracture(member="pier 2 column 1", shards=20)]
    found = counts(cut(members=rules))
    assert [found[name] for name in NAMES if "column" in name] == [7, 7, 20, 7]
    assert sum(found.values()) == 200
    # What is left, 159, goes to the deck and both caps by volume: 29.75 and twice 2.72 m³.
    assert found["deck"] == pytest.approx(1 + 156 * 29.75 / 35.19, abs=1)


def test_shares_of_members():
    found = counts(
        cut(members=[MemberFracture(member="deck", share=0.25), MemberFracture(member="pier cap", share=0.5)])
    )
    assert (found["deck"], found["pier 1 cap"], found["pier 2 cap"]) == (50, 50, 50)
    assert sum(found.values()) == 200


def test_masses_of_members_stay():
    parts = cut(
        members=[MemberFracture(member="deck", shards=60, stretch=[3, 1, 1])],
        noise=0.5,
        recursion_share=0.3,
        finer=[Finer(position_m=[6.5, 0, 5.4], radius_m=3, factor=10)],
    )
    np.testing.assert_allclose(np.bincount(parts.member_of_shard, parts.masses_kg), MASSES, rtol=VOLUME)


def test_members_around_hollows_are_cut_into_convex_shards(tmp_path):
    """A trough of the user's own: hulls of shards around its corners would reach into its inside."""
    trough = union([box([12, 4, 0.4]), box([12, 0.4, 2], [0, 1.8, 1.2]), box([12, 0.4, 2], [0, -1.8, 1.2])])
    trimesh.Trimesh(trough.vertices, trough.triangles).export(tmp_path / "trough.obj")
    text = f"""
[scenario]
title = "A trough"
[time]
duration_s = 1
[[geometry]]
name = "trough"
position_m = [0.0, 0.0, 0.2]
file = "{(tmp_path / "trough.obj").as_posix()}"
density_kg_m3 = 2400
[connections]
method = "face"
breaking_force_n = 1000
[fracture]
shards = 30"""
    scenario = scenario_from_text(text)
    parts = fractured_members(scenario, prepared_members(scenario).members)
    hulls_m3 = [hull(shard.vertices).volume() for shard in parts.shards]
    volumes, _ = volumes_and_centres(parts.shards)
    assert len(parts.shards) == 30
    assert volumes.sum() == pytest.approx(trough.volume, rel=1e-6)
    np.testing.assert_allclose(hulls_m3, volumes, rtol=1e-6)


def test_uniform_masses():
    parts = cut(mass="uniform")
    np.testing.assert_allclose(np.bincount(parts.member_of_shard, parts.masses_kg), MASSES, rtol=VOLUME)
    for index in range(len(MEMBERS)):
        assert np.ptp(parts.masses_kg[parts.member_of_shard == index]) == 0.0


def test_a_member_near_a_place_gets_more_shards():
    even, finer = cut(), cut(finer=[Finer(position_m=[0, 2.125, 2.45], radius_m=3, factor=20)])
    assert counts(finer)["pier 1 column 2"] > 3 * counts(even)["pier 1 column 2"]
    assert sum(counts(finer).values()) == 200


def test_points_of_ones_own(tmp_path):
    (tmp_path / "points.csv").write_text("x,y,z\n0.1,0,5.1\n\n-0.1, -1, 5.2\n", encoding="utf-8")
    middle = [FracturePoint(position_m=[x, 0.0, 5.4]) for x in (2.0, 5.0, 10.0)]
    parts = cut(points=middle, points_file=str(tmp_path / "points.csv"), shards=100)
    assert counts(parts)["deck"] == 3 and counts(parts)["pier 1 cap"] == 2
    deck = parts.member_of_shard == 0
    # Cut half-way between the points, at 3.5 and 7.5 m; the deck reaches from -0.5 to 13.5 m.
    np.testing.assert_allclose(parts.masses_kg[deck], np.array([4, 4, 6]) / 14 * MASSES[0], rtol=VOLUME)


@pytest.mark.parametrize(
    "settings, error, text",
    [
        (
            {"points": [FracturePoint(position_m=[6, 0, 2])]},
            GeometryError,
            "1 of 1 points of fracture.points and its file",
        ),
        (
            {"members": [MemberFracture(member="arch", shards=2)]},
            ScenarioError,
            "expected the name or kind of a member",
        ),
        ({"shards": 6}, GeometryError, "fracture.shards is 6: expected at least 7"),
        (
            {"members": [MemberFracture(member="deck", shards=196)]},
            GeometryError,
            "fracture.shards is 200: expected at least 202, as 196 are for members",
        ),
        (
            {"members": [MemberFracture(member=kind, shards=5) for kind in ("deck", "pier", "pier cap")]},
            GeometryError,
            "fracture.shards is 200: expected 35, as every member has points or a number of its own",
        ),
    ],
)
def test_what_does_not_fit_is_refused(settings, error, text):
    with pytest.raises(error) as refusal:
        cut(**settings)
    assert text in str(refusal.value)


def test_more_shards_than_fit():
    deck = replace(I235.bridge.deck, width_m=8.5, thickness_m=0.001)
    with pytest.raises(GeometryError, match=r"deck: \d+ shards do not fit into 2.975e-05 m³"):
        tiny = replace(
            I235.bridge,
            span_lengths_m=[0.0035],
            deck=replace(deck, overhang_m=0.0),
            piers=replace(I235.bridge.piers, column_length_m=0.001, column_width_m=0.001, height_m=0.001),
            pier_caps=None,
        )
        scenario = replace(I235, ball=None, bridge=tiny, fracture=FractureSettings(shards=60_000))
        fractured_members(scenario, prepared_members(scenario).members)


def test_one_shard_of_a_merged_bridge():
    scenario = replace(I235, bridge=replace(I235.bridge, merge=True), fracture=FractureSettings(shards=1))
    model = build_model(scenario)
    assert len(model.shards) == 1
    assert model.masses_kg[0] == pytest.approx(107_000, rel=VOLUME)


@pytest.mark.parametrize(
    "content, text",
    [
        ("x,y,z\n1,2\n", "row 2: expected three numbers (m) with commas between them, found 1,2"),
        ("1,2,3\na,b,c\n", "row 2: expected three numbers (m) with commas between them, found a, b, c"),
        ("1,2,nan\n", "row 1: expected three finite numbers"),
        ("x;y;z\n5;0;4\n", "row 2: expected three numbers (m) with commas between them, found 5;0;4"),
    ],
)
def test_files_that_hold_no_points_are_refused(tmp_path, content, text):
    path = tmp_path / "points.csv"
    path.write_text(content, encoding="utf-8")
    with pytest.raises(ScenarioError) as refusal:
        points_from_file(path)
    assert text.replace("1,2,", "") in str(refusal.value).replace("1, 2", "1,2")


def test_a_missing_file_of_points_is_refused(tmp_path):
    with pytest.raises(ScenarioError, match=r"fracture.points_file is .*: no such file"):
        points_from_file(tmp_path / "none.csv")


def test_a_file_of_points_that_is_no_text_is_refused(tmp_path):
    path = tmp_path / "points.csv"
    path.write_bytes(b"\xfa\xfe\x00x")
    with pytest.raises(ScenarioError, match=r"fracture.points_file is .*: is no text in UTF-8"):
        points_from_file(path)


def test_a_field_longer_than_any_number_is_refused(tmp_path):
    path = tmp_path / "points.csv"
    path.write_text("1," * 3 + "1" * 200_000, encoding="utf-8")
    with pytest.raises(ScenarioError, match=r"fracture.points_file is .*field larger than field limit"):
        points_from_file(path)


def test_gaps_leave_masses_and_connections_as_they_were():
    connections = replace(I235.connections, method="face", search_radius_m=None)
    without, model = (
        build_model(replace(I235, connections=connections, fracture=FractureSettings(shards=60, margin_m=margin)))
        for margin in (0.0, 0.004)
    )
    np.testing.assert_array_equal(model.masses_kg, without.masses_kg)
    np.testing.assert_array_equal(model.connections.areas, without.connections.areas)
    np.testing.assert_array_equal(model.second_moments_m4, without.second_moments_m4)
    volumes = [volumes_and_centres(built.shards)[0] for built in (without, model)]
    assert (volumes[1] < volumes[0]).all()


@pytest.mark.parametrize("values", [{}, {"shards": 3, "share": 0.5}])
def test_what_is_said_of_a_member_is_one_thing(values):
    with pytest.raises(ScenarioError, match=r"fracture\.members"):
        MemberFracture(member="deck", **values)


def test_a_member_is_named_once():
    with pytest.raises(ScenarioError, match=r'fracture.members.member is "deck" more than once'):
        FractureSettings(shards=9, members=[MemberFracture(member="deck", shards=n) for n in (1, 2)])


def test_everything_is_written_and_read_without_loss(tmp_path):
    settings = FractureSettings(
        shards=50,
        noise=0.25,
        stretch=[2, 1, 1],
        margin_m=0.01,
        mass="uniform",
        recursion_share=0.1,
        points_file="points.csv",
        members=[MemberFracture(member="deck", share=0.5), MemberFracture(member="pier", stretch=[1, 1, 4])],
        points=[FracturePoint(position_m=[1, 2, 3])],
        finer=[Finer(position_m=[1, 2, 3], radius_m=2, factor=3)],
    )
    scenario = replace(I235, fracture=settings)
    assert scenario_from_text(scenario_text(scenario)) == scenario
    (tmp_path / "scenario.toml").write_text(scenario_text(scenario), encoding="utf-8")
    read = read_scenario(tmp_path / "scenario.toml").fracture
    assert read == replace(settings, points_file=str((tmp_path / "points.csv").resolve()))
