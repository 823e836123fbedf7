"""Reference of the keys of a scenario file, made from the dataclasses that check them.

``python -m bridge_demolition_addon.model.scenario.reference docs/scenario.md`` writes it.
"""

import re
import sys
from collections.abc import Collection, Iterator
from dataclasses import Field
from pathlib import Path

from ..schema import (
    Table,
    expected,
    given,
    holds_many,
    is_required,
    key_fields,
    key_of,
    subtable_class,
    subtable_fields,
)
from ..toml_tables import toml_value
from .scenario import Scenario

INTRODUCTION = """\
# Scenario files

<!-- Made by `python -m bridge_demolition_addon.model.scenario.reference docs/scenario.md`: change the code instead. -->

A scenario is a [TOML](https://toml.io) file. `bda check FILE` reads it and prints what follows from it, such as
masses. `bda run FILE` runs it. Start from one of the [examples](../examples). Every key has its unit in its name. A key
that is not listed here is refused, and so is a value outside its limits. A key without a default may be left out, and
so may a table that is not required; one in double brackets is given as often as needed. No number is larger
than any bridge has, such as 100 m of a thickness, 1000 m of a width, 1e8 m of anything else, 1e9 kg, 1e13 N or 1e6 s.

x runs along the road, with 0 at the axis of the first pier; y across it, with 0 in its middle; z up, with 0 at the
ground. The deck's top is as high as a pier, a pier cap, the girders or the box girder and the deck's slab together.

Friction and restitution are those of pairs of surfaces, `[contacts]`. [contacts.md](contacts.md) says what Bullet makes
of them, where the defaults are from, and what older files mean.

A variant gives only the values that differ from another scenario file, such as another position for the ball to fall:

```toml
[scenario]
based_on = "my_bridge.toml"      # a path from the folder of this file
without = ["zones"]              # tables or keys (such as "connections.material") of that file to leave out
title = "My bridge, ball on the second span"

[ball]
target_m = [19.5, 0.0]
```

Tables are merged key by key. Values and lists of tables (`[[...]]`) replace those in the other file.
"""


_SHORTER = (
    (r"^a text on one line, not blank$", "text"),
    (r"^(?:a|one of|a number) (?=list|text|\"|from|above|of at)", ""),
    (r"^a (?=number\b)", ""),
    (r"^a whole number\b", "whole"),
    (r"\blists? of (?:one or more )?", ""),
    (r"\bnumbers (?=from|above|of at)", "numbers, "),
    (r"\babove ", "> "),
    (r"\bof at least ", "≥ "),
    (r"\bfrom (?=[-\d])", ""),
    (r" and up to ", " to "),
    (r"(?<=\d)\.0\b", ""),
    (r"\btrue or false\b", "true, false"),
)
"""Patterns in what a key takes, and what stands for each in a table."""


def scenario_reference() -> str:
    """Return every table and key of a scenario file with its default, limits and meaning, in Markdown."""
    return reference(INTRODUCTION, Scenario)


def reference(introduction: str, root: type[Table], elsewhere: Collection[str] = ()) -> str:
    """Return every table and key of a file that holds a table, after an introduction, in Markdown.

    Tables whose names are in `elsewhere` stand on another page, and are left out.
    """
    return "\n".join([introduction, *_section(root, elsewhere, required=True)])


def _section(
    table_class: type[Table], elsewhere: Collection[str], *, required: bool, many: bool = False
) -> Iterator[str]:
    yield f"## [[{table_class.table}]]" if many else f"## [{table_class.table}]"
    yield ""
    yield meaning(table_class) + (" Required." if required else "")
    yield ""
    if rows := list(map(_row, key_fields(table_class))):
        yield from ("| Key | Value | Default | Meaning |", "| --- | --- | --- | --- |", *rows, "")
    for item in subtable_fields(table_class):
        inner = given(subtable_class(item))
        if inner.table not in elsewhere:
            yield from _section(inner, elsewhere, required=is_required(item), many=holds_many(item))


def _row(item: Field) -> str:
    default = "" if default_text(item) == "none" else default_text(item)
    return f"| `{item.name}` | {value_text(item)} | {default} | {key_of(item).description} |"


def value_text(item: Field) -> str:
    """Return what a key takes as a table has it, such as ``> 0 (m)``: `expected` in as few words as can be."""
    text = expected(item)
    for long, short in _SHORTER:
        text = re.sub(long, short, text)
    return text


def default_text(item: Field) -> str:
    """Return the value of a key that is left out, as the reference gives it."""
    if is_required(item):
        return "required"
    return "none" if item.default is None else f"`{toml_value(item.default)}`"


def meaning(table_class: type[Table]) -> str:
    """Return what a table is, on one line."""
    return " ".join((table_class.__doc__ or "").split())


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(scenario_reference(), encoding="utf-8", newline="\n")
