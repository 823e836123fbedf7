# SPDX-License-Identifier: GPL-3.0-or-later
"""Calls the entry points of the core with random arrays for some seconds: what is wrong is refused in words.

Arguments: seconds, the first seed, and the folder of another library, such as one with sanitizers, or nothing. Before
each case its seed is printed, so that one that ends the process is known.
"""

import sys
import time
from pathlib import Path

import numpy as np
from support.core_terms import forces_and_tangents, term_in_substep, term_of_law
from support.own_ticks import OwnMemory, elastic_tick

from bridge_demolition_addon.bullet.body_motion import BodyMotionReader, BulletBodies
from bridge_demolition_addon.bullet.constraint_rows import BulletRows, Softness
from bridge_demolition_addon.bullet.constraints import BulletConnections
from bridge_demolition_addon.bullet.contacts import BulletContacts
from bridge_demolition_addon.bullet.layout import SYSTEM_V
from bridge_demolition_addon.bullet.tick import StandingSprings, SubstepStage
from bridge_demolition_addon.engineering.blast.exposure import projected_areas
from bridge_demolition_addon.engineering.blast.pulses import Pulses, impulse_between
from bridge_demolition_addon.engineering.core import library
from bridge_demolition_addon.engineering.core.calls import answer_of, call
from bridge_demolition_addon.engineering.drilled_charges.cages import BareBars, Cages
from bridge_demolition_addon.engineering.elasticity.bearings import Bearings, PadSprings
from bridge_demolition_addon.engineering.elasticity.cracks import Cracks, ExpectedCracks, corner_positions
from bridge_demolition_addon.engineering.elasticity.equations import BlockSystem, RigidBodies
from bridge_demolition_addon.engineering.elasticity.joint_rows import JointFrames
from bridge_demolition_addon.engineering.elasticity.kept_joints import KeptJoints, velocities_alone
from bridge_demolition_addon.engineering.elasticity.springs import PressedSprings, SpringPositions, SpringsOfConnections
from bridge_demolition_addon.engineering.elasticity.steel_bars import Steel
from bridge_demolition_addon.engineering.elasticity.structure import ElasticStructure, StepInput
from bridge_demolition_addon.engineering.elasticity.substep import (
    BARE_BARS,
    CRACKS,
    SPRINGS,
    Frames,
    Places,
    Substep,
    Term,
    deformations,
)
from bridge_demolition_addon.engineering.foundations import Footings, SoilSprings
from bridge_demolition_addon.engineering.geometry.hulls import ConvexHulls
from bridge_demolition_addon.engineering.geometry.vectors import symmetric_eigenvectors
from bridge_demolition_addon.engineering.mechanics.carried_sections import CarriedSections, MemberSections
from bridge_demolition_addon.engineering.mechanics.frame_loads import LoadAccumulator, SubstepLoads
from bridge_demolition_addon.engineering.mechanics.overloads import Overloads
from bridge_demolition_addon.engineering.mechanics.section_cuts import ConnectedFaces
from bridge_demolition_addon.engineering.mechanics.strength import MATERIALS
from bridge_demolition_addon.engineering.mechanics.stress import average_stress
from bridge_demolition_addon.engineering.mechanics.touches import Touches
from bridge_demolition_addon.engineering.mechanics.work import PairImpulses, shared_work, works_on_bodies
from bridge_demolition_addon.errors import BlastError, LayoutError, NotFiniteError

REFUSALS = (ValueError, IndexError, TypeError, NotFiniteError, LayoutError, BlastError)
"""Of wrappers and of numpy, before anything is handed over."""

WRONG_OF = 12
"""One array in so many is wrong."""


class Cases:
    """Random calls by a seed."""

    def __init__(self, seed):
        self.rng = np.random.default_rng(seed)

    def count(self, most):
        """So many, often none or one."""
        return int(self.rng.choice([0, 1, self.rng.integers(0, most + 1)], p=[0.1, 0.2, 0.7]))

    def odd(self, array):
        """Return an array as it is, or one that is wrong."""
        if self.rng.integers(WRONG_OF) or not array.size:
            return array
        wrong = array.copy()
        place = tuple(self.rng.integers(size) for size in array.shape)
        if array.dtype.kind == "i":
            wrong[place] = self.rng.choice([-1, -7, 9, 10**6, 2**62])
        elif array.dtype.kind == "f":
            wrong[place] = self.rng.choice([np.nan, np.inf, -np.inf, 1e308, -1e-320])
        return [wrong, array[..., :-1], array.astype(np.float32), array.T, array.astype(np.int32)][self.rng.integers(5)]

    def numbers(self, *shape):
        return self.odd(self.rng.normal(size=shape) * 10.0 ** self.rng.integers(-3, 4))

    def among(self, count, size):
        """So many of a number of things, often the same, and now and then one that there is not."""
        return self.odd(self.rng.integers(0, max(size, 1), count) if size else np.zeros(0, int))

    def frames(self, bodies, count):
        axes = [self.numbers(3, 3, count) for _ in range(2)]
        ends = [self.among(count, bodies) for _ in range(2)]
        return JointFrames(*ends, *axes, *(self.numbers(3, count) for _ in range(2)))

    def places(self, bodies):
        return self.numbers(3, bodies), self.numbers(3, 3, bodies)

    def of_deformations(self):
        bodies, count = self.count(6), self.count(9)
        frames = Frames.of(self.frames(bodies, count), bodies)
        deformations(frames, Places.of(*self.places(bodies if self.rng.integers(6) else 1)), self.among(5, count))

    def of_forces_alone(self):
        bodies = self.count(6)
        moving = [self.numbers(6, bodies), self.numbers(6, bodies), self.numbers(bodies)]
        velocities_alone(*moving, self.numbers(3, 3, bodies), self.numbers(6, bodies), 0.01)
        count = self.count(9)
        joints = KeptJoints(self.frames(bodies, count), bodies, self.numbers(6, 6, count), self.numbers(6, count))
        joints.stored_j(self.among(4, count), *self.places(bodies))

    def of_equations(self):
        """No connection, repeated pairs, a body with itself, and bodies whose motion is known."""
        bodies, count = self.count(12), self.count(20)
        ends = [self.among(count, bodies) - self.rng.integers(0, 2) for _ in range(2)]
        system, shapes = BlockSystem(bodies, *ends), self.numbers(6, 6, bodies)
        chosen = [self.among(min(count, self.count(8)), count) for _ in range(2)]
        adding = [[self.numbers(6, 6, len(rows)) for _ in range(3)] for rows in chosen]
        system.assemble(np.einsum("ikn,jkn->ijn", shapes, shapes), chosen[0], *adding[0])
        system.factor(*((chosen[1], *adding[1]) if self.rng.integers(2) else ()))
        system.solve(self.numbers(6, bodies))

    def cracks(self, bodies, connections):
        rng = self.rng
        cracks = Cracks(
            Steel(),
            rng.uniform(0.001, 0.05, connections),
            self.odd(rng.uniform(0.0, 3e4, (4, connections))),
            self.odd(np.ones(connections)),
            self.odd(np.full(connections, 2e8)),
        )
        count = self.count(4)
        places, sides = self.numbers(3, count), self.numbers(3, 2, count)
        corners = corner_positions(places, sides, np.full((2, count), 0.4))
        ends = self.among(count, bodies), self.among(count, bodies)
        axes = self.numbers(3, count), self.numbers(3, count)
        cracks.add(self.among(count, connections), *ends, corners, *axes, *self.places(bodies))
        return cracks

    def of_cracks(self):
        bodies, connections = self.count(6), self.count(8)
        cracks, places = self.cracks(bodies, connections), self.places(bodies)
        cracks.update_plastic_state(*places)
        cracks.grip(*places)
        cracks.state(*places)
        chosen = self.among(self.count(4), len(cracks))
        term = term_in_substep(cracks, chosen, *places)
        moving = self.numbers(bodies), self.numbers(3, 3, bodies), self.numbers(6, bodies)
        ExpectedCracks.of(term, bodies).between(*moving).find(Places.of(*places), 0.01)

    def of_springs(self):
        bodies, count = self.count(6), self.count(9)
        ends = self.among(count, bodies), self.among(count, bodies)
        anchors = self.numbers(3, count), self.numbers(3, count)
        places = SpringPositions(np.zeros(count, int), *ends, *anchors, np.ones(1, bool))
        law = [self.numbers(count), self.numbers(2, count), self.numbers(count), self.numbers(count)]
        springs = PressedSprings(*law, self.rng.integers(0, 2, count).astype(bool), self.numbers(count))
        SpringsOfConnections(np.zeros(1, int), places, springs).standing(*self.places(bodies)).resisted()

    def of_bearings(self):
        """Pads and footings that settle and fail, of bodies and connections that there may not be."""
        rng, bodies, connections = self.rng, 1 + self.count(5), self.count(4)
        of = np.sort(self.among(self.count(9), connections))
        count, ends = len(of), [self.among(connections, bodies) for _ in range(2)]
        pads = PadSprings(
            np.arange(connections),
            of,
            self.numbers(count, 3),
            self.numbers(count),
            self.numbers(count, 2),
            np.where(self.flags(connections), np.inf, 0.5),
            self.flags(connections),
            self.numbers(connections),
            self.among(connections, 3),
            self.numbers(connections),
        )
        built, places = self.places(bodies), self.places(bodies if rng.integers(6) else 1)
        soil = SoilSprings(
            *(np.arange(connections), of, self.numbers(count, 3), self.numbers(count)),
            *(self.numbers(connections) for _ in range(4)),
        )
        springs = (
            Bearings(pads, *ends, ends[0], *built),
            Footings(soil, *ends, rng.integers(0, 2, bodies).astype(bool), *built),
        )
        for law in springs:
            law.update_plastic_state(*places)
            law.stored_j(*places)
            term = term_in_substep(law, np.unique(self.among(3, connections)), *places)
            forces_and_tangents(term, rng.normal(size=(3, term.gaps)))
        springs[0].failed(self.flags(connections), self.numbers(connections))

    def flags(self, *shape):
        return self.odd(self.rng.integers(0, 2, shape).astype(bool))

    def of_terms(self):
        """Laws by themselves: of cracks, springs and bare bars."""
        gaps = self.count(9)
        kind, of_gap = self.rng.choice([CRACKS, SPRINGS, BARE_BARS]), self.among(gaps, 1 + self.count(5))
        named = {
            CRACKS: (("yields", "stiffness", "modulus", "flows", "pressed", "grips"), ("slips", "normals", "rests")),
            SPRINGS: (("vertical", "capacity", "friction", "pressed_by"), ()),
            BARE_BARS: (("lengths", "bared", "stays", "pulled_limits", "pressed_limits"), ("bared_lines",)),
        }[kind]
        law = {name: self.numbers(*lead, gaps) for names, lead in zip(named, ((), (3,)), strict=True) for name in names}
        if kind == SPRINGS:
            law |= {"sideways": self.numbers(2, gaps), "pulls": self.flags(gaps)}
        else:
            law["directions"] = self.numbers(3, gaps)
        if kind == CRACKS:
            law |= {"dowel": 0.1, "sheared": 0.2}
        if kind == BARE_BARS:
            law |= {"yields": self.numbers(gaps), "stiffness": self.numbers(gaps), "holds": self.flags(gaps)}
        term = term_of_law(kind, law, self.numbers(3, gaps), of_gap)
        forces_and_tangents(term, self.rng.normal(size=(1 if kind == BARE_BARS else 3, term.gaps)))

    def of_bare_bars(self):
        """Groups of bars that come, settle and are taken away, in a sub-step of all."""
        bodies, count, connections = 1 + self.count(5), self.count(6), self.count(3)
        places = self.places(bodies)
        cages = Cages(
            self.rng.choice([connections, connections, self.count(9)]), held_sideways=bool(self.rng.integers(2))
        )
        bars = [self.odd(self.rng.uniform(low, high, count)) for low, high in ((1.0, 9.0), (0.01, 0.03), (2e8, 6e8))]
        ends = [self.among(count, bodies) for _ in range(2)]
        cages.add(BareBars(*ends, self.numbers(3, count), self.numbers(3, count), *bars), *places)
        masses = self.rng.uniform(1.0, 1e3, bodies)
        rigid = RigidBodies(masses, np.eye(3)[:, :, None] * masses, *places)
        structure = ElasticStructure(self.frames(bodies, connections), np.zeros((6, 6, connections)), rigid, 1e-4)
        for _ in range(2):
            structure.stand_bare(cages)
            start = StepInput(*places, self.numbers(6, bodies), np.zeros(bodies, bool))
            structure.step(start, np.ones(connections, bool), 0.002)
            structure.update_plastic_state(*places)
            structure.end_substep()
        cages.forces_n(*places)
        term = term_in_substep(cages, self.among(self.count(4), count), *places)
        forces_and_tangents(term, self.rng.normal(size=(1, term.gaps)))

    def connected(self, bodies, count):
        """Faces between bodies, in pairs that there may not be, with areas and second moments of nothing."""
        pairs = np.stack([self.among(count, bodies), self.rng.integers(0, bodies, count)[: count or None]], axis=1)
        return ConnectedFaces(
            self.odd(pairs), *(self.numbers(count, 3) for _ in range(2)), self.numbers(count), self.numbers(count, 2, 2)
        )

    def of_overloads(self):
        rng, bodies, count = self.rng, 1 + self.count(6), self.count(12)
        faces, moves = self.connected(bodies, count), rng.integers(0, 2, bodies).astype(bool)
        further = {name: self.numbers(count) for name in ("pressed", "friction") if rng.integers(2)}
        judging = Overloads(faces, moves, MATERIALS["concrete"], None, **further)
        own = self.among(count, bodies), self.numbers(count), self.numbers(count, 3), self.numbers(count, 3, 3)
        sections, left = CarriedSections(*own), self.numbers(count)
        loads, places = self.numbers(6, count), self.places(bodies)
        judging.over_alone(self.flags(count), sections, loads, *places, left)
        judging.breaking(self.flags(count), sections, loads, *places, left)
        rows = self.among(self.count(5), count)
        at_once = sections.loads_at_once(loads, *places)
        axes, thicknesses = self.numbers(len(rows), 3, 3), abs(self.numbers(count))
        judging.in_cuts(rows, at_once, axes, self.flags(count))
        kinds, centres = rng.integers(0, 2, count), self.numbers(bodies, 3)
        members = MemberSections(faces, centres, moves, kinds, thicknesses)
        judging = Overloads(faces, moves, MATERIALS["concrete"], members, **further)
        flags, alone = self.flags(count), self.numbers(len(rows))
        parts = self.odd(rng.integers(-1, 3, count))
        judging.together(rows, alone, at_once, axes, flags, left, parts)
        judging.breaking(flags, sections, loads, *places, left, parts)

    def of_frame_loads(self):
        bodies, count, substeps, points = 1 + self.count(6), self.count(9), 1 + self.count(3), self.count(5)
        pairs = self.odd(self.rng.integers(0, bodies, (count, 2)))
        loads = SubstepLoads(
            self.rng.uniform(0.001, 0.1, substeps),
            *(self.numbers(substeps, count, 3) for _ in range(3)),
            self.numbers(substeps, count),
            np.sort(self.rng.integers(0, substeps, points)),
            self.odd(self.rng.integers(0, bodies, (points, 2))),
            *(self.numbers(points, 3) for _ in range(2)),
            self.numbers(substeps, bodies, 3),
            self.numbers(substeps, bodies, 3, 3),
        )
        of_frame = LoadAccumulator(pairs, self.numbers(bodies), lambda rotations: self.numbers(count, 3))
        of_frame.add(loads)
        of_frame.finish()
        faces = [self.numbers(count, 3) for _ in range(2)]
        average_stress(pairs, *faces, self.numbers(bodies, 3), self.numbers(bodies), *faces)
        symmetric_eigenvectors(self.numbers(count, 3, 3))

    def of_works(self):
        bodies, count = self.count(6), self.count(9)
        first, second = self.among(count, bodies), self.among(count, bodies)
        impulses = [self.numbers(count, 3) for _ in range(3)]
        works = works_on_bodies(
            PairImpulses(np.zeros((count, 2), int), *impulses), self.numbers(6, bodies), first, second
        )
        returned = self.numbers(count) if self.rng.integers(2) else np.zeros(0)
        shared_work(self.numbers(count), returned, *works, first, second, self.flags(bodies))
        touches = Touches()
        for _ in range(3):
            substeps = 1 + self.count(3)
            pairs, ends = [self.rng.permutation(20)[: self.count(5)] for _ in range(substeps)], [0]
            ends += np.cumsum([len(own) for own in pairs]).tolist()
            rows = np.concatenate(pairs)
            touches.returned_energies(self.odd(rows), self.numbers(len(rows)), self.odd(np.array(ends)))
            touches.pass_over(int(self.rng.choice([0, 1, 100])))

    def of_blast(self):
        bodies, charges = self.count(6), self.count(3)
        shape = bodies, charges
        impulse_between(
            Pulses(*(self.numbers(*shape) for _ in range(4))), 0.0, float(self.rng.choice([0.0, 0.01, 9.0]))
        )
        of_bodies = self.rng.integers(0, 8, bodies)
        starts = np.concatenate(([0], np.cumsum(of_bodies)))
        faces = int(starts[-1])
        hulls = ConvexHulls(
            *(np.zeros((faces, 3)), np.zeros(faces), self.numbers(3, faces), np.zeros(faces), self.odd(starts)),
            *(np.zeros((0, 3)), np.zeros(bodies + 1, int)),
        )
        projected_areas(hulls, self.numbers(bodies, 3, 3), self.numbers(*shape, 3))

    def of_structure(self):
        """One body, all fixed, none connected, all asleep, pairs that are named twice."""
        rng, bodies, count = self.rng, self.count(7), self.count(12)
        masses = rng.uniform(1.0, 1e4, bodies) * rng.choice([0.0, 1.0], bodies, p=[0.3, 0.7]) * rng.integers(0, 4)
        places, shapes = self.places(bodies), rng.normal(size=(6, 6, count))
        rigid = RigidBodies(masses, np.eye(3)[:, :, None] * masses, *places)
        stiffness = self.odd(1e6 * np.einsum("ikn,jkn->ijn", shapes, shapes))
        cracks = self.cracks(bodies, count) if rng.integers(2) else None
        structure = ElasticStructure(self.frames(bodies, count), stiffness, rigid, 1e-4, cracks)
        intact = np.ones(count, bool)
        if cracks is not None:
            intact[cracks.rows] = False
        for _ in range(3):
            asleep = np.full(bodies, bool(rng.integers(4) == 0))
            structure.update_plastic_state(*places)
            start, substep_s = (
                StepInput(*places, self.numbers(6, bodies), asleep),
                float(rng.choice([1e-9, 0.002, 1.0])),
            )
            structure.step(start, intact, substep_s)
            structure.end_substep()
            intact &= rng.uniform(size=count) < 0.7
            places = places[0] + 1e-3 * rng.normal(size=places[0].shape), places[1]

    def of_parts(self):
        """A sub-step by hand: parts without equations, of no body, or of bodies that there are not."""
        rng, bodies, count = self.rng, 1 + self.count(5), self.count(6)
        parts = self.count(3)
        frames, places = Frames.of(self.frames(bodies, count), bodies), Places.of(*self.places(bodies))
        starts = np.concatenate(([0], np.sort(rng.integers(0, bodies + 1, parts))))
        systems = [BlockSystem(int(size), np.zeros(0, int), np.zeros(0, int)) for size in np.diff(starts)]
        addresses = np.array([system.address for system in systems], np.int64)
        acting = np.unique(rng.integers(0, count, self.count(4))) if count else np.zeros(0, int)
        substep = Substep()
        substep.substep_s, substep.parts, substep.acting_count = 0.01, parts, len(acting)
        for name, array, size in (
            ("velocities", self.numbers(6, bodies), 6 * bodies),
            ("masses", rng.uniform(1.0, 2.0, bodies), bodies),
            ("inertias", np.ascontiguousarray(np.eye(3)[:, :, None] * np.ones(bodies)), 9 * bodies),
            ("assembled_rotations", np.zeros((3, 3, bodies)), 9 * bodies),
            ("stiffness", self.numbers(6, 6, count), 36 * count),
            ("damping_s", np.zeros(count), count),
            ("rows", np.zeros((count, 36)), 36 * count),
            ("equations", addresses * rng.integers(0, 6, parts).clip(max=1), parts),
            ("part_starts", starts * rng.choice([1, 1, 1, 2, -1]), parts + 1),
            ("part_bodies", self.among(bodies, bodies), bodies),
            ("part_of_body", self.among(bodies, parts) if parts else np.full(bodies, -1), bodies),
            ("part_of_connection", self.among(count, parts) if parts else np.full(count, -1), count),
            ("within_part", self.among(count, count), count),
            ("stale", np.ones(parts + 1, bool), parts + 1),
            ("awake", rng.integers(0, 2, parts + 1).astype(bool), parts + 1),
            ("acting", self.odd(acting), len(acting)),
            ("deformations", np.zeros((6, count)), 6 * count),
            ("offsets", self.numbers(6, count), 6 * count),
            *((name, np.zeros((6, len(acting))), 6 * len(acting)) for name in ("rates", "of_first", "of_second")),
            *((name, np.zeros((6, bodies)), 6 * bodies) for name in ("of_bodies", "ends")),
        ):
            substep.point(name, array, size)
        substep.stand(frames, places)
        substep.act(list[Term]())
        substep.solve()

    def of_bullet(self):
        """Bodies, springs and contacts in memory of our own, with rows that there are not."""
        rng, count, size = self.rng, self.count(6), 4096
        memory = rng.normal(size=(count + 2) * size // 8)
        addresses = memory.ctypes.data + size * np.arange(count, dtype=np.uint64)
        reader = BodyMotionReader(SYSTEM_V, addresses)
        bodies = BulletBodies.of(SYSTEM_V.body, addresses)
        self.refused_or_done(reader.read)
        exists, sides = rng.integers(0, 2, (2, count)).astype(bool), self.among(count, 2 * count)
        connections = BulletConnections(count=count, enabled=32, applied_impulse=56)
        for name, array in (("addresses", addresses), ("exists", exists), ("cracked", ~exists)):
            connections.point(name, array, count)
        connections.point("feedback", self.odd(np.zeros((count, 16))), 16 * count)
        taken = np.empty((19, count)), np.empty((6, len(sides))), np.empty(count), np.empty(count, bool)
        call("bda_take_snapshot", bodies, connections, len(sides), sides, *taken)
        held = rng.integers(0, 2, (6, count)).astype(bool)
        rows, chosen = BulletRows.of(SYSTEM_V.spring, addresses, held, held), self.among(self.count(5), count)
        expected = ExpectedCracks.of(Term.of_cracks(chosen, chosen, np.zeros((12, 0)), 0.1, 0.1), count)
        softness = Softness(softest=0.5, free_from=2.0, flags=1, frame_a=80, frame_b=240)
        call("bda_put_cracks", rows, expected, softness, len(chosen), chosen, exists)
        whole = memory.view(np.int64)
        lists = SYSTEM_V.dispatcher
        dispatcher = memory.ctypes.data + count * size
        whole.view(np.int32)[(count * size + lists.manifold_count) // 4] = rng.choice([0, -1, 2**30, count])
        whole[(count * size + lists.manifold_data) // 8] = dispatcher + 1024
        whole[(count * size + 1024) // 8 :][:count] = addresses
        for number in range(count):
            at = (number * size + SYSTEM_V.manifold.count) // 4
            whole.view(np.int32)[at] = rng.choice([0, 1, 4, 5, -1, 2**30], p=[0.3, 0.3, 0.2, 0.1, 0.05, 0.05])
        contacts = BulletContacts.of(SYSTEM_V, dispatcher)
        contacts.make_room(self.count(8))
        assert answer_of("bda_copy_contacts", contacts) in range(4)

    def of_sub_steps(self):
        """Sub-steps by stages, in any order, of structures that there may not be, with numbers that are wrong."""
        rng, bodies, count = self.rng, 1 + self.count(5), self.count(6)
        masses = rng.uniform(1.0, 9.0, bodies) * rng.integers(0, 2, bodies)
        inverse = np.divide(1.0, masses, out=np.zeros(bodies), where=masses > 0.0)
        own = OwnMemory(rng.normal(size=(3, bodies)), inverse, count)
        own.put_vectors("linear_velocity", rng.normal(size=(bodies, 3)))
        rigid = RigidBodies(masses, np.eye(3)[:, :, None] * masses, *self.places(bodies))
        structure = ElasticStructure(self.frames(bodies, count), np.zeros((6, 6, count)), rigid, 1e-4)
        tick, _ = elastic_tick(own, structure, 0.01, self.odd)
        numbers = tick.count + int(rng.choice([0, 0, 0, -1]))
        tick.is_judged, tick.count = int(rng.integers(2)), numbers
        self.bear(tick, own, count)
        for first in (SubstepStage.READ, SubstepStage.TAKE, *rng.integers(-1, 11, 3)):
            tick.next = int(first)
            if tick.go_on():
                structure.choose(rng.integers(0, 2, count).astype(bool), rng.integers(0, 2, bodies).astype(bool))

    def bear(self, tick, own, count):
        """Have some connections stand on footings, of bodies and connections that there may not be."""
        bodies, of = own.core_bodies.count, self.among(self.count(3), count)
        if not len(of) or not count:
            return
        soil = SoilSprings(
            *(
                np.unique(of),
                np.searchsorted(np.unique(of), np.sort(of)),
                self.numbers(len(of), 3),
                abs(self.numbers(len(of))),
            ),
            *(self.numbers(len(np.unique(of))) for _ in range(4)),
        )
        ends = [self.among(count, bodies) for _ in range(2)]
        footings = Footings(soil, *ends, np.ones(bodies, bool), *self.places(bodies))
        tick.stand("footings", StandingSprings.of(self.odd(footings.rows), footings.core))

    def refused_or_done(self, act):
        try:
            act()
        except REFUSALS as refusal:
            assert str(refusal)
            return True
        return False


NAMES = [name for name in vars(Cases) if name.startswith("of_")]


def main():
    """Try case after case until the time is over."""
    seconds, seed, *folder = sys.argv[1:]
    if folder:
        library.FOLDER = Path(folder[0])
    tried, until = {name: [0, 0] for name in NAMES}, time.process_time() + float(seconds)
    number = int(seed)
    while time.process_time() < until:
        cases, name = Cases(number), NAMES[number % len(NAMES)]
        print(number, name, flush=True)
        with np.errstate(all="ignore"):
            tried[name][cases.refused_or_done(getattr(cases, name))] += 1
        number += 1
    print("done", tried)
    rare = [name for name, counts in tried.items() if min(counts) == 0]
    if rare:
        sys.exit(f"always done or always refused: {rare}")


main()
