"""Elastic connections of a world: calculated before each sub-step, put into Bullet as forces, and read with its own.

Arrays of vectors have their components first here, as in `engineering.elasticity`, unless they are said to be (r, 3).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass

import bpy
import numpy as np

from ...bullet.body_motion import BodyMotion
from ...bullet.constraint_rows import check_frames
from ...bullet.tick import StandingSprings, Tick
from ...bullet.world import BulletWorld
from ...engineering.arithmetic import power
from ...engineering.elasticity.bearings import Bearings, PadSprings
from ...engineering.elasticity.crack_state import CrackState
from ...engineering.elasticity.cracks import CRACK_STATES, Cracks, ExpectedCracks
from ...engineering.elasticity.equations import RigidBodies, without
from ...engineering.elasticity.equilibrium import Equilibrium, equilibrium
from ...engineering.elasticity.joint_rows import (
    JointFrames,
    components_first,
    components_last,
    effective_inverse_masses,
    inertia_tensors,
    joint_positions,
    matrix_products,
    transposed,
)
from ...engineering.elasticity.section_stiffness import SectionStiffness, in_frames
from ...engineering.elasticity.structure import ElasticStructure
from ...engineering.elasticity.substep import Places
from ...engineering.elasticity.tendons import TendonForces
from ...engineering.foundations import Footings, SoilSprings
from ...engineering.mechanics.crack_faces import CrackFaces, TornFaces
from ...engineering.mechanics.reinforcement import FaceBars
from ...engineering.mechanics.section_cuts import section_axes
from ...model.results.frames import Inventory
from ...model.schema import given
from ...model.structure.equilibrium import largest_deflection_m
from ...model.structure.tendons import ModelTendons
from ...scene.connections.constraints import Breaking
from ...scene.world import scene_time_step
from .standing_bars import StandingBarsOfZones

_SOFTEST = 0.1
"""Frequency over that of the bridge as it was built, down to which damping follows. What is softer is falling, and
keeps the damping that it had: more of it would break what hangs by little."""


_LEAST_CHANGE_M_S2 = 0.024
"""Change of velocities, by the length of a sub-step, with which Bullet's solver has found what contacts and connections
do to each other: a four-hundredth of gravity, 0.1 mm/s at 240 sub-steps a second. A pile that it leaves before creeps:
what lies on the ground learns by one connection a pass what hangs on it."""


@dataclass(frozen=True, slots=True)
class RestingState:
    """How a bridge deforms and vibrates under its weight alone.

    Attributes
    ----------
    deflection_m : float
        Largest downward displacement of a shard, below 0 where a larger one is upwards.
    frequency_hz : float
        First frequency; 0 where nothing is held.
    damping_ratio : float
        Its damping as a share of the critical one, with that of steps in time.
    held_bodies : int
        Bodies that connections to a support hold; the others fall, or lie on something by contact alone.
    """

    deflection_m: float
    frequency_hz: float
    damping_ratio: float
    held_bodies: int

    def to_json(self) -> dict[str, float]:
        """Return the values by the names that summaries have for them."""
        values = asdict(self)
        return {"sag_m": values.pop("deflection_m")} | values


@dataclass(frozen=True, slots=True, eq=False)
class SupportSprings:
    """What is in place of some elastic connections: soil under footings, and pads of bearings; and tendons beside all.

    None of what there is not.
    """

    soil: SoilSprings | None = None
    pads: PadSprings | None = None
    tendons: ModelTendons | None = None


@dataclass(frozen=True, slots=True, eq=False)
class ElasticEnergy:
    """Energy (m,) in connections and in cracks that reinforcement holds, and the state of these; None without any."""

    stored_j: np.ndarray
    cracks: CrackState | None


class ElasticConnections:
    """All connections of a world that was bound just now, before any time passes.

    The damping ratio is that of the first frequency, as a share of the critical one, also of what is left once
    connections break or supports go: of each part on a support, at most once a frame. Footings stand on soil where the
    ground yields, and pads of bearings press, lift off and slide. Tendons press as the bodies are put at rest; later
    they are among the loads on the bodies.

    Attributes
    ----------
    motion : BodyMotion
        How all bodies moved as the sub-step began.
    loads : (6, m) float
        Forces and torques in the last sub-step that was predicted, on the bodies on which they are read.

    Raises
    ------
    LayoutError
        Memory is not as expected; nothing has been written.
    """

    def __init__(
        self,
        scene: bpy.types.Scene,
        world: BulletWorld,
        inventory: Inventory,
        bodies: Sequence[bpy.types.Object],
        stiffness: SectionStiffness,
        damping_ratio: float,
        springs: SupportSprings | None = None,
    ):
        self._world, self._rows, self._reader = world, world.elastic_rows(), world.bodies.motion()
        self._damping_ratio = damping_ratio
        settings = [(body.rigid_body.linear_damping, body.rigid_body.angular_damping) for body in bodies]
        self._left_per_second = 1.0 - np.array(settings).T.repeat(3, axis=0)
        is_first = world.first_is_body_a()
        pairs = np.where(is_first[:, None], inventory.pairs, inventory.pairs[:, ::-1])
        (axes_a, points_a), (axes_b, points_b) = self._rows.frame_components()
        self._frames = JointFrames(pairs[:, 0], pairs[:, 1], axes_a, axes_b, points_a, points_b)
        motion = self._reader.read()
        self.motion = BodyMotion.room_for(len(motion.asleep))
        self._alone = np.empty_like(motion.velocity_components)
        _check_frames(self._frames, world, motion)
        positions = joint_positions(self._frames, motion.position_components_m, motion.rotation_components)
        sections = components_first(section_axes(inventory.normals))
        self._stiffness = in_frames(
            stiffness, matrix_products(transposed(positions.first_axes), sections), self._rows.held
        )
        self._axial_n_m = stiffness.axial_n_m
        self._masses = inventory.masses_kg
        self._inertias = inertia_tensors(motion.inverse_inertia_components, motion.rotation_components, self._masses)
        step = scene_time_step(scene)
        self._shortest_s, self._frame_s = step.substep_s, step.frame_s
        self._since_fit_s = np.inf
        self._gravity = np.array(scene.gravity, float) if scene.use_gravity else np.zeros(3)
        self._footings = self._bearings = None
        soil, pads = (springs.soil, springs.pads) if springs else (None, None)
        ends = self._frames.first, self._frames.second
        built = motion.position_components_m, motion.rotation_components
        if soil is not None:
            self._footings = Footings(soil, *ends, self._masses > 0.0, *built)
        if pads is not None:
            self._bearings = Bearings(pads, *ends, inventory.pairs[pads.rows, 0], *built)
            self._stiffness = without(self._stiffness, pads.rows)
        tendons = springs.tendons if springs else None
        self.tendons: TendonForces | None = tendons.forces(*built) if tendons else None
        laws = {"footings": self._footings, "bearings": self._bearings}
        self._standing = {name: StandingSprings.of(law.rows, law.core) for name, law in laws.items() if law}
        self._rest = self._settle(motion)
        self._frequencies = np.full(len(self._frames), self._rest.frequency_hz)  # of the part of each connection
        self._structure: ElasticStructure | None = None
        self._is_first = is_first
        self._inventory = inventory
        self._on_ground = (inventory.body_kinds == "ground")[inventory.pairs].any(axis=1)
        self._cracks: Cracks | None = None
        self._expected: ExpectedCracks | None = None
        self._holds = np.zeros(0, bool)
        self.bare_bars = StandingBarsOfZones(self._reader, motion, self._masses, len(self._frames))
        self._built = motion
        self._substep_s, self._left = 0.0, np.ones_like(self._left_per_second)
        self._on_first = np.ones(len(self._frames), bool)
        self.loads = np.zeros((6, len(self._frames)))
        world.constraints.hold_thresholds(held=True)
        world.rub_across(wanted=True)

    def reinforce(self, breaking: Breaking, left: np.ndarray) -> None:
        """Have reinforcement hold where connections break; to be called before any time passes.

        Events keep up to date which part of its strength each connection (m,) has left.
        """
        bars = breaking.bars or FaceBars.none(len(self._frames))
        if breaking.ductility:
            ductility = breaking.ductility
            even = ductility.strength_share * given(breaking.strength).tension_pa * self._inventory.areas_m2
            if self._bearings:
                even[self._bearings.rows] = 0.0  # no bars run through a bearing
            even[bars.have_own_law] = 0.0
            bars = bars.with_even(even, float(ductility.elongation_m))
        self._faces = CrackFaces(self._inventory.areas_m2, self._inventory.second_moments_m4, bars)
        self._cracks = self._faces.cracks(breaking.steel, left, self._axial_n_m)

    def tear(
        self,
        rows: np.ndarray,
        points_m: np.ndarray,
        axes: np.ndarray,
        forces_n: np.ndarray,
        moments_nm: np.ndarray,
    ) -> None:
        """Let the reinforcement hold of connections (r,) that broke at points (r, 3), with section axes (r, 3, 3).

        They carried forces (r, 3), and moments (r, 3) about these points, on their first bodies.
        """
        if self._bearings:
            crosses = ~np.isin(rows, self._bearings.rows)
            rows, points_m, axes = rows[crosses], points_m[crosses], axes[crosses]
            forces_n, moments_nm = forces_n[crosses], moments_nm[crosses]
        if self._cracks is None or not len(rows):
            return
        motion = self._reader.read()
        signs = np.where(self._is_first[rows], 1.0, -1.0)
        ends = self._frames.first[rows], self._frames.second[rows]
        torn = TornFaces(rows, *ends, points_m, axes, signs, forces_n, moments_nm)
        self._faces.tear(self._cracks, torn, motion.position_components_m, motion.rotation_components)
        self._world.constraints.crack_rows(rows)

    @property
    def resting_state(self) -> RestingState:
        """How the bridge deforms under its own weight."""
        rest, start = self._rest, self._built.position_components_m
        fallen = (start - rest.positions_m)[2, rest.held]
        frequency = rest.frequency_hz
        ratio = max(self._damping_ratio, np.pi * frequency * self._shortest_s) if frequency else 0.0
        return RestingState(largest_deflection_m(fallen), frequency, ratio, int(rest.held.sum()))

    @property
    def built_positions(self) -> tuple[np.ndarray, np.ndarray]:
        """Positions (n, 3) and rotations (n, 3, 3) of all bodies before they deform under their weight."""
        built = self._built
        return components_last(built.position_components_m), components_last(built.rotation_components)

    @property
    def parts(self) -> np.ndarray:
        """Part of the bridge that each connection (m,) was in as the sub-step began, -1 for broken ones."""
        return given(self._structure).parts

    def begin_substep(self, tick: Tick, substep_s: float) -> None:
        """Take over, before a sub-step of a length in s, what changes with the length, or once a frame."""
        is_other, are_added = substep_s != self._substep_s, self.bare_bars.take_added()
        self._since_fit_s += substep_s
        loses = self._since_fit_s >= (1.0 - 1e-6) * self._frame_s and self._structure and self._structure.has_lost
        if is_other or are_added or loses:
            self._reader.read_into(self.motion)
        if is_other:
            self._prepare(self.motion, substep_s)
        if are_added:
            given(self._structure).stand_bare(self.bare_bars.law)
        if loses:
            self._follow_frequencies(self.motion)
        given(self._structure).begin_substep(substep_s)
        self.hand_over(tick)

    def hand_over(self, tick: Tick) -> None:
        """Let a sub-step have springs and bars as they are now, and know whether all acts as it was chosen."""
        structure, cracks = given(self._structure), self._cracks if self._cracks else None
        tick.is_current = structure.is_current
        tick.point("left", self._left, self._left.size)
        tick.point("soft", self._softness, self._softness.size)
        tick.refer(solved=structure.solved, bars=self.bare_bars.law.core, cracks=cracks.core if cracks else None)
        if self._expected:
            self._expected.substep_s = self._substep_s
        if cracks and len(cracks) != len(self._holds):
            self._holds = np.empty(len(cracks), bool)
        tick.point("holds", self._holds, len(self._holds))

    def connect(self, tick: Tick) -> None:
        """Let sub-steps have what stays the same from one to the next."""
        count, motion = len(self._frames), self.motion
        tick.point("motion", motion.components, motion.components.size)
        tick.point("asleep", motion.asleep, motion.asleep.size)
        tick.point("alone", self._alone, self._alone.size)
        tick.point("intact", np.empty(count, bool), count)
        tick.point("on_first", self._on_first, count)
        tick.point("loads", self.loads, 6 * count)
        tick.refer(rows=self._rows.core, softness=self._rows.softness)
        for name, standing in self._standing.items():
            tick.stand(name, standing)
        if self._bearings:
            self._failed = np.empty(len(self._bearings.rows), bool)
            tick.point("failed", self._failed, len(self._failed))
            tick.refer(pads=self._bearings.core_pads)

    def forget_ruptured(self) -> None:
        """Break the connections whose cracks no bar holds any more, as the core has found."""
        self._world.constraints.break_rows(given(self._structure).forget(self._holds))

    def choose(self, tick: Tick) -> None:
        """Choose what acts: connections have broken, or parts fell asleep or woke."""
        structure, motion, count = given(self._structure), self.motion, len(self._frames)
        step = structure.choose(self._world.constraints.intact(), motion.asleep)
        numbers, awake = np.flatnonzero(structure.intact), np.empty(structure.awake.size, bool)
        tick.count = len(numbers)
        tick.point("numbers", numbers, len(numbers))
        tick.point("chosen", structure.intact, count)
        tick.point("awake", awake, awake.size)
        if step.crack_term is None:
            self._expected = None
        else:
            inertia = motion.inverse_masses, motion.inverse_inertia_components
            self._expected = ExpectedCracks.of(step.crack_term, len(motion.asleep)).between(*inertia, step.velocities)
            self._rows.let_resist_as_cracks(step.cracks)
        tick.refer(crack_term=step.crack_term, expected=self._expected)

    def end_substep(self) -> None:
        """Find parts again once the sub-step is put into Bullet, where connections broke."""
        given(self._structure).end_substep()

    def begin_energy(self, tick: Tick) -> ElasticEnergy:
        """Return room for the energy in connections and bars, and have a sub-step write it."""
        self.hand_over(tick)
        stored, states = np.empty(len(self._frames)), np.empty((CRACK_STATES, len(self._cracks or ())))
        tick.point("stored", stored, stored.size)
        tick.point("states", states, states.size)
        return ElasticEnergy(stored, CrackState(self._cracks.rows, *states) if self._cracks else None)

    @property
    def have_bars(self) -> np.ndarray | None:
        """Connections (m,) whose cracks bars cross; None without reinforcement."""
        return self._cracks.have_bars if self._cracks is not None else None

    def read_on(self, sides: np.ndarray) -> None:
        """Read loads on Bullet's body A (0) or B (1) of each connection (m,); to be called before any time passes."""
        self._on_first = sides == 0

    def holding(self, intact: np.ndarray) -> np.ndarray:
        """Return which connections (m,) hold, intact or by reinforcement."""
        if self._cracks is None:
            return intact
        holding = intact.copy()
        holding[self._cracks.rows] = True
        return holding

    def keeping_apart(self, holding: np.ndarray) -> np.ndarray:
        """Return which of connections (m,) keep their bodies from colliding: all that hold but two kinds.

        A foot that some bars have left turns about the others. It would sink into the ground, which is found out at
        once when the last of them has ruptured, and pushes it out with energy that is not there. Sides of a crack that
        have slid off each other press no more, so that their bodies meet as any do.
        """
        if self._cracks is None:
            return holding
        leaving = self._cracks.ruptured_in_part()
        apart = holding.copy()
        apart[leaving[self._on_ground[leaving]]] = False
        apart[self._cracks.slid_off()] = False
        return apart

    @property
    def failed_bearings(self) -> np.ndarray:
        """Connections (b,) at pads that break before the coming sub-step, as the core has found."""
        return self._bearings.rows[self._failed] if self._bearings else np.zeros(0, int)

    @property
    def held_corners(self) -> tuple[np.ndarray, tuple[int, int]]:
        """Connections (t,) that cracks replace, another array where there are others; corners held, and that meet."""
        cracks = given(self._cracks)
        return cracks.rows, cracks.held_corners

    def _settle(self, motion: BodyMotion) -> Equilibrium:
        """Put the bodies where they rest under their own weight."""
        masses = np.where(motion.inverse_masses > 0.0, self._masses, 0.0)
        bodies = RigidBodies(masses, self._inertias, motion.position_components_m, motion.rotation_components)
        rest = equilibrium(self._frames, self._stiffness, bodies, self._gravity, None, self._bearings, self.tendons)
        rows = np.flatnonzero(rest.held)
        self._reader.set_positions(rows, rest.positions_m[:, rows], rest.rotations[..., rows])
        return rest

    def _prepare(self, motion: BodyMotion, substep_s: float) -> None:
        """Take over the length of sub-steps."""
        self._substep_s, self._left = substep_s, power(self._left_per_second, substep_s)
        self._world.end_passes(_LEAST_CHANGE_M_S2 * substep_s)
        if self._structure is None:
            bodies = RigidBodies(
                self._masses, self._inertias, self._built.position_components_m, self._built.rotation_components
            )
            self._structure = ElasticStructure(
                self._frames,
                self._stiffness,
                bodies,
                self._damping_s,
                self._cracks,
                self._footings,
                self._bearings,
            )
            places = Places.of(motion.position_components_m, motion.rotation_components)
            self._structure.stand(places, self._alone)
        self._structure.damp(self._damping_s)
        self._soften(motion)

    @property
    def _damping_s(self) -> np.ndarray:
        """Damping over stiffness, β (m,), with which the first frequencies of all parts have the damping ratio.

        Damping in proportion to stiffness has the ratio π f β, to which implicit steps add π f dt.
        """
        frequencies = self._frequencies
        wanted = np.divide(
            self._damping_ratio, np.pi * frequencies, out=np.zeros_like(frequencies), where=frequencies > 0.0
        )
        return np.maximum(wanted - self._substep_s, 0.0)

    def _follow_frequencies(self, motion: BodyMotion) -> None:
        """Have the damping ratio hold for parts that have lost connections."""
        structure = given(self._structure)
        fitted = structure.frequencies_after_breaks(motion.position_components_m, motion.rotation_components)
        if not fitted:
            return
        self._since_fit_s = 0.0
        for rows, frequency in fitted:
            if frequency >= _SOFTEST * self._rest.frequency_hz:
                self._frequencies[rows] = frequency
        structure.damp(self._damping_s)
        self._soften(motion)

    def _soften(self, motion: BodyMotion) -> None:
        """Make Bullet's own constraints as soft as the connections are in a sub-step."""
        substep_s = self._substep_s
        positions = joint_positions(self._frames, motion.position_components_m, motion.rotation_components)
        intact = np.flatnonzero(self._world.constraints.intact())
        rows, ends = positions.rows(), (self._frames.first, self._frames.second)
        inverse = effective_inverse_masses(rows, ends, motion.inverse_masses, motion.inverse_inertia_components)
        diagonal = self._stiffness[np.arange(6), np.arange(6)].copy()
        if self._bearings:
            diagonal[:, self._bearings.rows] = self._bearings.diagonal()
        hardness = substep_s * (substep_s + self._damping_s) * diagonal * inverse
        softness = np.divide(1.0, hardness, out=np.full_like(hardness, np.inf), where=hardness > 0.0)
        self._softness = np.ascontiguousarray(softness)
        for standing in self._standing.values():
            standing.touch()
        self._rows.soften(intact, softness[:, intact])
        # Sleeping bodies are held as they are, in the sub-step in which Bullet finds what wakes them.
        self._rows.expect(intact, positions.deformations()[:, intact])


def _check_frames(frames: JointFrames, world: BulletWorld, motion: BodyMotion) -> None:
    """Check that frames are where Blender shows their connections."""
    positions = joint_positions(frames, motion.position_components_m, motion.rotation_components)
    for axes, bodies, levers in (
        (positions.first_axes, frames.first, positions.first_levers_m),
        (positions.second_axes, frames.second, positions.second_levers_m),
    ):
        points = components_last(motion.position_components_m[:, bodies] + levers)
        check_frames(components_last(axes), points, world.connection_objects)
