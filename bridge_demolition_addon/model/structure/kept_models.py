"""Models that are kept from run to run: several runs of a process, as in an optimisation, share a bridge."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Iterator, Sequence
from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np

from ..bridge.member import Member
from ..scenario import Scenario
from .model import Model, ModelBasis, model_on

MOST_BYTES = 100_000_000
"""Arrays of all models that are kept, together: some of 10,000 shards, or many small ones."""


class KeptModels:
    """The models that were asked for last, for scenarios with the same `ModelBasis`.

    Their arrays can only be read, so that no run changes what the next one gets.

    Parameters
    ----------
    most_bytes
        How large the models' arrays may be together. The last model is kept whatever its size.
    """

    def __init__(self, most_bytes: int = MOST_BYTES) -> None:
        self._most_bytes = most_bytes
        self._models: OrderedDict[str, Model] = OrderedDict()
        self._bytes: dict[str, int] = {}

    def __len__(self) -> int:
        return len(self._models)

    def model_of(self, scenario: Scenario, members: Sequence[Member] | None = None) -> Model:
        """Return the model of a scenario, which has the bits of `build_model`; built where it is not kept.

        Its own members may be given where they are prepared already.
        """
        basis = ModelBasis.of(scenario)
        digest = basis.digest
        if digest not in self._models:
            self._keep(digest, model_on(basis, members))
        self._models.move_to_end(digest)
        return self._models[digest]

    def _keep(self, digest: str, model: Model) -> None:
        arrays = list(_arrays_in(model))
        for array in arrays:
            array.flags.writeable = False
        self._models[digest], self._bytes[digest] = model, sum(array.nbytes for array in arrays)
        while len(self._models) > 1 and sum(self._bytes.values()) > self._most_bytes:
            oldest, _ = self._models.popitem(last=False)
            del self._bytes[oldest]


def _arrays_in(value: Any) -> Iterator[np.ndarray]:
    """Yield all arrays of a dataclass, at any depth."""
    if isinstance(value, np.ndarray):
        yield value
    elif isinstance(value, tuple):
        for item in value:
            yield from _arrays_in(item)
    elif is_dataclass(value):
        for field in fields(value):
            yield from _arrays_in(getattr(value, field.name))
