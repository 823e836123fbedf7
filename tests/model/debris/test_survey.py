# SPDX-License-Identifier: GPL-3.0-or-later
"""A survey of debris beside a run: one shard on the ground, whose place, height and footprint are known.

The shard *lower* is a column of 0.5 m² in plan and 4 m high. Its middle ends at (3, 4, 2) m: it stands on the ground
there, 5 m from where it hung, and the forecast is a square of 0.707 m × 0.707 m and 4 m height.
"""

import numpy as np
import pytest
from support.run_folders import keep_run
from support.sample_results import hanging_chain

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.debris.survey import SurveySettings, compared, read_survey
from bridge_demolition_addon.model.terrain.placed import Placing

pytestmark = pytest.mark.slow

SIDE_M = 0.5**0.5
CELLS = SurveySettings(cell_m=0.05)
STAY = Placing(np.zeros(3), np.eye(2), 1.0)


def scan(height_m=4.0, shift_m=0.0, spacing_m=0.025, around_m=8.0):
    """Points of level ground, with a block on it that is that high, and as much farther along x than the forecast."""
    numbers = np.arange(-around_m, around_m, spacing_m) + 0.5 * spacing_m
    x, y = (grid.ravel() for grid in np.meshgrid(numbers, numbers + 2.0))
    on_block = (np.abs(x - 3.0 - shift_m) < SIDE_M / 2.0) & (np.abs(y - 4.0) < SIDE_M / 2.0)
    return np.column_stack((x, y, np.where(on_block, height_m, 0.0)))


def test_a_survey_that_is_the_forecast_agrees_in_all():
    found = compared(hanging_chain(), scan(), CELLS)
    assert found.overlap == pytest.approx(1.0, abs=0.05)
    assert found.surveyed.sum() * found.cell_m2 == pytest.approx(0.5, abs=0.08)  # a row of cells is 0.035 m²
    assert found.volume_m3(found.surveyed, found.survey_m) == pytest.approx(2.0, abs=0.3)
    assert found.share_inside == pytest.approx(1.0, abs=0.05)
    both = found.surveyed & found.foreseen
    assert found.difference_m[both] == pytest.approx(0.0, abs=1e-9)


def test_a_pile_that_is_higher_is_higher_by_that():
    found = compared(hanging_chain(), scan(height_m=4.6), CELLS)
    both = found.surveyed & found.foreseen
    assert found.difference_m[both] == pytest.approx(0.6, abs=1e-9)
    mean, squares, common = found.errors_m
    assert (mean, squares, common) == pytest.approx((0.6, 0.6, 0.6), abs=0.35)  # cells at the edges count too


def test_footprints_that_are_half_beside_each_other_overlap_by_a_third():
    found = compared(hanging_chain(), scan(shift_m=SIDE_M / 2.0), CELLS)
    assert found.overlap == pytest.approx(1.0 / 3.0, abs=0.05)
    assert found.share_foreseen == pytest.approx(0.5, abs=0.08)


@pytest.mark.parametrize("limit_m, share", [(20.0, 1.0), (0.5, 0.0)])
def test_the_share_inside_a_limit(limit_m, share):
    """The bridge's plan was a square of 1 m around the origin; the block is 3.2 m or more from it."""
    found = compared(hanging_chain(), scan(), SurveySettings(cell_m=0.05, limit_m=limit_m))
    assert found.share_inside == pytest.approx(share)
    farthest = np.hypot(3.0 + SIDE_M / 2.0 - 0.5, 4.0 + SIDE_M / 2.0 - 0.5)
    assert found.farthest_m(found.surveyed) == pytest.approx(farthest, abs=0.1)


def test_points_of_noise_do_not_count_and_gaps_are_not_known():
    points = scan()
    birds = points[::400] * (1.0, 1.0, 0.0) + np.full(3, 30.0) * (0.0, 0.0, 1.0)
    found = compared(hanging_chain(), np.concatenate([points, birds]), CELLS)
    assert found.surveyed.sum() * found.cell_m2 == pytest.approx(0.5, abs=0.1)
    half = points[points[:, 0] < 3.0]
    found = compared(hanging_chain(), half, CELLS)
    assert found.foreseen.sum() * found.cell_m2 == pytest.approx(0.25, abs=0.05)


def written(path, points):
    if path.suffix == ".ply":
        import trimesh

        trimesh.PointCloud(points).export(path)
    elif path.suffix == ".las":
        import laspy

        cloud = laspy.LasData(laspy.LasHeader(point_format=0))
        cloud.x, cloud.y, cloud.z = points.T
        cloud.write(path)
    else:
        np.savetxt(path, points, fmt="%.6f")
    return path


@pytest.mark.parametrize("ending", [".ply", ".las", ".xyz"])
def test_surveys_are_read_and_placed(ending, tmp_path):
    """In a map whose north is x of the scenario: a bearing of 0, and an origin far away."""
    there = np.array([(10.0, 2.0, 1.0), (11.0, 2.0, 1.5), (10.0, 3.0, 2.0)])
    origin = np.array((4000.0, 9000.0, 50.0))
    in_map = np.column_stack((-there[:, 1], there[:, 0], there[:, 2])) + origin
    turn = np.array([[0.0, 1.0], [-1.0, 0.0]])
    placing = Placing(origin, turn, 1.0)
    points = read_survey(written(tmp_path / f"scan{ending}", in_map), placing)
    assert points == pytest.approx(there, abs=0.011)


@pytest.mark.long
def test_what_is_no_survey_is_refused(tmp_path):
    with pytest.raises(ScenarioError, match=r"scan\.dwg: expected a survey that ends in one of \.las"):
        read_survey(tmp_path / "scan.dwg", STAY)
    (tmp_path / "scan.ply").write_text("ply\nformat")
    with pytest.raises(ScenarioError, match=r"scan\.ply: cannot be read as PLY"):
        read_survey(tmp_path / "scan.ply", STAY)
    with pytest.raises(ScenarioError, match="has no point near the bridge"):
        compared(hanging_chain(), scan() + 1000.0, CELLS)


@pytest.mark.long
@pytest.mark.slow
def test_the_command_says_it_and_writes_a_report(tmp_path, capsys):
    folder = keep_run(tmp_path / "run", hanging_chain())
    survey = written(tmp_path / "scan.xyz", scan(spacing_m=0.05))
    assert main(["compare", str(folder), "--survey", str(survey), "--cell", "0.1", "--limit", "10"]) == 0
    out = capsys.readouterr().out
    assert "debris inside the limit       100.0 % of its volume by the survey" in out
    report = folder / "survey" / "report.html"
    assert "Survey of the debris" in report.read_text(encoding="utf-8")
    rows = (folder / "survey" / "tables" / "survey_cells.csv").read_text(encoding="utf-8").splitlines()
    assert rows[0] == "x_m,y_m,forecast_m,survey_m,distance_m"
    assert len(rows) > 40
    assert main(["compare", str(folder), "--survey", str(survey), "--origin", "9e5", "0", "0"]) == 2
    refusal = capsys.readouterr().err
    assert "no point near the bridge: it goes from x = -900008 m to -899992 m" in refusal
    assert "say by --origin and --bearing" in refusal


def test_ground_that_is_too_high_is_said():
    """All points are 2 m higher, as where heights of the survey begin elsewhere: so is its ground."""
    assert compared(hanging_chain(), scan() + np.array((0.0, 0.0, 2.0)), CELLS).ground_m == pytest.approx(2.0)
    assert compared(hanging_chain(), scan(), CELLS).ground_m == pytest.approx(0.0)
