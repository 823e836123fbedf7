"""Evaluation of one run: its outputs, and where its debris was on plan."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any, Self

import numpy as np
from manifold3d import CrossSection

from ...engineering.blast.pulses import BlastModel
from ...engineering.geometry.plan_areas import outlines
from ...errors import OutputError
from ..blast.receptors import loads_at
from ..blast.vibration_laws import OF_FALL
from ..bridge.preparation import prepared_members
from ..debris.footprint import bodies_that_moved, footprint, plan_hulls, reaches_on_the_way, swept_footprint
from ..debris.throws import debris_of
from ..debris.touchdown import landings, shaking_at
from ..debris.zones import watch_zone
from ..results.arrays import Results
from ..results.collapse import Span, collapse_progress, piers_of, spans_of
from ..results.energy import is_known, throws_of
from ..results.motion import relative_to_ground, without_removed
from ..run_folder.summary import RunSummary
from ..scenario import Scenario
from ..structure.charge_plan import AtNeighbour, neighbours_of_zones
from .conclusions import fragment_outputs
from .criteria import COLLAPSED, Criterion, neighbour_output, pier_output, span_output, zone_output
from .runs_table import MOVING, RESTED, TRUSTED_REACH

SUCCESS = "success"
"""Output that says whether all criteria are met; only where there are some."""

_STRAIGHT_M = 1e-3
"""Tolerance of kept outlines."""

_NO_OUTLINES = np.zeros((0, 2), np.float32)


@dataclass(frozen=True, slots=True, eq=False)
class Outlines:
    """What is kept of a run on plan: closed outlines (k, 2), m; holes run clockwise."""

    bridge: tuple[np.ndarray, ...]  # of the shards at first
    resting: tuple[np.ndarray, ...]  # of the hazardous bodies that moved, at the end; those that overlap are not united
    swept: tuple[np.ndarray, ...]  # of these bodies at any time, united

    def arrays(self) -> dict[str, np.ndarray]:
        """All outlines as arrays by name, in single precision: ``bridge_m`` (c, 2), ``bridge_counts`` (o,), …"""
        arrays = {}
        for field in fields(self):
            rings = getattr(self, field.name)
            arrays[f"{field.name}_m"] = np.concatenate([_NO_OUTLINES, *rings]).astype(np.float32)
            arrays[f"{field.name}_counts"] = np.array([len(ring) for ring in rings], np.int32)
        return arrays

    @classmethod
    def of_arrays(cls, arrays: Mapping[str, np.ndarray]) -> Self:
        """Outlines from what `arrays` gives."""
        return cls(*(_rings(arrays[f"{field.name}_m"], arrays[f"{field.name}_counts"]) for field in fields(cls)))


@dataclass(frozen=True, slots=True, eq=False)
class RunEvaluation:
    """Result of a run that finished."""

    outputs: dict[str, float | int | bool | None]  # by name with unit; None for unknown values
    outlines: Outlines


def evaluate(
    results: Results,
    summary: RunSummary,
    scenario: Scenario,
    criteria: Sequence[Criterion] = (),
    least_mass_kg: float = 0.0,
) -> RunEvaluation:
    """Evaluate a run, by what was recorded and its summary, as in ``summary.json``.

    Shards of `least_mass_kg` or more, and balls, are hazards if they moved; removed shards are not.
    """
    left = relative_to_ground(without_removed(results)[0])
    shards, balls = left.inventory.of_kind("shard"), left.inventory.of_kind("ball")
    plan = footprint(left, shards, 0)
    _check(left, plan)
    heavy = shards[left.inventory.masses_kg[shards] >= least_mass_kg]
    hazards = bodies_that_moved(left, np.concatenate([heavy, balls]))
    outputs = {
        **_throws(left, hazards, plan),
        **_course(left, summary, scenario),
        **_surroundings(left, scenario, np.concatenate([shards, balls])),
        **fragment_outputs(scenario),
    }
    met = {criterion.output: criterion.is_met(outputs) for criterion in criteria}
    outputs |= met | ({SUCCESS: all(met.values())} if met else {})
    return RunEvaluation(outputs, _outlines(left, hazards, plan))


def _check(results: Results, plan: CrossSection) -> None:
    if not plan.area() > 0.0:
        raise OutputError("the bridge covers no area in plan: distances from it are not known")
    if not (np.isfinite(results.frames.positions_m).all() and np.isfinite(results.frames.rotations).all()):
        raise OutputError("a body was lost: Blender has no finite position for it")


def _throws(results: Results, hazards: np.ndarray, plan: CrossSection) -> dict[str, Any]:
    on_the_way = reaches_on_the_way(results, hazards, plan)
    debris = debris_of(results)
    return {
        "reach_m": float(on_the_way.max(initial=0.0)),
        "largest_throw_m": float(debris.throws_m.max(initial=0.0)),
        "resting_reach_m": float(debris.reaches_m.max(initial=0.0)),
        "debris_kg": float(debris.masses_kg.sum()),
        "debris_area_m2": float(debris.area.area()),
        **_without_doubtful(results, hazards, on_the_way),
    }


def _without_doubtful(results: Results, hazards: np.ndarray, on_the_way_m: np.ndarray) -> dict[str, Any]:
    """Return how many throws nothing explains, and the debris distance without them; None where that cannot be known.

    Hazards (h,) get so far on the way (h,).

    Without recorded work a throw is doubtful by the height of fall alone, which says nothing where charges went off.
    """
    has_energy = is_known(results)
    if not has_energy and results.frames.blast_impulses_ns.any():
        return {"doubtful_throws": None, TRUSTED_REACH: None}
    throws = throws_of(results)
    doubtful = throws.doubtful if has_energy else throws.beyond_fall
    trusted = ~np.isin(hazards, throws.bodies[doubtful])
    return {
        "doubtful_throws": int(doubtful.sum()),
        TRUSTED_REACH: float(on_the_way_m[trusted].max(initial=0.0)),
    }


def _course(results: Results, summary: RunSummary, scenario: Scenario) -> dict[str, Any]:
    force, energy, counts = summary.largest_resultant, summary.energy, summary.counts
    outputs = {
        COLLAPSED: float(collapse_progress(results)[-1]),
        "broken": counts.broken,
        "torn": counts.torn,
        RESTED: summary.came_to_rest_s,
        MOVING: summary.moving_at_end.shards if summary.moving_at_end else 0,
        "largest_force_N": force and force.force_n,
        "made_by_solver_share": energy and energy.made_by_solver.counted_share,
    }
    lengths = scenario.bridge.span_lengths_m if scenario.bridge else ()
    for span in spans_of(results, lengths):
        number = int(span.name.removeprefix("span ")) if span.name.startswith("span ") else 1
        outputs |= _span(number, span)
    for number, pier in piers_of(results).items():
        outputs[pier_output(number, "lost_share")] = _lost_share(pier, pier.heights_m[-1])
    return outputs


def _span(number: int, span: Span) -> dict[str, Any]:
    return {
        span_output(number, "drop_m"): span.drop_m,
        span_output(number, "lost_share"): _lost_share(span, span.heights_m[-1]),
        span_output(number, "most_lost_share"): _lost_share(span, span.heights_m.min()),
    }


def _lost_share(span: Span, height_m: float) -> float | None:
    """Return the part of its first height that a span or a pier has lost at a height; None where it had none."""
    first_m = float(span.heights_m[0])
    return (first_m - float(height_m)) / first_m if first_m > 0.0 else None


def _surroundings(results: Results, scenario: Scenario, bodies: np.ndarray) -> dict[str, Any]:
    outputs: dict[str, Any] = {}
    for zone in scenario.zones:
        watched = watch_zone(results, zone, bodies)
        outputs[zone_output(zone.name, "entered")] = bool(watched.entries)
        outputs[zone_output(zone.name, "bodies_entered")] = len(watched.entries)
    charges = [charge for charge in scenario.charges if charge.mass_kg > 0.0] if scenario.blast.explosion else []
    model, landed = BlastModel(scenario.blast.model), landings(results, scenario.fall_beds)
    of_holes = _of_drilled_charges(scenario)
    for neighbour in scenario.neighbours:
        loads = loads_at(neighbour.position_m, charges, model, scenario.blast.pressure_factor) if charges else None
        peak_pa, velocity_m_s = (loads.peak_pa, loads.peak_velocity_m_s) if loads else (0.0, 0.0)
        if drilled := of_holes.get(neighbour.name):
            peak_pa, velocity_m_s = max(peak_pa, drilled.pressure_pa), max(velocity_m_s, drilled.at_most_m_s)
        outputs[neighbour_output(neighbour.name, "pressure_kPa")] = peak_pa / 1e3
        outputs[neighbour_output(neighbour.name, "vibration_mm_s")] = velocity_m_s * 1e3
        shaking = shaking_at(neighbour.position_m, landed, scenario.site_law(OF_FALL))
        at_most_m_s = shaking.at_most_m_s if shaking else 0.0
        name = neighbour_output(neighbour.name, "touchdown_mm_s")
        outputs[name] = None if at_most_m_s is None else at_most_m_s * 1e3
    return outputs


def _of_drilled_charges(scenario: Scenario) -> dict[str, AtNeighbour]:
    """Return what blast zones do at each neighbour, by its name; nothing where none can fire."""
    if not ((scenario.blast_zones or scenario.cuts) and scenario.neighbours and scenario.blast.explosion):
        return {}
    found = neighbours_of_zones(scenario, prepared_members(scenario).members)
    return {at.neighbour.name: at for at in found}


def _outlines(results: Results, hazards: np.ndarray, plan: CrossSection) -> Outlines:
    resting = plan_hulls(results, hazards, -1)
    swept = swept_footprint(results, hazards).simplify(_STRAIGHT_M)
    return Outlines(
        tuple(outlines(plan.simplify(_STRAIGHT_M))),
        tuple(ring for hull in resting for ring in outlines(hull)),
        tuple(outlines(swept)),
    )


def _rings(corners: np.ndarray, counts: np.ndarray) -> tuple[np.ndarray, ...]:
    if int(counts.sum()) != len(corners):
        raise ValueError(f"{len(corners)} corners: expected {int(counts.sum())}")
    return tuple(np.split(np.asarray(corners, float), np.cumsum(counts)[:-1])) if len(counts) else ()
