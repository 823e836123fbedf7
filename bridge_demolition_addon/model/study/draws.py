"""Draws of a study: the inputs of one run, and the scenario with them.

Every input has random numbers of its own, from the study's seed, the number of the draw and the name of the key. So a
draw depends neither on how many there are nor on the order in which they run; and where another key is varied as well,
or not any more, all other inputs stay, so that two studies with one seed differ only in what was changed.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from ...errors import ScenarioError
from ..scenario import Scenario
from ..scenario.file import files_of, scenario_text
from .file import SEED, Study, Variation
from .keys import changed

_WORDS_OF_NAME = 4
"""32-bit words of a name's digest that begin its random numbers."""


@dataclass(frozen=True, slots=True, eq=False)
class Draw:
    """One draw.

    Attributes
    ----------
    number : int
        From 1 on.
    inputs : dict
        Value of each drawn key by its name, `SEED` first.
    scenario : Scenario
        What is run.
    judged_by : str
        Settings of the study that decide what is recorded of the run, in one way of writing.
    """

    number: int
    inputs: dict[str, Any]
    scenario: Scenario
    judged_by: str

    def address(self, versions: Mapping[str, str]) -> str:
        """Return the SHA-256, in hexadecimal digits, of all that the result of the run depends on.

        Parameters
        ----------
        versions
            What it is run with, such as Blender's version.

        Raises
        ------
        ScenarioError
            A file that the scenario names cannot be read.
        """
        parts = [scenario_text(self.scenario), self.judged_by, *_files_of(self.scenario)]
        parts += [f"{name} {version}" for name, version in sorted(versions.items())]
        return _digest(*(part.encode() for part in parts)).hex()


def inputs_of(study: Study, number: int) -> dict[str, Any]:
    """Return the inputs of a draw, from 1 on, by the names of their keys."""
    values = {each.key.name: each.value(each.distribution.quantile(p)) for each, p in _drawn(study, number)}
    return {SEED: _random_bits(study, number, SEED) >> 33, **values}


def draw_of(study: Study, number: int) -> Draw:
    """Return a draw, from 1 on.

    Raises
    ------
    ScenarioError
        The scenario cannot have these values together; `inputs_of` gives them.
    """
    inputs = inputs_of(study, number)
    values = {each.key: inputs[each.key.name] for each in study.variations}
    scenario = replace(changed(study.scenario, values), seed=inputs[SEED])
    return Draw(number, inputs, scenario, _judged_by(study))


def _drawn(study: Study, number: int) -> Iterator[tuple[Variation, float]]:
    for each in study.variations:
        yield each, _probability(_random_bits(study, number, each.key.name))


def _probability(bits: int) -> float:
    """Return a multiple of 2⁻⁵³ above 0 and below 1 from 64 random bits; it has no rounding."""
    return ((bits >> 12) + 0.5) / 2**52


def _random_bits(study: Study, number: int, name: str) -> int:
    """Return 64 random bits of a key in a draw."""
    words = np.frombuffer(_digest(name.encode()), "<u4")[:_WORDS_OF_NAME].tolist()
    sequence = np.random.SeedSequence(study.settings.seed, spawn_key=(number, *words))
    return int(np.random.PCG64(sequence).random_raw())


def _judged_by(study: Study) -> str:
    settings = study.settings
    return json.dumps([settings.least_mass_kg, settings.keep, [asdict(each) for each in settings.criteria]])


def _files_of(scenario: Scenario) -> list[str]:
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
    found = hashlib.sha256()
    for part in parts:
        found.update(f"{len(part)}:".encode())
        found.update(part)
    return found.digest()
