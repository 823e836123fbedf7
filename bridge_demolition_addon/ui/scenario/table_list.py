"""Lists of tables in the sidebar: a row for each table, and buttons to add, remove and move them."""

from dataclasses import Field

import bpy
from bpy.props import EnumProperty, StringProperty

from ...errors import ScenarioError
from ...model.schema import is_optional, key_fields
from ..operators import UndoableAction
from .prop import INDEX, USE, all_tables, group_name

LIST = "BDA_UL_tables"
_MOST_NUMBERS = 3


class _ListOperator(UndoableAction):
    """Base of the operators on one list."""

    path: StringProperty(name="List", description="Where the list is, from the scene: bda.scenario.fracture.members")

    def act(self, context: bpy.types.Context) -> None:
        owner, _, name = self.path.rpartition(".")
        try:
            group = context.scene.path_resolve(owner)
            tables = getattr(group, name)
        except (ValueError, AttributeError) as error:
            raise ScenarioError(f"{self.path}: there is no such list of tables") from error
        setattr(group, name + INDEX, self.change(tables, getattr(group, name + INDEX)))

    def change(self, tables: bpy.types.bpy_prop_collection, index: int) -> int:
        """Change the list, and return the index of the table that is chosen now."""
        return index


class BDA_OT_add_table(_ListOperator, bpy.types.Operator):
    """Add one more to the list"""

    bl_label = "Add"

    def change(self, tables: bpy.types.bpy_prop_collection, index: int) -> int:
        tables.add()
        return len(tables) - 1


class BDA_OT_remove_table(_ListOperator, bpy.types.Operator):
    """Remove the chosen one from the list"""

    bl_label = "Remove"

    def change(self, tables: bpy.types.bpy_prop_collection, index: int) -> int:
        if index >= len(tables):
            raise ScenarioError("Choose what to remove in the list first")
        tables.remove(index)
        return max(min(index, len(tables) - 1), 0)


class BDA_OT_move_table(_ListOperator, bpy.types.Operator):
    """Move the chosen one up or down in the list"""

    bl_label = "Move"

    direction: EnumProperty(name="Direction", items=[("UP", "Up", ""), ("DOWN", "Down", "")])

    def change(self, tables: bpy.types.bpy_prop_collection, index: int) -> int:
        target = index + (-1 if self.direction == "UP" else 1)
        if not (0 <= index < len(tables) and 0 <= target < len(tables)):
            return index
        tables.move(index, target)
        return target


class BDA_UL_tables(bpy.types.UIList):
    """Tables of one kind, each shown by its first value."""

    def draw_item(self, context, layout, data, item, icon, active_data, active_property, index) -> None:
        """Draw a row: its number and its first value."""
        layout.label(text=f"{index + 1}  {_summary(item)}", translate=False)


def draw_list(layout: bpy.types.UILayout, group: bpy.types.PropertyGroup, item: Field) -> None:
    """Draw the list of a field with its buttons."""
    path = group.path_from_id(item.name)
    row = layout.row()
    row.template_list(LIST, path, group, item.name, group, item.name + INDEX, rows=3)
    buttons = row.column(align=True)
    buttons.operator("bda.add_table", text="", icon="ADD").path = path
    buttons.operator("bda.remove_table", text="", icon="REMOVE").path = path
    for direction in ("UP", "DOWN"):
        move = buttons.operator("bda.move_table", text="", icon=f"TRIA_{direction}")
        move.path, move.direction = path, direction


def _summary(group: bpy.types.PropertyGroup) -> str:
    """Return the first value of a table as text."""
    table_class = next(table for table in all_tables() if group_name(table) == type(group).__name__)
    for item in key_fields(table_class):
        if is_optional(item) and not getattr(group, USE + item.name):
            continue
        value = getattr(group, item.name)
        if isinstance(value, str | int | float):
            return f"{value:g}" if isinstance(value, float) else str(value)
        return ", ".join(f"{number:g}" for number in list(value)[:_MOST_NUMBERS])
    return ""
