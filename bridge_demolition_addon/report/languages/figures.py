"""The texts within a drawing, put into a language."""

from __future__ import annotations

from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.ticker import FixedFormatter

from .translation import Translation


def translate_figure(figure: Figure, translation: Translation) -> None:
    """Put the texts of a drawing into a language, before it is laid out."""
    if translation.is_english:
        return
    for axis in figure.findobj(Axis):
        for formatter in (axis.get_major_formatter(), axis.get_minor_formatter()):
            if isinstance(formatter, FixedFormatter):
                formatter.seq = [_translated(text, translation) for text in formatter.seq]
    for text in figure.findobj(Text):
        if text.get_text().strip():
            text.set_text(_translated(text.get_text(), translation))


def _translated(text: str, translation: Translation) -> str:
    """Return a text; one of several lines is looked up as a whole, and then line by line."""
    if "\n" not in text:
        return translation.text(text)
    return "\n".join(map(translation.text, text.split("\n")))
