"""Truss spans by sizes: two planes of chords, posts and diagonals, with cross beams and bracing between them."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, ClassVar

from ...engineering.steelwork.catalogue import section_named
from ...errors import ScenarioError
from ..schema import SIZE, Table, key
from .bearings import PINNED, ROCKER
from .joint_settings import GROUND_NAME

PRATT, WARREN = "pratt", "warren"

_LEFT, _RIGHT = "left", "right"

_FEWEST_PANELS, _MOST_PANELS = 4, 60


@dataclass(frozen=True, slots=True, kw_only=True)
class TrussSpan(Table):
    """A span of two trusses side by side, along the road. Its bars and nodes are those that `[[steelwork.members]]` and
    `[[steelwork.nodes]]` would give, with fixed joints: nodes L0, L1 … of the bottom chord and U0, U1 … of the top
    chord, as `span L0 left`, and bars by the nodes at their ends, as `span L0-L1 left`. It has no deck of its own: the
    mass of one moves with the nodes that carry it."""

    table: ClassVar[str] = "steelwork.trusses"

    name: str = key("Name of the span, with which all names in it begin.", default="span")
    kind: str = key(
        "`pratt`: diagonals fall towards the middle, and are pulled; `warren`: they rise and fall by turns. Both have "
        "posts.",
        default=PRATT,
        choices=(PRATT, WARREN),
    )
    deck: str = key(
        "Where the deck lies: at the `bottom` chord of a through truss, whose ends are inclined, or on the `top` chord "
        "of a deck truss, whose ends are upright.",
        default="bottom",
        choices=("bottom", "top"),
    )
    position_m: tuple[float, float, float] = key(
        "Position of the first end, at the axis of the bottom chords and in the middle between them.",
        unit="m",
    )
    length_m: float = key("Length from the first node of the bottom chord to the last.", **SIZE)
    panels: int = key("Number of panels, an even one.", at_least=_FEWEST_PANELS, at_most=_MOST_PANELS)
    height_m: float = key("Distance of the axes of the chords.", **SIZE)
    spacing_m: float = key("Distance of the two trusses.", **SIZE)
    top_chord: str = key("Section of the top chord, and of inclined end posts.")
    bottom_chord: str = key("Section of the bottom chord.")
    posts: str = key("Section of the posts.")
    diagonals: str = key("Section of the diagonals.")
    cross_beams: str = key("Section of the beams across the road, between the nodes of both chords.")
    bracing: str = key("Section of the diagonals between the two trusses, in the planes of both chords.")
    deck_kg_m: float = key(
        "Mass of the deck and all that lies on it, by length of the road.", default=0.0, unit="kg/m", at_least=0
    )
    supports: tuple[str, str] | None = key(
        "What the two ends stand on, on pins at the first and on rockers at the last, as `steelwork.nodes.held_by`; "
        '`["ground", "ground"]` by default.',
        default=None,
    )
    is_supported: bool = key("Whether its ends stand on supports; else give bars that hold them.", default=True)

    def nodes(self) -> Iterator[dict[str, Any]]:
        """Yield the keys of its nodes."""
        first, last = self.supports or (GROUND_NAME, GROUND_NAME)
        for side, y in self._sides:
            for level, number in self._points:
                supported = self.is_supported and level == "L" and number in (0, self.panels)
                yield {
                    "name": self._node(level, number, side),
                    "position_m": self._place(level, number, y),
                    "mass_kg": self._deck_kg(level, number),
                    "support": None if not supported else ROCKER if number else PINNED,
                    "held_by": last if number else first,
                }

    def members(self) -> Iterator[dict[str, Any]]:
        """Yield the keys of its bars."""
        for side, _ in self._sides:
            for kind, section, one, other in self._in_plane():
                yield self._bar(kind, section, (*one, side), (*other, side), side)
        for level, number in self._points:
            yield self._bar("cross beam", self.cross_beams, (level, number, _LEFT), (level, number, _RIGHT), "")
        points = self._points
        for level, number in points:
            if (level, number + 1) in points:
                begin, end = (_LEFT, _RIGHT) if number % 2 else (_RIGHT, _LEFT)
                yield self._bar("bracing", self.bracing, (level, number, begin), (level, number + 1, end), "")

    @property
    def _sides(self) -> tuple[tuple[str, float], tuple[str, float]]:
        half = 0.5 * self.spacing_m
        return (_LEFT, half), (_RIGHT, -half)

    @property
    def _top(self) -> range:
        """Numbers of the nodes of the top chord."""
        return range(self.panels + 1) if self.deck == "top" else range(1, self.panels)

    @property
    def _points(self) -> list[tuple[str, int]]:
        return [*(("L", number) for number in range(self.panels + 1)), *(("U", number) for number in self._top)]

    def _in_plane(self) -> Iterator[tuple[str, str, tuple[str, int], tuple[str, int]]]:
        """Yield kind, section and nodes of the bars of one truss."""
        last, top = self.panels, self._top
        for number in range(last):
            yield "bottom chord", self.bottom_chord, ("L", number), ("L", number + 1)
        for number in top[:-1]:
            yield "top chord", self.top_chord, ("U", number), ("U", number + 1)
        for number in top:
            yield "post", self.posts, ("L", number), ("U", number)
        if top[0] == 1:
            yield "end post", self.top_chord, ("L", 0), ("U", 1)
            yield "end post", self.top_chord, ("L", last), ("U", last - 1)
        for panel in range(top[0], last - top[0]):
            falls = panel < last // 2 if self.kind == PRATT else panel % 2 == 1
            one, other = (("U", panel), ("L", panel + 1)) if falls else (("L", panel), ("U", panel + 1))
            yield "diagonal", self.diagonals, one, other

    def _node(self, level: str, number: int, side: str) -> str:
        return f"{self.name} {level}{number} {side}"

    def _place(self, level: str, number: int, y: float) -> tuple[float, float, float]:
        begin, middle, height = self.position_m
        return (
            begin + self.length_m * number / self.panels,
            middle + y,
            height + (self.height_m if level == "U" else 0.0),
        )

    def _deck_kg(self, level: str, number: int) -> float:
        """Mass of the deck that a node carries: half of a panel to each side, and half of the width."""
        if level != ("U" if self.deck == "top" else "L"):
            return 0.0
        panels = 0.5 if number in (0, self.panels) else 1.0
        return 0.5 * panels * self.deck_kg_m * self.length_m / self.panels

    def _bar(
        self, kind: str, section: str, begin: tuple[str, int, str], end: tuple[str, int, str], side: str
    ) -> dict[str, Any]:
        points = f"{begin[0]}{begin[1]}-{end[0]}{end[1]}"
        return {
            "name": " ".join(filter(None, (self.name, points, side or kind))),
            "kind": kind,
            "nodes": (self._node(*begin), self._node(*end)),
            "section": section,
        }

    def _check_together(self) -> None:
        if self.panels % 2:
            raise self.unexpected("panels", "an even number")
        for name in ("top_chord", "bottom_chord", "posts", "diagonals", "cross_beams", "bracing"):
            try:
                section_named(getattr(self, name))
            except ScenarioError as error:
                raise ScenarioError(f"{self.table}.{name}: {error}") from error
