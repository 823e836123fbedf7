"""Weakenings: strength that connections lose in one moment."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...texts import Text
from ..as_built import Structure
from ..schema import key
from .change import Change, Event


@dataclass(frozen=True, slots=True, kw_only=True)
class Weakening(Change):
    """A loss of strength in one moment, such as by cut reinforcement: of all connections of the members' shards, of
    those in the box, or of all. What slept among them wakes up, so that they carry their load at once. Several at the
    same position multiply.
    """

    table: ClassVar[str] = "weakenings"
    kind: ClassVar[str] = "weakening"
    noun: ClassVar[str] = "weakening"

    factor: float = key("Part of the strength, or of the breaking force, that is left.", above=0, at_most=1)

    def described(self) -> tuple[str, str]:
        what = Text("weakening to {} % of the strength", f"{100.0 * self.factor:g}")
        return what, self.where or Text("everywhere")

    def event(self, structure: Structure) -> Event:
        connections = np.flatnonzero(self._connections(structure))
        self._check_concerns(connections, "connection", structure)
        return Event(self, np.zeros(0, int), connections, self.factor)
