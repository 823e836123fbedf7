# SPDX-License-Identifier: GPL-3.0-or-later
"""What a listing of the extension asks for."""

import pytest
from PIL import Image
from support.checkout import ROOT

PICTURES = ROOT / "docs" / "pictures" / "listing"


def test_the_icon_is_square_and_transparent_around_the_bridge():
    with Image.open(PICTURES / "icon.png") as icon:
        assert (icon.size, icon.mode) == ((256, 256), "RGBA")
        opacity = icon.getchannel("A")
    corners = [opacity.getpixel(corner) for corner in ((0, 0), (255, 0), (0, 255), (255, 255))]
    assert corners == [0, 0, 0, 0] and opacity.getextrema() == (0, 255)


@pytest.mark.parametrize("name", ["featured", "preview_before", "preview_impact"])
def test_pictures_are_as_large_as_they_are_shown(name):
    with Image.open(PICTURES / f"{name}.jpg") as picture:
        assert picture.size == (1920, 1080)
        darkest, brightest = picture.convert("L").getextrema()
    assert brightest - darkest > 100
