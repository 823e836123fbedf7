"""Sampled runs: the inputs of one run of a study, a search or an optimisation, and the scenario with them.

Each input has random numbers of its own, from the seed, the number of the run and the name of the key. So a run
depends neither on how many runs there are nor on their order. Where another key is varied as well, or no longer, all
other inputs stay: two studies with one seed differ only in what was changed.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from ...errors import ScenarioError
from ..scenario import Scenario
from ..scenario.file import files_of, scenario_text
from .file import SEED, Ensemble
from .keys import ScenarioKey, changed

_WORDS_OF_NAME = 4
"""32-bit words of a name's digest that begin its random numbers."""


@dataclass(frozen=True, eq=False)
class SampledRun:
    """One run, as it is to be made.

    Attributes
    ----------
    number : int
        From 1 on. It fixes what varies by chance.
    inputs : dict
        Value of each input by its name, `SEED` first.
    changes : dict
        Values of the scenario's keys in this run.
    ensemble : Ensemble
        What it is a run of.
    """

    number: int
    inputs: Mapping[str, Any]
    changes: Mapping[ScenarioKey, Any]
    ensemble: Ensemble

    @cached_property
    def scenario(self) -> Scenario:
        """The scenario with these values.

        Raises
        ------
        ScenarioError
            It cannot have them together.
        """
        return replace(changed(self.ensemble.scenario, self.changes), seed=self.inputs[SEED])

    @property
    def request(self) -> dict[str, str]:
        """What the program of runs is asked, ready for JSON."""
        return {"scenario": scenario_text(self.scenario), "study": self.ensemble.settings.shared_text}

    def cache_key(self, versions: Mapping[str, str]) -> str:
        """Return the SHA-256, in hexadecimal digits, of all that the result of the run depends on.

        Parameters
        ----------
        versions
            What it is run with, such as Blender's version.

        Raises
        ------
        ScenarioError
            The scenario cannot have these values, or a file that it names cannot be read.
        """
        parts = [scenario_text(self.scenario), evaluation_settings(self.ensemble), *_file_digests(self.scenario)]
        parts += [f"{name} {version}" for name, version in sorted(versions.items())]
        return _digest(*(part.encode() for part in parts)).hex()


def sampled_run(ensemble: Ensemble, number: int, chosen: Mapping[ScenarioKey, Any] | None = None) -> SampledRun:
    """Return a run, from 1 on.

    Parameters
    ----------
    ensemble, number
        What it is a run of, and which.
    chosen
        Values of keys that are not left to chance.
    """
    changes = {
        variation.key: variation.value(variation.distribution.quantile(_probability(ensemble, number, variation.key)))
        for variation in ensemble.variations
    }
    values = {key.name: value for key, value in changes.items()}
    inputs = {SEED: _random_bits(ensemble, number, SEED) >> 33, **values}
    return SampledRun(number, inputs, changes | dict(chosen or {}), ensemble)


def evaluation_settings(ensemble: Ensemble) -> str:
    """Return the settings that decide what is recorded of a run, in one way of writing."""
    settings = ensemble.settings
    return json.dumps([settings.least_mass_kg, settings.keep, [asdict(criterion) for criterion in settings.criteria]])


def _probability(ensemble: Ensemble, number: int, key: ScenarioKey) -> float:
    """Return a multiple of 2⁻⁵³ above 0 and below 1 from 64 random bits; it has no rounding."""
    return ((_random_bits(ensemble, number, key.name) >> 12) + 0.5) / 2**52


def _random_bits(ensemble: Ensemble, number: int, name: str) -> int:
    """Return 64 random bits of a key in a run."""
    words = np.frombuffer(_digest(name.encode()), "<u4")[:_WORDS_OF_NAME].tolist()
    sequence = np.random.SeedSequence(ensemble.settings.seed, spawn_key=(number, *words))
    return int(np.random.PCG64(sequence).random_raw())


def _file_digests(scenario: Scenario) -> list[str]:
    """Return digests of the files that a scenario names."""
    digests = []
    for path in files_of(scenario):
        try:
            digests.append(_digest(path.read_bytes()).hex())
        except OSError as error:
            raise ScenarioError(f"{path}: cannot be read: {error.strerror}") from error
    return digests


def _digest(*parts: bytes) -> bytes:
    """SHA-256 of parts, each with its length, so that no two lists of parts give the same bytes."""
    digest = hashlib.sha256()
    for part in parts:
        digest.update(f"{len(part)}:".encode())
        digest.update(part)
    return digest.digest()
