"""``bda import``: make a scenario of a bridge in an IFC file."""

import argparse
import sys
from pathlib import Path

from ...errors import GeometryError, IfcError, ScenarioError
from ...ifc.element_materials import write_material_table
from ...ifc.folder import SCENARIO_FILE, check_new, folder_beside
from ...ifc.import_process import import_bridge
from ...ifc.settings import KINDS, UNITS, ImportSettings
from ...model.scenario.file import read_scenario
from ...model.sequence.checked_model import checked_model
from ...model.stages.stability import stability_of
from ..progress import progress_on

_MOST_SHARDS = 1_000_000
_USUAL = ImportSettings()


def add_to(commands: argparse._SubParsersAction) -> None:
    """Add the command to the command line."""
    parser = commands.add_parser(
        "import",
        description="Writes a scenario, and a mesh for each element. See docs/ifc.md.",
        allow_abbrev=False,
    )
    parser.add_argument(
        "file", metavar="BRIDGE.ifc", type=Path, nargs="?", help="IFC file: IFC2X3, IFC4, IFC4X1 to 4X3"
    )
    parser.add_argument(
        "--output", metavar="FOLDER", type=Path, help="new folder for the scenario and its meshes (beside the file)"
    )
    parser.add_argument(
        "--materials", metavar="FILE", type=Path, help="table of materials by name, as --write-materials writes it"
    )
    parser.add_argument(
        "--write-materials", metavar="FILE", type=Path, help="write the add-on's table of materials, to be changed"
    )
    parser.add_argument("--material", metavar="NAME", help="material of elements without one, or with an unknown one")
    parser.add_argument("--unit", choices=tuple(UNITS), help="unit of length, in place of that of the file")
    parser.add_argument(
        "--ground", metavar="METRES", type=_height, help="height of the ground in the file (the lowest underside)"
    )
    parser.add_argument("--shards", metavar="NUMBER", type=_count, default=300, help="shards of the bridge (300)")
    parser.add_argument(
        "--without",
        metavar="NAME",
        action="append",
        default=[],
        help="leave out elements of this name, class, kind or GlobalId, with * for anything; may be repeated",
    )
    parser.add_argument(
        "--kind",
        metavar="NAME=KIND",
        action="append",
        type=_kind,
        default=[],
        help=f"what elements of a name, class or GlobalId are: {', '.join(KINDS)}; may be repeated",
    )
    parser.add_argument(
        "--material-of",
        metavar="NAME=MATERIAL",
        action="append",
        type=_material_of,
        default=[],
        help="material of elements of a name, class or GlobalId, by its name in the table; may be repeated",
    )
    parser.add_argument(
        "--only", metavar="NAME", help="bridge that is taken of a file with several, with * for anything (the largest)"
    )
    parser.add_argument(
        "--bearing-gap",
        metavar="METRES",
        type=_gap,
        default=_USUAL.bearing_gap_m,
        help="gap up to which bearings and members are brought to what they lie on (0.015)",
    )
    parser.add_argument(
        "--bars",
        action=argparse.BooleanOptionalAction,
        default=None,
        help="make bars of [steelwork] of straight bars of steel, or cut them into shards as all else (bars, but with "
        "--strict)",
    )
    parser.add_argument(
        "--strict", action="store_true", help="refuse what is missing or damaged; assume, mend and leave out nothing"
    )
    parser.add_argument(
        "--time-limit",
        metavar="SECONDS",
        type=_seconds,
        default=_USUAL.time_limit_s,
        help="how long the geometry of an element may take before it is left out (60)",
    )
    parser.add_argument("--quiet", action="store_true", help="show no progress")
    parser.set_defaults(execute=import_ifc)


def import_ifc(arguments: argparse.Namespace) -> None:
    """Import a bridge, and print its members and notes; or write the table of materials."""
    if arguments.write_materials:
        write_material_table(arguments.write_materials)
        print(arguments.write_materials)
    if arguments.file is None and arguments.write_materials:
        return
    if arguments.file is None:
        raise IfcError("bda import needs an IFC file, or --write-materials FILE; see bda import --help")
    output = arguments.output or folder_beside(arguments.file)
    check_new(output)
    settings = ImportSettings(
        materials=arguments.materials,
        material=arguments.material,
        unit=arguments.unit,
        ground_m=arguments.ground,
        shards=arguments.shards,
        without=tuple(arguments.without),
        kinds=tuple(arguments.kind),
        materials_of=tuple(arguments.material_of),
        only=arguments.only,
        bearing_gap_m=arguments.bearing_gap,
        strict=arguments.strict,
        time_limit_s=arguments.time_limit,
        bars=arguments.bars,
    )
    progress = progress_on(sys.stderr, quiet=arguments.quiet)
    try:
        imported = import_bridge(arguments.file, output, settings, progress)
        for line in imported.lines:
            print(line)
        print(f"\n{output / SCENARIO_FILE}", flush=True)
        progress.stage("working out whether it stands")
        print(f"\n{_verdict(output / SCENARIO_FILE)}.")
    finally:
        progress.finish()


def _verdict(path: Path) -> str:
    """Return whether what was written stands under its own weight, as a sentence without a full stop."""
    scenario = read_scenario(path)
    try:
        return stability_of(scenario, checked_model(scenario), with_factor=False).sentence
    except (GeometryError, ScenarioError) as error:
        return f"Whether the bridge stands is not known, as it cannot be cut into shards: {error}"


def _height(text: str) -> float:
    height = float(text)
    if not abs(height) <= 1e5:
        raise argparse.ArgumentTypeError(f"{text!r} is wrong: expected a height in m")
    return height


def _gap(text: str) -> float:
    gap = float(text)
    if not 0.0 <= gap <= 0.5:
        raise argparse.ArgumentTypeError(f"{text!r} is wrong: expected a gap from 0 to 0.5 m")
    return gap


def _seconds(text: str) -> float:
    seconds = float(text)
    if not 0.1 <= seconds <= 86_400.0:
        raise argparse.ArgumentTypeError(f"{text!r} is wrong: expected a time from 0.1 to 86400 s")
    return seconds


def _count(text: str) -> int:
    number = int(text)
    if not 1 <= number <= _MOST_SHARDS:
        raise argparse.ArgumentTypeError(f"{text!r} is wrong: expected a whole number from 1 to {_MOST_SHARDS}")
    return number


def _kind(text: str) -> tuple[str, str]:
    name, equals, kind = text.rpartition("=")
    if not equals or kind not in KINDS:
        raise argparse.ArgumentTypeError(f"{text!r} is wrong: expected NAME=KIND, with one of {', '.join(KINDS)}")
    return name, kind


def _material_of(text: str) -> tuple[str, str]:
    name, equals, material = text.rpartition("=")
    if not equals or not material:
        raise argparse.ArgumentTypeError(f"{text!r} is wrong: expected NAME=MATERIAL")
    return name, material
