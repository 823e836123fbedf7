# SPDX-License-Identifier: GPL-3.0-or-later
"""List what the tables of languages lack, and what they have that the window no longer shows.

Prints for each language lines that can be copied into its table, ``ui/languages/NAME.toml``, and filled in. The exit
status is 0 where no label and no sentence is missing in any language, and nothing is stale.
"""

import ast
import json
import re
import sys
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import bpy

import bridge_demolition_addon
from bridge_demolition_addon.model.schema import Table, is_optional, key_of
from bridge_demolition_addon.ui import registration
from bridge_demolition_addon.ui.ensemble.session import WORKS
from bridge_demolition_addon.ui.ifc import BDA_PG_ifc_element
from bridge_demolition_addon.ui.languages.tables import LanguageTable, table_files
from bridge_demolition_addon.ui.scenario.key_tooltips import IN_FILE, WITH_TYPICAL, meaning_of
from bridge_demolition_addon.ui.scenario.number_rows import MOST_ROWS, row_name
from bridge_demolition_addon.ui.scenario.preset_menu import label_of_preset, preset_files
from bridge_demolition_addon.ui.scenario.prop import (
    USE,
    all_tables,
    group_name,
    registered_group,
    shown_keys,
    title_of,
)
from bridge_demolition_addon.ui.scene_settings import BDA_PG_settings

UI = Path(registration.__file__).parent

SAME = {
    *("2019", "A", "B", "C", "D", "E", "x", "y", "z", "g", "m/s2", "cm/s2", "kg"),
    *("Alembic", "GlobalId", "MATLAB", "ParaView", "USD"),
    *("Cividis", "Inferno", "Viridis", "cycles", "workbench"),
    *("ANFO", "C-4", "HMX", "PETN", "RDX", "Semtex", "TNT"),
    *("B400B", "B400C", "B500A", "B500B", "B500C", "HL-93", "LM1"),
    *("FIXED", "GENERIC", "GENERIC_SPRING", "HINGE", "POINT"),
    *("kingery-bulmash", "kinney-graham"),
    *("English", "Deutsch", "Español", "Français", "简体中文"),
    *("en", "de", "es", "fr", "zh_hans"),
    *("LENGTH", "NONE", "ifc_elements", "optimise", "scenario"),
}
"""Names and signs that are the same in all languages, and names that are never shown."""

SOURCE = re.compile(r"[\d.]+ kPa, ")
"""Begin of tooltips that give a number and where it comes from."""

OF_BLENDER = {"rna_type", "name", "check_existing"}
"""Properties that Blender brings along, with texts of its own."""

SHOWN_CONSTANTS = {"SENTENCES", "_HEADS", "RUNNING", "_STAGES", "_MEMBERS", "text", "words", "task", "unit"}
"""Constants of modules and classes, and local names, whose texts panels show."""

DRAWN = {"text"}
"""Arguments of what draws a part of a panel, which Blender looks up itself."""


@dataclass
class WindowTexts:
    """English texts of the window, by the parts of a table."""

    labels: set[str] = field(default_factory=set)
    sentences: set[str] = field(default_factory=set)
    tooltips: set[str] = field(default_factory=set)

    def note(self, label: str = "", tooltip: str = "") -> None:
        """Add a label and a tooltip, where they are not empty."""
        self.labels |= {label} - {""}
        self.tooltips |= {tooltip} - {""}


def window_texts() -> WindowTexts:
    """Return all texts of the window; the extension has to be registered."""
    texts = WindowTexts()
    for cls in registration.classes():
        if issubclass(cls, bpy.types.Operator):
            operator = getattr(bpy.ops.bda, cls.bl_idname.removeprefix("bda.")).get_rna_type()
            texts.note(operator.name, operator.description)
            note_properties(texts, operator)
        else:
            texts.note(getattr(cls, "bl_label", ""), getattr(cls, "bl_description", ""))
    for group in (BDA_PG_settings, BDA_PG_ifc_element):
        note_properties(texts, group.bl_rna)
    for table_class in all_tables():
        note_keys(texts, table_class)
    for name in preset_files():
        texts.note(label_of_preset(name))
    texts.sentences |= {work.name for work in WORKS}
    for path in sorted(UI.rglob("*.py")):
        texts.sentences |= set(texts_in(ast.parse(path.read_text(encoding="utf-8"))))
    texts.tooltips |= {IN_FILE, WITH_TYPICAL}
    texts.labels -= SAME
    texts.sentences -= texts.labels | SAME | {""}
    texts.tooltips = {text for text in texts.tooltips if not SOURCE.match(text)}
    return texts


def note_properties(texts: WindowTexts, rna: bpy.types.Struct, without: Iterable[str] = ()) -> None:
    """Note labels and tooltips of the properties of a group or an operator, and of their choices."""
    for prop in rna.properties:
        if prop.identifier in OF_BLENDER or prop.identifier in without or prop.is_hidden:
            continue
        if prop.name != prop.identifier or prop.description:  # else it has no text of its own
            texts.note(prop.name, prop.description)
        for item in prop.enum_items_static if prop.type == "ENUM" else ():
            texts.note(item.name, item.description)


def note_keys(texts: WindowTexts, table_class: type[Table]) -> None:
    """Note what a table of a scenario has: its keys, whose units and limits are put in by program, and other tables."""
    keys = shown_keys(table_class)
    for item in keys:
        texts.note(title_of(item), meaning_of(item))
        if is_choice(item):
            texts.labels |= set(key_of(item).choices)
    names = {name for item in keys for name in names_of(item)}
    note_properties(texts, registered_group(group_name(table_class)).bl_rna, without=names | {"given"})


def names_of(item: object) -> list[str]:
    """Return the names of all properties of a key."""
    rows = [row_name(item.name, number) for number in range(MOST_ROWS)]
    return [item.name, *rows, *([USE + item.name] if is_optional(item) else [])]


def is_choice(item: object) -> bool:
    """Return whether a key shows its choices in a menu."""
    return bool(key_of(item).choices) and not key_of(item).or_else


def texts_in(module: ast.Module) -> Iterator[str]:
    """Give the texts that a module shows: of labels and buttons, sentences, and why a button cannot work."""
    for node in ast.walk(module):
        match node:
            case ast.Call(func=ast.Name("translated"), args=[text]):
                yield from constants(text)
            case ast.Call(func=ast.Name("map"), args=[ast.Name("translated"), ast.Tuple(elts=parts)]):
                yield from (text for part in parts for text in constants(part))
            case ast.Call(func=ast.Name("draw_sentence" | "unset"), args=arguments):
                yield from (text for argument in arguments[1:] for text in constants(argument))
            case ast.Call(func=ast.Attribute(attr="stage"), args=[text]):
                yield from constants(text)
            case ast.Return(value=value) | ast.Lambda(body=value) if value:
                yield from (text for text in constants(value) if is_sentence(text))
            case ast.Assign(targets=[target], value=value) if SHOWN_CONSTANTS & set(names_in(target)):
                yield from constants(value)
        if isinstance(node, ast.Call):
            drawn = [keyword.value for keyword in node.keywords if keyword.arg in DRAWN]
            yield from (text for value in drawn for text in constants(value) if text)


def put_together(module: ast.Module) -> Iterator[str]:
    """Give the texts with words in them that a module puts together where it draws them: no table can have them."""
    for node in ast.walk(module):
        if not isinstance(node, ast.Call):
            continue
        is_sentence_drawn = isinstance(node.func, ast.Name) and node.func.id == "draw_sentence"
        drawn = [keyword.value for keyword in node.keywords if keyword.arg in DRAWN]
        for value in (*drawn, *(node.args if is_sentence_drawn else ())):
            fixed = "".join(constants(ast.Tuple(elts=value.values))) if isinstance(value, ast.JoinedStr) else ""
            if re.search(r"[a-z]{2}", fixed):
                yield ast.unparse(value)


def constants(node: ast.expr) -> Iterator[str]:
    """Give the texts that an expression may come to; none of those that are put together."""
    match node:
        case ast.Constant(value=str(text)):
            yield text
        case ast.IfExp(body=body, orelse=other):
            yield from (*constants(body), *constants(other))
        case ast.BoolOp(values=parts) | ast.Tuple(elts=parts) | ast.Dict(values=parts):
            yield from (text for part in parts for text in constants(part))


def is_sentence(text: str) -> bool:
    """Return whether what a function returns is a text for people, and no name."""
    return text[:1].isupper() and " " in text


def names_in(target: ast.expr) -> list[str]:
    """Return the names that an assignment sets."""
    return [node.id for node in ast.walk(target) if isinstance(node, ast.Name)]


def differences(table: dict[str, str], wanted: set[str]) -> tuple[list[str], list[str]]:
    """Return the texts that a part of a table lacks, and those that it has in excess."""
    return sorted(wanted - set(table)), sorted(set(table) - wanted)


def main() -> int:
    """Print what is missing and what is stale, and return the exit status."""
    bridge_demolition_addon.register()
    texts = window_texts()
    bridge_demolition_addon.unregister()
    failed = False
    for path in table_files():
        table = LanguageTable.read(path)
        for part in ("labels", "sentences", "tooltips"):
            missing, stale = differences(getattr(table, part), getattr(texts, part))
            print(
                f"# {path.name}, {part}: {len(getattr(table, part))} there, {len(missing)} missing, {len(stale)} stale"
            )
            print("".join(f'{json.dumps(text, ensure_ascii=False)} = ""\n' for text in missing), end="")
            print("".join(f"# stale: {text}\n" for text in stale), end="")
            failed |= bool(stale) or (part != "tooltips" and bool(missing))
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
