"""Actions on a part of the bridge, which a scenario gives by members or by a box."""

from dataclasses import dataclass
from typing import ClassVar

from ...errors import ScenarioError
from ..actions import PlannedAction
from ..schema import key


@dataclass(frozen=True, slots=True, kw_only=True)
class Part(PlannedAction):
    """An action on a part of the bridge: some members, what lies in a box, or what of the members lies in the box."""

    table: ClassVar[str] = "parts"

    members: tuple[str, ...] | None = key(
        'Members that it happens to, by the names that `bda check` lists or by kind: `["pier 1", "pier cap"]`.',
        default=None,
    )
    lowest_corner_m: tuple[float, float, float] | None = key(
        "Lowest x, y and z of the box that it happens in, as the bridge was built. Give both corners or none.",
        default=None,
        unit="m",
    )
    highest_corner_m: tuple[float, float, float] | None = key("Highest x, y and z of that box.", default=None, unit="m")

    @property
    def where(self) -> str:
        """Return members and box in words; empty where there are none."""
        members = ", ".join(self.members or ())
        corners = zip(self.lowest_corner_m or (), self.highest_corner_m or (), strict=True)
        box = " by ".join(f"{low:g} to {high:g}" for low, high in corners)
        return " in ".join(part for part in (members, box and f"{box} m") if part)

    def _check_together(self) -> None:
        lowest, highest = self.lowest_corner_m, self.highest_corner_m
        if (lowest is None) != (highest is None):
            given, missing = ("lowest", "highest") if highest is None else ("highest", "lowest")
            raise self.unexpected(f"{missing}_corner_m", f"it with {self.table}.{given}_corner_m")
        for place, (low, high) in enumerate(zip(lowest or (), highest or (), strict=True)):
            if not low < high:
                raise ScenarioError(
                    f"{self.table}.highest_corner_m[{place}] is {high}: expected more than that of the lowest "
                    f"corner, {low} (m)"
                )
