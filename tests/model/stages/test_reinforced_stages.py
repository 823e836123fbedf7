# SPDX-License-Identifier: GPL-3.0-or-later
"""Bridges that crack and stand on their bars, held against statics and plastic theory by hand."""

from pathlib import Path

import numpy as np
import pytest
from support.reinforced_slab import LENGTH_M, WEIGHT_N_M, Slab, slab_text

from bridge_demolition_addon.cli.check import scenario_facts
from bridge_demolition_addon.engineering.structure.connections import GROUND
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.scenario.file import read_scenario, scenario_from_text
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.stages.standing import BARS, StandingBridge

pytestmark = pytest.mark.slow

EXAMPLE = (Path(__file__).parents[3] / "examples" / "ground_motion" / "span_in_an_earthquake.toml").as_posix()


@pytest.fixture(scope="module")
def blocks():
    return Slab(slab_text(8, blocks=True))


def test_prisms_in_a_row_come_down_at_the_moment_of_plastic_theory(blocks):
    """3 %: the factor is found within 1 %, and shear and the little that pressed edges give way count beside."""
    assert blocks.collapse_factor() == pytest.approx(blocks.theory, rel=0.03)


@pytest.mark.long
def test_bars_that_harden_carry_up_to_their_tensile_strength():
    hardening = 1.2
    slab = Slab(slab_text(8, blocks=True, hardening=hardening))
    assert slab.collapse_factor() == pytest.approx(hardening * slab.theory, rel=0.03)


def test_half_of_the_bars_carry_half(blocks):
    """Without what concrete carries in tension: it is weak as well, and cracks before."""
    assert blocks.collapse_factor(0.5) == pytest.approx(0.5 * blocks.theory, rel=0.03)


@pytest.mark.long
@pytest.mark.parametrize("seed", [1, 2])
def test_irregular_shards_come_down_at_more_by_as_much_as_they_interlock(seed):
    """Faces are inclined: bars as dowels and friction carry beside, as in a run; up to 30 % in 40 shards."""
    slab = Slab(slab_text(40, seed=seed))
    assert 0.97 * slab.theory < slab.collapse_factor() < 1.3 * slab.theory


def test_a_cracked_bridge_is_in_balance_and_nothing_in_it_is_overloaded(blocks):
    factor = 0.8 * blocks.theory
    standing = blocks.rest(factor)
    assert standing.cracked.any()
    assert np.nanmax(standing.used) <= 1.0 + 1e-9  # bars that yield are used in full
    assert (blocks.bridge.governed_by(standing)[standing.cracked] == BARS).all()
    up_n = [force.force_n[2] for force in blocks.model.bearings.forces(standing.loads)]
    np.testing.assert_allclose(up_n, factor * WEIGHT_N_M * LENGTH_M / 2.0, rtol=1e-3)
    middle = np.argmin(abs(blocks.model.connections.points[:, 0] - 4.0))
    assert standing.cracked[middle]
    # About the middle of the face. What the span has given way by, and the rest of a step, are less than 1 %.
    assert abs(standing.loads.moments_nm[middle, 1]) == pytest.approx(factor * blocks.moment_nm, rel=0.01)
    # The bars in the middle pull by the share of their force at yield that the moment is of that which they bear.
    assert standing.used[middle] == pytest.approx(0.8, rel=0.05)


def test_a_bridge_that_does_not_crack_is_solved_as_without_bars(blocks):
    text = slab_text(8, blocks=True)
    without = (
        text[: text.index("[[reinforcement]]")].replace("ductile_hardening = 1.0", "") + text[text.index("[shards]") :]
    )
    plain = Slab(without)
    assert plain.model.crack_bars is None
    factor = 0.5
    standing = blocks.rest(factor)
    assert not standing.cracked.any()
    np.testing.assert_array_equal(standing.loads.forces_n, plain.rest(factor).loads.forces_n)


@pytest.mark.long
def test_check_says_what_cracks_and_what_bars_hold():
    text = slab_text(8, blocks=True)
    lines = list(scenario_facts(scenario_from_text(text)))
    words = "1 of 9 faces are cracked by the bridge's own weight, all held by bars"
    row = next(row for row, line in enumerate(lines) if words in line)
    assert "of the force at which these rupture at most" in lines[row + 1]
    assert "it stands at rest" in lines[row + 2]
    assert any("mm, with its cracks" in line for line in lines)
    heavy = list(scenario_facts(scenario_from_text(text.replace("= 2400.0", "= 8000.0"))))
    assert any("bars do not hold it" in line for line in heavy)


def test_a_bridge_on_soil_cracks_and_stands_with_its_whole_weight_on_it(tmp_path):
    """Vertical balance, with footings that press on soil: what supports carry is the weight of all shards."""
    path = tmp_path / "on_soil.toml"
    path.write_text(
        f'[scenario]\nbased_on = "{EXAMPLE}"\ntitle = "on soil"\n[connections]\nductile_share = 0.3\n'
        'ductile_elongation_m = 0.05\n[[reinforcement]]\nmembers = ["deck"]\ndepth_m = 0.05\narea_mm2 = 8000.0\n',
        encoding="utf-8",
    )
    scenario = read_scenario(path)
    model = checked_model(scenario)
    bridge, whole = StandingBridge(model, scenario.joints), np.ones(len(model.connections))
    standing = bridge.rest(whole > 0.0, whole, np.zeros((6, len(model.shards))))
    assert standing.cracked.any()
    assert np.nanmax(standing.used) <= 1.0 + 1e-9
    on_ground = (model.connections.pairs == GROUND).any(axis=1)
    weight_n = STANDARD_GRAVITY_M_S2 * model.masses_kg[standing.held].sum()
    assert abs(standing.loads.forces_n[on_ground, 2].sum()) == pytest.approx(weight_n, rel=1e-3)
