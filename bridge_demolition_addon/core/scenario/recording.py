"""What is recorded in a run, and its pictures."""

from dataclasses import dataclass
from typing import ClassVar

from ..schema import Table, key


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordingSettings(Table):
    """What is recorded while the simulation runs."""

    table: ClassVar[str] = "recording"

    every_substep: bool = key(
        "Whether loads are read after every sub-step, which gives their means, peaks and impulses, or only after the "
        "last one of each frame, which is faster and misses most of an impact.",
        default=True,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class PictureSettings(Table):
    """Size of the pictures."""

    table: ClassVar[str] = "pictures"

    width_px: int = key("Width.", default=1280, unit="px", at_least=16, at_most=8192)
    height_px: int = key("Height.", default=720, unit="px", at_least=16, at_most=8192)
