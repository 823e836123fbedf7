"""Whether the bridge stands, in the panel Scenario: worked out as it is built or by a button, never while drawing."""

from __future__ import annotations

import bpy

from ...errors import DemolitionError
from ...model.sequence.checked_model import checked_model
from ...model.stages.stability import COMES_DOWN, STANDS, Stability
from ...model.stages.stability_by_statics import stability_of
from ...scene.as_built import has_all_bodies
from ...scene.stability import keep_stability, kept_stability
from ..operators import Action, recording_runs, unset
from ..sidebar import draw_sentence
from .built import changes
from .values import scenario_of

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
    """Return whether there is a bridge of which a verdict can be: all that was built is still there."""
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
