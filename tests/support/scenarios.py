# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenarios that many tests start from."""

from dataclasses import replace

from support.checkout import I235_FILE

from bridge_demolition_addon.model.scenario.file import read_scenario

I235 = read_scenario(I235_FILE)
"""One span of the I-235 bridge, broken by a ball."""

SHORT_RUN = replace(
    I235,
    time=replace(I235.time, duration_s=0.5),
    fracture=replace(I235.fracture, shards=10),
    connections=replace(I235.connections, search_radius_m=3.0),
    ball=replace(I235.ball, drop_height_m=0.1, release_time_s=0.0),
    pictures=replace(I235.pictures, width_px=320, height_px=180),
)
"""A few large shards for a few frames, hit at once, and small pictures."""
