# SPDX-License-Identifier: GPL-3.0-or-later
"""Friction and restitution of pairs of surfaces, and files that give them for single bodies."""

from dataclasses import replace

import numpy as np
import pytest
from support.scenarios import I235

from bridge_demolition_addon.cli.check import scenario_facts
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.scenario import ContactSettings, GroundSurface, Jackhammer, SurfaceValues
from bridge_demolition_addon.model.scenario.contact_facts import contact_facts, contact_pairs, with_surfaces
from bridge_demolition_addon.model.scenario.contacts import BallContact, GroundContact, ShardContact, SurfaceContact
from bridge_demolition_addon.model.scenario.file import read_scenario, scenario_from_text, scenario_text
from bridge_demolition_addon.model.study.keys import changed, keys_named

CORNERS = ((20, 20), (30, 20), (30, 30))
RIVER, BANK = (GroundSurface(name=name, height_m=0.1, corners_m=CORNERS) for name in ("river", "bank"))
HAMMER = Jackhammer(start_time_s=0.0, end_time_s=1.0, path_m=((6.5, 0.0),), stroke_m=0.2, depth_m=0.1)
ALL = replace(I235, ground=replace(I235.ground, surfaces=(RIVER, BANK)), jackhammers=(HAMMER,))


def read(tmp_path, text):
    path = tmp_path / "variant.toml"
    path.write_text(f'[scenario]\nbased_on = "{(tmp_path / "base.toml").as_posix()}"\n{text}', encoding="utf-8")
    (tmp_path / "base.toml").write_text(I235_ALONE, encoding="utf-8")
    return read_scenario(path)


I235_ALONE = scenario_text(I235).split("[contacts]")[0] + "[ball]" + scenario_text(I235).split("[ball]", 1)[1]
"""A scenario without a word on friction."""


def products(scenario):
    return {name: (values.friction, values.restitution) for name, values in contact_pairs(scenario)}


def test_defaults_are_those_of_the_sources():
    """EN 1992-1-1, 6.2.5: smooth 0.6; NAVFAC DM-7.02: 0.5 on sand; Rabbat and Russell (1985): 0.57 dry on steel."""
    expected = {
        "shard on shard": 0.6,
        "shard on ball": 0.57,
        "shard on ground": 0.5,
        "shard on surfaces": 0.5,
        "shard on jackhammer": 0.57,
        "ball on ground": 0.57 * 0.5 / 0.6,
        "ball on surfaces": 0.57 * 0.5 / 0.6,
        "ball on jackhammer": 0.57 * 0.57 / 0.6,
    }
    found = products(ALL)
    assert {name: friction for name, (friction, _) in found.items()} == pytest.approx(expected, rel=1e-12)
    assert {restitution for _, restitution in found.values()} == {0.0}


def test_a_file_with_pairs_has_them(tmp_path):
    text = "[contacts.shards]\nfriction = 0.18\nrestitution = 0.125\n[contacts.ground]\nfriction = 0.3\n"
    found = products(read(tmp_path, text))
    assert found["shard on shard"] == pytest.approx((0.18, 0.125))
    assert found["shard on ground"] == pytest.approx((0.3, 0.0))
    assert found["shard on ball"] == pytest.approx((0.57, 0.0))


@pytest.mark.parametrize(
    "text, expected",
    [
        ("[shards]\nfriction = 0.6\n", (0.6, 0.8, 0.5)),
        ("[shards]\nfriction = 0.3\n", (0.3, 0.8, 0.5)),
        ("[ground]\nrestitution = 0.5\n", (0.6, 0.8, 0.5)),
        ("[ball]\nfriction = 0.9\n", (0.6, 0.8, 0.9)),
    ],
)
def test_a_file_with_values_of_bodies_means_what_it_did(tmp_path, text, expected):
    """Those that it leaves out were 0.6 for shards, 0.8 for the ground and 0.5 for the ball."""
    scenario = read(tmp_path, text)
    bodies = (scenario.shards, scenario.ground, scenario.ball)
    assert tuple(scenario.surface_of(body).friction for body in bodies) == expected
    assert scenario.contacts is None
    assert scenario_from_text(scenario_text(scenario)) == scenario
    shard, ground, _ = expected
    assert products(scenario)["shard on ground"][0] == pytest.approx(shard * ground)


def test_tools_and_surfaces_with_values_of_their_own_are_named():
    surfaces = (replace(RIVER, friction=0.1, restitution=0.2), BANK)
    hammers = (replace(HAMMER, friction=0.4), HAMMER)
    scenario = replace(ALL, ground=replace(ALL.ground, surfaces=surfaces), jackhammers=hammers)
    found = products(scenario)
    assert found["shard on river"] == pytest.approx((0.06, 0.0))
    assert found["shard on bank"] == pytest.approx((0.48, 0.0))
    assert found["shard on jackhammer 1"] == pytest.approx((0.24, 0.0))
    assert found["ball on jackhammer 2"] == pytest.approx((0.25, 0.0))
    assert "ground on river" not in found and "ground on jackhammer 1" not in found, "none of them moves"


@pytest.mark.parametrize(
    "text, message",
    [
        (
            "[contacts.ground]\nfriction = 0.5\n[ground]\nfriction = 0.8\n",
            "contacts.ground.friction and ground.friction are given together: expected friction and restitution of "
            "pairs under contacts, or of single bodies as in older files, not both",
        ),
        (
            "[contacts.shards]\nfriction = 0.6\n[ball]\nrestitution = 0.1\n",
            "contacts.shards.friction and ball.restitution are given together",
        ),
        (
            "[contacts.ground]\nrestitution = 0.3\n",
            "contacts.ground.restitution is 0.3: expected 0 where contacts.shards.restitution is 0, or a "
            "contacts.shards.restitution above 0: Bullet multiplies",
        ),
        (
            "[contacts.shards]\nfriction = 0\n",
            "contacts.ground.friction is 0.5: expected 0 where contacts.shards.friction is 0",
        ),
        (
            "[contacts.shards]\nrestitution = 0.2\n[contacts.ground]\nrestitution = 0.5\n"
            "[contacts.ball]\nrestitution = 0.6\n",
            "contacts.ball.restitution is 0.6: expected at most 0.4, which is contacts.shards.restitution over "
            "contacts.ground.restitution: by their values the ball would leave the ground 1.5 times as fast as it came",
        ),
        ("[contacts.shards]\nfriction = 11\n", "contacts.shards.friction is 11: expected a number from 0 to 10"),
        ("[contacts.shards]\nrestitution = 1.1\n", "contacts.shards.restitution is 1.1: expected a number from 0 to 1"),
    ],
)
def test_what_bullet_cannot_have_is_refused(tmp_path, text, message):
    with pytest.raises(ScenarioError) as refused:
        read(tmp_path, text)
    assert message in str(refused.value)


def test_a_pair_without_its_body_is_not_refused(tmp_path):
    """Without friction between shards nothing has friction with them; but there is no ball here."""
    text = 'without = ["ball"]\n[contacts.shards]\nfriction = 0\n[contacts.ground]\nfriction = 0\n'
    assert products(read(tmp_path, text)) == {"shard on shard": (0.0, 0.0), "shard on ground": (0.0, 0.0)}


def test_check_names_pairs_of_which_there_is_no_body(tmp_path):
    text = 'without = ["ball"]\n[contacts.ball]\nfriction = 0.3\n[contacts.ground]\nfriction = 0.4\n'
    facts = dict(contact_facts(read(tmp_path, text)))
    assert facts["of no use"] == "contacts.ball.friction: no such body is in the scenario"
    assert "of no use" not in dict(contact_facts(read(tmp_path, "[contacts.ball]\nfriction = 0.3\n")))


def test_bullet_has_no_more_than_10():
    contacts = ContactSettings(shards=ShardContact(friction=0.1), ground=GroundContact(friction=5.0))
    rough = replace(I235, contacts=replace(contacts, ball=BallContact(friction=5.0)))
    assert products(rough)["ball on ground"][0] == 10.0  # not 250


def test_a_study_may_vary_a_pair_or_the_value_of_a_body():
    (pair,), (body,) = keys_named(I235, "contacts.ground.friction"), keys_named(I235, "shards.friction")
    assert (pair.value, body.value) == (0.5, 0.6)
    assert products(changed(I235, {pair: 0.3}))["shard on ground"][0] == pytest.approx(0.3)
    assert products(changed(I235, {body: 0.3}))["shard on ground"][0] == pytest.approx(0.3 * 0.8)
    with pytest.raises(ScenarioError, match=r"contacts.ground.friction and shards.friction are given together"):
        changed(changed(I235, {pair: 0.3}), {body: 0.3})


def test_check_says_which_pairs_and_which_bodies():
    lines = [line.strip() for line in scenario_facts(ALL)]
    at = lines.index("Contacts")
    assert lines[at + 1 : at + 3] == [
        "shard on shard          friction 0.6, restitution 0",
        "shard on ball           friction 0.57, restitution 0",
    ]
    facts = dict(contact_facts(replace(ALL, shards=replace(ALL.shards, friction=0.5))))
    assert facts["given"] == (
        "for single bodies, as in older files: shard 0.5 and 0, ball 0.5 and 0, ground 0.8 and 0, surfaces 0.8 and 0, "
        "jackhammer 0.5 and 0, where those left out are as they were; a contact has the products"
    )
    assert facts["shard on ground"] == "friction 0.4, restitution 0"
    assert "given" not in dict(contact_facts(ALL))


def test_check_says_from_which_speed_on_a_body_bounces():
    """0.02 √0.75 1 m / (1.25 · 1/240 s) = 3.33 m/s, and a fifth of it."""
    contacts = ContactSettings(shards=ShardContact(restitution=0.25), ground=GroundContact(restitution=0.2))
    facts = dict(contact_facts(replace(I235, contacts=contacts)))
    assert facts["bounce"] == (
        "not to be relied on below 0.67 m/s of one of 0.2 m and 3.3 m/s of one of 1 m, with sub-steps of 4.17 ms: of "
        "what is round none, of flat faces less than given"
    )
    assert "bounce" not in dict(contact_facts(I235))


@pytest.mark.parametrize(
    "surfaces, contacts",
    [
        ({"shards": (0.3, 0.0)}, True),
        ({"ground": (0.2, 0.0)}, True),
        ({"ball": (0.123456, 0.0)}, True),
        ({"shards": (0.3, 0.4), "ground": (1.7, 0.9), "ball": (0.7, 0.1)}, True),
        ({"ground": (0.6454972, 0.9)}, False),
        ({"shards": (0.0, 0.0)}, False),
        ({"ground": (40.0, 0.0)}, False),
    ],
)
def test_values_of_bodies_become_pairs_that_make_them(surfaces, contacts):
    """To the last digit of Blender's single precision; not where shards have 0, or a product is above 10."""
    single = {name: SurfaceValues(*map(float, np.float32(values))) for name, values in surfaces.items()}
    wanted = {body: single.get(body.contact, I235.surface_of(body)) for body in (I235.shards, I235.ground, I235.ball)}
    found = with_surfaces(I235, wanted)
    assert (found.contacts is not None) == contacts
    for body, surface in zip((found.shards, found.ground, found.ball), wanted.values(), strict=True):
        own = found.surface_of(body)
        assert (
            np.float32((own.friction, own.restitution)).tolist()
            == np.float32((surface.friction, surface.restitution)).tolist()
        )
    assert scenario_from_text(scenario_text(found)) == found


def test_surfaces_that_differ_become_values_of_bodies():
    bodies = (ALL.shards, ALL.ground, *ALL.ground.surfaces, ALL.ball, *ALL.jackhammers)
    wanted = {body: ALL.surface_of(body) for body in bodies}
    assert with_surfaces(ALL, wanted) is ALL
    found = with_surfaces(ALL, wanted | {RIVER: SurfaceValues(0.25, 0.0)})
    assert found.contacts is None
    assert [surface.friction for surface in found.ground.surfaces] == [0.25, ALL.surface_of(BANK).friction]
    assert found.jackhammers[0].friction == ALL.surface_of(HAMMER).friction
    with pytest.raises(ScenarioError, match=r"jackhammers have no key for a restitution of 0.5 by themselves"):
        with_surfaces(ALL, wanted | {RIVER: SurfaceValues(0.25, 0.0), HAMMER: SurfaceValues(0.5, 0.5)})


def test_all_surfaces_have_one_pair():
    smooth = replace(ALL, contacts=ContactSettings(surfaces=SurfaceContact(friction=0.2)))
    assert products(smooth)["shard on surfaces"][0] == pytest.approx(0.2)
