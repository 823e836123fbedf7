"""Variants: scenario files that only say how they differ from the file that they are based on."""

from collections.abc import Iterable
from typing import Any

from ..errors import ScenarioError
from ..schema import shown
from .scenario import Scenario

BASED_ON = "based_on"
"""Key of the table of a scenario: the file of which this one is a variant."""

WITHOUT = "without"
"""Key of the table of a scenario: tables and keys of that file that this one does without."""


def take_based_on(document: dict[str, Any]) -> tuple[str | None, list[str]]:
    """Remove from a document what it is based on and what it does without, and return both.

    Parameters
    ----------
    document : dict
        As read from TOML. The two keys are removed from it.

    Raises
    ------
    ScenarioError
        One of the two is no text, or something is left out of no file.
    """
    heading = document.get(Scenario.table)
    if not isinstance(heading, dict):
        return None, []
    base, without = heading.pop(BASED_ON, None), heading.pop(WITHOUT, [])
    if base is not None and not (isinstance(base, str) and base.strip()):
        raise ScenarioError(f"{Scenario.table}.{BASED_ON} is {shown(base)}: expected the path of a scenario file")
    if not isinstance(without, list) or not all(isinstance(name, str) for name in without):
        raise ScenarioError(f"{Scenario.table}.{WITHOUT} is {shown(without)}: expected a list of tables and keys")
    if without and base is None:
        raise ScenarioError(f"{Scenario.table}.{WITHOUT} needs {Scenario.table}.{BASED_ON}")
    return base, without


def varied(base: dict[str, Any], changes: dict[str, Any], without: Iterable[str]) -> dict[str, Any]:
    """Return a document with changes: tables are merged key by key, values and lists of tables replaced.

    Parameters
    ----------
    base, changes : dict
        Documents as read from TOML; both stay as they are.
    without : iterable of str
        Names such as ``ball`` or ``bridge.pier_caps`` of what is left out of the base.

    Raises
    ------
    ScenarioError
        The base has nothing of a name.
    """
    result = base
    for name in without:
        result = _left_out(result, name.split("."), name)
    return _merged(result, changes)


def _left_out(table: dict[str, Any], path: list[str], name: str) -> dict[str, Any]:
    first, *rest = path
    if first not in table or (rest and not isinstance(table[first], dict)):
        raise ScenarioError(f"{Scenario.table}.{WITHOUT} names {shown(name)}, which is not in the file it is based on")
    inner = {first: _left_out(table[first], rest, name)} if rest else {}
    return {key: value for key, value in table.items() if key != first} | inner


def _merged(base: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    both = {
        key for key in base.keys() & changes.keys() if isinstance(base[key], dict) and isinstance(changes[key], dict)
    }
    return base | changes | {key: _merged(base[key], changes[key]) for key in both}
