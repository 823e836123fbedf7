# SPDX-License-Identifier: GPL-3.0-or-later
"""Layers of bars in Blender: a cracked beam stands as long as design formulas say, and comes down beyond that."""

import sys
from dataclasses import replace

import pytest
from support.checkout import ROOT

sys.path.insert(1, str(ROOT / "validation"))

from beams import Beam, middle_m
from case import RIGID_BODIES, simulated

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2

BEAM = Beam(4.0, 0.3, 0.3, 2.0, "bottom", 0.25, 1.0, 500.0, 30.0, 0.05, 0.0025)
"""Cracks in its middle under its own weight; its bars follow. It overshoots: by energy its middle goes down by
1.07 / 0.14 times the 8 mm at which bars yield."""


def area_mm2(share):
    """A of M = A f_y (d - a / 2), a = A f_y / (b f_c), with M so many times w L² / 8."""
    moment = share * BEAM.mass_kg * STANDARD_GRAVITY_M_S2 * BEAM.span_m / 8.0
    width = BEAM.width_m * BEAM.compression_n_mm2 * 1e6
    return width * (BEAM.depth_m - (BEAM.depth_m**2 - 2.0 * moment / width) ** 0.5) / BEAM.yield_n_mm2


@pytest.mark.long
@pytest.mark.parametrize(("share", "stands"), [(0.93, False), (1.07, True)])
def test_a_beam_stands_on_its_bars(blender, tmp_path, share, stands):
    beam = replace(BEAM, area_mm2=area_mm2(share))
    assert beam.moment_nm == pytest.approx(share * beam.mass_kg * STANDARD_GRAVITY_M_S2 * beam.span_m / 8.0)
    scenario = f"""
[scenario]
title = "beam on its bars"

[time]
duration_s = 1.0
substeps_per_frame = 20
solver_iterations = 50
{beam.scenario}
{RIGID_BODIES.format(shards=0.25, ground=0.25)}"""
    _, risen = middle_m(simulated(tmp_path, "run", scenario, beam.solids))
    assert (risen[-1] > -0.2) == stands
