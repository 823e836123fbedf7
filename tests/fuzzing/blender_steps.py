# SPDX-License-Identifier: GPL-3.0-or-later
"""Steps in Blender: the add-on's buttons and settings, mixed with Blender's own edits, undo, files and scenes.

In bare Blender, without the add-on, a demolition is built as mere data, what would be recorded is just played, and
mere settings are registered as the add-on is switched on, so that memory that Blender has freed is used again.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from random import Random
from typing import Any

import bpy
from support.checkout import SMALL, TESTS

import bridge_demolition_addon
from bridge_demolition_addon.errors import DemolitionError
from bridge_demolition_addon.model.scenario.file import read_scenario, scenario_text
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.scene.blast.charges import create_charges
from bridge_demolition_addon.scene.blast.force_fields import build_force_objects
from bridge_demolition_addon.scene.bodies import bodies_of
from bridge_demolition_addon.scene.demolition import build_demolition
from bridge_demolition_addon.scene.removal import remove_demolition, remove_loose_connections
from bridge_demolition_addon.scene.world import keep_played_frames, start_over
from bridge_demolition_addon.ui.contours import decorator as contours
from bridge_demolition_addon.ui.ground import decorator as ground
from bridge_demolition_addon.ui.preview import decorator as preview
from bridge_demolition_addon.ui.preview import handles
from bridge_demolition_addon.ui.scenario.prop import PRESETS

from .sequences import REFUSED, Player, WrongError

SCENARIOS = (SMALL, TESTS / "simulation" / "everything.toml")
SITE_PLAN = PRESETS / "span_of_2019_explosives.jpg"
"""Any picture."""

SHARDS, DURATION_S = 9, 0.6
LONGEST_FRAMES = 20

BUTTONS = {
    "build_scenario": 12,
    "build_anew": 3,
    "show_built": 2,
    "drag_handle": 3,
    "run": 6,
    "register_handler": 6,
    "unregister_handler": 5,
    "remove_demolition": 3,
    "remove_loose_connections": 2,
    "build_force_objects": 2,
    "add_source_point": 2,
    "delete_source_point": 2,
    "load_scenario": 2,
    "new_scenario": 1,
    "show_total_mass": 1,
    "toggle_symbols": 3,
    "draw_zone": 0.5,
    "lay_site_plan": 1,
    "raise_dust": 1,
    "settle_dust": 1,
    "bake": 2,
    "delete_bake": 2,
    "load_results": 3,
    "forget_results": 1,
    "load_preset": 2,
    "save_scenario": 1,
    "set_force_log": 1,
    "set_debris_log": 1,
    "add_selected_members": 1,
    "use_paint": 1,
    "add_table": 2,
    "remove_table": 1,
    "move_table": 1,
    "add_row": 2,
    "remove_row": 2,
    "look_at_bridge": 1,
    "dismiss_messages": 0.5,
    "make_workspace": 0.5,
    "go_to_body": 2,
    "go_to_peak": 0.3,
    "show_picture": 0.3,
    "compare_run": 1,
    "lay_over": 0.5,
    "forget_compared": 0.5,
    "section_at_shard": 0.5,
    "section_at_cursor": 1,
    "look_at_section": 0.5,
    "write_section": 0.3,
    "draw_charts": 0.1,
    "export_run": 0.1,
    "make_report": 0.1,
    "render_contours": 0.3,
    "render_run": 0.3,
    "check_stages": 0.5,
    "show_utilisation": 1,
    "import_ifc": 0.5,
}
"""How often each button is pressed. Those are not that open a window of the system: `open_...`."""

TEXTS = ("", "deck", "pier*", "[1, 2, 3]", "50% of $1 {x} \\ Ü", "not = [toml", "results", "//results", "no/x.toml")
LARGEST = 40
"""Of numbers, so that nothing takes minutes: shards, seconds, frames, pixels."""

SETTINGS = [
    type(
        f"Settings{number}",
        (bpy.types.PropertyGroup,),
        {"__annotations__": dict.fromkeys("abcde", bpy.props.FloatProperty())},
    )
    for number in range(130)
]
"""As many classes as the add-on has, which do nothing."""

MODES = ("EDIT", "SCULPT", "WEIGHT_PAINT", "VERTEX_PAINT", "TEXTURE_PAINT", "POSE")


class BlenderPlayer(Player):
    """Someone at work in Blender, with the add-on."""

    weights = {  # noqa: RUF012
        "press_a_button": 60,
        "change_a_setting": 12,
        "use_standard_settings": 8,
        "switch_add_on": 5,
        "play_frames": 25,
        "go_to_frame": 8,
        "go_to_start": 8,
        "delete_objects": 10,
        "remove_objects": 8,
        "edit_body": 6,
        "edit_connection": 6,
        "edit_world": 6,
        "edit_collections": 4,
        "edit_mesh": 3,
        "change_mode": 4,
        "duplicate_objects": 3,
        "add_object": 3,
        "rename_something": 3,
        "move_object": 3,
        "deface_properties": 3,
        "push_undo": 8,
        "undo": 7,
        "redo": 3,
        "save_and_open": 4,
        "link_scene": 2,
        "make_scene": 3,
        "choose_scene": 4,
        "delete_scene": 1,
        "change_layers": 2,
        "purge": 1,
        "update": 5,
        "look_at_drawings": 8,
        "render": 1,
    }
    first = ("use_standard_settings", "press_build")
    last = ("begin_another_file",)
    idle = "update"

    def __init__(self, folder: Path, *, bare: bool = False):
        super().__init__(folder, bare=bare)
        bpy.ops.wm.read_factory_settings(use_empty=True)
        self.scenarios = [_short(path, folder) for path in SCENARIOS]
        self.scenario = self.scenarios[0]
        self.is_on = False
        self._switch(on=True)

    def end(self) -> None:
        self._switch(on=False)

    # The add-on

    def press_build(self, random: Random) -> str:
        return self._press("build_scenario", random)

    def press_a_button(self, random: Random) -> str:
        return self._press(random.choices(list(BUTTONS), list(BUTTONS.values()))[0], random)

    def _press(self, button: str, random: Random) -> str:
        if not self.is_on:
            return "off"
        if self.bare:
            bpy.context.view_layer.update()  # as Blender does before and after an operator that a script calls
            done = self._do_without(button)
            bpy.context.view_layer.update()
            return done
        if button in ("run", "render_contours"):
            scene = bpy.context.scene
            scene.frame_end = min(scene.frame_end, scene.frame_start + LONGEST_FRAMES)
        if button == "build_scenario":
            fracture = bpy.context.scene.bda.scenario.fracture
            fracture.shards = min(fracture.shards, SHARDS)
        arguments = self._arguments(button, random)
        before = set(bpy.data.objects.keys())
        try:
            done = getattr(bpy.ops.bda, button)(**arguments)
        except RuntimeError as error:
            if "Traceback" in str(error):
                raise WrongError(f"{button} {arguments}: {error}") from error
            if set(bpy.data.objects.keys()) != before:
                raise WrongError(f"{button} {arguments} was refused and changed objects: {error}") from error
            return f"{button} {arguments}: {REFUSED}: {str(error).strip()}"
        return f"{button} {arguments}: {done}"

    def _arguments(self, button: str, random: Random) -> dict[str, Any]:
        names = [obj.name for obj in bpy.data.objects] or [""]
        lists = (
            "connections.between",
            "connections.joints",
            "fracture.members",
            "geometry",
            "removals",
            "nothing.here",
        )
        rows = ("bridge.span_lengths_m", "zones[0].corners_m", "bridge.merge", "nothing.here")
        arguments = {
            "load_preset": lambda: {
                "preset": random.choice(
                    ("span_of_2019_explosives", "reinforced_span_ball", "jackhammer_dismantling", "none")
                )
            },
            "save_scenario": lambda: {"filepath": self._path(random)},
            "set_force_log": lambda: {"filepath": self._path(random)},
            "set_debris_log": lambda: {"filepath": self._path(random)},
            "add_selected_members": lambda: {"directory": self._path(random)},
            "use_paint": lambda: {"filepath": self._path(random)},
            "add_table": lambda: {"path": "bda.scenario." + random.choice(lists)},
            "remove_table": lambda: {"path": "bda.scenario." + random.choice(lists)},
            "move_table": lambda: {
                "path": "bda.scenario." + random.choice(lists),
                "direction": random.choice(("UP", "DOWN")),
            },
            "add_row": lambda: {"path": "bda.scenario." + random.choice(rows)},
            "remove_row": lambda: {"path": "bda.scenario." + random.choice(rows), "number": random.randrange(3)},
            "run": lambda: {"pictures": random.random() < 0.2, "build_anew": random.random() < 0.3},
            "drag_handle": lambda: {
                "kind": random.choice(("TARGET", "DROP", "CHARGE")),
                "index": random.randrange(3),
                "is_upright": random.random() < 0.5,
                "position_m": [random.choice((-5.0, 0.0, 3.7, 1e6)) for _ in range(3)],
            },
            "import_ifc": lambda: {"filepath": self._path(random)},
            "go_to_body": lambda: {"body": random.choice(names), "frame": random.randrange(LONGEST_FRAMES)},
        }
        return arguments[button]() if button in arguments else {}

    def _path(self, random: Random) -> str:
        return random.choice(("", "//made", "made", str(self.folder / "made"), str(self.folder / "no" / "made.x"), "/"))

    def _do_without(self, button: str) -> str:
        """Do what is left of a button in bare Blender."""
        scene = bpy.context.scene
        if button == "build_anew" and scene.rigidbody_world and not scene.rigidbody_world.point_cache.is_baked:
            remove_demolition(scene)
        if button in ("build_scenario", "build_anew") and not scene.rigidbody_world and bpy.context.mode == "OBJECT":
            scenario = read_scenario(self.scenario)
            build_demolition(scene, scenario, checked_model(scenario))
        elif button == "add_source_point":
            create_charges(scene, [replace(read_scenario(self.scenarios[1]).charges[0], name="Charge")])
        elif button == "remove_demolition":
            remove_demolition(scene)
        elif button == "remove_loose_connections":
            remove_loose_connections(scene)
        elif button == "bake" and scene.rigidbody_world:
            keep_played_frames(scene)
        elif button == "delete_bake" and scene.rigidbody_world:
            with bpy.context.temp_override(scene=scene, point_cache=scene.rigidbody_world.point_cache):
                bpy.ops.ptcache.free_bake()
            scene.frame_set(scene.frame_start)
        elif button == "build_force_objects" and scene.rigidbody_world:
            build_force_objects(scene, bodies_of(scene))
        elif button in ("register_handler", "run") and scene.rigidbody_world:
            start_over(scene)
            if button == "run":
                _play(scene, min(scene.frame_end, scene.frame_start + LONGEST_FRAMES) - scene.frame_start)
        return f"without {button}"

    def use_standard_settings(self, random: Random) -> str:
        self.scenario = random.choice(self.scenarios)
        if self.bare or not self.is_on:
            return "off"
        settings, path = bpy.context.scene.bda, str(self.scenario)
        settings.scenario_path = path
        settings.output_directory = str(self.folder / "results")
        settings.film_directory = str(self.folder / "film")
        settings.results_path = str(self.folder / "results" / "results.npz")
        settings.compared_directory = str(self.folder / "results")
        settings.film_width, settings.film_height = 320, 180
        settings.scenario.pictures.width_px, settings.scenario.pictures.height_px = 64, 36
        settings.plan_picture = str(SITE_PLAN)
        settings.overwrite = True
        settings.contours = random.random() < 0.5
        return path

    def look_at_drawings(self, _random: Random) -> str:
        """Work out all that a 3D view would draw, as it does with every redraw."""
        if self.bare or not self.is_on:
            return "off"
        scene = bpy.context.scene
        drawn = [
            lambda: len(list(ground.drawn(scene, bpy.context.view_layer))),
            lambda: len(preview.preview_lines(scene.bda)),
            lambda: len(handles.handles(scene)),
            lambda: len(contours.vector_lines(scene)),
        ]
        return ", ".join(_drawn(part) for part in drawn)

    def change_a_setting(self, random: Random) -> str:
        if self.bare or not self.is_on:
            return "off"
        group = bpy.context.scene.bda
        while True:
            shown = [prop for prop in group.bl_rna.properties if prop.identifier != "rna_type" and not prop.is_hidden]
            item = random.choice(shown)
            if item.type == "POINTER":
                group = getattr(group, item.identifier)
            elif item.type != "COLLECTION":
                break
            elif len(tables := getattr(group, item.identifier)):
                group = random.choice(list(tables))
        value = _value(item, random)
        setattr(group, item.identifier, value)
        return f"{item.identifier} = {value!r}"

    def switch_add_on(self, random: Random) -> str:
        on = not self.is_on
        self._switch(on=on)
        if random.random() < 0.8 and not on:
            self._switch(on=True)
            return "off and on"
        return "on" if on else "off"

    def _switch(self, *, on: bool) -> None:
        if on == self.is_on:
            return
        self.is_on = on
        if self.bare:
            _switch_settings(on=on)
        else:
            (bridge_demolition_addon.register if on else bridge_demolition_addon.unregister)()

    # Time

    def play_frames(self, random: Random) -> str:
        count = random.randint(1, LONGEST_FRAMES)
        _play(bpy.context.scene, count)
        return f"{count} to {bpy.context.scene.frame_current}"

    def go_to_frame(self, random: Random) -> str:
        bpy.context.scene.frame_set(random.randint(-3, 2 * LONGEST_FRAMES))
        return str(bpy.context.scene.frame_current)

    def go_to_start(self, _random: Random) -> None:
        bpy.context.scene.frame_set(bpy.context.scene.frame_start)

    # Objects

    def delete_objects(self, random: Random) -> str:
        chosen = _chosen(random)
        _select(chosen)
        names = [item.name for item in chosen]
        bpy.ops.object.delete(use_global=random.random() < 0.2)
        return str(names)

    def remove_objects(self, random: Random) -> str:
        chosen = _chosen(random)
        names = [item.name for item in chosen]
        if random.random() < 0.5:
            bpy.data.batch_remove(chosen)
        else:
            for item in chosen:
                bpy.data.objects.remove(item)
        return str(names)

    def edit_body(self, random: Random) -> str:
        body = _one(random, lambda item: item.rigid_body)
        edits: tuple[Callable[[], Any], ...] = (
            lambda: setattr(body.rigid_body, "type", random.choice(("ACTIVE", "PASSIVE"))),
            lambda: setattr(body.rigid_body, "mass", random.choice((0.001, 1.0, 1e6))),
            lambda: setattr(body.rigid_body, "enabled", random.random() < 0.5),
            lambda: setattr(body.rigid_body, "kinematic", random.random() < 0.5),
            lambda: setattr(
                body.rigid_body, "collision_shape", random.choice(("MESH", "BOX", "CONVEX_HULL", "COMPOUND"))
            ),
            lambda: _with(body, bpy.ops.rigidbody.object_remove),
            lambda: _with(body, bpy.ops.rigidbody.object_add),
        )
        number = random.randrange(len(edits))
        edits[number]()
        return f"{body.name}, edit {number}"

    def edit_connection(self, random: Random) -> str:
        connection = _one(random, lambda item: item.rigid_body_constraint)
        rule, other = connection.rigid_body_constraint, random.choice(list(bpy.data.objects))
        edits: tuple[Callable[[], Any], ...] = (
            lambda: setattr(rule, "type", random.choice(("FIXED", "POINT", "HINGE", "GENERIC_SPRING", "MOTOR"))),
            lambda: setattr(rule, "object1", random.choice((None, other))),
            lambda: setattr(rule, "object2", random.choice((None, other))),
            lambda: setattr(rule, "breaking_threshold", random.choice((0.0, 1.0, 1e30))),
            lambda: setattr(rule, "use_breaking", random.random() < 0.5),
            lambda: setattr(rule, "enabled", random.random() < 0.5),
            lambda: setattr(rule, "disable_collisions", random.random() < 0.5),
            lambda: _with(connection, bpy.ops.rigidbody.constraint_remove),
            lambda: _with(other, bpy.ops.rigidbody.constraint_add),
        )
        number = random.randrange(len(edits))
        edits[number]()
        return f"{connection.name}, edit {number}"

    def edit_world(self, random: Random) -> str:
        scene = bpy.context.scene
        world = scene.rigidbody_world
        collection = random.choice([None, *bpy.data.collections])
        edits: tuple[Callable[[], Any], ...] = (
            lambda: bpy.ops.rigidbody.world_remove(),
            lambda: bpy.ops.rigidbody.world_add(),
            lambda: setattr(world, "enabled", random.random() < 0.5),
            lambda: setattr(world, "substeps_per_frame", random.randint(1, 12)),
            lambda: setattr(world, "time_scale", random.choice((0.0, 0.1, 1.0, 3.0))),
            lambda: setattr(world, "collection", collection),
            lambda: setattr(world, "constraints", collection),
            lambda: setattr(world.point_cache, "frame_start", random.randint(1, 5)),
            lambda: setattr(world.point_cache, "frame_end", random.randint(1, 30)),
            lambda: setattr(scene, "frame_start", random.randint(0, 5)),
            lambda: setattr(scene, "frame_end", random.randint(0, 30)),
            lambda: setattr(scene, "gravity", (0.0, 0.0, random.uniform(-20.0, 5.0))),
            lambda: setattr(scene, "use_gravity", random.random() < 0.5),
            lambda: setattr(scene.render, "fps", random.choice((1, 24, 60))),
            lambda: bpy.ops.ptcache.bake_all(bake=True),
            lambda: bpy.ops.ptcache.free_bake_all(),
        )
        number = random.randrange(len(edits))
        edits[number]()
        return f"edit {number}"

    def edit_collections(self, random: Random) -> str:
        scene, collection = bpy.context.scene, random.choice(list(bpy.data.collections))
        edits: tuple[Callable[[], Any], ...] = (
            lambda: scene.collection.children.unlink(collection),
            lambda: scene.collection.children.link(collection),
            lambda: setattr(collection, "hide_viewport", random.random() < 0.5),
            lambda: setattr(bpy.context.view_layer.layer_collection.children[collection.name], "exclude", True),
            lambda: bpy.data.collections.remove(collection),
            lambda: collection.objects.unlink(random.choice(list(collection.objects))),
            lambda: collection.objects.link(random.choice(list(bpy.data.objects))),
        )
        name, number = collection.name, random.randrange(len(edits))
        edits[number]()
        return f"{name}, edit {number}"

    def edit_mesh(self, random: Random) -> str:
        body = _one(random, lambda item: item.type == "MESH")
        edits: tuple[Callable[[], Any], ...] = (
            lambda: body.data.clear_geometry(),
            lambda: setattr(body, "data", random.choice(list(bpy.data.meshes))),
            lambda: body.data.transform(((2, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))),
            lambda: bpy.data.meshes.remove(body.data),
            lambda: body.modifiers.new("Modifier", random.choice(("SUBSURF", "MIRROR", "SOLIDIFY"))),
            lambda: body.vertex_groups.new(name="Group").add([0, 1, 2], 0.5, "REPLACE"),
        )
        name, number = body.name, random.randrange(len(edits))
        edits[number]()
        return f"{name}, edit {number}"

    def change_mode(self, random: Random) -> str:
        if bpy.context.mode != "OBJECT":
            if random.random() < 0.5 and bpy.context.mode == "EDIT_MESH":
                bpy.ops.mesh.select_all(action="SELECT")
                bpy.ops.mesh.delete(type=random.choice(("VERT", "FACE")))
            bpy.ops.object.mode_set(mode="OBJECT")
            return "OBJECT"
        body = _one(random, lambda item: item.type == "MESH")
        bpy.context.view_layer.objects.active = body
        bpy.ops.object.mode_set(mode=random.choice(MODES))
        return f"{bpy.context.mode} of {body.name}"

    def duplicate_objects(self, random: Random) -> str:
        chosen = _chosen(random)
        _select(chosen)
        bpy.ops.object.duplicate(linked=random.random() < 0.3)
        return str([item.name for item in chosen])

    def add_object(self, random: Random) -> str:
        added = random.choice(
            (bpy.ops.mesh.primitive_cube_add, bpy.ops.object.empty_add, bpy.ops.object.effector_add, _add_particles)
        )
        added()
        if random.random() < 0.5:
            bpy.ops.rigidbody.object_add()
        return str(bpy.context.object and bpy.context.object.name)

    def rename_something(self, random: Random) -> str:
        kind = random.choice((bpy.data.objects, bpy.data.objects, bpy.data.collections, bpy.data.scenes))
        data = random.choice(list(kind))
        before = data.name
        data.name = random.choice(("Ground", "Shard 000001", "x" * 63, "Ü $1 {}", before + "."))
        return f"{before} to {data.name}"

    def move_object(self, random: Random) -> str:
        data = _one(random)
        kind = random.choice(("location", "scale", "rotation_euler"))
        setattr(data, kind, [random.choice((0.0, -1.0, random.uniform(-5, 5))) for _ in range(3)])
        if random.random() < 0.3:
            data.keyframe_insert(kind, frame=random.randint(1, LONGEST_FRAMES))
        return f"{data.name}: {kind}"

    def deface_properties(self, random: Random) -> str:
        """Custom properties can be edited and deleted by hand, in Blender's own panel."""
        holders = [
            holder for holder in (*bpy.data.objects, *bpy.data.scenes, *bpy.data.collections) if _own_keys(holder)
        ]
        holder = random.choice(holders)
        key = random.choice(_own_keys(holder))
        if random.random() < 0.3:
            del holder[key]
            return f"{holder.name}: no {key}"
        holder[key] = random.choice(("", "nonsense", -1, 0, 1e300, [], [1.0], [1.0, 2.0, 3.0], "{}", "[[1]]", {"a": 1}))
        return f"{holder.name}: {key} = {holder[key]!r}"

    # Undo, files, scenes

    def push_undo(self, _random: Random) -> None:
        bpy.ops.ed.undo_push(message="step")

    def undo(self, random: Random) -> str:
        count = random.randint(1, 3)
        for _ in range(count):
            bpy.ops.ed.undo()
        return str(count)

    def redo(self, _random: Random) -> None:
        bpy.ops.ed.redo()

    def save_and_open(self, random: Random) -> str:
        path = str(self.folder / random.choice(("a.blend", "b.blend")))
        ways: dict[str, Callable[[], Any]] = {
            "save": lambda: bpy.ops.wm.save_as_mainfile(filepath=path),
            "save a copy": lambda: bpy.ops.wm.save_as_mainfile(filepath=path, copy=True),
            "open": lambda: bpy.ops.wm.open_mainfile(filepath=path),
            "revert": lambda: bpy.ops.wm.revert_mainfile(),
            "new": lambda: bpy.ops.wm.read_homefile(use_empty=True),
        }
        way = random.choices(list(ways), (4, 1, 3, 2, 1))[0]
        ways[way]()
        return f"{way} {path}"

    def begin_another_file(self, _random: Random) -> None:
        """Blender frees all that there is: some of what was wrong before ends in a crash here."""
        bpy.ops.wm.read_factory_settings(use_empty=True)
        _play(bpy.context.scene, 2)

    def link_scene(self, random: Random) -> str:
        path = self.folder / "linked.blend"
        bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)
        with bpy.data.libraries.load(str(path), link=random.random() < 0.7) as (stored, wanted):
            wanted.scenes = [random.choice(list(stored.scenes))]
        bpy.context.window.scene = wanted.scenes[0]
        return bpy.context.scene.name

    def make_scene(self, random: Random) -> str:
        kind = random.choice(("NEW", "EMPTY", "FULL_COPY"))
        bpy.ops.scene.new(type=kind)
        return f"{kind} {bpy.context.scene.name}"

    def choose_scene(self, random: Random) -> str:
        bpy.context.window.scene = random.choice(list(bpy.data.scenes))
        return bpy.context.scene.name

    def delete_scene(self, random: Random) -> str:
        scene = random.choice(list(bpy.data.scenes))
        name = scene.name
        bpy.data.scenes.remove(scene)
        return name

    def change_layers(self, random: Random) -> str:
        layers = bpy.context.scene.view_layers
        if len(layers) > 1 and random.random() < 0.5:
            layers.remove(layers[-1])
        else:
            bpy.context.window.view_layer = layers.new("Layer")
        return str(len(layers))

    def purge(self, _random: Random) -> None:
        bpy.ops.outliner.orphans_purge(do_recursive=True)

    def update(self, _random: Random) -> None:
        bpy.context.view_layer.update()

    def render(self, random: Random) -> None:
        render = bpy.context.scene.render
        render.engine, render.resolution_x, render.resolution_y = "BLENDER_WORKBENCH", 32, 18
        render.filepath = str(self.folder / "picture")
        if random.random() < 0.5:
            bpy.ops.render.render()
        else:
            scene = bpy.context.scene
            scene.frame_end = min(scene.frame_end, scene.frame_start + 3)
            bpy.ops.render.render(animation=True)


def _short(path: Path, folder: Path) -> Path:
    """Write a scenario of a few large shards and frames, and return the file."""
    scenario = read_scenario(path)
    scenario = replace(
        scenario,
        fracture=replace(scenario.fracture, shards=SHARDS),
        time=replace(scenario.time, duration_s=DURATION_S),
        weakenings=(),
        blast=replace(scenario.blast, start_s=0.2, apply="fields"),
    )
    short = folder / path.name
    short.write_text(scenario_text(scenario), encoding="utf-8")
    return short


def _drawn(draw: Callable[[], int]) -> str:
    """What was drawn, or why it was not, as the sidebar says it."""
    try:
        return str(draw())
    except DemolitionError as error:
        return str(error)


def _switch_settings(*, on: bool) -> None:
    for setting in SETTINGS:
        (bpy.utils.register_class if on else bpy.utils.unregister_class)(setting)


def _play(scene: bpy.types.Scene, count: int) -> None:
    for _ in range(count):
        scene.frame_set(scene.frame_current + 1)


def _one(random: Random, suits: Callable[[bpy.types.Object], Any] = bool) -> bpy.types.Object:
    return random.choice([obj for obj in bpy.data.objects if suits(obj)])


def _chosen(random: Random) -> list[bpy.types.Object]:
    """Choose a few objects, mostly of one kind."""
    word = random.choice(("Shard 0", "connection", "Ground", "ball", "Charge", "Force", ""))
    among = [obj for obj in bpy.context.view_layer.objects if word in obj.name] or list(bpy.data.objects)
    return random.sample(among, min(len(among), random.choice((1, 1, 1, 2, 3, 100))))


def _select(chosen: list[bpy.types.Object]) -> None:
    for obj in bpy.context.view_layer.objects:
        obj.select_set(obj in chosen)


def _with(chosen: bpy.types.Object, operator: Callable[[], Any]) -> None:
    bpy.context.view_layer.objects.active = chosen
    _select([chosen])
    operator()


def _add_particles() -> None:
    bpy.ops.mesh.primitive_plane_add()
    bpy.ops.object.particle_system_add()


def _own_keys(holder: bpy.types.ID) -> list[str]:
    return sorted(key for key in holder.keys() if key.startswith("bda_"))  # noqa: SIM118


def _value(item: bpy.types.Property, random: Random) -> Any:
    if item.type == "BOOLEAN":
        return random.random() < 0.5
    if item.type == "STRING":
        return random.choice(TEXTS)
    if item.type == "ENUM":
        names = [enum_item.identifier for enum_item in item.enum_items]
        return set(random.sample(names, random.randint(0, len(names)))) if item.is_enum_flag else random.choice(names)
    if item.is_array:
        return [_number(item, random) for _ in range(item.array_length)]
    return _number(item, random)


def _number(item: bpy.types.Property, random: Random) -> float:
    lowest, highest = max(item.hard_min, -LARGEST), min(item.hard_max, LARGEST)
    number = random.choice((lowest, highest, 0, 1, item.default, random.uniform(lowest, highest)))
    number = min(max(number, lowest), max(lowest, highest))
    return int(number) if item.type == "INT" else float(number)
