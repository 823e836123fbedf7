"""Colour maps: which colour stands for a share between the lowest and the highest value.

Colours here are those of a screen (sRGB), which is what tables of colour maps hold; `linear` turns them into the linear
light that a renderer reckons in.
"""

from __future__ import annotations

from enum import StrEnum
from functools import cache
from importlib import resources

import numpy as np

UNKNOWN = (0.5, 0.5, 0.5)
"""Colour of what has no value: a grey that is in none of the maps."""


class ColourMap(StrEnum):
    """The maps, by their names.

    That of 2019 runs from blue over green to red, straight from one to the next. The others are even to the eye: equal
    steps in value look equally large, also without colour. Viridis and inferno are by S. van der Walt and N. Smith
    (2015), cividis, for eyes that take red for green, by J. Nuñez, C. Anderton and R. Renslow (2018), *Optimizing
    colormaps with consideration for color vision deficiency*, PLOS ONE 13. Their tables, in ``core/data``, are those of
    matplotlib.
    """

    BLUE_TO_RED = "2019"
    VIRIDIS = "viridis"
    CIVIDIS = "cividis"
    INFERNO = "inferno"


def colours(colour_map: ColourMap, shares: np.ndarray) -> np.ndarray:
    """Colours (n, 3) on a screen, 0 to 1, for shares (n,) from 0 (lowest) to 1 (highest); grey for nan."""
    shares = np.asarray(shares, float)
    known = np.isfinite(shares)
    inside = np.clip(np.where(known, shares, 0.0), 0.0, 1.0)
    if colour_map == ColourMap.BLUE_TO_RED:
        found = np.stack((inside, 1.0 - abs(1.0 - 2.0 * inside), np.clip(1.0 - 2.0 * inside, 0.0, 1.0)), axis=-1)
    else:
        table = _tables()[colour_map]
        # As matplotlib does: the range is cut into as many equal pieces as there are colours.
        found = table[np.minimum((inside * len(table)).astype(int), len(table) - 1)]
    return np.where(known[..., None], found, UNKNOWN)


def linear(screen_colours: np.ndarray) -> np.ndarray:
    """Linear light of colours on a screen, of any shape, both 0 to 1 (IEC 61966-2-1)."""
    screen_colours = np.asarray(screen_colours, float)
    dark = screen_colours <= 0.04045
    return np.where(dark, screen_colours / 12.92, ((np.maximum(screen_colours, 0.0) + 0.055) / 1.055) ** 2.4)


@cache
def _tables() -> dict[ColourMap, np.ndarray]:
    file = resources.files(__package__) / "data" / "colour_maps.csv"
    lines = file.read_text(encoding="utf-8").splitlines()
    numbers = np.array([line.split(",") for line in lines[1:]], float)
    names = [name.rpartition("_")[0] for name in lines[0].split(",")][::3]
    return {ColourMap(name): numbers[:, 3 * column : 3 * column + 3] for column, name in enumerate(names)}
