"""Check of a scenario as far as its model shows it, without Blender."""

from collections.abc import Sequence

import numpy as np
from manifold3d import Manifold

from ...engineering.geometry.solids import to_manifold
from ...errors import GeometryError
from ..bridge.extent import surface_height
from ..bridge.member import Member
from ..scenario import Ball, Scenario
from ..structure.model import Model, build_model
from .events import model_structure, schedule
from .loads import placed_on_model

_SPHERE_FACETS = 64
"""Round enough: the corners are on the sphere, and its sides 0.1 % of the radius within it."""


def checked_model(scenario: Scenario, members: Sequence[Member] | None = None) -> Model:
    """Return the model of a scenario in which all that is planned for it concerns something.

    Parameters
    ----------
    scenario : Scenario
        What is to be run.
    members : sequence of Member, optional
        Its members, where they are prepared already.

    Raises
    ------
    GeometryError
        The bridge cannot be cut as asked, nothing lies under the ball or the beginning of a jackhammer's path, or the
        ball begins within a member.
    ScenarioError
        There is no member of a name, or a change or a load concerns nothing.
    """
    model = build_model(scenario, members)
    schedule(scenario.changes, model_structure(model))
    placed_on_model(scenario.loads, model)
    _ = scenario.ground_record  # refuses a file that holds no accelerogram
    drops = [drop.target_m for drop in scenario.ball.drops] if scenario.ball else []
    heights = [surface_height(scenario, model.members, place) for place in drops]
    for hammer in scenario.jackhammers:
        surface_height(scenario, model.members, hammer.path_m[0])
    if scenario.ball and scenario.ball.cable and scenario.ground.file is not None:
        lowest = np.array([scenario.ball.cable.lowest_point_m[:2]])
        scenario.ball.check_swing(float(np.nan_to_num(model.ground.heights_at(lowest)[0], nan=-np.inf)))
    if scenario.ball:
        _check_start(scenario.ball, heights[0] if heights else 0.0, model.members)
    return model


def _check_start(ball: Ball, surface_m: float, members: Sequence[Member]) -> None:
    """Bullet would throw a ball and a shard that begin within each other apart."""
    place = ball.start_m(surface_m)
    sphere = Manifold.sphere(ball.diameter_m / 2.0, _SPHERE_FACETS).translate(place)
    for member in members:
        if (to_manifold(member.solid, member.name) ^ sphere).volume() > 0.0:
            where = ", ".join(f"{each:g}" for each in place)
            raise GeometryError(
                f"The ball begins within member {member.name!r}, with its middle at [{where}] (m); give it another "
                f"{'cable, or draw it aside farther' if ball.cable else 'target or drop height'}."
            )
