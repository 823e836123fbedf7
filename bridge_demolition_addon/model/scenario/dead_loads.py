"""Dead loads on members: surfacing, kerbs, parapets, railings."""

from dataclasses import dataclass
from typing import ClassVar

from ..schema import POSITION, Table, check_exactly_one, key


@dataclass(frozen=True, slots=True, kw_only=True)
class DeadLoad(Table):
    """What lies on members beside their own concrete and steel, such as surfacing, kerbs, parapets or noise walls: mass
    of the shards at the top, which falls with them, and is in weights, reactions and picks. It has no shape, no
    strength and no stiffness."""

    table: ClassVar[str] = "dead_loads"

    name: str = key("What it is called.")
    member: str = key("Name or kind of the members that it lies on.", default="deck")
    mass_kg_m2: float | None = key(
        "Mass by its area: 240 of 10 cm of asphalt. Give this or `mass_kg_m`.", default=None, unit="kg/m²", above=0
    )
    mass_kg_m: float | None = key(
        "Mass by its length along the road: 50 of a railing, 600 of a parapet of concrete.",
        default=None,
        unit="kg/m",
        above=0,
    )
    across_m: tuple[float, float] | None = key(
        "From where to where it lies across the road; by default all of the member's width.", default=None, **POSITION
    )
    along_m: tuple[float, float] | None = key(
        "From where to where it lies along the road, in a skewed member in the middle of the road; by default all of "
        "the member's length.",
        default=None,
        **POSITION,
    )
    until_s: float | None = key(
        "When it is taken off, before all else that is done to the bridge. `bda stages` has it until then; a run "
        "begins without it.",
        default=None,
        unit="s",
        above=0,
    )

    def _check_together(self) -> None:
        check_exactly_one(self, "mass_kg_m2", "mass_kg_m")
        for name in ("across_m", "along_m"):
            ends = getattr(self, name)
            if ends is not None and not ends[0] < ends[1]:
                raise self.unexpected(name, "two positions, the lower one first")
