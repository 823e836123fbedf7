"""The line above the buttons that says what comes next."""

from __future__ import annotations

import bpy

from ...simulation.blender_events import running_recording
from ...simulation.kept_run import has_run
from .built import changes


def next_step(scene: bpy.types.Scene) -> str:
    """Return in a sentence what to do next in a scene."""
    settings = scene.bda
    if recording := running_recording():
        if recording.error:
            return "The recording ended early: Stop Recording keeps what there is"
        return "It is being recorded: wait, or stop it"
    if not settings.built_scenario:
        return "Next: choose one of the Presets, or change values below; then Build Scenario"
    if changes(settings):
        return "Next: values have changed; Build Again and Run"
    if not has_run(scene):
        return "Next: Run, and watch it"
    return "Next: see Results and Post Processing below, and make a Report"
