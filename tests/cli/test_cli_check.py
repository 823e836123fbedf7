# SPDX-License-Identifier: GPL-3.0-or-later
"""``bda check`` says what follows from a scenario, and needs no Blender for it."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from support.checkout import I235_FILE, ROOT, SMALL
from support.processes import run_bda, run_program
from support.scenarios import I235
from support.stage_beams import beam_file
from support.terrain_files import EASTING, HEIGHT, NORTHING, plane, write_asc

from bridge_demolition_addon.cli.check import scenario_facts
from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.engineering.geometry.solids import box
from bridge_demolition_addon.model.bridge.mesh_files import exported
from bridge_demolition_addon.model.scenario import (
    Ball,
    BallCable,
    BarLayer,
    Charge,
    ConnectionBetween,
    ConnectionSettings,
    Equipment,
    FractureSettings,
    Geometry,
    Load,
    Support,
)
from bridge_demolition_addon.model.scenario.connections import LARGE_MODEL, MATERIAL_OF_LARGE_MODELS
from bridge_demolition_addon.model.scenario.file import read_scenario, scenario_text
from bridge_demolition_addon.model.scenario.recording import PictureSettings
from bridge_demolition_addon.model.structure.facts import MOST_SHARDS_COMPARED
from bridge_demolition_addon.model.structure.model import build_model

SKEWED_ON_BEARINGS = """
[scenario]
title = "slab on bearings"
[time]
duration_s = 0.5
[bridge]
density_kg_m3 = 2500
span_lengths_m = [12.0]
skew_deg = {skew}
[bridge.deck]
width_m = 8.0
thickness_m = 0.6
overhang_m = 0.5
[bridge.abutments]
length_m = 0.6
width_m = 8.0
height_m = 2.0
[bridge.bearings]
pinned_at = 1
[fracture]
shards = 130
[connections]
type = "FIXED"
method = "face"
material = "reinforced concrete slab"
stiffness = "elastic"
"""


def facts(scenario, **options):
    """What is said of a scenario, by name."""
    lines = [line for line in scenario_facts(scenario, **options) if line.startswith("  ")]
    return {line[2:26].strip(): " ".join(line[26:].split()) for line in lines}


def test_facts_of_the_i235_span(capsys):
    assert main(["check", str(I235_FILE)]) == 0
    printed = capsys.readouterr()
    assert printed.err == ""
    assert printed.out.splitlines() == list(scenario_facts(I235))
    assert printed.out.startswith("I-235 bridge, one span, wrecking ball\n")
    found = facts(I235)
    assert found.pop("a run takes").endswith("on one core, without pictures, to a factor of 3")
    assert found.pop("").endswith("on the disk")
    assert found == {
        "length": "14.00 m",
        "spans": "13.00 m",
        "deck top above ground": "5.55 m",
        "deck": "29.750 m³ 71.064 t",
        "pier 1 cap": "2.720 m³ 6.497 t",
        "pier 1 column 1": "2.401 m³ 5.735 t",
        "pier 1 column 2": "2.401 m³ 5.735 t",
        "pier 2 cap": "2.720 m³ 6.497 t",
        "pier 2 column 1": "2.401 m³ 5.735 t",
        "pier 2 column 2": "2.401 m³ 5.735 t",
        "1 × deck": "29.750 m³ 71.064 t",
        "2 × pier cap": "5.440 m³ 12.995 t",
        "4 × pier": "9.604 m³ 22.941 t",
        "all": "44.794 m³ 107.000 t",
        "density": "2389 kg/m³",
        "duration": "5 s",
        "frames": "120 of 0.0416667 s",
        "sub-step": "0.00416667 s, 10 in a frame",
        "shards": "200",
        "connections": "1431, HINGE, nearest vertices within 1 m, at most 50 per shard",
        "breaking force": "98066.5 N = 98.07 kN",
        "breaking impulse": "408.6 N·s in a sub-step",  # 98 066.5 N / 240 Hz
        "without bars": "no reinforcing bars in deck, pier cap, pier: what cracks there falls apart, as concrete with "
        "bars does not; [bridge.reinforcement] or [[reinforcement]] gives them",
        "unknown": 'Whether the bridge stands cannot be known by statics: connections.method is "vertex": without the '
        "faces of shards there are no stresses; a run awake without what is done to it shows it: bda check --awake",
        "asleep": "In the run all shards sleep until something hits them, so that it does not show whether the bridge "
        "stands",
        # EN 1992-1-1 on concrete, Rabbat and Russell on steel, NAVFAC DM-7.02 on soil; 0.57 · 0.5 / 0.6 = 0.475.
        "shard on shard": "friction 0.6, restitution 0",
        "shard on ball": "friction 0.57, restitution 0",
        "shard on ground": "friction 0.5, restitution 0",
        "ball on ground": "friction 0.475, restitution 0",
        "overlapping shards": "no pairs, by more than 1e-06 of the smaller one",
        "overlapping hulls": "no pairs, by more than 1e-06 of the smaller one",
        "mass": "10.000 t",
        "diameter": "1.34 m, so 7938 kg/m³",
        "clear drop height": "5.00 m",
        "fall time": "1.010 s, so it hits the deck at 1.510 s",
        "impact speed": "9.90 m/s",
        "impact energy": "490.3 kJ",  # m g h
    }


def test_a_ball_that_comes_too_late_is_said():
    brief = replace(I235, time=replace(I235.time, duration_s=1.0))
    assert facts(brief)["fall time"].endswith("at 1.510 s, after the end of the run")


def test_without_ball_and_caps():
    bare = replace(I235, ball=None, bridge=replace(I235.bridge, pier_caps=None))
    assert "impact speed" not in facts(bare)
    assert facts(bare)["deck top above ground"] == "5.15 m"


@pytest.mark.parametrize(
    "method, radius, text",
    [
        ("vertex", 0.5, "nearest vertices within 0.5 m"),
        ("centre", 2, "centres of mass within 2 m"),
        ("face", None, "shards that share a face"),
    ],
)
def test_methods_of_connecting(method, radius, text):
    connections = replace(I235.connections, method=method, search_radius_m=radius)
    count, told = facts(replace(I235, connections=connections))["connections"].split(", ", 1)
    assert int(count) > 200
    assert told == f"HINGE, {text}, at most 50 per shard"


def test_the_shards_are_those_that_there_will_be():
    twice = replace(I235.fracture, shards=40, recursion_share=1.0, recursion_shards=2)
    assert facts(replace(I235, fracture=twice))["shards"] == "80"


@pytest.mark.long
def test_very_many_shards_are_cut_but_not_compared():
    sharing_faces = ConnectionSettings(type="HINGE", method="face", breaking_force_n=1e5)
    many = replace(I235, fracture=replace(I235.fracture, shards=MOST_SHARDS_COMPARED + 1), connections=sharing_faces)
    found = facts(many)
    assert found["shards"] == f"{MOST_SHARDS_COMPARED + 1}"
    assert int(found["connections"].split(",")[0]) > MOST_SHARDS_COMPARED
    assert found["overlapping shards"].startswith("not compared")


@pytest.mark.long
def test_a_large_model_is_told_what_one_force_for_all_comes_to():
    one_force = ConnectionSettings(method="face", breaking_force_n=1e5)
    large = replace(I235, fracture=replace(I235.fracture, shards=LARGE_MODEL), connections=one_force)
    areas = build_model(large).connections.areas
    stress = 1e5 * len(areas) / areas.sum() / 1e6
    assert (
        facts(large)["of all, by their area"] == f"{stress:.3g} N/mm² in the mean; plain concrete is torn at 3.5 N/mm²"
    )
    assert any("give none" in line for line in scenario_facts(large))
    by_default = facts(replace(large, connections=ConnectionSettings(method="face")))
    assert by_default["strength of"].startswith(f"{MATERIAL_OF_LARGE_MODELS}, as in all models of {LARGE_MODEL} shards")
    assert by_default["in shear"] == "0.9 N/mm²"


@pytest.mark.parametrize("material, stands", [("masonry", False), ("steel", True)])
def test_what_its_own_weight_breaks_is_told_of(tmp_path, capsys, material, stands):
    """tests/ui/recording/test_fell_by_itself.py runs the two."""
    file = tmp_path / "span.toml"
    connections = ConnectionSettings(type="FIXED", method="face", material=material, stiffness="elastic")
    scenario = replace(read_scenario(SMALL), connections=connections)
    file.write_text(scenario_text(scenario), encoding="utf-8")
    assert main(["check", str(file)]) == 0
    told = facts(scenario)["overloaded"]
    assert told.endswith("connections, by the bridge's own weight alone")
    assert told.startswith("0 of") == stands
    assert ("the bridge may fall by itself" in capsys.readouterr().out) != stands


@pytest.mark.long
def test_how_a_bridge_that_breaks_by_a_force_would_stand_is_said_too(tmp_path, capsys):
    file = tmp_path / "span.toml"
    for force_n, count in ((1.0, None), (1e12, 0)):
        connections = ConnectionSettings(type="FIXED", method="face", breaking_force_n=force_n)
        scenario = replace(read_scenario(SMALL), connections=connections)
        file.write_text(scenario_text(scenario), encoding="utf-8")
        assert main(["check", "--stand", str(file)]) == 0
        out = capsys.readouterr().out
        assert f"breaking force          {force_n:.1f} N" in out and "a run says whether it stands" in out
        (line,) = (line for line in out.splitlines() if line.startswith("  overloaded"))
        found, of, total = line.split()[1:4]
        # Nothing bears less than one newton, and nothing a million tonnes.
        assert of == "of" and int(found) == (int(total) if count is None else count)


def test_how_much_of_one_breaking_force_the_weight_uses_is_said(tmp_path):
    """A wall of 1 m × 1 m × 4 m on the ground, whose weight its foundation bears along one axis, and nothing else."""
    (tmp_path / "wall.obj").write_bytes(exported(box((1, 1, 4), (0, 0, 2)), ".obj"))
    wall = Geometry(name="wall", file=str(tmp_path / "wall.obj"), density_kg_m3=2400.0)
    weight_n = 2400.0 * 4.0 * 9.80665
    for between, told in (
        ((), "47.1% used at most, 47.1% in the mean of 1"),
        ((ConnectionBetween(members=("wall", "ground"), breaking_force_n=weight_n / 0.8),), "80.0% used at most"),
        ((ConnectionBetween(members=("wall", "ground"), material="steel"),), None),
    ):
        connections = ConnectionSettings(type="FIXED", method="face", breaking_force_n=200e3, between=between)
        standing = replace(
            I235,
            bridge=None,
            geometry=(wall,),
            ball=None,
            fracture=replace(I235.fracture, shards=1),
            connections=connections,
        )
        found = facts(standing, stand=True)
        assert found["overloaded"].startswith("0 of 1 ")
        assert found.get("of breaking forces", "").startswith(told) if told else "of breaking forces" not in found


@pytest.mark.long
def test_how_a_rigid_bridge_would_stand_is_said_when_asked_for(tmp_path, capsys):
    connections = ConnectionSettings(type="FIXED", method="face", material="concrete")
    file = tmp_path / "span.toml"
    texts = []
    for stiffness in ("rigid", "elastic"):
        scenario = replace(I235, connections=replace(connections, stiffness=stiffness))
        file.write_text(scenario_text(scenario), encoding="utf-8")
        assert main(["check", str(file), *(["--stand"] if stiffness == "rigid" else [])]) == 0
        texts.append(capsys.readouterr().out)
    assert "At rest" in texts[0]
    assert texts[0].count("as if its connections were elastic") == 1
    # Of elastic runs alone it is said what finer cuts change.
    assert ["dent of a ball" in text for text in texts] == [False, True]
    texts[1] = re.sub(r"  dent of a ball.*\n.*\n", "", texts[1])
    rigid, elastic = (text[text.index("\nBridge\n") :].splitlines() for text in texts)
    # How long a run takes differs as well.
    different = [
        pair for pair in zip(rigid, elastic, strict=True) if pair[0] != pair[1] and "a run takes" not in pair[0]
    ]
    ((said_of_rigid, said_of_elastic),) = different
    assert "a run says whether it stands" in said_of_rigid
    assert "the bridge may fall by itself" in said_of_elastic
    assert main(["check", "--stand", str(I235_FILE)]) == 2
    printed = capsys.readouterr()
    assert (
        'connections.method is "vertex": how the bridge stands can only be worked out with method = "face"'
        in printed.err
        and printed.out == ""
    )


def test_a_ball_swings_beside_a_member_of_ones_own(tmp_path):
    (tmp_path / "wall.obj").write_bytes(exported(box((4, 1, 3), (2, 0.5, 1.5)), ".obj"))
    wall = Geometry(name="wall", file=str(tmp_path / "wall.obj"), density_kg_m3=2400.0)
    cable = BallCable(crane_point_m=(-3.0, 0.5, 12.0), length_m=10.0, angle_degrees=45, azimuth_degrees=180)
    swinging = Ball(mass_kg=1000.0, diameter_m=1.0, cable=cable)
    few = replace(I235.fracture, shards=20)
    assert facts(replace(I235, bridge=None, geometry=(wall,), fracture=few, ball=swinging))["shards"] == "20"


def test_a_step_that_concerns_no_member_is_refused_as_by_run(tmp_path, capsys):
    path = tmp_path / "bridge.toml"
    step = '\n[[weakenings]]\ntime_s = 2.0\nmembers = ["pear"]\nfactor = 0.5\n'
    path.write_text(I235_FILE.read_text(encoding="utf-8") + step, encoding="utf-8")
    assert main(["check", str(path)]) == 2
    assert 'weakenings.members names "pear"' in capsys.readouterr().err


def test_loads_are_told_with_what_bears_them():
    course = {"times_s": (0.5, 2), "forces_n": (0, 90_000)}
    whole, point = Load(members=("deck",), **course), Load(point_m=(6.5, 0, 6), direction=(0, 1, 0), **course)
    scenario = replace(I235, loads=(whole, point))
    lines = [" ".join(line.split()) for line in scenario_facts(scenario)]
    start = lines.index("Loads") + 1
    assert lines[start] == "load 1 0 kN at 0.5 s, 90 kN at 2 s, towards (0, 0, -1)"
    deck = lines[lines.index("Members") + 1]  # by volume and density, as the member itself
    assert deck.startswith("deck") and lines[start + 1] == f"on 129 shards of deck, together {deck.split(' m³ ')[1]}"
    assert lines[start + 2] == "load 2 0 kN at 0.5 s, 90 kN at 2 s, towards (0, 1, 0)"


def test_moments_of_sections_with_bars_are_told():
    connections = ConnectionSettings(type="FIXED", method="face", material="reinforced concrete slab")
    layer = BarLayer(members=("deck",), depth_m=0.04, area_mm2=12_000.0)
    told = facts(replace(I235, connections=connections, reinforcement=(layer,), fracture=FractureSettings(shards=20)))
    # By hand, EN 1992-1-1: 6 MN, a = 6 / (8.5 × 35) m = 20.2 mm, 6 MN × (0.21 m - a / 2).
    assert told["reinforcement"].startswith("deck, along x: 1199 kN·m with its top pressed, ")
    assert told["reinforcement"].endswith(" kN·m with its bottom pressed")
    assert told["without bars"].startswith("no reinforcing bars in pier cap, pier: ")


def test_links_are_told_by_their_force_in_each_area_across_them():
    connections = ConnectionSettings(type="FIXED", method="face", material="reinforced concrete slab")
    links = BarLayer(members=("deck",), along="z", spread_mm2_m2=1570.0)
    told = facts(replace(I235, connections=connections, reinforcement=(links,), fracture=FractureSettings(shards=20)))
    # 1570 mm²/m² × 500 N/mm² = 0.785 N/mm².
    assert told["reinforcement"] == "deck, spread along z: 0.785 N/mm² of the area across them"


def test_pictures_that_only_a_window_can_take_are_said():
    scenario = read_scenario(SMALL)
    told = facts(replace(scenario, pictures=PictureSettings(camera="own")))["none can be taken"]
    assert "expected pictures.camera_m and pictures.look_at_m" in told
    assert "none can be taken" not in facts(scenario)


def test_checking_needs_no_blender():
    done = run_program("bda_without_blender", "check", I235_FILE)
    assert (done.returncode, done.stderr) == (0, "")
    assert "impact speed" in done.stdout


@pytest.mark.long
def test_running_without_blender_says_what_is_missing(tmp_path):
    output = tmp_path / "results"
    done = run_program("bda_without_blender", "run", I235_FILE, "--output", output)
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr == "bda: error: Blender is not there: install the bpy package or run inside Blender\n"
    assert not output.exists()


@pytest.mark.long
def test_a_title_that_the_console_cannot_show(tmp_path):
    path = tmp_path / "bridge.toml"
    path.write_text(scenario_text(replace(I235, title="다리")), encoding="utf-8")
    status, printed, complained = run_bda("check", path, PYTHONIOENCODING="ascii")
    assert (status, complained) == (0, "")
    assert printed.startswith(r"\ub2e4\ub9ac")


def test_help_is_no_failure(capsys):
    assert main(["--help"]) == 0
    assert "check" in capsys.readouterr().out
    assert main(["run", "--help"]) == 0
    assert "--no-pictures" in capsys.readouterr().out


def test_terrain_is_described_with_its_error_and_what_lies_on_it(tmp_path, capsys):
    """docs/ground.md: where it has no data, where the largest error is, how far it is levelled, what lies on it."""

    def with_a_gap(x, y):
        return np.where(x + y < EASTING + NORTHING + 20.0, np.nan, plane(x, y))

    write_asc(tmp_path / "site.asc", with_a_gap)
    ground = (
        f'\n[ground]\nfile = "site.asc"\norigin = [{EASTING + 50.0}, {NORTHING + 50.0}, {HEIGHT + 12.5}]\n'
        '\n[[ground.surfaces]]\nname = "road"\nkind = "carriageway"\nheight_m = 3.0\n'
        "corners_m = [[8.0, 8.0], [12.0, 8.0], [12.0, 18.0]]\n"
    )
    path = tmp_path / "bridge.toml"
    path.write_text(I235_FILE.read_text(encoding="utf-8") + ground, encoding="utf-8")
    assert main(["check", str(path)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert any(line.startswith("  height of deck top") for line in lines)
    start = lines.index("Ground") + 1
    section = {line[2:26].strip(): line[26:] for line in lines[start : lines.index("", start)]}
    assert section["from"].startswith("site.asc, ") and section["from"].endswith(" heights on the site")
    assert "triangles" in section["made"] and section["heights"].startswith("from ")
    assert " m at most, near (" in section["error"] and "95 % of the heights within" in section["error"]
    assert section["without data"].endswith("% of the site: level on from the nearest height")
    columns = [name for name in section if name.startswith("under pier")]
    assert len(columns) == 4
    for name in columns:  # 0.7 m by 0.7 m on a slope of 1 in 5 and 1 in 20: ± 0.0875 m, and a cell beside
        assert section[name].startswith("dug up to ") and 0.08 < float(section[name].split()[3]) < 0.4
    # A triangle of 20 m², less the one with corners (12, 12), (12, 18) and (11.08, 15.69) where the ground is higher.
    assert section["road"] == "carriageway, 17.2 m² in plan"


def test_how_finely_an_elastic_bridge_is_cut(tmp_path):
    whole = '\n[[fracture.members]]\nmember = "start"\nshards = 1\n'
    said = facts(read_scenario(beam_file(tmp_path, 4.0, more=whole)))
    # 59 cubes of 0.324 m fill 4 m × 1 m × 0.5 m; what stays in its position has no line.
    assert said["shards of beam"] == "12 along its length, 2 in its depth"
    assert said["another cut"].startswith("by seed ") and "the deflection by " in said["another cut"]
    assert "shards of start" not in said


def test_a_cut_is_compared_with_another_where_statics_alone_do_not_say_what_bearings_carry(tmp_path):
    path = tmp_path / "bridge.toml"
    path.write_text(SKEWED_ON_BEARINGS.format(skew=40.0), encoding="utf-8")
    assert facts(read_scenario(path))["another cut"].startswith("by seed 1: single bearings differ by up to ")
    path.write_text(SKEWED_ON_BEARINGS.format(skew=0.0), encoding="utf-8")
    said = facts(read_scenario(path))
    assert "of statics alone" in said and "another cut" not in said


def test_forces_of_bearings_are_not_known_while_shards_sleep(tmp_path, capsys):
    path = tmp_path / "bridge.toml"
    hint = "while shards sleep, a run does not know their forces: shards.start_deactivated = false"
    for more, is_said in (("", True), ("[shards]\nstart_deactivated = false\n", False)):
        path.write_text(SKEWED_ON_BEARINGS.format(skew=0.0) + more, encoding="utf-8")
        assert main(["check", str(path)]) == 0
        out = capsys.readouterr().out
        assert (hint in out) is is_said
        assert "-0.0" not in out


def test_how_an_elastic_bridge_is_damped(tmp_path):
    path = beam_file(tmp_path, 4.0)
    said = facts(read_scenario(path))
    by_steps = np.pi * float(said["first frequency"].split()[0]) / (24 * 10)  # by its 10 sub-steps a frame
    asked = f"{by_steps:.1%} by steps in time, more than the 5.0% asked for"
    assert said["damping"].startswith(asked)
    fine = path.read_text(encoding="utf-8").replace("per_second = 24", "per_second = 24\nsubsteps_per_frame = 1000")
    path.write_text(fine, encoding="utf-8")
    assert facts(read_scenario(path))["damping"] == f"5.0% of critical, {by_steps / 100.0:.1%} of it by steps in time"


def test_a_ball_over_a_slab_is_held_against_punching():
    connections = ConnectionSettings(type="FIXED", method="face", material="reinforced concrete slab")
    along = BarLayer(members=("deck",), depth_m=0.04, area_mm2=17_850.0)
    across = BarLayer(members=("deck",), along="y", depth_m=0.06, area_mm2=14_000.0)
    scenario = replace(
        I235, connections=connections, reinforcement=(along, across), fracture=FractureSettings(shards=20)
    )
    told, ball, length_m = facts(scenario), scenario.ball, deck_length_m(scenario)
    # By hand, EN 1992-1-1, 6.4: d = (0.21 + 0.19) / 2, k = 2, on 8.5 m of width 1 %, and along the deck what there is.
    ratio = (17_850e-6 / 8.5 / 0.21 * 14_000e-6 / length_m / 0.19) ** 0.5
    stress_pa = max(0.18e6 * 2.0 * (100.0 * ratio * 35.0) ** (1 / 3), 0.0525e6 * (8.0 * 35.0) ** 0.5)
    low, high = (stress_pa * 0.2 * math.pi * (loaded + 0.8) / 1e3 for loaded in (0.0, ball.diameter_m))
    assert told["punching"] == f"deck: {low:.4g} kN on a point, {high:.4g} kN on all of the ball"


def deck_length_m(scenario):
    """Length of the deck with its overhangs."""
    bridge = scenario.bridge
    return bridge.spans_m + 2.0 * bridge.deck.overhang_m


def said_after(scenario, name):
    """The lines of a fact and of those without a name that follow it."""
    lines = list(scenario_facts(scenario))
    first = next(number for number, line in enumerate(lines) if line.startswith(f"  {name} "))
    rest = next((number for number, line in enumerate(lines) if number > first and line[2:3] != " "), len(lines))
    return [" ".join(line[26:].split()) for line in lines[first:rest]]


def test_charges_that_lie_in_a_member_or_far_away_are_said():
    def charged(position_m):
        return replace(I235, ball=None, charges=(Charge(position_m=position_m, mass_kg=8.0),))

    # The deck is 0.25 m thick, and its top 5.55 m above the ground.
    assert said_after(charged((6.5, 0.0, 5.4)), "unusual") == [
        "Charge 1 lies in deck: it counts as a bare charge in air; [[blast_zones]] have drill holes"
    ]
    # Bridge from -0.5 to 13.5 m along the road; 40 m/kg^(1/3) of 8 kg are 80 m.
    assert said_after(charged((513.5, 0.0, 1.0)), "unusual") == [
        "Charge 1 is 500 m from the bridge: beyond 80 m its blast hardly loads anything"
    ]
    assert "unusual" not in facts(charged((13.5 + 79.0, 0.0, 1.0)))


def test_a_bridge_to_which_nothing_is_done_is_said():
    advice = "is done to the bridge: add [ball], [[charges]] or another action"
    assert facts(replace(I235, ball=None))["nothing"] == advice
    assert "nothing" not in facts(I235)


def test_equipment_is_listed_with_what_is_odd_about_it():
    def with_excavator(**values):
        excavator = Equipment(**{"name": "excavator", "footprint_m": (4.0, 3.0), "position_m": (6.5, 0.0)} | values)
        return replace(I235, equipment=(excavator,))

    assert said_after(with_excavator(mass_kg=24000.0), "excavator") == ["24 t at (6.5, 0) m"]
    assert said_after(with_excavator(mass_kg=24.0), "excavator") == [
        "0.024 t at (6.5, 0) m",
        "equipment.mass_kg is 24: give it in kg, not in t",
    ]
    # The deck ends at 13.5 m: of 4 m along the road from 11.5 to 15.5, the half is beyond it.
    beside = with_excavator(mass_kg=24000.0, position_m=(13.5, 0.0))
    assert said_after(beside, "excavator")[1:] == ["50% of what it stands on is beside the bridge: move it"]


@pytest.mark.long
def test_a_bridge_in_pieces_is_said():
    assert "pieces" not in facts(I235)
    rule = ConnectionBetween(members=("deck", "pier cap"), none=True)
    connections = ConnectionSettings(type="FIXED", method="face", material="concrete", between=(rule,))
    apart = replace(I235, connections=connections)
    # The deck, and two piers of a cap on two columns each.
    assert facts(apart)["pieces"].startswith("3, which no connection holds together")
    # Shards of a cap that never moves have no connections among each other: they are one piece all the same.
    held = replace(apart, supports=(Support(member="pier cap"),))
    assert facts(held)["pieces"].startswith("3, which no connection holds together")


def test_a_bridge_that_nothing_holds_is_not_said_to_stand(tmp_path):
    """A block of 2 m × 1 m × 1 m in the air, of 4.8 t: none of its connections is overloaded, and all of it falls."""
    (tmp_path / "block.obj").write_bytes(exported(box((2, 1, 1), (0, 0, 3)), ".obj"))
    block = Geometry(name="block", file=str(tmp_path / "block.obj"), density_kg_m3=2400.0)
    floating = replace(
        I235,
        bridge=None,
        geometry=(block,),
        ball=None,
        fracture=replace(I235.fracture, shards=4),
        connections=ConnectionSettings(type="FIXED", method="face", material="concrete"),
    )
    found = facts(floating, stand=True)
    assert "overloaded" not in found
    assert found["does not stand"].startswith(
        "4 of 4 shards, 4.800 t, 100% of what can move, are held by no connection"
    )
    (tmp_path / "foot.obj").write_bytes(exported(box((1, 1, 1), (5, 0, 0.5)), ".obj"))
    foot = Geometry(name="foot", file=str(tmp_path / "foot.obj"), density_kg_m3=2400.0)
    found = facts(replace(floating, geometry=(block, foot)), stand=True)
    assert found["overloaded"].endswith("by the bridge's own weight alone, where it is held")
    assert ", 4.800 t, 67% of what can move" in found["not held"]


def test_what_does_not_go_off_has_no_time():
    drilled = read_scenario(ROOT / "examples" / "drilled" / "two_spans.toml")
    still = replace(
        drilled, blast=replace(drilled.blast, explosion=False), fracture=replace(drilled.fracture, shards=20)
    )
    said = [line for line in scenario_facts(still) if line.startswith(("  P1.1", "  P2.1"))]
    assert len(said) == 2 and all(line.endswith("emulsion, does not go off") for line in said)
