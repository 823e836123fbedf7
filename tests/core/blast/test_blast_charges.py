"""Charges: what they are worth in TNT, and which are refused."""

import numpy as np
import pytest

from bridge_demolition_addon.core.blast.charges import EXPLOSIVES, Charge, ChargeArrays, explosive_named
from bridge_demolition_addon.core.blast.wave import Burst
from bridge_demolition_addon.core.errors import BlastError


def charge(**changes):
    return Charge(**({"name": "mid pier", "place_m": (1.0, 2.0, 3.0), "mass_kg": 10.0} | changes))


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
    assert charge(explosive=name).explosive == "ANFO"


def test_values_are_kept_as_what_they_are():
    kept = charge(place_m=np.array([1, 2, 3]), mass_kg=np.float32(2), delay_s=1, burst="surface")
    assert kept.place_m == (1.0, 2.0, 3.0)
    assert [type(value) for value in (*kept.place_m, kept.mass_kg, kept.delay_s)] == [float] * 5
    assert kept.burst is Burst.SURFACE
    assert charge(mass_kg=0.0).tnt_kg == 0.0


def test_arrays_of_charges():
    arrays = ChargeArrays.of([charge(), charge(explosive="ANFO", delay_s=0.25, burst=Burst.SURFACE)])
    assert arrays.places_m.tolist() == [[1.0, 2.0, 3.0]] * 2
    assert arrays.tnt_kg == pytest.approx([10.0, 8.2])
    assert arrays.delays_s.tolist() == [0.0, 0.25]
    assert arrays.bursts == (Burst.AIR, Burst.SURFACE)


def test_arrays_of_no_charges():
    arrays = ChargeArrays.of([])
    assert arrays.places_m.shape == (0, 3)
    assert arrays.tnt_kg.shape == arrays.delays_s.shape == (0,)


@pytest.mark.parametrize(
    "changes, message",
    [
        ({"mass_kg": -1.0}, "mid pier: mass is -1.0: expected a finite number of at least 0 (kg)"),
        ({"mass_kg": float("nan")}, "mid pier: mass is nan: expected a finite number"),
        ({"mass_kg": float("inf")}, "mid pier: mass is inf: expected a finite number"),
        ({"mass_kg": "much"}, "mid pier: mass is much: expected a finite number"),
        ({"mass_kg": None}, "mid pier: mass is None: expected a finite number"),
        ({"delay_s": -0.001}, "mid pier: delay is -0.001: expected a finite number of at least 0 (s)"),
        ({"delay_s": float("nan")}, "mid pier: delay is nan"),
        ({"place_m": (0.0, 0.0)}, "mid pier: place is (0.0, 0.0): expected three finite numbers (m)"),
        ({"place_m": (0.0, 0.0, float("inf"))}, "mid pier: place is (0.0, 0.0, inf): expected three finite numbers"),
        ({"place_m": 3.0}, "mid pier: place is 3.0: expected three finite numbers"),
        ({"explosive": "jelly"}, "explosive is 'jelly': expected one of TNT, ANFO, C-4"),
        ({"explosive": None}, "explosive is None: expected one of TNT"),
        ({"burst": "water"}, "Burst is 'water': expected one of air, surface"),
    ],
)
def test_impossible_charges_are_refused(changes, message):
    with pytest.raises(BlastError) as refusal:
        charge(**changes)
    assert message in str(refusal.value)
