# SPDX-License-Identifier: GPL-3.0-or-later
"""Read files of other programs that were damaged at random: each has to be read, or refused in one sentence.

Usage: python scripts/fuzz_foreign.py [--ifc 250] [--terrain 250] [--mutated 0] [--files FOLDER] [--seed 0]
       [--keep [--again]]

With `--mutated` as many IFC files contradict their schema: lines dropped, references cut, values null, schemas renamed.

What it finds is printed with its seed, and the status is 1 then. Files are made by `tests/support`, or are those in
`tests/foreign/files`. With `--keep` each result goes to docs/data/damaged_files.csv, from which
`scripts/foreign_files.py page` counts them; the same command goes on behind what is there, and `--again` begins from
the first.
"""

import argparse
import csv
import sys
import tempfile
import traceback
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
KEPT = ROOT / "docs" / "data" / "damaged_files.csv"
WRITTEN_BY_OTHERS = ROOT / "tests" / "foreign" / "files"
_OURS = ("by a fault of this add-on", "NoneType", "has no attribute", "Error:", "object is not")
"""Words of refusals that no user can make anything of."""

COLUMNS = ("kind", "seed", "result")
sys.path[:0] = [str(ROOT), str(ROOT / "tests")]


def main() -> int:
    """Read as many damaged files as asked for, and say what came of them."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--ifc", type=int, default=250)
    parser.add_argument("--terrain", type=int, default=250)
    parser.add_argument("--mutated", type=int, default=0)
    parser.add_argument("--files", type=Path, default=WRITTEN_BY_OTHERS, help="folder of files of other programs")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--keep", action="store_true")
    parser.add_argument("--again", action="store_true")
    arguments = parser.parse_args()
    wanted = [("ifc", seed) for seed in range(arguments.seed, arguments.seed + arguments.ifc)]
    wanted += [("terrain", seed) for seed in range(arguments.seed, arguments.seed + arguments.terrain)]
    wanted += [("mutated", seed) for seed in range(arguments.seed, arguments.seed + arguments.mutated)]
    results = kept() if arguments.keep and not arguments.again else {}
    for kind, seed in wanted:
        if (kind, seed) in results:
            continue
        with tempfile.TemporaryDirectory() as name:
            results[kind, seed] = READERS[kind](Path(name), seed, arguments.files)
        if arguments.keep:
            keep(results)
    seen = Counter(f"{kind} {result}" for (kind, _), result in results.items())
    for said, count in seen.most_common():
        print(f"{count:5d}  {said}")
    return 1 if any("FAULT" in said for said in seen) else 0


def kept() -> dict[tuple[str, int], str]:
    """Return the results that are kept, by kind and seed."""
    if not KEPT.exists():
        return {}
    with KEPT.open(encoding="utf-8", newline="") as file:
        return {(row["kind"], int(row["seed"])): row["result"] for row in csv.DictReader(file)}


def keep(results: dict[tuple[str, int], str]) -> None:
    """Write results by kind and seed."""
    with KEPT.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows((*key, result) for key, result in sorted(results.items()))


def whole_ifc(folder: Path, seed: int, files: Path) -> bytes:
    """Return a whole IFC file: one of the tests' in each schema, or one that another program wrote."""
    from support.ifc_bridges import SCHEMAS, whole_bridge

    others = sorted(files.glob("*.ifc"))
    number = seed % (len(SCHEMAS) + len(others))
    if number >= len(SCHEMAS):
        return others[number - len(SCHEMAS)].read_bytes()
    return whole_bridge(schema=SCHEMAS[number]).written(folder / f"whole_{seed}.ifc").read_bytes()


def read_damaged_ifc(folder: Path, seed: int, files: Path) -> str:
    """Import a damaged IFC file, and return ``read``, ``refused`` or what went wrong."""
    from support.damaged_files import damaged

    return _imported(damaged(whole_ifc(folder, seed, files), seed), folder, seed)


def read_mutated_ifc(folder: Path, seed: int, files: Path) -> str:
    """Import an IFC file that contradicts its schema, and return ``read``, ``refused`` or what went wrong."""
    from support.damaged_files import mutated

    return _imported(mutated(whole_ifc(folder, seed, files), seed), folder, seed)


def _imported(content: bytes, folder: Path, seed: int) -> str:
    from bridge_demolition_addon.errors import DemolitionError
    from bridge_demolition_addon.ifc.import_process import import_bridge
    from bridge_demolition_addon.ifc.settings import ImportSettings

    path = folder / f"damaged_{seed}.ifc"
    path.write_bytes(content)
    try:
        import_bridge(path, folder / f"made_{seed}", ImportSettings(shards=20, time_limit_s=20.0))
    except DemolitionError as error:
        return _refusal(error)
    except Exception:
        return f"FAULT: {traceback.format_exc()}"
    return "read"


def _refusal(error: Exception) -> str:
    text = str(error).strip()
    is_fault = "\n" in text or any(words in text for words in _OURS)
    return f"FAULT: {text}" if is_fault else "refused"


def read_damaged_terrain(folder: Path, seed: int, _: Path) -> str:
    """Read a damaged file of terrain, and return ``read``, ``refused`` or what went wrong."""
    from support.damaged_files import damaged
    from support.terrain_files import write_asc, write_landxml, write_las, write_mesh, write_tif, write_xyz

    from bridge_demolition_addon.errors import DemolitionError
    from bridge_demolition_addon.model.scenario import Ground
    from bridge_demolition_addon.model.terrain.files import read_terrain

    writers = (
        (".asc", write_asc),
        (".xml", write_landxml),
        (".tif", write_tif),
        (".xyz", write_xyz),
        (".stl", write_mesh),
        (".ply", write_mesh),
        (".glb", write_mesh),
        (".obj", write_mesh),
        (".las", write_las),
        (".laz", write_las),
        (".ifc", _network_of_12d),
    )
    ending, write = writers[seed % len(writers)]
    path = folder / f"damaged_{seed}{ending}"
    path.write_bytes(damaged(write(path).read_bytes(), seed))
    try:
        read_terrain(str(path), Ground(file=str(path)))
    except DemolitionError as error:
        return _refusal(error)
    except Exception:
        return f"FAULT {ending}: {traceback.format_exc()}"
    return "read"


def _network_of_12d(_: Path) -> Path:
    return WRITTEN_BY_OTHERS / "ifc_tin_1.ifc"


READERS = {"ifc": read_damaged_ifc, "terrain": read_damaged_terrain, "mutated": read_mutated_ifc}


if __name__ == "__main__":
    sys.exit(main())
