# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of the examples, whole or cut short, and what the tests of them measure."""

import json
import os
import signal
from contextlib import suppress
from dataclasses import dataclass, fields, is_dataclass, replace

import numpy as np
from support.checkout import ROOT, SEEDED

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.model.results.arrays import SHORT, Results, load_results, motion_digest
from bridge_demolition_addon.model.scenario import Scenario
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.sequence.ending import first_event_s
from bridge_demolition_addon.system.signals import Interrupted


@dataclass(frozen=True)
class ExampleRun:
    """An example that was run: scenario, summary and results."""

    scenario: Scenario
    summary: dict
    results: Results

    @property
    def shards(self):
        return self.results.inventory.of_kind("shard")

    @property
    def begins_s(self):
        """When the ball hits, or what else is done to the bridge begins; None where nothing is done."""
        if self.scenario.jackhammers:
            return self.scenario.jackhammers[0].start_time_s
        if self.scenario.charges or self.scenario.blast_zones:
            return self.scenario.blast.start_s
        if self.scenario.ball:
            return self.summary["impact"]["time_s"] if self.summary["impact"] else None
        begins_s = first_event_s(self.scenario)
        return begins_s if np.isfinite(begins_s) else None

    @property
    def hit_deck(self):
        """Name of the deck that the ball falls on."""
        deck = self.of_members("deck")
        apart_m = np.linalg.norm(self.results.frames.positions_m[0, deck, :2] - self.scenario.ball.target_m, axis=1)
        return self.results.inventory.body_members[deck[apart_m.argmin()]]

    def members_of(self, *names):
        """Indices of the shards of members, by the members' names."""
        return self.shards[np.isin(self.results.inventory.body_members[self.shards], names)]

    def of_members(self, *kinds):
        """Indices of the shards of kinds of members."""
        return self.shards[np.isin(self.results.inventory.body_member_kinds[self.shards], kinds)]

    def at(self, time_s):
        """Recorded step that begins a frame at a time or, where none does, the one after; the last of a run at rest."""
        times_s = self.results.frames.time_s
        return min(int(np.searchsorted(times_s, time_s - 1e-6)), len(times_s) - 1)

    def moved_m(self, bodies, step=-1):
        """How far bodies are from where they were at first, (n,) m."""
        return np.linalg.norm(
            self.results.frames.positions_m[step, bodies] - self.results.frames.positions_m[0, bodies], axis=1
        )

    def fallen_m(self, bodies, step=-1):
        """How far bodies have come down, (n,) m."""
        return self.results.frames.positions_m[0, bodies, 2] - self.results.frames.positions_m[step, bodies, 2]

    def throws_m(self, bodies):
        """How far bodies are on plan from where they were at first, (n,) m."""
        return np.linalg.norm(
            (self.results.frames.positions_m[-1, bodies] - self.results.frames.positions_m[0, bodies])[:, :2], axis=1
        )

    def outwards(self, charge, bodies, step):
        """Cosine of the angle between the velocity of each body and its direction from a charge, (n,)."""
        directions = self.results.frames.positions_m[0, bodies] - np.array(charge.position_m)
        velocities = self.results.frames.velocities_m_s[step, bodies]
        lengths = np.linalg.norm(directions, axis=1) * np.linalg.norm(velocities, axis=1)
        return (directions * velocities).sum(axis=1) / np.maximum(lengths, 1e-12)

    def near(self, charge, distance_m):
        """Shards whose centres of mass are at first within a distance of a charge."""
        positions = self.results.frames.positions_m[0, self.shards]
        return self.shards[np.linalg.norm(positions - np.array(charge.position_m), axis=1) < distance_m]


MEASURED_S = {
    "i235_one_span": 3.0,
    "i235_two_spans": 3.0,
    "i235_three_spans_between_decks": 3.0,
    "i235_three_spans_mid_span": 3.0,
    "i235_three_spans_near_end": 3.0,
    "i235_three_spans_neighbouring_deck": 3.0,
    "jackhammer_dismantling": 3.2,
    "single_span_explosives": 1.5,
    "two_spans_13m_explosives": 3.0,
    "two_spans_20m_at_once": 1.5,
    "two_spans_20m_delays": 1.5,
}
"""How much of an example its ranges over seeds are of; the others run whole."""

BEGINNINGS = {
    "arch_severed": 17,
    "composite_span_dropped": 15,
    "drilled_misfire": 22,
    "drilled_two_spans": 22,
    "drilled_two_spans_in_100_shards": 22,
    "drilled_viaduct_pier": 17,
    "excavator_on_the_deck": 27,
    "frame_leg_blasted": 17,
    "i235_one_span": 48,
    "i235_steps": 8,
    "i235_three_spans_between_decks": 48,
    "i235_three_spans_mid_span": 48,
    "i235_three_spans_near_end": 48,
    "i235_three_spans_neighbouring_deck": 48,
    "i235_two_spans": 48,
    "jackhammer_dismantling": 16,
    "single_span_awake": 12,
    "single_span_explosives": 13,
    "three_span_box_girder": 39,
    "two_spans_13m_ball": 29,
    "two_spans_13m_explosives": 46,
    "two_spans_20m_at_once": 12,
    "two_spans_20m_delays": 14,
}
"""How many frames of an example its tests run: until what is done to it has begun, and something came of it."""

VERSIONS = ROOT / "docs" / "data" / "seeds" / "versions.json"
"""How each example moved with its own seed as its ranges were measured: all of its run, and the beginning of it."""

FALL_S = 0.7
"""How long what a jackhammer has loosened has to fall, where an example is cut short."""


def example(name, duration_s=None, shards=None):
    """The scenario of an example, cut short where a duration is given, and in so many shards."""
    scenario = read_scenario(SEEDED[name])
    if shards:
        scenario = replace(scenario, fracture=replace(scenario.fracture, shards=shards))
    if not duration_s:
        return scenario
    hammers = [
        replace(jackhammer, end_time_s=min(jackhammer.end_time_s, duration_s - FALL_S))
        for jackhammer in scenario.jackhammers
    ]
    return replace(scenario, jackhammers=hammers, time=replace(scenario.time, duration_s=duration_s))


def motion_of(run):
    """The first digits of the digest of how everything moved and what broke."""
    return motion_digest(run.results)[:SHORT]


def motion_of_beginning(name, run):
    """The same of the beginning of an example, which may have run on."""
    frames = run.results.frames
    series = {field.name: getattr(frames, field.name) for field in fields(frames)}
    rows = slice(BEGINNINGS[name] + 1)
    cut = {part: values[rows] for part, values in series.items() if values is not None and not is_dataclass(values)}
    return motion_of(replace(run, results=replace(run.results, frames=replace(frames, **cut))))


def begun(name, session_folder):
    """The beginning of an example; what is measured of it is measured up to then.

    Its results are in the session's folder once a test has run it.
    """
    folder = session_folder / f"beginning of {name}"
    if not folder.exists():
        # Two processes may run it at once; the first that is done gives its folder the name.
        running = session_folder / f"{folder.name}, by {os.getpid()}"
        run_beginning(example(name, MEASURED_S.get(name)), BEGINNINGS[name], running)
        with suppress(OSError):
            running.rename(folder)
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    return ExampleRun(example(name, MEASURED_S.get(name)), summary, load_results(folder / "results.npz"))


class _Stopping(Silence):
    """Ends a run after so many frames, as a system does that shuts down; Ctrl-C is ignored in the background."""

    def __init__(self, frames):
        super().__init__()
        self._frames = frames

    def frame(self, done, total, connections, left_s):
        if done >= self._frames:
            signal.raise_signal(signal.SIGTERM)


def run_beginning(scenario, frames, folder):
    """Run so many frames of a scenario without pictures, and keep them in a folder."""
    from bridge_demolition_addon.simulation.run import run_scenario

    with suppress(Interrupted):
        run_scenario(scenario, folder, overwrite=True, pictures=False, progress=_Stopping(frames))


def run_example(scenario, folder):
    """Run a scenario without pictures."""
    from bridge_demolition_addon.simulation.run import run_scenario

    summary = run_scenario(scenario, folder / "run", overwrite=True, pictures=False, progress=Silence())
    return ExampleRun(scenario, summary, load_results(folder / "run" / "results.npz"))
