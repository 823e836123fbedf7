# SPDX-License-Identifier: GPL-3.0-or-later
"""The force chart, read back: from a vector picture its numbers and words, from pixels its size."""

import re
import warnings
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.image import imread
from support.sample_results import FRAME_S, G, changed, hanging_chain, without_connections

from bridge_demolition_addon.charts.histories import TimeAxis, plot_forces
from bridge_demolition_addon.model.results.frames import FrameSeries

pytestmark = pytest.mark.slow

# Nothing acts in the first frame, in which no time passes; in the fourth, the largest is not the mean.
SUMS_KN = np.array([0.0, 700 * G, 700 * G, 500 * G + np.hypot(200 * G, 1000), 300 * G]) / 1e3
RESULTANTS_KN = np.array([0.0, 300 * G, 300 * G, np.hypot(300 * G, 1000), 300 * G]) / 1e3


def drawn(tmp_path, results, title="A bridge", impact_s=None):
    path = tmp_path / "chart.svg"
    plot_forces(results, path, title, impact_s)
    return path.read_text(encoding="utf-8")


def curve(svg, colour):
    """Corners (k, 2) of the first curve of a colour, in points with y downwards."""
    path = re.search(rf'<path d="([^"]*)" clip-path="[^"]*" style="[^"]*stroke: {colour}', svg)
    return np.array(re.findall(r"[ML] (\S+) (\S+)", path[1]), float)


def test_curves_show_the_largest_force_on_any_shard(tmp_path):
    svg = drawn(tmp_path, hanging_chain())
    sums, resultants = curve(svg, "#b2182b"), curve(svg, "#2166ac")
    # One scale for both curves: heights in the picture are a linear function of the forces.
    heights, forces = np.append(sums[:, 1], resultants[:, 1]), np.append(SUMS_KN, RESULTANTS_KN)
    scale, origin = np.polyfit(forces, heights, 1)
    np.testing.assert_allclose(scale * forces + origin, heights, atol=1e-4)  # SVG coordinates have six decimals
    assert scale < 0.0
    np.testing.assert_allclose(np.diff(sums[:, 0]), np.diff(sums[:, 0]).mean(), atol=1e-4)


def test_the_count_of_connections_falls_when_one_breaks(tmp_path):
    heights = curve(drawn(tmp_path, hanging_chain()), "#4d4d4d")[:, 1]
    assert np.ptp(heights[:4]) == pytest.approx(0.0, abs=1e-4)
    # From the axis that begins at 0 it falls to half.
    floor = float(heights[3] + 2.0 * (heights[4] - heights[3]))
    assert floor == pytest.approx(axes_bottom(drawn(tmp_path, hanging_chain())), abs=1e-3)


def axes_bottom(svg):
    background = re.search(r'id="axes_1">\s*<g id="patch_2">\s*<path d="M \S+ (\S+)', svg)
    return float(background[1])


def test_the_impact_is_marked_at_its_time(tmp_path):
    assert "impact of the ball" not in drawn(tmp_path, hanging_chain())
    svg = drawn(tmp_path, hanging_chain(), impact_s=3 * FRAME_S)
    assert "<!-- impact of the ball -->" in svg
    assert curve(svg, "#000000")[0, 0] == pytest.approx(curve(svg, "#b2182b")[3, 0], abs=1e-4)


def test_words_and_units(tmp_path):
    svg = drawn(tmp_path, hanging_chain())
    for text in ("time (s)", "force (kN)", "connections intact", "largest resultant on a shard"):
        assert f"<!-- {text} -->" in svg


@pytest.mark.parametrize("title", ["I-235", "costs $5 to $6", r"$\nonsense{$", "100 % _done_ ^2", "é " * 80])
def test_any_title_is_text(tmp_path, title):
    svg = drawn(tmp_path, hanging_chain(), title)
    words = " ".join(re.findall(r"<!-- (.*?) -->", svg, re.DOTALL)).split()
    assert set(title.split()) <= set(words)


def test_picture_has_its_size_and_is_not_empty(tmp_path):
    plot_forces(hanging_chain(), tmp_path / "chart.png", "A bridge", 0.16)
    picture = imread(tmp_path / "chart.png")
    assert picture.shape[:2] == (600, 1080)  # 9 × 5 inches at 120 dots per inch
    assert len(np.unique(picture.reshape(-1, picture.shape[2]), axis=0)) > 3


def first_frame(results):
    return replace(results, frames=FrameSeries.of([results.frames[0]]))


def unknown_at_first(results):
    unknown = {name: results.arrays()[name].copy() for name in ("body_peaks_n", "body_peak_sums_n")}
    for values in unknown.values():
        values[0] = np.nan
    return changed(results, **unknown)


@pytest.mark.parametrize("change", [without_connections, first_frame, unknown_at_first])
def test_little_to_draw_is_drawn_without_complaint(tmp_path, change):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        plot_forces(change(hanging_chain()), tmp_path / "chart.png", "A bridge", None)
    assert imread(tmp_path / "chart.png").std() > 0.0


def test_without_shards_there_are_no_forces_to_draw(tmp_path):
    results = hanging_chain()
    only_ground = changed(results, body_kinds=np.full(4, "ground"))
    svg = drawn(tmp_path, only_ground)
    assert "<!-- connections intact -->" in svg
    for colour in ("#b2182b", "#2166ac"):
        np.testing.assert_allclose(curve(svg, colour)[:, 1], axes_bottom(svg), atol=1e-4)


def test_ball_and_ground_do_not_count(tmp_path):
    """In the last frame the ball loads the ground with ten times what any shard carries."""
    results = hanging_chain()
    assert (
        results.frames.loads.body_peaks_n[4, [0, 3]].min()
        >= 10 * results.frames.loads.body_peaks_n[4, [1, 2]].max() - 1e-9
    )  # rounding
    sums = curve(drawn(tmp_path, results), "#b2182b")[:, 1]
    assert sums[4] > sums[3]  # lower in the picture


def test_the_picture_of_forces_says_where_its_time_axis_lies(tmp_path):
    """The blue line begins at 0 s and ends at 0.16 s, wherever that is in the picture."""
    path = tmp_path / "chart.png"
    plot_forces(hanging_chain(), path, "A bridge", None)
    axis, picture = TimeAxis.read(path), imread(path)[..., :3]
    blue = (abs(picture - np.array([0x21, 0x66, 0xAC]) / 255.0) < 0.02).all(axis=-1)
    columns = np.flatnonzero(blue[: int(0.85 * len(blue))].any(axis=0))  # without the legend
    begin, end = (axis.time_at((column + 0.5) / picture.shape[1]) for column in (columns[0], columns[-1]))
    assert begin == pytest.approx(0.0, abs=5e-4) and end == pytest.approx(0.16, abs=5e-4)
    assert axis.time_at(axis.left - 0.01) is None and axis.time_at(1.0) is None


def test_other_pictures_have_no_time_axis(tmp_path):
    (tmp_path / "none.png").write_bytes(b"\x89PNG\r\n\x1a\n")
    (tmp_path / "text.png").write_text("no picture")
    assert TimeAxis.read(tmp_path / "none.png") is None
    assert TimeAxis.read(tmp_path / "text.png") is None
    assert TimeAxis.read(tmp_path / "missing.png") is None
