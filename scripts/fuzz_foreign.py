# SPDX-License-Identifier: GPL-3.0-or-later
"""Read files of other programs that were damaged at random: each has to be read, or refused in one sentence.

Usage: python scripts/fuzz_foreign.py [--ifc 250] [--terrain 250] [--seed 0] [--keep]

What it finds is printed with its seed, and the status is 1 then. The files come from `tests/support`. With `--keep` the
counts go to docs/data/damaged_files.csv, from which `scripts/foreign_files.py page` writes them into its page.
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
sys.path[:0] = [str(ROOT), str(ROOT / "tests")]


def main() -> int:
    """Read as many damaged files as asked for, and say what came of them."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--ifc", type=int, default=250)
    parser.add_argument("--terrain", type=int, default=250)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--keep", action="store_true")
    arguments = parser.parse_args()
    seen: Counter[str] = Counter()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for seed in range(arguments.seed, arguments.seed + arguments.ifc):
            seen[read_damaged_ifc(folder, seed)] += 1
        for seed in range(arguments.seed, arguments.seed + arguments.terrain):
            seen[read_damaged_terrain(folder, seed)] += 1
    for said, count in seen.most_common():
        print(f"{count:5d}  {said}")
    if arguments.keep:
        with KEPT.open("w", encoding="utf-8", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(("result", "files"))
            writer.writerows(sorted(seen.items()))
    return 1 if any("FAULT" in said for said in seen) else 0


def read_damaged_ifc(folder: Path, seed: int) -> str:
    """Import a damaged IFC file, and return ``read``, ``refused`` or what went wrong."""
    from support.damaged_files import damaged
    from support.ifc_bridges import SCHEMAS, whole_bridge

    from bridge_demolition_addon.errors import DemolitionError
    from bridge_demolition_addon.ifc.import_process import import_bridge
    from bridge_demolition_addon.ifc.settings import ImportSettings

    whole = whole_bridge(schema=SCHEMAS[seed % 3]).written(folder / f"whole_{seed}.ifc").read_bytes()
    path = folder / f"damaged_{seed}.ifc"
    path.write_bytes(damaged(whole, seed))
    try:
        import_bridge(path, folder / f"made_{seed}", ImportSettings(shards=20, time_limit_s=20.0))
    except DemolitionError as error:
        return f"FAULT ifc {seed}: {error}" if "by a fault of this add-on" in str(error) else "ifc refused"
    except Exception:
        return f"FAULT ifc {seed}: {traceback.format_exc()}"
    return "ifc read"


def read_damaged_terrain(folder: Path, seed: int) -> str:
    """Read a damaged file of terrain, and return ``read``, ``refused`` or what went wrong."""
    from support.damaged_files import damaged
    from support.terrain_files import write_asc, write_landxml, write_mesh, write_tif, write_xyz

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
    )
    ending, write = writers[seed % len(writers)]
    path = folder / f"damaged_{seed}{ending}"
    path.write_bytes(damaged(write(path).read_bytes(), seed))
    try:
        read_terrain(str(path), Ground(file=str(path)))
    except DemolitionError as error:
        return "terrain refused" if "\n" not in str(error).strip() else f"FAULT terrain {seed}: {error}"
    except Exception:
        return f"FAULT terrain {seed} {ending}: {traceback.format_exc()}"
    return "terrain read"


if __name__ == "__main__":
    sys.exit(main())
