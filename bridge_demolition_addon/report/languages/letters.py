"""Letters of a language that matplotlib's own font lacks, and where lines of such a language may end."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager

import matplotlib
from matplotlib import font_manager

from .translation import ReportTexts

CHINESE_FONTS = (
    "Noto Sans CJK SC",
    "Noto Sans SC",
    "Source Han Sans SC",
    "Source Han Sans CN",
    "WenQuanYi Zen Hei",
    "WenQuanYi Micro Hei",
    "Microsoft YaHei",
    "PingFang SC",
    "Heiti SC",
    "Hiragino Sans GB",
    "SimHei",
    "SimSun",
    "Noto Sans CJK JP",
    "Arial Unicode MS",
)
"""Fonts with simplified Chinese letters on Linux, Windows and macOS, those that are looked for first at the front."""

NO_LETTERS = (
    "{} is written, with its drawings in English, and no PDF: no font with Chinese letters was found. Install one, "
    "such as Noto Sans CJK SC (on Debian and Ubuntu: apt install fonts-noto-cjk), and make the report again"
)

_CHINESE = "\u2e80-\u2fdf\u3000-\u303f\u3400-\u9fff\uff00-\uffef"
_OPENING = "\uff08\u300a\u300c\u3010"
_CLOSING = "\u3002\uff0c\u3001\uff1b\uff1a\uff01\uff1f\uff09\u300b\u300d\u3011"
_PIECE = re.compile(
    rf"[{_OPENING}]*(?:[^{_CHINESE}]+|[{_CHINESE}])[{_CLOSING}]*"  # no line begins or ends with the wrong mark
)


def chinese_font() -> str | None:
    """Return the name of a font of this machine with simplified Chinese letters; None without one."""
    there = set(font_manager.get_font_names())
    return next((name for name in CHINESE_FONTS if name in there), None)


@contextmanager
def letters_of(table: ReportTexts) -> Iterator[bool]:
    """Have drawings and pages use a font that has the letters of a language; yield whether there is one."""
    if not table.chinese_letters:
        yield True
    elif (font := chinese_font()) is None:
        yield False
    else:
        with matplotlib.rc_context({"font.family": [*matplotlib.rcParams["font.family"], font]}):
            yield True


def families(family: str) -> tuple[str, ...]:
    """Return a family of letters, and those that have what it lacks."""
    return family, *matplotlib.rcParams["font.family"][1:]


def pieces(text: str) -> Iterator[tuple[str, str]]:
    """Yield parts of a text between which a line may end, each with the blank before it: words, and Chinese letters."""
    for word in text.split():
        blank = " "
        for piece in _PIECE.findall(word) or [word]:
            yield blank, piece
            blank = ""
