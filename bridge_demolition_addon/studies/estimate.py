"""How long a run takes, and what room, before it runs: by the size of its model."""

from __future__ import annotations

import numpy as np

from ..engineering.units import STANDARD_GRAVITY_M_S2
from ..model.scenario import Scenario
from ..model.schema import given
from ..model.stages.design_loads import load_cases
from ..model.structure.model import Model

FACTOR = 3.0
"""By how much an estimate from the size of a model may be off: processors differ, and so does what breaks and when."""

_PER_PART_S, _ITERATIONS = 2e-6, 20.0
"""Time for a shard or a connection in a sub-step, and iterations of the solver that take as long as all else of it:
from the I-235 span and the examples with 50 and 100 iterations, on one core. Thousands of shards take longer each."""

_ELASTIC, _WITH_BARS = 4.0, 2.0
"""So many times as long takes a sub-step with elastic connections, and with bars that hold their cracks on top of that:
`scripts/bench elastic`, and 1.8 to 2.4 times without bars for a ball on a deck of 100 to 400 shards."""

_PER_RUN_S = 0.5

_PER_PART_AT_REST_S, _PER_PART_AND_SEARCH_S = 2e-3, 9e-3
"""Time for a shard or a connection in a stage, and in the search of the load at which a bridge with bars comes down: 25
stages of three spans in 100 and 160 shards, on one core. Without bars a search takes as long as a few stages."""

_PROCESS_MB, _PER_PART_MB = 430.0, 0.03
"""Memory of a process with Blender, and of a shard or connection in it: the I-235 span in 100 shards took 445 MB, and
in 1600 shards with 36 856 connections 1559 MB."""

_FOLDER_MB, _PER_PART_AND_FRAME_MB = 5.0, 6e-5
"""Files of a run: of the same two, 59 and 62 bytes for each part in each frame."""


def seconds_by_size(scenario: Scenario, model: Model) -> float:
    """Return about how long a run takes on one core, to a factor of `FACTOR`."""
    time = scenario.time
    substeps = time.duration_s * time.frames_per_second * _mean_substeps(scenario, model)
    parts = len(model.shards) + len(model.connections)
    is_elastic, iterations = scenario.connections.is_elastic, float(given(time.solver_iterations))
    elastic = _ELASTIC if is_elastic else 1.0
    bars = _WITH_BARS if scenario.is_reinforced and is_elastic else 1.0
    if is_elastic:  # whose passes end once nothing changes
        iterations = min(iterations, _ITERATIONS)
    return _PER_RUN_S + elastic * bars * _PER_PART_S * substeps * parts * (1.0 + iterations / _ITERATIONS)


def seconds_of_stages(scenario: Scenario, model: Model, stages: int) -> tuple[float, float]:
    """Return about how long stages take on one core, without and with load factors, to a factor of `FACTOR`."""
    parts = len(model.shards) + len(model.connections)
    at_rest_s = _PER_RUN_S + _PER_PART_AT_REST_S * parts * stages
    searches = stages + sum(1 for _ in load_cases(scenario, model))
    search_s = _PER_PART_AND_SEARCH_S if scenario.is_reinforced else _PER_PART_AT_REST_S
    return at_rest_s, at_rest_s + search_s * parts * searches


def megabytes_by_size(model: Model) -> float:
    """Return about how much memory a run takes, MB."""
    return _PROCESS_MB + _PER_PART_MB * (len(model.shards) + len(model.connections))


def disk_megabytes(scenario: Scenario, model: Model) -> float:
    """Return about how large the folder of a run gets, MB, where it lasts for all of its time."""
    parts = len(model.shards) + len(model.connections)
    return _FOLDER_MB + _PER_PART_AND_FRAME_MB * parts * len(scenario.timeline)


def duration_text(seconds: float) -> str:
    """Return a time as text, in the unit that suits it."""
    for unit, length in (("days", 86400.0), ("hours", 3600.0), ("minutes", 60.0)):
        if seconds >= 2.0 * length:
            return f"{seconds / length:.2g} {unit}" if seconds < 10.0 * length else f"{seconds / length:.0f} {unit}"
    return f"{seconds:.2g} s" if seconds < 10.0 else f"{seconds:.0f} s"


def _mean_substeps(scenario: Scenario, model: Model) -> float:
    """Return the approximate number of sub-steps of a frame: in half of the frames debris is assumed at its fastest."""
    time = scenario.time
    if time.farthest_per_substep_m is None:
        return time.substeps_per_frame
    height_m = max(member.solid.bounds[1][2] for member in model.members)
    fastest = float(np.sqrt(2.0 * STANDARD_GRAVITY_M_S2 * max(height_m, 0.0)))
    return 0.5 * (time.substeps_per_frame + time.step.substeps_within(time.farthest_per_substep_m, fastest, 0.0))
