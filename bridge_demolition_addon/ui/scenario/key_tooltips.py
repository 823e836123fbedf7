"""Tooltips of the keys of a scenario: what a key means, a typical value, its name in a file and what it takes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import Field

from ...model.schema import Key, Table, expected, key_name, key_of, value_type
from ..sidebar import tooltip
from .typical_values import typical_text

IN_FILE = "{}. In a scenario file: {}"
WITH_TYPICAL = "{}. Typical: {}. In a scenario file: {}"
"""Patterns of tooltips in other languages: meaning, typical value, name and limits."""


def meaning_of(item: Field) -> str:
    """Return what a key means, as the tables of languages have it."""
    return tooltip(key_of(item).description)


def tooltip_of(table_class: type[Table], item: Field) -> str:
    """Return the tooltip of a key."""
    typical = typical_text(table_class, item)
    description = key_of(item).description + (f" Typical: {typical}." if typical else "")
    return tooltip(f"{description} In a scenario file: {key_name(table_class, item)}, {expected(item)}")


def translated_tooltip(table_class: type[Table], item: Field, tooltips: Mapping[str, str]) -> str | None:
    """Return the tooltip of a key from the table of a language; None where that lacks the key's meaning."""
    meaning, typical = tooltips.get(meaning_of(item)), typical_text(table_class, item)
    if meaning is None:
        return None
    in_file = ", ".join(filter(None, (key_name(table_class, item), _limits_in_signs(item))))
    if typical:
        return tooltips.get(WITH_TYPICAL, WITH_TYPICAL).format(meaning, typical, in_file)
    return tooltips.get(IN_FILE, IN_FILE).format(meaning, in_file)


def _limits_in_signs(item: Field) -> str:
    """Return what a key takes, in symbols, so that nothing needs translation."""
    rule = key_of(item)
    if value_type(item) is bool:
        return "true | false"
    if rule.choices:
        return " | ".join(rule.choices)
    return " ".join(filter(None, (_range(rule), rule.unit)))


def _range(rule: Key) -> str:
    if rule.at_least is not None and rule.at_most is not None:
        return f"{rule.at_least} … {rule.at_most}"
    signs = {">": rule.above, "≥": rule.at_least, "≤": rule.at_most}
    return ", ".join(f"{sign} {limit}" for sign, limit in signs.items() if limit is not None)
