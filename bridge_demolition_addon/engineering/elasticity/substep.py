"""What the compiled core takes and gives in a sub-step; `core/src/substep.h` and `terms.h` say what each field is.

All arrays have their components first.
"""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from typing import ClassVar

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray, same
from ..core.calls import call
from ..core.structs import Count, Doubles, Flags, Indices, NotFinite, Struct, WrittenDoubles, WrittenFlags
from .joint_rows import JointFrames

CRACKS, SPRINGS, BARE_BARS = range(3)
"""Kinds of terms."""

TURNED_RAD = 1e-4
"""Rotation of bodies after which rows and equations are made again: loads are then off by as much, relative."""

_MOST_GUESSES = 40
"""Largest number of solutions for bars that yield; forces out of balance then go into the next sub-step."""


class Frames(Struct):
    """Frames of connections: `bda_frames`."""

    _fields_ = (
        ("count", Count),
        ("first", Indices),
        ("second", Indices),
        ("first_axes", Doubles),
        ("second_axes", Doubles),
        ("first_points", Doubles),
        ("second_points", Doubles),
    )

    @classmethod
    def of(cls, frames: JointFrames, bodies: int) -> Frames:
        """Return the frames of connections between so many bodies."""
        count = len(frames)
        for ends in (frames.first, frames.second):
            if count and not (ends.min() >= 0 and ends.max() < bodies):
                raise ValueError(f"connections end in bodies {ends.min()} to {ends.max()} of {bodies}")
        made = cls(count=count)
        for name, array, components in (
            ("first", frames.first, 1),
            ("second", frames.second, 1),
            ("first_axes", frames.first_axes, 9),
            ("second_axes", frames.second_axes, 9),
            ("first_points", frames.first_points_m, 3),
            ("second_points", frames.second_points_m, 3),
        ):
            made.point(name, np.ascontiguousarray(array), components * count)
        return made


class Places(Struct):
    """Where bodies are: `bda_places`."""

    _fields_ = (("count", Count), ("positions", Doubles), ("rotations", Doubles))

    _last: ClassVar[Places]

    @classmethod
    def of(cls, positions_m: FloatArray, rotations: FloatArray) -> Places:
        """Return positions (3, n) and rotations (3, 3, n): those of last time, if these are the same arrays."""
        last = cls._last
        if last.given is not None and last.given[0] is positions_m and last.given[1] is rotations:
            return last
        count = positions_m.shape[1]
        made = cls(count=count)
        made.point("positions", np.ascontiguousarray(positions_m), 3 * count)
        made.point("rotations", np.ascontiguousarray(rotations), 9 * count)
        if positions_m.flags.c_contiguous and rotations.flags.c_contiguous:
            made.given, cls._last = (positions_m, rotations), made
        return made

    def __init__(self, **values: int) -> None:
        super().__init__(**values)
        self.given: tuple[FloatArray, FloatArray] | None = None


Places._last = Places()


class Term(Struct):
    """Forces of c connections, or of what is in their place, across q gaps: `bda_term`.

    Attributes
    ----------
    rows : (c,) int
        Their numbers among all that connects bodies.
    chosen_of_law : (c,) int
        Their numbers among those of their law.
    arrays : dict
        The arrays, by the names of their fields.
    """

    _fields_ = (
        ("kind", Count),
        ("connections", Count),
        ("gaps", Count),
        ("all_gaps", Count),
        ("law", ctypes.c_void_p),
        ("chosen", Indices),
        ("numbers", Indices),
        ("of_gap", Indices),
        ("which", Indices),
        ("first", Indices),
        ("second", Indices),
        ("first_arms", Doubles),
        ("second_arms", Doubles),
        ("widths", Doubles),
        ("remembered", WrittenDoubles),
        ("tangents", WrittenDoubles),
        ("of_first", WrittenDoubles),
        ("of_second", WrittenDoubles),
        ("yields", Doubles),
        ("stiffness", Doubles),
        ("modulus", Doubles),
        ("slips", Doubles),
        ("flows", Doubles),
        ("directions", Doubles),
        ("normals", Doubles),
        ("pressed", Doubles),
        ("rests", Doubles),
        ("grips", Doubles),
        ("dowel", ctypes.c_double),
        ("sheared", ctypes.c_double),
        ("vertical", Doubles),
        ("sideways", Doubles),
        ("capacity", Doubles),
        ("friction", Doubles),
        ("pressed_by", Doubles),
        ("pulls", Flags),
        ("above_first", Flags),
        ("solved_pressed", WrittenDoubles),
        ("lengths", Doubles),
        ("bared", Doubles),
        ("stays", Doubles),
        ("pulled_limits", Doubles),
        ("pressed_limits", Doubles),
        ("bared_lines", Doubles),
        ("holds", Flags),
        ("held_sideways", Count),
    )

    _OF_CONNECTIONS = ("chosen", "numbers", "above_first")

    @classmethod
    def of(
        cls,
        kind: int,
        rows: IntArray,
        chosen: IntArray,
        of_gap: IntArray,
        which: IntArray,
        remembered: FloatArray,
        ends: tuple[IntArray, IntArray],
        arms_m: tuple[FloatArray, FloatArray],
        widths_m: FloatArray,
        law: dict[str, FloatArray | BoolArray],
        in_core: Struct | None = None,
        **settings: float,
    ) -> Term:
        """Return a term with q gaps, which are `which` (q,) of all that are `remembered` (12, p).

        Gaps are between bodies `ends`, two (q,), at arms, two (3, q), of connections `of_gap` (q,). The arrays of the
        law are of gaps, with components first. `in_core` is what the core knows of all of the law, by which the term
        begins.
        """
        connections, gaps = len(rows), len(of_gap)
        made = cls(kind=kind, connections=connections, gaps=gaps, all_gaps=remembered.shape[-1], **settings)
        made.rows, made.chosen_of_law, made.in_core = rows, chosen, in_core
        made.law = None if in_core is None else ctypes.addressof(in_core)
        made.arrays = {
            "chosen": chosen,
            "numbers": rows,
            "of_gap": of_gap,
            "which": which,
            "first": ends[0],
            "second": ends[1],
            "first_arms": arms_m[0],
            "second_arms": arms_m[1],
            "widths": widths_m,
            "tangents": np.zeros((3, 3, gaps)),
            **law,
        }
        for name, array in made.arrays.items():
            size = connections if name in cls._OF_CONNECTIONS else gaps * (array.size // max(array.shape[-1], 1))
            made.point(name, np.ascontiguousarray(array), size)
        made.point("remembered", remembered, remembered.size)
        made.remembered_in = remembered
        made.impulses = np.zeros((6, connections)), np.zeros((6, connections))
        for name, array in zip(("of_first", "of_second"), made.impulses, strict=True):
            made.point(name, array, 6 * connections)
        return made

    @classmethod
    def of_cracks(
        cls,
        rows: IntArray,
        chosen: IntArray,
        remembered: FloatArray,
        dowel: float,
        sheared: float,
        in_core: Struct | None = None,
    ) -> Term:
        """Return a term of cracks (c,) whose arrays are not filled yet."""
        gaps = 4 * len(rows)
        whole = {name: np.empty(gaps, int) for name in ("which", "first", "second")}
        law: dict[str, FloatArray | BoolArray] = {
            name: np.empty((3, gaps)) for name in ("slips", "normals", "directions", "rests")
        }
        for name in ("yields", "stiffness", "modulus", "flows", "pressed", "grips"):
            law[name] = np.empty(gaps)
        return cls.of(
            CRACKS,
            rows,
            chosen,
            np.empty(gaps, int),
            whole["which"],
            remembered,
            (whole["first"], whole["second"]),
            (np.empty((3, gaps)), np.empty((3, gaps))),
            np.empty((3, gaps)),
            law,
            in_core,
            dowel=dowel,
            sheared=sheared,
        )

    def __init__(self, **values: float):
        super().__init__(**values)
        self.rows = self.chosen_of_law = np.zeros(0, int)
        self.in_core: Struct | None = None
        self.remembered_in = np.zeros((12, 0))
        self.arrays: dict[str, np.ndarray] = {}
        self.impulses = np.zeros((6, 0)), np.zeros((6, 0))  # (6, c), on first and on second bodies

    def is_of(self, chosen: IntArray, remembered: FloatArray) -> bool:
        """Whether these are its connections, and where their law remembers the last sub-step: of the same as before."""
        return self.remembered_in is remembered and same(self.chosen_of_law, chosen)

    def begin(self, positions_m: FloatArray, rotations: FloatArray) -> None:
        """Begin a sub-step with bodies at these positions, as one that is solved does by itself."""
        call("bda_begin_term", self, Places.of(positions_m, rotations))

    def resisted(self) -> FloatArray:
        """Return forces (d, q) across the gaps as they are, by which the tangents are written."""
        forces = np.empty((1 if self.kind == BARE_BARS else 3, self.gaps))
        call("bda_try_term", self, np.zeros_like(forces), forces)
        return forces


class Substep(Struct):
    """A sub-step: `bda_substep`."""

    _fields_ = (
        ("frames", ctypes.c_void_p),
        ("places", ctypes.c_void_p),
        ("substep_s", ctypes.c_double),
        ("turned_rad", ctypes.c_double),
        ("velocities", Doubles),
        ("masses", Doubles),
        ("inertias", Doubles),
        ("assembled_rotations", WrittenDoubles),
        ("stiffness", Doubles),
        ("damping_s", Doubles),
        ("rows", WrittenDoubles),
        ("parts", Count),
        ("bars", Count),
        ("equations", Indices),
        ("part_starts", Indices),
        ("part_bodies", Indices),
        ("part_of_body", Indices),
        ("part_of_connection", Indices),
        ("within_part", Indices),
        ("stale", WrittenFlags),
        ("awake", Flags),
        ("acting_count", Count),
        ("acting", Indices),
        ("offsets", Doubles),
        ("term_count", Count),
        ("terms", ctypes.c_void_p),
        ("most_guesses", Count),
        ("from_rest", Count),
        ("deformations", WrittenDoubles),
        ("rates", WrittenDoubles),
        ("of_first", WrittenDoubles),
        ("of_second", WrittenDoubles),
        ("of_bodies", WrittenDoubles),
        ("ends", WrittenDoubles),
        ("guesses", Count),
        ("factorings", Count),
        ("wrong", NotFinite),
    )

    def __init__(self) -> None:
        super().__init__(turned_rad=TURNED_RAD, most_guesses=_MOST_GUESSES)

    def stand(self, frames: Frames, places: Places) -> None:
        """Take over where connections and bodies are."""
        self.refer(frames=frames, places=places)

    def act(self, terms: Sequence[Term]) -> None:
        """Take over the terms that act in place of some connections."""
        self._terms = terms, (ctypes.c_void_p * max(len(terms), 1))(*(ctypes.addressof(term) for term in terms))
        self.term_count, self.terms = len(terms), ctypes.addressof(self._terms[1])

    def solve(self) -> None:
        """Find what connections, and terms in place of some, do in it.

        Raises
        ------
        NotFiniteError
            A quantity of a body or a connection is endless or no number.
        ValueError
            Numbers are out of range.
        MemoryError
            There is no room.
        """
        call("bda_solve_substep", self)


def deformations(frames: Frames, places: Places, chosen: IntArray) -> FloatArray:
    """Return deformations (6, m), m and rad, of chosen connections (k,), and 0 for the others."""
    found = np.zeros((6, frames.count))
    call("bda_deformations", frames, places, chosen.size, chosen, found)
    return found
