"""Summary of a run for its `summary.json`, from its recording and its scenario."""

from __future__ import annotations

import math
import platform
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import bpy
import numpy as np

from ..model.blast.vibration_laws import OF_FALL
from ..model.debris.throws import bodies_under_ground, debris_of, debris_on_surfaces
from ..model.debris.touchdown import landings, shaking_at
from ..model.reinforcement.concrete_members import plain_concrete
from ..model.results.arrays import Results, motion_digest, result_digest
from ..model.results.motion import without_removed
from ..model.results.summary import settling, summarise
from ..model.run_folder.own_code import own_code
from ..model.scenario import Scenario
from ..model.schema import given
from ..model.sequence.ending import Rest, fell_by_itself, last_event_s, undone_at_end
from ..model.structure.settlement import settlements
from ..scene.as_built import kept_stability
from ..scene.bodies import terrain_facts
from ..scene.tools.ground_motion import GroundMotionOfScene, ground_motion_of
from ..scene.world import scene_time_step
from ..system.processor import processor_name
from .recording.recorder import Recording


@dataclass(frozen=True, slots=True, eq=False)
class RunContext:
    """Values of a scene that its summary needs, read before the recording: undo or another file may remove the scene.

    Attributes
    ----------
    gravity : (3,) float
        Gravity of the scene, m/s².
    substep_s : float
        Length of a sub-step where time is not animated.
    scenario : Scenario or None
        None where the scene was not built from a scenario.
    made_by_hand : sequence of str
        Parts of the scene that no scenario can describe, as text.
    terrain : dict or None
        Facts on the file of the ground and its mesh; None where the ground is flat.
    stability : dict or None
        Whether the bridge stands under its own weight, as stored; None where this was not worked out.
    """

    title: str
    gravity: np.ndarray
    substep_s: float
    scenario: Scenario | None
    made_by_hand: Sequence[str] = ()
    ground_motion: GroundMotionOfScene | None = None
    terrain: Mapping[str, Any] | None = None
    stability: Mapping[str, Any] | None = None

    @classmethod
    def of(
        cls, scene: bpy.types.Scene, title: str, scenario: Scenario | None, made_by_hand: Sequence[str] = ()
    ) -> RunContext:
        """Return the context of a scene as it is now."""
        gravity, substep_s = np.array(scene.gravity, float), scene_time_step(scene).substep_s
        return cls(
            title,
            gravity,
            substep_s,
            scenario,
            made_by_hand,
            ground_motion_of(scene),
            terrain_facts(scene),
            kept_stability(scene),
        )


def run_summary(recording: Recording, results: Results, context: RunContext, *, completed: bool) -> dict[str, Any]:
    """Return the totals of a recording that has ended; completed or before its time."""
    scenario = context.scenario
    contact_time_s = scenario.ball.contact_time_s if scenario and scenario.ball else None
    summary = {
        "title": context.title,
        "completed": completed,
        "only_motion_because": recording.only_motion_because,
        "blender": bpy.app.version_string,
        "fingerprint": _fingerprint(recording, results),
        "substep_s": context.substep_s,
        "shortest_substep_s": _shortest_substep_s(results),
        "elasticity": None if recording.resting_state is None else recording.resting_state.to_json(),
        **summarise(results, context.gravity, contact_time_s),
        "bearings": [bearing.to_json() for bearing in recording.bearings],
        "reinforcement": recording.reinforcement and recording.reinforcement.to_json(),
        "events": recording.applied_events,
        "ground_motion": _ground_motion(context.ground_motion),
        "terrain": context.terrain,
        **_on_ground(results),
        "stability": context.stability,
        "made_by_hand": list(context.made_by_hand),
        "changed_bodies": recording.changed_bodies,
    }
    if recording.tendons:
        summary["tendons"] = recording.tendons.summary()
    if recording.loads:
        summary["loads"] = recording.loads.summary()
    if recording.pulls:
        summary["pulls"] = recording.pulls.summary()
        if lifts := recording.pulls.hooks.summary():
            summary["lifts"] = lifts
    return (
        summary
        if scenario is None
        else summary
        | _of_scenario(scenario, recording, results, context.ground_motion, has_hit=summary["impact"] is not None)
    )


def _shortest_substep_s(results: Results) -> float | None:
    """Length of the shortest sub-step; None where no time passed."""
    lengths_s = results.frames.substep_s
    return float(lengths_s[lengths_s > 0.0].min()) if (lengths_s > 0.0).any() else None


def _fingerprint(recording: Recording, results: Results) -> dict[str, str]:
    """Digests of model, motion and result, with the processor and the programs that calculated them."""
    whole = {"result": result_digest(results)} if recording.has_loads else {}
    return {
        "built": given(recording.setup).digest,
        "motion": motion_digest(results),
        **whole,
        "program": own_code(),
        "processor": processor_name(),
        "system": f"{platform.system()} {platform.machine()}",
        "blender": f"{bpy.app.version_string} {bpy.app.build_hash.decode()}",
        "python": platform.python_version(),
        "numpy": np.__version__,
    }


def _on_ground(results: Results) -> dict[str, Any]:
    """Debris on each surface of the ground by its name, and bodies that went through the ground or off its edge."""
    left, _ = without_removed(results)
    surfaces = debris_on_surfaces(left, debris_of(left)) if left.ground().surfaces else ()
    on_surfaces = {
        surface.name: {
            "kind": surface.kind,
            "bodies": len(surface.bodies),
            "mass_kg": surface.mass_kg,
            "covered_m2": surface.covered_m2,
        }
        for surface in surfaces
    }
    under = left.inventory.body_names[bodies_under_ground(left)]
    return {"debris_on_surfaces": on_surfaces, "under_ground": [str(name) for name in under]}


def rest_watch(scenario: Scenario, motion: GroundMotionOfScene | None) -> Rest:
    """Return the rest that a scenario waits for, on moving ground too."""
    time, motion_end_s = scenario.time, motion.end_s if motion else 0.0
    return Rest(
        time.rest_speed_m_s, time.rest_angular_velocity_rad_s, time.rest_hold_s, last_event_s(scenario, motion_end_s)
    )


def _ground_motion(motion: GroundMotionOfScene | None) -> dict[str, Any] | None:
    """Largest acceleration, velocity and displacement of the ground along x, y and z, and when it moves."""
    return {"start_s": motion.start_s, "end_s": motion.end_s, **motion.record.peaks()} if motion else None


def _of_scenario(
    scenario: Scenario, recording: Recording, results: Results, motion: GroundMotionOfScene | None, *, has_hit: bool
) -> dict[str, Any]:
    rest = rest_watch(scenario, motion)
    for state in zip(
        results.frames.time_s, results.frames.positions_m, results.frames.rotations, results.frames.asleep, strict=True
    ):
        rest.observe(*state, results.inventory.masses_kg)
    return {
        "seed": scenario.seed,
        "ended_before": undone_at_end(results, scenario, has_hit=has_hit),
        "charges": _charges(scenario, recording),
        "settled": settling(results, scenario.connections.warm_up_s),
        "came_to_rest_s": rest.came_to_rest_s,
        "fell_by_itself": (fall := fell_by_itself(results, scenario)) and asdict(fall),
        "plain_concrete": plain_concrete(scenario),
        "touchdown": _touchdown(scenario, results),
        "foundations": settlements(results, scenario.foundations),
    }


def _touchdown(scenario: Scenario, results: Results) -> dict[str, Any]:
    """Touchdown vibration at each neighbour, by its name; None where nothing fell."""
    landed, law = landings(results, scenario.fall_beds), scenario.site_law(OF_FALL)
    shaken = ((neighbour.name, shaking_at(neighbour.position_m, landed, law)) for neighbour in scenario.neighbours)
    return {name: shaking and asdict(shaking) for name, shaking in shaken}


def _charges(scenario: Scenario, recording: Recording) -> dict[str, Any] | None:
    """Charges with their detonations, and blast loads that were lost; None without an explosion."""
    charges = [charge for charge in scenario.charges if charge.mass_kg > 0.0]
    if not scenario.blast.explosion or not charges:
        return None
    times = [scenario.blast.start_s + charge.delay_s for charge in charges]
    timed = list(zip(charges, times, strict=True))
    at_once = [math.fsum(charge.mass_kg for charge, time in timed if time == together) for together in times]
    return {
        "charges": [
            {
                "name": charge.name,
                "place_m": charge.position_m,
                "mass_kg": charge.mass_kg,
                "explosive": charge.explosive,
                "tnt_kg": charge.tnt_kg,
                "detonation_s": time,
            }
            for charge, time in timed
        ],
        "mass_kg": math.fsum(charge.mass_kg for charge in charges),
        "largest_mass_at_once_kg": max(at_once),
        "applied_by": scenario.blast.apply,
        "loads_cut_short": recording.lost_blast_loads,
    }
