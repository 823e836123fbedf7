"""Names of the inputs and outputs of runs, as people read them."""

from __future__ import annotations

import re

from ...engineering.units import name_and_unit
from .criteria import Criterion

_IN_LIST = re.compile(r"\.\d+$")
"""The position of a value in a list, at the end of a name."""

_QUOTED_OR_DOT = re.compile(r'"[^"]*"|\.')
_CRITERION = f"{Criterion.table}."


def shown(name: str) -> str:
    """Return the name of an input or output as people read it: its unit in brackets, of a criterion only its own."""
    if name.startswith(_CRITERION):
        return name.removeprefix(_CRITERION).strip('"')
    name = name.replace("reach", "debris_distance")
    in_list = _IN_LIST.search(name)
    position = in_list[0] if in_list else ""
    name = name.removesuffix(position)
    name = _QUOTED_OR_DOT.sub(lambda part: " " if part[0] == "." else part[0], name)
    name, unit = name_and_unit(name)
    return f"{name.replace('_', ' ')}{position.replace('.', ' ')}" + (f" ({unit})" if unit else "")
