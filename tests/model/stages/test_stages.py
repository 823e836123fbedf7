# SPDX-License-Identifier: GPL-3.0-or-later
"""Stages of beams in irregular shards, held against statics, and against the same beams in Blender."""

import csv
from dataclasses import replace

import numpy as np
import pytest
from support.checkout import EXAMPLES
from support.scenarios import I235
from support.stage_beams import (
    DENSITY_KG_M3,
    DEPTH_M,
    MODULUS_M3,
    STRENGTH_PA,
    WEIGHT_N_M,
    WIDTH_M,
    beam_file,
    largest_stress_pa,
    staged,
)

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.stages.stages import criticality, reactions_n, stages_of
from bridge_demolition_addon.model.stages.standing import StandingBridge, made_elastic
from bridge_demolition_addon.model.stages.tables import SLOW_COLLAPSE, stage_row, stage_sentences, write_stages
from bridge_demolition_addon.report.sections.stages import stages_section
from bridge_demolition_addon.simulation.motion_run import motion_run

pytestmark = pytest.mark.slow

EXCAVATOR = """
[[equipment]]
name = "excavator"
mass_kg = 1000.0
position_m = [3.0, 0.0]
footprint_m = [0.4, 0.6]
from_s = 0.5
"""


def test_a_cantilever_bears_itself_and_an_excavator(tmp_path):
    length_m, arm_m, weight_n = 4.0, 3.0, 1000.0 * STANDARD_GRAVITY_M_S2
    (before, after), bridge = staged(beam_file(tmp_path, length_m, more=EXCAVATOR))
    own_n = WEIGHT_N_M * length_m
    # Loads are in the axes of shards that have turned a little as the beam sagged.
    assert reactions_n(bridge.model, before) == pytest.approx([0.0, 0.0, own_n], abs=1.2e-4 * own_n)
    assert reactions_n(bridge.model, after) == pytest.approx([0.0, 0.0, own_n + weight_n], abs=1.2e-4 * own_n)
    assert (before.equipment, after.equipment) == ((), ("excavator",))
    for stage, moment in ((before, own_n * length_m / 2.0), (after, own_n * length_m / 2.0 + arm_m * weight_n)):
        stress = moment / MODULUS_M3
        # The root is one plane. In irregular shards, tilted sections near it bear up to a tenth more.
        assert 0.98 * stress < largest_stress_pa(stage) < 1.15 * stress
        # It is brittle, so that it comes down when the first section is overloaded.
        assert stage.collapse_factor == pytest.approx(STRENGTH_PA / stress, rel=0.1)


CUT = """
[[saw_cuts]]
time_s = 0.5
point_m = [2.5, 0.0, 10.0]
normal = [1.0, 0.0, 0.0]
"""


def test_a_fixed_beam_that_is_cut_is_two_cantilevers(tmp_path):
    length_m = 5.0
    (before, after), bridge = staged(beam_file(tmp_path, length_m, ("start", "end"), more=CUT))
    own_n = WEIGHT_N_M * length_m
    for stage, moment in ((before, own_n * length_m / 12.0), (after, own_n * length_m / 8.0)):
        assert reactions_n(bridge.model, stage)[2] == pytest.approx(own_n, rel=1e-4)
        # A cut goes along the faces of shards, so that one half is up to a shard, 0.4 m of 2.5 m, longer.
        assert 0.95 * moment < largest_stress_pa(stage) * MODULUS_M3 < 1.4 * moment
    assert after.step.startswith("saw cut of ") and not after.loose.any()
    assert after.collapse_factor < before.collapse_factor


REMOVAL = """
[[removals]]
time_s = 0.5
lowest_corner_m = [1.0, -1.0, 9.0]
highest_corner_m = [2.0, 1.0, 11.0]
"""


def test_what_nothing_holds_any_more_is_told(tmp_path):
    (before, after), bridge = staged(beam_file(tmp_path, 4.0, more=REMOVAL))
    assert not before.loose.any()
    masses, centres = bridge.model.masses_kg, bridge.model.centres_m
    beyond = (centres[:, 0] > 2.0) & ~bridge.model.fixed
    assert (after.loose == beyond).all() and masses[beyond].sum() > 0.4 * DENSITY_KG_M3 * 4.0 * DEPTH_M * WIDTH_M
    assert after.removed.any() and not (after.removed & after.loose).any()
    assert after.step.startswith("removal of beam")


def test_a_bridge_whose_support_is_cut_off_has_no_factor(tmp_path):
    cut = CUT.replace("2.5", "0.0")
    (_, after), _ = staged(beam_file(tmp_path, 4.0, more=cut))
    assert not after.standing.held.any() and np.isnan(after.collapse_factor)


def test_a_member_that_holds_all_is_critical_and_one_that_hangs_on_it_is_not(tmp_path):
    scenario = read_scenario(beam_file(tmp_path, 4.0))
    found = criticality(StandingBridge(checked_model(scenario), scenario.joints), lambda done, total: None)
    falls = {fall.member: fall.share for fall in found}
    assert falls["start"] == pytest.approx(1.0) and falls["beam"] == 0.0


@pytest.mark.parametrize("factor", [0.9, 1.1])
def test_it_falls_in_blender_where_its_factor_is_below_1(blender, tmp_path, factor):
    length_m = float(np.sqrt(2.0 * STRENGTH_PA * MODULUS_M3 / WEIGHT_N_M))
    path = beam_file(tmp_path, length_m)
    [stage], _ = staged(path)
    assert stage.collapse_factor == pytest.approx(1.0, rel=0.12)
    scenario = read_scenario(path)
    connections = replace(scenario.connections, strength_factor=factor / stage.collapse_factor)
    scenario = replace(scenario, connections=connections)
    with motion_run(scenario, checked_model(scenario), tmp_path) as (results, _):
        heights = results.frames.positions_m[:, results.inventory.moves, 2]
        assert ((heights[0] - heights[-1]).max() > 0.5) == (factor < 1.0)


def test_a_stage_that_does_not_stand_says_why_a_run_may_be_slow_to_show_it(tmp_path):
    [stage], bridge = staged(beam_file(tmp_path, 4.0))
    row = stage_row(1, stage, bridge)
    assert stage.collapse_factor > 1.0 and SLOW_COLLAPSE not in stage_sentences(stage, row)
    falling = replace(stage, collapse_factor=0.94)
    assert stage_sentences(falling, row)[-2:] == ["comes down at 0.94 times its load", SLOW_COLLAPSE]


def pairs_of(names, pairs):
    """Pairs of shards, or of a shard and the ground, by the names of bodies."""
    return {frozenset(names[body].removeprefix("Shard ").lstrip("0") or "0" for body in pair) for pair in pairs}


def test_what_a_stage_breaks_first_is_the_first_to_break_in_a_run(blender, tmp_path):
    """A frame whose connection that is used most carries 1.002 times its strength."""
    frame = replace(
        I235,
        ball=None,
        time=replace(I235.time, duration_s=0.1),
        fracture=replace(I235.fracture, shards=40),
        connections=replace(I235.connections, type="FIXED", method="face", search_radius_m=None),
        shards=replace(I235.shards, start_deactivated=False, use_deactivation=False),
    )
    scenario = made_elastic(frame)
    model = checked_model(scenario)
    whole, nothing = np.ones(len(model.connections)), np.zeros((6, len(model.shards)))
    used = StandingBridge(model, scenario.joints).rest(whole > 0.0, whole, nothing).used
    connections = replace(scenario.connections, strength_factor=float(np.max(used)) / 1.002)
    scenario = replace(scenario, connections=connections)
    names = [*(str(number) for number in range(len(model.shards))), "Ground"]
    first = pairs_of(names, model.connections.pairs[[int(np.argmax(used))]])
    with motion_run(scenario, checked_model(scenario), tmp_path) as (results, _):
        inventory, intact = results.inventory, results.frames.intact
        broken = ~intact[np.flatnonzero(~intact.all(axis=1))[0]]
        assert first <= pairs_of(inventory.body_names.tolist(), inventory.pairs[broken])


def test_examples_are_scenarios_with_steps_and_equipment():
    paths = sorted((EXAMPLES / "stages").glob("*.toml"))
    assert paths
    for path in paths:
        scenario = read_scenario(path)
        assert scenario.equipment and scenario.changes and checked_model(scenario).connections


def test_tables_and_what_is_printed(tmp_path, capfd):
    path, output = beam_file(tmp_path, 4.0, more=EXCAVATOR), tmp_path / "out"
    assert main(["stages", str(path), "--output", str(output)]) == 0
    said = capfd.readouterr().out
    assert "stage 2, from 0.5 s" in said and "with excavator" in said and "comes down at" in said
    assert "without start: 4.80 t come down, 100%" in said
    rows = list(csv.DictReader((output / "stages.csv").open(encoding="utf-8")))
    assert [row["equipment"] for row in rows] == ["", "excavator"]
    assert [row["step"] for row in rows] == ["as it was built", "equipment comes or goes"]
    for row in rows:
        assert float(row["reaction_z_kN"]) == pytest.approx(float(row["weight_kN"]), rel=1e-4)
        # Its section bends; a face in the upper half of that is in tension.
        assert row["governed_by"] in ("bending", "tension") and float(row["collapse_factor"]) > 1.0
    used = list(csv.DictReader((output / "utilisation.csv").open(encoding="utf-8")))
    assert {row["stage"] for row in used} == {"1", "2"}
    largest = max(float(row["utilisation"]) for row in used if row["stage"] == "1")
    assert largest == pytest.approx(float(rows[0]["largest_utilisation"]), rel=1e-4)
    members = list(csv.DictReader((output / "criticality.csv").open(encoding="utf-8")))
    assert {row["member"]: row["stands"] for row in members} == {"beam": "true", "start": "false"}
    assert main(["stages", str(path), "--output", str(output)]) == 2
    assert "exists already; choose another folder, or add --overwrite" in capfd.readouterr().err


def test_without_factor_stages_say_all_else(tmp_path, capfd):
    path, outputs = beam_file(tmp_path, 4.0, more=EXCAVATOR), (tmp_path / "with", tmp_path / "without")
    said = []
    for output, more in zip(outputs, ((), ("--no-factor",)), strict=True):
        assert main(["stages", str(path), "--output", str(output), *more]) == 0
        said.append(capfd.readouterr().out.replace(str(output), "out").splitlines())
    assert [line for line in said[0] if "comes down at" not in line] == said[1]
    rows, others = (list(csv.DictReader((output / "stages.csv").open(encoding="utf-8"))) for output in outputs)
    assert [row | {"collapse_factor": "not sought"} for row in rows] == others
    texts = [str(block) for block in stages_section(outputs[1]).blocks]
    assert not any("no connection to a support holds anything" in text for text in texts)


def test_what_is_done_is_kept_where_the_rest_is_stopped(tmp_path):
    scenario = read_scenario(beam_file(tmp_path, 4.0, more=EXCAVATOR))
    bridge = StandingBridge(checked_model(made_elastic(scenario)), scenario.joints)

    def stop(done, total):
        assert (done, total) == (1, 2)
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        stages_of(
            scenario, bridge, stop, with_factor=False, keep=lambda done: write_stages(tmp_path / "out", done, bridge)
        )
    (row,) = csv.DictReader((tmp_path / "out" / "stages.csv").open(encoding="utf-8"))
    assert (row["stage"], row["step"]) == ("1", "as it was built")
    assert not (tmp_path / "out" / "criticality.csv").exists()


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (("[3.0, 0.0]", "[9.0, 0.0]"), "equipment 'excavator': nothing of the bridge is under [8.8"),
        (("from_s = 0.5", "from_s = 0.5\nuntil_s = 0.2"), "equipment.until_s is 0.2"),
        (("mass_kg = 1000.0", "mass_kg = 0.0"), "equipment.mass_kg is 0.0"),
    ],
)
def test_wrong_equipment_is_refused_in_words(tmp_path, change, said, capfd):
    path, output = beam_file(tmp_path, 4.0, more=EXCAVATOR.replace(*change)), tmp_path / "out"
    assert main(["stages", str(path), "--output", str(output), "--quiet"]) == 2
    assert said in capfd.readouterr().err and not output.exists()


def test_connections_that_cannot_be_elastic_are_refused_by_what_they_are_needed_for():
    with pytest.raises(
        ScenarioError,
        match=r'connections.method is "vertex": how the bridge stands can only be worked out with method = "face"',
    ):
        made_elastic(I235)
