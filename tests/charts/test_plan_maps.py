# SPDX-License-Identifier: GPL-3.0-or-later
"""Names on the maps of a report: none over another, none beside the map."""

import itertools

import pytest
from manifold3d import CrossSection
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from bridge_demolition_addon.charts.blast_maps import overpressure_map
from bridge_demolition_addon.charts.plan_maps import exclusion_map
from bridge_demolition_addon.engineering.blast.pulses import BlastModel
from bridge_demolition_addon.model.blast.charges import Charge
from bridge_demolition_addon.model.debris.zones import ExclusionZone, widened
from bridge_demolition_addon.model.scenario import Neighbour, Zone

pytestmark = pytest.mark.slow


def strip(name, x_m, width_m=1.0):
    """A zone across the road."""
    corners = [(x_m, -15.0), (x_m + width_m, -15.0), (x_m + width_m, 15.0), (x_m, 15.0)]
    return Zone(name=name, corners_m=corners)


def drawn(draw):
    """A figure as wide as a page, and the boxes of its texts by what they say."""
    figure = Figure(figsize=(6.7, 5.5), dpi=150, layout="constrained")
    FigureCanvasAgg(figure)
    draw(figure)
    figure.draw_without_rendering()
    return figure, {text.get_text(): text.get_window_extent() for text in figure.axes[0].texts}


def test_names_of_zones_side_by_side_are_not_over_each_other():
    bridge = CrossSection.square((11.0, 6.0)).translate((0.0, -3.0))
    zone = ExclusionZone(whole=widened(bridge, 15.0), drop=bridge, debris=bridge, plan=bridge)
    names = "Pipeline under the deck", "Stream", "Railway in a cutting"
    zones = [strip(name, 3.0 + 2.0 * number) for number, name in enumerate(names)]
    _, boxes = drawn(lambda figure: exclusion_map(figure, zone, zones))
    for first, second in itertools.combinations(names, 2):
        assert not boxes[first].overlaps(boxes[second]), (first, second)


@pytest.mark.parametrize("x_m", [-100.0, 0.0, 100.0])
def test_a_long_name_of_a_neighbour_stays_on_the_map(x_m):
    house = Neighbour(name="Old mill with a very long name beside the river", position_m=(x_m, 30.0, 1.5))
    charge = Charge(name="West", position_m=(0.0, 0.0, 1.0), mass_kg=60.0)
    bridge = CrossSection.square((11.0, 6.0))
    figure, boxes = drawn(
        lambda figure: overpressure_map(figure, [charge], bridge, [house], BlastModel("kingery-bulmash"))
    )
    (name,) = (box for text, box in boxes.items() if text.startswith("Old mill"))
    frame = figure.axes[0].get_window_extent()
    assert frame.x0 <= name.x0 and name.x1 <= frame.x1
