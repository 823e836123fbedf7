"""Girder bridges of steel by sizes: girders side by side over one or more spans, cross frames, and a deck on studs."""

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import accumulate, pairwise
from typing import Any, ClassVar

import numpy as np

from ...engineering.elasticity.section_stiffness import ElasticModuli
from ...engineering.mechanics.strength import Joint, Strength
from ...engineering.steelwork.catalogue import section_named
from ...engineering.steelwork.resistance import GRADES
from ...engineering.steelwork.sections import SteelSection
from ...engineering.steelwork.studs import (
    FRICTION_OF_STEEL,
    LARGEST_M,
    LEAST_HEIGHT,
    SLIP_CAPACITY_M,
    SMALLEST_M,
    STUD_STIFFNESS_N_M,
    STUD_ULTIMATE_PA,
    stud_shear_n,
    stud_uplift_n,
)
from ...errors import ScenarioError
from ..schema import ROUNDING, SIZE, Table, given, key
from .bearings import PINNED, ROCKER
from .joint_settings import GROUND_NAME

GIRDER_KIND, DECK_KIND = "girder", "deck"

MOST_GIRDERS, _MOST_FIELDS = 40, 60

_MM, _NEWTON_PER_SQUARE_MILLIMETRE = 1e-3, 1e6

_SHAPES = ("IPE", "HEA", "HEB", "HEM", "I", "PG", "BOX")

_EVEN_TORSION = 1.84
"""Torsion that a square field of studs resists as all of them yield, by that at which the first ones would: ∫ r dA =
0.3826 a³, and a³ / 4.8."""

_BY_EDGE = 3.0
"""Moment that studs resist in uplift about the pressed edge of a flange, n P b / 2, by that of an elastic section."""

_OF_DECK = (
    "deck_width_m",
    "studs_per_m",
    "stud_strength_n",
    "stud_diameter_mm",
    "stud_uplift_n",
)
"""Keys that only a deck has, and that are left out by default."""

_OF_STUDS = ("stud_strength_n", "stud_diameter_mm", "stud_uplift_n")


@dataclass(frozen=True, slots=True)
class StudRow:
    """Studs along a girder: how many by length, and what one of them resists."""

    per_m: float
    shear_n: float
    uplift_n: float
    stiffness_n_m: float  # shear force by slip
    slip_m: float  # at which it fails


@dataclass(frozen=True, slots=True)
class _Station:
    """A node of each girder along the road."""

    along_m: float  # from the first end
    has_frame: bool
    support: int | None  # number of the support below it, from 0


@dataclass(frozen=True, slots=True, kw_only=True)
class GirderSpan(Table):
    """Girders of steel side by side, along the road, over one span or continuous over several. Their bars and nodes are
    those that `[[steelwork.members]]` and `[[steelwork.nodes]]` would give, with fixed joints: nodes of girders 1, 2 …,
    counted from the left, with numbers along the road from 0, as `span G1 0`, at cross frames and where the section
    changes, and bars by the nodes at their ends, as `span G1 0-1`. A deck of concrete lies on the top flanges, `span
    deck`. It is cut across where the pieces of girders below it end, in so many parts at least, and these along the
    road."""

    table: ClassVar[str] = "steelwork.girders"

    name: str = key("Name with which all names in it begin.", default="span")
    position_m: tuple[float, float, float] = key(
        "Position of the first end: in the middle between the girders, at the top of their flanges.", unit="m"
    )
    span_lengths_m: tuple[float, ...] = key("Length of each span, between the axes of supports.", **SIZE)
    girders: int = key("Number of girders.", at_least=1, at_most=MOST_GIRDERS)
    spacing_m: float | None = key("Distance of girders; needed with more than one.", default=None, **SIZE)
    section: str = key(
        "Section of the girders, with flanges: `PG`, `I`, `IPE`, `HEA`, `HEB`, `HEM` or `BOX`, as of "
        "`[[steelwork.members]]`."
    )
    pier_section: str | None = key(
        "Section over inner supports, with its top flange at the same height; by default as elsewhere.", default=None
    )
    pier_length_m: float | None = key(
        "Length of that over each inner support, half of it on either side; needed with `pier_section`.",
        default=None,
        **SIZE,
    )
    grade: str | None = key("Grade of their steel; by default that of all.", default=None, choices=GRADES)
    fields: tuple[int, ...] = key(
        "Fields between cross frames in each span; one number for all spans alike.",
        at_least=1,
        at_most=_MOST_FIELDS,
    )
    cross_frames: str | None = key(
        "Section of the beams across the road between girders, at the ends of fields; needed with more than one "
        "girder.",
        default=None,
    )
    bracing: str | None = key(
        "Section of diagonals between girders, in each field, level in the axes of the girders; none by default.",
        default=None,
    )
    pieces: int | None = key(
        "Pieces of a girder in each field; by default as many as all bars.", default=None, at_least=1, at_most=200
    )
    supports: tuple[str, ...] | None = key(
        "What each support stands on, as `steelwork.nodes.held_by`; the ground by default.", default=None
    )
    pinned_at: int = key(
        "Which support is pinned, counted from the first end; the others move along the road.",
        default=1,
        at_least=1,
        at_most=1000,
    )
    is_supported: bool = key("Whether it stands on supports; else give bars that hold its nodes.", default=True)
    deck_thickness_m: float | None = key(
        "Thickness of the deck of concrete; without it there is none.", default=None, **SIZE
    )
    deck_width_m: float | None = key("Width of the deck; needed with it.", default=None, **SIZE)
    deck_density_kg_m3: float = key("Density of the deck, with its bars.", default=2500.0, unit="kg/m³", above=0)
    studs_per_m: float | None = key(
        "Studs by length of each girder; needed with a deck. With 0 it lies on the girders by friction alone.",
        default=None,
        unit="1/m",
        at_least=0,
        at_most=1000,
    )
    stud_strength_n: float | None = key(
        "Shear force that a stud resists. Give this or `stud_diameter_mm`.", default=None, unit="N", above=0
    )
    stud_diameter_mm: float | None = key(
        "Diameter of headed studs, whose shear strength is that of EN 1994-1-1, 6.6.3.1, without partial factors, with "
        "the concrete of the deck.",
        default=None,
        unit="mm",
        at_least=SMALLEST_M / _MM,
        at_most=LARGEST_M / _MM,
    )
    stud_height_mm: float = key("Height of headed studs.", default=125.0, unit="mm", above=0, at_most=1000)
    stud_ultimate_n_mm2: float = key(
        "Ultimate strength of their steel.",
        default=STUD_ULTIMATE_PA / _NEWTON_PER_SQUARE_MILLIMETRE,
        unit="N/mm²",
        above=0,
        at_most=1000,
    )
    stud_uplift_n: float | None = key(
        "Uplift that a stud resists. By default, with a diameter, the lesser of its shank and of a cone of concrete by "
        "EN 1992-4, 7.2.1.4; needed with `stud_strength_n`.",
        default=None,
        unit="N",
        above=0,
    )
    stud_stiffness_n_m: float = key(
        "Shear force of a stud by its slip; by default that of 19 mm in EN 1994-1-1, A.3 (4).",
        default=STUD_STIFFNESS_N_M,
        unit="N/m",
        above=0,
    )
    stud_slip_mm: float = key(
        "Slip at which a stud fails; until then it yields. By default that of ductile ones, EN 1994-1-1, 6.6.1.1 (5).",
        default=SLIP_CAPACITY_M / _MM,
        unit="mm",
        above=0,
        at_most=100,
    )
    deck_friction: float = key(
        "Friction of a deck without studs on the girders; by default that of EN 1994-1-1, 6.7.4.2 (4).",
        default=FRICTION_OF_STEEL,
        at_least=0,
        at_most=10,
    )
    stiffener_spacing_m: float | None = key(
        "Distance of upright stiffeners of the webs, by which `bda check` judges these in shear; without it there are "
        "some at the ends of each bar alone.",
        default=None,
        **SIZE,
    )
    rigid_end_posts: bool = key(
        "Whether the ends of webs are held by rigid end posts, as of EN 1993-1-5, 9.3.1.", default=False
    )

    @property
    def deck_name(self) -> str:
        return f"{self.name} deck"

    @property
    def has_deck(self) -> bool:
        return self.deck_thickness_m is not None

    @property
    def length_m(self) -> float:
        return math.fsum(self.span_lengths_m)

    @property
    def sections(self) -> tuple[SteelSection, SteelSection]:
        """Return the section of the girders, and that over inner supports."""
        own = section_named(self.section)
        return own, section_named(self.pier_section) if self.pier_section else own

    @property
    def girder_names(self) -> tuple[str, ...]:
        return tuple(f"{self.name} G{number}" for number in range(1, self.girders + 1))

    def nodes(self) -> Iterator[dict[str, Any]]:
        """Yield the keys of its nodes."""
        begin, middle, top = self.position_m
        height = top - top_of(self.sections[0])
        supports = self.supports or (GROUND_NAME,) * (len(self.span_lengths_m) + 1)
        for girder, across in zip(self.girder_names, self._across_m, strict=True):
            for number, station in enumerate(self._stations):
                is_held = self.is_supported and station.support is not None
                pinned = station.support == self.pinned_at - 1
                yield {
                    "name": f"{girder} {number}",
                    "position_m": (begin + station.along_m, middle + across, height),
                    "support": (PINNED if pinned else ROCKER) if is_held else None,
                    "held_by": GROUND_NAME if station.support is None else supports[station.support],
                }

    def members(self) -> Iterator[dict[str, Any]]:
        """Yield the keys of its bars."""
        for girder in self.girder_names:
            yield from self.bars_of(girder)
        for one, other in pairwise(range(1, self.girders + 1)):
            yield from self._between(one, other)

    def bars_of(self, girder: str) -> Iterator[dict[str, Any]]:
        """Yield the keys of the bars of one of its girders, from the first end on."""
        for number, (begin, end) in enumerate(pairwise(self._stations)):
            yield self._girder(girder, number, 0.5 * (begin.along_m + end.along_m))

    @property
    def end_nodes(self) -> tuple[str, ...]:
        """Return the names of the nodes at both ends of each girder."""
        return tuple(f"{girder} {number}" for girder in self.girder_names for number in (0, len(self._stations) - 1))

    def points_of(self) -> Iterator[tuple[str, ...]]:
        """Yield the names of the girders' nodes at each position along the road."""
        for number in range(len(self._stations)):
            yield tuple(f"{girder} {number}" for girder in self.girder_names)

    def studs(self, concrete_pa: float, moduli: ElasticModuli) -> StudRow | None:
        """Return its studs in a concrete with a strength and moduli; None where the deck lies on friction alone."""
        if not self.studs_per_m:
            return None
        shear_n, uplift_n = self.stud_strength_n, self.stud_uplift_n
        if self.stud_diameter_mm is not None:
            diameter, height = _MM * self.stud_diameter_mm, _MM * self.stud_height_mm
            ultimate = _NEWTON_PER_SQUARE_MILLIMETRE * self.stud_ultimate_n_mm2
            shear_n = stud_shear_n(diameter, height, ultimate, concrete_pa, moduli.young_pa)
            if uplift_n is None:
                uplift_n = stud_uplift_n(diameter, height, ultimate, concrete_pa, 1.0 / self.studs_per_m)
        return StudRow(
            self.studs_per_m, given(shear_n), given(uplift_n), self.stud_stiffness_n_m, _MM * self.stud_slip_mm
        )

    @property
    def _across_m(self) -> tuple[float, ...]:
        """Positions of girders from the middle, the left one first."""
        spacing = self.spacing_m or 0.0
        return tuple(spacing * (0.5 * (self.girders - 1) - number) for number in range(self.girders))

    @property
    def _supports_m(self) -> tuple[float, ...]:
        return tuple(accumulate(self.span_lengths_m, initial=0.0))

    @property
    def _stations(self) -> tuple[_Station, ...]:
        counts = self.fields * len(self.span_lengths_m) if len(self.fields) == 1 else self.fields
        stations = [_Station(0.0, True, 0)]
        columns = zip(pairwise(self._supports_m), counts, strict=True)
        for support, ((begin, end), count) in enumerate(columns, start=1):
            inner = [begin + (end - begin) * number / count for number in range(1, count)]
            stations += [*(_Station(along, True, None) for along in inner), _Station(end, True, support)]
        taken = [station.along_m for station in stations]
        slack = ROUNDING * self.length_m
        changes = [along for along in self._changes_m if min(abs(along - other) for other in taken) > slack]
        stations += [_Station(along, False, None) for along in changes]
        return tuple(sorted(stations, key=lambda station: station.along_m))

    @property
    def _changes_m(self) -> list[float]:
        """Where the section changes."""
        if self.pier_length_m is None:
            return []
        half = 0.5 * self.pier_length_m
        return [support + side * half for support in self._supports_m[1:-1] for side in (-1.0, 1.0)]

    def _girder(self, girder: str, number: int, middle_m: float) -> dict[str, Any]:
        own, over_pier = self.sections
        half = 0.5 * (self.pier_length_m or 0.0)
        is_over = any(abs(middle_m - support) < half for support in self._supports_m[1:-1])
        return {
            "name": f"{girder} {number}-{number + 1}",
            "kind": GIRDER_KIND,
            "nodes": (f"{girder} {number}", f"{girder} {number + 1}"),
            "section": self.pier_section if is_over else self.section,
            "grade": self.grade,
            "pieces": self.pieces,
            "eccentricities_m": ((0.0, 0.0, top_of(own) - top_of(over_pier)),) * 2 if is_over else None,
            "stiffener_spacing_m": self.stiffener_spacing_m,
            "rigid_end_posts": self.rigid_end_posts,
        }

    def _between(self, one: int, other: int) -> Iterator[dict[str, Any]]:
        """Yield cross frames and bracing between two girders."""
        pair = f"G{one}-G{other}"
        framed = [number for number, station in enumerate(self._stations) if station.has_frame]
        for number in framed:
            yield {
                "name": f"{self.name} {number} {pair}",
                "kind": "cross frame",
                "nodes": (f"{self.name} G{one} {number}", f"{self.name} G{other} {number}"),
                "section": self.cross_frames,
            }
        if self.bracing is None:
            return
        for row, (begin, end) in enumerate(pairwise(framed)):
            left, right = (one, other) if row % 2 else (other, one)
            yield {
                "name": f"{self.name} {begin}-{end} {pair}",
                "kind": "bracing",
                "nodes": (f"{self.name} G{left} {begin}", f"{self.name} G{right} {end}"),
                "section": self.bracing,
            }

    def _check_together(self) -> None:
        self._check_sections()
        spans = len(self.span_lengths_m)
        if not spans:
            raise self.unexpected("span_lengths_m", "the length of one span or more")
        if len(self.fields) not in (1, spans):
            raise self.unexpected("fields", f"one number, or {spans}, as there are spans")
        if self.pinned_at > spans + 1:
            raise self.unexpected("pinned_at", f"at most {spans + 1}, as there are supports")
        if self.supports is not None and len(self.supports) != spans + 1:
            raise self.unexpected("supports", f"{spans + 1} names, one for each support")
        if (self.pier_section is None) != (self.pier_length_m is None):
            missing, other = ("pier_length_m", "pier_section")[:: 1 if self.pier_section else -1]
            raise ScenarioError(f"{self.table}.{missing} is missing: expected it with {self.table}.{other}")
        if self.pier_length_m is not None and not self.pier_length_m < min(self.span_lengths_m):
            raise self.unexpected("pier_length_m", f"less than the shortest span, {min(self.span_lengths_m):g} (m)")
        least_m = max(float(section.size_m[1]) for section in self.sections)
        shortest_m = min(end.along_m - begin.along_m for begin, end in pairwise(self._stations))
        if shortest_m < least_m:
            wanted = f"cross frames and changes of section {least_m:g} m apart, as deep as girders are, or more"
            raise self.unexpected("fields", f"{wanted}; some are {shortest_m:.4g} m apart")
        for name in ("spacing_m", "cross_frames"):
            if self.girders > 1 and getattr(self, name) is None:
                raise ScenarioError(f"{self.table}.{name} is missing: expected it with {self.girders} girders")
        self._check_deck()

    def _check_sections(self) -> None:
        for name in ("section", "pier_section", "cross_frames", "bracing"):
            if (text := getattr(self, name)) is None:
                continue
            try:
                section = section_named(text)
            except ScenarioError as error:
                raise ScenarioError(f"{self.table}.{name}: {error}") from error
            shape = re.match("[A-Z]*", section.name.upper())
            if name in ("section", "pier_section") and given(shape)[0] not in _SHAPES:
                raise self.unexpected(name, "a section with flanges: PG, I, IPE, HEA, HEB, HEM or BOX")

    def _check_deck(self) -> None:
        if self.deck_thickness_m is None:
            for name in _OF_DECK:
                if getattr(self, name) is not None:
                    raise self.unexpected(name, f"none without {self.table}.deck_thickness_m")
            return
        for name in ("deck_width_m", "studs_per_m"):
            if getattr(self, name) is None:
                raise ScenarioError(f"{self.table}.{name} is missing: expected it with a deck")
        if not self.studs_per_m:
            for name in _OF_STUDS:
                if getattr(self, name) is not None:
                    raise self.unexpected(name, f"none where {self.table}.studs_per_m is 0")
            return
        if (self.stud_strength_n is None) == (self.stud_diameter_mm is None):
            raise ScenarioError(
                f"{self.table}: expected one of stud_strength_n and stud_diameter_mm with studs_per_m, and not both"
            )
        if self.stud_strength_n is not None and self.stud_uplift_n is None:
            raise ScenarioError(f"{self.table}.stud_uplift_n is missing: expected it with stud_strength_n")
        if self.stud_diameter_mm is not None and self.stud_height_mm < LEAST_HEIGHT * self.stud_diameter_mm:
            least = LEAST_HEIGHT * self.stud_diameter_mm
            raise self.unexpected("stud_height_mm", f"at least {least:g}, {LEAST_HEIGHT:g} times the diameter (mm)")


def joints_of_deck(span: GirderSpan, concrete: Joint, factor: float) -> tuple[Joint, Joint]:
    """Return the joints of a deck with its girders, and with their section over inner supports.

    `concrete` is the joint within the deck, and `factor` is on all strengths. Studs resist shear and uplift by the area
    of the flange, and concrete what is pressed. A deck without studs has no strength there.
    """
    strength, moduli = given(concrete.strength), given(concrete.moduli)
    studs = span.studs(float(strength.compression_pa) / factor, moduli)
    if studs is None:
        loose = Joint("GENERIC", moduli=moduli)
        return loose, loose
    at_yield_mm = factor * studs.shear_n / studs.stiffness_n_m / _MM
    if at_yield_mm >= span.stud_slip_mm:
        raise span.unexpected("stud_slip_mm", f"more than {at_yield_mm:.3g} (mm), at which studs yield")
    joints = []
    for section in span.sections:
        by_area = factor * studs.per_m / top_width_m(section)
        shear_pa, uplift_pa = by_area * studs.shear_n, by_area * studs.uplift_n
        resisted = Strength(
            compression_pa=strength.compression_pa,
            tension_pa=uplift_pa,
            shear_pa=shear_pa,
            torsion_pa=_EVEN_TORSION * shear_pa,
            bending_pa=_BY_EDGE * uplift_pa,
        )
        joints.append(Joint("FIXED", strength=resisted, moduli=moduli))
    return joints[0], joints[1]


def top_of(section: SteelSection) -> float:
    """Return the height of the top of a section above its centre, m."""
    return float(np.concatenate(section.rings)[:, 1].max())


def top_width_m(section: SteelSection) -> float:
    """Return the width of the top of a section."""
    points = np.concatenate(section.rings)
    top = points[points[:, 1] > top_of(section) - ROUNDING, 0]
    return float(np.ptp(top))
