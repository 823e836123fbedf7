"""Steelwork: bars of steel between nodes, as a scenario gives them."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...engineering.mechanics.strength import Joint, Strength
from ...engineering.steelwork.bolted_ends import BoltedEnd, bolted_end
from ...engineering.steelwork.bolts import RUPTURE_M, Bolts, bolts_named
from ...engineering.steelwork.catalogue import section_named
from ...engineering.steelwork.resistance import (
    DENSITY_KG_M3,
    GRADES,
    STEEL_MODULI,
    initial_bow_m,
    plastic_strength,
    strengths_pa,
)
from ...engineering.steelwork.sections import SteelSection
from ...errors import Faults, ScenarioError
from ..schema import SHORTEST_LENGTH_M, SIZE, Table, key, shown
from .bearings import FIXED, PINNED, ROCKER
from .girders import GirderSpan
from .joint_settings import GROUND_NAME
from .trusses import TrussSpan

NODE_KIND = "node"

HINGED = "hinged"

TURNS = {FIXED: (False, False), HINGED: (True, False), PINNED: (True, True)}
"""Whether a bar turns freely about y and z at an end."""

SUPPORTS = (FIXED, PINNED, ROCKER)

_MOST_PIECES = 200


@dataclass(frozen=True, slots=True, kw_only=True)
class SteelNode(Table):
    """A point in which bars end and are joined by plates. It is a member of its own, which supports, removals and all
    else may name, and its body has the plates that bars begin at."""

    table: ClassVar[str] = "steelwork.nodes"

    name: str = key("Name of the node.")
    position_m: tuple[float, float, float] = key("Along the road, across it, above the ground.", unit="m")
    support: str | None = key(
        "Support of the node: `fixed` holds displacements and rotations, `pinned` turns freely about an axis across "
        "the road, `rocker` also moves along it. All hold uplift. None by default.",
        default=None,
        choices=SUPPORTS,
    )
    held_by: str = key(
        "What the support stands on: the name or kind of a member, of which the nearest shard holds it, or `ground`.",
        default=GROUND_NAME,
    )
    mass_kg: float = key(
        "Mass that the node carries beside its bars, such as its share of a deck; it moves with the node.",
        default=0.0,
        unit="kg",
        at_least=0,
    )
    radius_m: float | None = key(
        "How far from the node its bars begin; by default so far that none of them lies in another.",
        default=None,
        **SIZE,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class SteelMember(Table):
    """A bar of steel from one node to another. It is cut across into pieces."""

    table: ClassVar[str] = "steelwork.members"

    name: str = key("Name of the bar.")
    nodes: tuple[str, str] = key("The nodes at its two ends.")
    section: str = key(
        "Name of a rolled section (`IPE 300`, `HEA 200`, `HEB 300`, `HEM 300`), or a shape and its sizes in mm: "
        "`I 900x300x12x25` (height, width, web, flange), `PG 1200x12x400x25x500x40` (height, web, width and thickness "
        "of the top flange, of the bottom flange), `BOX 400x300x10x20`, `RHS 200x100x8`, `SHS 100x5`, `CHS 168.3x8`, "
        "`L 100x100x10`, `U 200x75x8.5x11.5`, `T 200x200x10x15`, `FLAT 100x20`."
    )
    kind: str = key("What kind of member it is, such as `top chord` or `diagonal`.", default="steel bar")
    grade: str | None = key("Grade of its steel; by default that of all.", default=None, choices=GRADES)
    roll_deg: float = key(
        "Turn of the section about the bar. At 0 its y axis is level, so that a web stands upright; of an upright bar "
        "the web lies along the road.",
        default=0.0,
        unit="°",
        at_least=-360,
        at_most=360,
    )
    eccentricities_m: tuple[tuple[float, float, float], ...] | None = key(
        "From each of its nodes to the end of its axis, along the road, across it and upwards: plates of the node join "
        "what does not meet in one point. By default its axis ends in the nodes themselves.",
        default=None,
        unit="m",
    )
    ends: tuple[str, str] = key(
        "How it is joined to each node: `fixed`, `pinned`, which turns freely about both axes of its section, or "
        "`hinged`, which does so about its y axis alone.",
        default=(FIXED, FIXED),
        choices=tuple(TURNS),
    )
    end_strengths: tuple[float, float] = key(
        "Strength of its joint to each node, by bolts, welds or plates, as a part of that of the bar.",
        default=(1.0, 1.0),
        above=0,
        at_most=10,
    )
    end_bolts: tuple[str, str] | None = key(
        "Bolts of its joint to each node, in place of `end_strengths`: number, size and grade, such as `8 M20 8.8`, "
        "then `in 4 lines` along the bar (2 by default) and `in double shear` where they are; or `welded`, as strong "
        "as the bar. Their shear or the section between their holes, whichever resists less, gives the part. With "
        "their pattern in mm, as in `8 M20 8.8 in 2 lines, p1 70, p2 60, e1 40, e2 45, gusset 12 S275`, bearing, block "
        "tearing and the moment of the bolts count too.",
        default=None,
    )
    pieces: int | None = key(
        "Pieces that it is cut into; by default as many as all.", default=None, at_least=1, at_most=_MOST_PIECES
    )
    buckling_lengths: tuple[float, float] = key(
        "Buckling lengths about y and z, by its length between nodes, with which `bda check` judges it.",
        default=(1.0, 1.0),
        above=0,
        at_most=10,
    )
    stiffener_spacing_m: float | None = key(
        "Distance of upright stiffeners of its web, by which `bda check` judges that in shear; without it there are "
        "some at its ends alone.",
        default=None,
        **SIZE,
    )
    rigid_end_posts: bool = key(
        "Whether the ends of its web are held by rigid end posts, as of EN 1993-1-5, 9.3.1.", default=False
    )

    @property
    def steel_section(self) -> SteelSection:
        return section_named(self.section)

    @property
    def from_nodes_m(self) -> np.ndarray:
        """From each of its nodes to the end of its axis, (2, 3)."""
        return np.zeros((2, 3)) if self.eccentricities_m is None else np.array(self.eccentricities_m)

    def _check_together(self) -> None:
        if self.nodes[0] == self.nodes[1]:
            raise self.unexpected("nodes", "two different nodes")
        if self.eccentricities_m is not None and len(self.eccentricities_m) != 2:
            raise self.unexpected("eccentricities_m", "two, one for each node, such as [[0, 0, 0.2], [0, 0, 0]]")
        try:
            section_named(self.section)
        except ScenarioError as error:
            raise ScenarioError(f"{self.table}.section: {error}") from error
        self._check_bolts()

    def _check_bolts(self) -> None:
        if self.end_bolts is None:
            return
        if self.end_strengths != (1.0, 1.0):
            raise ScenarioError(
                f"{self.table} {shown(self.name)}: end_bolts is given together with end_strengths: expected one of the "
                "two"
            )
        for end in range(2):
            try:
                bolts = self.bolts(end)
            except ScenarioError as error:
                raise ScenarioError(f"{self.table} {shown(self.name)}: end_bolts.{end + 1}: {error}") from error
            if bolts is None:
                continue
            if bolts.count == 1 and self.ends[end] == FIXED:
                raise ScenarioError(
                    f"{self.table} {shown(self.name)}: end_bolts.{end + 1} is {shown(self.end_bolts[end])}, one bolt, "
                    f'which the bar turns about: expected "{PINNED}" or "{HINGED}" as ends.{end + 1}'
                )
            if bolts.net_area_m2(self.steel_section) <= 0.0:
                raise ScenarioError(
                    f"{self.table} {shown(self.name)}: end_bolts.{end + 1} is {shown(self.end_bolts[end])}, whose "
                    f"holes leave nothing of {self.section}: expected fewer lines or smaller bolts"
                )

    def bolts(self, end: int) -> Bolts | None:
        """Return the bolts at its first or last end, None without any."""
        return None if self.end_bolts is None else bolts_named(self.end_bolts[end])


@dataclass(frozen=True, slots=True, kw_only=True)
class Steelwork(Table):
    """Bars of steel between nodes: a truss, a frame, bracing. They need elastic connections with method `face`."""

    table: ClassVar[str] = "steelwork"

    grade: str = key("Grade of all bars that have none of their own.", default="S355", choices=GRADES)
    pieces: int = key(
        "Pieces that each bar is cut into that says no other number.", default=4, at_least=1, at_most=_MOST_PIECES
    )
    density_kg_m3: float = key("Density of the steel.", default=DENSITY_KG_M3, unit="kg/m³", above=0)
    bowed: bool = key(
        "Whether bars are built with the bow of EN 1993-1-1, 5.3.2, so that they buckle as their curves say.",
        default=False,
    )
    nodes: tuple[SteelNode, ...] = ()
    members: tuple[SteelMember, ...] = ()
    trusses: tuple[TrussSpan, ...] = ()
    girders: tuple[GirderSpan, ...] = ()

    @property
    def all_nodes(self) -> tuple[SteelNode, ...]:
        """Its own nodes, then its trusses' and girders'."""
        return (*self.nodes, *(SteelNode(**keys) for span in self._spans for keys in span.nodes()))

    @property
    def all_members(self) -> tuple[SteelMember, ...]:
        """Its own bars, then its trusses' and girders'."""
        return (*self.members, *(SteelMember(**keys) for span in self._spans for keys in span.members()))

    @property
    def decks(self) -> tuple[GirderSpan, ...]:
        """Girders that a deck lies on."""
        return tuple(span for span in self.girders if span.has_deck)

    @property
    def _spans(self) -> tuple[TrussSpan | GirderSpan, ...]:
        return (*self.trusses, *self.girders)

    def grade_of(self, member: SteelMember) -> str:
        return member.grade or self.grade

    def pieces_of(self, member: SteelMember) -> int:
        return self.pieces if member.pieces is None else member.pieces

    def yield_and_ultimate_pa(self, member: SteelMember) -> tuple[float, float]:
        return strengths_pa(self.grade_of(member), member.steel_section.thickest_m)

    def end_share(self, member: SteelMember, end: int) -> float:
        """Return the strength of the joint at the first or last end of a bar, as a part of the bar's."""
        bolts, by_pattern = member.bolts(end), self.bolted_end(member, end)
        if bolts is None:
            return member.end_strengths[end]
        section, (yield_pa, ultimate_pa) = member.steel_section, self.yield_and_ultimate_pa(member)
        axial_n = bolts.resistance_n(section, ultimate_pa) if by_pattern is None else by_pattern.axial_n
        return axial_n / (section.area_m2 * yield_pa)

    def bolted_end(self, member: SteelMember, end: int) -> BoltedEnd | None:
        """Return the first or last end of a bar by the pattern of its bolts; None where that is not given."""
        bolts = member.bolts(end)
        return None if bolts is None else bolted_end(bolts, member.steel_section, self.grade_of(member))

    def end_opening_m(self, member: SteelMember, end: int) -> float:
        """Return by how much that joint opens at most until it ruptures: of bolts that are weaker than the bar."""
        is_bolted = member.bolts(end) is not None and self.end_share(member, end) < 1.0
        return RUPTURE_M if is_bolted else math.inf

    def bow_m(self, member: SteelMember, length_m: float) -> np.ndarray:
        """Return how far a bar is bowed in its middle along y and z of its section (2,), if bars are."""
        if not self.bowed:
            return np.zeros(2)
        about_y, about_z = member.buckling_lengths
        yield_pa, _ = self.yield_and_ultimate_pa(member)
        return initial_bow_m(member.steel_section, yield_pa, (about_y * length_m, about_z * length_m))

    def joints(self, strength_factor: float) -> dict[tuple[str, ...], Joint]:
        """Return the joints of connections that are alike, by their `bar_key` or `support_key`."""
        return {
            name: Joint(kind, strength=_times(strength, strength_factor), moduli=STEEL_MODULI)
            for name, (strength, kind) in self._kinds().items()
        }

    def bar_key(self, member: SteelMember, end: int | None = None) -> tuple[str, ...]:
        """Return what the joints of a bar have in common, within it or at one of its ends."""
        share = 1.0 if end is None else self.end_share(member, end)
        joint = self.grade_of(member), member.steel_section.name, repr(share)
        by_pattern = None if end is None else self.bolted_end(member, end)
        return joint if by_pattern is None else (*joint, repr(by_pattern.bolts))

    def support_key(self, node: SteelNode) -> tuple[str, ...]:
        """Return what supports that are alike have in common."""
        return ("support", "FIXED" if node.support == FIXED else "GENERIC")

    def _kinds(self) -> dict[tuple[str, ...], tuple[Strength | None, str]]:
        kinds: dict[tuple[str, ...], tuple[Strength | None, str]] = {}
        for member in self.all_members:
            for end in (None, 0, 1):
                kinds.setdefault(self.bar_key(member, end), (_strength(self, member, end), "FIXED"))
        for node in self.all_nodes:
            if node.support is not None:
                key_of_support = self.support_key(node)
                kinds.setdefault(key_of_support, (None, key_of_support[1]))
        return kinds

    def _check_together(self) -> None:
        faults = Faults()
        for check in (self._check_names, self._check_ends, self._check_lengths):
            with faults.noted():
                check()
        faults.check()

    def _check_names(self) -> None:
        if not self.members and not self._spans:
            raise ScenarioError(
                "steelwork.members is missing: expected bars under [[steelwork.members]], [[steelwork.trusses]] or "
                "[[steelwork.girders]]"
            )
        names = [*(member.name for member in self.all_members), *(node.name for node in self.all_nodes)]
        names += [span.deck_name for span in self.decks]
        if twice := _first_twice(names):
            raise ScenarioError(f"steelwork has {shown(twice)} twice: expected a name of its own for each bar and node")

    def _check_ends(self) -> None:
        known = {node.name for node in self.all_nodes}
        for member in self.all_members:
            for name in member.nodes:
                if name not in known:
                    raise ScenarioError(
                        f"steelwork.members {shown(member.name)}: nodes has {shown(name)}: expected the name of one of "
                        "[[steelwork.nodes]]"
                    )
        for member in self.members:
            _check_patterns(member, self)
        used = {name for member in self.all_members for name in member.nodes}
        if unused := [node.name for node in self.all_nodes if node.name not in used]:
            raise ScenarioError(f"steelwork.nodes {shown(unused[0])}: expected a bar that ends in it")

    def _check_lengths(self) -> None:
        places = {node.name: np.array(node.position_m) for node in self.all_nodes}
        for member in self.all_members:
            if not set(member.nodes) <= places.keys():
                continue
            first, second = axis_m(member, places)
            if not np.abs(second - first).max() > SHORTEST_LENGTH_M:
                raise ScenarioError(
                    f"steelwork.members {shown(member.name)}: expected nodes that are more than {SHORTEST_LENGTH_M} m "
                    "apart"
                )


def axis_m(member: SteelMember, places: Mapping[str, np.ndarray]) -> np.ndarray:
    """Return the ends (2, 3) of the axis of a bar between nodes at places (3,)."""
    return np.array([places[name] for name in member.nodes]) + member.from_nodes_m


def bending_to_axial_ratio_of(steelwork: Steelwork, member: SteelMember, end: int | None) -> tuple[float, float]:
    """Return a joint's share of its bar's resistance in bending about y and z over its share in axial force.

    The joint is that at its first or last end, or one within it.
    """
    by_pattern = None if end is None else steelwork.bolted_end(member, end)
    if by_pattern is None or end is None:
        return 1.0, 1.0
    yield_pa, _ = steelwork.yield_and_ultimate_pa(member)
    return by_pattern.bending_to_axial_ratio(yield_pa, steelwork.end_share(member, end))


def _strength(steelwork: Steelwork, member: SteelMember, end: int | None) -> Strength:
    yield_pa, _ = steelwork.yield_and_ultimate_pa(member)
    share = 1.0 if end is None else steelwork.end_share(member, end)
    by_pattern = None if end is None else steelwork.bolted_end(member, end)
    if by_pattern is not None:
        return by_pattern.strength(yield_pa, share)
    return plastic_strength(member.steel_section, yield_pa).times(share)


def _check_patterns(member: SteelMember, steelwork: Steelwork) -> None:
    for end in range(2):
        try:
            steelwork.bolted_end(member, end)
        except ScenarioError as error:
            raise ScenarioError(f"steelwork.members {shown(member.name)}: end_bolts.{end + 1}: {error}") from error


def _first_twice(names: Iterable[str]) -> str | None:
    seen: set[str] = set()
    for name in names:
        if name in seen:
            return name
        seen.add(name)
    return None


def _times(strength: Strength | None, factor: float) -> Strength | None:
    return strength.times(factor) if strength is not None else None
