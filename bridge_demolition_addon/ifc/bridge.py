"""A bridge from an IFC file: members in their places, what connects and holds them, and the scenario they make."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import groupby
from pathlib import Path
from unicodedata import category

from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.solids import from_manifold, to_manifold
from ..errors import IfcError
from ..model.bridge.member import Member
from ..model.materials.materials import Material
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
from .bearings import Bearing, bearing_of, bearing_rules, seated
from .contacts import NearbyMembers
from .element_materials import Substance, substances
from .elements import Element, elements_of
from .kinds import LeftOut
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
    """What became of an element.

    Attributes
    ----------
    element : Element
        The element.
    member : Member or None
        The member that it is, in its place; None for one that is none.
    substance : Substance or None
        What the member is made of.
    became : str
        ``member``, ``connection`` or ``left out``.
    why : str
        Why, or what else there is to know of it; empty for nothing.
    mesh : TriangleMesh or None
        What is written of it, where that is not the member's solid.
    """

    element: Element
    member: Member | None
    substance: Substance | None
    became: str
    why: str
    mesh: TriangleMesh | None = None

    @property
    def part(self) -> tuple[Member, Substance]:
        """The member and what it is made of, of an element that is not left out."""
        return given(self.member), given(self.substance)


@dataclass(frozen=True, slots=True)
class ImportedBridge:
    """A bridge from an IFC file.

    Attributes
    ----------
    scenario : Scenario
        Its paths of meshes are from its own folder.
    meshes : dict of str to TriangleMesh
        By these paths.
    outcomes : tuple of Outcome
        Of all elements of the file, in its order.
    ground_m : float
        Height of the ground in the file.
    ground_source, site_source : str
        Where ground and site are from.
    notes : tuple of str
        What was put right or taken for granted.
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
        f"{each.facts.name}: {repair}"
        for each, done in zip([*members, *bearings], repaired, strict=True)
        for repair in done.repairs
    ]
    solids = [each.solid for each in repaired]
    ground_m, ground_source = _ground(members, solids, float(origin[2]), settings)
    near = placement_of(
        [solid for each, solid in zip(members, solids, strict=False) if each.kind in _CARRYING],
        ground_m - float(origin[2]),
    )
    solids = [near.placed(each) for each in solids]
    placement = replace(near, origin_m=near.origin_m + origin)
    site, site_source = site_of(source, placement)
    outcomes = _members(elements, members, made_of, solids)
    connected, rules, disagreements = _connected(outcomes, bearings, solids[len(members) :], placement)
    scenario, meshes, held = _scenario(source, settings, connected, rules, site)
    return ImportedBridge(
        scenario=scenario,
        meshes=meshes,
        outcomes=tuple(connected.values()),
        ground_m=ground_m,
        ground_source=ground_source,
        site_source=site_source,
        notes=(*source.notes, *notes, *disagreements, *held),
    )


def _check_kinds(path: Path, elements: Sequence[Element]) -> None:
    found = sorted({element.member_kind for element in elements if element.is_member})
    for wanted, what in ((_CARRYING, "carries the road"), (_STANDING, "stands on the ground")):
        if not set(found) & set(wanted):
            raise IfcError(
                f"{path}: has no element that {what}, of the kinds {', '.join(wanted)}, but {', '.join(found)}; say "
                f"which are by --kind, as in --kind 'NAME={wanted[0]}'"
            )


def _ground(
    members: Sequence[Element], solids: Sequence[TriangleMesh], origin_m: float, settings: ImportSettings
) -> tuple[float, str]:
    undersides = [float(solid.bounds[0, 2]) + origin_m for _, solid in zip(members, solids, strict=False)]
    lowest = min(undersides)
    if settings.ground_m is None:
        return lowest, f"the underside of {members[undersides.index(lowest)].facts.name}, as none is told by --ground"
    highest = max(float(solid.bounds[1, 2]) + origin_m for _, solid in zip(members, solids, strict=False))
    if not settings.ground_m < highest:
        raise IfcError(
            f"the ground at {settings.ground_m:g} m would cover the bridge, which reaches from {lowest:.2f} m to "
            f"{highest:.2f} m in its file"
        )
    return settings.ground_m, "as told"


def _members(
    elements: Sequence[Element],
    members: Sequence[Element],
    made_of: Sequence[Substance],
    solids: Sequence[TriangleMesh],
) -> dict[int, Outcome]:
    """Return what becomes of all elements but the bearings, by their numbers in the file."""
    names = _names([each.facts.name for each in members])
    found = {
        each.entity.id(): Outcome(each, None, None, "left out", each.kind.why if isinstance(each.kind, LeftOut) else "")
        for each in elements
    }
    for element, name, substance, solid in zip(members, names, made_of, solids, strict=False):
        kept = _above_ground(solid)
        number = element.entity.id()
        if kept is None:
            found[number] = Outcome(element, None, None, "left out", "it lies below the ground")
            continue
        why = "; ".join(each for each in (substance.note, "" if kept is solid else "cut off at the ground") if each)
        member = Member(name, element.member_kind, kept, substance.density_kg_m3)
        found[number] = Outcome(element, member, substance, "member", why)
    return found


def _above_ground(solid: TriangleMesh) -> TriangleMesh | None:
    """Return what of a solid lies above the ground; None for nothing."""
    if solid.bounds[0, 2] >= -_BELOW_GROUND_M:
        return solid
    kept = to_manifold(solid).trim_by_plane((0.0, 0.0, 1.0), 0.0)
    if kept.is_empty() or kept.bounding_box()[5] < _BELOW_GROUND_M:
        return None
    return from_manifold(kept)


def _connected(
    outcomes: dict[int, Outcome], bearings: Sequence[Element], solids: Sequence[TriangleMesh], placement: Placement
) -> tuple[dict[int, Outcome], list[ConnectionBetween], list[str]]:
    """Return outcomes with those of the bearings, the connections that these are, and what they disagree in."""
    done, found = dict(outcomes), []
    parts = [outcome.part for outcome in outcomes.values() if outcome.member]
    contacts, names = NearbyMembers([member.solid for member, _ in parts]), [member.name for member, _ in parts]
    for element, solid in zip(bearings, solids, strict=True):
        bearing = bearing_of(element, solid, contacts, names, placement)
        number = element.entity.id()
        if isinstance(bearing, str):
            done[number] = Outcome(element, None, None, "left out", bearing)
            continue
        below, substance = parts[bearing.below]
        found.append(bearing)
        part = Member(below.name, below.kind, solid, below.density_kg_m3)
        done[number] = Outcome(element, part, substance, "connection", _why(bearing, names), seated(solid))
    rules, notes = bearing_rules(found, names)
    return done, rules, notes


def _why(bearing: Bearing, names: Sequence[str]) -> str:
    above = " and ".join(names[each] for each in bearing.above)
    return f"between {above} and {names[bearing.below]}, of which it is part; {bearing.source}"


def _scenario(
    source: IfcSource,
    settings: ImportSettings,
    outcomes: dict[int, Outcome],
    rules: Sequence[ConnectionBetween],
    site: Site | None,
) -> tuple[Scenario, dict[str, TriangleMesh], list[str]]:
    kept = [outcome for outcome in outcomes.values() if outcome.member]
    if not any(each.became == "member" for each in kept):
        raise IfcError(f"{source.path}: nothing of it lies above the ground; put the ground lower by --ground")
    members = [each.part[0] for each in kept if each.became == "member"]
    contacts = NearbyMembers([member.solid for member in members])
    supports, held = supports_of(members, contacts)
    # A member that rests on a bearing touches that, not what the bearing lies on.
    connected = {support.member for support in supports} | {name for rule in rules for name in rule.members}
    loose = loose_members(members, contacts, connected)
    parts = [each.part[0] for each in kept]
    meshes = {
        _file(number, part.name): each.mesh or part.solid
        for number, (each, part) in enumerate(zip(kept, parts, strict=True), start=1)
    }
    geometry = tuple(
        Geometry(name=part.name, file=file, kind=part.kind, density_kg_m3=part.density_kg_m3)
        for part, file in zip(parts, meshes, strict=True)
    )
    main, within = _strength_rules([each for each in kept if each.became == "member"])
    scenario = Scenario(
        title=_title(source),
        time=TimeSettings(duration_s=_DURATION_S),
        geometry=geometry,
        fracture=FractureSettings(shards=max(settings.shards, len(members))),
        materials=_own_materials(kept),
        connections=ConnectionSettings(type="FIXED", method="face", material=main, between=(*rules, *within)),
        supports=tuple(supports),
        site=site,
    )
    return scenario, meshes, [*held, *loose]


def _strength_rules(kept: Sequence[Outcome]) -> tuple[str, list[ConnectionBetween]]:
    """Return the strength of most of the bridge by volume, and the connections within members that have another."""
    volumes: dict[str, float] = {}
    parts = [each.part for each in kept]
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


def _own_materials(kept: Sequence[Outcome]) -> tuple[Material, ...]:
    own = {material.name: material for each in kept if (material := each.part[1].row.own)}
    return tuple(own.values())


def _title(source: IfcSource) -> str:
    for name in ("IfcBridge", "IfcBuilding", "IfcProject"):
        try:
            found = source.model.by_type(name)
        except RuntimeError:  # a class that the schema does not have
            continue
        if found and (title := _plain(found[0].Name or "")):
            return title
    return _plain(source.path.stem) or "Bridge from IFC"


def _names(given: Sequence[str]) -> list[str]:
    """Return names on one line of which no two are the same, and none is that of a kind or of the ground."""
    taken, found = {*KINDS, GROUND_NAME}, []
    for each in given:
        plain = _plain(each) or "element"
        name, number = plain, 1
        while name in taken:
            number += 1
            name = f"{plain} {number}"
        taken.add(name)
        found.append(name)
    return found


def _plain(text: str) -> str:
    """Return a text on one line."""
    return " ".join("".join(" " if category(each) in LINE_BREAKING_CATEGORIES else each for each in text).split())


def _file(number: int, name: str) -> str:
    letters = re.sub(r"[^a-z0-9]+", "_", name.lower()).strip("_")[:40]
    return f"{MESH_FOLDER}/{number:03d}{'_' if letters else ''}{letters}.obj"
