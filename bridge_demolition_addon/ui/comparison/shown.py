"""The other run that is shown beside the scene's own: its surfaces, where they are now, and their colours."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import bpy
import numpy as np

from ...display.colour_scale import colours
from ...display.contour_quantities import ContourQuantity
from ...display.contours import ContourSeries
from ...display.moved_surfaces import MovedSurfaces
from ...errors import DemolitionError, OutputError
from ...exports.shapes import body_meshes
from ...model.debris.footprint import footprint
from ...model.results.arrays import load_results
from ...model.run_folder.summary import read_summary
from ...scene.time_scale import simulated_time_s
from ...scene.world import FIRST_STEP_FRAME
from ...simulation.blender_events import contours_of, shown_results
from ..ground.areas import plan_of
from . import figures

_COLOUR = (0.95, 0.62, 0.30)
_OPACITY_OVER = 0.45
_GAP_M = 5.0

_read: dict[Path, tuple[int | None, OtherRun | DemolitionError]] = {}
"""The run that was read last, or why it could not be read, with the time at which its results were written."""

_placed: dict[tuple, tuple[np.ndarray, np.ndarray, np.ndarray]] = {}
"""Its surfaces as they were drawn last: views are drawn many times a second."""


@dataclass(frozen=True, slots=True, eq=False)
class OtherRun:
    """A run by its folder.

    Attributes
    ----------
    title
        Title of its scenario, or name of its folder.
    plan_m : (4,) float
        Left, bottom, right and top of what the bridge covered at first.
    """

    folder: Path
    title: str
    surfaces: MovedSurfaces
    series: ContourSeries
    plan_m: tuple[float, float, float, float]

    @classmethod
    def read(cls, folder: Path) -> OtherRun:
        """Read a run; OutputError where the folder holds none."""
        if not folder.is_dir():
            raise OutputError(f"{folder}: expected the folder of another run")
        results = load_results(folder)
        if not len(results.frames):
            raise OutputError(f"{folder}: holds no frame of a run")
        plan = footprint(results, results.inventory.of_kind("shard"), 0)
        return cls(
            folder=folder,
            title=_title_of(folder),
            surfaces=MovedSurfaces(results, body_meshes(results.inventory)),
            series=ContourSeries.of_results(results),
            plan_m=plan.bounds() if not plan.is_empty() else (0.0, 0.0, 0.0, 0.0),
        )


@dataclass(frozen=True, slots=True, eq=False)
class DrawnRun:
    """What is drawn of the other run: triangles (3 t, 3), m, their colours (3 t, 4), and where its name stands."""

    triangles: np.ndarray
    colours: np.ndarray
    is_over: bool
    text: str
    position_m: tuple[float, float, float]


def other_run(scene: bpy.types.Scene) -> OtherRun | None:
    """Return the run that a scene shows beside its own; None where it shows none. OutputError where it is gone."""
    if not scene.bda.compared_folder:
        return None
    folder = Path(scene.bda.compared_folder)
    written = figures.written_at(folder)
    if folder not in _read or _read[folder][0] != written:
        _read.clear()
        _placed.clear()
        try:
            _read[folder] = written, OtherRun.read(folder)
        except DemolitionError as error:
            _read[folder] = written, error
    run = _read[folder][1]
    if isinstance(run, DemolitionError):
        raise run
    return run


def forget() -> None:
    """Forget the run that was read, and its figures."""
    _read.clear()
    _placed.clear()
    figures.forget()


def shift_beside(scene: bpy.types.Scene, run: OtherRun) -> float:
    """Return how far along y a run has to be drawn to stand beside the bridge of the scene, m."""
    plan = plan_of(scene)
    top = plan.bounds()[3] if plan is not None and not plan.is_empty() else 0.0
    return float(np.ceil(top - run.plan_m[1] + _GAP_M))


def time_shown_s(scene: bpy.types.Scene) -> float:
    """Return the simulated time of the frame that is shown: as it was recorded, where it was."""
    current = shown_results(scene).current_row
    if current is None:
        return simulated_time_s(scene, FIRST_STEP_FRAME) if scene.rigidbody_world else 0.0
    series, row = current
    return float(series.times_s[row])


def drawn_run(scene: bpy.types.Scene) -> DrawnRun | None:
    """Return what is drawn of the other run now; None where none is shown."""
    run = other_run(scene) if scene.bda.show_compared else None
    if run is None:
        return None
    row, shift_m = run.surfaces.row_at(time_shown_s(scene)), scene.bda.compared_shift_m
    key = (run.folder, row, shift_m)
    if key not in _placed:
        _placed.clear()
        _placed[key] = run.surfaces.at(row, (0.0, shift_m, 0.0))
    triangles, brightness, bodies = _placed[key]
    opacity = 1.0 if shift_m else _OPACITY_OVER
    painted = colours_of(scene, run, row)[bodies] * brightness[:, None]
    corners = np.repeat(np.column_stack((painted, np.full(len(painted), opacity))), 3, axis=0)
    left, bottom, right, top = run.plan_m
    highest = float(triangles[:, :, 2].max(initial=0.0))
    return DrawnRun(
        triangles=triangles.reshape(-1, 3),
        colours=corners,
        is_over=not shift_m,
        text=f"{run.folder.name}, {run.surfaces.time_s(row):.2f} s",
        position_m=((left + right) / 2.0, (bottom + top) / 2.0 + shift_m, highest + 1.0),
    )


def colours_of(scene: bpy.types.Scene, run: OtherRun, row: int) -> np.ndarray:
    """Return the colours (n, 3) of the bodies: those of the contours, by the scale of this run, where it has them."""
    plain = np.tile(_COLOUR, (len(run.series.body_names), 1))
    contours = contours_of(scene)
    settings = contours.settings
    shown = contours.shown_frame() if settings and settings.quantity is not ContourQuantity.UTILISATION else None
    if settings is None or shown is None:
        return plain
    of = len(run.series) - 1 if settings.peak and settings.whole_run else row
    values = run.series.values(of, settings.quantity, peak=settings.peak)
    painted = colours(settings.colour_map, shown[0].scale.shares(values))
    return np.where(np.isfinite(values)[:, None], painted, plain)


def _title_of(folder: Path) -> str:
    try:
        return str(read_summary(folder).values["title"])
    except (DemolitionError, OSError, ValueError, KeyError):  # a run that was killed has no summary
        return folder.name
