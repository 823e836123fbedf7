"""Help in the sidebar: how to begin, the next step, and a note on what breaks the connections."""

from __future__ import annotations

from pathlib import Path

import bpy

from ...model.scenario.connections import LARGE_MODEL, MATERIAL_OF_LARGE_MODELS
from ...model.scenario.contacts import QUANTITIES
from ...model.scenario.joint_settings import STRENGTH_KEYS
from ...simulation.blender_events import running_recording
from ...simulation.kept_run import has_run
from ..languages.words import translated
from ..operators import Action
from ..results.operator import open_path
from ..sidebar import draw_sentence
from .built import changes, is_emptied
from .prop import USE

_PACKAGE = Path(__file__).parents[2]
_PAGES = (_PACKAGE / "walkthrough" / "walkthrough.html", _PACKAGE.parent / "docs" / "walkthrough.md")
"""In the extension, or in a checkout."""

SENTENCES = (
    "A preset fills in all values: change what is different in your bridge below.",
    "Build Scenario cuts the bridge into shards and connects them; charges and the ball can be moved.",
    "Run simulates it, and leaves forces and debris in a folder; Make Report makes a report of it.",
)


class BDA_OT_open_walkthrough(Action, bpy.types.Operator):
    """Open the walkthrough, a demolition by mouse step by step, in the system's browser; it came with the extension"""

    bl_label = "Walkthrough"
    changes_scene = False

    def act(self, _context: bpy.types.Context) -> None:
        open_path(walkthrough())


def walkthrough() -> Path:
    """Return the page of the walkthrough, which needs no network."""
    return next((page for page in _PAGES if page.is_file()), _PAGES[0])


def draw_first_help(layout: bpy.types.UILayout, context: bpy.types.Context) -> None:
    """Draw help for the first time, as long as nothing is built in the scene."""
    if context.scene.bda.built_scenario:
        return
    box = layout.box()
    for sentence in SENTENCES:
        draw_sentence(box, context, sentence, icon="DOT")
    box.operator("bda.open_walkthrough", icon="HELP")


def next_step(scene: bpy.types.Scene) -> str:
    """Return in a sentence what to do next in a scene."""
    settings = scene.bda
    if recording := running_recording():
        if recording.error:
            return "The recording ended early: Stop Recording keeps what there is"
        return "It is being recorded: wait, or stop it"
    if not settings.built_scenario and settings.scenario.geometry:
        return "Next: Build Scenario, or change values below"
    if not settings.built_scenario:
        return "Next: choose one of the Presets, or change values below; then Build Scenario"
    if is_emptied(scene):
        return "Next: nothing is left of what was built; Build Scenario builds it again"
    if changes(settings):
        return "Next: values have changed; Build Again and Run"
    if not has_run(scene):
        return "Next: Run, and watch it"
    return "Next: see Results below, and make a Report"


def breaking_note(scenario: bpy.types.PropertyGroup) -> str:
    """Return a sentence on what breaks the connections of a scenario; empty where its values say it."""
    connections, is_large = scenario.connections, scenario.fracture.shards >= LARGE_MODEL
    strengths = [name for name in STRENGTH_KEYS if getattr(connections, USE + name)]
    if not strengths:
        if is_large and connections.method == "face":
            sentence = translated("With {} shards or more they break by the strength of {}")
            return sentence.format(LARGE_MODEL, translated(MATERIAL_OF_LARGE_MODELS))
        return "Choose a breaking force, or a material with method face"
    if is_large and "material" not in strengths:
        return "One force for all: the finer the bridge is cut, the stronger it is. A material does not depend on it"
    return ""


def contact_note(scenario: bpy.types.PropertyGroup) -> str:
    """Return a sentence where single bodies have friction or restitution of their own; empty where pairs have it."""
    bodies = (scenario.shards, scenario.ground, *scenario.ground.surfaces, scenario.ball, *scenario.jackhammers)
    if any(getattr(body, USE + name, False) for body in bodies for name in QUANTITIES):
        return (
            "Single bodies have values of their own, and a contact has the products: untick them in the panels of "
            "shards, ground, ball and jackhammers to give pairs here"
        )
    return ""
