"""The coarse scenario of a preview, in so few shards that its run takes seconds, and how far it is to be trusted."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ..blast.charges import MS_PER_S
from ..blast.settings import BlastSettings
from ..bridge.member import Member
from ..bridge.preparation import prepared_members
from ..scenario import Scenario
from ..scenario.fracture import FractureSettings
from ..scenario.steelwork import Steelwork
from ..scenario.time import TimeSettings
from ..sequence.checked_model import check_actions
from ..structure.kept_models import KeptModels
from ..structure.model import Model

SHARDS, ELASTIC_SHARDS = 80, 50
"""Shards of a preview, where connections are rigid and where they are elastic: a sub-step of elastic connections takes
about ten times as long."""

FRAMES_PER_SECOND, SUBSTEP_S = 12, 1.0 / 36.0
"""Frames and sub-steps of a preview with elastic connections. These are implicit, so that none is too stiff for such
steps; bars between cracks and contacts are followed more coarsely than in the run."""

WAVES_MS = 20.0
"""How long after a detonation waves load the bridge, where the scenario says nothing of it."""

FARTHEST_M = 1000.0
"""How far a body may go in such a sub-step: where bars are, a run would take up to a hundred of them in a frame."""

REST_HOLD_S, REST_SPEED_M_S, REST_SPIN_RAD_S = 0.5, 0.1, 0.3
"""A preview with elastic connections ends at this rest: what topples slowly is faster within half a second."""


def preview_scenario(scenario: Scenario, members: Sequence[Member]) -> Scenario:
    """Return a scenario in as few shards as a preview takes, and otherwise as it is; itself where it has no more.

    What is cut finer by numbers or points of the user's own is then cut by volume, as all else: these numbers add up to
    the scenario's. Connections stay rigid or elastic, as they are; elastic ones get longer steps, end at a rest that is
    less strict, and bars of steel are not cut across.

    Parameters
    ----------
    members
        All members of the scenario: each takes one shard at least, but steel members have their own.
    """
    is_elastic = scenario.connections.is_elastic
    most = max(ELASTIC_SHARDS if is_elastic else SHARDS, sum(member.steel is None for member in members))
    found = replace(scenario, fracture=in_shards(scenario.fracture, most))
    if is_elastic:
        time = in_long_steps(scenario.time)
        blast = in_short_steps(scenario.blast, scenario.time, time) if scenario.charges else scenario.blast
        found = replace(found, time=time, blast=blast, steelwork=in_one_piece(scenario.steelwork))
    return scenario if found == scenario else found


def preview_model(scenario: Scenario, models: KeptModels | None = None) -> tuple[Scenario, Model]:
    """Return the coarse scenario of a preview, and its model; an action that acts on nothing raises ScenarioError.

    Previews of one bridge share its model where models are kept.
    """
    members = prepared_members(scenario).members
    coarse = preview_scenario(scenario, members)
    is_as_prepared = coarse.steelwork == scenario.steelwork  # other pieces are other members
    models = KeptModels() if models is None else models  # one that is empty counts as false
    model = models.model_of(coarse, members if is_as_prepared else None)
    check_actions(coarse, model)
    return coarse, model


def in_shards(fracture: FractureSettings, most: int) -> FractureSettings:
    """Return how a bridge is cut into a number of shards at most."""
    fracture = replace(fracture, recursion_share=0.0)
    if fracture.shards <= most:
        return fracture
    stretched = tuple(replace(rule, shards=None, share=None) for rule in fracture.members if rule.stretch)
    return replace(fracture, shards=most, members=stretched, points=(), points_file=None)


def in_one_piece(steelwork: Steelwork | None) -> Steelwork | None:
    """Return steelwork whose bars are not cut across, but those that say their own pieces, or need them to buckle."""
    return steelwork if steelwork is None or steelwork.bowed else replace(steelwork, pieces=1)


def in_long_steps(time: TimeSettings) -> TimeSettings:
    """Return the steps of a preview with elastic connections, none shorter than the scenario's own."""
    own = time.step
    if own.frame_s < 1.0 / FRAMES_PER_SECOND:
        time = replace(time, frames_per_second=FRAMES_PER_SECOND, frames_per_second_base=1.0, time_scale=1.0)
    substeps = round(time.step.frame_s / max(SUBSTEP_S, own.substep_s))
    return replace(
        time,
        substeps_per_frame=max(1, substeps),
        farthest_per_substep_m=FARTHEST_M,
        rest_hold_s=min(time.rest_hold_s, REST_HOLD_S),
        rest_speed_m_s=max(time.rest_speed_m_s, REST_SPEED_M_S),
        rest_angular_velocity_rad_s=max(time.rest_angular_velocity_rad_s, REST_SPIN_RAD_S),
    )


def in_short_steps(blast: BlastSettings, own: TimeSettings, coarse: TimeSettings) -> BlastSettings:
    """Return a blast while whose waves sub-steps are as short as in the run: longer ones leave columns standing."""
    frame_ms = blast.slow_frame_ms or MS_PER_S * own.step.frame_s
    duration_ms = WAVES_MS if blast.slow_frame_ms is None else blast.slow_duration_ms
    in_frame = coarse.substeps_per_frame / own.substeps_per_frame
    slow_frame_ms = min(in_frame * frame_ms, MS_PER_S * coarse.step.frame_s)
    return replace(blast, slow_frame_ms=slow_frame_ms, slow_duration_ms=duration_ms)


ALIKE_PERCENT = 93
"""So many spans fall in both or stand in both, of all pairs of a preview and a whole run with other draws of shards."""

LEAST_THROW, MOST_THROW = 0.6, 2.7
"""How far 95 % of the shards get on plan, over that of whole runs, by the medians over draws: least and most of all
scenarios in which a span falls."""
