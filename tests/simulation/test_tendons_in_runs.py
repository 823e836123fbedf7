# SPDX-License-Identifier: GPL-3.0-or-later
"""Prestressed beams in runs in Blender: at rest as by statics, and what the cut of tendons does to them at once."""

import numpy as np
import pytest
from support.beam_runs import played
from support.prestressed_beam import AREA_MM2, FORCE_N, Beam, beam_text, tendon

from bridge_demolition_addon.engineering.elasticity.tendons import CutTendon

STRAIGHT = "eccentricities_m = [0.3, 0.3, 0.3]"
SPAN_M, CUT_S = 12.0, 0.3


def two_tendons(more="bonded = false"):
    return "".join(tendon(STRAIGHT, name=name, area_mm2=AREA_MM2 / 2.0, more=more) for name in ("one", "other"))


@pytest.mark.long
def test_half_of_the_tendons_go_at_once(blender, tmp_path):
    """At rest as by statics; then between once and twice as far as to the rest that statics has with the other half."""
    cut = f'[[tendon_cuts]]\ntime_s = {CUT_S}\ntendons = ["one"]\n'
    beam = Beam(beam_text(two_tendons() + cut, blocks=12, span_m=SPAN_M, duration_s=1.5))
    recording, results, rises_m = played(blender, tmp_path, beam)
    before_m = beam.middle_rises_m(beam.rest())
    after_m = beam.middle_rises_m(beam.rest(cuts=[CutTendon(0, 0.0)]))
    until = results.frames.time_s < CUT_S - 0.02
    assert rises_m[until][1:] == pytest.approx(before_m, rel=0.01)
    static_m, jump_m = before_m - after_m, before_m - rises_m.min()
    assert 1.5 * static_m < jump_m < 2.0 * static_m  # with 2 % of critical damping nearly twice
    assert rises_m[-20:].mean() == pytest.approx(after_m, abs=0.2 * static_m)
    energy_j = (FORCE_N / 2.0) ** 2 * SPAN_M / (2.0 * 195e9 * AREA_MM2 / 2.0 * 1e-6)
    one, other = recording.tendons.summary()
    assert (one["name"], one["stored_J"]) == ("one", pytest.approx(energy_j, rel=1e-6))
    ((time_s, how, released_j),) = [tuple(part.values()) for part in one["released"]]
    assert (time_s, how, released_j) == (pytest.approx(CUT_S, abs=0.01), "cut", pytest.approx(energy_j, rel=1e-6))
    assert other["released"] == []


def test_connections_carry_the_prestress_from_the_first_frame_on(blender, tmp_path):
    beam = Beam(beam_text(two_tendons("bonded = true"), blocks=12, span_m=SPAN_M, duration_s=0.2))
    recording, results, _ = played(blender, tmp_path, beam)
    assert (
        recording.resting_state.deflection_m == pytest.approx(beam.rest().sag_m, rel=0.01) and beam.rest().sag_m < 0.0
    )
    row = beam.middle_face
    by_statics = beam.rest().loads
    forces = results.frames.loads.connection_forces_n[2:, row]
    assert np.abs(forces[:, 0]) == pytest.approx(np.abs(by_statics.forces_n[row, 0]), rel=0.01)
    assert np.abs(forces[:, 0]) == pytest.approx(FORCE_N, rel=0.01)
    moments = results.frames.loads.connection_moments_nm[2:, row]
    assert np.abs(moments[:, 1]) == pytest.approx(np.abs(by_statics.moments_nm[row, 1]), rel=0.01)


@pytest.mark.long
def test_a_beam_without_its_tendons_comes_down(blender, tmp_path):
    """Its weight alone is more than plain concrete resists; a saw cut takes all of a tendon without bond."""
    saw = "[[saw_cuts]]\ntime_s = 0.1\npoint_m = [18.01, 0.0, 3.5]\nnormal = [1.0, 0.0, 0.0]\n"
    beam = Beam(beam_text(tendon(STRAIGHT, more="bonded = false") + saw, blocks=10, duration_s=0.8))
    recording, _, rises_m = played(blender, tmp_path, beam)
    assert recording.tendons.summary()[0]["released"][0]["how"] == "cut"
    assert rises_m.min() < -0.5
