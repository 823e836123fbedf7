"""A scenario with elastic connections, of one whose connections are rigid."""

from dataclasses import replace
from typing import Any

from ...errors import ScenarioError
from ..scenario import Scenario
from ..scenario.connections import MATERIAL_OF_LARGE_MODELS


def made_elastic(scenario: Scenario) -> Scenario:
    """Return a scenario with elastic connections, where they break by a force as stiff as the others.

    Where all do, they are as stiff as reinforced concrete.

    Raises
    ------
    ScenarioError
        They cannot be elastic: they stand for no faces, or are of a type that has no stiffness.
    """
    between = tuple(
        replace(each, breaking_force_n=None, breaking_force_kgf=None) for each in scenario.connections.between
    )
    changes: dict[str, Any] = {"stiffness": "elastic", "between": between}
    if scenario.connections.material is None and scenario.connections.method == "face":
        changes |= {"breaking_force_n": None, "breaking_force_kgf": None, "material": MATERIAL_OF_LARGE_MODELS}
    try:
        return replace(scenario, connections=replace(scenario.connections, **changes))
    except ScenarioError as error:
        raise ScenarioError(f"how a bridge rests is worked out with elastic connections, but {error}") from error
