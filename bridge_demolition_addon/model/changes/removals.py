"""Removals and weakenings: shards that are taken away, and strength that connections lose, in one moment."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from ...engineering.units import mass_text
from ...texts import Text
from ..actions import CutBox, Fact, Worksite
from ..as_built import Structure
from ..schema import key
from .change import Change, Event


@dataclass(frozen=True, slots=True, kw_only=True)
class Removal(Change):
    """Shards that are taken away in one moment, such as a pier that is kicked out: all of the members, or what of them
    lies in the box. The members are cut along the sides of the box before they are made into shards, so that what goes
    weighs what the box holds. Connections of what goes are cut, it collides with nothing any more, and what slept wakes
    up. It is put out of sight, 1000 m below its position.
    """

    table: ClassVar[str] = "removals"
    kind: ClassVar[str] = "removal"
    noun: ClassVar[str] = "removal"

    along: str = key(
        "What ends at the box: `box` cuts shards apart along its sides; `faces` takes whole shards, those whose "
        "centres of mass lie in it, and so do all removals of steelwork and of members with `fracture.points`.",
        default="box",
        choices=("box", "faces"),
    )

    def cut_planes(self) -> tuple[CutBox, ...]:
        return (CutBox(self.members, self.box),) if self.box and self.along == "box" else ()

    def _check_together(self) -> None:
        Change._check_together(self)
        if self.members is None and self.lowest_corner_m is None:
            raise self.unexpected("members", "it, or the two corners of a box")

    def facts(self, site: Worksite) -> Iterator[Fact]:
        structure, gone = site.structure, self.event(site.structure).bodies
        mass = mass_text(float(structure.masses_kg[gone].sum()), 1)
        names = ", ".join(sorted(set(structure.member_names[gone].tolist())))
        yield f"{self.time_s:.3f} s", f"{self.kind}, {self.where}: {mass} of {names}"
        yield from self.facts_of_held(structure)

    def event(self, structure: Structure) -> Event:
        inside = self.of_members(structure) & self.in_box(structure.centres_m)
        bodies = np.flatnonzero(inside & structure.is_shard)
        self._check_concerns(bodies, "shard", structure)
        connections = structure.connected_to(bodies)
        return Event(self, bodies, connections, 0.0, tendons=structure.tendons_cut_with(connections, bodies))

    def _why_held(self, names: str) -> str:
        return (
            f"{names} cannot be taken away, as [[supports]] hold all of it that is meant; cut off what rests on it "
            "with [[saw_cuts]], or take it out of [[supports]] and have connections.foundation hold its foot"
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class LiftingAway(Removal):
    """A part that a crane lifts away: it is taken out in one moment. It follows from a table of `[[lifts]]`, and is no
    table of a scenario; a scene keeps it.
    """

    table: ClassVar[str] = "liftings_away"
    kind: ClassVar[str] = "lifting away"
    by_crane: ClassVar[bool] = True

    name: str = key("Name of the lift.")

    def recorded(self) -> Mapping[str, Any]:
        return {"lift": self.name}


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
