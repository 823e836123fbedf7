"""How long a study takes, before it runs: by its own runs where some are done, or else by the size of its model."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path

import numpy as np

from ..engineering.units import STANDARD_GRAVITY_M_S2
from ..errors import ScenarioError
from ..model.ensemble.folder import outcome_in
from ..model.scenario import Scenario
from ..model.structure.model import Model
from ..model.study.file import Study
from ..model.study.files import RUNS_FOLDER
from ..model.study.runs_table import DONE
from ..model.study.sampled_runs import sampled_run

FACTOR = 3.0
"""By how much an estimate from the size of a model may be off: processors differ, and so does what breaks and when."""

_MOST_LOOKED_AT = 20

_PER_PART_S, _ITERATIONS = 2e-6, 20.0
"""Time for a shard or a connection in a sub-step, and iterations of the solver that take as long as all else of it:
from the I-235 span and the examples with 50 and 100 iterations, on one core. Thousands of shards take longer each."""

_PER_RUN_S = 0.5


def seconds_by_size(scenario: Scenario, model: Model) -> float:
    """Return about how long a run takes on one core, to a factor of `FACTOR`."""
    time = scenario.time
    substeps = time.duration_s * time.frames_per_second * _mean_substeps(scenario, model)
    parts = len(model.shards) + len(model.connections)
    return _PER_RUN_S + _PER_PART_S * substeps * parts * (1.0 + time.solver_iterations / _ITERATIONS)


def _mean_substeps(scenario: Scenario, model: Model) -> float:
    """Return the approximate number of sub-steps of a frame: in half of the frames debris is assumed at its fastest."""
    time = scenario.time
    if time.farthest_per_substep_m is None:
        return time.substeps_per_frame
    height_m = max(member.solid.bounds[1][2] for member in model.members)
    fastest = float(np.sqrt(2.0 * STANDARD_GRAVITY_M_S2 * max(height_m, 0.0)))
    return 0.5 * (time.substeps_per_frame + time.step.substeps_within(time.farthest_per_substep_m, fastest, 0.0))


def seconds_by_runs(study: Study, folder: Path, versions: Mapping[str, str]) -> float | None:
    """Return how long the first runs that are done in a study's folder took, in the mean; None without any."""
    seconds = []
    for number in range(1, min(study.settings.runs, _MOST_LOOKED_AT) + 1):
        with suppress(ScenarioError):  # inputs that the scenario cannot have together take no time
            outcome = outcome_in(folder / RUNS_FOLDER / sampled_run(study, number).cache_key(versions))
            if outcome and outcome.status == DONE:
                seconds.append(outcome.wall_time_s)
    return float(np.mean(seconds)) if seconds else None
