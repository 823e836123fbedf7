"""Contours that follow the timeline: of the latest recording of a scene, or of loaded results.

In a render they are painted in the render's thread, into the render's own copies of the bodies alone.
"""

from __future__ import annotations

import bpy
import numpy as np

from ...display.contour_quantities import ContourQuantity
from ...display.contours import ContourFrame, ContourSettings, StageContours
from ...errors import ContourError
from ...scene.bodies import Kind, bodies_of, kind_of
from ...scene.rendering.body_colours import paint, show_colours, show_materials, unpaint
from .shown_results import ShownResults

_SAME_M = 1e-3
"""How far the shards of a scene may be from where stages have them: Blender has positions in single precision."""


class ContourDisplay:
    """Colours of the bodies of one scene, by settings, which are None while bodies have their own colours.

    Attributes
    ----------
    error
        Why the bodies could not be coloured, or None.
    stages
        Utilisation at each stage, if it was calculated; shown for that quantity alone.
    stage
        Which stage is shown, from 1 on.
    """

    def __init__(self, shown: ShownResults):
        self.shown = shown
        self.settings: ContourSettings | None = None
        self.error: Exception | None = None
        self.stages: StageContours | None = None
        self.stage = 1

    @property
    def scene(self) -> bpy.types.Scene:
        """The scene of the results."""
        return self.shown.scene

    @property
    def is_shown(self) -> bool:
        """Whether the bodies are coloured."""
        return self.settings is not None

    def show(self, settings: ContourSettings) -> None:
        """Colour the bodies, and keep colouring them at every change of the frame."""
        self._show_true_shape()
        self.settings, self.error = settings, None
        show_colours(self.scene, shaded=settings.shaded)
        self.refresh()

    def hide(self) -> None:
        """Give the bodies their own colours and materials back."""
        self._show_true_shape()
        self.settings = self.error = None
        show_materials(self.scene)
        unpaint(self.scene)

    def refresh(self) -> None:
        """Colour the bodies of the current frame now."""
        for layer in self.scene.view_layers:
            if layer.depsgraph:
                self._paint(layer.depsgraph)

    def paint(self, depsgraph: bpy.types.Depsgraph) -> None:
        """Colour the bodies in an evaluated scene, if contours are shown, and move them; never raises."""
        shows_record = self.shown.are_loaded or self.shown.stays_placed
        if self.error or (self.settings is None and not shows_record):
            return
        try:
            self._paint(depsgraph)
        except Exception as error:  # an exception in a handler would be lost in the console: the sidebar shows it
            self.error = error

    def shown_frame(self) -> tuple[ContourFrame, int | None] | None:
        """Return the current frame as it is shown, and its row in the series; None where nothing was recorded.

        A stage, if stages are shown, has no row.
        """
        if self._shows_stages:
            if self.stages is None or self.settings is None:
                return None
            return self.stages.show(self.stage, self.settings), None
        current = self.shown.current_row
        if self.settings is None or current is None:
            return None
        series, row = current
        return series.show(row, self.settings), row

    @property
    def magnification(self) -> float:
        """Factor on the displacements that are shown; 1 while the scene is recorded."""
        return 1.0 if self.settings is None or self.shown.is_live else self.settings.magnification

    def _show_true_shape(self) -> None:
        """Move magnified bodies back to their positions: Blender does not know that they are shown elsewhere."""
        current = self.shown.current_row
        if current is None or self.magnification == 1.0:
            return
        series, row = current
        for layer in self.scene.view_layers:
            if layer.depsgraph:
                self.shown.place(layer.depsgraph, series.frame(row))

    def _paint(self, depsgraph: bpy.types.Depsgraph) -> None:
        current = self.shown.current_row
        if current and (self.shown.are_placed or self.magnification != 1.0):
            series, row = current
            if row or self.magnification != 1.0:  # the scene itself has the first frame, and what was edited since
                self.shown.place(depsgraph, series.magnified(row, self.magnification))
        if self._shows_stages:
            self._paint_stage(depsgraph)
        elif self.settings is not None and current:
            series, row = current
            frame = series.show(row, self.settings)
            rows = {name: row for row, name in enumerate(series.body_names)}
            paint(self.scene, depsgraph, rows, np.where(series.moves[:, None], frame.screen_colours, np.nan))

    @property
    def _shows_stages(self) -> bool:
        return self.settings is not None and self.settings.quantity is ContourQuantity.UTILISATION

    def _paint_stage(self, depsgraph: bpy.types.Depsgraph) -> None:
        world = self.scene.rigidbody_world
        if self.stages is None or self.settings is None or not (world and world.collection):
            return
        shards = [body for body in bodies_of(self.scene) if kind_of(body) == Kind.SHARD]
        positions_m = np.array([body.location for body in shards]).reshape(-1, 3)
        centres_m = self.stages.centres_m
        if positions_m.shape != centres_m.shape or not np.allclose(positions_m, centres_m, atol=_SAME_M):
            raise ContourError("stages: they are of another bridge than the scene has; build it again, or check again")
        frame = self.stages.show(self.stage, self.settings)
        paint(self.scene, depsgraph, {body.name: row for row, body in enumerate(shards)}, frame.screen_colours)
