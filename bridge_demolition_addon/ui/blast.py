"""Charges in the open, in the sidebar: their list, settings and buttons, and where a new one stands."""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import bpy
import numpy as np
from bpy.props import BoolProperty, EnumProperty, IntProperty, StringProperty

from ..engineering.blast.wave import Burst
from ..engineering.geometry.mesh import TriangleMesh, joined_meshes
from ..errors import DemolitionError
from ..model.blast.charges import EXPLOSIVES, Charge, is_on_bridge, place_at_pier
from ..model.blast.settings import Apply
from ..model.bridge.member import Member, is_standing
from ..model.bridge.mesh_files import placed_mesh
from ..model.bridge.parametric import bridge_members
from ..model.scenario import BlastSettings
from ..scene.blast.charges import (
    BURST,
    DELAY,
    EXPLOSIVE,
    MASS,
    charge_collection,
    charge_objects,
    create_charges,
    is_charge,
    keep_blast,
)
from ..scene.blast.force_fields import BuildCount, build_force_objects
from ..scene.bodies import Kind, bodies_of, kind_of, member_of, scaled_mesh
from ..scene.visibility import hide_symbols, symbols_are_hidden
from .languages.words import CONTEXT, translated
from .operators import UndoableAction, no_world
from .preview.decorator import sizes_shown
from .scenario.values import table_of
from .scene_units import mass_text
from .sidebar import SidebarPanel, letters_of
from .viewport import select_only


def place_of_new(scene: bpy.types.Scene) -> tuple[float, float, float] | None:
    """Return where a new charge is put at a pier, m; None where the 3D cursor is on the bridge, or there is no pier."""
    cursor_m = np.array(scene.cursor.location, float)
    pieces = _built(scene) or _shown(scene)
    boxes_m = [np.array((piece.solid.vertices.min(axis=0), piece.solid.vertices.max(axis=0))) for piece in pieces]
    if (
        cursor_m.any() and boxes_m and is_on_bridge(cursor_m, np.stack(boxes_m))
    ):  # it starts at the origin, where the user has not put it
        return None
    return place_at_pier([member.solid for member in _whole(pieces) if is_standing(member)], cursor_m)


def _built(scene: bpy.types.Scene) -> list[Member]:
    """Return each shard where it was built, as a piece of its member."""
    shards = [body for body in bodies_of(scene) if kind_of(body) == Kind.SHARD]
    return [Member(*member_of(shard), _placed(shard)) for shard in shards]


def _placed(shard: bpy.types.Object) -> TriangleMesh:
    """Return the triangles of a shard at its own position: the simulation moves it elsewhere, and not that."""
    mesh = scaled_mesh(shard)
    return TriangleMesh(mesh.vertices + np.array(shard.matrix_basis.translation), mesh.triangles)


def _shown(scene: bpy.types.Scene) -> list[Member]:
    """Return the members that the panels show; none of those that cannot be built."""
    bridge, _, own = sizes_shown(scene.bda)
    try:
        of_bridge = bridge_members(replace(bridge, merge=False)) if bridge and not own else ()
        return [*of_bridge, *(Member(table.name, table.kind, placed_mesh(table)) for table in own)]
    except (DemolitionError, ValueError):  # Build Scenario says why
        return []


def _whole(pieces: Sequence[Member]) -> list[Member]:
    """Return members put together of their pieces."""
    solids = defaultdict(list)
    for piece in pieces:
        solids[piece.name, piece.kind].append(piece.solid)
    return [Member(name, kind, joined_meshes(parts)) for (name, kind), parts in solids.items()]


_EXPLOSIVES = [
    (
        name,
        name,
        f"1 kg has the impulse of {explosive.tnt_by_impulse:g} kg of TNT, and the peak overpressure of "
        f"{explosive.tnt_by_pressure:g} kg",
    )
    for name, explosive in EXPLOSIVES.items()
]
_BURSTS = [
    (Burst.AIR.value, "Air", "It detonates in the air"),
    (Burst.SURFACE.value, "Surface", "It detonates on the ground, which throws the wave back"),
]


def shown_charge(scene: bpy.types.Scene) -> bpy.types.Object | None:
    """Return the charge that is chosen in the list, if there is one."""
    collection = charge_collection(scene)
    objects = collection.objects if collection else ()
    index = scene.bda.charge_index
    return objects[index] if index < len(objects) and is_charge(objects[index]) else None


def select_shown(settings: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    """Select the charge that was chosen in the list, and nothing else, so that it can be moved at once."""
    charge = shown_charge(settings.id_data)
    if charge is None or context.mode != "OBJECT" or charge.name not in context.view_layer.objects:
        return
    select_only(context, [charge])
    context.view_layer.objects.active = charge


def choice_of_charge(key: str, items: list[tuple[str, str, str]], name: str, description: str) -> Any:
    """Return a property that shows and sets one of a few values that the chosen charge keeps under a key."""
    identifiers = [item[0] for item in items]

    def shown(settings: bpy.types.PropertyGroup) -> int:
        charge = shown_charge(settings.id_data)
        value = charge.get(key) if charge else None
        return identifiers.index(value) if value in identifiers else 0

    def choose(settings: bpy.types.PropertyGroup, number: int) -> None:
        if charge := shown_charge(settings.id_data):
            charge[key] = identifiers[number]
            charge.update_tag()

    return EnumProperty(name=name, description=description, items=items, get=shown, set=choose)


class ChargeProperties:
    """The part of the scene's settings on its charges."""

    charge_index: IntProperty(
        name="Charge",
        description="The charge whose properties are shown below the list",
        min=0,
        update=select_shown,
    )
    charge_explosive: choice_of_charge(EXPLOSIVE, _EXPLOSIVES, "Explosive", "What the charge is made of")
    charge_burst: choice_of_charge(
        BURST,
        _BURSTS,
        "Burst",
        "Whether the charge detonates in the air, or on the ground, which throws the wave back",
    )
    charges_given: StringProperty(options={"HIDDEN"}, description="Charges as they were loaded, in JSON")
    total_mass: StringProperty(options={"HIDDEN"}, description="Mass of all active bodies but the ball")


_LETTERS_FOR_POSITIONS = 65
_LETTERS_FOR_ALL = 90
"""Width of the sidebar from which a row of the list shows more than name and mass."""
_SHARE_OF_NAME = 0.35
"""Of a row of the list: the rest is for numbers."""


class BDA_UL_charges(bpy.types.UIList):
    """The charges of the scene, one row for each."""

    def draw_item(self, context, layout, data, item, icon, active_data, active_property, index) -> None:
        """Name and mass always, the rest where the sidebar is wide enough for it."""
        letters = letters_of(context)
        halves = layout.split(factor=_SHARE_OF_NAME, align=True)
        halves.prop(item, "name", text="", emboss=False, icon="EMPTY_AXIS")
        row = halves.row(align=True)
        if not is_charge(item):
            row.label(text=translated("no charge"))
            return
        if letters >= _LETTERS_FOR_POSITIONS:
            for axis in range(3):
                row.prop(item, "location", index=axis, text="")
        row.prop(item, f'["{MASS}"]', text="kg", translate=False)
        if letters >= _LETTERS_FOR_ALL:
            row.prop(item, f'["{DELAY}"]', text="")
            row.label(text=str(item.get(EXPLOSIVE, "")))


class BDA_PT_explosion(SidebarPanel, bpy.types.Panel):
    """Charges that lie bare, and whether they go off; called Explosion in 2019."""

    bl_label = "Charges in the Open"

    def draw(self, context: bpy.types.Context) -> None:
        layout, settings = self.layout, context.scene.bda
        layout.prop(settings.scenario.blast, "explosion", text="Explosion")
        collection = charge_collection(context.scene)
        if collection:
            layout.template_list("BDA_UL_charges", "", collection, "objects", settings, "charge_index", rows=3)
        row = layout.row(align=True)
        row.operator("bda.add_source_point")
        row.operator("bda.delete_source_point")
        charge = shown_charge(context.scene)
        if charge:
            self._draw_charge(settings, charge)
        layout.operator("bda.build_force_objects")
        layout.operator("bda.show_total_mass")
        if settings.total_mass:
            layout.label(text=translated("Total mass: {}").format(settings.total_mass), translate=False)

    def _draw_charge(self, settings: bpy.types.PropertyGroup, charge: bpy.types.Object) -> None:
        column = self.layout.column(align=True)
        for axis, name in enumerate("XYZ"):
            column.prop(charge, "location", index=axis, text=name)
        column.prop(charge, f'["{MASS}"]', text=translated("Mass") + " (kg)", translate=False)
        column.prop(charge, f'["{DELAY}"]', text="Delay", text_ctxt=CONTEXT)
        column.prop(settings, "charge_explosive")
        column.prop(settings, "charge_burst")


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
    """Return the total mass of active bodies without balls, kg."""
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
