# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of a run in the window, and from a peak of the chart of forces to its frame and shard."""

import numpy as np
import pytest
from matplotlib.image import imread
from support.checkout import SMALL

from bridge_demolition_addon.charts.histories import TimeAxis
from bridge_demolition_addon.errors import OutputError
from bridge_demolition_addon.model.results.arrays import load_results
from bridge_demolition_addon.ui.chart_pictures import chart_of, go_to_peak, pictures_of


@pytest.fixture
def ran(extension, settings, tmp_path):
    settings.scenario_path = str(SMALL)
    extension.ops.bda.build_scenario()
    settings.output_directory = str(tmp_path / "run")
    extension.ops.bda.run(pictures=False)
    return extension


def test_pictures_are_those_of_the_run_with_charts_first(ran, tmp_path):
    scene = ran.context.scene
    assert [path.name for path in pictures_of(scene)] == ["force_over_time.png"]
    ran.ops.bda.draw_charts()
    (tmp_path / "run" / "frames").mkdir(exist_ok=True)
    (tmp_path / "run" / "frames" / "after.png").touch()
    names = [path.relative_to(tmp_path / "run").as_posix() for path in pictures_of(scene)]
    assert names == ["charts/debris_plan.png", "charts/force_over_time.png", "frames/after.png"]
    assert chart_of(scene) == tmp_path / "run" / "charts" / "force_over_time.png"


@pytest.mark.long
def test_without_a_run_or_an_image_editor_the_buttons_say_so(extension, ran):
    with pytest.raises(RuntimeError, match="Go to the BDA Workspace first"):
        ran.ops.bda.show_picture()
    assert not ran.ops.bda.go_to_peak.poll()
    ran.context.scene.bda.output_directory = ""
    ran.ops.bda.remove_demolition()


def test_a_click_on_the_peak_goes_to_the_frame_and_shard_of_the_peak_force(ran, tmp_path):
    """The peak is where the red and blue lines are highest in the picture, and what the panel Results calls it."""
    from bridge_demolition_addon.ui.results.shown_run import shown_run

    scene = ran.context.scene
    path, results = chart_of(scene), load_results(tmp_path / "run")
    picture = imread(path)[..., :3]
    blue = (np.abs(picture - np.array([0x21, 0x66, 0xAC]) / 255.0) < 0.02).all(axis=-1)
    blue[: int(0.05 * len(blue))] = blue[int(0.85 * len(blue)) :] = False  # neither title nor legend
    rows, columns = np.nonzero(blue)
    share = float(np.median(columns[rows == rows.min()]) + 0.5) / picture.shape[1]
    said = go_to_peak(ran.context, share)
    largest = shown_run(scene).peak_force
    assert scene.frame_current == largest.frame
    assert ran.context.view_layer.objects.active.name == largest.body
    assert f"on {largest.body} at" in said and said.startswith(largest.text)
    forces = np.asarray(results.frames.loads.body_peaks_n)[:, results.inventory.of_kind("shard")]
    assert f"{forces.max() / 1e3:,.0f} kN" in said


def test_a_click_beside_the_axis_is_refused(ran):
    with pytest.raises(OutputError, match="beside the time axis"):
        go_to_peak(ran.context, 0.001)


@pytest.mark.long
def test_a_chart_of_an_earlier_version_is_said_to_be_one(ran):
    path = chart_of(ran.context.scene)
    picture = path.read_bytes()
    path.write_bytes(picture.replace(b"bda time axis", b"bda time nixx"))
    assert TimeAxis.read(path) is None
    with pytest.raises(OutputError, match="Draw Charts draws it again"):
        go_to_peak(ran.context, 0.5)
