"""``bda check``: print what follows from a scenario, without running it."""

import argparse
from collections.abc import Iterator, Sequence

import numpy as np

from ..engineering.geometry.overlap import SHARD_OVERLAP_TOLERANCE, Overlaps, hulls, overlaps
from ..engineering.mechanics.joint import Joint
from ..engineering.mechanics.strength import MATERIALS, NEWTON_PER_SQUARE_MILLIMETRE, Strength
from ..engineering.units import STANDARD_GRAVITY_M_S2
from ..model.bridge import deck_top
from ..model.bridge.member import Member, mean_density
from ..model.bridge.preparation import prepared_members
from ..model.ground_motion.settings import DIRECTIONS
from ..model.materials.bar_layers import AXES, SIDES
from ..model.scenario import Ball, BallCable, Bridge, ConnectionBetween, ConnectionSettings, Scenario, TimeSettings
from ..model.scenario.connections import LARGE_MODEL, MATERIAL_OF_LARGE_MODELS
from ..model.scenario.file import read_scenario
from ..model.sequence.checked_model import checked_model
from ..model.sequence.loads import placed_on_model
from ..model.stages.made_elastic import made_elastic
from ..model.structure.equilibrium import model_at_rest, overloaded, sag_m, used_of_forces
from ..model.structure.face_bars import layers_of_members
from ..model.structure.model import Model
from ..model.terrain.built import BuiltGround, terrain_summary
from .arguments import naming

MOST_FIELDS = 300
"""Force fields up to which they cost less than the rest of a frame: Blender tests every one against every body."""

MOST_SHARDS_COMPARED = 2000
"""Comparing so many shards with their neighbours takes as long as cutting them."""

MOST_PAIRS_NAMED = 5


def add_to(commands: argparse._SubParsersAction) -> None:
    """Add the command to the command line."""
    parser = commands.add_parser("check", help="read a scenario and say what follows from it", allow_abbrev=False)
    parser.add_argument("scenario", metavar="SCENARIO.toml", help="scenario file, see docs/scenario.md")
    parser.add_argument(
        "--stand",
        action="store_true",
        help="say how the bridge stands under its own weight, as with elastic connections, also where they are rigid",
    )
    parser.set_defaults(execute=check)


def check(arguments: argparse.Namespace) -> None:
    """Print what a planner wants to know before a run."""
    scenario = read_scenario(arguments.scenario)
    with naming(arguments.scenario):
        for line in scenario_facts(scenario, stand=arguments.stand):
            print(line)


def scenario_facts(scenario: Scenario, *, stand: bool = False) -> Iterator[str]:
    """Yield lines on a scenario's bridge, time steps, connections, ball, sequence and charges.

    With `stand` they say how a bridge with rigid connections would stand if these were elastic.
    """
    as_elastic = made_elastic(scenario) if stand else scenario  # refused before anything is said
    yield scenario.title
    prepared = prepared_members(scenario)
    if scenario.bridge:
        yield from _section("Bridge", _bridge_facts(scenario.bridge, is_flat=scenario.ground.file is None))
    yield from _section("Members", _member_facts(prepared.members))
    if prepared.notes:
        yield from _section("Repaired", (note.split(": ", 1) for note in prepared.notes))
    yield from _section("Time", _time_facts(scenario))
    model = checked_model(scenario, prepared.members)
    if not model.ground.is_plain:
        yield from _section("Ground", _terrain_facts(model.ground))
    yield from _section("Shards and connections", _connection_facts(scenario, model))
    if stand and model.stiffness is None:
        elastic = checked_model(as_elastic, prepared.members)
        yield from _section("At rest", _rest_facts(scenario, elastic))
    elif model.stiffness is not None:
        yield from _section("At rest", _rest_facts(scenario, model))
    yield from _section("Overlap at the start", _overlap_facts(model))
    if scenario.ground_motion:
        yield from _section("Ground motion", _shaking_facts(scenario))
    if model.soil:
        yield from _section("Foundations", _foundation_facts(scenario, model))
    if scenario.ball:
        yield from _section("Ball", _ball_facts(scenario.ball, scenario.time))
    if scenario.changes or scenario.jackhammers:
        yield from _section("Sequence", _sequence_facts(scenario))
    if scenario.loads:
        yield from _section("Loads", _load_facts(scenario, model))
    if scenario.charges:
        yield from _section("Charges", _charge_facts(scenario))
    if reason := scenario.pictures.why_not_without_window:
        yield from _section("Pictures", iter([("none can be taken", reason)]))


def _section(heading: str, facts: Iterator[tuple[str, str]]) -> Iterator[str]:
    yield ""
    yield heading
    for name, value in facts:
        yield f"  {name:<24}{value}"


def _bridge_facts(bridge: Bridge, *, is_flat: bool) -> Iterator[tuple[str, str]]:
    yield "length", f"{bridge.length_m:.2f} m"
    yield "spans", " + ".join(f"{span:.2f}" for span in bridge.span_lengths_m) + " m"
    yield "deck top above ground" if is_flat else "height of deck top", f"{deck_top(bridge):.2f} m"


def _terrain_facts(ground: BuiltGround) -> Iterator[tuple[str, str]]:
    """Yield how the terrain was made, and what lies on it."""
    if ground.facts:
        yield from terrain_summary(ground.facts)
    recorded = ground.recorded()
    for surface in recorded.surfaces:
        yield surface.name, f"{surface.kind}, {recorded.shown(surface).area():.1f} m² in plan"


def _member_facts(members: Sequence[Member]) -> Iterator[tuple[str, str]]:
    alike = len({member.density_kg_m3 for member in members}) == 1
    for member in members:
        own = "" if alike else f", {member.density_kg_m3:.0f} kg/m³"
        yield member.name, _volume_and_mass(member.volume_m3, member.mass_kg) + own
    volume, mass = (sum(getattr(member, what) for member in members) for what in ("volume_m3", "mass_kg"))
    yield "all", _volume_and_mass(volume, mass)
    yield "density" if alike else "mean density", f"{mean_density(members):.0f} kg/m³"


def _volume_and_mass(volume_m3: float, mass_kg: float) -> str:
    return f"{volume_m3:9.3f} m³ {mass_kg / 1000.0:10.3f} t"


def _overlap_facts(model: Model) -> Iterator[tuple[str, str]]:
    """Yield whether shards lie in each other, which would throw them apart when the simulation begins."""
    if len(model.shards) > MOST_SHARDS_COMPARED:
        yield "overlapping shards", f"not compared with each other, as they are more than {MOST_SHARDS_COMPARED}"
        return
    yield from _pairs_found("overlapping shards", overlaps(model.shards), model)
    # What Blender lets collide. Hulls of connected shards overlap unharmed until their connection breaks.
    yield from _pairs_found("overlapping hulls", overlaps(hulls(model.shards)), model)


def _pairs_found(name: str, found: Overlaps, model: Model) -> Iterator[tuple[str, str]]:
    yield name, f"{len(found) or 'no'} pairs, by more than {SHARD_OVERLAP_TOLERANCE:g} of the smaller one"
    for (first, second), volume in list(zip(found.pairs, found.volumes, strict=True))[:MOST_PAIRS_NAMED]:
        named = (f"{model.members[model.member_of_shard[shard]].name}, shard {shard}" for shard in (first, second))
        yield "", f"{volume:.3g} m³ of {' and '.join(named)}"


def _time_facts(scenario: Scenario) -> Iterator[tuple[str, str]]:
    time, timeline = scenario.time, scenario.timeline
    yield "duration", f"{time.duration_s:g} s"
    shortest = timeline.frame_lengths_s.min()
    slowed = "" if shortest > 0.999 * time.step.frame_s else f", down to {shortest:.3g} s around detonations"
    yield "frames", f"{len(timeline)} of {time.step.frame_s:.6g} s{slowed}"
    farthest_m = time.farthest_per_substep_m
    shortened = "" if farthest_m is None else f", more where a body would go farther than {farthest_m:g} m in one"
    yield "sub-step", f"{time.step.substep_s:.6g} s, {time.substeps_per_frame} in a frame{shortened}"


def _connection_facts(scenario: Scenario, model: Model) -> Iterator[tuple[str, str]]:
    connections = scenario.connections
    yield "shards", f"{len(model.shards)}"
    kind = f"{connections.type}, {_method(connections)}, at most {connections.limit_per_shard} per shard"
    yield "connections", f"{len(model.connections.pairs)}, {kind}"
    is_large = scenario.fracture.shards >= LARGE_MODEL
    if connections.material is not None:
        is_usual = is_large and connections.material == MATERIAL_OF_LARGE_MODELS
        usual = f", as in all models of {LARGE_MODEL} shards or more that give no strength" if is_usual else ""
        yield "strength of", f"{connections.material}{usual}"
        yield from _strength_facts(scenario.joints[0].strength)
    else:
        force = scenario.joints[0].breaking_force_n
        yield "breaking force", f"{force:.1f} N = {force / 1000.0:.2f} kN"
        yield "breaking impulse", f"{scenario.time.step.impulse(force):.4g} N·s in a sub-step"
        if is_large:
            yield from _stress_facts(force, scenario, model)
            yield "", "one force for all: the finer the bridge is cut, the stronger it is. To break by the"
            yield "", f'strength of {MATERIAL_OF_LARGE_MODELS} give none, and method "face"'
    yield from _bar_facts(scenario, model)
    yield from _rule_facts(scenario)


def _bar_facts(scenario: Scenario, model: Model) -> Iterator[tuple[str, str]]:
    """Yield what sections with layers of bars bear at yield."""
    strength = scenario.joints[0].strength
    for group in layers_of_members(scenario.reinforcement, model.members):
        section = group.section(strength.compression_pa, scenario.connections.strength_factor)
        along, across, _ = group.axes
        sides = sorted((highest, side) for side, (axis, highest) in SIDES.items() if axis == across)
        moments = zip([side for _, side in reversed(sides)], section.moments_nm(), strict=True)
        borne = ", ".join(f"{moment / 1000.0:.4g} kN·m with its {side} pressed" for side, moment in moments)
        yield "reinforcement", f"{model.members[group.member].name}, along {AXES[along]}: {borne}"


def _rest_facts(scenario: Scenario, model: Model) -> Iterator[tuple[str, str]]:
    """Yield how an elastic bridge stands under its own weight."""
    rest = model_at_rest(model, scenario.joints)
    held = int(rest.held[: len(model.shards)].sum())
    loose = len(model.shards) - held - int(model.fixed.sum())
    broken = int(overloaded(model, rest, scenario.joints).sum())
    yield "overloaded", f"{broken} of {len(model.connections)} connections, by the bridge's own weight alone"
    if not scenario.connections.is_elastic:
        yield "", "if they were elastic. Rigid ones share loads otherwise: a run says whether it stands"
    elif broken:
        yield "", "they break before anything is done to it, and the bridge may fall by itself"
    used = used_of_forces(model, rest, scenario.joints)
    if by_force := np.count_nonzero(~np.isnan(used)):
        yield (
            "of breaking forces",
            f"{np.nanmax(used):.1%} used at most, {np.nanmean(used):.1%} in the mean of {by_force}",
        )
        yield "", "by the force or moment of each that is largest, in N or N·m, as Bullet breaks it"
    if loose:
        yield "not held", f"{loose} shards, by no connection to a support: they fall, or tremble on others. Bearings"
        yield "", "would hold them: [[connections.between]] with type GENERIC"
    if held:
        yield "sag", f"{1000.0 * sag_m(model, rest):.2f} mm"
        yield "first frequency", f"{rest.frequency_hz:.3f} Hz"


def _shaking_facts(scenario: Scenario) -> Iterator[tuple[str, str]]:
    """Yield how the ground shakes."""
    record, start_s = scenario.ground_record, scenario.ground_motion.start_s
    yield "from, to", f"{start_s:g} s, {start_s + record.duration_s:g} s, of {scenario.time.duration_s:g} s"
    peaks = record.peaks()
    for axis, direction in enumerate(DIRECTIONS):
        if direction not in scenario.ground_motion.directions:
            continue
        acceleration = peaks["accelerations_m_s2"][axis]
        yield (
            direction,
            f"up to {acceleration:.3g} m/s² = {acceleration / STANDARD_GRAVITY_M_S2:.3f} g, "
            f"{peaks['velocities_m_s'][axis]:.3g} m/s, {peaks['displacements_m'][axis]:.3g} m",
        )


def _foundation_facts(scenario: Scenario, model: Model) -> Iterator[tuple[str, str]]:
    """Yield how footings press on their soil by the bridge's own weight."""
    rest, soil = model_at_rest(model, scenario.joints), model.soil
    forces_n = np.abs(rest.loads[2, soil.rows])
    areas = model.connections.areas[soil.rows]
    members = model.member_of_shard[model.connections.pairs[soil.rows, 0]]
    for member in dict.fromkeys(members.tolist()):
        mine = members == member
        force, area = float(forces_n[mine].sum()), float(areas[mine].sum())
        pressure = force / area
        settled = pressure / float(soil.stiffness_n_m3[mine][0])
        yield (
            model.members[member].name,
            f"{force / 1e3:.0f} kN on {area:.2f} m², {pressure / 1e3:.0f} kPa, "
            f"{pressure / float(soil.capacity_pa[mine][0]):.1%} of what it bears, {1e3 * settled:.2f} mm",
        )


def _stress_facts(force_n: float, scenario: Scenario, model: Model) -> Iterator[tuple[str, str]]:
    """Yield the stress that one breaking force for all comes to, which grows with the number of shards."""
    alike = np.array([joint.breaking_force_n == force_n for joint in scenario.joints])
    holds = alike[model.joint_of_connection]
    if area_m2 := float(model.connections.areas[holds].sum()):
        stress = force_n * int(holds.sum()) / area_m2 / NEWTON_PER_SQUARE_MILLIMETRE
        torn = MATERIALS["concrete"].tension_pa / NEWTON_PER_SQUARE_MILLIMETRE
        yield "of all, by their area", f"{stress:.3g} N/mm² in the mean; plain concrete is torn at {torn:g} N/mm²"


def _rule_facts(scenario: Scenario) -> Iterator[tuple[str, str]]:
    for rule, joint in zip(scenario.connections.between, scenario.joints[1:], strict=True):
        yield "between", f"{' and '.join(rule.members)}: {'none' if rule.none else _joint_text(rule, joint)}"


def _joint_text(rule: ConnectionBetween, joint: Joint) -> str:
    """Return what a connection of a rule holds, and what breaks it where that is not as elsewhere."""
    words = [joint.type]
    if joint.free:
        words.append(f"free: {', '.join(joint.free)}")
    if rule.material is not None:
        words.append(f"strength of {rule.material}")
    elif rule.breaking_force_newton is not None:
        words.append(f"breaking force {rule.breaking_force_newton / 1000.0:.2f} kN")
    return ", ".join(words)


def _strength_facts(strength: Strength) -> Iterator[tuple[str, str]]:
    for kind in ("compression", "tension", "shear", "torsion", "bending"):
        yield f"in {kind}", f"{getattr(strength, f'{kind}_pa') / NEWTON_PER_SQUARE_MILLIMETRE:g} N/mm²"


def _method(connections: ConnectionSettings) -> str:
    if connections.method == "face":
        return "shards that share a face"
    if connections.method == "nearest":
        return f"each with its {connections.neighbours} nearest"
    places = {"vertex": "nearest vertices", "centre": "centres of mass"}
    return f"{places[connections.method]} within {connections.search_radius_m:g} m"


def _ball_facts(ball: Ball, time: TimeSettings) -> Iterator[tuple[str, str]]:
    yield "mass", f"{ball.mass_kg / 1000.0:.3f} t"
    yield "diameter", f"{ball.diameter_m:.2f} m, so {ball.density_kg_m3:.0f} kg/m³"
    yield from _swing_facts(ball, ball.cable) if ball.cable else _drop_facts(ball, time)


def _sequence_facts(scenario: Scenario) -> Iterator[tuple[str, str]]:
    """Yield what is planned besides hits and charges, in order of time."""
    steps = [(change.time_s, f"{change.kind}, {change.where or 'everywhere'}") for change in scenario.changes]
    for hammer in scenario.jackhammers:
        work = f"jackhammer until {hammer.end_time_s:g} s, at up to {hammer.largest_speed_m_s:.1f} m/s"
        steps.append((hammer.start_time_s, work))
    for time_s, text in sorted(steps):
        yield f"{time_s:.3f} s", text


def _load_facts(scenario: Scenario, model: Model) -> Iterator[tuple[str, str]]:
    """Yield how large each load becomes, on how many shards."""
    for number, placed in enumerate(placed_on_model(scenario.loads, model), start=1):
        load = placed.load
        course = ", ".join(
            f"{force_n / 1000.0:g} kN at {time_s:g} s"
            for time_s, force_n in zip(load.times_s, load.forces_n, strict=True)
        )
        names = sorted({model.members[row].name for row in model.member_of_shard[placed.bodies]})
        yield f"load {number}", f"{course}, towards ({', '.join(f'{each:g}' for each in load.direction)})"
        point = "" if load.point_m is None else f" at ({', '.join(f'{each:g}' for each in load.point_m)}) m"
        count, mass_kg = len(placed.bodies), model.masses_kg[placed.bodies].sum()
        borne = f"{count} shards" if count > 1 else "a shard"
        yield "", f"on {borne} of {', '.join(names)}{point}, together {mass_kg / 1000.0:.3f} t"


def _swing_facts(ball: Ball, cable: BallCable) -> Iterator[tuple[str, str]]:
    yield "cable", f"{cable.length_m:.2f} m, let go {cable.angle_degrees:g}° from the vertical"
    place = ", ".join(f"{value:.2f}" for value in cable.lowest_point_m)
    period_s = cable.period_s(ball.diameter_m)
    yield (
        "swing to and fro",
        f"{period_s:.3f} s, at its lowest ({place}) m at {ball.release_time_s + period_s / 4:.3f} s",
    )
    yield "largest speed", f"{cable.largest_speed_m_s:.2f} m/s"
    yield "largest energy", f"{ball.mass_kg * cable.largest_speed_m_s**2 / 2000.0:.1f} kJ"


def _drop_facts(ball: Ball, time: TimeSettings) -> Iterator[tuple[str, str]]:
    impact_time_s = ball.release_time_s + ball.fall_time_s
    late = ", after the end of the run" if impact_time_s > time.duration_s else ""
    yield "clear drop height", f"{ball.drop_height_m:.2f} m"
    yield "fall time", f"{ball.fall_time_s:.3f} s, so it hits the deck at {impact_time_s:.3f} s{late}"
    yield "impact speed", f"{ball.impact_speed_m_s:.2f} m/s"
    for number, hit in enumerate(ball.hits, start=2):
        impact_s = hit.release_time_s + hit.fall_time_s
        yield f"hit {number}", f"at {impact_s:.3f} s, {hit.impact_speed_m_s:.2f} m/s"
    yield "impact energy", f"{ball.mass_kg * ball.impact_speed_m_s**2 / 2000.0:.1f} kJ"


def _charge_facts(scenario: Scenario) -> Iterator[tuple[str, str]]:
    blast, charges = scenario.blast, scenario.charges
    if not blast.explosion:
        yield "explosion", "not ticked: nothing goes off"
    for charge in charges:
        place = ", ".join(f"{value:g}" for value in charge.place_m)
        worth = "" if charge.explosive == "TNT" else f" = {charge.tnt_kg:.3g} kg of TNT"
        detonation_s = blast.start_s + charge.delay_s
        yield charge.name, f"{charge.mass_kg:g} kg of {charge.explosive}{worth} at ({place}) m, {detonation_s:.4g} s"
    yield "all", f"{sum(charge.mass_kg for charge in charges):g} kg"
    yield "model", f"{blast.model}, {blast.loading} pressure{', with shielding' if blast.shielding else ''}"
    if blast.apply == "fields":
        yield "applied by", f"force fields{_fields_are_slow(scenario.fracture.shards)}"
    else:
        yield "applied", "directly in every sub-step"


def _fields_are_slow(shards: int) -> str:
    return f'; with {shards} shards these are slow, and blast.apply = "direct" is not' if shards > MOST_FIELDS else ""
