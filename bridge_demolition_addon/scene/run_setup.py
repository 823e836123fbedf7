"""All that decides a run, read from its scene once.

Each field of `RunSetup` says which parts of it go into the digest of the scene, which are compared with the scene as it
was built, and how a scenario says it, or why not. The digest, manual edits, the scenario of a run and its recording
follow from the fields.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import astuple, dataclass, field, fields, replace
from functools import cached_property
from typing import Any

import bpy
import numpy as np

from ..engineering.foundations import SoilSprings
from ..engineering.geometry.hulls import ConvexHulls, convex_hulls
from ..engineering.geometry.vectors import transformed
from ..errors import ScenarioError
from ..model.as_built import Structure
from ..model.blast.charges import Charge
from ..model.blast.explosion import Explosion
from ..model.blast.settings import BlastSettings
from ..model.changes.change import Change, Event, schedule
from ..model.loads.part import PlacedLoad, SizedLoad, placed_loads
from ..model.pulls import Pull
from ..model.results.arrays import digest, known_parts
from ..model.results.frames import Inventory
from ..model.scenario import Scenario
from ..model.scenario.fall_beds import FallBed
from ..model.sequence.lifts import recorded_structure
from ..model.structure.tendons import ModelTendons
from .blast.charges import blast_of, charges_of
from .bodies import Kind, start_motion_of
from .body_settings import BodySettings, body_settings_of
from .connections.constraints import Breaking, ConstraintSettings, breaking_of, constraint_settings_of
from .connections.elasticity import (
    BearingsOfScene,
    ConnectionElasticity,
    bearings_of,
    elasticity_of,
    named_bearings_of,
    soil_of,
    tendons_of,
)
from .custom_properties import run_tables_of
from .effective_scenario import with_bodies, with_duration, with_first_frame, with_speed, with_time_step
from .inventory import take_inventory
from .tools.ground_motion import GroundMotionOfScene, ground_motion_of
from .world import TimeOfScene, time_of

Parts = Mapping[str, Any]
"""Arrays, numbers and texts by names, as `digest` takes them."""

Writer = Callable[[Any, Scenario], Scenario]
"""Takes the value of a field over into a scenario; raises `ScenarioError` on what no scenario can say."""

_ALWAYS_S = 1e6
"""After this time every pulse of a blast is over."""

_NOT_IN_DIGEST = "fingerprints of earlier runs do not have it"
_NO_KEY = "a scenario has no key for it"
_SAME_KEY = "the scenario that was built says it"
_BY_KEY = "the scenario of the run says it"


def decides(
    *,
    hashed: Callable[[RunSetup], Parts] | str,
    compared: Mapping[str, Callable[[RunSetup], Parts]] | str,
    written: Sequence[Writer] | str,
) -> Any:
    """Return a field of `RunSetup` that says what follows from it; a text says why nothing does.

    Parameters
    ----------
    hashed
        Its parts in the digest of what was built.
    compared
        Its parts that are compared with the scene as it was built, by the text for a difference.
    written
        How it is written into the scenario of a run.
    """
    return field(metadata={"hashed": hashed, "compared": compared, "written": written})


def _elastic_parts(setup: RunSetup) -> Parts:
    elasticity, breaking = setup.elasticity, setup.breaking
    if elasticity is None:
        return {}
    parts = known_parts(elasticity.stiffness)
    parts |= {"damping_ratio": elasticity.damping_ratio, "thicknesses_m": elasticity.thicknesses_m}
    return parts | ({"steel": np.array(astuple(breaking.steel))} if breaking.is_reinforced else {})


def _soil_parts(setup: RunSetup) -> Parts:
    """Return no parts for rigid connections: soil only deforms under elastic ones."""
    if setup.elasticity is None or setup.soil is None:
        return {}
    return {f"soil {name}": values for name, values in known_parts(setup.soil).items()}


def _bearing_parts(setup: RunSetup) -> Parts:
    """Return no parts for rigid connections: there pads are as other connections are."""
    if setup.elasticity is None or setup.bearings is None:
        return {}
    return {f"bearings {name}": values for name, values in known_parts(setup.bearings.springs).items()}


def _tendon_parts(setup: RunSetup) -> Parts:
    """Return no parts without tendons, nor for rigid connections: there they do not press."""
    if setup.elasticity is None or setup.tendons is None:
        return {}
    parts = {f"tendons {name}": values for name, values in known_parts(setup.tendons.steel).items()}
    return parts | {f"passages {name}": values for name, values in known_parts(setup.tendons.passages).items()}


def _breaking_parts(setup: RunSetup) -> Parts:
    breaking = setup.breaking
    limits = {"strength_pa": breaking.strength, "ductility": breaking.ductility}
    parts = {name: np.array(astuple(limit) if limit else (), float) for name, limit in limits.items()}
    bars = breaking.bars
    if not bars:
        return parts
    parts |= {"bars": np.column_stack((bars.yield_n, bars.offsets_m, bars.directions, bars.openings_m))}
    if bars.yield_shares is not None:
        parts |= {"yield_shares": np.nan_to_num(bars.yield_shares)}
    return parts if bars.hinges is None else parts | {"hinges": np.nan_to_num(bars.hinges)}


def _load_parts(setup: RunSetup) -> Parts:
    parts: dict[str, Any] = {}
    for number, placed in enumerate(setup.placed_loads):
        bears = np.stack((placed.bodies, placed.shares))
        parts |= {f"load {number}": placed.load.course, f"load {number} bears": bears}
    return parts


def _pull_parts(setup: RunSetup) -> Parts:
    """Return no parts without cables: fingerprints of earlier runs do not have them."""
    parts: dict[str, Any] = {}
    for number, placed in enumerate(setup.placed_pulls):
        parts |= {f"pull {number}": [repr(placed.load)], f"pull {number} bears": placed.bodies}
    return parts


def _bed_parts(setup: RunSetup) -> Parts:
    """Return no parts without beds: fingerprints of earlier runs do not have them."""
    return {"fall beds": [repr(bed) for bed in setup.fall_beds]} if setup.fall_beds else {}


def _ground_motion_parts(setup: RunSetup) -> Parts:
    motion = setup.ground_motion
    if motion is None:
        return {}
    times = motion.start_s + motion.record.times_s
    return {"ground_motion": np.column_stack((times, motion.record.accelerations_m_s2))}


def _time_parts(setup: RunSetup) -> Parts:
    step, farthest_m = setup.time.step, setup.time.farthest_per_substep_m
    return {"step": [step.frame_s, step.substep_s, *([] if farthest_m is None else [farthest_m])]}


def _blast_parts(setup: RunSetup) -> Parts:
    """Return the impulses of the charges together on the bodies as they were built."""
    if not setup.goes_off:
        return {"blast_impulses_ns": np.zeros(0)}
    positions_m, rotations = setup.bodies.positions_m, setup.bodies.rotations
    rows = setup.pushed_rows
    loads = setup.explosion().loads(0.0, _ALWAYS_S, positions_m[rows], rotations[rows])
    return {"blast_impulses_ns": replace(loads, bodies=rows[loads.bodies]).vectors(len(setup.bodies))}


def _unlike(bodies: BodySettings, name: str) -> list[Any]:
    """Return a property of every shard where they differ: a scenario has one value for all."""
    values = [bodies.rigid[name][row] for row in bodies.of_kind(Kind.SHARD)]
    return values if len(set(values)) > 1 else []


def _shape_parts(setup: RunSetup) -> Parts:
    bodies = setup.bodies
    positions = bodies.own_matrices[~bodies.is_animated]
    return {"places": positions if len(positions) else [], "vertices": bodies.vertex_counts, "boxes": bodies.boxes_m}


def _mass_parts(setup: RunSetup) -> Parts:
    """Return all masses but the ball's, which has a key."""
    bodies = setup.bodies
    return {"kg": [kg for kg, kind in zip(bodies.rigid["mass"], bodies.kinds, strict=True) if kind != Kind.BALL]}


def _contact_parts(setup: RunSetup) -> Parts:
    bodies = setup.bodies
    return {
        "types": bodies.rigid["type"],
        "shapes": bodies.rigid["collision_shape"],
        "enabled": bodies.rigid["enabled"],
        "layers": bodies.layers,
        **{name: _unlike(bodies, name) for name in ("friction", "restitution", "linear_damping", "angular_damping")},
    }


def _pair_parts(setup: RunSetup) -> Parts:
    connections = setup.connections
    return {
        "names": connections.names,
        "places": connections.positions_m,
        "first": [first for first, _ in connections.bodies],
        "second": [second for _, second in connections.bodies],
    }


def _joint_parts(setup: RunSetup) -> Parts:
    connections, breaking, elasticity = setup.connections, setup.breaking, setup.elasticity
    ratio = elasticity.damping_ratio if elasticity else 0.0
    return {
        "types": connections.constraint["type"],
        "enabled": connections.constraint["enabled"],
        "breaking": connections.constraint["use_breaking"],
        "breaking at": connections.breaks_at(),
        "collisions": connections.constraint["disable_collisions"],
        "iterations": connections.iterations,
        "elasticity": [str(elasticity is not None), str(ratio)],
        "strength": [] if breaking.strength is None else np.broadcast_arrays(*astuple(breaking.strength)),
        "others": repr(replace(breaking, strength=None)),
    }


def _record_parts(setup: RunSetup) -> Parts:
    if setup.ground_motion is None:
        return {}
    record = setup.ground_motion.record
    return {"record": np.column_stack((record.times_s, record.accelerations_m_s2))}


@dataclass(frozen=True, eq=False)
class RunSetup:
    """All that decides a run, as its scene has it.

    The inventory is what stays the same of bodies and connections throughout a run. The start motion (n, 6) is the
    velocity, m/s, and angular velocity, rad/s, that each body begins with.
    """

    gravity_m_s2: np.ndarray = decides(
        hashed=_NOT_IN_DIGEST,
        compared={"gravity": lambda setup: {"m_s2": setup.gravity_m_s2, "used": setup.has_gravity}},
        written=_NO_KEY,
    )
    has_gravity: bool = decides(hashed=_NOT_IN_DIGEST, compared="compared with gravity_m_s2", written=_NO_KEY)
    bodies: BodySettings = decides(
        hashed=lambda setup: {"positions_m": setup.bodies.positions_m, "rotations": setup.bodies.rotations},
        compared={
            "which bodies there are": lambda setup: {"names": setup.bodies.names},
            "positions, shapes or sizes of bodies": _shape_parts,
            "masses of bodies": _mass_parts,
            "how bodies move and touch": _contact_parts,
            "animation of bodies": lambda setup: {"keys": setup.bodies.keys},
        },
        written=(with_bodies,),
    )
    connections: ConstraintSettings = decides(
        hashed=lambda setup: {
            "thresholds_ns": setup.connections.constraint["breaking_threshold"],
            "breaks": setup.connections.constraint["use_breaking"],
        },
        compared={
            "which connections there are, and between which bodies": _pair_parts,
            "kinds and strengths of connections": _joint_parts,
        },
        written=_NO_KEY,
    )
    inventory: Inventory = decides(
        hashed=lambda setup: known_parts(setup.inventory),
        compared="compared with bodies and connections",
        written="written with bodies",
    )
    breaking: Breaking = decides(hashed=_breaking_parts, compared="compared with connections", written=_SAME_KEY)
    elasticity: ConnectionElasticity | None = decides(
        hashed=_elastic_parts, compared="compared with connections", written=_SAME_KEY
    )
    start_motion: np.ndarray = decides(
        hashed=lambda setup: {"start_motion": setup.start_motion} if setup.start_motion.any() else {},
        compared={"velocities that bodies begin with": lambda setup: {"start_motion": setup.start_motion}},
        written=_SAME_KEY,
    )
    changes: tuple[Change, ...] = decides(
        hashed=_NOT_IN_DIGEST,
        compared={"removals, saw cuts, weakenings and blast zones": lambda setup: {"planned": repr(setup.changes)}},
        written=_SAME_KEY,
    )
    loads: tuple[SizedLoad, ...] = decides(
        hashed=_load_parts, compared={"loads": lambda setup: {"planned": repr(setup.loads)}}, written=_SAME_KEY
    )
    pulls: tuple[Pull, ...] = decides(hashed=_pull_parts, compared={"pulls": _pull_parts}, written=_SAME_KEY)
    fall_beds: tuple[FallBed, ...] = decides(hashed=_bed_parts, compared={"fall beds": _bed_parts}, written=_SAME_KEY)
    ground_motion: GroundMotionOfScene | None = decides(
        hashed=_ground_motion_parts, compared={"the motion of the ground": _record_parts}, written=_SAME_KEY
    )
    soil: SoilSprings | None = decides(
        hashed=_soil_parts,
        compared={"soil under footings": lambda setup: known_parts(setup.soil) if setup.soil else {}},
        written=_SAME_KEY,
    )
    bearings: BearingsOfScene | None = decides(
        hashed=_bearing_parts,
        compared={"bearings": lambda setup: known_parts(setup.bearings.springs) if setup.bearings else {}},
        written=_SAME_KEY,
    )
    tendons: ModelTendons | None = decides(hashed=_tendon_parts, compared={"tendons": _tendon_parts}, written=_SAME_KEY)
    blast: BlastSettings = decides(hashed="hashed with charges", compared=_BY_KEY, written="written as panels show it")
    charges: tuple[Charge, ...] = decides(hashed=_blast_parts, compared=_BY_KEY, written="written as panels show them")
    time: TimeOfScene = decides(
        hashed=_time_parts,
        compared=_BY_KEY,
        written=(with_time_step, with_duration, with_speed, with_first_frame),
    )

    @property
    def digest(self) -> str:
        """Digest of everything that decides what will happen."""
        parts: dict[str, Any] = {}
        for hashed in self._metadata("hashed"):
            parts |= hashed(self)
        return digest(parts)

    def compared(self) -> dict[str, str]:
        """Return the digests of the parts that are compared with the scene as it was built, by their texts."""
        return {
            text: digest(parts(self)) for compared in self._metadata("compared") for text, parts in compared.items()
        }

    def effective_scenario(self, built: Scenario) -> tuple[Scenario, list[str]]:
        """Return what a scene that was built from a scenario runs, and sentences on what no scenario can say."""
        scenario, left_out = built, []
        for item in fields(self):
            writers = item.metadata["written"]
            for write in () if isinstance(writers, str) else writers:
                try:
                    scenario = write(getattr(self, item.name), scenario)
                except ScenarioError as error:
                    left_out.append(str(error))
        return scenario, left_out

    @classmethod
    def _metadata(cls, name: str) -> list[Any]:
        return [item.metadata[name] for item in fields(cls) if not isinstance(item.metadata[name], str)]

    @property
    def goes_off(self) -> bool:
        """Whether anything explodes: the explosion is asked for, and some charge has a mass."""
        return self.blast.explosion and any(charge.mass_kg > 0.0 for charge in self.charges)

    @cached_property
    def pushed_rows(self) -> np.ndarray:
        """Rows of the bodies that a blast can push."""
        return np.flatnonzero(self.inventory.masses_kg > 0.0)

    def explosion(self) -> Explosion:
        """Return the explosion of the charges on the bodies that it can push, before anything goes off."""
        return Explosion(self.charges, self._hulls, self.blast)

    @cached_property
    def _hulls(self) -> ConvexHulls:
        inventory = self.inventory
        vertices_m = np.split(inventory.vertices_m, np.cumsum(inventory.vertex_counts)[:-1])
        rows = self.pushed_rows.tolist()
        return convex_hulls([vertices_m[row] for row in rows], [self.bodies.names[row] for row in rows])

    @cached_property
    def events(self) -> tuple[Event, ...]:
        """Changes as events on bodies and connections, in order of time."""
        return schedule(self.changes, self._structure) if self.changes else ()

    @cached_property
    def placed_loads(self) -> tuple[PlacedLoad[SizedLoad], ...]:
        """Loads on the bodies that carry them."""
        return placed_loads(self.loads, self._structure) if self.loads else ()

    @cached_property
    def placed_pulls(self) -> tuple[PlacedLoad[Pull], ...]:
        """Cables on the bodies that they pull."""
        return placed_loads(self.pulls, self._structure) if self.pulls else ()

    @cached_property
    def _structure(self) -> Structure:
        bodies = self.bodies
        corners = transformed(bodies.rotations[:, None], bodies.boxes_m) + bodies.positions_m[:, None]
        boxes_m = np.stack((corners.min(axis=1), corners.max(axis=1)), axis=1)
        named = named_bearings_of(self.connections.objects) if len(self.inventory.pairs) else None
        of_bearings = named.rows if named else np.zeros(0, int)
        return recorded_structure(self.inventory, of_bearings, bodies.positions_m, boxes_m, self.tendons)


def run_setup_of(scene: bpy.types.Scene, *, with_connections: bool = True) -> RunSetup:
    """Read all that decides a run from a scene with a rigid-body world.

    The inventory has no connections where the run can only read motion.
    """
    bodies, connections = body_settings_of(scene), constraint_settings_of(scene)
    return RunSetup(
        gravity_m_s2=np.array(scene.gravity, float),
        has_gravity=scene.use_gravity,
        bodies=bodies,
        connections=connections,
        inventory=take_inventory(bodies.objects, connections.objects if with_connections else ()),
        breaking=breaking_of(scene, connections.objects),
        elasticity=elasticity_of(scene, connections.objects),
        start_motion=start_motion_of(bodies.objects),
        changes=run_tables_of(scene, Change.kept_in),
        loads=run_tables_of(scene, SizedLoad.kept_in),
        pulls=run_tables_of(scene, Pull.kept_in),
        fall_beds=run_tables_of(scene, FallBed.kept_in),
        ground_motion=ground_motion_of(scene),
        soil=soil_of(connections.objects),
        bearings=bearings_of(connections.objects),
        tendons=tendons_of(scene, bodies.objects, connections.objects if with_connections else ()),
        blast=blast_of(scene),
        charges=charges_of(scene),
        time=time_of(scene),
    )
