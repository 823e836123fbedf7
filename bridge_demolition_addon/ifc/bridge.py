"""A bridge from an IFC file: its members, connections and supports, and the scenario of them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import chain, count, groupby
from pathlib import Path
from unicodedata import category

from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.solids import from_manifold, to_manifold
from ..errors import IfcError
from ..model.bridge.member import Member
from ..model.scenario import (
    ConnectionBetween,
    ConnectionSettings,
    FractureSettings,
    Geometry,
    Scenario,
    Site,
    TimeSettings,
)
from ..model.scenario.connections import GROUND_NAME
from ..model.schema import LINE_BREAKING_CATEGORIES, given
from .bearings import BearingTables, bearing_of, bearing_tables, seated
from .contacts import NearbyMembers
from .element_materials import Substance, substances
from .elements import Element, elements_of
from .kinds import ElementFacts
from .map_place import site_of
from .materials import MaterialTable, material_table
from .meshes import element_solids
from .placement import Placement, placement_of
from .settings import KINDS, ImportSettings
from .source import IfcSource, naming_contradictions, open_source
from .supports import loose_members, supports_of

MESH_FOLDER = "members"

_BELOW_GROUND_M = 1e-3
"""How far a member may reach below the ground, as elsewhere."""

_DURATION_S = 3.0
_CARRYING = ("deck", "girder")
_STANDING = ("pier", "abutment", "wall", "footing")


@dataclass(frozen=True, slots=True)
class Outcome:
    """The result for an element: ``member``, ``connection`` or ``left out``, and why, or another note on it.

    Its member and substance are None where it is left out. The mesh is written in place of the member's solid. It keeps
    the element's facts, not its entity, which is only valid while the file is open.
    """

    facts: ElementFacts
    member: Member | None
    substance: Substance | None
    became: str
    why: str
    mesh: TriangleMesh | None = None

    @property
    def part(self) -> tuple[Member, Substance]:
        """Member and substance of an element that is not left out."""
        return given(self.member), given(self.substance)


@dataclass(frozen=True, slots=True)
class ImportedBridge:
    """A bridge from an IFC file.

    The meshes have the paths of the scenario, relative to its folder. The outcomes are those of all elements of the
    file, in its order. The ground has its height in the file; the sources say where ground and site are from.
    """

    scenario: Scenario
    meshes: dict[str, TriangleMesh]
    outcomes: tuple[Outcome, ...]
    ground_m: float
    ground_source: str
    site_source: str
    notes: tuple[str, ...]


def read_bridge(path: Path, settings: ImportSettings) -> ImportedBridge:
    """Read a bridge from an IFC file."""
    table = material_table(settings.materials)
    with naming_contradictions(path):
        return _bridge(path, table, settings)


def _bridge(path: Path, table: MaterialTable, settings: ImportSettings) -> ImportedBridge:
    source = open_source(path, settings)
    elements = elements_of(source, settings)
    _check_kinds(path, elements)
    members = [element for element in elements if element.is_member and element.kind != "bearing"]
    bearings = [element for element in elements if element.kind == "bearing"]
    made_of = substances(source, members, table, settings)
    repaired, origin = element_solids(source, [*members, *bearings])
    notes = [
        f"{element.facts.name}: {repair}"
        for element, done in zip([*members, *bearings], repaired, strict=True)
        for repair in done.repairs
    ]
    solids = [done.solid for done in repaired]
    ground_m, ground_source = _ground(members, solids, float(origin[2]), settings)
    carrying = [solid for member, solid in zip(members, solids, strict=False) if member.kind in _CARRYING]
    near = placement_of(carrying, ground_m - float(origin[2]))
    solids = [near.placed(solid) for solid in solids]
    placement = replace(near, origin_m=near.origin_m + origin)
    site, site_source = site_of(source, placement)
    outcomes = _members(elements, members, made_of, solids)
    connected, tables = _connected(outcomes, bearings, solids[len(members) :], placement)
    scenario, meshes, held = _scenario(source, settings, connected, tables, site)
    return ImportedBridge(
        scenario=scenario,
        meshes=meshes,
        outcomes=tuple(connected.values()),
        ground_m=ground_m,
        ground_source=ground_source,
        site_source=site_source,
        notes=(*source.notes, *notes, *tables.notes, *held),
    )


def _check_kinds(path: Path, elements: Sequence[Element]) -> None:
    present = sorted({element.member_kind for element in elements if element.is_member})
    for kinds, use in ((_CARRYING, "carries the road"), (_STANDING, "stands on the ground")):
        if set(present).isdisjoint(kinds):
            raise IfcError(
                f"{path}: has no element that {use}, of the kinds {', '.join(kinds)}, but {', '.join(present)}; say "
                f"which are by --kind, as in --kind 'NAME={kinds[0]}'"
            )


def _ground(
    members: Sequence[Element], solids: Sequence[TriangleMesh], origin_m: float, settings: ImportSettings
) -> tuple[float, str]:
    bounds = [solid.bounds for _, solid in zip(members, solids, strict=False)]
    undersides = [float(low[2]) + origin_m for low, _ in bounds]
    lowest = min(undersides)
    if settings.ground_m is None:
        return lowest, f"the underside of {members[undersides.index(lowest)].facts.name}, as --ground is not given"
    highest = max(float(high[2]) + origin_m for _, high in bounds)
    if not settings.ground_m < highest:
        raise IfcError(
            f"the ground at {settings.ground_m:g} m would cover the bridge, which reaches from {lowest:.2f} m to "
            f"{highest:.2f} m in its file"
        )
    return settings.ground_m, "as given by --ground"


def _members(
    elements: Sequence[Element],
    members: Sequence[Element],
    made_of: Sequence[Substance],
    solids: Sequence[TriangleMesh],
) -> dict[int, Outcome]:
    """Return the outcomes of all elements but the bearings, by their numbers in the file."""
    names = _names([member.facts.name for member in members])
    outcomes = {element.entity.id(): _left_out(element, element.why_left_out) for element in elements}
    for element, name, substance, solid in zip(members, names, made_of, solids, strict=False):
        kept = _above_ground(solid)
        number = element.entity.id()
        if kept is None:
            outcomes[number] = _left_out(element, "it lies below the ground")
            continue
        why = "; ".join(note for note in (substance.note, "" if kept is solid else "cut off at the ground") if note)
        member = Member(name, element.member_kind, kept, substance.density_kg_m3)
        outcomes[number] = Outcome(element.facts, member, substance, "member", why)
    return outcomes


def _left_out(element: Element, why: str) -> Outcome:
    return Outcome(element.facts, None, None, "left out", why)


def _above_ground(solid: TriangleMesh) -> TriangleMesh | None:
    """Return the part of a solid above the ground; None where there is no such part."""
    if solid.bounds[0, 2] >= -_BELOW_GROUND_M:
        return solid
    kept = to_manifold(solid).trim_by_plane((0.0, 0.0, 1.0), 0.0)
    if kept.is_empty() or kept.bounding_box()[5] < _BELOW_GROUND_M:
        return None
    return from_manifold(kept)


def _connected(
    outcomes: dict[int, Outcome], bearings: Sequence[Element], solids: Sequence[TriangleMesh], placement: Placement
) -> tuple[dict[int, Outcome], BearingTables]:
    """Return outcomes with those of the bearings, and the tables of these."""
    done, placed = dict(outcomes), []
    parts = [outcome.part for outcome in outcomes.values() if outcome.member]
    contacts, names = NearbyMembers([member.solid for member, _ in parts]), [member.name for member, _ in parts]
    for element, solid in zip(bearings, solids, strict=True):
        bearing = bearing_of(element, solid, contacts, names, placement)
        number = element.entity.id()
        if isinstance(bearing, str):
            done[number] = _left_out(element, bearing)
            continue
        below, substance = parts[bearing.below]
        placed.append(bearing)
        above = " and ".join(names[index] for index in bearing.above)
        why = f"between {above} and {below.name}, of which it is part; {bearing.source}"
        part = Member(below.name, below.kind, solid, below.density_kg_m3)
        done[number] = Outcome(element.facts, part, substance, "connection", why, seated(solid))
    return done, bearing_tables(placed, names)


def _scenario(
    source: IfcSource,
    settings: ImportSettings,
    outcomes: dict[int, Outcome],
    tables: BearingTables,
    site: Site | None,
) -> tuple[Scenario, dict[str, TriangleMesh], list[str]]:
    kept = [outcome for outcome in outcomes.values() if outcome.member]
    of_members = [outcome for outcome in kept if outcome.became == "member"]
    if not of_members:
        raise IfcError(f"{source.path}: nothing of it lies above the ground; put the ground lower by --ground")
    members = [outcome.part[0] for outcome in of_members]
    contacts = NearbyMembers([member.solid for member in members])
    supports, held = supports_of(members, contacts)
    # A member on a bearing touches the bearing, not the member below it.
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
    scenario = Scenario(
        title=_title(source),
        time=TimeSettings(duration_s=_DURATION_S),
        geometry=geometry,
        fracture=FractureSettings(shards=max(settings.shards, len(members))),
        materials=tuple({own.name: own for outcome in kept if (own := outcome.part[1].row.own)}.values()),
        connections=ConnectionSettings(
            type="FIXED", method="face", material=main, between=(*tables.connections, *within)
        ),
        bearings=tables.bearings,
        supports=tuple(supports),
        site=site,
    )
    return scenario, meshes, [*held, *loose]


def _strength_rules(kept: Sequence[Outcome]) -> tuple[str, list[ConnectionBetween]]:
    """Return the strength of most of the bridge by volume, and the connections within members that have another."""
    volumes: dict[str, float] = {}
    parts = [outcome.part for outcome in kept]
    for member, substance in parts:
        strength = substance.row.strength_name
        volumes[strength] = volumes.get(strength, 0.0) + member.volume_m3
    main = max(volumes, key=lambda strength: volumes[strength])
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


def _title(source: IfcSource) -> str:
    for name in ("IfcBridge", "IfcBuilding", "IfcProject"):
        try:
            entities = source.model.by_type(name)
        except RuntimeError:  # a class that the schema does not have
            continue
        if entities and (title := _plain(entities[0].Name or "")):
            return title
    return _plain(source.path.stem) or "Bridge from IFC"


def _names(texts: Sequence[str]) -> list[str]:
    """Return different names, each on one line, and none of them that of a kind or of the ground."""
    taken, names = {*KINDS, GROUND_NAME}, []
    for text in texts:
        plain = _plain(text) or "element"
        choices = chain([plain], (f"{plain} {number}" for number in count(2)))
        names.append(next(name for name in choices if name not in taken))
        taken.add(names[-1])
    return names


def _plain(text: str) -> str:
    """Return a text on one line."""
    return " ".join("".join(" " if category(sign) in LINE_BREAKING_CATEGORIES else sign for sign in text).split())


def _file(number: int, name: str) -> str:
    letters = re.sub(r"[^a-z0-9]+", "_", name.lower()).strip("_")[:40]
    return f"{MESH_FOLDER}/{number:03d}{'_' if letters else ''}{letters}.obj"
