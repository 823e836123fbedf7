# SPDX-License-Identifier: GPL-3.0-or-later
"""Colour maps against what is published of them."""

import matplotlib
import numpy as np
import pytest

from bridge_demolition_addon.display.colour_scale import UNKNOWN, ColourMap, colours, linear

ENDS_AND_MIDDLE = np.array([0.0, 0.5, 1.0])
EVEN = [ColourMap.VIRIDIS, ColourMap.CIVIDIS, ColourMap.INFERNO]


def test_the_map_of_2019_runs_from_blue_over_green_to_red():
    # The three channels as the report's listing has them: r = t, g = 1 - 2 |0.5 - t|, b = 1 - 2 t, cut off at 0.
    expected = [[0.0, 0.0, 1.0], [0.5, 1.0, 0.0], [1.0, 0.0, 0.0]]
    assert np.allclose(colours(ColourMap.BLUE_TO_RED, ENDS_AND_MIDDLE), expected, atol=1e-12)


@pytest.mark.parametrize(
    ("colour_map", "low", "high"),
    [
        (ColourMap.VIRIDIS, "#440154", "#fde725"),
        (ColourMap.CIVIDIS, "#00224e", "#fee838"),
        (ColourMap.INFERNO, "#000004", "#fcffa4"),
    ],
)
def test_even_maps_end_where_their_publications_do(colour_map, low, high):
    found = np.round(255.0 * colours(colour_map, [0.0, 1.0])).astype(int)
    assert ["#{:02x}{:02x}{:02x}".format(*colour) for colour in found] == [low, high]


@pytest.mark.parametrize("colour_map", EVEN)
def test_even_maps_are_those_of_matplotlib(colour_map):
    shares = np.linspace(0.0, 1.0, 1001)
    assert np.allclose(colours(colour_map, shares), matplotlib.colormaps[colour_map.value](shares)[:, :3], atol=1e-12)


def test_beyond_the_range_the_ends_go_on_and_no_value_is_grey():
    shares = np.array([-1.0, 2.0, np.nan])
    found = colours(ColourMap.VIRIDIS, shares)
    assert np.array_equal(found[:2], colours(ColourMap.VIRIDIS, [0.0, 1.0]))
    assert found[2].tolist() == list(UNKNOWN)


def test_linear_light_of_screen_colours():
    # IEC 61966-2-1: mid-grey 0.5 is 21.4 % of the light; the two branches meet at 0.04045.
    assert np.allclose(linear([0.0, 0.04045, 0.5, 1.0]), [0.0, 0.0031308, 0.2140411, 1.0], atol=1e-7)
