# SPDX-License-Identifier: GPL-3.0-or-later
"""The chance to fire the other way round, against tables of the normal distribution and drawn times."""

from dataclasses import replace

import numpy as np
import pytest
from support.drilled_columns import ZONE, column_members, column_scenario

from bridge_demolition_addon.model.structure.charge_plan import charge_plan
from bridge_demolition_addon.model.structure.firing_order import chance_of_swap, firing_facts, firing_pairs


@pytest.mark.parametrize(
    "apart_s, one_s, other_s, tabulated",
    [
        (0.005, 0.003, 0.004, 0.158655),  # Φ(-1)
        (0.010, 0.003, 0.004, 0.022750),  # Φ(-2)
        (0.015, 0.0, 0.005, 0.001350),  # Φ(-3)
        (0.0, 0.001, 0.001, 0.5),
        (0.025, 0.0, 0.0, 0.0),
    ],
)
def test_the_chance_is_that_of_the_normal_distribution(apart_s, one_s, other_s, tabulated):
    """M. Abramowitz and I. A. Stegun (1964), table 26.1."""
    assert chance_of_swap(apart_s, one_s, other_s) == pytest.approx(tabulated, abs=5e-7)


def test_the_chance_is_that_of_drawn_times():
    """A million pairs with 2 % at 500 and 525 ms: 3.3 standard deviations of the share that is found."""
    generator, draws = np.random.default_rng(3), 1_000_000
    one, other = (at * (1.0 + 0.02 * generator.standard_normal(draws)) for at in (0.500, 0.525))
    chance = chance_of_swap(0.025, 0.010, 0.0105)
    assert (other < one).mean() == pytest.approx(chance, abs=3.3 * np.sqrt(chance / draws))


def rows(folder, *zones):
    return charge_plan(column_scenario(folder, *zones), column_members()).rows


def test_each_planned_time_is_held_against_the_next(tmp_path):
    """The lower zone fires both rows at 0 ms, where 2 % are nothing; the upper one at 300 and 325 ms: 6 and 6.5 ms."""
    later = {"name": "upper", "middle_m": 3.2, "delay_ms": 300.0, "row_delay_ms": 25.0, "detonator": "shock tube"}
    first, second = firing_pairs(rows(tmp_path, ZONE, replace(ZONE, **later)))
    assert (first.earlier, first.later) == (("zone row 1", "zone row 2"), ("upper row 1",))
    assert first.apart_s == pytest.approx(0.3) and first.chance < 1e-300  # 50 standard deviations
    assert (second.earlier, second.later) == (("upper row 1",), ("upper row 2",))
    assert second.chance == pytest.approx(0.00236, abs=1e-5)  # Φ(-25 / 8.846) = Φ(-2.826)


def test_what_is_the_likeliest_is_said_and_exact_detonators_say_nothing(tmp_path):
    upper = replace(ZONE, name="upper", middle_m=3.2, delay_ms=1.0)
    assert list(firing_facts(rows(tmp_path, ZONE, upper))) == []
    # 25 ms are 52 standard deviations.
    apart = [replace(ZONE, detonator="electronic"), replace(upper, delay_ms=25.0, detonator="electronic")]
    assert next(iter(firing_facts(rows(tmp_path, *apart))))[1].endswith("with a chance of less than 1e-09")
    electronic = [replace(zone, detonator="electronic") for zone in (ZONE, upper)]
    (_, said), _ = firing_facts(rows(tmp_path, *electronic))
    # Φ(-1 / (0.34 √2)) = Φ(-2.080)
    assert said == (
        "a detonator of upper row 1 fires before one of zone row 1, planned 1 ms earlier, with a chance of 0.019"
    )
