# SPDX-License-Identifier: GPL-3.0-or-later
"""A run of which only motion is wanted comes to the same, bit by bit, as one with everything, whatever breaks it."""

from dataclasses import replace

import numpy as np
import pytest
from support.checkout import TESTS
from support.long_cases import long_but
from support.scenarios import SHORT_RUN

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.model.results.arrays import load_results
from bridge_demolition_addon.model.scenario import RecordingSettings
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.sequence.checked_model import checked_model

SAME_RUN = TESTS / "simulation" / "same_run"
EVERYTHING = read_scenario(TESTS / "simulation" / "everything.toml")
SCENARIOS = {
    "a force breaks it": SHORT_RUN,
    "by the frame": replace(SHORT_RUN, recording=RecordingSettings(every_substep=False, contacts=True)),
    "strength, bars, saw cut and charge": EVERYTHING,
    "elastic": replace(
        EVERYTHING,
        time=replace(EVERYTHING.time, duration_s=0.6),
        connections=replace(EVERYTHING.connections, stiffness="elastic"),
        weakenings=(),
    ),
    "blast": read_scenario(SAME_RUN / "blast.toml"),
}


QUICK = ("a force breaks it", "by the frame")
"""Those that take least."""


@pytest.fixture(scope="module", params=long_but(QUICK, SCENARIOS))
def both(request, tmp_path_factory):
    """Results and summary of a whole run, and those of a run of which only motion is wanted."""
    from bridge_demolition_addon.simulation.motion_run import motion_run
    from bridge_demolition_addon.simulation.run import run_scenario

    scenario = SCENARIOS[request.param]
    folder = tmp_path_factory.mktemp("whole")
    summary = run_scenario(scenario, folder, overwrite=True, pictures=False, progress=Silence())
    with motion_run(scenario, checked_model(scenario), tmp_path_factory.mktemp("motion")) as motion:
        yield (load_results(folder), summary), motion


def test_it_has_the_same_digests(both):
    (_, whole), (_, motion) = both
    assert whole["connections"]["broken"] > 0
    assert {name: whole["fingerprint"][name] for name in ("built", "motion")} == {
        name: motion["fingerprint"][name] for name in ("built", "motion")
    }
    assert "result" not in motion["fingerprint"]  # not all of it is known


def test_every_frame_has_the_same_bits(both):
    whole, motion = (results.frames for results, _ in both)
    for name in ("time_s", "positions_m", "rotations", "velocities_m_s", "intact", "asleep", "blast_impulses_ns"):
        assert np.array_equal(getattr(whole, name), getattr(motion, name)), name


def test_what_was_not_read_is_not_known(both):
    _, (results, summary) = both
    assert np.isnan(results.frames.loads.body_peak_sums_n).all() and np.isnan(results.frames.work.made_j).all()
    assert summary["energy"] is None and summary["largest_force_sum"] is None
    assert results.contacts is None


def test_contacts_are_kept_where_they_are_asked_for_and_add_up_to_the_loads_of_their_bodies(both):
    (results, _), _ = both
    if results.load_sampling == "every sub-step":
        assert results.contacts is None
        return
    contacts, frames = results.contacts, results.frames
    sums = np.zeros(frames.positions_m.shape)
    rows = np.searchsorted(frames.number, contacts.frames)
    for side, sign in ((0, 1.0), (1, -1.0)):
        np.add.at(sums, (rows, contacts.bodies[:, side]), sign * contacts.impulses_ns)
    assert len(contacts)
    # Seven digits of each of the contacts that act on a body, some of them against each other.
    most = contacts.normal_impulses_ns.max()
    np.testing.assert_allclose(frames.loads.body_contact_impulses_ns, sums, rtol=0.0, atol=1e-5 * most)


def test_it_leaves_nothing_behind(blender, tmp_path):
    from bridge_demolition_addon.simulation.motion_run import motion_run

    with motion_run(SHORT_RUN, checked_model(SHORT_RUN), tmp_path):
        assert list(tmp_path.iterdir())
    assert not list(tmp_path.iterdir())
