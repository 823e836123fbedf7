"""The time axis of a chart, kept with its picture, so that a click on the picture can be read as a time."""

from __future__ import annotations

import struct
from dataclasses import dataclass
from pathlib import Path

from matplotlib.axes import Axes

KEY = "bda time axis"
"""Keyword of the text in the picture (PNG) that says where the axis lies."""

_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_LENGTH, _NAME, _CHECK = 4, 4, 4
_IMAGE_BEGINS = b"IDAT"


@dataclass(frozen=True, slots=True)
class TimeAxis:
    """Where an axis lies in its picture, as shares of the width from the left, and the times at its ends, s."""

    left: float
    right: float
    begin_s: float
    end_s: float

    @classmethod
    def of(cls, axes: Axes) -> TimeAxis:
        """Return the axis of a chart that is laid out for good."""
        box, (begin_s, end_s) = axes.get_position(), axes.get_xlim()
        return cls(float(box.x0), float(box.x1), float(begin_s), float(end_s))

    @classmethod
    def read(cls, path: Path) -> TimeAxis | None:
        """Return the axis that a picture was written with; None where it has none, or is no picture."""
        try:
            text = _texts(path.read_bytes()).get(KEY)
            return cls(*map(float, text.split())) if text else None
        except (OSError, struct.error, TypeError, ValueError):
            return None

    @property
    def text(self) -> str:
        """The axis as it is kept."""
        return f"{self.left:.6f} {self.right:.6f} {self.begin_s:.6f} {self.end_s:.6f}"

    def time_at(self, share: float) -> float | None:
        """Return the time, s, at a share of the picture's width; None beside the axis."""
        if not self.left <= share <= self.right:
            return None
        return self.begin_s + (share - self.left) / (self.right - self.left) * (self.end_s - self.begin_s)


def _texts(picture: bytes) -> dict[str, str]:
    """Return the texts of a PNG by their keywords, up to where its pixels begin."""
    found, begin = {}, len(_SIGNATURE)
    if not picture.startswith(_SIGNATURE):
        return {}
    while begin + _LENGTH + _NAME <= len(picture):
        length, name = struct.unpack_from(">I4s", picture, begin)
        if name == _IMAGE_BEGINS:
            break
        first = begin + _LENGTH + _NAME
        if name == b"tEXt":
            keyword, _, text = picture[first : first + length].partition(b"\0")
            found[keyword.decode("latin-1")] = text.decode("latin-1")
        begin = first + length + _CHECK
    return found
