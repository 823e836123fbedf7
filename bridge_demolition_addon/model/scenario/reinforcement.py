"""Bars by a rule: designed for traffic, or by ratios of steel, of a parametric bridge or of members from files."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

from ...engineering.elasticity.steel_bars import Steel
from ...engineering.reinforced_concrete.materials import GRADES
from ...engineering.reinforced_concrete.traffic import Traffic, hl_93, load_model_1, own_traffic
from ...errors import ScenarioError
from ...texts import Quantity, Text, joined
from ..schema import SIZE, Table, key

LOAD_MODEL_1 = "LM1"
HL_93 = "HL-93"
OWN_WEIGHT = "own weight"
NONE = "none"

USUAL_COVER_M = 0.045
"""Nominal cover where the user says none."""

_KILO = 1e3
_LEFT_OUT = ("arch", "thrust block")
"""Members that no design gives bars, by the beginnings of their names."""

_OWN = "traffic of your own (traffic_kn_m2, axles_kn)"
_PERCENT = {"default": None, "unit": "%", "at_least": 0, "at_most": 8}


@dataclass(frozen=True, slots=True, kw_only=True)
class RatiosOfMember(Table):
    """Ratios of steel of a member, or of all of a kind: areas of bars over the area of the section that they cross.
    Those that are left out are 0."""

    table: ClassVar[str] = "bridge.reinforcement.ratios"

    member: str = key("Name or kind of a member.")
    bottom_percent: float | None = key("Bars along the road at the bottom, or at the sides of what stands.", **_PERCENT)
    top_percent: float | None = key("Bars along the road at the top.", **_PERCENT)
    across_bottom_percent: float | None = key("Bars across the road at the bottom.", **_PERCENT)
    across_top_percent: float | None = key("Bars across the road at the top.", **_PERCENT)
    upright_percent: float | None = key("Upright bars of a pier or abutment, at its four sides together.", **_PERCENT)
    links_percent: float | None = key(
        "Links: their area over that of the member as seen along them, A_sw / (s b).", **_PERCENT
    )

    def _check_together(self) -> None:
        if not any(getattr(self, name) for name in RATIOS):
            raise ScenarioError(
                f"{self.table} of {self.member} has no ratio above 0: expected one of {', '.join(RATIOS)}"
            )


RATIOS = (
    "bottom_percent",
    "top_percent",
    "across_bottom_percent",
    "across_top_percent",
    "upright_percent",
    "links_percent",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class BarRule(Table):
    """A rule for bars: what they are designed for, and what of."""

    designed_for: str | None = key(
        "Traffic that the bridge was designed for beside its own weight: load model 1 of EN 1991-2 with α = 1 (`LM1`), "
        "HL-93 of AASHTO, none (`own weight`); or `none` for a bridge that has no bars.",
        default=None,
        choices=(LOAD_MODEL_1, HL_93, OWN_WEIGHT, NONE),
    )
    traffic_kn_m2: float | None = key(
        "Uniform load of your own on the carriageway.", default=None, unit="kN/m²", at_least=0, at_most=1000
    )
    axles_kn: tuple[float, ...] | None = key(
        "Axle loads of a vehicle of your own, from first to last, with impact.",
        default=None,
        unit="kN",
        at_least=0,
        at_most=100_000,
    )
    axle_spacing_m: tuple[float, ...] | None = key(
        "Distances from each axle to the next; one less than axles.", default=None, unit="m", above=0, at_most=100
    )
    carriageway_m: float | None = key(
        "Width of the carriageway, which says how many lanes there are; by default that of the deck.",
        default=None,
        **SIZE,
    )
    permanent_kn_m2: float = key(
        "Permanent load on the deck that the bridge was designed for beside its own weight, as of surfacing. The "
        "simulation does not have it.",
        default=0.0,
        unit="kN/m²",
        at_least=0,
        at_most=1000,
    )
    concrete_n_mm2: float | None = key(
        "Characteristic strength of the concrete in compression, f_ck, that it was designed with; by default that of "
        "`connections.material`.",
        default=None,
        unit="N/mm²",
        at_least=12,
        at_most=90,
    )
    steel: str = key("Grade of the bars.", default="B500B", choices=tuple(GRADES))
    cover_m: float = key(
        "Nominal cover of the outermost bars. By default that of EN 1992-1-1 for exposure XD1, class S4: 35 mm and 10 "
        "mm for deviations.",
        default=USUAL_COVER_M,
        unit="m",
        above=0,
        at_most=1,
    )
    bar_diameter_mm: float = key(
        "Diameter of main bars; larger ones are taken where these do not fit.",
        default=20.0,
        unit="mm",
        at_least=6,
        at_most=40,
    )

    @property
    def has_bars(self) -> bool:
        return self.designed_for != NONE

    @property
    def grade(self) -> Steel:
        return GRADES[self.steel]

    @property
    def described(self) -> str:
        """What the bars follow from, for a heading."""
        if self.designed_for is not None:
            return (
                Text("own weight") if self.designed_for == OWN_WEIGHT else Text("own weight and {}", self.designed_for)
            )
        parts: list[str] = [] if self.traffic_kn_m2 is None else [Quantity(self.traffic_kn_m2, "kN/m²", "g")]
        if self.axles_kn is not None:
            *others, last = self.axles_kn
            axles = [*(Quantity(axle, "kN", "g", shown=False) for axle in others), Quantity(last, "kN", "g")]
            parts.append(Text("axles of {}", joined("{} + {}", axles)))
        return Text("own weight, {}", joined("{} and {}", parts))

    def traffic(self, deck_width_m: float) -> Traffic | None:
        """Return the traffic of the design; None for own weight alone."""
        width = self.carriageway_m or deck_width_m
        if self.designed_for == LOAD_MODEL_1:
            return load_model_1(width)
        if self.designed_for == HL_93:
            return hl_93(width)
        if self.designed_for is not None:
            return None
        axles = [_KILO * axle for axle in self.axles_kn or ()]
        return own_traffic(width, _KILO * (self.traffic_kn_m2 or 0.0), axles, self.axle_spacing_m or ())

    def refused(self, why: str) -> ScenarioError:
        """Return the error of a load that the bridge cannot be designed for."""
        name = next(
            (n for n in ("designed_for", "traffic_kn_m2", "axles_kn") if getattr(self, n) is not None), "ratios"
        )
        value = getattr(self, name)
        shown = f'"{value}"' if isinstance(value, str) else f"{value}"
        return ScenarioError(f"{self.table}.{name} is {shown}: {why}")

    def _check_together(self) -> None:
        own = self.traffic_kn_m2 is not None or self.axles_kn is not None
        self._check_one_route({"designed_for": self.designed_for is not None, _OWN: own})
        needed = max(len(self.axles_kn or ()) - 1, 0)
        if len(self.axle_spacing_m or ()) != needed:
            wanted = f"{needed} numbers (m), from each axle to the next" if needed else "none with fewer than two axles"
            raise self.unexpected("axle_spacing_m", wanted)

    def _check_one_route(self, routes: dict[str, bool]) -> None:
        """Check that exactly one of what bars may follow from is given."""
        if sum(routes.values()) != 1:
            state = "given together" if any(routes.values()) else "all missing"
            *first, last = routes
            raise ScenarioError(
                f"{self.table} has {', '.join(first)} and {last} {state}: expected exactly one of these"
            )


@dataclass(frozen=True, slots=True, kw_only=True)
class BridgeReinforcement(BarRule):
    """Bars by a rule, for a bridge without drawings: designed by EN 1992-1-1 for its own weight and traffic, or by
    ratios. Give one of `designed_for`, traffic of your own and `ratios`. A frame has ratios alone. Over an arch, deck
    and piers may be designed; `ratios` then give the bars of arch and thrust blocks. `[[reinforcement]]` of a member
    replaces what this gives it. Needs what `[[reinforcement]]` needs. `bda check` prints the schedule of bars."""

    table: ClassVar[str] = "bridge.reinforcement"

    ratios: tuple[RatiosOfMember, ...] = ()

    @property
    def described(self) -> str:
        """What the bars follow from, for a heading."""
        return BarRule.described.__get__(self) if self.is_designed else Text("ratios of steel")

    @property
    def is_designed(self) -> bool:
        """Return whether bars follow from loads, and not from ratios alone."""
        return self.designed_for is not None or self.traffic_kn_m2 is not None or self.axles_kn is not None

    def check_frame(self) -> None:
        """Check that bars of a frame are not designed."""
        if self.is_designed and self.has_bars:
            raise self.refused(
                "expected [[bridge.reinforcement.ratios]] with bridge.frame, or [[reinforcement]]: moments at the "
                "corners of a frame and in its legs are not designed for"
            )

    def check_ratios(self, members: Sequence[str]) -> None:
        """Check that ratios next to a design are of these members only, which it leaves out."""
        if self.is_designed and any(table.member not in members for table in self.ratios):
            self._refuse_both()

    def check_deck(self, width_m: float) -> None:
        """Check that the carriageway is on the deck."""
        if self.carriageway_m is not None and self.carriageway_m > width_m:
            raise self.unexpected("carriageway_m", f"at most bridge.deck.width_m, {width_m:g} (m)")

    def _check_one_route(self, routes: dict[str, bool]) -> None:
        if not any(routes.values()):
            routes = {**routes, "ratios": bool(self.ratios)}
        elif not self.has_bars or any(not table.member.startswith(_LEFT_OUT) for table in self.ratios):
            self._refuse_both()
        BarRule._check_one_route(self, routes)

    def _refuse_both(self) -> None:
        if self.ratios:
            BarRule._check_one_route(self, dict.fromkeys(("designed_for", _OWN, "ratios"), True))


@dataclass(frozen=True, slots=True, kw_only=True)
class GeometryReinforcement(BarRule):
    """Bars by a rule of the members of `[[geometry]]` that are of concrete, as of a bridge from IFC: designed by EN
    1992-1-1 for their own weight and traffic, by the kind, sizes and supports of each. Give `designed_for` or traffic
    of your own. `[[reinforcement]]` of a member replaces what this gives it. Needs what `[[reinforcement]]` needs.
    `bda check` prints the schedule of bars."""

    table: ClassVar[str] = "geometry_reinforcement"
