# SPDX-License-Identifier: GPL-3.0-or-later
"""Decks on bearings in Blender's own simulation: what they carry at rest, and how they slide, lift off and break."""

import csv
import json

import numpy as np
import pytest
from support.bearing_decks import OVERHANG_M, PINNED_AND_ROCKERS, TOP_M, WEIGHT_N_M, deck_text, standing_deck

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.results.arrays import load_results
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.report.run_folder import read_run
from bridge_demolition_addon.report.sections.forces import force_section
from bridge_demolition_addon.simulation.run import run_scenario

SPAN_M = 10.0
WEIGHT_N = WEIGHT_N_M * (SPAN_M + 2.0 * OVERHANG_M)


@pytest.fixture
def run(blender, tmp_path):
    def ran(text):
        path = tmp_path / "deck.toml"
        path.write_text(text, encoding="utf-8")
        run_scenario(read_scenario(path), tmp_path / "run", overwrite=True, pictures=False, progress=Silence())
        return load_results(tmp_path / "run" / "results.npz")

    return ran


def forces_n(results, wall):
    """Force (k, 3) of a wall on the deck in each frame."""
    inventory = results.inventory
    above, below = np.array(inventory.body_members)[inventory.pairs.T]
    rows = (above == "deck") & (below == wall)
    return results.frames.loads.connection_forces_n[:, rows].astype(float).sum(axis=1)


def log_of(folder):
    """Lines of the log of bearings."""
    with (folder / "run" / "bearing_log.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def bearings_of(folder):
    """What the summary says of bearings."""
    return json.loads((folder / "run" / "summary.json").read_text(encoding="utf-8"))["bearings"]


def deck_position_m(results):
    """Centre of mass (k, 3) of the deck in each frame."""
    inventory = results.inventory
    deck = np.flatnonzero(np.array(inventory.body_members) == "deck")
    masses = inventory.masses_kg[deck]
    return (results.frames.positions_m[:, deck] * masses[:, None]).sum(axis=1) / masses.sum()


def load(direction, times_s, forces_n, more=""):
    return (
        f'[[loads]]\nmembers = ["deck"]\ndirection = {list(direction)}\ntimes_s = {list(times_s)}\n'
        f"forces_n = {list(forces_n)}\n{more}"
    )


def test_a_run_begins_and_stays_at_rest_as_stages_have_it(run, tmp_path):
    text = deck_text(spans=(10.0, 15.0), shards=40, support_m=1.2)
    results = run(text)
    at_rest = standing_deck(text)[2]
    for wall, bearing in at_rest.items():
        assert forces_n(results, wall)[1:, 2] == pytest.approx(bearing.force_n[2], rel=1e-3)
    assert results.frames.intact.all()
    names = [f"deck on {wall}" for wall in at_rest]
    tables = {block.name: block for block in force_section(read_run(tmp_path / "run")).blocks if hasattr(block, "name")}
    assert [row[0] for row in tables["bearings"].rows] == names
    for row, bearing in zip(tables["bearings"].rows, at_rest.values(), strict=True):
        assert row[1:4] == pytest.approx([bearing.force_n[2] / 1e3] * 3, rel=1e-3)
        assert row[-1] == 100.0
    logged = log_of(tmp_path)
    assert list(dict.fromkeys(line["bearing"] for line in logged)) == names
    for line, bearing in zip(logged[-3:], at_rest.values(), strict=True):
        force_n = [float(line[f"force_{axis}_N"]) for axis in "xyz"]
        moment_nm = [float(line[f"moment_{axis}_Nm"]) for axis in "xyz"]
        assert force_n == pytest.approx(bearing.force_n, abs=1e-4 * WEIGHT_N)
        assert moment_nm == pytest.approx(bearing.moment_nm, abs=1e-4 * WEIGHT_N)
        assert float(line["open_share"]) == 0.0
        assert float(line["slip_m"]) < 1e-6


def asleep(text):
    """The same deck, asleep until something wakes it."""
    awake = "use_deactivation = false\nstart_deactivated = false"
    assert awake in text
    return text.replace(awake, "use_deactivation = true\nstart_deactivated = true")


@pytest.mark.long
def test_what_bearings_carry_is_not_known_while_a_deck_sleeps(run, tmp_path):
    """It carries its weight all the same, and has not lifted off: once it is pushed, its bearings have all of it."""
    deck = {"spans": (SPAN_M,), "shards": 12, "support_m": 1.2}
    run(asleep(deck_text(PINNED_AND_ROCKERS, **deck)))
    assert (
        {line["force_z_N"] for line in log_of(tmp_path)} == {line["open_share"] for line in log_of(tmp_path)} == {"nan"}
    )
    assert bearings_of(tmp_path) == []
    names = {getattr(block, "name", "") for block in force_section(read_run(tmp_path / "run")).blocks}
    assert "bearings" not in names

    push = load((0, 0, -1), (0.1, 0.11, 1.0), (0.0, 1000.0, 1000.0))
    run(asleep(deck_text(PINNED_AND_ROCKERS, **deck, duration_s=0.4, more=push)))
    assert log_of(tmp_path)[0]["force_z_N"] == "nan"
    upwards_n = [float(line["force_z_N"]) for line in log_of(tmp_path)[-2:]]
    assert sum(upwards_n) == pytest.approx(WEIGHT_N + 1000.0, rel=0.01)
    for bearing in bearings_of(tmp_path):
        assert bearing["at_rest_up_N"] is None and not bearing["opened"]
    (extremes,) = (
        block for block in force_section(read_run(tmp_path / "run")).blocks if getattr(block, "name", "") == "bearings"
    )
    assert [cells[1] for cells in extremes.rows] == [None, None]


@pytest.mark.long
def test_a_deck_slides_where_friction_ends(run, tmp_path):
    """Pushed with 0.15 of its weight against a friction of 0.1, it is moved by the difference, a twentieth of g."""
    push = load((1, 0, 0), (0.05, 0.1, 1.0), (0.0, 0.15 * WEIGHT_N, 0.15 * WEIGHT_N))
    sliding = (("pier", 'kind = "sliding"\nfriction = 0.1'),)
    results = run(deck_text(sliding, spans=(SPAN_M,), shards=12, support_m=1.2, duration_s=0.4, more=push))
    along_m = deck_position_m(results)[:, 0]
    assert abs(along_m[2] - along_m[1]) < 1e-5  # in frame 0 it is as it was built
    total = forces_n(results, "pier 1") + forces_n(results, "pier 2")
    late = slice(12, None)
    assert total[late, 0] == pytest.approx(-0.1 * total[late, 2], rel=0.01)
    frame_s = 1.0 / 50.0
    time_s = frame_s * np.arange(len(along_m))
    speed_m_s = np.diff(along_m)[late].mean() / frame_s
    middle_s = time_s[late].mean()
    # It is pushed in full from 0.1 s on, and slides since the load was 0.1 of the weight, at 0.05 + 0.05 / 1.5 s.
    begun_s = 0.1 - 0.5 * (0.05 / 0.15) * 0.05
    for bearing in bearings_of(tmp_path):
        assert bearing["slid"]
        assert not bearing["opened"]
        moved_m = along_m[-1] - along_m[0]
        assert bearing["slip_m"] == pytest.approx(moved_m, rel=0.02)
        assert bearing["largest_displacement_m"] == pytest.approx(moved_m, rel=0.02)
        assert bearing["largest_horizontal_N"] == pytest.approx(0.1 * bearing["largest_up_N"], rel=0.02)
    assert speed_m_s == pytest.approx(0.05 * STANDARD_GRAVITY_M_S2 * (middle_s - begun_s), rel=0.02)


def test_a_deck_lifts_off_its_far_support(run, tmp_path):
    """A load on one of two spans grows slowly, to where the other end of the deck hangs in the air."""
    load_n = 1.5e6
    more = load((0, 0, -1), (0.0, 0.6), (0.0, load_n), f"point_m = [17.5, 0.0, {TOP_M}]\n")
    results = run(deck_text(spans=(10.0, 15.0), shards=40, duration_s=0.8, more=more))
    lifted = forces_n(results, "pier 1")
    assert lifted[1, 2] == pytest.approx(forces_n(results, "pier 3")[1, 2] * 171.8 / 337.6, rel=0.1)
    assert not lifted[-5:].any()
    inventory = results.inventory
    is_far = np.array(inventory.body_members)[inventory.pairs[:, 1]] == "pier 1"
    # Lifted by 20 mm it is out of its pins, and left for good.
    assert (results.frames.intact[-1] == ~is_far).all()
    far, *others = bearings_of(tmp_path)
    assert far["opened"]
    assert 0.0 < far["opened_s"] < 0.7
    assert far["least_up_N"] == pytest.approx(0.0, abs=1e-5 * WEIGHT_N)
    assert far["largest_open_share"] == 1.0
    assert far["left_share"] == 0.0
    assert not any(bearing["opened"] for bearing in others)
    middle, last = (forces_n(results, wall)[-20:, 2].mean() for wall in ("pier 2", "pier 3"))
    weight_n = WEIGHT_N_M * 26.0
    assert last == pytest.approx((weight_n * 2.5 + load_n * 7.5) / 15.0, rel=0.1)
    assert middle + last == pytest.approx(weight_n + load_n, rel=0.1)


@pytest.mark.long
def test_a_bearing_breaks_as_a_whole_and_the_deck_comes_off(run, tmp_path):
    """It resists 300 kN along the road, which the load passes at 0.1 s; the rocker is left after 0.2 m."""
    push = load((1, 0, 0), (0.0, 0.1, 2.0), (0.0, 3e5, 6e6))
    bearings = (("pier 1", 'kind = "pinned"\nbreaking_force_n = 3e5'), PINNED_AND_ROCKERS[1])
    results = run(deck_text(bearings, spans=(SPAN_M,), shards=12, support_m=0.4, duration_s=0.8, more=push))
    inventory = results.inventory
    below = np.array(inventory.body_members)[inventory.pairs[:, 1]]
    broken_in = {
        wall: (~results.frames.intact[:, below == wall]).argmax(axis=0).tolist() for wall in ("pier 1", "pier 2")
    }
    assert len(set(broken_in["pier 1"])) == 1
    assert 4 <= broken_in["pier 1"][0] <= 7
    pinned, rocker = bearings_of(tmp_path)
    assert pinned["gone_s"] == pytest.approx(broken_in["pier 1"][0] / 50.0)
    assert 3e5 < pinned["largest_horizontal_N"] < 1.2 * 3e5
    assert rocker["gone_s"] > pinned["gone_s"]
    assert rocker["largest_displacement_m"] == pytest.approx(0.2, abs=0.03)
    moved_m = deck_position_m(results)[:, 0] - deck_position_m(results)[0, 0]
    for frame in broken_in["pier 2"]:
        assert moved_m[frame - 1] < 0.21
        assert moved_m[frame] > 0.19


def impulses_ns(folder):
    """Impulse (k, 3) of all bearings on the deck in each frame of the log, and the length (k,) of these, s."""
    forces, times = {}, {}
    for line in log_of(folder):
        frame = int(line["frame"])
        times[frame] = float(line["time_s"])
        forces[frame] = forces.get(frame, 0.0) + np.array([float(line[f"force_{axis}_N"]) for axis in "xyz"])
    durations_s = np.diff(list(times.values()), prepend=0.0)
    return durations_s[:, None] * np.array(list(forces.values())), durations_s


def test_impulses_of_bearings_and_weight_are_the_change_of_momentum(run, tmp_path):
    """A load lets go after 0.1 s, and the deck swings on one fixed, one pinned and one elastomeric bearing."""
    bearings = (
        ("pier 1", 'kind = "fixed"'),
        ("pier 2", 'kind = "elastomeric"\nstiffness_mn_m = 500\nshear_mn_m = 5\npads = 2'),
        ("pier 3", 'kind = "sliding"\nfriction = 0.05'),
    )
    more = load((0.3, 0.0, -1.0), (0.0, 0.1, 0.101), (0.0, 3e5, 0.0), f"point_m = [17.5, 0.0, {TOP_M}]\n")
    results = run(deck_text(bearings, shards=20, duration_s=0.4, more=more))
    assert results.frames.intact.all()
    deck = np.array(results.inventory.body_members) == "deck"
    masses_kg = results.inventory.masses_kg[deck]
    momentum = (masses_kg[:, None] * results.frames.velocities_m_s[:, deck].astype(float)).sum(axis=1)
    impulses, durations_s = impulses_ns(tmp_path)
    impulses[:, 2] -= STANDARD_GRAVITY_M_S2 * masses_kg.sum() * durations_s
    free = slice(6, None)  # the load has gone
    assert abs(impulses[free]).max() > 100.0
    assert impulses[free] == pytest.approx(np.diff(momentum, axis=0)[free], abs=1e-3 * abs(impulses[free]).max())


@pytest.mark.parametrize(("shards", "seed"), [(24, 1), (40, 3)])
def test_reactions_at_rest_balance_weight_and_moments(run, tmp_path, shards, seed):
    """Of a deck that is clamped at one end: the moment of the fixed bearing is part of the balance."""
    bearings = (("pier 1", 'kind = "fixed"\npad_m = [0.5, 0.4]\npads = 3\ntension = true'), PINNED_AND_ROCKERS[1])
    results = run(deck_text(bearings, shards=shards, seed=seed, duration_s=0.04))
    lines = log_of(tmp_path)[:3]
    up_n = np.array([float(line["force_z_N"]) for line in lines])
    about_y_nm = [float(line["moment_y_Nm"]) for line in lines]
    weight_n = WEIGHT_N_M * 26.0
    assert up_n.sum() == pytest.approx(weight_n, rel=1e-3)
    # About x = 0: a force up at x has the moment -x F about y, and the weight is in the middle, at 12.5 m.
    assert sum(about_y_nm) - up_n @ (0.0, 10.0, 25.0) == pytest.approx(-12.5 * weight_n, rel=1e-3)
    assert abs(about_y_nm[0]) > 0.01 * weight_n
    assert about_y_nm[1:] == pytest.approx([0.0, 0.0], abs=1e-5 * weight_n)
    assert results.frames.intact.all()


@pytest.mark.long
def test_uplift_where_a_support_is_taken_away(run, tmp_path):
    """The end of the longer span hangs free then, and the other end is held down: by 2.5 m / 10 m of the weight."""
    bearings = (("pier 1", 'kind = "pinned"\ntension = true'), PINNED_AND_ROCKERS[1])
    removal = '[[removals]]\ntime_s = 0.1\nmembers = ["pier 3"]\n'
    held = "".join(f'[[supports]]\nmember = "pier {number}"\n' for number in (1, 2))
    run(deck_text(bearings, shards=24, duration_s=1.4, are_held=False, more=held + removal))
    first, middle, last = bearings_of(tmp_path)
    weight_n = WEIGHT_N_M * 26.0
    assert first["least_up_N"] < -0.25 * weight_n < 0.0 < first["at_rest_up_N"]
    assert last["gone_s"] == pytest.approx(0.12, abs=0.021)
    assert last["left_share"] == 0.0
    assert last["least_up_N"] > 0.0
    assert middle["largest_up_N"] > 1.25 * weight_n
    up_n = np.array([float(line["force_z_N"]) for line in log_of(tmp_path)]).reshape(-1, 3)
    # It swings about its rest: the mean from one lowest force to the next.
    begin = int(up_n[:, 0].argmin())
    end = begin + 20 + int(up_n[begin + 20 :, 0].argmin())
    assert up_n[begin:end].mean(axis=0) == pytest.approx([-0.25 * weight_n, 1.25 * weight_n, 0.0], abs=0.01 * weight_n)
