"""Steel sections: rolled ones by sizes and root radius, and plates made to an I, a box, a tube, an angle and more.

y is level and z upright in a section that stands as drawings show it, so that bending about y is about the strong axis
of an I-section. Torsion is Saint-Venant's; warping, and the distance of the shear centre from the middle of open
sections, are left out. Angles, channels and T-sections bend about their own y and z, not about principal axes, in what
is said of their moments.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...errors import ScenarioError
from ..arithmetic import cosine, sine
from ..arrays import FloatArray
from .outlines import PlaneShape, about_centre, plane_shape, rectangle, rounded

_TUBE_SIDES = 24

_ROLLED_NARROW = 1.2
"""Height by width of rolled I-sections above which their curves are those of beams: EN 1993-1-1:2005, table 6.2."""

_THIN_FLANGE_M = 0.04
"""Thickness of flanges up to which rolled and welded I-sections have the better curves (ibid.)."""


@dataclass(frozen=True, slots=True)
class Web:
    """Upright webs between two flanges."""

    count: int
    height_m: float  # clear, between the flanges
    thickness_m: float


FLAT_BAR, WEB, LEG, STEM = "flat bar", "web", "leg", "stem"
"""What of a section lies on a gusset."""


@dataclass(frozen=True, slots=True)
class FlatPart:
    """The part of a section that lies on a gusset."""

    kind: str  # one of the above
    width_m: float
    thickness_m: float
    along: int = 1  # which of y and z (0, 1) it is wide along


@dataclass(frozen=True, eq=False)
class SteelSection:
    """A section of a steel bar.

    Attributes
    ----------
    name : str
        As a scenario gives it.
    rings : tuple of (k, 2) float
        Outline in m along y and z, about the centre: see `outlines`.
    torsion_m4 : float
        Torsion constant of Saint-Venant.
    shear_areas_m2 : (2,) float
        Areas that deform evenly by shear along y and z.
    plastic_shear_areas_m2 : (2,) float
        Areas that yield by shear along y and z: EN 1993-1-1:2005, 6.2.6 (3).
    torsion_modulus_m3 : float
        Torsion by the shear stress at which all of it yields: Σ b t² / 2 of open plates, 2 A t of tubes (Bredt).
    thickest_m : float
        Its thickest part, by which the yield strength goes.
    buckling_curves : tuple of str
        Curves about y and z, up to S420: EN 1993-1-1:2005, table 6.2.
    flanges_apart_m : float or None
        Distance between the middles of two flanges that are alike; None for other sections.
    is_rolled : bool
        Whether it is of a rolled I-section.
    web : Web or None
        Its webs; None of sections without one between two flanges.
    flat : FlatPart or None
        What lies on a gusset, of sections without such webs.
    """

    name: str
    rings: tuple[FloatArray, ...]
    torsion_m4: float
    shear_areas_m2: FloatArray
    plastic_shear_areas_m2: FloatArray
    torsion_modulus_m3: float
    thickest_m: float
    buckling_curves: tuple[str, str]
    flanges_apart_m: float | None = None
    is_rolled: bool = False
    web: Web | None = None
    flat: FlatPart | None = None

    @property
    def on_gusset(self) -> FlatPart | None:
        """What of it lies on a gusset; None of hollow sections."""
        if self.web is not None and self.web.count == 1:
            return FlatPart(WEB, self.web.height_m, self.web.thickness_m)
        return self.flat

    @cached_property
    def shape(self) -> PlaneShape:
        """Area and moments."""
        return plane_shape(self.rings)

    @property
    def area_m2(self) -> float:
        return self.shape.area_m2

    @property
    def size_m(self) -> FloatArray:
        """Width along y and height along z, (2,)."""
        return np.ptp(np.concatenate(self.rings), axis=0)


def rolled_i(name: str, height: float, width: float, web: float, flange: float, radius: float) -> SteelSection:
    """Return a rolled I-section with roots rounded by a radius, all in m.

    Torsion constant and plastic shear area as in the tables of rolled sections (ArcelorMittal, Sections and Merchant
    Bars, notations and formulae).
    """
    inner = (height - 2.0 * flange) / 2.0
    roots = [(1, -1), (1, 1), (-1, 1), (-1, -1)]
    right, left = width / 2.0, -width / 2.0
    corners = [
        *((left, -height / 2.0), (right, -height / 2.0), (right, -inner)),
        *((roots[0][0] * web / 2.0, -inner), (roots[1][0] * web / 2.0, inner)),
        *((right, inner), (right, height / 2.0), (left, height / 2.0), (left, inner)),
        *((roots[2][0] * web / 2.0, inner), (roots[3][0] * web / 2.0, -inner)),
        (left, -inner),
    ]
    radii = [0.0, 0.0, 0.0, radius, radius, 0.0, 0.0, 0.0, 0.0, radius, radius, 0.0]
    rings = about_centre([rounded(corners, radii)])
    circle = (_square(radius + web / 2.0) + _square(radius + flange) - radius * radius) / (2.0 * radius + flange)
    roots_m4 = 2.0 * (web / flange) * (0.145 + 0.1 * radius / flange) * _square(_square(circle))
    plates_m4 = 2.0 / 3.0 * (width - 0.63 * flange) * _cube(flange) + (height - 2.0 * flange) * _cube(web) / 3.0
    area = plane_shape(rings).area_m2
    of_web = max(area - 2.0 * width * flange + (web + 2.0 * radius) * flange, 2.0 * inner * web)
    narrow, thin = height > _ROLLED_NARROW * width, flange <= _THIN_FLANGE_M
    curves = ("a", "b") if narrow and thin else ("b", "c")
    if not narrow and flange > 0.1:
        curves = ("d", "d")
    return SteelSection(
        name,
        rings,
        plates_m4 + roots_m4,
        _i_shear(width, flange, (height - flange) * web),
        np.array([2.0 * width * flange, of_web]),
        _plates_modulus([(width, flange)] * 2 + [(height - 2.0 * flange, web)]),
        max(web, flange),
        curves,
        height - flange,
        is_rolled=True,
        web=Web(1, 2.0 * inner, web),
    )


def plate_girder(
    name: str, height: float, web: float, top: tuple[float, float], bottom: tuple[float, float]
) -> SteelSection:
    """Return a welded I-section: height over all, thickness of the web, widths and thicknesses of the flanges, in m."""
    (top_width, top_plate), (bottom_width, bottom_plate) = top, bottom
    clear = height - top_plate - bottom_plate
    half, below, above = web / 2.0, bottom_plate, height - top_plate
    ring = np.array(
        [
            *((-bottom_width / 2.0, 0.0), (bottom_width / 2.0, 0.0), (bottom_width / 2.0, below), (half, below)),
            *((half, above), (top_width / 2.0, above), (top_width / 2.0, height), (-top_width / 2.0, height)),
            *((-top_width / 2.0, above), (-half, above), (-half, below), (-bottom_width / 2.0, below)),
        ]
    )
    flanges = top_width * top_plate + bottom_width * bottom_plate
    thickest = max(top_plate, bottom_plate)
    plates = [(top_width, top_plate), (bottom_width, bottom_plate), (clear, web)]
    return SteelSection(
        name,
        about_centre([ring]),
        _plates_torsion(plates),
        np.array([5.0 / 6.0 * flanges, web * (height - (top_plate + bottom_plate) / 2.0)]),
        np.array([flanges, web * clear]),
        _plates_modulus(plates),
        max(web, thickest),
        ("b", "c") if thickest <= _THIN_FLANGE_M else ("c", "d"),
        height - top_plate if top == bottom else None,
        web=Web(1, clear, web),
    )


def hollow_rectangle(name: str, height: float, width: float, plate: float) -> SteelSection:
    """Return a rectangular tube with rounded corners, hot finished, by sizes in m.

    Corners have radii of 1.5 and 1.0 times the thickness, and the torsion constant follows EN 10210-2:2006, A.3.
    """
    outer, inner = 1.5 * plate, 1.0 * plate
    around = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)]
    ring = rounded([(y * width, z * height) for y, z in around], [outer] * 4)
    hole = rounded([(y * (width - 2 * plate), z * (height - 2 * plate)) for y, z in around], [inner] * 4)[::-1]
    corner = 0.5 * (outer + inner)
    middle_line = 2.0 * (height + width - 2.0 * plate) - 2.0 * corner * (4.0 - math.pi)
    enclosed = (height - plate) * (width - plate) - corner * corner * (4.0 - math.pi)
    torsion = _cube(plate) * middle_line / 3.0 + 4.0 * enclosed * enclosed * plate / middle_line
    rings = about_centre([ring, hole])
    area = plane_shape(rings).area_m2
    shares = np.array([width, height]) / (width + height)
    return SteelSection(
        name,
        rings,
        torsion,
        _webs(width, height, plate, plate),
        area * shares,
        2.0 * enclosed * plate,
        plate,
        ("a", "a"),
    )


def welded_box(name: str, height: float, width: float, web: float, flange: float) -> SteelSection:
    """Return a box of two webs and two flanges, by sizes over all in m; its torsion constant is Bredt's."""
    ring = rectangle(width, height)
    hole = rectangle(width - 2.0 * web, height - 2.0 * flange)[::-1]
    deep, wide = height - flange, width - web
    torsion = 2.0 * _square(deep * wide) / (deep / web + wide / flange)
    clear = height - 2.0 * flange
    return SteelSection(
        name,
        about_centre([ring, hole]),
        torsion,
        _webs(width, height, web, flange),
        np.array([2.0 * flange * width, 2.0 * web * clear]),
        2.0 * deep * wide * min(web, flange),
        max(web, flange),
        ("b", "b"),
        web=Web(2, clear, web),
    )


def tube(name: str, diameter: float, plate: float) -> SteelSection:
    """Return a round tube by its outer diameter and thickness in m, hot finished; its outline has 24 sides.

    The polygon has the area of the tube, and nearly its second moments.
    """
    outer, inner = diameter / 2.0, diameter / 2.0 - plate
    angles = 2.0 * math.pi * np.arange(_TUBE_SIDES) / _TUBE_SIDES
    circle = np.column_stack((cosine(angles), sine(angles)))
    circle *= math.sqrt(math.pi / (0.5 * _TUBE_SIDES * float(sine(2.0 * math.pi / _TUBE_SIDES))))
    rings = (outer * circle, inner * circle[::-1])
    area = math.pi * (outer * outer - inner * inner)
    torsion = math.pi / 2.0 * (_square(outer * outer) - _square(inner * inner))
    return SteelSection(
        name,
        rings,
        torsion,
        np.full(2, area / 2.0),
        np.full(2, 2.0 * area / math.pi),
        2.0 * math.pi * _square(outer - plate / 2.0) * plate,
        plate,
        ("a", "a"),
    )


def channel(name: str, height: float, width: float, web: float, flange: float) -> SteelSection:
    """Return a channel with parallel flanges and sharp corners, by sizes over all in m."""
    inner = height / 2.0 - flange
    ring = np.array(
        [
            *((0.0, -height / 2.0), (width, -height / 2.0), (width, -inner), (web, -inner)),
            *((web, inner), (width, inner), (width, height / 2.0), (0.0, height / 2.0)),
        ]
    )
    of_web = web * (height - flange)
    plates = [(width - web / 2.0, flange)] * 2 + [(height - flange, web)]
    return SteelSection(
        name,
        about_centre([ring]),
        _plates_torsion(plates),
        _i_shear(width, flange, of_web),
        np.array([2.0 * width * flange, of_web]),
        _plates_modulus(plates),
        max(web, flange),
        ("c", "c"),
        flat=FlatPart(WEB, 2.0 * inner, web),
    )


def angle(name: str, height: float, width: float, plate: float) -> SteelSection:
    """Return an angle with sharp corners, by sizes over all in m."""
    ring = np.array([(0.0, 0.0), (width, 0.0), (width, plate), (plate, plate), (plate, height), (0.0, height)])
    legs = np.array([(width - plate / 2.0) * plate, (height - plate / 2.0) * plate])
    plates = [(width - plate / 2.0, plate), (height - plate / 2.0, plate)]
    return SteelSection(
        name,
        about_centre([ring]),
        _plates_torsion(plates),
        5.0 / 6.0 * legs,
        legs,
        _plates_modulus(plates),
        plate,
        ("b", "b"),
        flat=FlatPart(LEG, height, plate),
    )


def tee(name: str, height: float, width: float, web: float, flange: float) -> SteelSection:
    """Return a T-section with its flange at the top and sharp corners, by sizes over all in m."""
    below = height - flange
    ring = np.array(
        [
            *((-web / 2.0, 0.0), (web / 2.0, 0.0), (web / 2.0, below), (width / 2.0, below)),
            *((width / 2.0, height), (-width / 2.0, height), (-width / 2.0, below), (-web / 2.0, below)),
        ]
    )
    of_web = web * (height - flange / 2.0)
    plates = [(width, flange), (height - flange / 2.0, web)]
    return SteelSection(
        name,
        about_centre([ring]),
        _plates_torsion(plates),
        5.0 / 6.0 * np.array([width * flange, of_web]),
        np.array([width * flange, of_web]),
        _plates_modulus(plates),
        max(web, flange),
        ("c", "c"),
        flat=FlatPart(STEM, below, web),
    )


def solid_bar(name: str, height: float, width: float) -> SteelSection:
    """Return a flat or square bar by its sizes in m; torsion after Roark, table 10.1, case 4."""
    long, short = max(height, width), min(height, width)
    slender = short / long
    torsion = long * _cube(short) * (1.0 / 3.0 - 0.21 * slender * (1.0 - _square(slender * slender) / 12.0))
    area = height * width
    return SteelSection(
        name,
        (rectangle(width, height),),
        torsion,
        np.full(2, 5.0 / 6.0 * area),
        np.full(2, area),
        short * short * (3.0 * long - short) / 6.0,  # Nadai's analogy of sand
        short,
        ("c", "c"),
        flat=FlatPart(FLAT_BAR, long, short, along=1 if height >= width else 0),
    )


def check_sizes(name: str, sizes_mm: Sequence[float], holes_mm: Sequence[float]) -> None:
    """Refuse sizes that are not above 0, and plates that leave nothing between them (`holes_mm`)."""
    if min(sizes_mm) <= 0.0 or min(holes_mm, default=1.0) <= 0.0:
        raise ScenarioError(f'section "{name}": expected sizes above 0 mm, and plates thinner than what they are in')


def _i_shear(width: float, flange: float, web_m2: float) -> FloatArray:
    """Areas that shear deforms of two flanges, and of a web."""
    return np.array([5.0 / 6.0 * 2.0 * width * flange, web_m2])


def _webs(width: float, height: float, web: float, flange: float) -> FloatArray:
    """Areas that shear deforms of a box along its width and its height."""
    return np.array([2.0 * flange * (width - web), 2.0 * web * (height - flange)])


def _plates_torsion(plates: Sequence[tuple[float, float]]) -> float:
    """Torsion constant of open plates, by lengths and thicknesses: Σ b t³ / 3, without free ends for their length."""
    return math.fsum(max(long - 0.63 * thin, 0.0) * _cube(thin) / 3.0 for long, thin in plates)


def _plates_modulus(plates: Sequence[tuple[float, float]]) -> float:
    """Torsion of open plates by the shear stress at which all of them yield: Σ b t² / 2."""
    return math.fsum(long * thin * thin / 2.0 for long, thin in plates)


def _square(value: float) -> float:
    return value * value


def _cube(value: float) -> float:
    return value * value * value
