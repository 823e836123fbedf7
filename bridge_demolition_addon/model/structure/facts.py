"""Facts about a model before a run: shards, connections, how the bridge stands at rest, what changes with
the number of shards."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np

from ...engineering.elasticity.accuracy import spacing_m
from ...engineering.elasticity.equations import connected_parts
from ...engineering.elasticity.equilibrium import Equilibrium
from ...engineering.elasticity.member_shapes import member_shapes
from ...engineering.elasticity.section_stiffness import DAMPING_RATIO
from ...engineering.geometry.overlap import SHARD_OVERLAP_TOLERANCE, Overlaps, hulls, overlaps
from ...engineering.geometry.vectors import AXES, SIDES
from ...engineering.mechanics.strength import MATERIALS, NEWTON_PER_SQUARE_MILLIMETRE, SMEARED, Joint, Strength
from ...engineering.reinforced_concrete.resistance import FRICTION_ALONG_CRACK
from ...engineering.units import mass_text
from ..actions import Fact
from ..bridge.member import Member
from ..reinforcement.concrete_members import plain_concrete_text
from ..scenario import ConnectionBetween, ConnectionSettings, Scenario
from ..scenario.connections import LARGE_MODEL, MATERIAL_OF_LARGE_MODELS
from ..scenario.girders import GirderSpan, StudRow
from ..scenario.scenario import JointName, bearing_tables, studs_of
from ..scenario.steelwork import Steelwork
from ..schema import given
from .bearing_ranges import another_cut_facts, bearing_facts
from .cracking import CrackedBridge, RestingModel
from .equilibrium import deflection_m, force_utilisations, loads_of, overloaded
from .member_layers import LayersOfMember, layers_of_members, spread_bars
from .model import Model
from .punching import punching_of_decks
from .starter_bars import GIRDER, ON_GIRDERS
from .t_beams import TBeam, t_beams

MOST_SHARDS_COMPARED = 2000
"""Comparing so many shards with their neighbours takes as long as cutting them."""

MOST_PAIRS_NAMED = 5
MOST_MEMBERS_NAMED = 3

_NO_KIND = "member"
"""Kind of members from files of which the scenario says none: they are named one by one."""

_ACROSS = {"turn x": (1, 2), "turn y": (0, 2), "turn z": (0, 1)}
"""Axes along which faces that are apart hold against a rotation that each of them leaves free."""

_ONE_ROW_M = 0.02
"""Distance up to which faces turn about one axis."""


def overlap_facts(model: Model) -> Iterator[Fact]:
    """Yield whether shards lie in each other, which would throw them apart when the simulation begins."""
    if len(model.shards) > MOST_SHARDS_COMPARED:
        yield "overlapping shards", f"not compared with each other, as they are more than {MOST_SHARDS_COMPARED}"
        return
    yield from _pair_facts("overlapping shards", overlaps(model.shards), model)
    # What Blender lets collide. Hulls of connected shards overlap unharmed until their connection breaks.
    yield from _pair_facts("overlapping hulls", overlaps(hulls(model.shards)), model)


def _pair_facts(name: str, pairs: Overlaps, model: Model) -> Iterator[Fact]:
    yield name, f"{len(pairs) or 'no'} pairs, by more than {SHARD_OVERLAP_TOLERANCE:g} of the smaller one"
    for (first, second), volume in list(zip(pairs.pairs, pairs.volumes, strict=True))[:MOST_PAIRS_NAMED]:
        named = (f"{model.members[model.member_of_shard[shard]].name}, shard {shard}" for shard in (first, second))
        yield "", f"{volume:.3g} m³ of {' and '.join(named)}"


def connection_facts(scenario: Scenario, model: Model) -> Iterator[Fact]:
    connections = scenario.connections
    yield "shards", f"{len(model.shards)}"
    kind = f"{connections.type}, {_method(connections)}, at most {connections.limit_per_shard} per shard"
    yield "connections", f"{len(model.connections.pairs)}, {kind}"
    if scenario.steelwork:
        yield "bars of steel", _grades_text(scenario.steelwork)
    names = list(scenario.named_joints)
    if {names[row].kind for row in np.unique(model.joint_of_connection).tolist()} != {"steel"}:
        yield from _breaking_facts(scenario, model)
    yield from _piece_facts(model)
    yield from _bar_facts(scenario, model)
    yield from _spread_facts(scenario, model)
    yield from _starter_facts(scenario, model)
    yield from _punching_facts(scenario, model)
    yield from _rule_facts(scenario)
    yield from _clamping_facts(scenario, model)
    yield from _bearing_facts(scenario, model)


def _breaking_facts(scenario: Scenario, model: Model) -> Iterator[Fact]:
    """Yield what connections break by that are of no bars of steel."""
    connections = scenario.connections
    is_large = scenario.fracture.shards >= LARGE_MODEL
    if connections.material is not None:
        is_usual = is_large and connections.material == MATERIAL_OF_LARGE_MODELS
        usual = f", as in all models of {LARGE_MODEL} shards or more that give no strength" if is_usual else ""
        yield "strength of", f"{connections.material}{usual}"
        yield from _strength_facts(given(scenario.joints[0].strength))
        if model.bars and connections.material in SMEARED:
            yield "", f"Members with bars crack as {SMEARED[connections.material]}, and the bars hold on: these"
            yield "", "strengths have steel that is smeared over each face, which would count twice."
    else:
        force = given(scenario.joints[0].breaking_force_n)
        yield "breaking force", f"{force:.1f} N = {force / 1000.0:.2f} kN"
        yield "breaking impulse", f"{scenario.time.step.impulse(force):.4g} N·s in a sub-step"
        if is_large:
            yield from _stress_facts(force, scenario, model)
            yield "", "one force for all: the finer the bridge is cut, the stronger it is. To break by the"
            yield "", f'strength of {MATERIAL_OF_LARGE_MODELS} give none, and method "face"'


def _grades_text(steelwork: Steelwork) -> str:
    """Return the grades of the bars, with their yield strengths by thickness."""
    grades: dict[str, set[float]] = {}
    for bar in steelwork.all_members:
        yield_n_mm2 = steelwork.yield_and_ultimate_pa(bar)[0] / NEWTON_PER_SQUARE_MILLIMETRE
        grades.setdefault(steelwork.grade_of(bar), set()).add(yield_n_mm2)
    listed = ((grade, " or ".join(f"{value:g}" for value in sorted(grades[grade]))) for grade in sorted(grades))
    return "; ".join(f"{grade}, yield strength {values} N/mm²" for grade, values in listed)


def _piece_facts(model: Model) -> Iterator[Fact]:
    """Yield in how many pieces the bridge is that no connection holds together, if in more than one."""
    pieces = _pieces(model)
    if len(pieces) > 1:
        yield "pieces", f"{len(pieces)}, which no connection holds together: they lie on each other by contact alone"
        for names in pieces[:MOST_PAIRS_NAMED]:
            yield "", _listed(names)
        if len(pieces) > MOST_PAIRS_NAMED:
            yield "", f"and {len(pieces) - MOST_PAIRS_NAMED} more, none of more members than these"


def _pieces(model: Model) -> list[list[str]]:
    """Return the names of the members in each piece that connections hold together, the largest piece first.

    No connection lies between two shards that never move: shards of one member belong together by that.
    """
    count = len(model.shards)
    pairs = model.connections.pairs
    pairs = pairs[((pairs >= 0) & (pairs < count)).all(axis=1)]
    held = np.flatnonzero(model.fixed)
    held = held[np.argsort(model.member_of_shard[held], kind="stable")]
    beside = np.column_stack((held[:-1], held[1:]))
    beside = beside[model.member_of_shard[beside[:, 0]] == model.member_of_shard[beside[:, 1]]]
    first, second = np.concatenate((pairs, beside)).T
    label = connected_parts(np.ones(count, bool), first, second)
    members = (dict.fromkeys(model.member_of_shard[label == piece].tolist()) for piece in np.unique(label))
    named = [[model.members[member].name for member in piece] for piece in members]
    return sorted(named, key=len, reverse=True)


def _listed(names: Sequence[str]) -> str:
    more = len(names) - MOST_MEMBERS_NAMED
    return ", ".join(names[:MOST_MEMBERS_NAMED]) + (f" and {more} more" if more > 0 else "")


def _bar_facts(scenario: Scenario, model: Model) -> Iterator[Fact]:
    alike: dict[tuple[str, str], list[str]] = {}
    beams = tuple(t_beams(scenario, model.layers, model.members))
    for beam in beams:
        alike.setdefault(_beam_texts(scenario, beam), []).append(model.members[beam.girder.member].name)
    for group in layers_of_members(model.layers, model.members):
        if not any(beam.has(group) for beam in beams):
            alike.setdefault(_bar_texts(scenario, group), []).append(model.members[group.member].name)
    for (resisted, ruptured), names in alike.items():
        yield "reinforcement", f"{_together(names)}, {resisted}"
        yield "", ruptured
    if text := plain_concrete_text(scenario):
        yield "without bars", text


def _bar_texts(scenario: Scenario, group: LayersOfMember) -> tuple[str, str]:
    """Return which moments the bars of a member resist, and when they rupture."""
    along, across, _ = group.axes
    sides = sorted((highest, side) for side, (axis, highest) in SIDES.items() if axis == across)
    compression_pa, factor = (
        float(given(scenario.joints[0].strength).compression_pa),
        scenario.connections.strength_factor,
    )
    moments = zip(
        [side for _, side in reversed(sides)], group.section(compression_pa, factor).moments_nm(), strict=True
    )
    resisted = ", ".join(f"{moment / 1000.0:.4g} kN·m with its {side} pressed" for side, moment in moments)
    return f"along {AXES[along]}{_between_text(group.between_m)}: {resisted}", _ruptured_text(scenario, [group])


def _beam_texts(scenario: Scenario, beam: TBeam) -> tuple[str, str]:
    """Return the same of a girder with the slab that it is cast with, in the span and over a pier."""
    factor = scenario.connections.strength_factor
    compression_pa = float(given(scenario.joints[0].strength).compression_pa)
    begin_m, end_m = beam.deck.between_m
    moments = []
    for number, (pressed, where, places_m) in enumerate(
        (
            ("top", "in the span", [0.5 * (one + other) for one, other in pairwise(beam.supports_m)]),
            ("bottom", "over a pier", beam.supports_m[1:-1]),
        )
    ):
        if at_m := [place for place in places_m if begin_m <= place <= end_m]:
            moment_nm = beam.section(at_m[0], compression_pa, factor).moments_nm()[number]
            flange = f"{beam.flange_m(at_m[0]):.2f} m of slab"
            moments.append(f"{moment_nm / 1000.0:.4g} kN·m with its {pressed} pressed, {flange}, {where}")
    return (
        f"and slab along x{_between_text(beam.deck.between_m)}: {'; '.join(moments)}",
        _ruptured_text(scenario, [beam.girder, beam.deck], beam.depth_m),
    )


def _ruptured_text(scenario: Scenario, groups: Sequence[LayersOfMember], whole_m: float | None = None) -> str:
    own_m, steel = scenario.connections.ductile_elongation_m, scenario.steel
    compression_pa = float(given(scenario.joints[0].strength).compression_pa)
    openings = [opening for group in groups for opening in group.openings_m(compression_pa, steel, whole_m)]
    openings = openings if own_m is None else [own_m]
    ranged = " to ".join(dict.fromkeys(f"{1000.0 * opening:.3g}" for opening in (min(openings), max(openings))))
    more = " more than what shards beside it stretch" if scenario.connections.cracks_within_shards else ""
    return f"These bars rupture once a crack has opened by {ranged} mm{more}."


def _together(names: Sequence[str]) -> str:
    """Return members that are alike as one text, as ``6 × pier column`` without what counts them."""
    if len(names) == 1:
        return names[0]
    without_numbers = {" ".join(word for word in name.split() if not word.isdecimal()) for name in names}
    listed = ", ".join(names) if len(without_numbers) > 1 else without_numbers.pop()
    return f"{len(names)} × {listed}"


def _between_text(between_m: tuple[float, float]) -> str:
    """Return the part of a member between two positions as text; empty for all of it."""
    begin, end = between_m
    texts = [f"from {begin:.2f} m" if begin > -np.inf else "", f"to {end:.2f} m" if end < np.inf else ""]
    return "".join(f" {text}" for text in texts if text)


def _spread_facts(scenario: Scenario, model: Model) -> Iterator[Fact]:
    alike: dict[str, list[str]] = {}
    for spread in spread_bars(model.layers, model.members):
        layer = spread.layer
        stress_n_mm2 = 1e-6 * scenario.connections.strength_factor * layer.ratio * layer.yield_pa
        text = f"spread along {layer.along}: {stress_n_mm2:.3g} N/mm² of the area across them"
        alike.setdefault(text, []).append(model.members[spread.member].name)
    for text, names in alike.items():
        yield "reinforcement", f"{_together(names)}, {text}"


def _starter_facts(scenario: Scenario, model: Model) -> Iterator[Fact]:
    """Yield what bars between members of one piece carry."""
    alike: dict[tuple[str, str], list[str]] = {}
    if bars := model.bars:
        of_pair = np.sort(np.append(model.member_of_shard, -1)[model.connections.pairs], axis=1)
        has = (of_pair[:, 0] != of_pair[:, 1]) & (bars.yield_n > 0.0) & ~bars.have_own_law
        for one, other in np.unique(of_pair[has], axis=0).tolist():
            rows = has & (of_pair == (one, other)).all(axis=1)
            first, last = model.members[one] if one >= 0 else None, model.members[other]
            carried_n, opened_mm = float(bars.yield_n[rows].sum()), 1e3 * float(bars.openings_m[rows].max())
            ruptured = f"These bars rupture once a crack has opened by {opened_mm:.3g} mm."
            if first and {first.kind, last.kind} == ON_GIRDERS:
                girder = last if last.kind == GIRDER else first
                by_m = carried_n / float(np.ptp(girder.without_skew(girder.solid.vertices)[:, 0])) / 1000.0
                text = f"links to the slab carry {by_m:.4g} kN/m across a crack, "
                text += f"{FRICTION_ALONG_CRACK * by_m:.4g} kN/m along it (EN 1992-1-1, 6.2.5)"
                alike.setdefault((text, ruptured), []).append(girder.name)
            else:
                text = f"bars into the {first.kind}" if first else "bars into its footing"
                alike.setdefault((f"{text} carry {carried_n / 1000.0:.4g} kN", ruptured), []).append(last.name)
    for (text, ruptured), names in alike.items():
        yield "reinforcement", f"{_together(names)}, {text}"
        yield "", ruptured


def _punching_facts(scenario: Scenario, model: Model) -> Iterator[Fact]:
    ball, strength = scenario.ball, scenario.joints[0].strength
    if ball is None or ball.cable or strength is None:
        return
    layers, strength_pa = model.layers, float(strength.compression_pa)
    alike: dict[tuple[str, str], list[str]] = {}
    for deck in punching_of_decks(layers, model.members, strength_pa, ball.diameter_m):
        forces = f"{deck.on_point_n / 1000.0:.4g} kN on a point, {deck.on_ball_n / 1000.0:.4g} kN on all of the ball"
        momentum_ns = ball.mass_kg * ball.impact_speed_m_s
        stopped_ms = 1000.0 * math.pi * momentum_ns / 2.0 / deck.on_ball_n
        stopped = f"without factors of safety; the ball punches if it stops in less than {stopped_ms:.3g} ms"
        alike.setdefault((forces, stopped), []).append(deck.member)
    for (forces, stopped), names in alike.items():
        yield "punching", f"{_together(names)}: {forces}"
        yield "", stopped


def rest_facts(scenario: Scenario, resting: RestingModel) -> Iterator[Fact]:
    """Yield how an elastic bridge stands under its own weight."""
    model, rest = resting.model, resting.rest
    held = int(rest.held[: len(model.shards)].sum())
    loose = len(model.shards) - held - int(model.fixed.sum())
    broken = int(overloaded(model, rest, scenario.joints).sum())
    cracked = resting.cracked() if broken else None
    stands = _with_cracks(resting)
    if loose:
        yield from _loose_facts(model, rest.held[: len(model.shards)], held)
    if cracked:
        yield from _crack_facts(cracked)
    elif held or not loose:
        of_held = ", where it is held" if loose else ""
        weight = f"by the bridge's own weight alone{of_held}"
        yield "overloaded", f"{broken} of {len(model.connections)} connections, {weight}"
    if not scenario.connections.is_elastic:
        yield "", "if they were elastic. Rigid ones share loads otherwise: a run says whether it stands"
    elif broken and not cracked:
        yield "", "they break before anything is done to it, and the bridge may fall by itself"
    used = force_utilisations(model, rest, scenario.joints)
    if by_force := np.count_nonzero(~np.isnan(used)):
        yield (
            "of breaking forces",
            f"{np.nanmax(used):.1%} used at most, {np.nanmean(used):.1%} in the mean of {by_force}",
        )
        yield "", "by the force or moment of each that is largest, in N or N·m, as Bullet breaks it"
    if held:
        deflected_m, with_cracks = (
            (stands.deflection_m, ", with its cracks") if stands else (deflection_m(model, rest), "")
        )
        yield "deflection" if deflected_m >= 0.0 else "camber", f"{1000.0 * abs(deflected_m):.2f} mm{with_cracks}"
        yield "first frequency", f"{rest.frequency_hz:.3f} Hz{', without cracks' if stands else ''}"
        yield "damping", _damping_text(scenario, rest.frequency_hz)


def reaction_facts(scenario: Scenario, resting: RestingModel) -> Iterator[Fact]:
    """Yield what bearings carry under the bridge's own weight; nothing without bearings, or where nothing is held."""
    model = resting.model
    if not model.bearings or not resting.rest.held[: len(model.shards)].any():
        return
    stands = _with_cracks(resting)
    bearings = model.bearings.forces(stands.loads if stands else loads_of(model, resting.rest))
    yield from bearing_facts(scenario, model, resting.rest, bearings)


def _with_cracks(resting: RestingModel) -> CrackedBridge | None:
    """Return the bridge with its cracks; None where it does not crack, or does not stand so."""
    if not overloaded(resting.model, resting.rest, resting.joints).any():
        return None
    cracked = resting.cracked()
    return cracked if cracked and not cracked.fallen.any() else None


def _loose_facts(model: Model, is_held: np.ndarray, held: int) -> Iterator[Fact]:
    """Yield what no connection to a support holds, and in which members that is most."""
    loose = ~is_held & ~model.fixed
    mass_kg = float(model.masses_kg[loose].sum())
    share = mass_kg / float(model.masses_kg[~model.fixed].sum())
    count = int(loose.sum())
    how = f"{count} of {count + held} shards, {mass_text(mass_kg).strip()}, {share:.0%} of what can move"
    yield "does not stand" if not held else "not held", f"{how}, are held by no connection to a support:"
    by_member = np.bincount(model.member_of_shard[loose], model.masses_kg[loose], minlength=len(model.members))
    heaviest = [row for row in np.argsort(-by_member, kind="stable")[:MOST_MEMBERS_NAMED].tolist() if by_member[row]]
    names = ", ".join(model.members[row].name for row in heaviest)
    more = " and more" if np.count_nonzero(by_member) > len(heaviest) else ""
    yield "", f"they fall, or tremble on others. Most of it is in {names}{more}. Let members touch what"
    yield "", "stands, or hold them: [[supports]], [[bearings]]"


def _crack_facts(bridge: CrackedBridge) -> Iterator[Fact]:
    """Yield how a bridge with bars cracks by its own weight, and whether it stands."""
    cracks, used = np.count_nonzero(~bridge.intact), bridge.bars_used
    held = np.count_nonzero(np.isfinite(used))
    by_bars = "" if bridge.fallen.any() else f", {'all' if held == cracks else held} held by bars"
    yield "cracked", f"{cracks} of {len(bridge.intact)} faces are cracked by the bridge's own weight{by_bars}"
    if bridge.fallen.any():
        yield "", f"bars do not hold it: {np.count_nonzero(bridge.fallen)} shards come down by themselves"
        return
    if held:
        yield "", f"with {np.nanmax(used):.0%} of the force at which these rupture at most"
    yield "", "it stands at rest. A run cracks it at once, with a jerk: see docs/stages.md"


def _damping_text(scenario: Scenario, frequency_hz: float) -> str:
    """How the first frequency is damped in a run, by what is asked for and by steps in time."""
    asked = scenario.connections.damping_ratio
    asked = DAMPING_RATIO if asked is None else asked
    by_steps = float(np.pi * frequency_hz * scenario.time.step.substep_s)
    if by_steps > asked:
        return f"{by_steps:.1%} by steps in time, more than the {asked:.1%} asked for: take more sub-steps"
    return f"{asked:.1%} of critical, {by_steps:.1%} of it by steps in time"


def accuracy_facts(scenario: Scenario, resting: RestingModel) -> Iterator[Fact]:
    """Yield how many shards members have along their length and depth, and what differs in another cut."""
    model = resting.model
    moves = np.bincount(model.member_of_shard[~model.fixed], minlength=len(model.members)) > 0
    moves &= np.array([member.steel is None for member in model.members])
    if scenario.steelwork:
        pieces = sorted({scenario.steelwork.pieces_of(table) for table in scenario.steelwork.all_members})
        ranged = " to ".join(dict.fromkeys(f"{count}" for count in (pieces[0], pieces[-1])))
        yield "pieces of a steel bar", f"{ranged} along its length: docs/steel.md says how far off bending is with few"
    along, deep = _fineness(model)
    kinds = np.array([member.name if member.kind == _NO_KIND else member.kind for member in model.members])
    for kind in dict.fromkeys(kinds[moves].tolist()):
        rows = np.flatnonzero(moves & (kinds == kind))
        fewest = rows[np.argmin(along[rows])]
        of_many = f", of {len(rows)} in the coarsest" if len(rows) > 1 else ""
        yield f"shards of {kind}", f"{along[fewest]:.0f} along its length, {deep[fewest]:.0f} in its depth{of_many}"
    yield from another_cut_facts(scenario, resting)


def _fineness(model: Model) -> tuple[np.ndarray, np.ndarray]:
    """Shards along the lengths and depths of members, (k,) each."""
    counts = np.bincount(model.member_of_shard, minlength=len(model.members)).tolist()
    shapes = member_shapes([member.solid for member in model.members])
    fineness = []
    for row, (member, count) in enumerate(zip(model.members, counts, strict=True)):
        # What is neither bar nor plate, such as a box girder, is as thick as its walls.
        extents = shapes.extents_m[row].tolist() if shapes.are_filled[row] else _extents_of_walls(member)
        thickness, width, length = extents
        spacing = spacing_m(member.volume_m3, max(count, 1), thickness, width)
        fineness.append((length / spacing, max(1.0, thickness / spacing)))
    along, deep = np.array(fineness).reshape(-1, 2).T
    return along, deep


def _extents_of_walls(member: Member) -> tuple[float, float, float]:
    """Thickness, width and length of a member by its walls, m."""
    _, width, length = sorted(np.ptp(member.solid.vertices, axis=0).tolist())
    return member.thickness_m, width, length


def foundation_facts(scenario: Scenario, resting: RestingModel) -> Iterator[Fact]:
    """Yield the pressure of footings on their soil by the bridge's own weight."""
    model, rest, soil = resting.model, resting.rest, given(resting.model.soil)
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
            f"{pressure / float(soil.capacity_pa[mine][0]):.1%} of its capacity, {1e3 * settled:.2f} mm",
        )


def _stress_facts(force_n: float, scenario: Scenario, model: Model) -> Iterator[Fact]:
    """Yield the mean stress at one breaking force for all, which grows with the number of shards."""
    alike = np.array([joint.breaking_force_n == force_n for joint in scenario.joints])
    holds = alike[model.joint_of_connection]
    if area_m2 := float(model.connections.areas[holds].sum()):
        stress = force_n * int(holds.sum()) / area_m2 / NEWTON_PER_SQUARE_MILLIMETRE
        torn = MATERIALS["concrete"].tension_pa / NEWTON_PER_SQUARE_MILLIMETRE
        yield "of all, by their area", f"{stress:.3g} N/mm² in the mean; plain concrete is torn at {torn:g} N/mm²"


def _rule_facts(scenario: Scenario) -> Iterator[Fact]:
    joints = scenario.named_joints
    for number, rule in enumerate(scenario.connections.between, start=1):
        joint = joints[JointName("rule", number)]
        yield "between", f"{' and '.join(rule.members)}: {'none' if rule.none else _joint_text(rule, joint)}"


def _clamping_facts(scenario: Scenario, model: Model) -> Iterator[Fact]:
    """Yield which faces between members turn freely one by one, but clamp together."""
    of_body = np.append(model.member_of_shard, len(model.members))  # the ground is -1, the last
    names = [member.name for member in model.members] + ["the ground"]
    for number, joint in enumerate(scenario.joints[: 1 + len(scenario.connections.between)]):
        rows = np.flatnonzero(model.joint_of_connection == number)
        between = np.sort(of_body[model.connections.pairs[rows]], axis=1)
        rows, between = rows[between[:, 0] != between[:, 1]], between[between[:, 0] != between[:, 1]]
        for motion in (motion for motion in joint.free if motion in _ACROSS):
            for pair in np.unique(between, axis=0):
                points = model.connections.points[rows[(between == pair).all(axis=1)]]
                depth_m = max(float(np.ptp(points[:, axis])) for axis in _ACROSS[motion])
                if depth_m > _ONE_ROW_M:
                    yield "clamps", f"{' and '.join(names[member] for member in pair)}: free to {motion}, but in faces"
                    yield "", f"{depth_m:.2f} m apart across that axis, which press and pull: [[bearings]] turn freely"


def _bearing_facts(scenario: Scenario, model: Model) -> Iterator[Fact]:
    if not model.bearings:
        return
    bearings = model.bearings
    joints = list(scenario.named_joints)
    tables = {joints.index(JointName("bearing", row)): table for row, table in enumerate(bearing_tables(scenario))}
    for number, name in enumerate(bearings.names):
        rows = bearings.rows_of(number)
        if not len(rows):
            continue
        if table := tables.get(int(model.joint_of_connection[rows[0]])):
            yield "bearing", f"{name}: {table.described}, {len(rows)} connections"
        else:
            yield _of_steelwork(scenario, name, len(rows))
    if not scenario.connections.is_elastic:
        yield "", "with rigid connections they hold what is lifted, and slide without friction"
    if scenario.shards.start_deactivated:
        yield "", "while shards sleep, a run does not know their forces: shards.start_deactivated = false"


def _of_steelwork(scenario: Scenario, name: str, connections: int) -> Fact:
    """Describe the support of a node, or how a deck lies on a girder, by the name of that bearing."""
    steelwork = given(scenario.steelwork)
    for span in steelwork.decks:
        if name.startswith(f"{span.deck_name} on "):
            return (
                "bearing",
                f"{name}: without studs, with a friction of {span.deck_friction:g}, {connections} connections",
            )
    supports = {f"{node.name} on {node.held_by}": node.support for node in steelwork.all_nodes}
    return "support", f"{name}: {supports[name]}"


def _joint_text(rule: ConnectionBetween, joint: Joint) -> str:
    words = [joint.type]
    if joint.free:
        words.append(f"free: {', '.join(joint.free)}")
    if rule.material is not None:
        words.append(f"strength of {rule.material}")
    elif rule.breaking_force_newton is not None:
        words.append(f"breaking force {rule.breaking_force_newton / 1000.0:.2f} kN")
    return ", ".join(words)


def _strength_facts(strength: Strength) -> Iterator[Fact]:
    for kind in ("compression", "tension", "shear", "torsion", "bending"):
        yield f"in {kind}", f"{getattr(strength, f'{kind}_pa') / NEWTON_PER_SQUARE_MILLIMETRE:g} N/mm²"


def _method(connections: ConnectionSettings) -> str:
    if connections.method == "face":
        return "shards that share a face"
    if connections.method == "nearest":
        return f"each with its {connections.neighbours} nearest"
    positions = {"vertex": "nearest vertices", "centre": "centres of mass"}
    return f"{positions[connections.method]} within {connections.search_radius_m:g} m"


def deck_facts(scenario: Scenario, model: Model, rest: Equilibrium) -> Iterator[Fact]:
    """Yield how decks of a model at rest lie on their girders, without cracks."""
    if not model.decks or not scenario.steelwork:
        return
    for number, span in enumerate(scenario.steelwork.decks):
        studs = studs_of(span, scenario)
        if studs is None:
            loose = f"on {span.girders} girders without studs, with a friction of {span.deck_friction:g}"
            yield span.deck_name, loose
            continue
        yield span.deck_name, f"on {span.girders} girders, {_described(span, studs)}"
        mine = model.decks.only(model.decks.decks == number)
        counts = mine.studded_m * studs.per_m
        if (several := counts >= 1.0).any():
            yield from _used(scenario, model, rest, mine.rows[several], counts[several], studs)


def _described(span: GirderSpan, studs: StudRow) -> str:
    by = "by EN 1994-1-1, 6.6.3.1" if span.stud_diameter_mm is not None else "as given"
    return (
        f"{studs.per_m:g} studs/m on each: {studs.shear_n / 1e3:.1f} kN in shear ({by}), "
        f"{studs.uplift_n / 1e3:.1f} kN in uplift, {studs.stiffness_n_m / 1e6:.0f} kN/mm, no partial factors"
    )


def _used(
    scenario: Scenario, model: Model, rest: Equilibrium, rows: np.ndarray, counts: np.ndarray, studs: StudRow
) -> Iterator[Fact]:
    """Yield the shear and uplift of the stud that has most of each, of contacts with their studs (c,), 1 or more."""
    forces, factor = loads_of(model, rest).forces_n[rows], scenario.connections.strength_factor
    shear = np.sqrt(np.square(forces[:, :2]).sum(axis=1)) / counts
    lifted = np.maximum(-forces[:, 2], 0.0) / counts
    for what, each, strength in (("shear", shear, studs.shear_n), ("uplift", lifted, studs.uplift_n)):
        row = int(each.argmax())
        place = model.connections.points[rows[row], 0]
        share = f"{each[row] / factor / strength:.0%}"
        yield f"studs in {what}", f"{each[row] / 1e3:.1f} kN each at most, {share}, at x = {place:.2f} m"


DEBRIS_M = {50: 2.6, 100: 3.5, 200: 3.8, 400: 7.0}
"""Debris distance of a drilled span of 13 m by its shards, the median of the seeds in docs/data/convergence.csv."""

SAG_M = {100: 0.055, 200: 0.058, 400: 0.064}
"""Deflection of a reinforced span of 13 m under a ball of 10 t by the shards of two of them, from
docs/data/reinforced_deck.csv."""


def convergence_facts(scenario: Scenario, shards: int) -> Iterator[Fact]:
    """Yield how much finer and coarser cuts changed the outcome of a demolition of the same kind."""
    if scenario.bridge is None:
        return
    spans = len(scenario.bridge.span_lengths_m)
    here = f"here {shards / spans:.0f} shards a span: docs/choosing.md says what to take"
    if scenario.blast_zones or scenario.charges:
        yield "debris distance", f"of a drilled span in {_by_shards(DEBRIS_M, 1, 'm')}, the median over seeds;"
        yield "", here
    elif scenario.ball:
        halves = {count // 2: sag for count, sag in SAG_M.items()}
        yield "dent of a ball", f"in a span in {_by_shards(halves, 3, 'm')}, the median over seeds;"
        yield "", here


def _by_shards(found: dict[int, float], digits: int, unit: str) -> str:
    counts = ", ".join(map(str, found))
    values = ", ".join(f"{value:.{digits}f}" for value in found.values())
    return f"{counts} shards: {values} {unit}"
