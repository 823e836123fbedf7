"""Sentences on the scenario in the sidebar: how to begin, the next step, whether it stands, what undo has done.

Undo makes another world of rigid bodies, which knows no frame but its first: going on from the middle would crash
Blender, so `simulation.crash_guards.safe_undo` goes back.
"""

from __future__ import annotations

from pathlib import Path

import bpy
from bpy.app.handlers import persistent

from ...errors import DemolitionError, OutputError
from ...model.results.stability import COMES_DOWN, STANDS, Stability
from ...model.scenario.connections import LARGE_MODEL, MATERIAL_OF_LARGE_MODELS
from ...model.scenario.contacts import QUANTITIES
from ...model.scenario.joint_settings import STRENGTH_KEYS
from ...model.sequence.checked_model import checked_model
from ...model.stages.stability import stability_of
from ...scene.as_built import has_all_bodies, keep_stability, kept_stability
from ...simulation.blender_events import running_recording, shown_results
from ...simulation.kept_run import has_run
from ..languages.words import translated
from ..operators import Action, recording_runs, unset
from ..results.operator import open_path
from ..results.shown_run import shown_run
from ..sidebar import draw_sentence
from ..stages import show_checked
from .built import changes, is_emptied
from .prop import USE
from .values import scenario_of

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
    if _was_stopped(scene):
        return "Next: Run again to its end, as a run that was stopped says too little; what it has is in Results below"
    return "Next: see Results below, and make a Report"


def _was_stopped(scene: bpy.types.Scene) -> bool:
    try:
        run = shown_run(scene)
    except OutputError:  # the panel Results says so
        return False
    return run is not None and not run.summary.completed


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


_ICONS = {STANDS: "CHECKMARK", COMES_DOWN: "ERROR"}


def _has_changed(context: bpy.types.Context) -> str | None:
    return "Values have changed since the scene was built: build it again" if changes(context.scene.bda) else None


class BDA_OT_does_it_stand(Action, bpy.types.Operator):
    """Work out by statics whether the bridge as it was built stands under its own weight, and its load factor"""

    bl_label = "Does It Stand?"
    blocked_by = (
        unset("built_scenario", "Nothing is built here yet: build the scenario"),
        recording_runs,
        _has_changed,
    )

    def act(self, context: bpy.types.Context) -> str:
        scenario = scenario_of(context.scene.bda)
        stability = stability_of(scenario, checked_model(scenario))
        keep_stability(context.scene, stability.to_json())
        return stability.sentence


def draws_verdict(scene: bpy.types.Scene) -> bool:
    """Return whether there is a bridge to give a verdict on: all that was built is still there."""
    return bool(scene.bda.built_scenario) and has_all_bodies(scene)


def draw_stability(layout: bpy.types.UILayout, context: bpy.types.Context) -> None:
    """Draw the verdict that is kept with a scene that is built, and the button that works it out in full."""
    scene = context.scene
    if not draws_verdict(scene):
        return
    try:
        kept = kept_stability(scene)
        stability = Stability.of_json(kept) if kept else None
    except (DemolitionError, KeyError, TypeError):  # the custom property was edited: the button writes it again
        stability = None
    if stability and not changes(scene.bda):
        for text in stability.unusual:
            draw_sentence(layout, context, text, icon="ERROR")
        draw_sentence(layout, context, stability.sentence, icon=_ICONS.get(stability.verdict, "QUESTION"))
        if stability.is_asleep:
            draw_sentence(layout, context, stability.asleep_sentence, icon="INFO")
    layout.operator("bda.does_it_stand", icon="QUESTION")


_frames_before: dict[int, int] = {}
"""The frame of each scene as an undo or redo begins, by the scene's number of this session."""

_put_back: dict[int, int] = {}
"""The start frame of scenes whose timeline was put there."""


def undo_note(scene: bpy.types.Scene) -> str:
    """Return the sentence as long as the timeline stays where undo has put it; empty otherwise."""
    if scene.rigidbody_world and _put_back.get(scene.session_uid) == scene.frame_current:
        if shown_results(scene).are_loaded:
            return translated("Undo put the timeline to its start: it plays what was recorded")
        return translated("Undo began the simulation again: the timeline is at its start, and plays as before")
    _put_back.pop(scene.session_uid, None)
    return ""


@persistent
def _before(*_: object) -> None:
    _frames_before.clear()
    _frames_before.update((scene.session_uid, scene.frame_current) for scene in bpy.data.scenes)


@persistent
def _after(*_: object) -> None:
    for scene in bpy.data.scenes:
        show_checked(scene)
        world, before = scene.rigidbody_world, _frames_before.get(scene.session_uid)
        if world and before is not None and before > scene.frame_current == world.point_cache.frame_start:
            _put_back[scene.session_uid] = scene.frame_current


_HANDLERS = {"undo_pre": _before, "redo_pre": _before, "undo_post": _after, "redo_post": _after}


def register() -> None:
    """Follow undo; to be called after the guards of the simulation, which put the timeline back."""
    for name, handler in _HANDLERS.items():
        getattr(bpy.app.handlers, name).append(handler)


def unregister() -> None:
    """Follow it no longer."""
    for name, handler in _HANDLERS.items():
        getattr(bpy.app.handlers, name).remove(handler)
    _frames_before.clear()
    _put_back.clear()
