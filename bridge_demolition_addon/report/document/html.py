"""Write a report as one page for a browser, with everything in it: no network, no other file.

There is a script only where there is a model to show. The page forbids browsers to load anything.
"""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterator
from html import escape
from pathlib import Path

from ...system.disk import write_whole_text
from ...texts import Text
from ..languages.translation import IN_ENGLISH, Translation
from .blocks import AnimatedModel, Block, DataTable, Document, Listing, Paragraph, Photo, Picture, Section
from .drawings import Drawings, svg

_ALLOWED = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'"
"""What a page may use: only what is in it."""

_VIEWER = Path(__file__).with_name("viewer.js")

_SPEEDS = {1: "real time", 5: Text("{} times slower", 5), 20: Text("{} times slower", 20)}

_SHORT_TABLE_ROWS = 16
"""Tables of no more rows are not broken over pages."""

STYLE = """
@page { size: A4; margin: 18mm 20mm; }
html { font: 10.5pt/1.45 "DejaVu Sans", "Liberation Sans", Arial, sans-serif; color: #000; background: #fff; }
body { max-width: 190mm; margin: 0 auto; padding: 0 1em; }
h1 { font-size: 1.7em; line-height: 1.2; margin-bottom: 0.2em; }
h2 { font-size: 1.3em; border-bottom: 1px solid #000; margin-top: 1.8em; break-after: avoid; }
p.subtitle { margin-top: 0; color: #333; }
p.notice { border: 2px solid #000; padding: 0.5em 0.8em; font-weight: bold; break-inside: avoid; }
figure { margin: 1.2em 0; break-inside: avoid; }
figure img { width: 100%; height: auto; display: block; }
figcaption { font-size: 0.9em; margin-top: 0.3em; }
table { border-collapse: collapse; width: 100%; margin: 0.4em 0 1.4em; font-size: 0.85em; line-height: 1.3; }
caption { text-align: left; font-weight: bold; padding: 0.6em 0 0.3em; break-after: avoid; }
th, td { text-align: left; vertical-align: top; padding: 0.18em 0.8em 0.18em 0; border-bottom: 1px solid #bbb; }
th { border-bottom: 1px solid #000; }
td.number, th.number { text-align: right; }
tr { break-inside: avoid; }
thead { display: table-header-group; }
table.short { break-inside: avoid; }
pre { font: 0.75em/1.35 "DejaVu Sans Mono", "Liberation Mono", monospace; white-space: pre-wrap; }
footer { margin-top: 2em; font-size: 0.8em; color: #333; }
ol.contents { columns: 2; }
ol.contents a { color: inherit; }
figure.model canvas { width: 100%; aspect-ratio: 16 / 9; display: block; touch-action: none; }
figure.model div { display: flex; gap: 0.8em; align-items: center; margin-top: 0.4em; }
figure.model input { flex: 1; }
@media print { body { max-width: none; padding: 0; } figure.model { display: none; } }
"""


def write_html(document: Document, drawings: Drawings, path: Path, translation: Translation = IN_ENGLISH) -> None:
    """Write a report as a page; `translation` has the words that the page adds, such as on its buttons."""
    write_whole_text(path, "\n".join(_lines(document, drawings, translation)) + "\n")


def _lines(document: Document, drawings: Drawings, translation: Translation) -> Iterator[str]:
    title = escape(document.title)
    yield f'<!doctype html>\n<html lang="{translation.table.tag}">\n<head>\n<meta charset="utf-8">'
    yield f"<title>{title}</title>"
    yield f'<meta name="description" content="{escape(document.subtitle)}">'
    if document.control.author:
        yield f'<meta name="author" content="{escape(document.control.author)}">'
    yield '<link rel="icon" href="data:,">'  # or a browser asks for one
    yield f'<meta http-equiv="Content-Security-Policy" content="{_ALLOWED}">'
    yield '<meta name="viewport" content="width=device-width, initial-scale=1">'
    yield f"<style>{STYLE}{_page_foot(document.control.foot)}</style>\n</head>\n<body>\n<h1>{title}</h1>"
    yield f'<p class="subtitle">{escape(document.subtitle)}</p>'
    for block in document.first_page:
        yield _block(block, drawings, translation)
    yield '<ol class="contents">'
    for number, section in enumerate(document.sections, start=1):
        yield f'<li><a href="#section-{number}">{escape(section.title)}</a></li>'
    yield "</ol>"
    for number, section in enumerate(document.sections, start=1):
        yield from _section(number, section, drawings, translation)
    if any(isinstance(block, AnimatedModel) for block in document.blocks()):
        yield f"<script>\n{_VIEWER.read_text(encoding='utf-8')}</script>"
    if document.control.foot:
        yield f"<footer>{escape(document.control.foot)}</footer>"
    yield "</body>\n</html>"


def _page_foot(text: str) -> str:
    """Return the rule by which browsers print a text at the foot of each page."""
    quoted = text.replace("\\", "").replace('"', "'").replace("<", "(")
    return f'@page {{ @bottom-left {{ content: "{quoted}"; font-size: 7pt; }} }}\n' if text else ""


def _section(number: int, section: Section, drawings: Drawings, translation: Translation) -> Iterator[str]:
    yield f'<section>\n<h2 id="section-{number}">{number} {escape(section.title)}</h2>'
    for block in section.blocks:
        yield _block(block, drawings, translation)
    yield "</section>"


def _block(block: Block, drawings: Drawings, translation: Translation) -> str:
    match block:
        case Paragraph():
            kind = ' class="notice"' if block.is_notice else ""
            return f"<p{kind}>{escape(block.text)}</p>"
        case Listing():
            return f"<pre>{escape(block.text)}</pre>"
        case DataTable():
            return _table(block)
        case Picture():
            return _figure("image/svg+xml", svg(drawings[block]), block.title)
        case Photo():
            return _figure("image/png", block.path.read_bytes(), block.title)
        case AnimatedModel():
            return _model(block, translation)


def _figure(kind: str, content: bytes, title: str) -> str:
    source = f"data:{kind};base64,{b64encode(content).decode('ascii')}"
    caption = escape(title)
    return f'<figure>\n<img alt="{caption}" src="{source}">\n<figcaption>{caption}</figcaption>\n</figure>'


def _model(model: AnimatedModel, translation: Translation) -> str:
    play, stop, time, speed = (escape(translation.pattern(word)) for word in ("Play", "Stop", "time", "speed"))
    speeds = "".join(
        f'<option value="{slower}">{escape(translation.label(text))}</option>' for slower, text in _SPEEDS.items()
    )
    return (
        f'<figure class="model" data-model="{model.packed}">\n<canvas aria-label="{escape(model.title)}"></canvas>\n'
        f'<div><button type="button" data-play="{play}" data-stop="{stop}">{play}</button>'
        f'<input type="range" min="0" max="0" step="any" value="0" aria-label="{time}">'
        f'<select aria-label="{speed}">{speeds}</select><output></output></div>\n'
        f"<figcaption>{escape(model.title)}</figcaption>\n</figure>"
    )


def _table(table: DataTable) -> str:
    classes = [' class="number"' if column.form else "" for column in table.columns]
    kind = ' class="short"' if len(table.rows) <= _SHORT_TABLE_ROWS else ""
    lines = [f"<table{kind}>", f"<caption>{escape(table.title)}</caption>"]
    if any(column.heading for column in table.columns):
        cells = [
            f"<th{kind}>{escape(column.heading)}</th>" for kind, column in zip(classes, table.columns, strict=True)
        ]
        lines.append(f"<thead><tr>{''.join(cells)}</tr></thead>")
    lines.append("<tbody>")
    for row in table.shown_rows():
        cells = [f"<td{kind}>{escape(text)}</td>" for kind, text in zip(classes, row, strict=True)]
        lines.append(f"<tr>{''.join(cells)}</tr>")
    return "\n".join([*lines, "</tbody>", "</table>"])
