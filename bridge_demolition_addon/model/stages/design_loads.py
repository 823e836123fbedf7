"""Whether a bridge carries what its bars are designed for: 1.35 times its weight and 1.5 times its traffic."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ...engineering.reinforced_concrete.influence_lines import MovingLoad
from ...engineering.reinforced_concrete.traffic import Traffic
from ..bridge.layout import pier_axes
from ..scenario import Scenario
from ..scenario.reinforcement import BridgeReinforcement
from ..scenario.scenario import bars_by_rule
from ..schema import given
from ..structure.model import Model
from .stages import standing_loads
from .standing import StandingBridge

PERMANENT_FACTOR, TRAFFIC_FACTOR = 1.35, 1.5
"""EN 1990:2002, table A2.4(B), as for the bars: docs/reinforcement.md."""

_STEP_M = 0.5
"""Largest distance of the points at which an even load stands on the deck."""

_AXLE_M = 0.4
"""Length along the road on which an axle stands: EN 1991-2:2003, figure 4.2a."""


@dataclass(frozen=True, slots=True)
class DesignLoad:
    """Loads of the design in one position, and what the bridge carries of them."""

    name: str
    factor: float  # load factor at which it collapses, of weight and traffic with their factors; ∞ above some 47


def design_loads(
    scenario: Scenario, bridge: StandingBridge, progress: Callable[[int, int], None] = lambda done, of: None
) -> list[DesignLoad]:
    """Return what a bridge as it was built carries of 1.35 G + 1.5 Q; nothing without bars that are designed."""
    model = bridge.model
    intact, whole = np.ones(len(model.connections), bool), np.ones(len(model.connections))
    cases, found = list(load_cases(scenario, model)), []
    for number, (name, loads) in enumerate(cases, 1):
        found.append(DesignLoad(name, bridge.collapse_factor(intact, whole, loads) / PERMANENT_FACTOR))
        progress(number, len(cases))
    return found


def carries_design_loads(
    scenario: Scenario, bridge: StandingBridge, positions: Collection[str] = ()
) -> dict[str, bool]:
    """Return whether a bridge stands under 1.35 G + 1.5 Q, in some positions or in each: quicker than a load factor."""
    whole = np.ones(len(bridge.model.connections))
    return {
        name: not bridge.comes_down(whole > 0.0, whole, loads, PERMANENT_FACTOR).any()
        for name, loads in load_cases(scenario, bridge.model)
        if not positions or name in positions
    }


def design_load_sentences(loads: Sequence[DesignLoad]) -> Iterator[str]:
    """Yield a line for each position of the loads."""
    for load in loads:
        verdict = "it carries them" if load.factor >= 1.0 else "it does not carry them"
        factor = f"{load.factor:.2f}" if np.isfinite(load.factor) else "above 40"
        yield f"under 1.35 G + 1.5 Q, {load.name}: collapse load factor {factor}, {verdict}"


def load_cases(scenario: Scenario, model: Model) -> Iterator[tuple[str, np.ndarray]]:
    """Yield names of positions, and loads (6, n) on the shards on top of their weight.

    Weight and these together, times 1.35, are 1.35 G + 1.5 Q.
    """
    rule = bars_by_rule(scenario)
    if rule is None or not rule.is_designed:
        return
    bridge = given(scenario.weighed_bridge)
    traffic = rule.traffic(bridge.deck.width_m)
    axes = pier_axes(bridge).tolist()
    permanent = _even(model, axes[0], axes[-1], bridge.deck.width_m, 1e3 * rule.permanent_kn_m2)
    if traffic is None:
        yield "own weight alone", permanent
        return
    spans = list(pairwise(axes))
    loaded = [[number] for number in range(len(spans))]
    if not bridge.deck.per_span:
        loaded += [[number, number + 1] for number in range(len(spans) - 1)]
    if bridge.arch:
        first, last = bridge.arch.from_support - 1, bridge.arch.last_support(len(axes)) - 1
        loaded.append(list(range(first, (first + last + 1) // 2)))
    for numbers in loaded:
        name = f"{_described(rule)} on span {' and '.join(str(number + 1) for number in numbers)}"
        lengths = [spans[number] for number in numbers]
        yield name, permanent + TRAFFIC_FACTOR / PERMANENT_FACTOR * _traffic_loads(model, traffic, lengths)


def _described(rule: BridgeReinforcement) -> str:
    return rule.described.removeprefix("own weight and ").removeprefix("own weight, ")


def _traffic_loads(model: Model, traffic: Traffic, spans: Sequence[tuple[float, float]]) -> np.ndarray:
    """Return loads (6, n) of traffic: uniform on spans, the vehicle in the middle of the first."""
    begin, end = spans[0]
    heaviest = max(traffic.on_whole_width(), key=lambda load: _moment(load, end - begin))
    width = traffic.carriageway_m
    loads = _even(model, begin, spans[-1][1], width, heaviest.uniform_n_m / width)
    for force, offset in zip(heaviest.axles_n, _centred(heaviest), strict=True):
        middle = (begin + end) / 2.0 + offset
        if begin < middle < end:
            loads += _even(model, middle - _AXLE_M / 2.0, middle + _AXLE_M / 2.0, width, force / (_AXLE_M * width))
    return loads


def _moment(load: MovingLoad, span_m: float) -> float:
    """Return the moment in the middle of a simple span, N·m; below 0 for what counts over supports alone."""
    if load.hogging_only:
        return -1.0
    arms = np.maximum(span_m / 2.0 - abs(_centred(load)), 0.0) / 2.0
    return float(np.sum(np.array(load.axles_n) * arms)) + load.uniform_n_m * span_m**2 / 8.0


def _centred(load: MovingLoad) -> np.ndarray:
    """Positions of the axles along the road, with the middle of their forces at 0, m."""
    offsets, forces = np.array(load.offsets_m, float), np.array(load.axles_n, float)
    return offsets - (offsets @ forces) / (forces.sum() or 1.0) if len(offsets) else offsets


def _even(model: Model, begin_m: float, end_m: float, width_m: float, pressure_pa: float) -> np.ndarray:
    """Return loads (6, n) of a uniform load on the deck, between positions along the road, skewed as the deck is."""
    counts = [max(2, int(np.ceil(length / _STEP_M))) for length in (end_m - begin_m, width_m)]
    along = begin_m + (np.arange(counts[0]) + 0.5) / counts[0] * (end_m - begin_m)
    across = ((np.arange(counts[1]) + 0.5) / counts[1] - 0.5) * width_m
    x, y = (axis.ravel() for axis in np.meshgrid(along, across))
    deck = next(member for member in model.members if member.kind == "deck")
    points = deck.with_skew(np.column_stack((x, y, np.zeros_like(x))))[:, :2]
    weight_n = pressure_pa * (end_m - begin_m) * width_m / len(points)
    return standing_loads(model, points, weight_n, np.zeros(len(model.shards), bool))[0]
