# SPDX-License-Identifier: GPL-3.0-or-later
"""A body whose velocity is no number ends the run: it is named, and what was recorded before is kept."""

import json
from dataclasses import replace

import numpy as np
import pytest
from support.checkout import EXAMPLES
from support.scenarios import SHORT_RUN

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.errors import SimulationError
from bridge_demolition_addon.model.results.arrays import load_results
from bridge_demolition_addon.model.scenario.file import read_scenario

BEFORE, BODY = 4, 7
"""Frames that are recorded, and the body that is then put out of this world."""

DRILLED = read_scenario(EXAMPLES / "drilled" / "two_spans.toml")
ELASTIC = replace(DRILLED, fracture=replace(DRILLED.fracture, shards=30))


class Breaking(Silence):
    """Gives a body of Bullet a velocity that is no number, after some frames."""

    def frame(self, done, total, connections, left_s):
        from bridge_demolition_addon.simulation.blender_events import running_recording

        if done == BEFORE:
            bodies = running_recording().world.bodies
            moving = np.flatnonzero(bodies.can_move())[[BODY]]
            bodies.set_velocities(moving, np.full((1, 3), np.nan), np.zeros((1, 3)))
            bodies.wake(moving)
            self.body = int(moving[0])


@pytest.mark.slow
@pytest.mark.parametrize("every_substep", [True, False])
@pytest.mark.parametrize("scenario", [SHORT_RUN, ELASTIC], ids=["rigid", "elastic"])
def test_the_run_ends_and_names_the_body(tmp_path, scenario, every_substep):
    from bridge_demolition_addon.simulation.run import run_scenario

    asked = replace(scenario, recording=replace(scenario.recording, every_substep=every_substep))
    folder, damage = tmp_path / "run", Breaking()
    with pytest.raises(SimulationError) as raised:
        run_scenario(asked, folder, overwrite=False, pictures=False, progress=damage)
    results = load_results(folder / "results.npz")
    name, text = results.inventory.body_names[damage.body], str(raised.value)
    assert text.startswith(("the velocity of body ", "the position of body ")) and "is no finite number" in text
    assert repr(str(name)) in text and text.endswith(f"; the results up to then are in {folder}")
    assert len(results.frames) == BEFORE + 1
    assert np.isfinite(results.frames.positions_m).all() and np.isfinite(results.frames.velocities_m_s).all()
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    assert summary["completed"] is False and summary["frames"] == BEFORE + 1
