"""Names of the inputs and outputs of runs, as people read them."""

from __future__ import annotations

import re

from ...engineering.units import name_and_unit
from ...texts import NEAREST, UP, Text, Unit
from .criteria import Criterion

_IN_LIST = re.compile(r"\.\d+$")
"""The position of a value in a list, at the end of a name."""

_QUOTED_OR_DOT = re.compile(r'"[^"]*"|\.')
_REACH = "debris distance"
_CRITERION = f"{Criterion.table}."


def shown(name: str) -> Text:
    """Return the name of an input or output as people read it: its unit in brackets, of a criterion only its own."""
    words, unit = words_and_unit(name)
    side = UP if is_reach(name) else NEAREST
    return Text("{0} ({1})", words, Unit(unit, side)) if unit else words


def is_reach(name: str) -> bool:
    """Return whether an output is a distance that debris gets, which is never rounded down."""
    return name in ("reach_m", "largest_throw_m")


def words_and_unit(name: str) -> tuple[Text, str]:
    """Return the name of an input or output as people read it, and its unit, empty without one."""
    if name.startswith(_CRITERION):
        return Text("{}", name.removeprefix(_CRITERION).strip('"')), ""
    in_list = _IN_LIST.search(name)
    position = in_list[0] if in_list else ""
    words, unit = name_and_unit(name.removesuffix(position).replace("reach", "debris_distance"))
    words = _QUOTED_OR_DOT.sub(lambda part: " " if part[0] == "." else part[0], words)
    words = f"{words.replace('_', ' ')}{position.replace('.', ' ')}"
    return Text(_REACH) if words == _REACH else Text("{}", words), unit
