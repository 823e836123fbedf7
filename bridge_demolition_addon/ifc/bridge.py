"""A bridge from an IFC file: its members, how finely they are cut, connections, supports, and the scenario of them."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import chain, count, groupby
from pathlib import Path

import numpy as np

from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.solids import to_manifold
from ..errors import IfcError
from ..model.bridge.member import Member
from ..model.materials import BarLayer
from ..model.scenario import (
    ConnectionBetween,
    ConnectionSettings,
    FractureSettings,
    Geometry,
    Scenario,
    ShardSettings,
    Site,
    TimeSettings,
)
from ..model.scenario.fracture import MemberFracture
from ..model.schema import given
from ..model.structure.members import shards_per_member
from .assembly import Assembly
from .bars import bar_layers, with_bars_by_rule
from .bodies import Bodies, bodies_of
from .contacts import NearbyMembers
from .element_materials import MaterialTable, material_table, substances
from .elements import Element, elements_of, plain_text
from .kinds_by_shape import with_kinds_by_shape
from .left_out import leave_out_clamping_slabs, leave_out_light_bracing, leave_out_plates
from .likely_units import with_likely_unit
from .map_place import ground_of, site_of
from .outcome import BAR, CONNECTION, LEFT_OUT, MEMBER, Outcome
from .placement import Placement, placement_of
from .quantities import quantities_of, units_of
from .settings import ImportSettings
from .several_bridges import CARRYING, chosen_elements
from .shapes import KeptShapes, shapes_of
from .source import IfcSource, naming_contradictions, open_source
from .steel_elements import STEEL, SteelElements, steel_elements
from .steel_frames import (
    SteelFrame,
    as_they_stand,
    cut_out,
    fallen,
    steel_frame,
    supported,
    with_no_bearings_on,
)
from .steel_notes import by_reason, steel_notes
from .supports import CLEARANCE_M, STANDING, loose_members, supports_of

MESH_FOLDER = "members"

_DURATION_S = 3.0
_WARM_UP_S, _WARM_UP_DAMPING = 0.5, 0.99
"""Time in which the bridge settles under its own weight, and by how much it is damped then."""

_STANDING = (*STANDING, "footing")


@dataclass(frozen=True, slots=True)
class ImportedBridge:
    """A bridge from an IFC file.

    The meshes have the paths of the scenario, relative to its folder. The outcomes have one entry for each element of
    the file, in its order. The ground has its height in the file; the sources say where ground and site are from.
    """

    scenario: Scenario
    meshes: dict[str, TriangleMesh]
    outcomes: tuple[Outcome, ...]
    ground_m: float
    ground_source: str
    site_source: str
    notes: tuple[str, ...]
    left_out: dict[str, TriangleMesh] = field(default_factory=dict)
    """Elements that have a shape, but are no members, where they stand, by different names."""
    on_bars: tuple[str, ...] = ()
    """What is said of bars of steel."""


def read_bridge(path: Path, settings: ImportSettings, kept: KeptShapes | None = None) -> ImportedBridge:
    """Read a bridge from an IFC file, maybe with shapes of elements that were worked out before."""
    table = material_table(settings.materials)
    with naming_contradictions(path):
        return _bridge(path, table, settings, kept or KeptShapes())


def _bridge(path: Path, table: MaterialTable, settings: ImportSettings, kept: KeptShapes) -> ImportedBridge:
    source = open_source(path, settings)
    found = elements_of(source, settings)
    by_shape: tuple[str, ...] = ()
    if not settings.strict:
        found, by_shape = with_kinds_by_shape(source, found, kept)
    chosen = chosen_elements(source, found, settings)
    elements = chosen.elements
    _check_kinds(path, elements, settings)
    wanted = [element for element in elements if element.is_member]
    source, shapes = with_likely_unit(source, wanted, shapes_of(source, wanted, kept), settings)
    made_of = substances(source, wanted, table, settings)
    units = units_of(source.model)
    quantities = {element.entity.id(): quantities_of(element.psets, units) for element in elements}
    volumes = {number: known.volume_m3 for number, known in quantities.items() if known.volume_m3}
    bodies = bodies_of(source, wanted, shapes, kept, volumes, strict=settings.strict)
    ground_m, ground_source = _ground(path, wanted, bodies, settings)
    placement, solids = _placed(path, wanted, bodies, ground_m)
    site, site_source = site_of(source, placement)
    ground, of_ground = ground_of(source, placement)
    steel = SteelElements({}, {})
    if settings.takes_bars:
        steel = steel_elements(source, wanted, solids, made_of, placement)
    result = Assembly(elements, made_of, quantities, bodies, bars=frozenset(steel.bars))
    result.add_members(solids)
    if settings.strict and result.unfit:
        wrong = "; ".join(f"{title} {why}" for title, why in result.unfit.items())
        raise IfcError(f"{path}: {wrong}; leave such elements out by --without NAME")
    bearings = [element for element in wanted if element.kind == "bearing" and element.entity.id() in solids]
    frame: SteelFrame | None = None
    on_bars: tuple[str, ...] = ()
    gap_m = 0.0 if settings.strict else settings.bearing_gap_m
    if settings.strict:
        result.add_bearings(bearings, solids, placement, gap_m, table)
    else:
        frame, on_bars = _put_together(result, settings, steel, bearings, solids, placement, gap_m, table, kept.says)
    bars: list[BarLayer] = []
    if not settings.strict:
        bars, said = bar_layers(source, elements, dict(result.members()), placement)
        result.notes += said
    scenario, meshes, held = _scenario(source, settings, result, site, chosen.title or _title(source), frame)
    if ground:
        scenario = replace(scenario, ground=ground)
    if bars:
        scenario = replace(scenario, reinforcement=tuple(bars))
    if not settings.strict:
        scenario = with_bars_by_rule(scenario)
    return ImportedBridge(
        scenario=scenario,
        meshes=meshes,
        outcomes=tuple(result.outcomes.values()),
        ground_m=ground_m,
        ground_source=ground_source,
        site_source=site_source,
        notes=(*source.notes, *chosen.notes, *by_shape, *of_ground, *result.notes, *held),
        left_out=_left_out(result, bodies, placement, solids),
        on_bars=on_bars,
    )


def _put_together(
    result: Assembly,
    settings: ImportSettings,
    steel: SteelElements,
    bearings: Sequence[Element],
    solids: Mapping[int, TriangleMesh],
    placement: Placement,
    gap_m: float,
    table: MaterialTable,
    says: Callable[[str], None],
) -> tuple[SteelFrame | None, tuple[str, ...]]:
    """Put members together, and return the frame of those that are bars of steel, if there are any, and notes on these.

    Notes say of other elements of steel why they are no bars.
    """
    taken = {number: bar for number, bar in steel.bars.items() if result.outcomes[number].became == BAR}
    taken = with_no_bearings_on(result, taken, [solids[bearing.entity.id()] for bearing in bearings])
    before = {number: given(result.outcomes[number].member).solid.vertices[0] for number in taken}
    leave_out_light_bracing(result, settings.shards)
    result.fit_together()
    plates = leave_out_plates(result, as_they_stand(result, taken, before))
    says("closing gaps between members")
    result.close_gaps(gap_m)
    result.add_bearings(bearings, solids, placement, gap_m, table)
    leave_out_clamping_slabs(result)
    hung = as_they_stand(result, taken, before)
    supports = supported(result, hung, gap_m)
    says("looking for what nothing holds")
    result.hold(gap_m, table)
    standing = as_they_stand(result, taken, before)
    stays = {
        number: f"{why}: no bar, and cut into shards"
        for number, why in steel.refused.items()
        if result.outcomes[number].became == MEMBER
    }
    apart = {**fallen(result, hung, standing), **stays}
    frame = None
    lines = tuple(by_reason(result, apart))
    if standing:
        frame, said = steel_frame(result, standing, supports, plates)
        lines = (*steel_notes(result, said), *lines)
        cut_out(result, frame)
    says("cutting off where members lie in each other")
    result.drop_consumed()
    result.make_writable()
    return frame, lines


def _left_out(
    result: Assembly, bodies: Bodies, placement: Placement, solids: Mapping[int, TriangleMesh]
) -> dict[str, TriangleMesh]:
    """Return the meshes of elements that have a shape and are left out, by different names."""
    near = replace(placement, origin_m=placement.origin_m - bodies.origin)
    meshes: dict[str, TriangleMesh] = {}
    for number, outcome in result.outcomes.items():
        if outcome.became != LEFT_OUT:
            continue
        mesh = solids.get(number)
        if mesh is None and number in bodies.unsound:
            mesh = near.placed(bodies.unsound[number])
        if mesh is not None:
            name = plain_text(outcome.facts.name) or outcome.facts.classes[0]
            meshes[next(text for text in chain([name], (f"{name} {n}" for n in count(2))) if text not in meshes)] = mesh
    return meshes


def _check_kinds(path: Path, elements: Sequence[Element], settings: ImportSettings) -> None:
    present = sorted({element.member_kind for element in elements if element.is_member})
    needed: list[tuple[tuple[str, ...], str]] = [(CARRYING, "carries the road")]
    if settings.strict:
        needed.append((_STANDING, "stands on the ground"))
    for kinds, use in needed:
        if set(present).isdisjoint(kinds):
            but = f"but {', '.join(present)}" if present else "nor of any other"
            raise IfcError(
                f"{path}: has no element that {use}, of the kinds {', '.join(kinds)}, {but}; say "
                f"which are by --kind, as in --kind 'NAME={kinds[0]}'"
            )


def _ground(path: Path, elements: Sequence[Element], bodies: Bodies, settings: ImportSettings) -> tuple[float, str]:
    members = [element for element in elements if element.kind != "bearing" and element.entity.id() in bodies.solids]
    if not members:
        raise IfcError(f"{path}: no member has a body that can be used; export it again, with closed bodies")
    origin_m = float(bodies.origin[2])
    bounds = [bodies.solids[element.entity.id()].bounds for element in members]
    undersides = [float(low[2]) + origin_m for low, _ in bounds]
    lowest = min(undersides)
    if settings.ground_m is None:
        if not any(member.kind in _STANDING for member in members):
            return lowest - CLEARANCE_M, (
                f"{CLEARANCE_M:g} m below the bridge, of which nothing stands on the ground; --ground says it better"
            )
        return lowest, f"the underside of {members[undersides.index(lowest)].facts.name}, as --ground is not given"
    highest = max(float(high[2]) + origin_m for _, high in bounds)
    if not settings.ground_m < highest:
        raise IfcError(
            f"{path}: the ground at {settings.ground_m:g} m would cover the bridge, which reaches from {lowest:.2f} m "
            f"to {highest:.2f} m in its file"
        )
    return settings.ground_m, "as given by --ground"


def _placed(
    path: Path, elements: Sequence[Element], bodies: Bodies, ground_m: float
) -> tuple[Placement, dict[int, TriangleMesh]]:
    """Return where the bridge stands, and the solids there, by the numbers of their elements."""
    carrying = [
        bodies.solids[element.entity.id()]
        for element in elements
        if element.kind in CARRYING and element.entity.id() in bodies.solids
    ]
    if not carrying:
        reasons = "; ".join(dict.fromkeys(bodies.missing.values()))
        raise IfcError(
            f"{path}: nothing that carries the road has a body that can be used ({reasons}); export it again"
        )
    near = placement_of(carrying, ground_m - float(bodies.origin[2]))
    solids = {number: near.placed(solid) for number, solid in bodies.solids.items()}
    return replace(near, origin_m=near.origin_m + bodies.origin), solids


def _scenario(
    source: IfcSource,
    settings: ImportSettings,
    result: Assembly,
    site: Site | None,
    title: str,
    frame: SteelFrame | None,
) -> tuple[Scenario, dict[str, TriangleMesh], list[str]]:
    kept = [outcome for outcome in result.ordered().values() if outcome.member and outcome.became != BAR]
    of_members = [outcome for outcome in kept if outcome.became != CONNECTION]
    bars = [outcome.part[0] for outcome in result.ordered().values() if outcome.became == BAR]
    if not of_members and not bars:
        raise IfcError(f"{source.path}: nothing of it lies above the ground; put the ground lower by --ground")
    members = [outcome.part[0] for outcome in of_members]
    contacts = NearbyMembers([member.solid for member in (*members, *bars)])
    supports, held = supports_of(members, contacts, [support.name for support in result.added])
    # A member on a bearing touches the bearing, not the member below it. Bars have supports of nodes instead.
    tables = result.bearing_tables().without({bar.name for bar in bars})
    connected = {support.member for support in supports} | tables.members
    loose = loose_members(members, contacts, connected)
    parts = [outcome.part[0] for outcome in kept]
    meshes = {
        _file(number, outcome.part[0].name): outcome.mesh or outcome.part[0].solid
        for number, outcome in enumerate(kept, start=1)
    }
    geometry = tuple(
        Geometry(name=part.name, file=file, kind=part.kind, density_kg_m3=part.density_kg_m3)
        for part, file in zip(parts, meshes, strict=True)
    )
    main, within = _strength_rules(of_members)
    between = (*tables.connections, *within)
    scenario = Scenario(
        title=title,
        time=TimeSettings(duration_s=_DURATION_S),
        geometry=geometry,
        fracture=_fracture(settings, members, [member.name for member in result.added]),
        materials=tuple({own.name: own for outcome in kept if (own := outcome.part[1].row.own)}.values()),
        connections=_connections(main, between, strict=settings.strict),
        shards=ShardSettings(start_deactivated=settings.strict),
        bearings=tables.bearings,
        supports=tuple(supports),
        site=site,
        steelwork=frame.steelwork if frame else None,
    )
    return scenario, meshes, [*tables.notes, *held, *loose]


def _fracture(settings: ImportSettings, members: Sequence[Member], added: Sequence[str]) -> FractureSettings:
    if settings.strict:
        return FractureSettings(shards=max(settings.shards, len(members)))
    if not members:
        return FractureSettings(shards=1)
    return fracture_of(members, added, settings.shards)


def _connections(main: str, between: Sequence[ConnectionBetween], *, strict: bool) -> ConnectionSettings:
    """Return connections by the strength of a material; elastic ones that crack, so that the bridge stands awake."""
    rigid = ConnectionSettings(type="FIXED", method="face", material=main, between=tuple(between))
    if strict:
        return rigid
    return replace(
        rigid,
        stiffness="elastic",
        warm_up_s=_WARM_UP_S,
        warm_up_damping=_WARM_UP_DAMPING,
    )


def _strength_rules(kept: Sequence[Outcome]) -> tuple[str, list[ConnectionBetween]]:
    """Return the strength of most of the bridge by volume, and the connections within members that have another."""
    volumes: dict[str, float] = {}
    parts = [outcome.part for outcome in kept]
    for member, substance in parts:
        strength = substance.row.strength_name
        volumes[strength] = volumes.get(strength, 0.0) + member.volume_m3
    main = max(volumes, key=lambda strength: volumes[strength], default=STEEL)
    rules = []
    for kind, group in groupby(sorted(parts, key=lambda part: part[0].kind), key=lambda part: part[0].kind):
        of_kind = {member.name: substance.row.strength_name for member, substance in group}
        alike = set(of_kind.values())
        named = {kind: alike.pop()} if len(alike) == 1 else of_kind
        rules += [
            ConnectionBetween(members=(name, name), material=strength)
            for name, strength in named.items()
            if strength != main
        ]
    return main, rules


_NO_TITLES = ("undefined", "default", "unnamed", "project", "building", "unnamed bridge")
"""What programs call what the user has given no name."""


def _title(source: IfcSource) -> str:
    for name in ("IfcBridge", "IfcBuilding", "IfcProject"):
        try:
            entities = source.model.by_type(name)
        except RuntimeError:  # a class that the schema does not have
            continue
        title = plain_text(entities[0].Name or "") if entities else ""
        if title and title.casefold() not in _NO_TITLES:
            return title
    return plain_text(source.path.stem) or "Bridge from IFC"


def _file(number: int, name: str) -> str:
    letters = re.sub(r"[^a-z0-9]+", "_", name.lower()).strip("_")[:40]
    return f"{MESH_FOLDER}/{number:03d}{'_' if letters else ''}{letters}.obj"


_SLENDER = ("girder", "arch", "bracing", "parapet", "member", "pier cap")
_LONGEST = 3.0
"""Length of a shard of a slender member by the height of its section: a longer one of a curved girder would reach far
beside it, as what meets others in a run is the hull of a shard."""

_CURVED = 6.0
"""Volume of the hull by that of the member from which on its width is that of a curve: open sections have up to 4."""


def fracture_of(members: Sequence[Member], held: Collection[str], shards: int) -> FractureSettings:
    """Return how members are cut into about a number of shards; those that are `held` never move, and need no more."""
    volumes = np.array([member.volume_m3 for member in members])
    by_volume = shards_per_member(volumes, max(shards, len(members)))
    rules, more = [], 0
    for member, own in zip(members, by_volume.tolist(), strict=True):
        least = 1 if member.name in held or member.kind not in _SLENDER else _least_count(member)
        if least > own:
            rules.append(MemberFracture(member=member.name, shards=least))
            more += least - own
    return FractureSettings(shards=int(by_volume.sum()) + more, members=tuple(rules))


def _least_count(member: Member) -> int:
    longest, middle, least = np.sort(np.ptp(member.solid.vertices, axis=0))[::-1].tolist()
    is_curved = to_manifold(member.solid).hull().volume() > _CURVED * member.volume_m3
    return math.ceil(longest / (_LONGEST * (least if is_curved else middle)))
