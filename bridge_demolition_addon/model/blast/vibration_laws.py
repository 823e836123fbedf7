"""How the ground of the site carries vibration, as `bda calibrate` fits it to measured events."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

from ...engineering.blast.site_law import FEWEST_EVENTS, SiteLaw
from ...errors import ScenarioError
from ..schema import Table, key

OF_CHARGES, OF_FALL = "charges", "fall"

_MM_PER_M = 1e3
_SIGNIFICANT = ".6g"


@dataclass(frozen=True, slots=True, kw_only=True)
class VibrationLaw(Table):
    """How the ground of the site carries vibration: v = K (R / √S)^-b, as `bda calibrate` writes it. It takes the place
    of the general formula, and its upper line is what is held against limits. One of each kind at most."""

    table: ClassVar[str] = "vibration_laws"

    of: str = key(
        "What shakes: `charges` in drill holes, with S the kg within a delay, or the `fall`, with S its energy in kJ.",
        choices=(OF_CHARGES, OF_FALL),
    )
    velocity_mm_s: float = key("K: the velocity at a scaled distance of 1.", unit="mm/s", above=0)
    exponent: float = key("b: how fast it falls with the distance.", above=0, at_most=10)
    scatter: float = key("Standard deviation of the natural logarithm of the velocities about it.", at_least=0)
    events: int = key("How many events it was fitted to.", at_least=FEWEST_EVENTS, at_most=1_000_000)
    scaled: tuple[float, float, float] = key(
        "Scaled distances R / √S of the events, in m/√kg or m/√kJ: the nearest, the geometric mean, the farthest.",
        above=0,
    )
    spread: float = key("Standard deviation of the natural logarithm of these distances.", above=0)

    @property
    def law(self) -> SiteLaw:
        nearest, middle, farthest = self.scaled
        velocity_m_s = self.velocity_mm_s / _MM_PER_M
        return SiteLaw(velocity_m_s, self.exponent, self.scatter, self.events, nearest, farthest, middle, self.spread)

    def _check_together(self) -> None:
        nearest, middle, farthest = self.scaled
        if not nearest < middle < farthest:
            raise self.unexpected("scaled", "the nearest, the mean and the farthest, in this order")


def check_laws(laws: Sequence[VibrationLaw]) -> None:
    """Check that there is at most one law of each kind."""
    for kind in (OF_CHARGES, OF_FALL):
        if len([law for law in laws if law.of == kind]) > 1:
            raise ScenarioError(f'[[vibration_laws]] has more than one of "{kind}": expected one')


def law_text(law: SiteLaw, of: str) -> str:
    """Return a law as a table of a scenario file."""
    values = {
        "of": f'"{of}"',
        "velocity_mm_s": format(_MM_PER_M * law.velocity_m_s, _SIGNIFICANT),
        "exponent": format(law.exponent, _SIGNIFICANT),
        "scatter": format(law.scatter, _SIGNIFICANT),
        "events": str(law.events),
        "scaled": f"[{', '.join(format(value, _SIGNIFICANT) for value in (law.nearest, law.middle, law.farthest))}]",
        "spread": format(law.spread, _SIGNIFICANT),
    }
    return "\n".join(["[[vibration_laws]]", *(f"{name} = {value}" for name, value in values.items())]) + "\n"
