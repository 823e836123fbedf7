# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of a beam in Blender, and how its middle moves."""

import numpy as np

from bridge_demolition_addon.scene.demolition import build_demolition
from bridge_demolition_addon.simulation.playback import Playing
from bridge_demolition_addon.simulation.recording.recorder import Recording


def played(blender, folder, beam):
    """The recording of a run, and how far the middle of the beam has risen since it was built, (k,)."""
    build_demolition(blender.context.scene, beam.scenario, beam.model)
    playing = Playing(Recording(blender.context.scene, folder))
    while not playing.finished:
        playing.step()
    playing.end()
    results = playing.recording.results()
    inventory = results.inventory
    deck = np.flatnonzero(inventory.body_members == "deck")
    built_m = results.frames.positions_m[0, deck]
    order = np.argsort(built_m[:, 0])
    heights = results.frames.positions_m[:, deck[order], 2]
    middle_m = beam.first_m + beam.span_m / 2.0
    rises = [np.interp(middle_m, built_m[order, 0], height - built_m[order, 2]) for height in heights]
    return playing.recording, results, np.array(rises)
