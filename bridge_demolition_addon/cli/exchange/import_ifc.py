"""``bda import``: make a scenario of a bridge in an IFC file."""

import argparse
from pathlib import Path

from ...errors import IfcError
from ...ifc.bridge import read_bridge
from ...ifc.folder import SCENARIO_FILE, check_new, folder_beside, write_bridge
from ...ifc.materials import write_material_table
from ...ifc.settings import KINDS, UNITS, ImportSettings

_MOST_SHARDS = 1_000_000


def add_to(commands: argparse._SubParsersAction) -> None:
    """Add the command to the command line."""
    parser = commands.add_parser(
        "import",
        help="make a scenario of a bridge in an IFC file",
        description="Writes a scenario, and a mesh for each element. See docs/ifc.md.",
        allow_abbrev=False,
    )
    parser.add_argument("file", metavar="BRIDGE.ifc", type=Path, nargs="?", help="IFC file: IFC2X3, IFC4 or IFC4X3")
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
    )
    for line in write_bridge(read_bridge(arguments.file, settings), output):
        print(line)
    print(f"\n{output / SCENARIO_FILE}")


def _height(text: str) -> float:
    height = float(text)
    if not abs(height) <= 1e5:
        raise argparse.ArgumentTypeError(f"{text!r} is wrong: expected a height in m")
    return height


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
