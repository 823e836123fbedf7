"""A scenario from the sidebar's properties, and back, without loss.

Blender's numbers have single precision. A number that the user did not touch is the one that was loaded; any other is
the shortest decimal that single precision takes for it, which is what the user typed.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import Field, replace
from typing import Any

import bpy

from ...engineering.single_precision import as_given
from ...errors import BlastError, ScenarioError
from ...model.scenario import Charge, Scenario
from ...model.scenario.kept import table_values, values_from_text, values_text
from ...model.schema import (
    Table,
    expected,
    holds_many,
    is_optional,
    key_name,
    numbered_tables,
    shown,
    subtable_class,
    value_type,
)
from ...model.toml_tables import toml_value
from ...scene.blast.charges import charges_of, replace_charges
from .number_rows import list_in
from .prop import GIVEN, USE, is_written_out, shown_keys, shown_tables, vector_length

_ROUNDING = 1e-14
"""Relative difference of a delay that only comes from keeping it in s."""


def scenario_of(settings: bpy.types.PropertyGroup) -> Scenario:
    """Return the scenario that the sidebar shows, with the charges of its scene."""
    return table_of(settings.scenario, Scenario, charges=_charges(settings))


def table_of(group: bpy.types.PropertyGroup, table_class: type[Table], **others: Any) -> Table:
    """Return the table that a property group shows, with `others` in place of the values that it shows."""
    loaded = values_from_text(getattr(group, GIVEN), {})
    values = {item.name: _value(group, table_class, item, loaded.get(item.name)) for item in shown_keys(table_class)}
    for item in shown_tables(table_class):
        values[item.name] = inner_of(group, item)
    return table_class(**values | others)


def inner_of(group: bpy.types.PropertyGroup, item: Field) -> Table | tuple[Table, ...] | None:
    """Return the table, or the tables, that a group shows in one field; None where it is not used."""
    table_class = subtable_class(item)
    inner = getattr(group, item.name)
    if not holds_many(item):
        return None if is_optional(item) and not getattr(group, USE + item.name) else table_of(inner, table_class)
    return numbered_tables(table_class, inner, lambda part: table_of(part, table_class))


def show_scenario(settings: bpy.types.PropertyGroup, scenario: Scenario) -> None:
    """Show a scenario in the sidebar, and its charges in the scene in place of those that were there."""
    show_table(settings.scenario, scenario)
    empties = replace_charges(settings.id_data, scenario.charges)
    loaded = {empty.name: table_values(charge) for empty, charge in zip(empties, scenario.charges, strict=True)}
    settings.charges_given = values_text(loaded)
    settings.charge_index = 0


def show_table(group: bpy.types.PropertyGroup, table: Table) -> None:
    """Show a table in its property group."""
    reset(group)
    show_fields(group, table, [*shown_keys(type(table)), *shown_tables(type(table))])


def show_fields(group: bpy.types.PropertyGroup, table: Table, items: Sequence[Field]) -> None:
    """Show some keys and tables of a table in a property group that has them."""
    loaded = values_from_text(getattr(group, GIVEN), {})
    for item in items:
        value = getattr(table, item.name)
        if subtable_class(item):
            show_inner(group, item, value)
            continue
        if is_optional(item):
            setattr(group, USE + item.name, value is not None)
        if value is None:
            continue
        if value_type(item) is float or vector_length(item):
            loaded[item.name] = value
        setattr(group, item.name, toml_value(value) if is_written_out(item) else value)
    setattr(group, GIVEN, values_text(loaded))


def show_inner(group: bpy.types.PropertyGroup, item: Field, inner: Table | tuple[Table, ...] | None) -> None:
    """Show the table, or the tables, of one field in place of what the group shows of it."""
    shown_in = getattr(group, item.name)
    if holds_many(item):
        shown_in.clear()
        for table in inner:
            show_table(shown_in.add(), table)
        return
    if is_optional(item):
        setattr(group, USE + item.name, inner is not None)
    if inner is None:
        reset(shown_in)
    else:
        show_table(shown_in, inner)


def reset(group: bpy.types.PropertyGroup) -> None:
    """Set all properties of a group, and of the groups in it, to their defaults."""
    for prop in group.bl_rna.properties:
        if prop.identifier == "rna_type":  # Blender's own, which describes the group
            continue
        if prop.type == "POINTER":
            reset(getattr(group, prop.identifier))
        elif prop.type == "COLLECTION":
            getattr(group, prop.identifier).clear()
        elif not prop.is_readonly:
            group.property_unset(prop.identifier)


def list_of(text: str, name: str, item: Field) -> list:
    """Return a list from TOML; brackets around it may be left out. The error of a text that is no list says `name`."""
    if (values := list_in(text)) is not None:
        return values
    raise ScenarioError(f"{name} is {shown(text)}: expected {expected(item)}")


def _value(group: bpy.types.PropertyGroup, table_class: type[Table], item: Field, loaded: Any) -> Any:
    if is_optional(item) and not getattr(group, USE + item.name):
        return None
    value = getattr(group, item.name)
    if is_written_out(item):
        return list_of(value, key_name(table_class, item), item)
    if vector_length(item):
        return tuple(map(as_given, value, loaded or [None] * len(value)))
    return as_given(value, loaded) if value_type(item) is float else value


def _charges(settings: bpy.types.PropertyGroup) -> Iterable[Charge]:
    loaded = values_from_text(settings.charges_given, {})
    scene = settings.id_data
    scene.view_layers[0].update()  # a script may have moved one just now
    try:
        charges = charges_of(scene)
    except BlastError as error:
        raise ScenarioError(str(error)) from error
    return tuple(_as_loaded(charge, loaded.get(charge.name, {})) for charge in charges)


def _as_loaded(charge: Charge, loaded: dict[str, Any]) -> Charge:
    """Return a charge of the scene, with all digits of the values that did not change since it was loaded."""
    delay_ms = loaded.get("delay_ms", charge.delay_ms)
    return replace(
        charge,
        name=loaded.get("name") or charge.name,
        position_m=tuple(
            map(as_given, charge.position_m, loaded.get("position_m", loaded.get("place_m", (None,) * 3)))
        ),
        delay_ms=delay_ms if math.isclose(delay_ms, charge.delay_ms, rel_tol=_ROUNDING) else charge.delay_ms,
    )
