# SPDX-License-Identifier: GPL-3.0-or-later
"""Bars that yield: beams that come down by plastic theory, and a strut that bends more near to Euler's load."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.steelwork import bar, node, rest_under, steel_scenario

from bridge_demolition_addon.engineering.steelwork.catalogue import section_named
from bridge_demolition_addon.engineering.steelwork.resistance import DENSITY_KG_M3
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.structure.cracking import CrackedBridge
from bridge_demolition_addon.model.structure.equilibrium import model_at_rest
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.model.structure.utilisation import Utilisations

pytestmark = pytest.mark.slow

SECTION, LENGTH_M, PLATE_M = section_named("HEB 200"), 8.0, 0.1
WEIGHT_N_M = DENSITY_KG_M3 * SECTION.area_m2 * STANDARD_GRAVITY_M_S2
PLASTIC_NM = 235e6 * SECTION.shape.plastic_moduli_m3[0]


def beam(first: str, last: str, pieces: int) -> CrackedBridge:
    ends = [(first, 0.0), (last, LENGTH_M)]
    nodes = [
        node(name, x, 5.0, support=support, radius_m=PLATE_M) for name, (support, x) in zip("ab", ends, strict=True)
    ]
    scenario = steel_scenario(nodes, [bar("beam", "a", "b", "HEB 200")], grade="S235", pieces=pieces)
    model = build_model(scenario)
    whole = np.ones(len(model.connections))
    rest = model_at_rest(model, scenario.joints)
    return CrackedBridge(model, scenario.joints, Utilisations(model, scenario.joints), whole > 0.0, whole, rest)


@pytest.mark.parametrize(
    ("first", "last", "pieces", "moments", "clear_m"),
    [
        ("pinned", "rocker", 12, 8.0, LENGTH_M),
        # A hinge at the fixed end and one in the span: 6 + 4 √2.
        ("fixed", "rocker", 16, 6.0 + 4.0 * math.sqrt(2.0), LENGTH_M - PLATE_M),
    ],
)
def test_a_beam_comes_down_at_its_plastic_load(first, last, pieces, moments, clear_m):
    """M_pl / L² times 8 on two supports, times 11.66 with one end fixed; hinges form at the plates of nodes."""
    by_theory = moments * PLASTIC_NM / clear_m**2 / WEIGHT_N_M
    bridge = beam(first, last, pieces)
    bridge.carry(0.97 * by_theory)
    assert not bridge.fallen.any()
    bridge.carry(1.03 * by_theory)
    assert bridge.fallen.any()


def test_a_beam_fixed_at_both_ends_yields_there_and_then_in_the_middle():
    """12 M_pl / L² and 16 M_pl / L². Then it hangs between its ends, as it cannot draw them together."""
    unit = PLASTIC_NM / (LENGTH_M - 2.0 * PLATE_M) ** 2 / WEIGHT_N_M
    bridge = beam("fixed", "fixed", 11)
    hinges, deflections = [], []
    for load in (11.3, 12.5, 14.0, 15.0, 16.5, 18.0):
        bridge.carry(load * unit)
        hinges.append(int(bridge.cracked.sum()))
        deflections.append(bridge.deflection_m)
    assert hinges[:4] == [0, 2, 2, 2] and hinges[4] > 2
    # Per load, it deflects several times as much once there is a mechanism.
    assert deflections[4] - deflections[3] > 3.0 * (deflections[3] - deflections[2])
    assert not bridge.fallen.any()


@pytest.mark.parametrize("share", [0.25, 0.5, 0.8])
def test_compression_makes_a_strut_softer_until_euler_s_load(share):
    """A pinned strut in 8 pieces under its own weight, with P = share of π² E I / L²; about its weak axis.

    Deflection by that without P is 12 (2 sec u - 2 - u²) / 5 u⁴ with u = π / 2 √share (Timoshenko and Gere, Theory of
    Elastic Stability, 1.5). The load at which it would be infinite is off by less than 3 %.
    """
    nodes = [node("a", 0.0, 5.0, support="pinned"), node("b", LENGTH_M, 5.0, support="rocker")]
    scenario = steel_scenario(nodes, [bar("strut", "a", "b", "HEB 200", roll_deg=90.0)], pieces=8)
    model = build_model(scenario)
    euler_n = math.pi**2 * 210e9 * SECTION.shape.second_moments_m4[1, 1] / LENGTH_M**2
    deflections = [
        (
            model.centres_m[:, 2] - rest_under(model, scenario, {"b": (-force, 0, 0)}, weight=True).positions_m[2, :-1]
        ).max()
        for force in (0.0, share * euler_n)
    ]
    larger = deflections[1] / deflections[0]
    u = math.pi / 2.0 * math.sqrt(share)
    by_theory = 12.0 * (2.0 / math.cos(u) - 2.0 - u * u) / (5.0 * u**4)
    # 1 / (1 - P / P_cr), within 1 %, says at which load each would be infinite.
    assert (1.0 - 1.0 / larger) / (1.0 - 1.0 / by_theory) == pytest.approx(1.0, abs=0.03)


@pytest.mark.parametrize(("length_m", "pieces"), [(3.0, 8), (5.0, 8), (8.0, 8), (5.0, 4)])
def test_a_bowed_strut_buckles_as_its_curve_says(length_m, pieces):
    """A pinned strut, pressed more and more: χ A f_y of EN 1993-1-1, 6.3.1, curve c about the weak axis of HEB 200."""
    slenderness = (
        length_m / math.pi * math.sqrt(235.0 * SECTION.area_m2 / 210e3 / SECTION.shape.second_moments_m4[1, 1])
    )
    phi = 0.5 * (1.0 + 0.49 * (slenderness - 0.2) + slenderness**2)
    by_curve_n = 235e6 * SECTION.area_m2 / (phi + math.sqrt(phi**2 - slenderness**2))
    # Node b has the mass that the force moves, and hardly any weight is left beside it.
    held = node("b", length_m, 5.0, support="rocker", mass_kg=50_000.0)
    struts = [bar("strut", "a", "b", "HEB 200", roll_deg=90.0)]
    scenario = steel_scenario(
        [node("a", 0.0, 5.0, support="pinned"), held], struts, grade="S235", pieces=pieces, bowed=True
    )
    model = build_model(scenario)
    model = replace(model, masses_kg=np.where(model.masses_kg < 1e4, 0.05, 1.0) * model.masses_kg)
    whole, rest = np.ones(len(model.connections)), model_at_rest(model, scenario.joints)
    utilisations = Utilisations(model, scenario.joints)
    strut = CrackedBridge(model, scenario.joints, utilisations, whole > 0.0, whole, rest)
    loads = np.zeros((6, len(model.shards)))
    loads[0, model.masses_kg.argmax()] = -by_curve_n
    for share in (0.5, 0.7, 0.8, 0.9):
        strut.carry(1.0, share * loads)
    assert not strut.fallen.any()
    for share in (1.0, 1.1):
        strut.carry(1.0, share * loads)
    assert strut.fallen.any()


def test_others_go_on_while_a_beam_comes_to_rest():
    """Hinges form one after another, with a pause in each step."""
    bridge, paused = beam("fixed", "fixed", 11), []
    bridge.carry(17.0 * PLASTIC_NM / LENGTH_M**2 / WEIGHT_N_M, pause=lambda: paused.append(bridge.deflection_m))
    assert len(paused) > 1
