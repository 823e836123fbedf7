"""Whether a scenario can be run at all, beyond what its values tell: found out without Blender."""

from collections.abc import Sequence

from .events import model_structure, schedule
from .extent import surface_height
from .member import Member
from .model import Model, build_model
from .scenario import Scenario


def runnable_model(scenario: Scenario, members: Sequence[Member] | None = None) -> Model:
    """Return the model of a scenario in which all that is planned for it concerns something.

    Parameters
    ----------
    scenario
        What is to be run.
    members
        Its members, where they are prepared already.

    Raises
    ------
    GeometryError
        The bridge cannot be cut as asked, or nothing lies under the ball or the beginning of a jackhammer's path.
    ScenarioError
        There is no member of a name, or a change concerns nothing.
    """
    model = build_model(scenario, members)
    schedule(scenario.changes, model_structure(model))
    drops = [drop.target_m for drop in scenario.ball.drops] if scenario.ball else []
    for place in (*drops, *(hammer.path_m[0] for hammer in scenario.jackhammers)):
        surface_height(scenario, model.members, place)
    return model
