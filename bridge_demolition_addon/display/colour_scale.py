"""Colour scale: which colour stands for a share between the lowest and the highest value, and its ticks.

Colours are for a screen (sRGB); `linear` turns them into the linear light that a renderer calculates with.
"""

from __future__ import annotations

from enum import StrEnum
from functools import cache

import numpy as np

UNKNOWN = (0.5, 0.5, 0.5)
"""Colour of what has no value: a grey that is in none of the maps."""


class ColourMap(StrEnum):
    """The maps, by their names.

    The map of 2019 runs from blue over green to red, straight from one to the next. The others are matplotlib's, and
    even to the eye: equal steps in value look equally large, also without colour. Cividis is made for eyes that take
    red for green.

    References
    ----------
    Viridis and inferno: S. van der Walt and N. Smith (2015). Cividis: J. Nuñez, C. Anderton and R. Renslow (2018),
    Optimizing colormaps with consideration for color vision deficiency, PLOS ONE 13.
    """

    BLUE_TO_RED = "2019"
    VIRIDIS = "viridis"
    CIVIDIS = "cividis"
    INFERNO = "inferno"


def colours(colour_map: ColourMap, shares: np.ndarray) -> np.ndarray:
    """Return the colours (n, 3) on a screen, 0 to 1, of shares (n,) from 0 (lowest) to 1 (highest); grey for nan."""
    shares = np.asarray(shares, float)
    known = np.isfinite(shares)
    inside = np.clip(np.where(known, shares, 0.0), 0.0, 1.0)
    if colour_map == ColourMap.BLUE_TO_RED:
        painted = np.stack((inside, 1.0 - abs(1.0 - 2.0 * inside), np.clip(1.0 - 2.0 * inside, 0.0, 1.0)), axis=-1)
    else:
        table = _table(colour_map)
        # As matplotlib does: the range is cut into as many equal pieces as there are colours.
        painted = table[np.minimum((inside * len(table)).astype(int), len(table) - 1)]
    return np.where(known[..., None], painted, UNKNOWN)


def linear(screen_colours: np.ndarray) -> np.ndarray:
    """Return the linear light of colours on a screen, of any shape, both 0 to 1 (IEC 61966-2-1)."""
    screen_colours = np.asarray(screen_colours, float)
    dark = screen_colours <= 0.04045
    return np.where(dark, screen_colours / 12.92, ((np.maximum(screen_colours, 0.0) + 0.055) / 1.055) ** 2.4)


def tick_text(number: float) -> str:
    """Return a round number in few letters: no more digits than it has, powers of ten instead of many zeros."""
    return "0" if number == 0.0 else f"{number:.4g}"


@cache
def _table(colour_map: ColourMap) -> np.ndarray:
    # Takes half a second, which only those wait who show the map.
    from matplotlib import colormaps
    from matplotlib.colors import ListedColormap

    colours = colormaps[colour_map.value]
    assert isinstance(colours, ListedColormap)
    return np.array(colours.colors)
