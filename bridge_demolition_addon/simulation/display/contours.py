"""Contours that follow the timeline: of the latest recording of a scene, or of loaded results.

In a render they are painted in the render's thread, into the render's own copies of the bodies alone.
"""

from __future__ import annotations

import bpy
import numpy as np

from ...display.contour_quantities import ContourQuantity
from ...display.contour_ranges import ContourSettings
from ...display.contours import ContourFrame, ContourSeries
from ...display.stage_contours import StageContours
from ...errors import ContourError
from ...model.results.arrays import Results
from ...model.results.frames import Frame
from ...scene.bodies import Kind, bodies_of, kind_of
from ...scene.rendering.body_colours import paint, place, put_back, show_colours, show_materials, unpaint
from ..recording.recorder import Recording

_SAME_M = 1e-3
"""How far the shards of a scene may be from where stages have them: Blender has places in single precision."""


class ContourDisplay:
    """Colours of the bodies of one scene.

    Attributes
    ----------
    scene
        As Blender holds it now.
    settings
        What is shown, or None.
    error
        Why the bodies could not be coloured, or None.
    recording
        The recording of the scene that runs, or ran last; or None.
    is_live
        Whether it runs.
    results_number
        Which results these are: another number for all others.
    missing
        Why the results of the run of a file that was opened are not shown; empty where they are, or there was none.
    stages
        How the bridge stands between its steps, if that was worked out; shown for the quantity of that alone.
    stage
        Which stage is shown, from 1 on.
    """

    def __init__(self, scene: bpy.types.Scene):
        self.scene = scene
        self.settings: ContourSettings | None = None
        self.error: Exception | None = None
        self.recording: Recording | None = None
        self.is_live = False
        self.missing = ""
        self.results_number = 0
        self.stages: StageContours | None = None
        self.stage = 1
        self._results: Results | None = None
        self._loaded: ContourSeries | None = None
        self._recorded: ContourSeries | None = None
        self._has_placed = False

    @property
    def is_shown(self) -> bool:
        """Whether the bodies are coloured."""
        return self.settings is not None

    def show(self, settings: ContourSettings) -> None:
        """Colour the bodies from now on, whatever frame is gone to."""
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
        """Colour the bodies in an evaluated scene, where contours are shown, and place them; never raises."""
        if self.error or (self.settings is None and self._loaded is None):
            return
        try:
            self._paint(depsgraph)
        except Exception as error:  # an exception in a handler would be lost in the console: the sidebar shows it
            self.error = error

    def follow(self, recording: Recording) -> None:
        """Show a recording that begins, in place of what was recorded or loaded before."""
        self.recording, self.is_live = recording, True
        self._let_results_go()
        self._loaded, self.missing = None, ""

    def use_results(self, results: Results) -> None:
        """Show results that were kept, until something new is recorded.

        Raises
        ------
        ContourError
            None of their bodies is in the scene.
        """
        world = self.scene.rigidbody_world
        there = {body.name for body in bodies_of(self.scene)} if world and world.collection else set()
        names = results.inventory.body_names.tolist()
        if there.isdisjoint(names):
            raise ContourError(
                f"results: none of their {len(names)} bodies is in scene {self.scene.name!r}; open the "
                "scene that they were recorded in, or build it from the same scenario"
            )
        self._let_results_go()
        self._results = results
        self._loaded, self.missing = ContourSeries.of_results(results), ""
        self.refresh()

    @property
    def shows_loaded(self) -> bool:
        """Whether results that were loaded are shown, whatever Blender simulates."""
        return self._loaded is not None

    def forget(self) -> None:
        """Let go of what was recorded or loaded."""
        if not self.is_live:
            self.recording = None
        self._let_results_go()
        self._loaded = self._recorded = None
        self.missing = ""

    @property
    def results(self) -> Results | None:
        """The results of what is shown, once it has ended; None where nothing was recorded."""
        if self._results is None and self.recording and not self.is_live and self.recording.recorded_frames:
            self._results = self.recording.results()
        return self._results

    def before_frame(self) -> None:
        """Put bodies back before the frame from which Blender simulates: it would begin where they are shown."""
        world = self.scene.rigidbody_world
        if not (self._has_placed and world and world.collection):
            return
        if self.is_placed and self.scene.frame_current <= world.point_cache.frame_start + 1:
            self._put_back()

    def _put_back(self) -> None:
        if self._has_placed:
            put_back(self.scene)
            self._has_placed = False

    def _let_results_go(self) -> None:
        self._put_back()
        self._results = None
        self.results_number += 1

    @property
    def series(self) -> ContourSeries | None:
        """What there is to show, up to the latest frame; None where nothing was recorded."""
        return self._followed() if self._loaded is None else self._loaded

    def shown_frame(self) -> tuple[ContourFrame, int | None] | None:
        """Return the current frame as it is shown, and its row in the series; None where nothing was recorded.

        Of stages it is the stage that is shown, which has no row.
        """
        if self._shows_stages:
            return (self.stages.show(self.stage, self.settings), None) if self.stages else None
        series = self.series
        row = series.row_at(self.scene.frame_current) if series else None
        if self.settings is None or row is None:
            return None
        return series.show(row, self.settings), row

    @property
    def is_placed(self) -> bool:
        """Whether bodies are shown where they were recorded, as Blender has forgotten the frames it played."""
        if self.is_live:
            return False
        world = self.scene.rigidbody_world
        return self._loaded is not None or not (world and world.enabled) or world.point_cache.is_outdated

    @property
    def magnification(self) -> float:
        """How many times as far as they are displaced bodies are shown; while they are recorded, where they are."""
        return 1.0 if self.settings is None or self.is_live else self.settings.magnification

    def _show_true_shape(self) -> None:
        """Show bodies that are magnified where they are: Blender does not know that they are shown elsewhere."""
        series = self.series
        row = series.row_at(self.scene.frame_current) if series else None
        if row is None or self.magnification == 1.0:
            return
        for layer in self.scene.view_layers:
            if layer.depsgraph:
                self._place(layer.depsgraph, series, series.frame(row))

    def _followed(self) -> ContourSeries | None:
        """Return the series of the recording, with the frames that came since the last look."""
        if self.recording is None or not self.recording.recorded_frames:
            return None
        frames, series = self.recording.frames, self._recorded
        if series is None or series.recorded is not frames:
            series = self._recorded = ContourSeries(self.recording.inventory, frames)
        series.follow()
        return series

    def _paint(self, depsgraph: bpy.types.Depsgraph) -> None:
        series = self.series
        row = series.row_at(self.scene.frame_current) if series else None
        if row is not None and (self.is_placed or self.magnification != 1.0):
            self._place(depsgraph, series, series.magnified(row, self.magnification))
        if self._shows_stages:
            self._paint_stage(depsgraph)
            return
        if self.settings is None or row is None:
            return
        frame = series.show(row, self.settings)
        rows = {name: row for row, name in enumerate(series.body_names)}
        paint(self.scene, depsgraph, rows, np.where(series.moves[:, None], frame.screen_colours, np.nan))

    @property
    def _shows_stages(self) -> bool:
        return self.settings is not None and self.settings.quantity is ContourQuantity.UTILISATION

    def _paint_stage(self, depsgraph: bpy.types.Depsgraph) -> None:
        world = self.scene.rigidbody_world
        if self.stages is None or not (world and world.collection):
            return
        shards = [body for body in bodies_of(self.scene) if kind_of(body) == Kind.SHARD]
        places = np.array([body.location for body in shards]).reshape(-1, 3)
        if places.shape != self.stages.centres_m.shape or not np.allclose(places, self.stages.centres_m, atol=_SAME_M):
            raise ContourError("stages: they are of another bridge than the scene has; build it anew, or check again")
        frame = self.stages.show(self.stage, self.settings)
        paint(self.scene, depsgraph, {body.name: row for row, body in enumerate(shards)}, frame.screen_colours)

    def _place(self, depsgraph: bpy.types.Depsgraph, series: ContourSeries, shown: Frame) -> None:
        moving = {name: row for row, name in enumerate(series.body_names) if series.moves[row]}
        self._has_placed = True
        place(self.scene, depsgraph, moving, shown.positions_m, shown.rotations)
