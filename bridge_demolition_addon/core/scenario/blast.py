"""The charges, and how their blast is computed and applied."""

import math
from dataclasses import dataclass
from typing import ClassVar

from ..blast.charges import EXPLOSIVES, Charge
from ..blast.explosion import BlastOptions
from ..blast.models import BlastModel
from ..blast.pulses import Loading
from ..blast.wave import Burst
from ..errors import ScenarioError
from ..timing.timeline import SlowMotion
from .schema import Table, key

_MS_PER_S = 1000.0


@dataclass(frozen=True, slots=True, kw_only=True)
class ChargeSettings(Table):
    """A bare charge. One of 0 kg does nothing."""

    table: ClassVar[str] = "charges"

    name: str | None = key("What it is called in the logs; by default Charge and its number.", default=None)
    place_m: tuple[float, float, float] = key("Where it is: along the road, across it, and above the ground.", unit="m")
    mass_kg: float = key("Mass of the explosive itself.", unit="kg", at_least=0, at_most=1_000_000)
    explosive: str = key("What it is made of.", default="TNT", choices=tuple(EXPLOSIVES))
    delay_ms: float = key(
        "Time from `blast.start_s` to its detonation.", default=0.0, unit="ms", at_least=0, at_most=1e6
    )
    burst: str = key(
        "Whether it detonates in the `air` or on the `surface` of the ground, which throws the wave back.",
        default=Burst.AIR.value,
        choices=tuple(burst.value for burst in Burst),
    )

    def charge(self, number: int) -> Charge:
        """The charge, where it is the one of that number."""
        return Charge(
            name=self.name or f"Charge {number}",
            place_m=self.place_m,
            mass_kg=self.mass_kg,
            explosive=self.explosive,
            delay_s=self.delay_ms / _MS_PER_S,
            burst=Burst(self.burst),
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class BlastSettings(Table):
    """When the charges go off, and how their blast is computed and applied."""

    table: ClassVar[str] = "blast"

    explosion: bool = key("Whether the charges go off at all.", default=True)
    start_s: float = key("When a charge without delay detonates.", default=0.5, unit="s", at_least=0)
    model: str = key(
        "Where the blast waves come from: tests (`kingery-bulmash`) or the formulas of the 2019 report "
        "(`kinney-graham`).",
        default=BlastModel.KINGERY_BULMASH.value,
        choices=tuple(model.value for model in BlastModel),
    )
    loading: str = key(
        "Pressure beside the wave's path (`incident`), or on a wall that it meets head-on (`reflected`).",
        default=Loading.INCIDENT.value,
        choices=tuple(loading.value for loading in Loading),
    )
    shielding: bool = key(
        "Whether shards that stand behind others get less, as rays from the charge find out.", default=False
    )
    constant_decay: float | None = key(
        "One decay for all pulses, as the 2019 report has it with 1; by default each pulse gets the one that fits its "
        "impulse.",
        default=None,
        at_least=0,
    )
    apply: str = key(
        "How bodies are pushed: by force-field empties (`fields`), steady within each frame, or straight through the "
        "physics, updated in every sub-step (`direct`), which costs next to nothing with many shards.",
        default="fields",
        choices=("fields", "direct"),
    )
    slow_frame_ms: float | None = key(
        "Simulated time of a frame while charges go off; by default as long as all others.",
        default=None,
        unit="ms",
        above=0,
    )
    slow_duration_ms: float = key(
        "How long after each detonation frames are that short.", default=50.0, unit="ms", above=0, at_most=1e6
    )

    @property
    def options(self) -> BlastOptions:
        """How the loads are computed."""
        return BlastOptions(
            start_s=self.start_s,
            model=BlastModel(self.model),
            loading=Loading(self.loading),
            shielding=self.shielding,
            constant_decay=self.constant_decay,
        )

    def slow_motions(self, charges: tuple[Charge, ...], frame_s: float) -> tuple[SlowMotion, ...]:
        """Spans of slow motion after the detonations of charges, for frames that otherwise take `frame_s`."""
        if not self.explosion or self.slow_frame_ms is None:
            return ()
        slow_frame_s, duration_s = self.slow_frame_ms / _MS_PER_S, self.slow_duration_ms / _MS_PER_S
        if slow_frame_s > frame_s:
            raise ScenarioError(
                f"blast.slow_frame_ms is {self.slow_frame_ms:g}: expected at most the length of any other frame, "
                f"{frame_s * _MS_PER_S:.6g} (ms)"
            )
        times = sorted({self.start_s + charge.delay_s for charge in charges if charge.mass_kg > 0.0})
        return tuple(SlowMotion(time, duration_s, slow_frame_s) for time in times if math.isfinite(time))
