"""A sub-step of Bullet in the core: all that is done before it, and after it, in one call each.

Where something happens that changes the structure, a call ends at once and says what; it goes on by another.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from enum import IntEnum, IntFlag

import numpy as np

from ..engineering.core.calls import CONTACT_IMPULSE, DONE, NOT_FINITE, answer_of, fault
from ..engineering.core.structs import (
    Count,
    Doubles,
    Flags,
    Indices,
    NotFinite,
    Struct,
    WrittenDoubles,
    WrittenFlags,
)
from ..errors import LayoutError
from .body_motion import SYMMETRIC, WRONG_INERTIA
from .contacts import TOO_MANY_CONTACTS


class SubstepStage(IntEnum):
    """What is next in a sub-step, in the order of `core/src/tick.h`."""

    READ, SETTLE, PREDICT, JUDGE, PUT, TURN, BULLET, TAKE, STORE, END = range(10)


class Found(IntFlag):
    """What Python has to do before a call goes on, as in `core/src/tick.h`."""

    RUPTURED, OTHERS_ACT, NO_SECTIONS, OVERLOADED, NO_ROOM = (1 << bit for bit in range(5))


_MEANINGS = {SubstepStage.READ: WRONG_INERTIA, SubstepStage.TURN: WRONG_INERTIA, SubstepStage.TAKE: TOO_MANY_CONTACTS}
"""What it means where numbers are out of range."""


class StandingSprings(Struct):
    """Footings or pads, whose constraints of Bullet's become softer as less of them touches: `bda_standing`."""

    _fields_ = (
        ("springs", ctypes.c_void_p),
        ("rows", Indices),
        *((name, WrittenDoubles) for name in ("followed", "energies")),
    )

    @classmethod
    def of(cls, rows: np.ndarray, springs: Struct) -> StandingSprings:
        """Return those in place of connections (c,), with their springs as the core takes them."""
        made, count = cls(), springs.connections
        made.touching = np.ones(count)
        made.refer(springs=springs)
        return made.take(rows=(rows, count), followed=(made.touching, count), energies=(np.empty(count), count))

    def touch(self) -> None:
        """Take all of them for touching, as constraints are made."""
        self.touching[:] = 1.0


class Tick(Struct):
    """A sub-step of Bullet, of n bodies and m connections: `bda_tick`."""

    _fields_ = (
        ("next", Count),
        ("found", Count),
        *((name, ctypes.c_double) for name in ("substep_s", "symmetric", "redistributed")),
        *((name, Count) for name in ("is_judged", "in_members", "is_current")),
        *((name, ctypes.c_void_p) for name in ("bodies", "connections", "contacts")),
        ("times", Doubles),
        *((name, ctypes.c_void_p) for name in ("judging", "coming", "carried")),
        *((name, ctypes.c_void_p) for name in ("solved", "rows", "softness")),
        ("soft", Doubles),
        *((name, ctypes.c_void_p) for name in ("cracks", "crack_term", "expected")),
        *((name, StandingSprings) for name in ("footings", "bearings")),
        *((name, ctypes.c_void_p) for name in ("pads", "bars")),
        *((name, WrittenDoubles) for name in ("motion", "alone")),
        *((name, WrittenFlags) for name in ("asleep", "awake")),
        ("left", Doubles),
        ("holds", WrittenFlags),
        *((name, Flags) for name in ("chosen", "on_first")),
        ("intact", WrittenFlags),
        ("loads", WrittenDoubles),
        ("whole", Flags),
        ("strength", Doubles),
        ("failed", WrittenFlags),
        ("sides", Indices),
        *((name, WrittenDoubles) for name in ("components", "taken", "impulses")),
        ("left_intact", WrittenFlags),
        ("numbers", Indices),
        ("count", Count),
        *((name, WrittenDoubles) for name in ("stored", "states")),
        ("wrong", NotFinite),
    )

    def __init__(self) -> None:
        super().__init__(symmetric=SYMMETRIC)
        self.body_of_contact: Callable[[], int] = int

    def stand(self, name: str, standing: StandingSprings) -> None:
        """Take over footings or bearings."""
        setattr(self, name, standing)  # a copy of it, which points to what this one keeps
        self.keep(name, standing)

    def go_on(self) -> Found:
        """Go on with the sub-step, and return what has happened.

        Raises
        ------
        NotFiniteError
            A quantity is endless or no number.
        LayoutError
            Bullet's memory is not as expected.
        ValueError
            Numbers are out of range.
        MemoryError
            There is no room.
        """
        answer = answer_of("bda_go_on", self)
        if answer not in {DONE, NOT_FINITE} and self.next in _MEANINGS:
            raise LayoutError(_MEANINGS[SubstepStage(self.next)])
        if answer:
            if answer == NOT_FINITE and self.next == SubstepStage.TAKE and self.wrong.quantity == CONTACT_IMPULSE:
                self.wrong.row = self.body_of_contact()
            raise fault(answer, self.wrong)
        return Found(self.found)
