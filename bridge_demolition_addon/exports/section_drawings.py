"""Files of a section through a pile: a picture (SVG, PNG, PDF), or a drawing in metres for CAD programs (DXF)."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ..engineering.geometry.plan_areas import outlines
from ..errors import OutputError, text_of
from ..model.debris.pile_sections import PileSection
from ..system.disk import whole_file

DXF, SVG = ".dxf", ".svg"
ENDINGS = (SVG, DXF, ".png", ".pdf")
"""Of the files that a section can be written to."""

_FIGURE_IN = (9.0, 5.0)
_LAYERS = {"DEBRIS": 30, "STANDING": 8, "GROUND": 7, "TEXT": 7}
"""Layers of a drawing, and their colours by the numbers of AutoCAD."""

_TEXT_M = 0.25


def new_section_file(folder: Path, section: PileSection, ending: str) -> Path:
    """Return a new file for a section in the folder of its run: ``section_across_12.5m.svg``, counted up from 2."""
    name = f"section_{section.direction}_{section.position_m:g}m"
    names = (f"{name}{number}{ending}" for number in ("", *(f"_{count}" for count in range(2, 10_000))))
    return next(path for each in names if not (path := folder / each).exists())


def write_section(section: PileSection, path: Path) -> None:
    """Write a section to a new file, as its ending says.

    Raises
    ------
    OutputError
        The plane cuts no shard, the ending is none of `ENDINGS`, the file is there, or cannot be written.
    """
    if path.suffix not in ENDINGS:
        raise OutputError(f"{path}: expected a name that ends in {', '.join(ENDINGS)}")
    if section.is_empty:
        raise OutputError(
            f"section {section.direction} the bridge at {section.position_m:g} m: cuts no shard; move the plane"
        )
    if path.exists() or path.is_symlink():
        raise OutputError(f"{path}: is there already; choose another name, or delete it first")
    try:
        with whole_file(path) as part:
            if path.suffix == DXF:
                part.write_text(dxf_text(section), encoding="ascii", newline="\r\n")
            else:
                _draw(section, part)
    except OSError as error:
        raise OutputError(f"{path}: cannot be written ({text_of(error)})") from error


def dxf_text(section: PileSection) -> str:
    """Return a section as a drawing in DXF, release 12, in m: widths along x, heights along y.

    References
    ----------
    Autodesk (1992), AutoCAD Release 12 Customization Manual, chapter 11, Drawing Interchange File.
    """
    heading = [(0, "SECTION"), (2, "HEADER"), (9, "$ACADVER"), (1, "AC1009")]
    tables = [(0, "SECTION"), (2, "TABLES"), (0, "TABLE"), (2, "LAYER"), (70, len(_LAYERS))]
    for name, colour in _LAYERS.items():
        tables += [(0, "LAYER"), (2, name), (70, 0), (62, colour), (6, "CONTINUOUS")]
    ends = [(0, "ENDTAB"), (0, "ENDSEC")]
    parts = [*heading, (0, "ENDSEC"), *tables, *ends, (0, "SECTION"), (2, "ENTITIES"), *_entities(section)]
    return "".join(f"{code}\n{value}\n" for code, value in (*parts, (0, "ENDSEC"), (0, "EOF")))


def _entities(section: PileSection) -> Iterator[tuple[int, object]]:
    for layer, area in (("DEBRIS", section.debris), ("STANDING", section.standing)):
        for ring in outlines(area):
            yield from _polyline(layer, ring, closed=True)
    yield from _polyline("GROUND", section.ground_m, closed=False)
    x, y = section.ground_m[0]
    text = (
        f"section {section.direction} the bridge at {section.position_m:g} m, {section.time_s:.2f} s, "
        f"debris {section.debris_area_m2:.2f} m2, {section.debris_height_m:.2f} m high"
    )
    yield from ((0, "TEXT"), (8, "TEXT"), (10, f"{x:.4f}"), (20, f"{y - 3.0 * _TEXT_M:.4f}"), (40, _TEXT_M), (1, text))


def _polyline(layer: str, corners: np.ndarray, *, closed: bool) -> Iterator[tuple[int, object]]:
    yield from ((0, "POLYLINE"), (8, layer), (66, 1), (70, int(closed)), (10, "0.0"), (20, "0.0"), (30, "0.0"))
    for x, y in corners.tolist():
        yield from ((0, "VERTEX"), (8, layer), (10, f"{x:.4f}"), (20, f"{y:.4f}"), (30, "0.0"))
    yield from ((0, "SEQEND"), (8, layer))


def _draw(section: PileSection, path: Path) -> None:
    # Loading matplotlib takes a second, which a drawing in DXF need not wait.
    from ..charts.pile import section_chart, section_title
    from ..charts.style import blank_figure

    figure = blank_figure(*_FIGURE_IN, layout="constrained")
    section_chart(figure, section)
    figure.axes[0].set_title(section_title(section), fontsize=10)
    figure.savefig(path, dpi=150, bbox_inches="tight")  # a low pile leaves much of the page empty
