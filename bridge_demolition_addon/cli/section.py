"""``bda section``: a section through the debris of a run, as a picture or as a drawing for CAD programs."""

import argparse
import math
from pathlib import Path

from ..model.debris.pile_sections import Direction


def add_to(commands: argparse._SubParsersAction) -> None:
    """Add the command to the command line."""
    parser = commands.add_parser(
        "section",
        description="Draws debris and what stands where an upright plane cuts them at the end of a run, and says area, "
        "width and height of the debris. See docs/sections.md.",
        allow_abbrev=False,
    )
    parser.add_argument("folder", metavar="RUN", type=Path, help="folder that bda run made")
    place = parser.add_mutually_exclusive_group(required=True)
    place.add_argument("--across", metavar="X", type=_place, help="plane across the bridge, at x in m")
    place.add_argument("--along", metavar="Y", type=_place, help="plane along the bridge, at y in m")
    parser.add_argument(
        "--output",
        metavar="FILE",
        type=Path,
        action="append",
        help="new file that ends in .svg, .dxf, .png or .pdf; may be repeated (an SVG and a DXF in the folder of the "
        "run)",
    )
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")
    parser.set_defaults(execute=section)


def section(arguments: argparse.Namespace) -> None:
    """Cut, say the figures, and where the files are."""
    from ..exports.section_drawings import DXF, SVG, new_section_file, write_section
    from ..model.debris.pile_sections import pile_section
    from ..model.results.arrays import load_results

    across = arguments.across is not None
    direction, position_m = (Direction.ACROSS, arguments.across) if across else (Direction.ALONG, arguments.along)
    cut = pile_section(load_results(arguments.folder), direction, position_m)
    outputs = arguments.output or [new_section_file(arguments.folder, cut, ending) for ending in (SVG, DXF)]
    for path in outputs:
        write_section(cut, path)
    if arguments.quiet:
        return
    rows = (
        ("debris, area", f"{cut.debris_area_m2:.2f} m²"),
        ("debris, width", f"{cut.debris_width_m:.2f} m"),
        ("debris, height above the ground", f"{cut.debris_height_m:.2f} m"),
        ("at", f"{cut.time_s:.2f} s"),
    )
    for name, value in rows:
        print(f"{name:<34}{value}")
    for path in outputs:
        print(path)


def _place(text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise argparse.ArgumentTypeError(f"{text!r} is wrong: expected a number of metres")
    return number
