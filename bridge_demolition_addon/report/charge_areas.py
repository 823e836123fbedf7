"""Areas of a charge plan for the site plan: those that BS 6187 names, as far as they are known without a run.

Predicted debris is that of a run or a study. Fragments are known within a factor of 2, and no safety distance.
"""

from __future__ import annotations

from dataclasses import replace

from manifold3d import CrossSection

from ..engineering.drilled_charges.fragments import Ranges
from ..engineering.geometry.plan_areas import united
from ..engineering.geometry.solids import to_manifold
from ..errors import GeometryError, ScenarioError
from ..model.bridge.preparation import prepared_members
from ..model.debris.exclusion import widened, widened_around
from ..model.scenario import Scenario
from ..model.structure.charge_plan import charge_plan
from ..model.structure.zone_fragments import fragment_areas, zone_areas


def charge_areas(scenario: Scenario) -> dict[str, CrossSection]:
    """Return all areas of the charge plan of a scenario by their names, the largest first."""
    members = prepared_members(scenario).members
    plan = charge_plan(scenario, members)
    bridge = united([to_manifold(member.solid, member.name).project() for member in members])
    drop = {} if scenario.exclusion is None else {"designed drop": widened(bridge, scenario.exclusion.designed_drop_m)}
    own = drop | {"bridge": bridge} | zone_areas(plan.zones)
    return fragment_areas(plan.zones, plan.flyrock) | cordon_area(scenario, bridge) | own


def areas_of_fragments(scenario: Scenario | None, limits: Ranges | None = None) -> dict[str, CrossSection]:
    """Return areas of fragments of a run's scenario; nothing without blast zones, or without files of its members.

    Where there are limits of a study, all zones have these.
    """
    if scenario is None or not scenario.blast_zones:
        return {}
    try:
        plan = charge_plan(scenario, prepared_members(scenario).members)
    except (GeometryError, ScenarioError):
        return {}  # the chapter with the charge plan says why
    flown = plan.flyrock
    if limits is not None:
        flown = tuple(None if of is None else replace(of, sampled=limits) for of in flown)
    return fragment_areas(plan.zones, flown)


def cordon_area(scenario: Scenario | None, bridge: CrossSection) -> dict[str, CrossSection]:
    """Return what is kept clear around the plan of a bridge, by its name; nothing where the scenario does not say."""
    if scenario is None or scenario.exclusion is None or scenario.exclusion.cordon_m is None:
        return {}
    return {"cordon": widened_around(bridge, scenario.exclusion.cordon_m)}
