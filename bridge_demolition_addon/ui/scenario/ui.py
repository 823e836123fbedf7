"""The panels of a scenario: the groups of the tab, and one for each table, drawn from the tables' keys alone."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import Field, dataclass
from functools import cache

import bpy
from bpy.types import Context, PropertyGroup, UILayout

from ...model.scenario import Scenario
from ...model.schema import Table, holds_many, is_optional, key_name, subtable_class, value_type
from ...scene.visibility import has_symbols, symbols_are_hidden
from ..languages.words import CONTEXT, translated
from ..messages import draw_messages
from ..preview.bars import shown_bars
from ..sidebar import (
    DEMOLITION_ADVANCED,
    PREFIX,
    SidebarPanel,
    draw_sentence,
    letters_of,
    parent_of,
    tables_below,
    width_of,
)
from ..task_progress import draw_task_progress, going_on
from .built import ChangedValue, Kept, built_values, change_of, change_of_use, changes, changes_of_table, has_changed
from .hints import breaking_note, contact_note, draw_first_help, draw_stability, next_step, undo_note
from .number_rows import draw_rows, numbers_in_row, row_unit
from .preset_menu import draw_presets
from .prop import INDEX, USE, label_of, shown_keys, shown_tables, title_of, vector_length
from .table_list import draw_list

_LABELS = {
    "bridge": "Sizes",
    "geometry": "Own Model",
    "exclusion": "Exclusion Zone",
    "cuts": "Severed Members",
    "recording": "What Is Recorded",
}
"""What panels of tables are called where the name of the table does not say what is in it."""

_OPEN = {"bridge"}
"""Tables whose panels are open from the start."""

_BUTTONS = {
    "geometry": "bda.add_selected_members",
    "fracture": "bda.use_paint",
    "zones": "bda.draw_zone",
}
"""Operators that fill in a table of a scenario."""

_ELSEWHERE = {"blast.explosion", "study.scenario", "report"}
"""Keys and tables that are drawn by hand, or that the panels stand for."""

_REINFORCEMENT = "reinforcement"
"""Name of both tables of bars: by hand, and by the rule of the bridge."""

_LETTERS_OF_VALUE = 9
_LISTED = 4
"""Changed values that are listed above the buttons; each is marked in its own panel as well."""

_PROMINENT = 1.5
"""Height of the buttons that most people need, over that of others."""

CHANGED = "ERROR"
"""Icon of values that have changed since the scene was built."""


@dataclass(frozen=True, slots=True)
class Row:
    """How a key is drawn: its field, name and labels, and whether it has a check box or several numbers."""

    item: Field
    name: str
    label: str
    label_of_rows: str
    is_optional: bool
    length: int
    is_number: bool
    is_check_box: bool


class BDA_PT_scenario(SidebarPanel, bpy.types.Panel):
    """Where a scenario comes from, and building it."""

    bl_label = "Scenario"
    bl_options = set()

    def draw_header_preset(self, context: Context) -> None:
        """Show the preview's switch, and an eye for connections and force fields once there are any."""
        self.layout.prop(context.scene.bda, "show_preview", text="", icon="MOD_WIREFRAME", emboss=False)
        if has_symbols(context.view_layer, context.scene):
            hidden = symbols_are_hidden(context.view_layer, context.scene)
            self.layout.operator("bda.toggle_symbols", text="", icon="HIDE_ON" if hidden else "HIDE_OFF", emboss=False)

    def draw(self, context: Context) -> None:
        layout, settings = self.layout, context.scene.bda
        if progress := going_on():
            draw_task_progress(layout, context, progress)
        else:
            draw_sentence(layout, context, next_step(context.scene), icon="FORWARD")
        if note := undo_note(context.scene):
            draw_sentence(layout, context, note, icon="INFO")
        draw_presets(layout, settings)
        column = layout.column(align=True)
        column.scale_y = _PROMINENT
        column.menu("BDA_MT_presets", icon="ASSET_MANAGER")
        column.operator("bda.build_scenario", icon="MOD_BUILD")
        draw_run(column, settings, has_changed=bool(changes(settings)))
        draw_messages(layout, context)
        draw_stability(layout, context)
        layout.prop(settings, "preview_run")
        layout.prop(settings, "scenario_path", text="", placeholder=translated("Scenario file"))
        row = layout.row(align=True)
        row.operator("bda.load_scenario", text="Load")
        row.operator("bda.save_scenario", text="Save")
        row.operator("bda.new_scenario", text="New")
        row = layout.row(align=True)
        row.operator("bda.import_ifc", icon="IMPORT")
        row.operator("bda.look_into_ifc", icon="VIEWZOOM")
        draw_first_help(layout, context)


class BDA_PT_advanced_scenario(SidebarPanel, bpy.types.Panel):
    """Title and seed, taking away what was built, and a workspace with charts."""

    bl_label = "Advanced"

    def draw(self, context: Context) -> None:
        layout, settings = self.layout, context.scene.bda
        draw_keys(layout, context, settings.scenario, Scenario, built_values(settings))
        column = layout.column(align=True)
        column.operator("bda.build_anew")
        column.operator("bda.remove_demolition")
        column.operator("bda.remove_loose_connections")
        column = layout.column(align=True)
        column.operator("bda.look_at_bridge", icon="LOOP_BACK")
        column.operator("bda.make_workspace", icon="WORKSPACE")


class _TablePanel(SidebarPanel):
    """Base of the panels that were made for a table; each knows its field and the names that lead to its group."""

    item: Field
    names: tuple[str, ...]

    def draw_header(self, context: Context) -> None:
        owner = self._owner(context)
        if is_optional(self.item):
            self.layout.prop(owner, USE + self.item.name, text="")
        if self._changes(context, owner):
            self.layout.label(icon=CHANGED)

    def draw(self, context: Context) -> None:
        owner, kept = self._owner(context), self._kept(context)
        layout = self.layout
        if not self.names and self.item.name in _BUTTONS:
            layout.operator(_BUTTONS[self.item.name])
        if self.item.name == _REINFORCEMENT:
            draw_bars(layout, context)
        if holds_many(self.item):
            draw_tables(layout, context, owner, self.item, kept)
            return
        draw_change_of_table(layout, context, owner, self.item, kept)
        layout.enabled = not is_optional(self.item) or getattr(owner, USE + self.item.name)
        inner_kept = kept and kept.get(self.item.name)
        draw_keys(layout, context, getattr(owner, self.item.name), subtable_class(self.item), inner_kept)
        if not self.names and self.item.name == "connections" and (note := breaking_note(owner)):
            draw_sentence(layout, context, note, icon="INFO")
        if not self.names and self.item.name == "contacts" and (note := contact_note(owner)):
            draw_sentence(layout, context, note, icon="INFO")

    def _owner(self, context: Context) -> PropertyGroup:
        group = context.scene.bda.scenario
        for name in self.names:
            group = getattr(group, name)
        return group

    def _kept(self, context: Context) -> Kept:
        """Return the built values of the table that this one stands in."""
        kept = built_values(context.scene.bda)
        for name in self.names:
            kept = kept and kept.get(name)
        return kept

    def _changes(self, context: Context, owner: PropertyGroup) -> bool:
        kept = self._kept(context)
        return kept is not None and any(True for _ in changes_of_table(owner, self.item, kept))


def draw_bars(layout: UILayout, context: Context) -> None:
    """Draw the switch that shows reinforcing bars, and why they cannot be shown."""
    layout.prop(context.scene.bda, "show_bars")
    _, reason = shown_bars(context.scene.bda)
    if reason:
        draw_sentence(layout, context, reason, icon="ERROR")


def draw_run(layout: UILayout, settings: PropertyGroup, *, has_changed: bool) -> None:
    """Draw the button Run, which builds again first where values have changed since the scene was built."""
    text = "Build Again and Run" if has_changed else "Run"
    run = layout.operator("bda.run", text=text, icon="PLAY")
    run.build_anew, run.pictures = has_changed, settings.pictures_of_run


def draw_changes(layout: UILayout, context: Context, changed: Sequence[ChangedValue]) -> None:
    """Draw which values have changed since the scene was built, with buttons that build or show them."""
    box = layout.box()
    draw_sentence(box, context, "Values have changed since this was built:", icon=CHANGED)
    for change in changed[:_LISTED]:
        text = translated("{}: {}, built {}").format(change.key, change.shown, change.built)
        draw_sentence(box, context, text, icon="NONE")
    if len(changed) > _LISTED:
        box.label(text=translated("and {} more").format(len(changed) - _LISTED), translate=False)
    row = box.row(align=True)
    row.operator("bda.build_anew")
    row.operator("bda.show_built")


def draw_keys(
    layout: UILayout,
    context: Context,
    group: PropertyGroup,
    table_class: type[Table],
    kept: Kept = None,
    *,
    without: Collection[str] = (),
) -> None:
    """Draw the keys of a table, each on a line, or on two where its label is long, and what has changed below it."""
    letters = letters_of(context)
    column = layout.column()
    for row in rows_of(table_class):
        if row.name in without:
            continue
        _draw_key(column, letters, group, row)
        if change := change_of(group, table_class, row.item, kept):
            draw_sentence(column, context, translated("built {}").format(change.built), icon=CHANGED)


def draw_change_of_table(layout: UILayout, context: Context, group: PropertyGroup, item: Field, kept: Kept) -> None:
    """Draw whether a table, or another number of tables, was used when the scene was built."""
    if kept is not None and (change := change_of_use(group, item, kept)):
        draw_sentence(layout, context, translated("built {}").format(change.built), icon=CHANGED)


def draw_tables(layout: UILayout, context: Context, group: PropertyGroup, item: Field, kept: Kept = None) -> None:
    """Draw a list of tables, and below it the keys and tables of the chosen one."""
    draw_list(layout, group, item)
    draw_change_of_table(layout, context, group, item, kept)
    tables, index = getattr(group, item.name), getattr(group, item.name + INDEX)
    if index >= len(tables):
        return
    table_class, built = subtable_class(item), (kept or {}).get(item.name) or []
    kept = built[index] if index < len(built) else None
    draw_keys(layout, context, tables[index], table_class, kept)
    for inner in shown_tables(table_class):
        box = layout.box()
        box.label(text=label_of(table_class, inner), text_ctxt=CONTEXT)
        if holds_many(inner):
            draw_tables(box, context, tables[index], inner, kept)
        else:
            _draw_inner(box, context, tables[index], inner, kept)


@cache
def rows_of(table_class: type[Table]) -> tuple[Row, ...]:
    """Return how the keys of a table are drawn, in their order."""
    return tuple(
        Row(
            item=item,
            name=item.name,
            label=label_of(table_class, item),
            label_of_rows=title_of(item) if row_unit(item) != "NONE" else label_of(table_class, item),
            is_optional=is_optional(item),
            length=vector_length(item) or 1,
            is_number=value_type(item) in (int, float),
            is_check_box=value_type(item) is bool,
        )
        for item in shown_keys(table_class)
        if key_name(table_class, item) not in _ELSEWHERE
    )


def table_panels() -> tuple[type[bpy.types.Panel], ...]:
    """Return the tables' panels; one for a table that has no place among the panels stands with rare actions."""
    panels: list[type[bpy.types.Panel]] = []
    for item in shown_tables(Scenario):
        if key_name(Scenario, item) in _ELSEWHERE:
            continue
        parent = None if parent_of(PREFIX + item.name) else DEMOLITION_ADVANCED
        panel = _panel(item, (), parent, _LABELS.get(item.name, label_of(Scenario, item)))
        panels += [panel, *_inner(item, (item.name,), panel.__name__)]
    return tuple(panels)


def _inner(item: Field, names: tuple[str, ...], parent: str) -> Iterator[type[bpy.types.Panel]]:
    """Return panels of the tables in a table; those in a list of tables are drawn with it."""
    if holds_many(item):
        return
    table_class = subtable_class(item)
    for inner in shown_tables(table_class):
        panel = _panel(inner, names, parent, label_of(table_class, inner))
        yield panel
        yield from _inner(inner, (*names, inner.name), panel.__name__)


def _panel(item: Field, names: tuple[str, ...], parent: str | None, label: str) -> type[bpy.types.Panel]:
    contents = {
        "__doc__": subtable_class(item).__doc__,
        "bl_label": label,
        "item": item,
        "names": names,
    }
    if parent:
        contents["bl_parent_id"] = parent
    if not names and item.name in _OPEN:
        contents["bl_options"] = set()
    return type(PREFIX + "_".join((*names, item.name)), (_TablePanel, bpy.types.Panel), contents)


def _draw_key(layout: UILayout, letters: int, group: PropertyGroup, row: Row) -> None:
    if row.is_check_box and not row.is_optional:
        layout.prop(group, row.name, text=row.label)
        return
    label = translated(row.label)
    width = width_of(label)
    fits = row.length == 1 and not numbers_in_row(row.item) and width + _LETTERS_OF_VALUE <= letters
    if not row.is_number:  # Blender gives part of a line to the label of a text or a choice
        fits = fits and width <= letters // (4 if row.is_optional else 2)
    if row.is_optional:
        line = layout.row(align=True)
        line.prop(group, USE + row.name, text="" if fits else row.label)
        line = line.row() if fits else layout.row()
        line.enabled = getattr(group, USE + row.name)
    else:
        heading = None if fits else layout.row()  # filled in once it is known whether rows have units of their own
        if numbers_in_row(row.item) and draw_rows(layout.column(align=True), group, row.item):
            heading.label(text=translated(row.label_of_rows) + ":", translate=False)
            return
        if heading:
            heading.label(text=label + ":", translate=False)
        line = layout.row(align=row.length > 1)
    line.prop(group, row.name, text=row.label if fits else "")


def _draw_inner(layout: UILayout, context: Context, group: PropertyGroup, item: Field, kept: Kept) -> None:
    draw_change_of_table(layout, context, group, item, kept)
    if is_optional(item):
        layout.prop(group, USE + item.name, text="Use")
        if not getattr(group, USE + item.name):
            return
    draw_keys(layout, context, getattr(group, item.name), subtable_class(item), kept and kept.get(item.name))


class _Holder(SidebarPanel):
    """Base of panels that hold others, and draw nothing themselves but a sign that a value in them has changed."""

    def draw_header(self, context: bpy.types.Context) -> None:
        """Show what a closed panel would hide."""
        if has_changed(context.scene.bda, tables_below(type(self).__name__)):
            self.layout.label(icon=CHANGED)

    def draw(self, _context: bpy.types.Context) -> None:
        """Draw nothing: its sub-panels have everything."""


class BDA_PT_group_bridge(_Holder, bpy.types.Panel):
    """The bridge by its sizes or as a model of your own, its site, and what it is made of."""

    bl_label = "Bridge"


class BDA_PT_advanced_bridge(_Holder, bpy.types.Panel):
    """How the bridge is cut, what holds it together, and what it stands on."""

    bl_label = "Advanced"


class BDA_PT_group_demolition(_Holder, bpy.types.Panel):
    """What brings the bridge down: ball, charges, cuts and machines, each at its time."""

    bl_label = "Demolition"


class BDA_PT_advanced_demolition(_Holder, bpy.types.Panel):
    """Actions that few demolitions have: weakenings, tendon cuts, loads, equipment and ground motion."""

    bl_label = "Advanced"


class BDA_PT_group_run_and_results(_Holder, bpy.types.Panel):
    """Run the demolition, look at what came of it, and make a report, pictures and films."""

    bl_label = "Run and Results"
    bl_options = set()  # open, as results come into it when a run has ended


class BDA_PT_advanced_run_and_results(_Holder, bpy.types.Panel):
    """Time and cameras, vectors, earlier runs, recording by hand and its files."""

    bl_label = "Advanced"


class BDA_PT_group_planning(_Holder, bpy.types.Panel):
    """Whether the bridge stands between its stages, and many runs: studies, searches and optimisations."""

    bl_label = "Planning"
