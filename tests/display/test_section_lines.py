# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines, triangles and scale of a section, of shards whose places can be checked by hand."""

import numpy as np
import pytest
from support.sample_results import changed, hanging_chain

from bridge_demolition_addon.display.section_lines import (
    ground_line,
    height_scale,
    section_outline,
    section_triangles,
)
from bridge_demolition_addon.model.debris.pile_sections import Direction, pile_section


@pytest.fixture
def section():
    """Through the shard that fell, 0.7071 m wide about y = 4 and 4 m high, by a plane at x = 3.1."""
    return pile_section(hanging_chain(), Direction.ACROSS, 3.1)


def test_outline_and_triangles_lie_in_the_plane_and_cover_what_is_cut(section):
    outline, triangles = section_outline(section, section.debris), section_triangles(section, section.debris)
    for points in (outline, triangles, ground_line(section)):
        assert set(points[:, 0]) == {3.1}
    lengths = np.linalg.norm(outline[1::2] - outline[::2], axis=1)
    assert lengths.sum() == pytest.approx(2.0 * (4.0 + 0.5**0.5))
    corners = triangles.reshape(-1, 3, 3)
    doubled = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    assert doubled.sum() / 2.0 == pytest.approx(4.0 * 0.5**0.5)
    assert len(section_triangles(section, section.standing)) == len(section_outline(section, section.standing)) == 0


def test_the_scale_has_round_heights_from_the_ground_to_the_top(section):
    scale = height_scale(section)
    assert [height for _, height in scale.marks] == [0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0]
    for (x, y, z), height in scale.marks:
        assert (x, z) == (3.1, height) and y < 4.0 - 0.5**1.5
    tall = height_scale(pile_section(hanging_chain(), Direction.ALONG, 0.2))
    assert [height for _, height in tall.marks] == [0.0, 5.0, 10.0, 15.0, 20.0]


def test_where_nothing_is_cut_there_is_no_scale():
    assert height_scale(pile_section(hanging_chain(), Direction.ALONG, 50.0)) is None


def test_a_shard_that_sank_in_by_millimetres_gives_no_mark_below_the_ground():
    results = hanging_chain()
    positions = np.array(results.frames.positions_m)
    positions[4, 2, 2] -= 0.02
    scale = height_scale(pile_section(changed(results, places_m=positions), Direction.ACROSS, 3.1))
    assert min(height for _, height in scale.marks) == 0.0
