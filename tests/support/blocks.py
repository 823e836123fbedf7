# SPDX-License-Identifier: GPL-3.0-or-later
"""Small scenes of blocks and connections, whose forces statics gives by hand."""

from __future__ import annotations

from pathlib import Path

import bpy

from bridge_demolition_addon.engineering.geometry.solids import box
from bridge_demolition_addon.model.results.arrays import Results
from bridge_demolition_addon.model.scenario import TimeSettings
from bridge_demolition_addon.scene.world import create_world
from bridge_demolition_addon.simulation.blender_events import start_recording, stop_recording
from bridge_demolition_addon.simulation.recording.recorder import Recording

MOST_FRAMES = 10_000


class Blocks:
    """A scene with a rigid-body world of its own, to be filled with blocks and connections.

    Damping is off and nothing falls asleep, so that what is measured is statics and nothing else.
    """

    def __init__(self, **time: float):
        self.scene = bpy.context.scene
        self.time = TimeSettings(duration_s=1.0, **time)
        self.world = create_world(self.scene, self.time, MOST_FRAMES)

    def block(
        self, place: tuple[float, float, float], mass_kg: float = 0.0, size_m: tuple[float, float, float] = (1, 1, 1)
    ) -> bpy.types.Object:
        """A block; without a mass it never moves."""
        name = f"Block {len(self.world.collection.objects)}"
        mesh, solid = bpy.data.meshes.new(name), box(size_m, (0, 0, 0))
        mesh.from_pydata(solid.vertices, [], solid.triangles.tolist())
        body = bpy.data.objects.new(name, mesh)
        body.location = place
        self.world.collection.objects.link(body)
        rigid = body.rigid_body
        rigid.type, rigid.collision_shape = ("ACTIVE", "BOX") if mass_kg else ("PASSIVE", "BOX")
        rigid.mass = mass_kg or 1.0
        rigid.linear_damping = rigid.angular_damping = 0.0
        rigid.use_deactivation = False
        rigid.use_margin, rigid.collision_margin = True, 0.0
        return body

    def connect(
        self,
        kind: str,
        place: tuple[float, float, float],
        first: bpy.types.Object,
        second: bpy.types.Object,
        breaking_force_newton: float | None = None,
    ) -> bpy.types.Object:
        """A connection, unbreakable unless it has a breaking force."""
        connection = bpy.data.objects.new(f"Connection {len(self.world.constraints.objects)}", None)
        connection.location = place
        self.world.constraints.objects.link(connection)
        constraint = connection.rigid_body_constraint
        constraint.type, constraint.object1, constraint.object2 = kind, first, second
        if breaking_force_newton is not None:
            constraint.use_breaking = True
            constraint.breaking_threshold = self.time.step.impulse(breaking_force_newton)
        return connection

    def play(self, folder: Path, frames: int, *, every_substep: bool = True, contacts: bool = False) -> Results:
        """Simulate and record, from the start frame on."""
        self.recording = recording = Recording(self.scene, folder, every_substep=every_substep, contacts=contacts)
        start_recording(recording)
        for frame in range(self.scene.frame_start, self.scene.frame_start + frames + 2):
            self.scene.frame_set(frame)
        stop_recording()
        if recording.error:
            raise recording.error
        return recording.results()
