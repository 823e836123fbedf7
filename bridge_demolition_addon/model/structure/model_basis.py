"""What a model is built from: all of a scenario but what is done to its bridge, and when.

`build_model` sees nothing else. So two scenarios with the same basis have the same model, to the last bit: a key that
is new belongs to the basis, and what a scenario is stripped of cannot change a model.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, replace
from itertools import chain
from typing import Self

from ..actions import CutOfMembers, CutPlane
from ..blast.settings import BlastSettings
from ..scenario import Scenario
from ..scenario.file import file_digests
from ..scenario.scenario import no_actions
from ..scenario.time import TimeSettings


@dataclass(frozen=True, slots=True)
class ModelBasis:
    """What a model is built from.

    Attributes
    ----------
    scenario : Scenario
        As it stands: without actions, and with the blast and the time that a scenario has by default.
    planes : tuple of CutPlane or CutOfMembers
        What actions have the bridge cut along.
    clear_height_m : float
        How high a ball hangs above the bridge, for which terrain gets more room; 0 without terrain or ball.
    """

    scenario: Scenario
    planes: tuple[CutPlane | CutOfMembers, ...]
    clear_height_m: float

    @classmethod
    def of(cls, scenario: Scenario) -> Self:
        """Return what the model of a scenario is built from."""
        standing = replace(scenario, **no_actions(scenario), blast=BlastSettings(), time=TimeSettings())
        planes = tuple(chain.from_iterable(action.cut_planes() for action in scenario.actions))
        on_terrain = scenario.ball if not scenario.has_flat_ground else None
        return cls(standing, planes, on_terrain.largest_height_m(0.0) if on_terrain else 0.0)

    @property
    def digest(self) -> str:
        """SHA-256, in hexadecimal digits, of all fields, down to the sign of a zero, and of all files that are read."""
        text = "\n".join((repr(self), *file_digests(self.scenario)))
        return hashlib.sha256(text.encode()).hexdigest()
