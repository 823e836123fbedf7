"""Candidates of an optimisation, proposed by Optuna.

Its sampler is a tree-structured Parzen estimator: J. Bergstra, R. Bardenet, Y. Bengio and B. Kégl (2011), Algorithms
for hyper-parameter optimization, NeurIPS 24. Candidates that fall short of the constraint come after all others.
"""

from __future__ import annotations

from importlib.util import find_spec
from typing import Any

import numpy as np

from ..errors import MissingLibraryError


def has_optuna() -> bool:
    """Return whether Optuna is installed, without loading it, which takes a second."""
    return find_spec("optuna") is not None


def check_optuna() -> str:
    """Return the version of Optuna, which has to be installed."""
    try:
        import optuna
    except ModuleNotFoundError as error:
        raise MissingLibraryError(
            "an optimisation needs Optuna: install it with pip install 'bridge-demolition-addon[optimise]'"
        ) from error
    return optuna.__version__


class OptunaProposals:
    """Asks Optuna for candidates of `size` numbers, and passes results on to it.

    The same seed and results give the same candidates.
    """

    def __init__(self, size: int, seed: int):
        check_optuna()
        import optuna

        optuna.logging.set_verbosity(optuna.logging.WARNING)
        sampler = optuna.samplers.TPESampler(seed=seed)
        self._study = optuna.create_study(sampler=sampler)
        self._ranges: dict[str, Any] = {
            str(number): optuna.distributions.FloatDistribution(0.0, 1.0) for number in range(size)
        }
        self._trials: list[optuna.Trial] = []

    def propose(self) -> np.ndarray:
        """Return the next candidate: numbers (d,) from 0 to 1."""
        trial = self._study.ask(self._ranges)
        self._trials.append(trial)
        return np.array([trial.params[name] for name in self._ranges])

    def record_result(self, number: int, value: float, shortfall: float) -> None:
        """Take the result of a candidate, by its number from 0; its objective may be infinite.

        The shortfall is the probability of success that was asked for, less the part of its runs that succeeded.
        """
        trial = self._trials[number]
        trial.set_constraint("shortfall", shortfall)
        self._study.tell(trial, value)
