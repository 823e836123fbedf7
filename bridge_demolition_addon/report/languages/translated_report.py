"""The documents of a report, put into a language."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from ..document.blocks import AnimatedModel, Block, Column, DataTable, Document, Paragraph, Photo, Picture, Section
from .translation import Translation

_MOST_SHOWN = 3
"""Texts that stayed English, and are named at the head of the report."""

_LACKING = "The table of this language lacks {} texts of this report, which are in English, such as: {}"
_DRAWINGS = "The drawings are in English: no font with the letters of this language was found."
HEAD = (_LACKING, _DRAWINGS)
"""Texts that only a report with English in it has."""


def translated_document(document: Document, translation: Translation) -> Document:
    """Return a report in a language. Keys, names of files, listings of files and the numbers stay as they are.

    Where the table of the language lacks a text, the report says so at its head.
    """
    if translation.is_english:
        return document
    sections = tuple(
        Section(translation.text(section.title), _blocks(section.blocks, translation)) for section in document.sections
    )
    title, subtitle = translation.text(document.title), translation.text(document.subtitle)
    return Document(title, subtitle, sections, _blocks(document.summary, translation))


def with_notes(document: Document, notes: Sequence[str]) -> Document:
    """Return a report with notes at its head."""
    return replace(document, summary=(*(Paragraph(note, is_notice=True) for note in notes), *document.summary))


def notes_on_language(translation: Translation, can_draw: bool) -> list[str]:
    """Return what of a report stayed English, in its language: texts that the table lacks, and drawings."""
    notes = [] if can_draw else [translation.pattern(_DRAWINGS)]
    if translation.missing:
        first = "; ".join(translation.missing[:_MOST_SHOWN])
        notes.insert(0, translation.pattern(_LACKING).format(len(translation.missing), first))
    return notes


def _blocks(blocks: Sequence[Block], translation: Translation) -> tuple[Block, ...]:
    return tuple(_block(block, translation) for block in blocks)


def _block(block: Block, translation: Translation) -> Block:
    match block:
        case Paragraph():
            return replace(block, text=translation.text(block.text))
        case DataTable():
            return _table(block, translation)
        case Picture() | Photo() | AnimatedModel():
            return replace(block, title=translation.text(block.title))
    return block


def _table(table: DataTable, translation: Translation) -> DataTable:
    """Return a table as people read it, in a language: its file is written from that in English."""
    columns = tuple(replace(column, heading=translation.text(column.heading)) for column in table.columns)
    rows = [
        tuple(_cell(column, value, translation) for column, value in zip(table.columns, row, strict=True))
        for row in table.rows
    ]
    return replace(table, title=translation.text(table.title), columns=columns, rows=rows)


def _cell(column: Column, value: Any, translation: Translation) -> Any:
    """Return a value of a table, numbers, sources and what is not known as they are."""
    return value if column.form or column.cites or value is None else translation.text(column.shown(value))
