# SPDX-License-Identifier: GPL-3.0-or-later
"""Charges: what they are worth in TNT, and which are refused."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.blast.wave import Burst
from bridge_demolition_addon.errors import BlastError, ScenarioError
from bridge_demolition_addon.model.blast.charges import EXPLOSIVES, Charge, explosive_named
from bridge_demolition_addon.model.schema import named


def charge(**changes):
    return Charge(**({"name": "mid pier", "position_m": (1.0, 2.0, 3.0), "mass_kg": 10.0} | changes))


def test_tnt_is_worth_itself():
    assert charge().tnt_kg == charge().tnt_for_pressure_kg == 10.0


def test_other_explosives_are_worth_what_their_source_says():
    c4 = charge(explosive="C-4")
    assert c4.tnt_kg == pytest.approx(11.9)
    assert c4.tnt_for_pressure_kg == pytest.approx(13.7)
    # Heats of detonation over the 4520 kJ/kg of TNT, as far as they are printed: RDX 5360, HMX 5680, dynamite 2710.
    for name, heat in (("RDX", 5360.0), ("HMX", 5680.0), ("Dynamite 60 %", 2710.0)):
        assert charge(explosive=name).tnt_kg == pytest.approx(10.0 * heat / 4520.0, rel=1e-3)


def test_every_explosive_has_a_source_and_a_plausible_worth():
    assert {"TNT", "PETN", "RDX", "ANFO", "C-4", "Composition B", "HMX"} <= set(EXPLOSIVES)
    for name, explosive in EXPLOSIVES.items():
        assert name == explosive.name
        assert explosive.source
        assert 0.5 <= explosive.tnt_by_impulse <= explosive.tnt_by_pressure <= 1.5


@pytest.mark.parametrize("name", ["anfo", " ANFO ", "Anfo"])
def test_names_in_any_letters(name):
    assert explosive_named(name) is EXPLOSIVES["ANFO"]


@pytest.mark.parametrize("name", ["jelly", None])
def test_unknown_explosives_are_refused(name):
    with pytest.raises(BlastError, match=f"explosive is {name!r}: expected one of TNT, ANFO, C-4"):
        explosive_named(name)


def test_values_are_kept_as_what_they_are():
    kept = charge(position_m=[1, 2, 3], mass_kg=np.float32(2), delay_ms=1, burst="surface")
    assert kept.position_m == (1.0, 2.0, 3.0)
    assert [type(value) for value in (*kept.position_m, kept.mass_kg, kept.delay_ms)] == [float] * 5
    assert kept.burst == Burst.SURFACE
    assert kept.delay_s == 0.001
    assert charge(mass_kg=0.0).tnt_kg == 0.0


def test_charges_without_a_name_are_called_after_their_number():
    called = named([charge(), charge(name=None), charge(name="last")])
    assert [charge.name for charge in called] == ["mid pier", "Charge 2", "last"]
    assert named(called) == called


@pytest.mark.parametrize(
    "changes, message",
    [
        ({"mass_kg": -1.0}, "charges.mass_kg is -1.0: expected a number from 0 to 1000000 (kg)"),
        ({"mass_kg": float("nan")}, "charges.mass_kg is nan: expected a number"),
        ({"mass_kg": float("inf")}, "charges.mass_kg is inf: expected a number"),
        ({"mass_kg": "much"}, 'charges.mass_kg is "much": expected a number'),
        ({"mass_kg": None}, "charges.mass_kg is missing: expected a number"),
        ({"delay_ms": -1.0}, "charges.delay_ms is -1.0: expected a number from 0"),
        ({"delay_ms": float("nan")}, "charges.delay_ms is nan"),
        ({"position_m": (0.0, 0.0)}, "charges.position_m is a list of length 2: expected a list of 3 numbers"),
        ({"position_m": (0.0, 0.0, float("inf"))}, "charges.position_m.3 is inf: expected a list of 3 numbers"),
        ({"position_m": 3.0}, "charges.position_m is 3.0: expected a list of 3 numbers"),
        ({"explosive": "jelly"}, 'charges.explosive is "jelly": expected one of "TNT", "ANFO", "C-4"'),
        ({"explosive": None}, 'charges.explosive is missing: expected one of "TNT"'),
        ({"burst": "water"}, 'charges.burst is "water": expected one of "air", "surface"'),
    ],
)
def test_impossible_charges_are_refused(changes, message):
    with pytest.raises(ScenarioError) as refusal:
        charge(**changes)
    assert message in str(refusal.value)
