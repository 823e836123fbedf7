"""Connections as constraints of a Bullet world that was checked, as arrays over Bullet's own memory."""

from __future__ import annotations

import numpy as np

from ..engineering.core.calls import call
from ..engineering.core.structs import Addresses, Count, Doubles, Flags, Struct
from .collision_pairs import CollisionPairs
from .constraint_rows import ConstraintRows
from .layout import Layout
from .memory import BYTES, DOUBLES, POINTERS, gather_doubles
from .teardown import Fingerprints

FEEDBACK_DOUBLES = 16
"""btJointFeedback: force and torque on body A, force and torque on body B, four doubles each."""


class BulletConnections(Struct):
    """m connections: `bda_bullet_connections`."""

    _fields_ = (
        ("count", Count),
        ("addresses", Addresses),
        ("exists", Flags),
        ("cracked", Flags),
        ("enabled", Count),
        ("applied_impulse", Count),
        ("feedback", Doubles),
    )


class ConstraintTable:
    """m connections of a world, as long as it is bound; e of them exist in it. Nothing is written until `prepare`.

    Parameters
    ----------
    addresses
        (m,) uint64 of the constraints; 0 for one that does not exist.
    forbids_collision
        (m,) whether each keeps its bodies from colliding.
    collision_pairs
        Entries of these in Bullet's lists; None in a world that is not read.
    feedback
        (m, 4, 4) where Bullet is to write the loads of the connections; never to be freed.

    Attributes
    ----------
    exists
        (m,) whether each exists; kept up to date.
    cracked
        (m,) whether each has broken, and holds on by its reinforcement; kept up to date.
    core
        What the core gets of them.
    """

    def __init__(
        self,
        layout: Layout,
        addresses: np.ndarray,
        forbids_collision: np.ndarray,
        collision_pairs: CollisionPairs | None,
        feedback: np.ndarray,
    ):
        self.addresses, self.exists, self.feedback = addresses, addresses != 0, feedback
        self.cracked = np.zeros(len(addresses), bool)
        self._layout, self._constraint = layout, layout.constraint
        self._thresholds = gather_doubles(self._fields(layout.constraint.breaking_threshold))[:, 0]
        self._threshold_factor, self._holds = 1.0, False
        self._feedback_fields = POINTERS.indices(addresses + np.uint64(layout.constraint.joint_feedback))
        self._feedback_addresses = feedback.ctypes.data + np.arange(
            0, feedback.nbytes, 8 * FEEDBACK_DOUBLES, dtype=np.uint64
        )
        self._forbids_collision, self._collision_pairs = forbids_collision, collision_pairs
        self._pair_rows = np.cumsum(forbids_collision) - 1
        self._fingerprints = Fingerprints(layout, addresses[self.exists])
        offsets = layout.constraint.enabled, layout.constraint.applied_impulse
        self.core = BulletConnections(count=len(self), enabled=offsets[0], applied_impulse=offsets[1])
        for name, array in (("addresses", addresses), ("exists", self.exists), ("cracked", self.cracked)):
            self.core.point(name, array, len(self))
        self.core.point("feedback", feedback, FEEDBACK_DOUBLES * len(self))
        self._rows: ConstraintRows | None = None

    def __len__(self) -> int:
        return len(self.addresses)

    @property
    def existing(self) -> np.ndarray:
        """Addresses (e,) of those that exist."""
        return self.addresses[self.exists]

    def prepare(self) -> None:
        """Have Bullet write loads to our buffer."""
        self.feedback[:] = 0.0
        self.write_loads(wanted=True)

    def write_loads(self, *, wanted: bool) -> None:
        """Have Bullet write the loads after every sub-step, as from `prepare` on, or leave them as they are."""
        targets = self._feedback_addresses[self.exists] if wanted else np.uint64(0)
        POINTERS.everywhere[self._feedback_fields[self.exists]] = targets

    def intact(self) -> np.ndarray:
        """Return whether each connection (m,) exists and has not broken."""
        intact = np.empty(len(self), bool)
        call("bda_intact", self.core, intact)
        return intact

    def first_bodies(self) -> np.ndarray:
        """Return the addresses (e,) of Bullet's body A of those that exist."""
        return POINTERS.gather(self._fields(self._constraint.body_a))

    def break_rows(self, rows: np.ndarray) -> None:
        """Break connections (k,), as Bullet does at their breaking thresholds."""
        rows = rows[self.exists[rows]]
        BYTES.write(self.addresses[rows] + np.uint64(self._constraint.enabled), 0)
        self.feedback[rows] = 0.0  # Bullet would leave the last load of one whose bodies are not simulated any more
        self.cracked[rows] = False

    def crack_rows(self, rows: np.ndarray) -> None:
        """Have Bullet keep the rows of connections (k,) that broke: reinforcement holds on, and resists contacts."""
        rows = rows[self.exists[rows]]
        BYTES.write(self.addresses[rows] + np.uint64(self._constraint.enabled), 1)
        self.cracked[rows] = True

    def weaken(self, rows: np.ndarray, factor: float) -> None:
        """Multiply the breaking thresholds of connections (k,)."""
        rows = rows[self.exists[rows]]
        self._thresholds[(np.cumsum(self.exists) - 1)[rows]] *= factor
        self._write_thresholds()

    def hold_thresholds(self, *, held: bool) -> None:
        """Let no connection break at its threshold, or let them break again."""
        self._holds = held
        self._write_thresholds()

    def scale_thresholds(self, factor: float) -> None:
        """Let connections break at a multiple of the thresholds that Blender gave them."""
        if factor != self._threshold_factor:
            self._threshold_factor = factor
            self._write_thresholds()

    def let_broken_collide(self, intact: np.ndarray) -> None:
        """Let the bodies of connections (m,) that broke since the last call, and are not intact now, collide again."""
        broken = self._forbids_collision & ~intact
        if self._collision_pairs is not None and broken.any():
            self._collision_pairs.restore(self._pair_rows[broken])
            self._forbids_collision[broken] = False

    def elastic_rows(self, names: list[str]) -> ConstraintRows:
        """Return the rows of all connections, which have to exist; `restore` leaves them as Blender made them."""
        self._rows = ConstraintRows(self._layout, self.addresses, names)
        return self._rows

    def forget_freed(self) -> np.ndarray:
        """Mark those that Blender has freed by now; return whether each that existed (e,) is still there."""
        alive = self._fingerprints.still_there(self.existing)
        self.exists[self.exists] = alive
        return alive

    def restore(self) -> None:
        """Take our buffer, and what was written to rows, out of those that exist."""
        self.write_loads(wanted=False)
        if self._rows:
            self._rows.restore(np.flatnonzero(self.exists))

    def _fields(self, offset: int) -> np.ndarray:
        """Addresses (e,) of a field of the connections that exist."""
        return self.existing + np.uint64(offset)

    def _write_thresholds(self) -> None:
        values = np.inf if self._holds else self._thresholds * self._threshold_factor
        DOUBLES.write(self._fields(self._constraint.breaking_threshold), values)
