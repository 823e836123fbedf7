"""Buttons for charges and for what pushes the shards."""

from dataclasses import replace

import bpy
from bpy.props import BoolProperty

from ...engineering.blast.wave import Burst
from ...model.blast.charges import Charge
from ...model.blast.settings import Apply
from ...model.scenario import BlastSettings
from ...scene.blast.charges import charge_collection, charge_objects, create_charges, keep_blast
from ...scene.blast.force_fields import BuildCount, build_force_objects
from ...scene.bodies import Kind, bodies_of, kind_of
from ...scene.visibility import hide_symbols, symbols_are_hidden
from ..languages.words import translated
from ..operators import UndoableAction, no_world
from ..scenario.values import table_of
from ..scene_units import mass_text
from .place import place_of_new
from .prop import shown_charge

_NEW_CHARGE_KG = 10.0


def keep_shown_blast(scene: bpy.types.Scene) -> None:
    """Keep the blast as the sidebar shows it in the scene, for the next recording."""
    keep_blast(scene, table_of(scene.bda.scenario.blast, BlastSettings))


def build_missing_fields(scene: bpy.types.Scene) -> None:
    """Give shards that were added since the last time a force field, where charges push them by one."""
    blast = table_of(scene.bda.scenario.blast, BlastSettings)
    if blast.explosion and blast.apply == Apply.FIELDS and charge_objects(scene):
        build_fields(scene, bpy.context.view_layer)


def build_fields(scene: bpy.types.Scene, layer: bpy.types.ViewLayer) -> BuildCount:
    """Give each shard that lacks one a force field, which is hidden where the others are."""
    hidden = symbols_are_hidden(layer, scene)
    built = build_force_objects(scene, bodies_of(scene))
    if hidden and built.made:
        hide_symbols(layer, scene, hidden=True)
    return built


def total_mass_kg(scene: bpy.types.Scene) -> float:
    """Return the mass of all active bodies but balls, kg."""
    active = [body for body in bodies_of(scene) if body.rigid_body.type == "ACTIVE"]
    return sum(body.rigid_body.mass for body in active if kind_of(body) != Kind.BALL)


class BDA_OT_add_source_point(UndoableAction, bpy.types.Operator):
    """Add a charge at the pier nearest to the 3D cursor, to be dragged as you like; called Add Source Point in 2019"""

    bl_label = "Add Charge"
    changes_objects = True

    at_pier: BoolProperty(
        name="At a Pier",
        description="Put it at the nearest pier, 1 m up, unless the 3D cursor is on the bridge; else at the 3D cursor",
        options={"SKIP_SAVE"},
    )

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        self.at_pier = True
        return self.execute(context)

    def act(self, context: bpy.types.Context) -> None:
        scene = context.scene
        number = len(charge_objects(scene)) + 1
        while f"Charge {number}" in bpy.data.objects:
            number += 1
        place = place_of_new(scene) if self.at_pier else None
        charge = Charge(name=f"Charge {number}", position_m=tuple(scene.cursor.location), mass_kg=_NEW_CHARGE_KG)
        if place:  # so near to the ground that it throws the wave back
            charge = replace(charge, position_m=place, burst=Burst.SURFACE.value)
        create_charges(scene, [charge])
        scene.bda.charge_index = len(charge_collection(scene).objects) - 1


def _none_chosen(context: bpy.types.Context) -> str | None:
    return "Choose a charge in the list first" if shown_charge(context.scene) is None else None


class BDA_OT_delete_source_point(UndoableAction, bpy.types.Operator):
    """Delete the charge that is chosen in the list"""

    bl_label = "Delete"
    changes_objects = True
    blocked_by = (_none_chosen,)

    def act(self, context: bpy.types.Context) -> None:
        settings = context.scene.bda
        bpy.data.objects.remove(shown_charge(context.scene))
        settings.charge_index = min(settings.charge_index, max(len(charge_collection(context.scene).objects) - 1, 0))


class BDA_OT_build_force_objects(UndoableAction, bpy.types.Operator):
    """Give every shard a force field, through which the blast pushes it; called Build Force Objects in 2019"""

    bl_label = "Build Force Fields"
    changes_objects = True
    blocked_by = (no_world,)

    def act(self, context: bpy.types.Context) -> str:
        keep_shown_blast(context.scene)
        built = build_fields(context.scene, context.view_layer)
        return f"{built.made} force fields made, {built.kept} kept, {built.removed} removed"


class BDA_OT_show_total_mass(UndoableAction, bpy.types.Operator):
    """Add up the masses of all active bodies but the ball; called Show Total Mass of Particles in 2019"""

    bl_label = "Total Mass"
    blocked_by = (no_world,)

    def act(self, context: bpy.types.Context) -> str:
        context.scene.bda.total_mass = mass_text(total_mass_kg(context.scene))
        return translated("Total mass: {}").format(context.scene.bda.total_mass)
