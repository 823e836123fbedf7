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

from ..scenario import Scenario
from ..scenario.file import file_digests, scenario_text
from .file import SEED, Ensemble
from .keys import ScenarioKey, changed

_WORDS_OF_NAME = 4
"""32-bit words of a name's digest that begin its random numbers."""


@dataclass(frozen=True, eq=False)
class SampledRun:
    """One run, as it is to be made."""

    number: int  # from 1; it fixes what varies by chance
    inputs: Mapping[str, Any]  # by name, `SEED` first
    changes: Mapping[ScenarioKey, Any]  # values of the scenario's keys
    ensemble: Ensemble

    @cached_property
    def scenario(self) -> Scenario:
        """The scenario with these values."""
        return replace(changed(self.ensemble.scenario, self.changes), seed=self.inputs[SEED])

    @property
    def request(self) -> dict[str, str]:
        """The request to the program of runs, ready for JSON."""
        return {"scenario": scenario_text(self.scenario), "study": self.ensemble.settings.shared_text}

    def cache_key(self, versions: Mapping[str, str]) -> str:
        """Return the SHA-256, in hexadecimal digits, of everything that the result of the run depends on."""
        parts = [scenario_text(self.scenario), evaluation_settings(self.ensemble), *file_digests(self.scenario)]
        parts += [f"{name} {version}" for name, version in sorted(versions.items())]
        return _digest(*(part.encode() for part in parts)).hex()


def sampled_run(ensemble: Ensemble, number: int, chosen: Mapping[ScenarioKey, Any] | None = None) -> SampledRun:
    """Return a run by its number, from 1, with the values of keys that are chosen and do not vary by chance."""
    changes = {
        variation.key: variation.value(variation.distribution.quantile(_probability(ensemble, number, variation.key)))
        for variation in ensemble.variations
    }
    values = {key.name: value for key, value in changes.items()}
    inputs = {SEED: _random_bits(ensemble, number, SEED) >> 33, **values}
    return SampledRun(number, inputs, changes | dict(chosen or {}), ensemble)


def evaluation_settings(ensemble: Ensemble) -> str:
    """Return the settings that decide what is recorded of a run, as text."""
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


def _digest(*parts: bytes) -> bytes:
    """Return the SHA-256 of parts, each with its length, so that no two lists of parts have the same bytes."""
    digest = hashlib.sha256()
    for part in parts:
        digest.update(f"{len(part)}:".encode())
        digest.update(part)
    return digest.digest()
