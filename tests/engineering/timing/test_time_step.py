# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames, sub-steps and impulses against rates that are known and sums done by hand."""

import pytest

from bridge_demolition_addon.engineering.timing.timeline import TimeStep

FILM = TimeStep(frames_per_second=24, frames_per_second_base=1.0, substeps_per_frame=10, time_scale=1.0)
NTSC = TimeStep(frames_per_second=30, frames_per_second_base=1.001, substeps_per_frame=7, time_scale=1.0)

# Quotients of a few doubles: some units in the last place.
ROUNDING = 1e-14


def test_frame_of_film_and_of_ntsc():
    assert FILM.frame_s == pytest.approx(1 / 24, rel=ROUNDING)
    # NTSC shows 30 000 pictures in 1001 s.
    assert 30_000 * NTSC.frame_s == pytest.approx(1001, rel=ROUNDING)


def test_slow_motion_shortens_frames():
    slow = TimeStep(25, 1.0, 4, 0.1)
    assert slow.frame_s == pytest.approx(0.004, rel=ROUNDING)
    assert slow.substep_s == pytest.approx(0.001, rel=ROUNDING)


def test_substeps_fill_a_frame():
    assert 240 * FILM.substep_s == pytest.approx(1.0, rel=ROUNDING)
    assert 7 * NTSC.substep_s == pytest.approx(NTSC.frame_s, rel=ROUNDING)


def test_impulse_is_the_momentum_that_a_force_gives_in_a_substep():
    # 100 kg held for 1/240 s against the standard acceleration of free fall.
    assert FILM.impulse(980.665) == pytest.approx(980.665 / 240, rel=ROUNDING)
    # The impulses of all sub-steps of a second add up to force times 1 s, whatever the steps.
    for step in (FILM, NTSC):
        assert step.impulse(5.0) / step.substep_s == pytest.approx(5.0, rel=ROUNDING)


@pytest.mark.parametrize(
    "step, duration_s, frames",
    [
        (FILM, 5.0, 120),
        (FILM, 5.0001, 121),
        (FILM, 1 / 24, 1),
        (FILM, 0.001, 1),
        (FILM, 0.0, 0),
        (NTSC, 1001.0, 30_000),
        (TimeStep(24, 1.0, 10, 0.5), 5.0, 240),
        (TimeStep(10, 1.0, 1, 1.0), 0.1 + 0.2, 3),  # in binary a little more than three tenths
        (TimeStep(100, 1.0, 1, 1.0), 0.29, 29),  # 0.29 × 100 is a little less than 29
        (TimeStep(24, 1.0, 1, 1.0), 100 / 24 * (1 + 1e-9), 100),
    ],
)
def test_frames_cover_a_duration_and_rounding_adds_none(step, duration_s, frames):
    assert step.frames(duration_s) == frames
    assert type(step.frames(duration_s)) is int
