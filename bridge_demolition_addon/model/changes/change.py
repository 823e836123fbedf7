"""Changes: what is done to the structure in one moment, as an event on bodies and connections."""

from abc import abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from ...engineering.elasticity.tendons import CutTendon
from ...errors import ScenarioError
from ...texts import Text
from ..actions import Fact, Plan, Worksite
from ..as_built import Structure
from ..loads.part import Part
from ..schema import key
from .bare_bars import StandingBars
from .departures import Departure


@dataclass(frozen=True, eq=False, slots=True)
class Event:
    """A change as rows of bodies that it removes, and of connections."""

    change: "Change"
    bodies: np.ndarray  # (b,), bodies that no longer carry: removed, or thrown out of their member
    connections: np.ndarray  # (c,), those that are cut or weakened
    factor: float  # on their strength; 0 for those that are cut
    departure: Departure | None = None  # how the bodies of a blast zone leave their member
    bars: StandingBars | None = None  # those that stay in it
    compression_factor: float = 1.0  # on the strength in compression, beside the factor on all strengths
    tendons: tuple[CutTendon, ...] = ()  # that are cut, and where

    @property
    def time_s(self) -> float:
        return self.change.time_s

    @property
    def kind(self) -> str:
        return self.change.kind


@dataclass(frozen=True, slots=True, kw_only=True)
class Change(Part):
    """A change at a time to a part of the bridge: to some members, to what lies in a box, or to both at once."""

    table: ClassVar[str] = "changes"
    kept_in: ClassVar[str] = "changes"
    kind: ClassVar[str] = "change"
    by_crane: ClassVar[bool] = False
    """Whether a crane takes bodies away, which nothing may hold."""

    time_s: float = key("When it happens.", unit="s", at_least=0)

    def begins_s(self, plan: Plan) -> float:
        return self.time_s

    def facts(self, site: Worksite) -> Iterator[Fact]:
        yield f"{self.time_s:.3f} s", f"{self.kind}, {self.where or 'everywhere'}"

    def check_plan(self, plan: Plan) -> None:
        """Check that it happens between the end of the settling and the end of the run."""
        latest_s = plan.time.duration_s - plan.time.step.frame_s
        if not plan.warm_up_s <= self.time_s < latest_s:
            latest = f"less than {latest_s:.6g} (s), a frame before time.duration_s is over"
            raise self.unexpected("time_s", f"at least connections.warm_up_s, {plan.warm_up_s} (s), and {latest}")

    def check_model(self, site: Worksite) -> None:
        site.affected_by(self)

    def shards(self, structure: Structure, number: int) -> np.ndarray:
        event = self.event(structure)
        concerned = np.union1d(event.bodies, structure.pairs[event.connections])
        there: np.ndarray = concerned[(structure.is_shard | structure.held)[concerned]]
        return there

    def changes(self, plan: Plan) -> Iterator["Change"]:
        yield self

    def described(self) -> tuple[str, str]:
        return Text(self.kind), self.where or Text("everywhere")

    @property
    def step(self) -> str:
        """What is done, in a word for a stage; empty where its bodies or connections say it."""
        return ""

    def recorded(self) -> Mapping[str, Any]:
        """Return what a run says of it apart from time, kind, shards and connections, ready for JSON."""
        return {}

    @abstractmethod
    def event(self, structure: Structure) -> Event:
        """Return it as rows of a structure; refuse one that concerns nothing."""

    def _connections(self, structure: Structure) -> np.ndarray:
        """Return whether each connection (m,) has a shard of the members and is in the box."""
        return self.of_members(structure)[structure.pairs].any(axis=1) & self.in_box(structure.points_m)

    def _check_concerns(self, rows: np.ndarray, things: str, structure: Structure) -> None:
        """Refuse a change without rows (k,) of bodies or connections, and say why there are none."""
        if len(rows):
            return
        chosen = self.of_members(structure) & self.in_box(structure.centres_m)
        if (chosen & structure.is_shard).any() or not (chosen & structure.held).any():
            why = f"no {things} of the bridge is there; expected members, a box or a plane that meet some"
        else:
            why = self._why_held(", ".join(sorted(set(structure.member_names[chosen & structure.held].tolist()))))
        raise ScenarioError(f"{self.table} at {self.time_s:g} s: {why}")

    def _why_held(self, names: str) -> str:
        """Return why nothing of members that supports hold is concerned."""
        return (
            f"{names} has no connection there, as [[supports]] hold all of it that is meant; expected members, a box "
            "or a plane that meet a connection to what can move"
        )


def schedule(changes: Sequence[Change], structure: Structure) -> tuple[Event, ...]:
    """Return changes as events, in order of time; changes at the same time keep their order."""
    return tuple(sorted((change.event(structure) for change in changes), key=lambda event: event.time_s))
