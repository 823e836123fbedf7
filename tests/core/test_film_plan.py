"""Which recorded step each picture of a film shows."""

import numpy as np
import pytest

from bridge_demolition_addon.core.film import film_plan

FRAMES = np.arange(49) / 24.0


def test_the_whole_run_is_shown_in_real_time_between_two_stills():
    plan = film_plan(FRAMES, None)
    assert plan.steps.tolist() == [0] * 24 + list(range(49)) + [48] * 24
    assert plan.speeds.tolist() == [0.0] * 24 + [1.0] * 49 + [0.0] * 24


def test_the_decisive_moment_is_shown_four_times_slower():
    plan = film_plan(FRAMES, 0.5)
    slow = plan.steps[plan.speeds == 0.25]
    # From a quarter of a second before to the end of the 1.5 s after it: steps 6 to 48, each four times.
    assert slow[0] == 6 and slow[-1] == 48
    assert set(np.bincount(slow)[6:48]) == {4}


def test_shorter_frames_do_not_change_how_time_passes():
    """Frames of a tenth around a detonation: real time still shows one step of each 24th of a second."""
    times = np.unique(np.concatenate([FRAMES, np.linspace(1.0, 1.25, 61)]))
    plan = film_plan(times, None)
    shown = times[plan.steps[plan.speeds == 1.0]]
    assert len(shown) == 49
    np.testing.assert_allclose(shown, FRAMES, atol=1e-5)


@pytest.mark.parametrize("moment_s", [None, 0.0])
def test_a_single_frame_makes_a_still(moment_s):
    assert set(film_plan(np.zeros(1), moment_s).steps) == {0}
