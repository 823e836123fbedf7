"""Pictures of a run in the window: charts, plan and pictures in an image editor, and from a chart's peak to its frame.

The workspace BDA has such an editor.
"""

from pathlib import Path

import bpy
from bpy.props import EnumProperty

from ..errors import DemolitionError, OutputError
from ..model.results.force_history import peak_near
from ..model.run_folder.files import FILM_FILE, FORCE_CHART, PICTURE_FOLDER, PICTURES, SLOW_FILM_FILE
from .languages.words import translated
from .operators import Action, GuardedOperator, recording_runs, refused
from .results.operator import CHARTS, go_to
from .results.shown_run import shown_run
from .viewport import region_of

EDITOR = "IMAGE_EDITOR"

_NEAR_SHARE = 0.02
"""How far beside a click a peak is looked for, as a share of the time axis."""

_LOOKING_ROUND = {"MIDDLEMOUSE", "WHEELUPMOUSE", "WHEELDOWNMOUSE", "MOUSEMOVE", "INBETWEEN_MOUSEMOVE", "TIMER"}

_items: list[tuple[str, str, str]] = []
"""The choices that Blender shows now: it needs their texts to stay."""


def pictures_of(scene: bpy.types.Scene) -> list[Path]:
    """Return the pictures and films of the shown run, charts first; none without a run."""
    try:
        run = shown_run(scene)
    except OutputError:  # the panel Results says so
        return []
    if run is None:
        return []
    rendered = (Path(PICTURE_FOLDER, f"{name}.png") for name in PICTURES)
    others = [*rendered, Path(FILM_FILE), Path(SLOW_FILM_FILE)]
    charts = sorted((run.folder / CHARTS).glob("*.png"))
    own = [] if any(chart.name == FORCE_CHART for chart in charts) else [run.folder / FORCE_CHART]
    return [path for path in (*own, *charts, *(run.folder / name for name in others)) if path.is_file()]


def chart_of(scene: bpy.types.Scene) -> Path | None:
    """Return the chart of forces of the shown run, a drawn one before the run's own; None without one."""
    return next((path for path in pictures_of(scene) if path.name == FORCE_CHART), None)


def show_in(window: bpy.types.Window, path: Path) -> bool:
    """Show the whole of a picture in all image editors of a window, and return whether there is one."""
    areas = [area for area in window.screen.areas if area.type == EDITOR]
    if not areas:
        return False
    image = bpy.data.images.load(str(path), check_existing=True)
    image.reload()
    for area in areas:
        area.spaces.active.image = image
        with bpy.context.temp_override(window=window, area=area, region=region_of(area, "WINDOW")):
            bpy.ops.image.view_all(fit_view=True)
    return True


def _no_editor(context: bpy.types.Context) -> str | None:
    areas = context.window.screen.areas if context.window else ()
    found = any(area.type == EDITOR for area in areas)
    return None if found else "Go to the BDA Workspace first: it has an image editor for pictures"


def _no_picture(context: bpy.types.Context) -> str | None:
    return None if pictures_of(context.scene) else "This run has no pictures yet: Draw Charts makes some"


def _choices(_operator: bpy.types.Operator, context: bpy.types.Context | None) -> list[tuple[str, str, str]]:
    paths = pictures_of(context.scene) if context else []
    _items[:] = [(str(path), path.stem.replace("_", " "), str(path)) for path in paths]
    return _items


class BDA_OT_show_picture(Action, bpy.types.Operator):
    """Show a chart, the plan, a picture or the film of the run in the image editor of the workspace"""

    bl_label = "Show Picture"
    changes_scene = False
    blocked_by = (_no_picture, _no_editor)

    picture: EnumProperty(name="Picture", description="Picture or film of the run", items=_choices)

    def act(self, context: bpy.types.Context) -> None:
        if not show_in(context.window, Path(self.picture)):
            raise OutputError(f"{self.picture}: there is no image editor to show it in")


def _no_chart(context: bpy.types.Context) -> str | None:
    return None if chart_of(context.scene) else "This run has no chart of forces: Draw Charts makes it"


class BDA_OT_go_to_peak(GuardedOperator, bpy.types.Operator):
    """Click a peak in the chart of forces: the 3D view goes to its frame and to its shard; Esc cancels"""

    bl_label = "Go to Peak"
    changes_scene = False
    blocked_by = (recording_runs, _no_chart, _no_editor)

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        show_in(context.window, chart_of(context.scene))
        context.workspace.status_text_set(translated("Click a peak in the chart of forces | Esc: cancel"))
        context.window.cursor_modal_set("CROSSHAIR")
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if event.type in _LOOKING_ROUND or event.value != "PRESS":
            return {"PASS_THROUGH"}
        if event.type in {"ESC", "RIGHTMOUSE"}:
            return self._leave(context, {"CANCELLED"})
        if event.type != "LEFTMOUSE":
            return {"RUNNING_MODAL"}
        try:
            share = share_clicked(context.window, event.mouse_x, event.mouse_y)
            with context.temp_override(**_view_in(context.window)):
                self.report({"INFO"}, go_to_peak(bpy.context, share))
        except DemolitionError as error:
            self._leave(context, set())
            return refused(self, error)
        return self._leave(context, {"FINISHED"})

    def cancel(self, context: bpy.types.Context) -> None:
        """End it; Blender calls this before it loads another file."""
        self._leave(context, {"CANCELLED"})

    @staticmethod
    def _leave(context: bpy.types.Context, ended: set[str]) -> set[str]:
        if context.window:
            context.window.cursor_modal_restore()
        if context.workspace:
            context.workspace.status_text_set(None)
        return ended


def share_clicked(window: bpy.types.Window, mouse_x: int, mouse_y: int) -> float:
    """Return where across the picture of an image editor a click is, as a share of its width from the left.

    A click elsewhere raises OutputError.
    """
    for area in window.screen.areas:
        region = region_of(area, "WINDOW") if area.type == EDITOR else None
        if region and region.x <= mouse_x < region.x + region.width and region.y <= mouse_y < region.y + region.height:
            return float(region.view2d.region_to_view(mouse_x - region.x, mouse_y - region.y)[0])
    raise OutputError("that is no chart: click in the chart of forces, in the image editor")


def go_to_peak(context: bpy.types.Context, share: float) -> str:
    """Go to the largest force on a shard near a share of the chart's width, and return in a sentence what it is."""
    # Loading matplotlib takes a second, which switching the extension on need not wait for.
    from ..charts.histories import TimeAxis

    scene = context.scene
    axis = TimeAxis.read(chart_of(scene))
    if axis is None:
        raise OutputError("this chart was drawn by an earlier version: Draw Charts draws it again")
    time_s = axis.time_at(share)
    if time_s is None:
        raise OutputError("that is beside the time axis: click between its ends")
    results = shown_run(scene).results()
    peak = peak_near(results, time_s, _NEAR_SHARE * (axis.end_s - axis.begin_s))
    if peak is None:
        raise OutputError(f"no shard bore a force near {time_s:.2f} s")
    name, frame = str(results.inventory.body_names[peak.row]), int(results.frames.number[peak.step])
    go_to(context, name, frame)
    return f"{peak.force_n / 1e3:,.0f} kN on {name} at {results.frames.time_s[peak.step]:.3f} s, frame {frame}"


def _view_in(window: bpy.types.Window) -> dict[str, object]:
    """Return what makes the largest 3D view of a window the one in context; none where it has none."""
    views = [area for area in window.screen.areas if area.type == "VIEW_3D"]
    area = max(views, key=lambda view: view.width * view.height, default=None)
    return {"window": window, "area": area, "region": region_of(area, "WINDOW")} if area else {"window": window}
