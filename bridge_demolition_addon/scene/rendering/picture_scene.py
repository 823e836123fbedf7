"""A scene for pictures alone: copies of what a run has moved, dressed for looks, and what is written in.

The scene of the run is not touched: no body, no motion and no frame that Blender has played changes.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix, Vector

from ...display.approaches import approaches
from ...display.crawlers import StandingRoom, ball_cranes, breaker_excavators, excavator_parts
from ...display.dressing import LOOKS_ONLY, DrawnPart, Stuff, joined_by_stuff, rod
from ...display.dust import Chips, are_steel, bent_bars, chips_of, puffs, touchdowns
from ...display.moved_surfaces import moved, parted
from ...display.road_furniture import road_furniture
from ...display.scale_bar import ScaleBar, scale_bar
from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.geometry.solids import box
from ...errors import OutputError
from ...model.results.arrays import Results
from ...model.scenario.recording import PictureSettings
from ..bodies import Kind, bodies_of, is_uneven_ground, kind_of, mesh_of
from ..tools.cables import drawn_cables
from ..tools.keyframes import curves_of
from .dust import raise_dust
from .materials import BUILT_AT, SurfaceMaterial, material_of, new_nodes
from .rough_faces import roughened
from .stills import pictures_rendered_in, render_picture
from .surroundings import is_land, points_in_view, share_view

_HEIGHT, _SMALL, _LINE = 0.07, 0.048, 0.065
"""Heights of letters, and of the lowest line, as parts of the picture's height."""

_MARGIN = 0.03
_AWAY_M = 1.0

_SHADE, _BEHIND = 0.06, 1.0005
"""How far a dark copy lies below and beside each text, in heights of its letters, and behind it: on white walls white
words are read by it."""

_DECIMALS = 2


def time_text(time_s: float) -> str:
    """Return a time of a run as pictures show it."""
    return f"t = {time_s:.{_DECIMALS}f} s"


class Caption:
    """Texts that stand before the camera of a scene."""

    def __init__(self, scene: bpy.types.Scene, length: str, looks_only: str) -> None:
        camera = scene.camera
        corners = [Vector(corner) for corner in camera.data.view_frame(scene=scene)]
        scale = _AWAY_M / -corners[0].z
        right, left = max(c.x for c in corners) * scale, min(c.x for c in corners) * scale
        top, bottom = max(c.y for c in corners) * scale, min(c.y for c in corners) * scale
        height = top - bottom
        self._materials = _of_colour("Caption", 1.0), _of_colour("Caption shade", 0.01)
        margin, small, line = _MARGIN * height, _SMALL * height, _LINE * height
        place = (left + margin, bottom + margin + line)
        self._time = self._words(scene, "Time", place, _HEIGHT * height, "LEFT", time_text(0.0))
        self._words(scene, "Note", (left + margin, bottom + margin), small, "LEFT", looks_only)
        self._words(scene, "Scale", (right - margin, bottom + margin + line), small, "RIGHT", f"bar: {length}")

    def show_time(self, time_s: float) -> None:
        """Write the time of the run."""
        for text in self._time:
            text.data.body = time_text(time_s)

    def _words(
        self, scene: bpy.types.Scene, name: str, place: tuple[float, float], size: float, aligned: str, words: str
    ) -> list[bpy.types.Object]:
        """Add words and their dark copy behind them."""
        texts = []
        for suffix, material, off, away in zip(
            ("", " shade"), self._materials, (0.0, _SHADE * size), (_AWAY_M, _BEHIND * _AWAY_M), strict=True
        ):
            text = _text(scene, name + suffix, (place[0] + off, place[1] - off), size, aligned, material, away)
            text.data.body = words
            texts.append(text)
        return texts


def _text(
    scene: bpy.types.Scene,
    name: str,
    place: tuple[float, float],
    size: float,
    aligned: str,
    material: bpy.types.Material,
    away_m: float,
) -> bpy.types.Object:
    data = bpy.data.curves.new(name, "FONT")
    data.size, data.align_x, data.align_y = size, aligned, "BOTTOM"
    data.materials.append(material)
    text = bpy.data.objects.new(name, data)
    text.parent = scene.camera
    text.location = (*place, -away_m)
    text.visible_shadow = text.visible_diffuse = text.visible_glossy = False
    scene.collection.objects.link(text)
    return text


def _of_colour(name: str, brightness: float) -> bpy.types.Material:
    material = bpy.data.materials.new(name)
    material.diffuse_color = (brightness, brightness, brightness, 1.0)
    emission, output = new_nodes(material, "ShaderNodeEmission", "ShaderNodeOutputMaterial")
    emission.inputs["Color"].default_value = material.diffuse_color
    material.node_tree.links.new(emission.outputs[0], output.inputs["Surface"])
    return material


_OF_STUFF = {
    Stuff.CONCRETE: SurfaceMaterial.CONCRETE,
    Stuff.STEEL: SurfaceMaterial.STEEL,
    Stuff.ASPHALT: SurfaceMaterial.ASPHALT,
    Stuff.SOIL: SurfaceMaterial.SOIL,
    Stuff.WHITE: SurfaceMaterial.MARKING,
    Stuff.YELLOW: SurfaceMaterial.PAINT,
    Stuff.RED: SurfaceMaterial.RED_PAINT,
    Stuff.BLACK: SurfaceMaterial.BLACK_PAINT,
    Stuff.RUST: SurfaceMaterial.RUST,
    Stuff.SKIN: SurfaceMaterial.SKIN,
}
_OF_SHARDS = (SurfaceMaterial.CONCRETE, SurfaceMaterial.BROKEN_CONCRETE)
"""What shards are made of where they are built, whatever their density."""

_BROKEN = 1
"""Which of the materials of a shard is that of its cuts: `Finish.BROKEN`."""

_LAND_M = 3000.0
"""Half the side of the ground to the horizon, where it is flat."""


@contextmanager
def dressed_pictures(
    scene: bpy.types.Scene, results: Results, view: PictureSettings, *, has_bars: bool, is_captioned: bool = True
) -> Iterator[DressedScene]:
    """Give a scene of its own to take pictures of a run in; afterwards it is gone.

    `has_bars` says whether the bridge has reinforcement, which then sticks out where it broke. Where pictures are too
    small for words, `is_captioned` leaves them and the scale bar out: what shows such a picture has to say the rest.
    """
    dressed = DressedScene(scene, results, has_bars=has_bars)
    try:
        with pictures_rendered_in(dressed.scene, view):
            if is_captioned:
                dressed.put_caption_up()
            yield dressed
    finally:
        dressed.remove()


class DressedScene:
    """Copies of bodies at places of a run, and what is drawn with them for looks only."""

    def __init__(self, scene: bpy.types.Scene, results: Results, *, has_bars: bool) -> None:
        self._results, self._has_bars, self._of_run = results, has_bars, scene
        self.scene = bpy.data.scenes.new("Pictures")
        share_view(scene, self.scene)
        self._opened, self._of_steel = parted(results), are_steel(results.inventory)
        self._rows = {str(name): row for row, name in enumerate(results.inventory.body_names)}
        self._bodies: list[tuple[bpy.types.Object, bpy.types.Object, int]] = []
        self._carried: list[tuple[bpy.types.Object, int]] = []
        self._animated: list[tuple[bpy.types.Object, bpy.types.Object]] = []
        self._of_frame: list[bpy.types.Object] = []
        self._rough: dict[int, tuple[int, ...]] = {}
        self._caption: Caption | None = None
        self._show_bodies()
        self._show_others()
        beside = [*road_furniture(results), *approaches(results)]
        self._room = StandingRoom.of_run(results, beside)
        self._excavators = breaker_excavators(results, self._room)
        for body, made in self._add_parts(beside):
            if body is not None:
                self._carried.append((made, body))
        times = dict(zip(results.frames.number.tolist(), results.frames.time_s.tolist(), strict=True))
        broken = puffs(results, opened=self._opened)
        self._dust = raise_dust(self.scene, [*broken, *touchdowns(results)])
        self._chips: Chips = chips_of(broken, times, results.ground())
        self.bar: ScaleBar | None = None

    def render(self, frame: int, path: Path) -> None:
        """Render a frame of the run."""
        row = int(np.argmin(np.abs(self._results.frames.number - frame)))
        self._place(row, frame)
        render_picture(self.scene, frame, path)

    def put_caption_up(self) -> None:
        """Lay the scale bar; write time, scale and what is for looks only before the scene's camera."""
        self.bar = self._scale_bar()
        self._caption = Caption(self.scene, self.bar.text, LOOKS_ONLY)

    def remove(self) -> None:
        """Remove the scene and all that was made for it."""
        of_run = set(self._of_run.objects)
        made = [obj for obj in self.scene.collection.all_objects if obj not in of_run]
        collections = list(self.scene.collection.children)
        data = {obj.data for obj in made}
        materials = {slot.material for obj in made for slot in obj.material_slots if slot.material}
        actions = {obj.animation_data.action for obj in made if obj.animation_data}
        bpy.data.scenes.remove(self.scene)
        bpy.data.batch_remove(made)
        bpy.data.batch_remove(collections)
        for group in (data | actions, materials):
            bpy.data.batch_remove([part for part in group if part and not part.users])

    def _place(self, row: int, frame: int) -> None:
        frames = self._results.frames
        for original, copy, body in self._bodies:
            copy.matrix_world = Matrix.LocRotScale(
                Vector(frames.positions_m[row, body]), Matrix(frames.rotations[row, body]).to_quaternion(), copy.scale
            )
            copy.hide_render = _is_hidden(original, frame)
        hidden = {body for original, _, body in self._bodies if _is_hidden(original, frame)}
        for made, body in self._carried:
            turn = frames.rotations[row, body] @ frames.rotations[0, body].T
            origin = frames.positions_m[row, body] - turn @ frames.positions_m[0, body]
            made.matrix_world = Matrix.Translation(Vector(origin)) @ Matrix(turn).to_4x4()
            made.hide_render = body in hidden
        for moving in (*self._dust, *self._moving_cameras()):
            _set_to(moving, frame)
        for original, shown in self._animated:
            shown.hide_render = _is_hidden(original, frame)
        self._show_of_frame(row, frame, hidden)
        self._roughen(row)
        if self._caption:
            self._caption.show_time(float(frames.time_s[row]))

    def _show_of_frame(self, row: int, frame: int, hidden: set[int]) -> None:
        """Show what has another shape in every frame: ropes, arms, bars and chips."""
        _remove(self._of_frame)
        parts = ball_cranes(self._results, row, self._room)
        parts += excavator_parts(self._results, row, self._room, self._excavators)
        if self._has_bars:
            parts += [
                self._at(part, row) for part in bent_bars(self._results, self._opened[row]) if part.body not in hidden
            ]
        if (chips := self._chips.at(float(self._results.frames.time_s[row]))) is not None:
            parts.append(DrawnPart(Stuff.CONCRETE, chips))
        parts += self._cables(row, frame)
        self._of_frame = [made for _, made in self._add_parts(parts)]

    def _roughen(self, row: int) -> None:
        """Show the faces of connections that have broken by a row as rough."""
        inventory, frames = self._results.inventory, self._results.frames
        open_now = self._opened[row]
        for original, copy, body in self._bodies:
            touching = np.flatnonzero(open_now & (inventory.pairs == body).any(axis=1))
            is_ours = kind_of(original) == Kind.SHARD and BUILT_AT in original and not self._of_steel[body]
            if not is_ours or tuple(touching) == self._rough.get(body, ()):
                continue
            self._rough[body] = tuple(touching)
            turn, origin = frames.rotations[0, body], frames.positions_m[0, body]
            outwards = np.where(inventory.pairs[touching, 0] == body, 1.0, -1.0)[:, None]
            points = (inventory.points_m[touching] - origin) @ turn
            before = copy.data
            copy.data = (
                roughened(original.data, Vector(origin), points, outwards * inventory.normals[touching] @ turn, _BROKEN)
                if len(touching)
                else original.data
            )
            if before != original.data:
                bpy.data.meshes.remove(before)

    def _moving_cameras(self) -> list[bpy.types.Object]:
        camera = self.scene.camera
        return [camera] if camera and camera.name not in self._of_run.objects and camera.animation_data else []

    def _at(self, part: DrawnPart, row: int) -> DrawnPart:
        assert part.body is not None
        solid = TriangleMesh(moved(self._results, row, part.body, part.solid.vertices), part.solid.triangles)
        return DrawnPart(part.stuff, solid)

    def _cables(self, row: int, frame: int) -> list[DrawnPart]:
        cables = []
        for cable, shard, end in drawn_cables(self._of_run):
            if shard.name in self._rows and not _is_hidden(cable, frame):
                frames, body = self._results.frames, self._rows[shard.name]
                place = frames.positions_m[row, body] + frames.rotations[row, body] @ end
                cables.append(DrawnPart(Stuff.BLACK, rod(np.array(cable.location), place, 0.08)))
        return cables

    def _show_bodies(self) -> None:
        for body in bodies_of(self._of_run):
            if body.name not in self._rows or (kind_of(body) == Kind.GROUND and not is_uneven_ground(body)):
                continue
            copy = bpy.data.objects.new(body.name, body.data)
            copy.scale, copy.color = body.matrix_world.to_scale(), body.color
            if BUILT_AT in body:
                copy[BUILT_AT] = body[BUILT_AT]
            self.scene.collection.objects.link(copy)
            self._bodies.append((body, copy, self._rows[body.name]))
            if kind_of(body) == Kind.SHARD and self._of_steel[self._rows[body.name]]:
                _paint(copy)

    def _show_others(self) -> None:
        """Show what is no body: sun, zones, a site plan, what the user has added; and ground without an edge."""
        bodies = set(bodies_of(self._of_run))
        is_flat = not any(is_uneven_ground(body) for body in bodies)
        drawn = {cable for cable, *_ in drawn_cables(self._of_run)}
        for obj in self._of_run.objects:
            is_shown = obj not in bodies and obj not in drawn and obj.type != "EMPTY"
            if not is_shown or (is_flat and is_land(obj)):
                continue
            if obj.animation_data and obj.animation_data.action:
                self._animated.append((obj, self._copy(obj)))
            else:
                self.scene.collection.objects.link(obj)
        if is_flat:
            land = box((2.0 * _LAND_M, 2.0 * _LAND_M, 1.0), (0.0, 0.0, -0.5))
            self._add_parts([DrawnPart(Stuff.SOIL, land)])

    def _copy(self, obj: bpy.types.Object) -> bpy.types.Object:
        """Return a copy that stays, which is hidden frame by frame: a render of this scene alone would not know."""
        copy = obj.copy()
        copy.animation_data_clear()
        copy.matrix_world = obj.matrix_world
        self.scene.collection.objects.link(copy)
        return copy

    def _scale_bar(self) -> ScaleBar:
        points = points_in_view(self._of_run)
        if points is None:
            raise OutputError(f"scene {self._of_run.name!r} was not built here: choose pictures.renderer workbench")
        bar = scale_bar(points, self._results.ground())
        self._add_parts(bar.parts())
        return bar

    def _add_parts(self, parts: Sequence[DrawnPart]) -> list[tuple[int | None, bpy.types.Object]]:
        made = []
        for (body, stuff), solid in joined_by_stuff(list(parts)).items():
            mesh = mesh_of(f"Looks {stuff}", solid)
            mesh.materials.append(material_of(_OF_STUFF[stuff]))
            obj = bpy.data.objects.new(mesh.name, mesh)
            self.scene.collection.objects.link(obj)
            made.append((body, obj))
        return made


def _paint(copy: bpy.types.Object) -> None:
    """Show a shard of steel painted, where its own mesh is of no other material than those that all shards have."""
    known = {material_of(surface) for surface in _OF_SHARDS}
    for slot in copy.material_slots:
        if slot.material in known:
            slot.link = "OBJECT"
            slot.material = material_of(SurfaceMaterial.BRIDGE_PAINT)


def _is_hidden(obj: bpy.types.Object, frame: int) -> bool:
    """Return whether an object is hidden in pictures of a frame, also where that is animated."""
    if obj.animation_data and obj.animation_data.action:
        for curve in curves_of(obj.animation_data):
            if curve.data_path == "hide_render":
                return curve.evaluate(frame) > 0.5
    return bool(obj.hide_render)


def _set_to(obj: bpy.types.Object, frame: int) -> None:
    """Give an object the values that its animation has in a frame.

    A scene that no window shows has these in its renders only where they are set.
    """
    for curve in curves_of(obj.animation_data):
        value, owner = curve.evaluate(frame), getattr(obj, curve.data_path)
        if isinstance(owner, bool):
            setattr(obj, curve.data_path, value > 0.5)
        else:
            owner[curve.array_index] = value
        curve.mute = True


def _remove(objects: list[bpy.types.Object]) -> None:
    meshes = [obj.data for obj in objects]
    bpy.data.batch_remove(objects)
    bpy.data.batch_remove(meshes)
