# SPDX-License-Identifier: GPL-3.0-or-later
"""A strip with a plastic hinge in its middle, which a charge below it bends upwards."""

from pathlib import Path

import numpy as np
from beams import Beam, middle_m
from case import RIGID_BODIES, VERIFICATION, Case, Comparison, Found, simulated
from matplotlib.figure import Figure

from bridge_demolition_addon.engineering.blast.pulses import Pulses, blast_pulses, impulse_between
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2 as G

STRIP = Beam(4.0, 1.0, 0.1, 14.0, "top", 0.08, 150.0, 500.0, 40.0, 3.5, 0.001)
STAND_OFF_M, CHARGES_KG = 12.0, (15.0, 25.0, 35.0)
STRENGTH_N = 8.0 * STRIP.moment_nm / STRIP.span_m
STARTS_S, STEP_S = 0.01, 2e-5


def run(folder: Path) -> Found:
    """Let each charge go off."""
    comparisons, courses = [], {}
    for charge in CHARGES_KG:
        courses[charge] = risen_m(folder, charge)
        whole, most = impulse_ns(charge), float(courses[charge][1].max())
        name = f"{charge:g} kg"
        comparisons += [
            Comparison(f"rise, {name}, with the length of the pulse", "mm", 1e3 * expected_m(charge), 1e3 * most, 0.05),
            Comparison(f"rise, {name}, by the impulse alone", "mm", 1e3 * by_impulse_m(whole), 1e3 * most, 0.15),
        ]

    def draw(figure: Figure) -> None:
        axes = figure.subplots()
        for (charge, (times, risen)), style in zip(courses.items(), ("-", "--", ":"), strict=True):
            axes.plot(times, 1e3 * risen, color="black", linestyle=style, label=f"{charge:g} kg")
            axes.axhline(1e3 * expected_m(charge), color="0.6", linewidth=0.8)
        axes.set(xlabel="time (s)", ylabel="rise of the middle (mm)")
        axes.legend()

    return Found(comparisons, draw)


def by_impulse_m(impulse_ns: float) -> float:
    """Rise by an impulse I in no time: 3 I² L / (32 M m), less as the weight works as the strength does, and δ₁ / 2."""
    mass, weight = STRIP.mass_kg, STRIP.mass_kg * G
    alone = 3.0 * impulse_ns**2 * STRIP.span_m / (32.0 * STRIP.moment_nm * mass)
    return (alone + 0.5 * STRIP.yields_by_m) * STRENGTH_N / (STRENGTH_N + weight)


def expected_m(charge_kg: float) -> float:
    """Rise by the pulse as it is: (m / 3) dv/dt = P(t) / 2 - 4 M / L - m g / 2 to v = 0; M grows until bars yield."""
    pulses, area = _pulses(charge_kg), _area_m2()
    time_s = float(pulses.arrivals_s[0, 0])
    most_n, weight_n = 4.0 * STRIP.moment_nm / STRIP.span_m, 0.5 * STRIP.mass_kg * G
    risen = before = 0.0
    while True:
        pushed_ns = 0.5 * area * float(impulse_between(pulses, time_s, time_s + STEP_S)[0, 0])
        held_n = most_n * min(risen / STRIP.yields_by_m, 1.0) + weight_n
        speed = before + (pushed_ns - held_n * STEP_S) * 3.0 / STRIP.mass_kg
        if speed <= 0.0:
            return risen
        risen += 0.5 * (before + speed) * STEP_S
        time_s, before = time_s + STEP_S, speed


def impulse_ns(charge_kg: float) -> float:
    """Whole impulse upwards on both halves."""
    return float(_pulses(charge_kg).impulses_pa_s[0, 0]) * _area_m2()


def _slant_m() -> float:
    """From the charge to the middle of a half."""
    return float(np.hypot(STAND_OFF_M, STRIP.span_m / 4.0))


def _pulses(charge_kg: float) -> Pulses:
    return blast_pulses(
        np.array([[_slant_m()]]), np.array([charge_kg]), np.array([STARTS_S]), ["air"], loading="reflected"
    )


def _area_m2() -> float:
    """Area that both halves show to the charge, by what of its direction is upwards."""
    up, aside = STAND_OFF_M / _slant_m(), STRIP.span_m / 4.0 / _slant_m()
    half = STRIP.width_m * (0.5 * STRIP.span_m * up + STRIP.height_m * aside)
    return 2.0 * half * up


def risen_m(folder: Path, charge_kg: float) -> tuple[np.ndarray, np.ndarray]:
    """Times, and how far the middle has risen in a run, m."""
    middle = STRIP.bottom_m + STRIP.height_m / 2.0
    scenario = f"""
[scenario]
title = "strip over a charge of {charge_kg:g} kg"

[time]
duration_s = 0.2
frames_per_second = 240
substeps_per_frame = 40
solver_iterations = 100
{STRIP.scenario}
[blast]
start_s = {STARTS_S}
loading = "reflected"
apply = "direct"

[[charges]]
position_m = [0.0, 0.0, {middle - STAND_OFF_M}]
mass_kg = {charge_kg}
{RIGID_BODIES.format(shards=0.25, ground=0.25)}"""
    return middle_m(simulated(folder, f"{charge_kg:g}_kg", scenario, STRIP.solids))


CASE = Case(
    name="blasted_strip",
    title="Strip under the impulse of a blast",
    group=VERIFICATION,
    asked=f"A charge goes off {STAND_OFF_M:g} m below a strip of {STRIP.span_m:g} m, {STRIP.height_m:g} m thick, with "
    f"{STRIP.area_mm2:g} mm² of steel near its top. It cracks in its middle, and its halves go up. How far?",
    left_out="More hinges than one, and what is elastic but the crack: its bars yield as it is open by "
    f"{1e3 * STRIP.yields_at_m:g} mm, and the middle up by δ₁ = {1e3 * STRIP.yields_by_m:g} mm. The cracked section of "
    "such a strip is more flexible, 51 mm by M L² / (12 E I); so few bars would not yield under the smallest charge. "
    "The blast is the same over each half, as each is one shard, and pushes head-on.",
    source="Two stiff halves and a plastic hinge: δ = 3 I² L / (32 M m), the impulsive asymptote of rigid-plastic "
    "theory, here with δ₁ / 2 and the work of the weight, Ru / (Ru + m g), Ru = 8 M / L; and the same with the pulse "
    "as long as it is, (m / 3) dv/dt = P(t) / 2 - 4 M / L - m g / 2, with M growing up to δ₁. M by hand, "
    "A f_y (d - a / 2), a = A f_y / (b f_c), EN 1992-1-1:2004, 3.1.7 (3).",
    reason="5 % with the length of the pulse: until it cracks the strip is elastic. Sub-steps are 0.1 ms. 15 % of the "
    "rise by the impulse alone: the pulse takes a tenth of the time that the strip moves, which is worth 4 to 5 %.",
    run=run,
)
