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
from .cracking import cracked_by_weight
from .equilibrium import loads_of, model_at_rest, overloaded
from .model import Model, build_model
from .model_bearings import BearingForce

ONE_CUT = Text(
    "Single bearings are of this one cut: each seed shares what an axis carries "
    "otherwise, and bda check --cuts 5 says by how much."
)
"""What is said beside forces of bearings that may carry an axis together."""

LEAST_CUTS, MOST_CUTS = 2, 100

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
    """Yield what bearings carry, with the sum of each axis, and how far those that share it differ in another cut.

    Both cuts are compared without cracks, in which they are at `rest`. What each of two decks that meet over a pier
    lays on it, statics of that deck say alone: no other cut is made for it.
    """
    axes = bearing_axes(model, bearings)
    shared = [axis for axis in axes if _is_shared(model, axis)]
    together = [number for axis in shared for number in axis.bearings]
    other = next_cut(scenario, model) if shared else None
    own_n = _upwards_n(model, rest)
    more_n = np.zeros(len(own_n)) if other is None else _upwards_n(other, model_at_rest(other, scenario.joints)) - own_n
    for number, bearing in enumerate(bearings):
        along, across, up = _KILO * bearing.force_n
        lifted = "" if up else ": it has lifted off"
        text = f"{up:z.1f} kN up, {along:z.1f} kN along, {across:z.1f} kN across{lifted}"
        if other is not None and number in together:
            text += f"; {_KILO * more_n[number]:+.1f} kN up in another cut"
        yield bearing.name, text
    for axis in axes:
        sum_n = math.fsum(float(bearings[number].force_n[2]) for number in axis.bearings)
        yield axis.name, f"{_KILO * sum_n:z.1f} kN up in all"
    if other is not None:
        seed, largest = other_seed(scenario), max(float(own_n[list(axis.bearings)].mean()) for axis in shared)
        share = float(abs(more_n[together]).max()) / largest
        yield (
            "another cut",
            f"by seed {seed}: single bearings differ by up to {share:.1%} of what one of an axis carries",
        )
        yield "", "in the mean. bda check --cuts 5 compares more cuts"
        yield from _alike_cuts_facts(scenario, model)


def _alike_cuts_facts(scenario: Scenario, model: Model) -> Iterator[Fact]:
    """Yield how far off single bearings are where all seeds cut almost alike: another cut does not show it."""
    bridge = scenario.bridge
    if bridge is None or bridge.alignment or not (bridge.girders or model.has_lattices):
        return
    share = expected_single_deviation(bridge.skew_deg)
    if share is None:
        yield "known to within", "not measured with so much skew: 8% of each bearing at 25°. Cuts that are alike do not"
    else:
        yield (
            "known to within",
            f"{share:.0%} of each bearing, beside bricks and plates of OpenSees. Cuts that are alike do not",
        )
    yield "", "show what all of them leave out"


def _is_shared(model: Model, axis: BearingAxis) -> bool:
    """Return whether two bearings of an axis hold one body, of all that hangs together but for its bearings."""
    bearings, pairs = given(model.bearings), model.connections.pairs
    between = np.delete(pairs, bearings.springs.rows, axis=0)
    between = between[(between >= 0).all(axis=1)]
    body_of_shard = connected_parts(~model.fixed, *between.T)
    above = [int(body_of_shard[pairs[bearings.rows_of(number)[0], 0]]) for number in axis.bearings]
    return len(set(above)) < len(above)


def other_seed(scenario: Scenario, number: int = 1) -> int:
    """Return the seed of another cut, so many after the scenario's own."""
    return (scenario.seed + number) % (LARGEST_INTEGER + 1)


def next_cut(scenario: Scenario, model: Model, number: int = 1) -> Model | None:
    """Return the bridge cut by another seed, so many after its own; None where that cuts it alike."""
    cut = build_model(replace(scenario, seed=other_seed(scenario, number)), model.members)
    return None if np.array_equal(cut.centres_m, model.centres_m) else cut


def bearing_ranges(scenario: Scenario, model: Model, count: int) -> BearingRanges:
    """Return what the bearings of an elastic bridge carry in so many cuts: by its seed, and by those that follow.

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
    """Upward forces (b,) of all bearings of a model at rest."""
    return np.array([bearing.force_n[2] for bearing in given(model.bearings).forces(loads_of(model, rest))])


def _range_text(forces_n: np.ndarray) -> str:
    least, largest, mean = (_KILO * float(value) for value in (forces_n.min(), forces_n.max(), forces_n.mean()))
    return f"{least:z.0f} to {largest:z.0f} kN up, {mean:z.0f} kN in the mean"


def _common_name(names: Sequence[str]) -> str:
    """Return the words that names of members begin with alike; else all of them."""
    unique = list(dict.fromkeys(names))
    words = [alike[0] for alike in zip(*(name.split() for name in unique), strict=False) if len(set(alike)) == 1]
    return " ".join(words) or ", ".join(unique)
