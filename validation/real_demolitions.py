# SPDX-License-Identifier: GPL-3.0-or-later
"""Whole demolitions with published outcomes, one of which failed: what came down, and how long it took."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from blind import BlindCase, Foreseen
from blind_page import case_lines, compared

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.model.results.arrays import Results, load_results
from bridge_demolition_addon.model.results.collapse import spans_of
from bridge_demolition_addon.model.run_folder.files import SCENARIO_FILE
from bridge_demolition_addon.model.scenario import Scenario
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.schema import given

FOLDER = Path(__file__).resolve().parent / "demolitions"

SANK_M = 0.5
"""A pier on which the deck is lower by less stands: zones were 1.3 m high or higher."""

LOST_SHARE = 0.5
"""Part of its height that a span has lost when it is down, as in studies."""

ALMOST = 0.95
"""Part of the drop at which the deck counts as down: what follows is that debris settles."""


@dataclass(frozen=True, slots=True)
class Demolition:
    """A demolition: its files, what is foreseen of it, each from the runs of its study, and what its page says."""

    name: str
    place: str
    asked: Sequence[tuple[str, str, Callable[[Results, Scenario], float]]]
    happened: str
    foreseen: str
    cause: str


def spans_down(results: Results, scenario: Scenario) -> float:
    """Return how many spans lost half of their height."""
    spans = spans_of(results, given(scenario.bridge).span_lengths_m)
    return float(np.sum([span.heights_m[-1] < (1.0 - LOST_SHARE) * span.heights_m[0] for span in spans]))


def piers_that_stand(results: Results, scenario: Scenario) -> float:
    """Return on how many piers the deck is as high as it was, from half of one span to half of the next."""
    lengths = np.array(given(scenario.bridge).span_lengths_m)
    halves = np.concatenate([[0.0], lengths]) / 2.0 + np.concatenate([lengths, [0.0]]) / 2.0
    piers = {f"span {number}" for number in range(2, len(lengths) + 1)}  # as spans_of counts the parts
    of_piers = [part for part in spans_of(results, halves.tolist()) if part.name in piers]
    return float(np.sum([part.drop_m < SANK_M for part in of_piers]))


def time_down_s(results: Results, scenario: Scenario) -> float:
    """Return how long after the first charge the deck had come down."""
    (deck,) = spans_of(results)
    drops_m = deck.levels_m[0] - deck.levels_m
    down = int(np.argmax(drops_m >= ALMOST * drops_m[-1]))
    return float(results.frames.time_s[down]) - scenario.blast.start_s


DEMOLITIONS = (
    Demolition(
        "liebenstein",
        "Liebensteinspeicher",
        [("piers that stand, of 5", "", piers_that_stand), ("spans down, of 6", "", spans_down)],
        happened="It failed. 65 kg in five low piers went off as planned on 10 December 2021; the outer two sank, the "
        "three between stood as if nothing had happened, and the deck bent a little. An adviser of the blasters: "
        "perhaps the piers were too low to fold.",
        foreseen="The failure is not foreseen: all piers fail, and four or five of six spans come down, in each of "
        "three runs. `bda check` says of each zone, before any run, that what is above it can land upright on its "
        "stub and stand, and that a second zone would let it fold. That is no forecast either: it says the like of the "
        "other two bridges, which came down.",
        cause="The zone throws all its concrete out as soon as its charge a volume is above a threshold that is known "
        "within a factor of two; a wall of 1 m takes 13 kg over a height that no source has, and with a higher zone "
        "or a larger wall the concrete stays in its bars. Whether the three piers had concrete left was not reported.",
    ),
    Demolition(
        "oehringhausen",
        "Öhringhausen",
        [("spans down, of 5", "", spans_down), ("deck down after the first charge", "s", time_down_s)],
        happened="On 28 April 2018 it came down upright over its whole length: after half a second the charges had "
        "done their work, and one second later it lay in its bed. The machines were on the rubble half an hour later.",
        foreseen="Three or four of five spans come down, in 2.5 to 3.1 s. In two runs the first and the last stay on "
        "their abutments and lose a sixth of their height, in the third the last comes down as well.",
        cause="Free fall over 11 m takes 1.5 s, so that the deck is held on its way: columns land on stubs and stand, "
        "and abutments that cannot move hold the end spans. What was reported is a newspaper's count of seconds.",
    ),
    Demolition(
        "salzbachtal",
        "Salzbachtal, southern bridge",
        [("spans down, of 5", "", spans_down), ("deck down after the first charge", "s", time_down_s)],
        happened="On 6 November 2021 the southern one of two bridges came straight down over its whole length, and "
        "the northern one tilted onto it 2 s later; all was over in 3 s.",
        foreseen="All five spans come down in two of three runs, in 5.5 and 6.1 s. In the third nothing falls: there "
        "the columns were drawn 2.1 m long.",
        cause="The mass of explosive is known, the columns are not: in those of 2.1 m it is 0.74 kg/m³, with which the "
        "model leaves the concrete as rubble between its bars, and the columns stand on it; in the others it is 0.85 "
        "and 0.92 kg/m³, and the concrete is thrown out. The time is that of what happened in the range of that run "
        "alone, else about twice as long: pieces of columns land on each other here, too.",
    ),
)


def foresee(folder: Path) -> Sequence[Foreseen]:
    """Foresee all of them."""
    return [one for demolition in DEMOLITIONS for one in _of_study(demolition, folder)]


def _of_study(demolition: Demolition, folder: Path) -> Iterator[Foreseen]:
    """Run the study of a demolition, one run after the other; yield the median of its runs and their range."""
    output = folder / demolition.name
    status = main(["study", str(FOLDER / f"{demolition.name}_study.toml"), "--output", str(output), "--jobs", "1"])
    if status:
        raise RuntimeError(f"the study of {demolition.name} ended with {status}")
    runs = [(load_results(path), read_scenario(path.parent / SCENARIO_FILE)) for path in _kept(output)]
    for quantity, unit, value_of in demolition.asked:
        values = [value_of(*run) for run in runs]
        low, middle, high = (round(float(value), 3) for value in (min(values), np.median(values), max(values)))
        yield Foreseen(f"{demolition.place}: {quantity}", unit, middle, low, high)


def _kept(output: Path) -> list[Path]:
    return sorted(output.rglob("results.npz"))


CASE = BlindCase(
    name="real_demolitions",
    title="Three demolitions, three runs of each",
    asked="Three bridges were brought down by charges in their piers, or were to be: what comes down, and how soon?",
    known="What happened was known as the files were written: a forecast that is not blind in the strict sense. But "
    "all cases share one file of settings, `defaults.toml`, and no run of them was looked at before this forecast was "
    "kept. An earlier model of Öhringhausen, with other settings, had been run.",
    assumed="Sizes and charges that no source has, over a range that is likely; three runs of each, of which the "
    "median is the forecast, and the least and the most are its range. Sub-steps are up to four times as long as "
    "by default, for the time that runs take.",
    source="Newspapers and pages of owners and contractors, named in each file.",
    foresee=foresee,
)

DOCUMENT = FOLDER.parent.parent / "docs" / "real_demolitions.md"

_HEAD = """# Real demolitions

<!-- Made by `scripts/validate --page`: change validation/real_demolitions.py instead. -->

Whole demolitions whose outcomes were published, held against what this program foresees of them, those that failed
too. Files, with sources, what is known and what is guessed: [validation/demolitions](../validation/demolitions). All
share one file of settings, nothing is fitted to one of them, and a miss stays.

**{hits} of {all} quantities are within the range of the runs.** Do not rely on a run for whether a part stands or for
how long a fall takes, before these are better: hold it against statics and practice.
"""


def page() -> str:
    """Return the page of real demolitions."""
    pairs = list(compared(CASE.name))
    hits = sum(foreseen.has(measured) for foreseen, measured in pairs)
    lines = [_HEAD.format(hits=hits, all=len(pairs))]
    for demolition in DEMOLITIONS:
        lines += [f"## {demolition.place}", "", f"*What happened*: {demolition.happened}", ""]
        lines += [f"*What the runs say*: {demolition.foreseen}", "", f"*Why, as far as we see*: {demolition.cause}", ""]
        file = f"validation/demolitions/{demolition.name}.toml"
        lines += [f"[{file}](../{file})", ""]
    text = "\n".join([*lines, *case_lines(CASE)]).replace("### ", "## ")
    return text.rstrip() + "\n"
