"""Parts of the panels Study, Search and Optimise: file and folder, settings, progress or Start, and the result."""

from __future__ import annotations

import bpy

from ..languages.words import translated
from ..scenario.ui import draw_keys
from ..sidebar import SidebarPanel, draw_sentence
from .prop import SPAN_DOWN
from .session import Work


class EnsemblePanel(SidebarPanel):
    """Base of the three panels, each for the work of a kind; `can_pause` says that it has buttons for that."""

    work: Work
    can_pause = False

    def draw_settings(self, context: bpy.types.Context) -> None:
        """Draw the settings."""

    def draw_result(self, context: bpy.types.Context) -> None:
        """Draw the result."""

    def draw(self, context: bpy.types.Context) -> None:
        layout, settings, work = self.layout, context.scene.bda, self.work
        name = translated(work.name)
        row = layout.row(align=True)
        row.prop(settings, f"{work.key}_path", text="", placeholder=translated("{} file").format(name))
        row.operator(f"bda.load_{work.key}", text="Load")
        layout.prop(settings, f"{work.key}_directory", text="", placeholder=translated("Folder of the {}").format(name))
        self.draw_settings(context)
        layout.prop(settings, "study_jobs")
        if work.session:
            self._draw_progress()
        else:
            layout.operator(f"bda.start_{work.key}", text="Start")
        if work.why_ended:
            draw_sentence(layout, context, work.why_ended)
        if work.result:
            self.draw_result(context)

    def _draw_progress(self) -> None:
        """Draw the buttons above the lines that come and go: so they stay under the mouse."""
        layout, work = self.layout, self.work
        layout.progress(
            factor=work.session.planner.done / work.session.planner.total, text=work.session.folder.path.name
        )
        row = layout.row(align=True)
        if self.can_pause:
            if work.session.is_paused:
                row.operator(f"bda.resume_{work.key}", text="Resume")
            else:
                row.operator(f"bda.pause_{work.key}", text="Pause")
        row.operator(f"bda.stop_{work.key}", text="Stop")
        column = layout.column(align=True)
        for line in work.progress:
            column.label(text=line, translate=False)


class OneValuePanel(EnsemblePanel):
    """Base of the panels Search and Optimise: keys, a criterion, and a result in sentences with a picture."""

    picture: str

    def draw_criterion(self, layout: bpy.types.UILayout, settings: bpy.types.PropertyGroup) -> None:
        """Draw what a success is."""
        column = layout.column()
        column.use_property_split, column.use_property_decorate = True, False
        column.prop(settings, f"{self.work.key}_criterion")
        if getattr(settings, f"{self.work.key}_criterion") == SPAN_DOWN:
            column.prop(settings, f"{self.work.key}_span")

    def draw_result(self, context: bpy.types.Context) -> None:
        draw_whose_result(self.layout, context, self.work)
        for sentence in self.work.result.sentences:
            draw_sentence(self.layout, context, sentence, icon="NONE")
        self.layout.operator(self.picture)


def draw_whose_result(layout: bpy.types.UILayout, context: bpy.types.Context, work: Work) -> None:
    """Say where a result is of another bridge, or of other charges, than the panels show."""
    if work.is_of_other(context.scene.bda):
        sentence = translated("This result is of other values than the panels show: {}")
        draw_sentence(layout, context, sentence.format(work.scenario.title))


def draw_own_keys(panel: EnsemblePanel, context: bpy.types.Context, without: tuple[str, ...] = ()) -> None:
    """Draw the keys that only this kind has, from the schema; those that all kinds share are in the panel Study."""
    column = panel.layout.column()
    column.enabled = panel.work.session is None
    group = getattr(context.scene.bda, panel.work.key)
    draw_keys(column, context, group, panel.work.settings_class, without=without)
