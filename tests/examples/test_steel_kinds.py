# SPDX-License-Identifier: GPL-3.0-or-later
"""What the page on steelwork says that presets of steel and prestressed bridges carry."""

import re

import numpy as np
import pytest
from support.checkout import EXAMPLES, PRESETS, ROOT

from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.stages.stability import stability_of

ROW = re.compile(r"\| \*(?P<name>[^*]+)\* \| (?P<mass>\d+) t \| (?P<least>[\d.]+)(?: to (?P<most>[\d.]+))? \|")
FILES = {
    path.stem: path
    for folder in (PRESETS / "steel", EXAMPLES / "steel", EXAMPLES / "prestressed")
    for path in folder.glob("*.toml")
}
QUICK = ("rolled_beams_severed", "steel_box_girder_dropped", "beam_cut_in_stages")
"""Those whose load factor takes some seconds."""


def rows():
    text = (ROOT / "docs" / "steel.md").read_text(encoding="utf-8")
    return {match["name"].lower().replace(" ", "_"): match for match in ROW.finditer(text)}


def test_the_table_names_presets():
    assert set(QUICK) < set(rows()) <= set(FILES)


@pytest.mark.long
@pytest.mark.parametrize("name", QUICK)
def test_it_comes_down_at_as_many_times_its_weight_as_the_page_says(blender, name):
    row, scenario = rows()[name], read_scenario(FILES[name])
    model = checked_model(scenario)
    factor = stability_of(scenario, model, with_factor=True).load_factor
    least, most = float(row["least"]), float(row["most"] or row["least"])
    assert least - 0.05 <= factor <= most + 0.05
    assert float(model.masses_kg.sum()) / 1000.0 == pytest.approx(float(row["mass"]), abs=0.5)


def test_rolled_beams_come_down_as_plastic_theory_with_partial_shear_connection_has_it(blender):
    """EN 1994-1-1, 6.2.1.3, and the mechanism of a continuous beam of two spans; 10 %: slabs do not crush in depth."""
    yield_n_m2, concrete_n_m2 = 355e6, 35e6
    area, flange, plastic_m3, studs, stud_n = 23860e-6, 0.3, 4815e-6, 35, 102e3  # HEB 500; 19 mm in C35
    pressed = studs * stud_n
    depth = (area - pressed / yield_n_m2) / 2.0 / flange  # of the neutral axis in the top flange
    block = 3 * pressed / (concrete_n_m2 * 6.6)
    in_span = 3.0 * (area * yield_n_m2 * 0.25 - flange * depth**2 * yield_n_m2 + pressed * (0.2 - block / 2.0))
    over_support = 3.0 * plastic_m3 * yield_n_m2
    x = np.linspace(3.0, 9.0, 601)
    load_n_m = ((in_span + over_support * x / 14.0) / (0.5 * x * (14.0 - x))).min()
    weight_n_m = 9.81 * (92.4e3 + 3 * 28 * 187.3 + 1.6e3) / 28.0  # deck, beams and cross frames
    found = float(rows()["rolled_beams_severed"]["least"])
    assert load_n_m / weight_n_m == pytest.approx(11.1, abs=0.15)  # as the page says
    assert found == pytest.approx(load_n_m / weight_n_m, rel=0.1)
