"""Contours as pictures and as a film, in a folder."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from enum import StrEnum
from pathlib import Path

import bpy
import numpy as np

from ...display.contours import ContourSeries, ContourSettings
from ...display.frames import film_rows
from ...errors import ContourError, OutputError
from ...model.run_folder.files import FILM_FILE, SLOW_FILM_FILE
from ...model.scenario.recording import PictureSettings
from ...scene.rendering.film import RenderSettings, encode_film, set_up_for_pictures
from ...scene.rendering.stills import rendered_to
from ...system.disk import writing
from ...system.native_output import without_noise
from ..blender_events import contours_of, shown_results

_PICTURE = "contours_{:06d}.png"


class FilmKind(StrEnum):
    """What is made."""

    PICTURES = "pictures"
    FILM = "film"


@dataclass(frozen=True, slots=True)
class FilmSettings:
    """A film, or the pictures of one.

    Attributes
    ----------
    slowness
        Seconds of film for a second of the simulation: 1 is real time.
    slow_motion
        Seconds of a second film, made of the same pictures, for a second of the simulation; no such film for None.
    picture
        Size of the pictures, colour bar included.
    view
        Their camera; its size of other pictures does not matter here.
    """

    kind: FilmKind = FilmKind.FILM
    pictures_per_second: float = 25.0
    slowness: float = 1.0
    slow_motion: float | None = None
    picture: RenderSettings = field(default_factory=RenderSettings)
    view: PictureSettings = field(default_factory=PictureSettings)

    @property
    def rendered(self) -> RenderSettings:
        """The part of a picture that is rendered: all but the colour bar."""
        from ...charts.contour_legend import legend_width  # matplotlib, which switching the add-on on need not wait for

        return replace(self.picture, width_px=self.picture.width_px - legend_width(self.picture.height_px))


class FilmRendering:
    """A film of a scene whose frames were played, rendered picture by picture into a folder, which is made if new."""

    def __init__(
        self, scene: bpy.types.Scene, folder: Path, contour_settings: ContourSettings, film_settings: FilmSettings
    ):
        series = shown_results(scene).series
        if series is None:
            raise ContourError(f"scene {scene.name!r} has no recording to show: record one, or load its results")
        self._scene, self._folder = scene, folder
        self._contours, self._film = contour_settings, film_settings
        self._films = _frames_of_films(series, film_settings)
        self._frames = sorted(set().union(*self._films.values()))
        with writing(folder):
            folder.mkdir(parents=True, exist_ok=True)
            pictures = folder.glob("contours_[0-9][0-9][0-9][0-9][0-9][0-9].png")
            for old in (*pictures, folder / FILM_FILE, folder / SLOW_FILM_FILE):
                old.unlink(missing_ok=True)

    @property
    def picture_count(self) -> int:
        """How many pictures are to be rendered."""
        return len(self._frames)

    def pictures(self) -> Iterator[Path]:
        """Render one picture after the other; the scene is restored after the last, or when the iterator is closed."""
        from ...charts.contour_legend import add_legend  # matplotlib, which switching the add-on on need not wait for

        scene = self._scene
        with (
            _contours_shown(scene, self._contours),
            _simulation_at_rest(scene),
            set_up_for_pictures(scene, self._film.rendered, self._film.view),
        ):
            for frame in self._frames:
                path = self._path(frame)
                scene.frame_set(frame)
                with rendered_to(path) as scene.render.filepath, without_noise():
                    bpy.ops.render.render(write_still=True, scene=scene.name)
                if error := contours_of(scene).error:
                    raise error
                if not path.exists():
                    raise OutputError(f"{path}: Blender wrote no picture; see what it says on its console")
                if shown := contours_of(scene).shown_frame():
                    add_legend(path, self._contours, shown[0])
                yield path

    def finish(self) -> list[Path]:
        """Make the films, if any are asked for, and return the files."""
        pictures = [self._path(frame) for frame in self._frames]
        if self._film.kind == FilmKind.PICTURES:
            return pictures
        for film, frames in self._films.items():
            encode_film([self._path(frame) for frame in frames], self._folder / film, self._film.pictures_per_second)
        for picture in pictures:
            picture.unlink()
        return [self._folder / film for film in self._films]

    def _path(self, frame: int) -> Path:
        return self._folder.resolve() / _PICTURE.format(frame)


def _frames_of_films(series: ContourSeries, settings: FilmSettings) -> dict[str, list[int]]:
    """Return the frame of every picture of each film; frames of a series of pictures count as a film's."""
    if settings.kind == FilmKind.PICTURES:
        return {FILM_FILE: series.frames}
    films = {FILM_FILE: settings.slowness}
    if settings.slow_motion is not None:
        films[SLOW_FILM_FILE] = settings.slow_motion
    frames = np.array(series.frames)
    rows = {film: film_rows(series.times_s, settings.pictures_per_second, slow) for film, slow in films.items()}
    return {film: frames[rows_of_film].tolist() for film, rows_of_film in rows.items()}


@contextmanager
def _simulation_at_rest(scene: bpy.types.Scene) -> Iterator[None]:
    """Have the bodies stay as they were recorded if Blender has forgotten the played frames.

    A render would simulate them again, in the world that the 3D view simulates too, and crash.
    """
    world = scene.rigidbody_world
    if not shown_results(scene).are_placed or not world.enabled:
        yield
        return
    world.enabled = False
    try:
        yield
    finally:
        world.enabled = True


@contextmanager
def _contours_shown(scene: bpy.types.Scene, settings: ContourSettings) -> Iterator[None]:
    """Colour the bodies by these settings, and afterwards as before."""
    before = contours_of(scene).settings
    contours_of(scene).show(settings)
    try:
        yield
    finally:
        if before is None:
            contours_of(scene).hide()
        else:
            contours_of(scene).show(before)
