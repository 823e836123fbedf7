"""Forces of single bearings over several cuts of one bridge, and their sums over axes.

Coarse shards share loads between girders, or between feet, otherwise than the bridge does, and each cut in a way of its
own. Sums of an axis differ less.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...engineering.elasticity.accuracy import expected_single_deviation
from ...engineering.elasticity.equations import connected_parts
from ...engineering.elasticity.equilibrium import Equilibrium
from ...errors import ScenarioError
from ...texts import Text
from ..actions import Fact
from ..scenario import Scenario
from ..schema import LARGEST_INTEGER, given
from .cracking import RestingModel, cracked_by_weight
from .equilibrium import deflection_m, loads_of, model_at_rest, overloaded
from .model import Model, build_model
from .model_bearings import BearingForce

ONE_CUT = Text(
    "Single bearings are of this one cut: each seed shares what an axis carries "
    "otherwise, and bda check --cuts 5 says by how much."
)
"""What is said beside forces of bearings that may carry an axis together."""

LEAST_CUTS, MOST_CUTS = 2, 100

MOST_SHARDS_CUT_AGAIN = 600
"""Shards up to which a bridge without bearings is cut again to see what differs: of 600 in 5 s."""

_LEAST_OF_LARGEST = 0.05
"""Part of the largest force that what differs is compared with at least: bearings may carry next to nothing."""

_TURNS_FREELY_M = 0.01
"""Lever of a bearing's force by which its moment about the axis across the road is no more than what cuts leave."""

_SAME_AXIS_M = 0.05
"""Distance along the road up to which bearings on several members are in one axis."""

_SAME_LEVEL_M = 0.3

_KILO = 1e-3


@dataclass(frozen=True, slots=True)
class BearingAxis:
    """Bearings, by their numbers, that carry together: on one member, or side by side on several."""

    name: str
    bearings: tuple[int, ...]


@dataclass(frozen=True, slots=True, eq=False)
class BearingRanges:
    """Upward forces (k, b) of bearings at rest, in k cuts of one bridge: those by the seeds with which it stands."""

    names: tuple[str, ...]
    axes: tuple[BearingAxis, ...]
    seeds: tuple[int, ...]
    upwards_n: np.ndarray

    def facts(self) -> Iterator[Fact]:
        """Yield the least, the largest and the mean force of each bearing, and of each axis."""
        count = len(self.upwards_n)
        if count < len(self.seeds):
            yield "not counted", f"{len(self.seeds) - count} cuts, which come down by their own weight"
        if count < LEAST_CUTS:
            return
        for name, forces_n in zip(self.names, self.upwards_n.T, strict=True):
            yield name, _range_text(forces_n)
        for axis in self.axes:
            yield axis.name, Text("{}, in all", _range_text(self.upwards_n[:, list(axis.bearings)].sum(axis=1)))
        # Of k + 1 exchangeable values each is as likely to be the least or the largest.
        yield "no bounds", f"one more cut is outside the range of a bearing with a chance of {2.0 / (count + 1):.0%}."
        yield "", "On the whole the mean is nearer than one cut to what the bridge does, which is not cut."


def bearing_axes(model: Model, bearings: Sequence[BearingForce]) -> tuple[BearingAxis, ...]:
    """Return the axes of a model in which two bearings or more carry together."""
    if model.bearings is None:
        return ()
    pairs = {
        number: model.connections.pairs[rows[0]].tolist()
        for number in range(len(bearings))
        if len(rows := model.bearings.rows_of(number))
    }
    above, members = (
        {number: int(model.member_of_shard[pair[side]]) if pair[side] >= 0 else -1 for number, pair in pairs.items()}
        for side in (0, 1)
    )

    def are_beside(one: int, other: int) -> bool:
        if members[one] == members[other]:
            return True
        # What lies above follows the line of the road, which a column below does not.
        places = [model.members[above[n]].without_skew(bearings[n].axis_m) for n in (one, other)]
        along, _, up = np.abs(places[0] - places[1])
        return bool(along <= _SAME_AXIS_M and up <= _SAME_LEVEL_M)

    axes: list[list[int]] = []
    for number in pairs:
        together = [axis for axis in axes if any(are_beside(number, other) for other in axis)]
        joined = [*(other for axis in together for other in axis), number]
        axes = [*(axis for axis in axes if axis not in together), joined]
    names = [model.members[member].name for member in range(len(model.members))]
    return tuple(
        BearingAxis(f"on {_common_name([names[members[number]] for number in axis])}", tuple(axis))
        for axis in axes
        if len(axis) > 1
    )


def bearing_facts(
    scenario: Scenario, model: Model, rest: Equilibrium, bearings: Sequence[BearingForce]
) -> Iterator[Fact]:
    """Yield what bearings carry, with the sum of each axis, and how far they differ in another cut of this bridge.

    Both cuts are compared without cracks, in which they are at `rest`. No other cut is made where statics alone say
    what each carries, as of decks of one span.
    """
    axes = bearing_axes(model, bearings)
    redundant = _redundant(model, axes, bearings)
    other = next_cut(scenario, model) if redundant else None
    own_n = _upwards_n(model, rest)
    other_rest = None if other is None else model_at_rest(other, scenario.joints)
    more_n = np.zeros(len(own_n)) if other is None else _upwards_n(other, given(other_rest)) - own_n
    for number, bearing in enumerate(bearings):
        along, across, up = _KILO * bearing.force_n
        lifted = "" if up else ": it has lifted off"
        text = f"{up:z.1f} kN up, {along:z.1f} kN along, {across:z.1f} kN across{lifted}"
        if other is not None and number in redundant:
            text += f"; {_KILO * more_n[number]:+.1f} kN up in another cut"
        yield bearing.name, text
    for axis in axes:
        sum_n = math.fsum(float(bearings[number].force_n[2]) for number in axis.bearings)
        yield axis.name, f"{_KILO * sum_n:z.1f} kN up in all"
    if other is not None and other_rest is not None:
        usual_n = own_n.copy()
        for axis in axes:
            usual_n[list(axis.bearings)] = own_n[list(axis.bearings)].mean()
        compared_n = np.maximum(usual_n, _LEAST_OF_LARGEST * usual_n.max())
        most, more = (abs(more_n) / compared_n)[redundant].max(), _differences_text((model, rest), (other, other_rest))
        yield (
            "another cut",
            f"by seed {other_seed(scenario)}: single bearings differ by up to {most:.1%} of what one of",
        )
        yield "", f"their axis carries in the mean, {more}."
        yield "", "bda check --cuts 5 compares more cuts"
        yield from _alike_cuts_facts(scenario, model)
    elif not redundant:
        yield "of statics alone", "what each bearing carries upwards: it is the same however the bridge is cut"


def another_cut_facts(scenario: Scenario, resting: RestingModel) -> Iterator[Fact]:
    """Yield how a bridge without bearings, elastic and at rest, differs in another cut."""
    model = resting.model
    if model.bearings is not None or not resting.rest.held[: len(model.shards)].any():
        return
    if len(model.shards) > MOST_SHARDS_CUT_AGAIN:
        yield "another cut", f"is not made of more than {MOST_SHARDS_CUT_AGAIN} shards"
        return
    other = next_cut(scenario, model)
    if other is not None:
        differences = _differences_text((model, resting.rest), (other, model_at_rest(other, scenario.joints)))
        yield "another cut", f"by seed {other_seed(scenario)}: {differences}"


def _differences_text(one: tuple[Model, Equilibrium], other: tuple[Model, Equilibrium]) -> str:
    """Say by how much the deflection and the first frequency of another cut differ, without cracks."""
    deflections_m, frequencies_hz = (
        [deflection_m(*one), deflection_m(*other)],
        [one[1].frequency_hz, other[1].frequency_hz],
    )
    texts = []
    for name, (own, others) in (("deflection", deflections_m), ("first frequency", frequencies_hz)):
        texts.append(f"the {name} by {others / own - 1.0:+.1%}" if own else f"the {name} is 0")
    return ", ".join(texts)


def _alike_cuts_facts(scenario: Scenario, model: Model) -> Iterator[Fact]:
    """Yield how far off single bearings are where all seeds cut almost alike: another cut does not show it."""
    bridge = scenario.bridge
    if bridge is None or bridge.alignment or not (bridge.girders or model.has_lattices):
        return
    share = expected_single_deviation(bridge.skew_deg)
    if share is None:
        yield (
            "known to within",
            "not measured with so much skew: 11% of each bearing at 25°. Cuts that are alike do not",
        )
    else:
        yield (
            "known to within",
            f"{share:.0%} of each bearing, beside bricks and plates of OpenSees. Cuts that are alike do not",
        )
    yield "", "show what all of them leave out"


def _redundant(model: Model, axes: Sequence[BearingAxis], bearings: Sequence[BearingForce]) -> list[int]:
    """Return the numbers of bearings whose forces upwards do not follow from statics alone.

    Statics say what two bearings carry that turn freely and hold a body that nothing else does: all that hangs together
    but for its bearings.
    """
    rows, pairs = given(model.bearings), model.connections.pairs
    between = np.delete(pairs, rows.springs.rows, axis=0)
    is_held = np.append(model.fixed, True)[between]  # the ground, at index -1, is
    body_of_shard = connected_parts(~model.fixed, *between[~is_held.any(axis=1)].T)
    held = set(body_of_shard[between[is_held.any(axis=1)][~is_held[is_held.any(axis=1)]]].tolist())
    above = {
        number: int(body_of_shard[pairs[own[0], 0]])
        for number in range(len(bearings))
        if len(own := rows.rows_of(number))
    }
    for axis in axes:
        bodies = [above[number] for number in axis.bearings]
        held |= {body for body in bodies if bodies.count(body) > 1}
    turned = {
        body
        for number, body in above.items()
        if abs(bearings[number].moment_nm[1]) > _TURNS_FREELY_M * abs(bearings[number].force_n[2])
    }
    holds = list(above.values())
    return [number for number, body in above.items() if body in held | turned or holds.count(body) > 2]


def other_seed(scenario: Scenario, number: int = 1) -> int:
    """Return the seed of another cut, counted from the scenario's own."""
    return (scenario.seed + number) % (LARGEST_INTEGER + 1)


def next_cut(scenario: Scenario, model: Model, number: int = 1) -> Model | None:
    """Return the bridge cut by another seed, counted from its own; None where that cuts it alike."""
    cut = build_model(replace(scenario, seed=other_seed(scenario, number)), model.members)
    return None if np.array_equal(cut.centres_m, model.centres_m) else cut


def bearing_ranges(scenario: Scenario, model: Model, count: int) -> BearingRanges:
    """Return what the bearings of an elastic bridge carry in a number of cuts: by its seed, and by the next ones.

    Raises
    ------
    ScenarioError
        The bridge has no bearings, or every seed cuts it alike.
    """
    if model.bearings is None:
        raise ScenarioError("there are no [[bearings]] or [bridge.bearings]: expected some whose cuts can be compared")
    seeds = tuple(other_seed(scenario, number) for number in range(count))
    axes: tuple[BearingAxis, ...] = ()
    forces_n = []
    for number, seed in enumerate(seeds):
        cut = next_cut(scenario, model, number) if number else model
        if cut is None:
            raise ScenarioError(
                f"scenario.seed {seed} cuts the bridge as {scenario.seed} does: expected members that the seed cuts, "
                "not ones in single shards or with fracture.points"
            )
        rest = model_at_rest(cut, scenario.joints)
        cracked = (
            cracked_by_weight(cut, scenario.joints, rest) if overloaded(cut, rest, scenario.joints).any() else None
        )
        if cracked and cracked.fallen.any():
            continue
        bearings = given(cut.bearings).forces(cracked.loads if cracked else loads_of(cut, rest))
        axes = axes or bearing_axes(cut, bearings)
        forces_n.append([float(bearing.force_n[2]) for bearing in bearings])
    names = model.bearings.names
    return BearingRanges(names, axes, seeds, np.array(forces_n).reshape(-1, len(names)))


def _upwards_n(model: Model, rest: Equilibrium) -> np.ndarray:
    """Upward forces (b,) of the bearings of a model at rest."""
    return np.array([bearing.force_n[2] for bearing in given(model.bearings).forces(loads_of(model, rest))])


def _range_text(forces_n: np.ndarray) -> str:
    least, largest, mean = (_KILO * float(value) for value in (forces_n.min(), forces_n.max(), forces_n.mean()))
    return f"{least:z.0f} to {largest:z.0f} kN up, {mean:z.0f} kN in the mean"


def _common_name(names: Sequence[str]) -> str:
    """Return the words that names of members begin with alike; else all of them."""
    unique = list(dict.fromkeys(names))
    words = [alike[0] for alike in zip(*(name.split() for name in unique), strict=False) if len(set(alike)) == 1]
    return " ".join(words) or ", ".join(unique)
