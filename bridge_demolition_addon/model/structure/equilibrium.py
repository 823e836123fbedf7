"""A model with elastic connections at rest under its own weight, before any simulation."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...engineering.elasticity.bearings import Bearings, PadSprings
from ...engineering.elasticity.equations import RigidBodies
from ...engineering.elasticity.equilibrium import Equilibrium, equilibrium
from ...engineering.elasticity.joint_rows import JointFrames, components_first
from ...engineering.elasticity.section_stiffness import SectionStiffness, in_frames
from ...engineering.elasticity.tendons import TendonForces
from ...engineering.mechanics.carried_sections import MemberSections, kinds_of
from ...engineering.mechanics.overloads import Overloads
from ...engineering.mechanics.section_cuts import ConnectedFaces, ConnectionLoads, section_axes
from ...engineering.mechanics.strength import MOTIONS, Joint, Strength
from ...engineering.structure.connections import GROUND, Connections
from ...engineering.units import STANDARD_GRAVITY_M_S2
from ..schema import given
from .model import Model


def deflection_m(model: Model, rest: Equilibrium) -> float:
    """Return the largest deflection of a shard that is held, m, as in `largest_deflection_m`."""
    shards = len(model.shards)
    held = rest.held[:shards]
    return largest_deflection_m(model.centres_m[held, 2] - rest.positions_m[2, :shards][held])


def largest_deflection_m(fallen_m: np.ndarray) -> float:
    """Return the largest of displacements (n,) downwards; below 0 where a larger one is upwards, as by tendons."""
    fallen, risen = float(fallen_m.max(initial=0.0)), float(-fallen_m.min(initial=0.0))
    return fallen if fallen >= risen else -risen


def overloaded(model: Model, rest: Equilibrium, joints: Sequence[Joint]) -> np.ndarray:
    """Return which connections (m,) of a model at rest are overloaded, so that the bridge does not stand.

    A breaking force is compared with each direction by itself, moments included, as Bullet does.
    """
    broken = force_utilisations(model, rest, joints) >= 1.0
    sections = member_sections_of(model)
    for row, joint in enumerate(joints):
        of_one = np.flatnonzero(model.breakable & (model.joint_of_connection == row))
        if joint.strength is not None and len(of_one):
            broken[_beyond_strength(model, rest, of_one, joint.strength, sections)] = True
    if model.bearings:
        whole = np.ones(len(model.connections))
        broken[model.bearings.springs.rows] = model.bearings.utilisations(loads_of(model, rest), whole > 0.0, whole) > 1
    return broken


def loads_of(model: Model, rest: Equilibrium) -> ConnectionLoads:
    """Return the connections' loads on their first bodies, of a model at rest."""
    return ConnectionLoads(rest.loads[:3].T, rest.loads[3:].T, model.connections.points)


def force_utilisations(model: Model, rest: Equilibrium, joints: Sequence[Joint]) -> np.ndarray:
    """Return the utilisation of the breaking force of each connection (m,) of a model at rest; nan without one.

    It is the largest of any direction: Bullet compares forces along three axes, and moments about them in N·m, one by
    one with the same number.
    """
    forces = np.array([np.nan if joint.breaking_force_n is None else joint.breaking_force_n for joint in joints])
    return abs(rest.loads).max(axis=0, initial=0.0) / forces[model.joint_of_connection]


def _beyond_strength(
    model: Model, rest: Equilibrium, rows: np.ndarray, strength: Strength, sections: MemberSections
) -> np.ndarray:
    """Return which connections (r,) with a strength would break first in a simulation, as indices (k,)."""
    loads = loads_of(model, rest)
    axes = section_axes(model.connections.normals[rows])
    whole, together = np.ones(len(model.connections)), np.zeros(len(model.connections), int)
    judged = overloads_of(model, strength, sections)
    return judged.overloaded(rows, loads, axes, whole > 0.0, whole, together)[0]


def member_sections_of(model: Model) -> MemberSections:
    """Return the sections across the members of a model."""
    faces, moves = _faces(model), _moves(model)
    return MemberSections(
        faces,
        np.vstack((model.centres_m, np.zeros(3))),
        moves,
        kinds_of(np.append(model.member_of_shard, -1)[faces.pairs]),
        model.thicknesses_m(),
    )


def overloads_of(model: Model, strength: Strength, sections: MemberSections) -> Overloads:
    friction = None
    if model.tendons:
        names = np.array([*(model.members[member].name for member in model.member_of_shard), ""])
        friction = model.tendons.friction(names[model.connections.pairs])
    return Overloads(_faces(model), _moves(model), strength, sections, friction=friction)


def _faces(model: Model) -> ConnectedFaces:
    """Return the faces of the connections; the ground is the last body."""
    connections = model.connections
    pairs = connections.pairs % (len(model.fixed) + 1)
    return ConnectedFaces(pairs, connections.points, connections.normals, connections.areas, model.second_moments_m4)


def _moves(model: Model) -> np.ndarray:
    """Whether each shard moves, and the ground, at index -1, which does not."""
    return np.append(~model.fixed, False)


def model_at_rest(model: Model, joints: Sequence[Joint]) -> Equilibrium:
    """Return where the shards of a model rest, and the ground behind them; its connections have to be elastic.

    Springs in motions that are free do not count. Tendons have their prestress.
    """
    masses = np.where(model.fixed, 0.0, model.masses_kg)
    held, pads = held_motions(model, joints), model.bearings.springs if model.bearings else None
    tendons = model.tendons.forces_of_shards(model.centres_m) if model.tendons else None
    return at_rest(
        model.connections,
        given(model.stiffness),
        masses,
        inertias_of(model),
        model.centres_m,
        held,
        pads=pads,
        tendons=tendons,
    )


def held_motions(model: Model, joints: Sequence[Joint]) -> np.ndarray:
    """Return whether connections hold displacements along and rotations about the axes of the world, (6, m)."""
    held = np.array([[motion not in joint.free for motion in MOTIONS] for joint in joints]).T
    return held[:, model.joint_of_connection]


def inertias_of(model: Model) -> np.ndarray:
    """Return the moments of inertia (n, 3) of the shards of a model; 0 for those that never move."""
    inertias = np.array([box_inertia(np.ptp(shard.vertices, axis=0)) for shard in model.shards])
    return inertias * np.where(model.fixed, 0.0, model.masses_kg)[:, None]


def box_inertia(size_m: np.ndarray) -> np.ndarray:
    """Return the moments of inertia (3,) of a box by its mass, m²: Bullet takes every shard for the box around it."""
    squares = np.square(size_m)
    return (squares.sum() - squares) / 12.0


def at_rest(
    connections: Connections,
    stiffness: SectionStiffness,
    masses_kg: np.ndarray,
    inertias_kg_m2: np.ndarray,
    centres_m: np.ndarray,
    held: np.ndarray | None = None,
    gravity_m_s2: tuple[float, float, float] = (0.0, 0.0, -STANDARD_GRAVITY_M_S2),
    loads: np.ndarray | None = None,
    pads: PadSprings | None = None,
    tendons: TendonForces | None = None,
) -> Equilibrium:
    """Return where n bodies rest under their own weight, and the ground as the last body.

    Parameters
    ----------
    masses_kg, inertias_kg_m2, centres_m : (n,), (n, 3), (n, 3) float
        Masses, 0 for those that never move, moments of inertia about the axes of the world, and centres of mass.
    held : (6, m) bool, optional
        Whether connections hold displacements along and rotations about the axes of the world; all by default.
    loads : (6, n) float, optional
        Further forces on the shards, N, and moments about their centres, N·m.
    pads : PadSprings, optional
        Springs in place of those connections that are bearings.
    tendons : TendonForces, optional
        Tendons, as they are after the cuts so far.
    """
    sections = components_first(section_axes(connections.normals))
    held = np.ones((6, len(connections)), bool) if held is None else held
    axes = np.repeat(np.eye(3)[:, :, None], len(connections), axis=2)
    first, second = connections.pairs.T
    second = np.where(second == GROUND, len(masses_kg), second)
    positions = np.vstack((centres_m, np.zeros(3)))
    levers = [components_first(connections.points - positions[ends]) for ends in (first, second)]
    tensors, unturned = np.zeros((3, 3, len(positions))), np.repeat(np.eye(3)[:, :, None], len(positions), axis=2)
    tensors[[0, 1, 2], [0, 1, 2], :-1] = inertias_kg_m2.T
    bearings = None
    if pads is not None:
        bearings = Bearings(pads, first, second, first[pads.rows], components_first(positions), unturned)
    return equilibrium(
        JointFrames(first, second, axes, axes, *levers),
        in_frames(stiffness, sections, held),
        RigidBodies(np.append(masses_kg, 0.0), tensors, components_first(positions), unturned),
        np.array(gravity_m_s2),
        None if loads is None else np.column_stack((loads, np.zeros(6))),
        bearings,
        tendons,
    )
