"""When charges go off, and how their blast is computed and applied."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import ClassVar

from ...engineering.blast.pulses import BlastModel, Loading
from ...engineering.blast.wave import NamedChoice
from ...engineering.timing.timeline import SlowMotion
from ...errors import ScenarioError
from ..actions import Fact
from ..schema import Table, key
from .charges import MS_PER_S, Charge

MOST_FIELDS = 300
"""Force fields up to which they cost less than the rest of a frame: Blender tests every one against every body."""


class Apply(NamedChoice):
    """How blast loads reach the bodies."""

    FIELDS = "fields"
    """By one force-field empty per body, steady within a frame."""

    DIRECT = "direct"
    """As forces in Bullet, set again in every sub-step."""


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
    pressure_factor: float = key(
        "Factor on all pressures, and so on all impulses; times and the vibration of the ground stay. Tests scatter "
        "about the curves: a study may sample it.",
        default=1.0,
        above=0,
        at_most=100,
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
        default=Apply.FIELDS.value,
        choices=tuple(apply.value for apply in Apply),
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

    def facts(self, charges: Sequence[Charge], shards: int) -> Iterator[Fact]:
        """Yield the total of the charges, and how their blast acts on a number of shards."""
        yield "all", f"{math.fsum(charge.mass_kg for charge in charges):g} kg"
        if not self.explosion:
            yield "explosion", "not ticked: nothing goes off"
        yield "model", f"{self.model}, {self.loading} pressure{', with shielding' if self.shielding else ''}"
        if self.apply == Apply.DIRECT:
            yield "applied", "directly in every sub-step"
        else:
            slow = f'; with {shards} shards these are slow, and blast.apply = "direct" is not'
            yield "applied by", f"force fields{slow if shards > MOST_FIELDS else ''}"

    def slow_motions(self, charges: tuple[Charge, ...], frame_s: float) -> tuple[SlowMotion, ...]:
        """Return the spans of slow motion after detonations, for frames that otherwise take `frame_s`."""
        if not self.explosion or self.slow_frame_ms is None:
            return ()
        slow_frame_s, duration_s = self.slow_frame_ms / MS_PER_S, self.slow_duration_ms / MS_PER_S
        if slow_frame_s > frame_s:
            raise ScenarioError(
                f"blast.slow_frame_ms is {self.slow_frame_ms:g}: expected at most the length of any other frame, "
                f"{frame_s * MS_PER_S:.6g} (ms)"
            )
        times = sorted({self.start_s + charge.delay_s for charge in charges if charge.mass_kg > 0.0})
        return tuple(SlowMotion(time, duration_s, slow_frame_s) for time in times if math.isfinite(time))
