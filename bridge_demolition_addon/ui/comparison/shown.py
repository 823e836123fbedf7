"""Another run that is shown next to the scene's own: surfaces, key figures, and their drawing in the 3D view."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import bpy
import numpy as np

from ...display.colour_scale import colours
from ...display.contour_quantities import ContourQuantity
from ...display.contours import ContourSeries
from ...display.moved_surfaces import MovedSurfaces
from ...engineering.unit_systems import UnitSystem
from ...errors import DemolitionError, OutputError
from ...exports.shapes import body_meshes
from ...model.debris.footprint import footprint
from ...model.debris.throws import debris_of
from ...model.results.arrays import load_results, results_in
from ...model.run_folder.summary import read_summary
from ...report.findings import IMPACT, Finding, findings
from ...report.run_folder import read_run
from ...scene.world import FIRST_STEP_FRAME, simulated_time_s
from ...simulation.blender_events import contours_of, shown_results
from ..ground.decorator import plan_of
from ..languages.words import translated
from ..results import shown_run
from ..scene_units import area_text, length_text, mass_text, units_of_texts
from ..view_drawing import ViewDrawing, draw_triangles, write_at

_KG_PER_T = 1000.0

_HEADS = {
    IMPACT: "Impact of the ball",
    "Connections cracked, held by bars": "Cracked, held by bars",
    "Connections torn": "Connections torn",
    "Progress of the collapse": "Progress of the collapse",
    "All shards at rest from": "At rest from",
    "Debris": "Debris",
    "Footprint of the debris": "Area of the debris",
    "Height of the pile": "Height of the pile",
    "95 % of the debris's mass thrown up to": "95 % thrown up to",
    "Largest throw": "Largest throw",
    "Debris beyond the bridge's outline, at most": "Debris distance",
    "Largest load on a shard": "Largest load on a shard",
}
"""Names in the panel, by those in a report."""

_kept: dict[Path, tuple[int | None, list[Finding]]] = {}
"""Findings by folder, with the time at which the results were written that they are of."""


class FigureRow(NamedTuple):
    """A figure of both runs as texts."""

    name: str
    this: str
    other: str


def figure_rows(this: Path | None, other: Path) -> list[FigureRow]:
    """Return the key figures of two runs by their folders, without those that neither has.

    Of this one nothing is known where there is no folder yet. A folder that holds no results raises OutputError.
    """
    of_other = findings_of(other)
    of_this = findings_of(this) if this else [None] * len(of_other)
    rows = []
    for mine, theirs in zip(of_this, of_other, strict=True):
        if theirs.value is not None or (mine and mine.value is not None):
            rows.append(FigureRow(translated(_HEADS[theirs.label]), figure_text(mine), figure_text(theirs)))
    return rows


def findings_of(folder: Path) -> list[Finding]:
    """Return the findings of a run, worked out once."""
    written = written_at(folder)
    if folder not in _kept or _kept[folder][0] != written:
        run = read_run(folder)
        if run.results is None:
            raise OutputError(f"{folder}: {' '.join(run.shortcomings)}")
        _kept[folder] = written, findings(run, debris_of(run.recorded))
    return _kept[folder][1]


def written_at(folder: Path) -> int | None:
    """Return when the results in a folder were written, in ns since 1970; None where there are none."""
    try:
        return results_in(folder).stat().st_mtime_ns
    except OSError:
        return None


def figure_text(finding: Finding | None) -> str:
    """Return a figure with its unit, in the units of the scene; a dash where it is not known."""
    if finding is None or finding.value is None:
        return "-"
    value = finding.value
    match finding.unit:
        case "m":
            return length_text(value, ".2f")
        case "m²":
            return area_text(value, ".0f")
        case "t":
            return mass_text(value * _KG_PER_T) if units_of_texts() is UnitSystem.IMPERIAL else f"{value:.1f} t"
        case "1":
            return f"{value:.0f}"
        case "s":
            return f"{value:.2f} s"
        case unit:
            return f"{value:.0f} {unit}"


def forget_figures() -> None:
    """Forget all findings."""
    _kept.clear()


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
    """Return the run that a scene shows next to its own; None where it shows none. OutputError where it is gone."""
    if not scene.bda.compared_folder:
        return None
    folder = Path(scene.bda.compared_folder)
    written = written_at(folder)
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
    forget_figures()


def shift_beside(scene: bpy.types.Scene, run: OtherRun) -> float:
    """Return how far along y a run has to be drawn to stand next to the bridge of the scene, m."""
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
    """Return the colours (n, 3) of the bodies: from the contours, by the scale of this run, where it has them."""
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
        return read_summary(folder).title
    except (DemolitionError, OSError, ValueError, KeyError):  # a run that was killed has no summary
        return folder.name


_texts: list[tuple[tuple[float, float, float], str]] = []
"""Position, m, and text of the view that is drawn now."""


def _draw_in_space(context: bpy.types.Context) -> None:
    _texts.clear()
    shown_run.follow_later(context.scene)
    run = drawn_run(context.scene)
    if run is None:
        return
    draw_triangles(run.triangles, run.colours, solid=not run.is_over)
    _texts.append((run.position_m, run.text))


def _draw_on_screen(context: bpy.types.Context) -> None:
    for position, text in _texts:
        write_at(context, position, text)


def _forget() -> None:
    _texts.clear()
    forget()


drawing = ViewDrawing(_draw_in_space, _draw_on_screen, forget=_forget)
