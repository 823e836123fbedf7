# SPDX-License-Identifier: GPL-3.0-or-later
"""The charts on blast: what their lines say, in the units on their axes, and that every picture is one."""

import warnings
from functools import cache
from io import BytesIO

import numpy as np
import pytest
from matplotlib.image import imread

from bridge_demolition_addon.charts.blast_design import (
    CHARTS,
    TARGETS_PA,
    ChartSettings,
    charge_for_overpressure,
    overpressure_contours,
    pressure_over_time,
    two_span_charges,
    two_span_over_time,
    two_span_rings,
    two_span_total,
    write_charts,
)
from bridge_demolition_addon.charts.style import lay_out
from bridge_demolition_addon.engineering.blast.pulses import BlastModel, blast_wave
from bridge_demolition_addon.engineering.blast.wave import Burst
from bridge_demolition_addon.errors import OutputError

pytestmark = pytest.mark.slow

KPA, RATIO = ChartSettings(), ChartSettings(as_ratio=True)
SCALED = ChartSettings(scaled=True)
GROUND = ChartSettings(model=BlastModel.KINNEY_GRAHAM, burst=Burst.SURFACE, as_ratio=True, scaled=True)
SMALL = ChartSettings(pulse_charge_kg=8.0, pier_charge_kg=8.0)
LARGE = ChartSettings(pulse_charge_kg=250_000.0, pier_charge_kg=12_500.0)


def lines(figure, axes=0):
    return {line.get_label(): line.get_xydata() for line in figure.axes[axes].lines}


def words(figure):
    axes = figure.axes[0]
    return " ".join([axes.get_title(), axes.get_xlabel(), axes.get_ylabel()])


@cache
def drawn(name, settings):
    """A chart that was drawn without a warning, and its picture."""
    with warnings.catch_warnings(), BytesIO() as file:
        warnings.simplefilter("error")
        figure = CHARTS[name](settings)
        lay_out(figure)
        figure.savefig(file)
        file.seek(0)
        return figure, imread(file)


@pytest.mark.parametrize(
    "settings",
    [
        pytest.param(KPA, id="kPa"),
        pytest.param(RATIO, id="ratio", marks=pytest.mark.long),
        pytest.param(SCALED, id="scaled", marks=pytest.mark.long),
        pytest.param(GROUND, id="ground"),
        pytest.param(SMALL, id="small", marks=pytest.mark.long),
        pytest.param(LARGE, id="large", marks=pytest.mark.long),
    ],
)
@pytest.mark.parametrize("name", CHARTS)
def test_every_chart_is_drawn_without_complaint(name, settings):
    figure, picture = drawn(name, settings)
    assert figure.axes[0].get_xlabel()
    assert figure.axes[0].get_ylabel()
    assert picture[..., :3].std() > 0.02


@pytest.mark.parametrize("name", CHARTS)
def test_no_words_leave_the_picture(name):
    for settings in (KPA, GROUND, SMALL, LARGE):
        figure, _ = drawn(name, settings)
        width, height = figure.canvas.get_width_height()
        for axes in figure.axes:
            box = axes.get_tightbbox()
            # Half a pixel of rounding.
            assert box.x0 >= -0.5 and box.y0 >= -0.5 and box.x1 <= width + 0.5 and box.y1 <= height + 0.5
        for legend in figure.legends:
            box = legend.get_window_extent()
            assert box.x0 >= -0.5 and box.y0 >= -0.5 and box.x1 <= width + 0.5
            for axes in figure.axes:
                assert not box.overlaps(axes.get_window_extent())


@pytest.mark.parametrize(
    "name", ["pressure_over_time", "charge_for_overpressure", "two_span_charges", "two_span_total"]
)
def test_lines_differ_without_colour(name):
    figure = CHARTS[name](KPA)
    looks = [(str(line._unscaled_dash_pattern), line.get_linewidth()) for line in figure.axes[0].lines]
    assert len(set(looks)) == len(looks) > 1


def test_figure_10_pulses_pass_in_order_with_their_peaks():
    pulses = list(lines(pressure_over_time(KPA)).values())
    waves = blast_wave(np.array([2.0, 2.5, 3.0, 4.0, 5.0, 7.0, 10.0]) * 10_000 ** (1 / 3), 10_000.0)
    for pulse, peak, arrival in zip(pulses, waves.peak_overpressure_pa, waves.arrival_time_s, strict=True):
        assert pulse[:, 1].max() == pytest.approx(peak / 1e3)
        assert pulse[0] == pytest.approx([1e3 * arrival, 0.0])
        assert pulse[-1, 1] == pytest.approx(0.0, abs=1e-9)
        assert (np.diff(pulse[1:, 1]) < 0.0).all()


def test_figure_10_scaled_does_not_know_the_charge():
    pulse = lines(pressure_over_time(SCALED))["Z = 5 m/kg$^{1/3}$"]
    assert pulse[0, 0] == pytest.approx(8.995, abs=5e-4)
    assert pulse[-1, 0] == pytest.approx(8.995 + 3.333, abs=1e-3)


def test_figure_10_of_another_charge():
    figure = pressure_over_time(SMALL)
    pulse = lines(figure)["10 m (Z = 5)"]
    # Times grow with the cube root of the charge, 2; the check values are those of 1 kg at Z = 5.
    assert pulse[0, 0] == pytest.approx(2 * 8.995, abs=1e-3)
    assert pulse[:, 1].max() == pytest.approx(31.30, abs=5e-3)
    assert "Pulses of 8 kg of TNT" in words(figure)


def test_figure_11_contours_lie_where_the_overpressure_is():
    axes = overpressure_contours(RATIO).axes[0]
    contours = axes.collections[-1]
    segments = dict(zip(contours.levels, contours.allsegs, strict=True))
    distances, charges = np.concatenate(segments[1.0]).T
    peaks = blast_wave(distances, charges).peak_overpressure_pa / 101_325.0
    # Straight between cells of a grid of 300 × 300 over decades.
    assert peaks == pytest.approx(np.ones(len(peaks)), rel=2e-3)


def test_figure_11_over_scaled_distance_is_one_curve():
    curves = lines(overpressure_contours(SCALED))
    distances, peaks = curves["incident"].T
    assert peaks == pytest.approx(blast_wave(distances, 1.0).peak_overpressure_pa / 1e3)
    assert (curves["reflected"][:, 1] > 2.0 * peaks).all()


def test_figure_12_charges_give_their_overpressure():
    for settings in (KPA, GROUND):
        for target, line in zip(TARGETS_PA, charge_for_overpressure(settings).axes[0].lines, strict=True):
            wave = blast_wave(*line.get_xydata().T, settings.burst, settings.model)
            assert wave.peak_overpressure_pa == pytest.approx(np.full(len(line.get_xdata()), target), rel=1e-9)


def test_figure_13_each_charge_by_itself():
    curves = lines(two_span_charges(RATIO))
    assert list(curves) == ["left end", "mid pier", "right end"]
    for position, name in ((-20.0, "left end"), (0.0, "mid pier"), (20.0, "right end")):
        x, ratio = curves[name].T
        # 10 m from 1000 kg is Z = 1.
        away = abs(abs(x - position) - 10.0) < 1e-9
        assert ratio[away] == pytest.approx(np.full(away.sum(), 934.86 / 101.325), rel=1e-5)
        assert away.any()


def test_figure_13_of_another_charge():
    figure = two_span_charges(SMALL)
    x, peak = lines(figure)["mid pier"].T
    # 10 m from 8 kg is Z = 5.
    assert peak[abs(x - 10.0) < 1e-9] == pytest.approx([31.30], abs=5e-3)
    assert "8 kg of TNT at both ends" in words(figure)


def test_figure_14_the_sum_and_what_is_there_at_one_time():
    curves = lines(two_span_total(KPA))
    (x, total), (_, at_once) = curves["sum of the peaks, as in 2019"].T, curves["largest sum at one time"].T
    by_charge = sum(line[:, 1] for line in lines(two_span_charges(KPA)).values())
    assert total == pytest.approx(by_charge)
    assert total == pytest.approx(total[::-1])
    assert (at_once <= total * (1 + 1e-12)).all()
    # In the middle of a span two fronts meet at once; the third comes after they are gone.
    middle = abs(x - 10.0) < 1e-9
    assert at_once[middle] == pytest.approx(2.0 * 934.86, rel=1e-5)


def test_the_map_over_time_shows_fronts_where_they_are():
    figure = two_span_over_time(KPA)
    mesh = figure.axes[0].collections[0]
    pressures, corners = mesh.get_array(), mesh.get_coordinates()
    positions, times = corners[0, :, 0], corners[:, 0, 1]
    column = np.searchsorted(positions, 5.0)
    first = np.flatnonzero(pressures[:, column] > 50.0)[0]
    assert times[first] == pytest.approx(1e3 * blast_wave(5.0, 1000.0).arrival_time_s, abs=2.0 * np.diff(times).max())


def test_rings_have_the_radii_of_their_thresholds():
    figure = two_span_rings(KPA)
    ring = lines(figure)["34.5: eardrum rupture, 1 %"]
    radii = np.hypot(ring[:181, 0] + 20.0, ring[:181, 1])
    assert blast_wave(radii, 1000.0).peak_overpressure_pa == pytest.approx(np.full(181, 34.5e3), rel=1e-9)
    near = lines(figure, axes=1)
    assert "34.5: eardrum rupture, 1 %" in near
    assert "1.03: typical glass breakage" not in near


def test_units_are_said_on_the_axes():
    assert "overpressure (kPa)" in words(pressure_over_time(KPA))
    assert "overpressure / ambient pressure" in words(pressure_over_time(RATIO))
    assert "time since the detonation (ms)" in words(pressure_over_time(KPA))
    assert "ms/kg$^{1/3}$" in words(pressure_over_time(SCALED))
    assert "distance from mid pier (m)" in words(two_span_charges(KPA))
    assert "m/kg$^{1/3}$" in words(two_span_charges(SCALED))
    assert "Kinney-Graham, surface burst" in words(two_span_total(GROUND))


@pytest.mark.long
def test_pictures_are_written_into_a_new_folder(tmp_path):
    paths = write_charts(tmp_path / "new" / "charts", KPA)
    assert [path.stem for path in paths] == list(CHARTS)
    assert sorted(paths) == sorted((tmp_path / "new" / "charts").iterdir())
    assert imread(paths[0]).shape[:2] == (660, 960)  # 8 × 5.5 inches at 120 dots per inch


def test_a_folder_that_cannot_be_made_is_refused(tmp_path):
    (tmp_path / "file").touch()
    with pytest.raises(OutputError, match="charts cannot be written"):
        write_charts(tmp_path / "file", KPA)
