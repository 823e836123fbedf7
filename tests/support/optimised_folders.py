# SPDX-License-Identifier: GPL-3.0-or-later
"""Folders of optimisations as `bda optimise` leaves them, made without runs."""

import numpy as np
from support.optimise_files import optimise_file

from bridge_demolition_addon.model.ensemble.folder import EnsembleFolder
from bridge_demolition_addon.model.optimise.conclusions import best_of
from bridge_demolition_addon.model.optimise.file import read_optimisation
from bridge_demolition_addon.model.optimise.planner import OptimisePlanner
from bridge_demolition_addon.model.study.runs_table import RunOutcome


class Proposals:
    """Candidates by chance, whatever their results."""

    def __init__(self, size):
        self._size, self._random = size, np.random.default_rng(5)

    def propose(self):
        return self._random.random(self._size)

    def record_result(self, number, value, shortfall):
        pass


def optimised(folder, *changes, most=None, fails_at_last=False):
    """The folder of an optimisation whose debris goes the farther the heavier its charges are, and by chance."""
    optimisation, random = read_optimisation(optimise_file(folder / "asked", *changes)), np.random.default_rng(3)
    planner = OptimisePlanner(optimisation, Proposals(optimisation.space.size))
    path = folder / "optimised"
    with EnsembleFolder(path, optimisation, {"blender": "5.0.0", "optuna": "4.0"}) as kept:
        while not planner.is_finished and (most is None or planner.done < most):
            run = next(planner.next_runs())
            is_confirmation = planner.rounds.round_of(run.number) == "confirmation"
            mass_kg = run.inputs["charges.mass_kg"]
            success = mass_kg > 0.5 and not (fails_at_last and is_confirmation)
            outputs = {"reach_m": 5.0 + np.log10(mass_kg) + random.exponential(), "success": success}
            planner.take(run, RunOutcome("done", "", {**outputs, "came_to_rest_s": 0.2}))
        kept.write_tables(planner.table)
        if planner.is_finished:
            kept.write_result(best_of(planner.ensemble, planner.table))
    return path, planner
