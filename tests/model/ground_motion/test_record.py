# SPDX-License-Identifier: GPL-3.0-or-later
"""Motion of the ground by accelerations that are known: integrals by hand, and what a baseline leaves."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from support.checkout import EXAMPLES, REPORT_2019

from bridge_demolition_addon.engineering.ground_motion import corrected, integrated
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.ground_motion.record_files import read_record, record_text
from bridge_demolition_addon.model.ground_motion.settings import GroundMotion, Sweep
from bridge_demolition_addon.model.ground_motion.sources import ground_record
from bridge_demolition_addon.model.scenario.file import files_of, read_scenario
from bridge_demolition_addon.model.study.keys import changed, keys_named

TIMES_S = np.linspace(0.0, 4.0, 401)


def along(values):
    return np.column_stack((values, np.zeros((len(values), 2))))


def test_a_straight_line_of_acceleration_is_integrated_exactly_also_between_samples():
    """a = 6 t - 1: v = 3 t² - t, d = t³ - t² / 2."""
    record = integrated(TIMES_S, along(6.0 * TIMES_S - 1.0))
    assert record.velocities_m_s[:, 0] == pytest.approx(3.0 * TIMES_S**2 - TIMES_S, abs=1e-12)
    for time_s in (0.0, 0.013, 1.2345, 3.999, 4.0):
        assert record.displacement_at(time_s) == pytest.approx([time_s**3 - time_s**2 / 2.0, 0.0, 0.0], abs=1e-11)
    assert record.displacement_at(-1.0).tolist() == [0.0, 0.0, 0.0]
    assert record.displacement_at(9.0) == pytest.approx([56.0, 0.0, 0.0])


@pytest.mark.parametrize("baseline", ["linear", "parabola"])
def test_a_baseline_ends_at_rest_where_the_ground_began_and_takes_a_drift_off(baseline):
    """Two cycles of a sine end at rest; with 1 m/s² more throughout they would not. That is taken off exactly."""
    sine = np.sin(np.pi * TIMES_S) ** 2 * np.sin(2.0 * np.pi * TIMES_S)
    clean = corrected(TIMES_S, along(sine), baseline)
    drifting = corrected(TIMES_S, along(sine + 1.0), baseline)
    for record in (clean, drifting):
        assert abs(record.velocities_m_s[-1]).max() < 1e-12
        assert abs(record.displacements_m[-1]).max() < 1e-12
    assert drifting.accelerations_m_s2 == pytest.approx(clean.accelerations_m_s2, abs=1e-11)


def test_a_parabola_leaves_less_velocity_than_a_line():
    drift = along(np.sin(2.0 * np.pi * TIMES_S) + 0.1 * TIMES_S**3)
    line, parabola = (corrected(TIMES_S, drift, correction).velocities_m_s for correction in ("linear", "parabola"))
    assert 0.0 < (parabola**2).sum() < 0.5 * (line**2).sum()


def test_without_a_baseline_a_record_has_to_end_at_rest():
    with pytest.raises(ScenarioError, match="the record ends with 4 m/s, 100% of its largest velocity"):
        corrected(TIMES_S, along(np.ones_like(TIMES_S)), "none")
    there_and_on = along(np.where(TIMES_S < 2.0, 1.0, -1.0))
    assert corrected(TIMES_S, there_and_on, "none").displacements_m[-1, 0] == pytest.approx(4.0, rel=0.01)


def test_a_sweep_has_its_acceleration_in_every_cycle_and_its_frequencies():
    """The straight line of the baseline shifts the cycles: by less than 3 % here."""
    motion = GroundMotion(
        directions=("across", "up"),
        sweep=Sweep(from_hz=1.0, to_hz=4.0, duration_s=10.0, acceleration_m_s2=2.0),
        factor=0.5,
    )
    record = ground_record(motion, seed=0)
    swept = record.accelerations_m_s2[:, 1]
    assert (record.accelerations_m_s2[:, 2] == swept).all() and not record.accelerations_m_s2[:, 0].any()
    crossings = record.times_s[np.flatnonzero(np.diff(np.sign(swept)) > 0)]
    peaks = [abs(swept[(record.times_s >= a) & (record.times_s < b)]).max() for a, b in itertools.pairwise(crossings)]
    assert peaks[2:-2] == pytest.approx(np.ones(len(peaks) - 4), rel=0.03)
    # 25 cycles: the mean of both frequencies times 10 s. The last one but one has nearly the last frequency.
    assert len(crossings) == pytest.approx(25, abs=1)
    assert 1.0 / (crossings[-3] - crossings[-4]) == pytest.approx(4.0, rel=0.1)


RECORD = "time,a,b\n0.00,0.1,0\n0.01,0.2,0.1\n0.02,-0.1,0\n0.03,-0.2,-0.1\n0.04,0,0\n"


def written(tmp_path, text=RECORD, unit="g", directions=("along", "up"), **more):
    path = tmp_path / "record.csv"
    path.write_text(text, encoding="utf-8")
    return GroundMotion(file=str(path), unit=unit, directions=directions, **more)


@pytest.mark.parametrize(("unit", "factor"), [("g", STANDARD_GRAVITY_M_S2), ("m/s2", 1.0), ("cm/s2", 0.01)])
def test_an_accelerogram_is_read_in_its_unit_and_directions(tmp_path, unit, factor):
    read = ground_record(written(tmp_path, RECORD.replace(",", ";"), unit, baseline="linear"), seed=0)
    given = factor * np.array([[0.1, 0.2, -0.1, -0.2, 0.0], [0.0, 0.0, 0.0, 0.0, 0.0], [0.0, 0.1, 0.0, -0.1, 0.0]]).T
    assert read.duration_s == pytest.approx(0.04)
    # Along and up are as given but for one straight line each.
    off = read.accelerations_m_s2 - given
    assert abs(np.diff(off, n=2, axis=0)).max() < 1e-9 * factor
    assert not off[:, 1].any()


@pytest.mark.parametrize(
    ("change", "more", "said"),
    [
        (("0.02,", "0.01,"), {}, "row 4: the time is 0.01 s after 0.01 s: expected times that increase"),
        (("0.04,0", "0.07,0"), {}, "row 6: a gap of 0.04 s after 0.03 s, where samples are 0.01 s apart"),
        (("0.2,0.1", "nan,0.1"), {}, 'row 3: expected finite numbers, found "0.01, nan, 0.1"'),
        (("0.2,0.1", "x,0.1"), {}, 'row 3: expected numbers, found "0.01, x, 0.1"'),
        (("0.2,0.1", '"0.2",x' + "9" * 500), {}, 'row 3: expected numbers, found "0.01, 0.2, x9{20,80}'),
        (("", ""), {"directions": ("along",)}, "row 2: has 3 columns: expected 2, the time in s and an acceleration"),
        (("0.01,0.2,0.1", "0,01;0,2;0,1"), {}, "row 2: has 1 columns: expected 3"),
        (("0.2,", "6.2,"), {}, 'ground_motion.unit is "g", by which .* has up to 6.2 g: expected at most 5 g'),
        (("0.03,-0.2,-0.1\n0.04,0,0\n", ""), {}, "an accelerogram of at least 4 rows, found 3"),
    ],
)
def test_a_wrong_accelerogram_is_refused_in_words(tmp_path, change, more, said):
    with pytest.raises(ScenarioError, match=said):
        ground_record(written(tmp_path, RECORD.replace(*change), **more), seed=0)


def test_a_file_that_is_not_there_and_one_of_zeros_are_refused(tmp_path):
    motion = GroundMotion(file=str(tmp_path / "none.csv"), unit="g", directions=("along",))
    with pytest.raises(ScenarioError, match=r"ground_motion.file is .*none.csv.*: no such file"):
        ground_record(motion, seed=0)
    with pytest.raises(ScenarioError, match="all accelerations are 0"):
        ground_record(written(tmp_path, "0,0,0\n1,0,0\n2,0,0\n3,0,0\n"), seed=0)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"directions": ["along"]}, "ground_motion has no file, sweep or spectrum: give one of them"),
        ({"directions": ["along"], "file": "a.csv"}, "ground_motion.unit is missing: expected one of g, m/s2, cm/s2"),
        ({"directions": ["along", "along"], "file": "a.csv", "unit": "g"}, "names one twice"),
        ({"directions": ["north"], "file": "a.csv", "unit": "g"}, r'directions.1 is "north"'),
        ({"directions": [], "file": "a.csv", "unit": "g"}, "directions is a list of length 0"),
    ],
)
def test_wrong_keys_are_refused_in_words(given, said):
    with pytest.raises(ScenarioError, match=said):
        GroundMotion(**given)


@pytest.mark.slow
def test_a_study_can_vary_the_factor_and_a_draw_depends_on_the_file(tmp_path):
    """The example's record is made: it names no file; one that is named counts by what is in it."""
    scenario = read_scenario(EXAMPLES / "ground_motion" / "span_in_an_earthquake.toml")
    assert list(files_of(scenario)) == []
    (key,) = keys_named(scenario, "ground_motion.factor")
    stronger = changed(scenario, {key: 1.5})
    peaks = [motion.ground_record.peaks()["accelerations_m_s2"][0] for motion in (scenario, stronger)]
    assert peaks[1] == pytest.approx(1.5 * peaks[0])
    motion = written(tmp_path)
    assert list(files_of(replace(scenario, ground_motion=motion))) == [tmp_path / "record.csv"]


def test_a_record_is_written_and_read_back(tmp_path):
    record = ground_record(written(tmp_path), seed=0)
    path = tmp_path / "kept.csv"
    path.write_text(record_text(record, 1.5), encoding="utf-8")
    read, start_s = read_record(path)
    assert start_s == 1.5
    assert read.times_s == pytest.approx(record.times_s)
    assert read.displacements_m == pytest.approx(record.displacements_m, abs=1e-12)
    path.write_text("time_s\n1\n", encoding="utf-8")
    with pytest.raises(ScenarioError, match="expected the motion of the ground"):
        read_record(path)


def test_tools_that_machines_hold_and_late_records_are_refused():
    """They would not move with the ground."""
    motion = read_scenario(EXAMPLES / "ground_motion" / "span_in_an_earthquake.toml").ground_motion
    hammers = read_scenario(REPORT_2019 / "jackhammer_dismantling.toml")
    with pytest.raises(ScenarioError, match="jackhammers is given together with ground_motion"):
        replace(hammers, ground_motion=motion)
    plain = read_scenario(REPORT_2019 / "single_span_awake.toml")
    assert replace(plain, ground_motion=motion).ground_record.duration_s == pytest.approx(17.0)
    with pytest.raises(ScenarioError, match=r"ground_motion\.start_s is 3\.0: expected less than time\.duration_s"):
        replace(plain, ground_motion=replace(motion, start_s=3.0))
