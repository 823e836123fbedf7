"""The results that are shown in a scene: of its latest recording, or loaded ones."""

from __future__ import annotations

import bpy

from ...display.contours import ContourSeries
from ...errors import ContourError
from ...model.results.arrays import Results
from ...model.results.frames import Frame
from ...model.schema import given
from ...scene.as_built import build_of
from ...scene.bodies import bodies_of
from ...scene.rendering.body_colours import place, put_back, put_back_to_start
from ..recording.recorder import Recording


class ShownResults:
    """Results of one scene, for as long as it shows the building that they are of, which undo may bring back.

    Attributes
    ----------
    recording
        The recording of the scene that runs, or ran last; or None. `is_live` is set while it runs.
    number
        Another number for other results.
    stays_placed
        Whether bodies are shown where they were recorded also without contours, as what is drawn with them is of the
        recorded frame.
    missing
        Why the results of the run of an opened file are not shown; empty where they are, or the file has no run.
    """

    def __init__(self, scene: bpy.types.Scene):
        self.scene = scene
        self.recording: Recording | None = None
        self.is_live = False
        self.number = 0
        self.stays_placed = False
        self.missing = ""
        self._build = ""
        self._results: Results | None = None
        self._loaded: ContourSeries | None = None
        self._recorded: ContourSeries | None = None
        self._is_held = False
        self._has_placed = False

    def follow(self, recording: Recording) -> None:
        """Show a recording that begins, in place of earlier results."""
        self._drop()
        self.recording, self.is_live, self._build = recording, True, build_of(self.scene)

    def load(self, results: Results) -> None:
        """Show kept results until the next recording; raises a `ContourError` if the scene has none of their bodies."""
        world = self.scene.rigidbody_world
        there = {body.name for body in bodies_of(self.scene)} if world and world.collection else set()
        names = results.inventory.body_names.tolist()
        if there.isdisjoint(names):
            raise ContourError(
                f"results: none of their {len(names)} bodies is in scene {self.scene.name!r}; open the "
                "scene that they were recorded in, or build it from the same scenario"
            )
        self._drop()
        self._results, self._loaded, self._build = results, ContourSeries.of_results(results), build_of(self.scene)

    def hold(self) -> bool:
        """Show from now on what was recorded, as Blender has lost the frames that it played; False where nothing is."""
        if self.is_live or self.series is None:
            return False
        self._is_held = True
        return True

    def forget(self) -> None:
        """Show no results any more; a recording that runs goes on."""
        if not self.is_live:
            self.recording = None
        self._drop()
        self._recorded = None

    @property
    def are_loaded(self) -> bool:
        """Whether loaded results, or those that are held, are shown, also while Blender simulates."""
        return (self._loaded is not None or self._is_held) and self.series is not None

    @property
    def are_placed(self) -> bool:
        """Whether bodies are shown where they were recorded, as Blender has forgotten the frames it played."""
        if self.is_live:
            return False
        world = self.scene.rigidbody_world
        return self.are_loaded or not (world and world.enabled) or world.point_cache.is_outdated

    @property
    def results(self) -> Results | None:
        """The results, once their recording has ended; None where nothing was recorded."""
        if self.is_live or not self._are_of_the_build:
            return None
        if self._results is None and self.recording and self.recording.recorded_frames:
            self._results = self.recording.results()
        return self._results

    @property
    def series(self) -> ContourSeries | None:
        """The frames that can be shown, up to the latest one; None where nothing was recorded of what is built."""
        if not self._are_of_the_build:
            return None
        if self._loaded is not None:
            return self._loaded
        if self.recording is None or not self.recording.recorded_frames:
            return None
        frames, series = self.recording.frames, self._recorded
        if series is None or series.recorded is not frames:
            series = self._recorded = ContourSeries(given(self.recording.inventory), frames)
        series.follow()
        return series

    @property
    def current_row(self) -> tuple[ContourSeries, int] | None:
        """The frames, and the row of the scene's current one; None where nothing was recorded."""
        series = self.series
        row = series.row_at(self.scene.frame_current) if series else None
        return None if series is None or row is None else (series, row)

    def place(self, depsgraph: bpy.types.Depsgraph, shown: Frame) -> None:
        """Show the bodies of an evaluated scene where a frame has them."""
        self._has_placed = True
        place(self.scene, depsgraph, self._moving_rows(), shown.positions_m, shown.rotations)

    def before_frame(self) -> None:
        """Put bodies back before the frame from which Blender simulates: it would begin where they are shown."""
        world = self.scene.rigidbody_world
        if not (self._has_placed and world and world.collection):
            return
        if self.are_placed and self.scene.frame_current <= world.point_cache.frame_start + 1:
            if series := self.series:
                first = series.frame(0)
                put_back_to_start(self.scene, self._moving_rows(), first.positions_m, first.rotations)
            self._has_placed = False

    def put_bodies_back(self) -> None:
        """Put bodies back where they were before they were shown elsewhere."""
        if self._has_placed:
            put_back(self.scene)
            self._has_placed = False

    @property
    def _are_of_the_build(self) -> bool:
        return self._build == build_of(self.scene)

    def _moving_rows(self) -> dict[str, int]:
        series = self.series
        return {name: row for row, name in enumerate(series.body_names) if series.moves[row]} if series else {}

    def _drop(self) -> None:
        self.put_bodies_back()
        self._results = self._loaded = None
        self._is_held = False
        self.missing = ""
        self.number += 1
