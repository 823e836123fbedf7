"""Blender properties for all keys of a scenario, made from the dataclasses that check them.

There is one property group for each table, nested as the tables are. An optional key or table has a check box next to
it, ``use_`` and its name; a list of tables is a collection with the index of its active one, its name and ``_index``.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import MISSING, Field, fields
from functools import cache
from pathlib import Path
from typing import Any, get_args

import bpy
from bpy.props import (
    BoolProperty,
    CollectionProperty,
    EnumProperty,
    FloatProperty,
    FloatVectorProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

from ...model.optimise.settings import ChosenQuantity, OptimiseSettings
from ...model.run_folder.files import SCENARIO_FILE
from ...model.scenario import Scenario
from ...model.scenario.contacts import BodyInContact
from ...model.scenario.file import read_scenario
from ...model.schema import (
    Key,
    Table,
    holds_many,
    is_optional,
    is_required,
    key_fields,
    key_name,
    key_of,
    subtable_class,
    subtable_fields,
    value_type,
)
from ...model.search.settings import SearchSettings
from ...model.study.criteria import Criterion
from ...model.study.keys import names_to_propose
from ...model.study.settings import EnsembleSettings, StudySettings
from ...model.toml_tables import toml_value
from ..languages.words import in_own_context
from ..sidebar import tooltip
from .key_tooltips import tooltip_of
from .number_rows import row_properties

PRESETS = Path(__file__).parent / "presets"
DEFAULT_PRESET = PRESETS / "reinforced_span_ball.toml"
EARLIER_DEFAULT = PRESETS / "span_of_2019_ball.toml"
"""What a new scene showed before, and what files of then do not hold, as Blender saves only what was set."""

ENSEMBLES = {"study": StudySettings, "search": SearchSettings, "optimise": OptimiseSettings}
"""Groups of the scene in addition to that of the scenario."""

_SHARED = {item.name for item in fields(EnsembleSettings)}

USE = "use_"
INDEX = "_index"
GIVEN = "given"
"""Property of a group: the numbers of its table as they were loaded, in JSON, as Blender has single precision only."""

BLENDER_UNITS = {
    "m": "LENGTH",
    "m²": "AREA",
    "m³": "VOLUME",
    "kg": "MASS",
    "s": "TIME_ABSOLUTE",
    "m/s": "VELOCITY",
    "m/s²": "ACCELERATION",
}
"""Units that Blender shows beside a number itself, and turns into others where the user prefers them."""

_PER_SECOND = "1/s"
"""A unit that the names of its keys spell out."""

_DECIMALS = 3
_WORDS = {
    "places": "positions",
    "trials": "runs",
    "turning": "rotational",
}
"""What labels say in place of words in keys, which keep their names."""

_SMALL_WORDS = {"a", "and", "at", "by", "for", "in", "of", "on", "or", "per", "the", "to"}


@cache
def vector_length(item: Field) -> int | None:
    """Return how many numbers a key holds, None for one that does not hold a fixed number of them."""
    kinds = get_args(value_type(item))
    return len(kinds) if holds_many(item) and set(kinds) == {float} else None


@cache
def is_written_out(item: Field) -> bool:
    """Return whether a key's value is shown as a text in the syntax of TOML: a list that is no vector."""
    return holds_many(item) and vector_length(item) is None


def shown_keys(table_class: type[Table]) -> list[Field]:
    """Return the keys of a table; of searches and optimisations those that they do not share with studies.

    Of a study its own come first, then those that it shares.
    """
    keys = [item for item in key_fields(table_class) if not _is_of_study(table_class, item)]
    return sorted(keys, key=lambda item: table_class is StudySettings and item.name in _SHARED)


def shown_tables(table_class: type[Table]) -> list[Field]:
    """Return the fields of the tables in a table, but for the charges, which are objects of the scene."""
    tables = (item for item in subtable_fields(table_class) if not subtable_class(item).is_object)
    return [item for item in tables if not _is_of_study(table_class, item)]


def _is_of_study(table_class: type[Table], item: Field) -> bool:
    """Return whether the panel Study shows a setting for searches and optimisations too."""
    return table_class in (SearchSettings, OptimiseSettings) and item.name in _SHARED


def label_of(_table_class: type[Table], item: Field) -> str:
    """Return what a key or table is called in the sidebar, with its unit where Blender does not show that itself."""
    return title_of(item) + unit_in_label(item)


def title_of(item: Field) -> str:
    """Return what a key or table is called, without a unit."""
    if not subtable_class(item) and (label := key_of(item).label):
        return label
    unit = "" if subtable_class(item) else key_of(item).unit
    return _titled(item.name.removesuffix("_" + _in_names(unit)) if unit else item.name)


def unit_in_label(item: Field) -> str:
    """Return the unit of a key as its label has it, such as `` (mm²)``; empty where Blender shows it."""
    unit = "" if subtable_class(item) else key_of(item).unit
    return f" ({unit})" if unit and unit != _PER_SECOND and unit_of(item) == "NONE" else ""


def unit_of(item: Field) -> str:
    """Return Blender's name for the unit of a key, NONE where it has none."""
    kinds = get_args(value_type(item)) or (value_type(item),)
    return BLENDER_UNITS.get(key_of(item).unit, "NONE") if set(kinds) == {float} else "NONE"


def group_name(table_class: type[Table]) -> str:
    """Return the name of the property group for a table."""
    return "BDA_PG_" + re.sub(r"\W", "_", table_class.table)


@cache
def all_tables() -> tuple[type[Table], ...]:
    """Return all tables that have a property group, inner ones first."""
    roots = (Scenario, *ENSEMBLES.values())
    return tuple(dict.fromkeys(table for root in roots for table in _with_inner(root)))


@cache
def default_scenario() -> Scenario:
    """Return the scenario of a new scene."""
    return read_scenario(DEFAULT_PRESET)


def _default_ensembles() -> tuple[EnsembleSettings, ...]:
    """Return the study, search and optimisation of a new scene."""
    shared: dict[str, Any] = {"scenario": SCENARIO_FILE, "criteria": (Criterion(name="collapsed", kind="collapsed"),)}
    quantity: dict[str, Any] = {"key": "charges.mass_kg", "factor": True, "logarithmic": True}
    quantity |= {"lowest": 0.1, "highest": 4.0}
    search = SearchSettings(trials=40, **shared, **quantity)
    optimise = OptimiseSettings(objective="reach", quantities=(ChosenQuantity(**quantity),), **shared)
    return StudySettings(scenario=SCENARIO_FILE), search, optimise


def register() -> None:
    """Register all groups with Blender: whole scenario, study, search and optimisation last."""
    for group in _groups():
        bpy.utils.register_class(group)


@cache
def _groups() -> tuple[type[bpy.types.PropertyGroup], ...]:
    """Return all groups, inner ones first; they stay where the user switches the extension off and on."""
    defaults: dict[type[Table], Table] = {}
    for table in (default_scenario(), *_default_ensembles()):
        defaults |= _default_tables(table)
    groups: dict[type[Table], type[bpy.types.PropertyGroup]] = {}
    for table_class in all_tables():
        groups[table_class] = in_own_context(_group(table_class, defaults.get(table_class), groups))
    return tuple(groups.values())


def unregister() -> None:
    """Unregister all groups."""
    for table_class in reversed(all_tables()):
        bpy.utils.unregister_class(registered_group(group_name(table_class)))


def registered_group(name: str) -> type[bpy.types.PropertyGroup]:
    """Return the registered property group of that name."""
    return bpy.types.PropertyGroup.bl_rna_get_subclass_py(name)


def _with_inner(table_class: type[Table]) -> Iterator[type[Table]]:
    for item in shown_tables(table_class):
        yield from _with_inner(subtable_class(item))
    yield table_class


def _default_tables(table: Table) -> dict[type[Table], Table]:
    defaults = {type(table): table}
    for item in shown_tables(type(table)):
        if isinstance(inner := getattr(table, item.name), Table):
            defaults |= _default_tables(inner)
    return defaults


def _group(
    table_class: type[Table], defaults: Table | None, groups: dict[type[Table], type[bpy.types.PropertyGroup]]
) -> type[bpy.types.PropertyGroup]:
    properties: dict[str, Any] = {GIVEN: StringProperty(options={"HIDDEN"})}
    for item in shown_keys(table_class):
        properties.update(_key_properties(table_class, item, default_value(item, defaults)))
    for item in shown_tables(table_class):
        properties.update(_table_properties(item, defaults, groups[subtable_class(item)]))
    contents = {"__doc__": table_class.__doc__, "__annotations__": properties}
    return type(group_name(table_class), (bpy.types.PropertyGroup,), contents)


def _table_properties(item: Field, defaults: Table | None, group: type[bpy.types.PropertyGroup]) -> dict[str, Any]:
    meaning = tooltip(subtable_class(item).__doc__)
    if holds_many(item):
        return {
            item.name: CollectionProperty(type=group, name=_titled(item.name), description=meaning),
            item.name + INDEX: IntProperty(name="Active", description="Which of the list is shown below it", min=0),
        }
    properties: dict[str, Any] = {item.name: PointerProperty(type=group, name=_titled(item.name), description=meaning)}
    if is_optional(item):
        is_used = defaults is not None and getattr(defaults, item.name) is not None
        properties[USE + item.name] = BoolProperty(name=_titled(item.name), description=meaning, default=is_used)
    return properties


def _key_properties(table_class: type[Table], item: Field, default: Any) -> dict[str, Any]:
    label, meaning = label_of(table_class, item), tooltip_of(table_class, item)
    rule, name = key_of(item), key_name(table_class, item)
    words: dict[str, Any] = {"name": label, "description": meaning}
    if issubclass(table_class, BodyInContact) and item.name in table_class.older_values:
        words["update"] = _use_what_is_set(item.name)
    propose = _PROPOSED.get(name)
    properties = {item.name: _proposing(rule, default, propose, words) if propose else _property(item, default, words)}
    properties.update(row_properties(item, words))
    if is_optional(item):
        properties[USE + item.name] = BoolProperty(name=label, description=meaning, default=default is not None)
    return properties


def _use_what_is_set(name: str) -> Callable[[bpy.types.PropertyGroup, bpy.types.Context], None]:
    """Return what ticks the check box of a key once a script sets its value, as scripts did before it had one."""

    def update(group: bpy.types.PropertyGroup, _context: bpy.types.Context) -> None:
        setattr(group, USE + name, True)

    return update


def _property(item: Field, default: Any, words: dict[str, str]) -> Any:
    rule, kind = key_of(item), value_type(item)
    if kind is bool:
        return BoolProperty(default=bool(default), **words)
    if rule.choices and kind is str:
        items = [(choice, choice, "") for choice in rule.choices]
        return EnumProperty(items=items, default=default or rule.choices[0], **words)
    if kind is str:
        is_path = item.name == "file" or item.name.endswith("_file")
        return StringProperty(default=default or "", subtype="FILE_PATH" if is_path else "NONE", **words)
    if is_written_out(item):
        return StringProperty(default="" if default is None else toml_value(default), **words)
    return _number_property(item, default, words)


def _proposing(
    rule: Key, default: Any, propose: Callable[[bpy.types.PropertyGroup, Key], Iterable[str]], words: dict[str, str]
) -> Any:
    """Return a property for a text, with texts that it proposes as the user types."""

    def search(group: bpy.types.PropertyGroup, _context: bpy.types.Context, typed: str) -> list[str]:
        return [text for text in propose(group, rule) if typed.casefold() in text.casefold()]

    return StringProperty(default=default or next(iter(rule.choices), ""), search=search, **words)


def materials_to_propose(group: bpy.types.PropertyGroup, rule: Key) -> list[str]:
    """Return the materials that a key may name: those that come with it, and the user's own."""
    return [*rule.choices, *(material.name for material in group.id_data.bda.scenario.materials)]


_PROPOSED = {
    "connections.material": materials_to_propose,
    "connections.between.material": materials_to_propose,
    **{f"{table}.key": lambda _group, _rule: names_to_propose() for table in ("vary", "search", "quantities")},
}
"""Keys that propose texts, and take others too."""


def _number_property(item: Field, default: Any, words: dict[str, str]) -> Any:
    """Return a property for a number or a vector, with limits that Blender clamps to.

    Blender has no limit that a number has to exceed: the scenario's own check refuses the limit itself.
    """
    rule, kind = key_of(item), value_type(item)
    is_whole = kind is int
    limits = {"min": rule.at_least if rule.above is None else rule.above + is_whole, "max": rule.at_most}
    settings = words | {
        name: (int if is_whole else float)(limit) for name, limit in limits.items() if limit is not None
    }
    if is_whole:
        return IntProperty(default=int(_least(rule) if default is None else default), **settings)
    settings.update(unit=unit_of(item), precision=_DECIMALS)
    if length := vector_length(item):
        return FloatVectorProperty(size=length, subtype="XYZ", default=default or (_least(rule),) * length, **settings)
    return FloatProperty(default=_least(rule) if default is None else default, **settings)


def _least(rule: Key) -> float:
    """Return a value that is within the limits, for a number without a default."""
    lowest = max((limit for limit in (rule.at_least, rule.above, 0.0) if limit is not None), default=0.0)
    if rule.holds(lowest):
        return lowest
    return 1.0 if rule.holds(1.0) else rule.at_most


def default_value(item: Field, defaults: Table | None) -> Any:
    """Return the value of a key in the table of defaults, else its own default, else None."""
    if defaults is not None:
        return getattr(defaults, item.name)
    if not is_required(item):
        return item.default if item.default is not MISSING else item.default_factory()
    return None


def _titled(name: str) -> str:
    words = " ".join(_WORDS.get(word, word) for word in name.split("_")).split()
    return " ".join(word if word in _SMALL_WORDS and number else word.capitalize() for number, word in enumerate(words))


def _in_names(unit: str) -> str:
    """Return a unit as it ends the names of keys."""
    return unit.lower().translate({ord("/"): "_", ord("³"): "3", ord("²"): "2", ord("°"): "deg", ord("·"): None})
