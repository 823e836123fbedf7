# SPDX-License-Identifier: GPL-3.0-or-later
"""The examples of an arch and of a frame stand as they were built."""

from dataclasses import replace

import pytest
from support.checkout import EXAMPLES
from support.long_cases import long_but

from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.stages.stability import STANDS, stability_of
from bridge_demolition_addon.model.structure.model import build_model

FOLDER = EXAMPLES / "arches_and_frames"


@pytest.mark.slow
@pytest.mark.parametrize("name", ["arch_severed", "frame_leg_blasted"])
@pytest.mark.parametrize("seed", long_but([1], [1, 2, 3]))
def test_it_stands_under_its_own_weight(name, seed):
    scenario = replace(read_scenario(FOLDER / f"{name}.toml"), seed=seed)
    assert stability_of(scenario, build_model(scenario), with_factor=False).verdict == STANDS
