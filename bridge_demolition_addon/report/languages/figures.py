"""The texts within a drawing, put into a language."""

from __future__ import annotations

from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.ticker import FixedFormatter

from .translation import Translation

_DOLLAR = r"\$"
"""A dollar that begins no formula."""


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
    r"""Return a text of a drawing, line by line. Its dollars, which are ``\$`` there, are looked up as they are."""
    if "\n" in text:
        return "\n".join(_translated(line, translation) for line in text.split("\n"))
    bare = text.replace(_DOLLAR, "$")
    own = translation.text(bare)
    return own if bare == text else own.replace("$", _DOLLAR)
