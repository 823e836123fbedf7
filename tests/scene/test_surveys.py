# SPDX-License-Identifier: GPL-3.0-or-later
"""A survey in the 3D view: each cell at its height, with the colour of how much higher it is than the forecast."""

import numpy as np
import pytest
from support.sample_results import hanging_chain

from bridge_demolition_addon.model.debris.survey import SurveySettings, compared


def scan(height_m):
    """Points on level ground, 10 cm apart, and on a block of 0.7 m around the shard that ends at (3, 4) m."""
    x, y = (grid.ravel() for grid in np.meshgrid(np.arange(-4.95, 8.0, 0.1), np.arange(-4.95, 8.0, 0.1)))
    on_block = (np.abs(x - 3.0) < 0.35) & (np.abs(y - 4.0) < 0.35)
    return np.column_stack((x, y, np.where(on_block, height_m, 0.0)))


@pytest.mark.parametrize(
    ("height_m", "name"),
    [
        (4.0, "Survey, as foreseen"),
        (4.6, "Survey, 0.25 to 1 m higher"),
        (6.0, "Survey, more than 1 m higher"),
        (3.5, "Survey, 0.25 to 1 m lower"),
        (1.0, "Survey, more than 1 m lower"),
    ],
)
def test_cells_have_the_colour_of_their_difference(height_m, name, blender):
    """The shard is 4 m high; ground without debris by either is as foreseen."""
    from bridge_demolition_addon.scene.rendering.ground import show_survey

    found = compared(hanging_chain(), scan(height_m), SurveySettings(cell_m=0.1))
    ground = np.full(found.survey_m.shape, 2.0)
    shown = show_survey(blender.context.scene, found, ground)
    assert len(shown.data.polygons) == np.isfinite(found.survey_m).sum()
    middle = min(shown.data.polygons, key=lambda face: (face.center.x - 3.0) ** 2 + (face.center.y - 4.0) ** 2)
    assert middle.center.z == pytest.approx(2.0 + height_m, abs=1e-5)
    assert shown.data.materials[middle.material_index].name.startswith(name)
    assert shown.rigid_body is None


def test_a_survey_takes_the_place_of_the_one_before(blender):
    from bridge_demolition_addon.scene.rendering.ground import SURVEY_ROLE, show_survey

    found = compared(hanging_chain(), scan(4.0), SurveySettings(cell_m=0.1))
    for _ in range(2):
        show_survey(blender.context.scene, found, np.zeros(found.survey_m.shape))
    assert [obj.name for obj in blender.data.objects if obj.get("bda_role") == SURVEY_ROLE] == ["Survey"]
