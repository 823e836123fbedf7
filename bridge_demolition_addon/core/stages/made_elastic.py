"""A scenario with elastic connections, of one whose connections are rigid."""

from dataclasses import replace

from ..scenario import Scenario
from ..scenario.connections import MATERIAL_OF_LARGE_MODELS


def made_elastic(scenario: Scenario) -> Scenario:
    """Return a scenario with elastic connections, where they break by a force as stiff as the others.

    Where all do, they are as stiff as reinforced concrete.
    """
    between = tuple(
        replace(each, breaking_force_n=None, breaking_force_kgf=None) for each in scenario.connections.between
    )
    changes = {"stiffness": "elastic", "between": between}
    if scenario.connections.material is None and scenario.connections.method == "face":
        changes |= {"breaking_force_n": None, "breaking_force_kgf": None, "material": MATERIAL_OF_LARGE_MODELS}
    return replace(scenario, connections=replace(scenario.connections, **changes))
