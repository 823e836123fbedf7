# SPDX-License-Identifier: GPL-3.0-or-later
"""Recorded arrays: forces per body by statics, and files that come back as they were written."""

from dataclasses import fields

import numpy as np
import pytest
from support.sample_results import (
    FRAME_S,
    GRAVITY,
    SUBSTEP_S,
    SUBSTEPS,
    G,
    changed,
    hanging_chain,
    with_contacts,
    without_connections,
)

from bridge_demolition_addon.errors import OutputError
from bridge_demolition_addon.model.results.arrays import load_results

STORED = {
    "reading",
    *("frames", "times_s", "substep_s", "places_m", "rotations", "velocities_m_s", "spins_rad_s", "asleep", "intact"),
    *("body_names", "body_kinds", "masses_kg", "volumes_m3", "body_members", "body_member_kinds"),
    *("vertices_m", "vertex_counts"),
    *("body_forces_n", "body_peaks_n", "body_sums_n", "body_peak_sums_n", "body_contact_impulses_ns"),
    *("body_signed_2019_n", "blast_impulses_ns", "stresses_pa", "von_mises_pa"),
    *("connection_names", "pairs", "points_m", "areas_m2", "normals", "second_moments_m4"),
    *("connection_forces_n", "connection_moments_nm", "connection_peaks_n"),
    *("connection_peak_forces_n", "connection_peak_moments_nm"),
    *("balls", "ball_times_s", "ball_impulses_ns", "ball_velocities_m_s"),
}
STORED_OF_WORK = {
    "work_of_gravity_j",
    "work_of_loads_j",
    "work_of_tools_j",
    "lost_to_damping_j",
    "dissipated_between_bodies_j",
    "dissipated_by_bars_j",
    "dissipated_by_crack_friction_j",
    "made_by_connections_j",
    "made_by_contacts_j",
    "made_by_lifting_j",
    "made_by_solver_j",
}
"""Of these, earlier versions recorded nothing."""

# Some units in the last place of numbers around 5000.
ROUNDING_N = 1e-11


def test_resultants_of_bodies_at_rest_are_their_weights():
    resultants = hanging_chain().frames.loads.body_forces_n
    assert resultants.shape == (5, 4, 3)
    upper, lower = resultants[1, 1], resultants[1, 2]
    np.testing.assert_allclose([upper, lower], [[0, 0, 300 * G], [0, 0, 200 * G]], atol=ROUNDING_N)
    np.testing.assert_allclose(
        hanging_chain().frames.loads.body_peaks_n[1], [500 * G, 300 * G, 200 * G, 0.0], atol=ROUNDING_N
    )


def test_forces_cancel_over_all_bodies_in_every_frame():
    results = hanging_chain()
    assert results.frames.loads.body_forces_n[1:].any(axis=(1, 2)).all()
    np.testing.assert_allclose(results.frames.loads.body_forces_n.sum(axis=1), 0.0, atol=ROUNDING_N)
    np.testing.assert_allclose(results.frames.loads.body_contact_impulses_ns.sum(axis=1), 0.0, atol=ROUNDING_N)


def test_sums_of_magnitudes():
    results = hanging_chain()
    sums, peaks = results.frames.loads.body_sums_n, results.frames.loads.body_peak_sums_n
    assert sums.shape == peaks.shape == (5, 4)
    np.testing.assert_allclose(sums[1], [500 * G, 700 * G, 200 * G, 0.0], atol=ROUNDING_N)
    np.testing.assert_allclose(peaks[1], [500 * G, 700 * G, 200 * G, 0.0], atol=ROUNDING_N)
    # In frame 5 the lower connection pulls with its 200 kg and, half of the time, 1 kN across.
    assert peaks[3, 2] == pytest.approx(((200 * G) ** 2 + 1000**2) ** 0.5)
    assert sums[3, 2] == pytest.approx((200 * G + ((200 * G) ** 2 + 1000**2) ** 0.5) / 2)


def test_means_and_peaks_of_connections():
    results = hanging_chain()
    # On upper, by lower in frame 5: 1 kN along x in five of ten sub-steps.
    np.testing.assert_allclose(results.frames.loads.connection_forces_n[3, 1], [500, 0, -200 * G], atol=ROUNDING_N)
    np.testing.assert_allclose(
        results.frames.loads.connection_peak_forces_n[3, 1], [1000, 0, -200 * G], atol=ROUNDING_N
    )
    assert results.frames.loads.connection_peaks_n[3, 1] == pytest.approx(np.hypot(1000, 200 * G))
    assert not results.frames.loads.connection_forces_n[4, 1].any()  # broken
    assert (
        not results.frames.loads.connection_moments_nm.any()
        and not results.frames.loads.connection_peak_moments_nm.any()
    )


def test_the_impulse_that_stops_the_ball_is_what_it_falls_with():
    """Momentum: what the contact gave and what gravity gave are what changed, in every frame and every sub-step."""
    results = hanging_chain()
    mass = results.inventory.masses_kg[3]
    frames = mass * np.diff(results.frames.velocities_m_s[:, 3], axis=0)
    # The ball is held up to frame 3; from then on gravity acts in every frame.
    np.testing.assert_allclose(
        frames[1:], results.frames.loads.body_contact_impulses_ns[2:, 3] + mass * FRAME_S * GRAVITY, atol=ROUNDING_N
    )
    substeps = mass * np.diff(results.balls.velocities_m_s[:, 0], axis=0)
    gravity = mass * SUBSTEP_S * GRAVITY
    np.testing.assert_allclose(
        substeps[SUBSTEPS:], results.balls.impulses_ns[SUBSTEPS + 1 :, 0] + gravity, atol=ROUNDING_N
    )
    in_frames = results.balls.impulses_ns.reshape(4, SUBSTEPS, 3).sum(axis=1)
    np.testing.assert_allclose(in_frames, results.frames.loads.body_contact_impulses_ns[1:, 3], atol=ROUNDING_N)
    # 6 g over half a frame of 0.04 s, on the ledge downwards.
    np.testing.assert_allclose(results.frames.loads.body_contact_impulses_ns[4, 0], [0, 0, -120 * G], atol=ROUNDING_N)
    assert not results.frames.loads.body_contact_impulses_ns[4, 1:3].any()


def test_stress_is_that_in_the_middle_of_each_hanging_body():
    results = hanging_chain()
    stresses = np.zeros((4, 3, 3))
    # What hangs below, and half of itself, over 1 m² and 0.5 m².
    stresses[1, 2, 2], stresses[2, 2, 2] = (200 + 150) * G, 100 * G / 0.5
    np.testing.assert_allclose(results.frames.loads.stresses_pa[1], stresses, atol=ROUNDING_N)
    np.testing.assert_allclose(results.frames.loads.von_mises_pa[1], [0, 350 * G, 200 * G, 0], atol=ROUNDING_N)
    # Frame 5: 1 kN across, 2 m from the middles, in opposite senses; half of its moment turns the bodies, and half of
    # the time there is none. Shear 1000 × 2 / 2 over 4 m³ and 2 m³.
    assert results.frames.loads.stresses_pa[3, 1:3, 0, 2] == pytest.approx([-125, -250])
    equivalent = [np.sqrt((350 * G) ** 2 + 3 * 250**2), np.sqrt((200 * G) ** 2 + 3 * 500**2)]
    assert results.frames.loads.von_mises_pa[3, 1:3] == pytest.approx(equivalent)


def test_numbers_of_2019_are_added_for_first_and_taken_off_for_second_bodies():
    signed = hanging_chain().frames.loads.body_signed_2019_n
    np.testing.assert_allclose(signed[1], [-500 * G, 700 * G, -200 * G, 0.0], atol=ROUNDING_N)


def test_in_the_first_frame_no_time_passes_and_nothing_acts():
    results = hanging_chain()
    assert results.frames.substep_s[0] == results.frames.time_s[0] == 0.0
    loads = results.frames[0].loads
    known = {item.name: getattr(loads, item.name) for item in fields(loads)}
    assert known.pop("body_bar_use") is None and known.pop("connection_bars") is None and len(known) == 13
    for name, values in known.items():
        assert not values.any(), name


def test_bodies_of_a_kind():
    results = hanging_chain()
    assert results.inventory.of_kind("shard").tolist() == [1, 2]
    assert results.inventory.of_kind("ball").tolist() == [3]
    assert results.inventory.of_kind("charge").tolist() == []


def test_without_connections_nothing_is_held():
    results = without_connections(hanging_chain())
    assert results.frames.loads.body_forces_n.shape == (5, 4, 3)
    assert not results.frames.loads.body_forces_n[:4].any() and not results.frames.loads.body_peak_sums_n[:4].any()
    # Only the contact of the ball is left, in the last frame.
    np.testing.assert_allclose(
        results.frames.loads.body_forces_n, results.frames.loads.body_contact_impulses_ns / FRAME_S, atol=ROUNDING_N
    )
    assert results.frames.loads.body_peak_sums_n[4].tolist() == [6000 * G, 0, 0, 6000 * G]
    assert not results.frames.loads.body_signed_2019_n.any()


@pytest.mark.parametrize("results", [hanging_chain(), without_connections(hanging_chain())], ids=["chain", "loose"])
def test_files_come_back_as_they_were_written(tmp_path, results):
    path = tmp_path / "results.npz"
    results.save(path)
    again = load_results(path).arrays()
    assert set(again) == set(results.arrays())
    for name, written in results.arrays().items():
        written, read = np.asarray(written), np.asarray(again[name])
        assert written.dtype == read.dtype and np.array_equal(written, read), name


def test_a_file_is_readable_without_us(tmp_path):
    hanging_chain().save(tmp_path / "results.npz")
    with np.load(tmp_path / "results.npz", allow_pickle=False) as stored:
        assert stored["masses_kg"].tolist() == [0, 300, 200, 1000]


def test_texts_and_series_come_back_as_what_they_were(tmp_path):
    hanging_chain().save(tmp_path / "results.npz")
    again = load_results(tmp_path / "results.npz")
    assert again.load_sampling == "every sub-step"
    assert again.inventory.connection_names.tolist() == ["Connection", "Connection.001"]
    assert again.frames.asleep.dtype == again.frames.intact.dtype == bool
    assert len(again.frames) == 5
    assert [frame.number for frame in again.frames] == [2, 3, 4, 5, 6]
    assert again.frames[3].loads.body_sums_n.tolist() == hanging_chain().frames.loads.body_sums_n[3].tolist()


def test_arrays_in_the_file_keep_their_names(tmp_path):
    hanging_chain().save(tmp_path / "results.npz")
    with np.load(tmp_path / "results.npz", allow_pickle=False) as stored:
        assert set(stored) == STORED | STORED_OF_WORK


def test_files_from_before_work_was_recorded_are_read(tmp_path):
    arrays = hanging_chain().arrays()
    np.savez(tmp_path / "results.npz", **{name: arrays[name] for name in STORED})
    work = load_results(tmp_path / "results.npz").frames.work
    assert work.made_j.shape == (5, 4) and np.isnan(work.made_j).all()
    assert work.gravity_j.shape == (5,) and np.isnan(work.gravity_j).all()


def write_no_file(path):
    pass


def write_nothing(path):
    path.write_bytes(b"")


def write_text(path):
    path.write_text("frame,time_s\n")


def write_lone_array(path):
    with path.open("wb") as file:
        np.save(file, np.zeros(3))


def write_other_arrays(path):
    np.savez(path, frames=np.zeros(3))


def write_half(path):
    hanging_chain().save(path)
    path.write_bytes(path.read_bytes()[:2000])


def write_damaged(path):
    np.savez(path, **hanging_chain().arrays())
    content = path.read_bytes()
    middle = content.index(np.float64(500 * G).tobytes())
    path.write_bytes(content[:middle] + bytes(8) + content[middle + 8 :])


@pytest.mark.parametrize(
    "write", [write_nothing, write_text, write_lone_array, write_other_arrays, write_half, write_damaged, write_no_file]
)
def test_other_files_are_refused(tmp_path, write):
    path = tmp_path / "results.npz"
    write(path)
    with pytest.raises(OutputError, match=r"results\.npz: expected the results of a run"):
        load_results(path)


@pytest.mark.parametrize(
    ("name", "values", "said"),
    [
        ("contact_bodies", np.array([[0, 1], [1, 0], [0, 4], [0, 1]]), "expected whole numbers from 0 to 3"),
        ("contact_bodies", np.array([[0, 1], [1, 0], [-1, 0], [0, 1]]), "expected whole numbers from 0 to 3"),
        ("contact_frames", np.array([3, 6, 5, 6]), "expected numbers that do not fall"),
        ("contact_places_m", np.full((4, 3), np.nan), "expected numbers of at most"),
        ("contact_normals", np.zeros((3, 3)), "expected a length of 4, as in contact_frames"),
    ],
)
def test_contacts_that_no_run_writes_are_refused(tmp_path, name, values, said):
    changed(with_contacts(hanging_chain()), **{name: values}).save(tmp_path / "results.npz")
    with pytest.raises(OutputError, match=f"{name}: {said}"):
        load_results(tmp_path)
