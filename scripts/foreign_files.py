# SPDX-License-Identifier: GPL-3.0-or-later
"""Import files of other programs, run what they give, and write tests/foreign/README.md from the results.

Usage: python scripts/foreign_files.py measure FILE [--only NAME] ... | page

`measure` imports each file as `bda import FILE` does, with no option, runs the scenario awake for 1.5 s, and adds a row
to docs/data/foreign_files.csv. `page` writes the document from these rows.
"""

import csv
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from bridge_demolition_addon import load_results
from bridge_demolition_addon.model.results.motion import travel

ROOT = Path(__file__).resolve().parents[1]
ROWS = ROOT / "docs" / "data" / "foreign_files.csv"
DAMAGED = ROOT / "docs" / "data" / "damaged_files.csv"
PAGE = ROOT / "tests" / "foreign" / "README.md"

COLUMNS = (
    *("file", "bridge", "written_by", "elements", "members", "bearings", "approach_slabs", "left_out", "lost", "added"),
    *("assumed", "bars_kg_m3", "mass_t", "file_mass_share", "said", "utilisation", "cracked_at_rest", "moved_m"),
    *("cracked", "connections", "import_s", "steel_bars"),
)

WRITTEN_BY = {
    "infra-bridge.ifc": "SketchUp 2024, IFC4",
    "v440_tekla_modell.ifc": "Tekla Structures 2020, IFC2X3",
    "rickbrice_br01_uts.ifc": "BridgeLink PGSuper 8.0, IFC4X3",
    "rickbrice_i405_flyover.ifc": "BridgeLink PGSuper 8.0, IFC4X3",
    "rickbrice_aashto_idm_template.ifc": "OpenBrIM v3, IFC4X3",
    "ifc2mct_bridge_test.ifc": "Xbim, IFC4X1",
}

CLAMPING = "which it would hold down"
"""Of why an approach slab is left out that lies on what moves on bearings."""

BY_RULE = re.compile(r"by rule they have bars .*?, (\d+) kg/m³")
"""Of the line of `import.txt` on bars by rule."""

AWAKE = """
[scenario]
based_on = "scenario.toml"
title = "Awake"
[time]
duration_s = 1.5
[shards]
use_deactivation = false
start_deactivated = false
"""


def measure(path: Path, only: str | None = None) -> dict[str, str]:
    """Import a file, run it, and return its row."""
    import time

    from bridge_demolition_addon.errors import DemolitionError
    from bridge_demolition_addon.ifc.import_process import import_bridge
    from bridge_demolition_addon.ifc.settings import ImportSettings

    row = dict.fromkeys(COLUMNS, "") | {"file": path.name, "written_by": WRITTEN_BY.get(path.name, "")}
    row["bridge"] = only or ""
    with tempfile.TemporaryDirectory() as name:
        folder, began = Path(name) / "bridge", time.monotonic()
        try:
            imported = import_bridge(path, folder, ImportSettings(only=only))
        except DemolitionError as error:
            return row | {"said": str(error).removeprefix(f"{path}: ")}
        row["import_s"] = f"{time.monotonic() - began:.0f}"
        return row | _from_folder(folder, imported.lines) | _run(folder)


def _from_folder(folder: Path, lines: tuple[str, ...]) -> dict[str, str]:
    with (folder / "elements.csv").open(encoding="utf-8", newline="") as file:
        elements = list(csv.DictReader(file))
    became = [row["became"] for row in elements]
    left = [row for row in elements if row["became"] == "left out"]
    slabs = [row for row in left if CLAMPING in row["why"]]
    lost = [row for row in left if "missing" in row["why"] and row not in slabs]
    mass = sum(float(row["mass_kg"]) for row in elements if row["mass_kg"])
    by_file = [line.rsplit(", ", 1)[1] for line in lines if " by the file for " in line]
    by_rule = [found.group(1) for line in lines if (found := BY_RULE.search(line))]
    at = lines.index("To know") if "To know" in lines else len(lines)
    return {
        "elements": str(len({row["global_id"] for row in elements if row["became"] != "added"})),
        "members": str(became.count("member")),
        "steel_bars": str(became.count("bar")),
        "bearings": str(became.count("connection")),
        "approach_slabs": str(sum(row["kind"] == "approach slab" for row in elements) + len(slabs)),
        "left_out": str(len(left) - len(lost) - len(slabs)),
        "lost": str(len(lost)),
        "added": str(became.count("added")),
        "assumed": str(max(len(lines) - at - 1, 0)),
        "bars_kg_m3": by_rule[0] if by_rule else "",
        "mass_t": f"{mass / 1000.0:.0f}",
        "file_mass_share": by_file[-1] if by_file else "",
    }


def _run(folder: Path) -> dict[str, str]:
    (folder / "awake.toml").write_text(AWAKE, encoding="utf-8")
    command = [sys.executable, "-m", "bridge_demolition_addon", "run", "--no-pictures", "--quiet"]
    command += ["--output", str(folder / "run"), str(folder / "awake.toml")]
    done = subprocess.run(
        command,
        capture_output=True,
        text=True,
        cwd=ROOT,
    )
    if done.returncode:
        return {"said": done.stderr.strip().splitlines()[-1].replace(f"{folder}/", "")}
    summary = json.loads((folder / "run" / "summary.json").read_text(encoding="utf-8"))
    fell, connections = summary["fell_by_itself"], summary["connections"]
    stability = summary["stability"]
    moved = _largest_move_m(folder / "run") if fell is None else fell["largest_move_m"]
    return {
        "utilisation": f"{stability['utilisation']:.2f}",
        "cracked_at_rest": str(stability["cracked"]),
        "moved_m": f"{moved:.3f}",
        "cracked": str(connections["broken"]),
        "connections": str(connections["count"]),
        "said": "stands" if moved < 0.5 else "falls",
    }


def _largest_move_m(run: Path) -> float:
    """Return how far the shard ends from where it was that has moved most."""
    results = load_results(run)
    shards = results.inventory.of_kind("shard")
    positions = results.frames.positions_m[:, shards]
    return float(travel(positions[0], positions[-1]).max(initial=0.0))


def rows() -> list[dict[str, str]]:
    """Return what was measured."""
    if not ROWS.exists():
        return []
    with ROWS.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def keep(new: dict[str, str]) -> None:
    """Add a row, in place of an earlier one of the same bridge."""
    others = [row for row in rows() if (row["file"], row["bridge"]) != (new["file"], new["bridge"])]
    with ROWS.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(sorted([*others, new], key=lambda row: (row["file"], row["bridge"])))


def page() -> str:
    """Return the document."""
    lines = [
        "# Files of other programs",
        "",
        "What `bda import FILE` makes of them, with no option but `--only` where a bridge is named. *Lost* is what had",
        "no geometry that can be used, beside what carries nothing anyway; *approach slabs* are left out where they",
        "lie on what moves on bearings, and members elsewhere; *assumed* counts the lines of `import.txt` on what was",
        "assumed and mended; *bars* are those [by rule](../../docs/ifc.md#bars-by-rule), in members of concrete",
        "beside footings and approach slabs; the mass is compared with that which the file gives its elements.",
        "*Bars of steel* are elements that become [steelwork](../../docs/ifc.md#bars-of-steel), beside members.",
        "",
        "*By statics* is the largest utilisation under the bridge's own weight, of forces once what is overloaded has",
        "cracked, and how many connections that are; their bars hold them. *Awake* is the largest displacement of any",
        "shard in a run of 1.5 s, of which the bridge settles for half a second, and how many connections crack in it.",
        "",
        "| file | written by | elements | members, bearings | bars of steel | approach slabs | left out, lost | "
        "supports added | assumed | bars | mass | against the file | by statics | awake |",
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    for row in rows():
        name = f"`{row['file']}`" + (f", {row['bridge']}" if row["bridge"] else "")
        if not row["members"]:
            lines.append(f"| {name} | {row['written_by']} |{' |' * 10} | refused: {row['said']} |")
            continue
        bars = f"{row['bars_kg_m3']} kg/m³" if row["bars_kg_m3"] else "-"
        lines.append(
            f"| {name} | {row['written_by']} | {row['elements']} | {row['members']}, {row['bearings']} | "
            f"{row['steel_bars']} | {row['approach_slabs']} | {row['left_out']}, {row['lost']} | {row['added']} | "
            f"{row['assumed']} | "
            f"{bars} | {row['mass_t']} t | {row['file_mass_share'] or '-'} | {_by_statics(row)} | {_awake(row)} |"
        )
    lines += [
        "",
        "Each bridge was run once, [one of many](../../docs/accuracy.md#one-run-is-one-possible-outcome), or not",
        "where a dash stands: its statics alone were worked out, or nothing but the import for the box girder of",
        "IFC4X1: those of its 173 plates had not ended after eight minutes on two busy cores.",
        "A bridge of which much is lost, such as the abutments of an OpenBrIM file, stands on supports that are added.",
        "",
        "**Bars of steel.** None of these files has straight ones: the 68 ribs of the box girder are swept along",
        "its alignment, and the girders of OpenBrIM are curved. Of the steel of a building that ArchiCAD wrote as",
        "faces alone (IFC2X3, Schependomlaan), 46 of 77 elements are bars, of 5.9 t; volumes are those of the file",
        "within 0.02 %, and axes run up to 0.27 m beside their nodes. Its walls are in another file: `import.txt`",
        "names 21 ends that are free and what is left out as it meets nothing, and by statics it comes down. Of",
        "single beams that buildingSMART and others give as examples, 18 of IPE 220 and T-sections, four of IPE 200",
        "on different cardinal points, and those cut by half-spaces are bars; one that is revolved and one along a",
        "curve are not.",
        "",
        *_damaged(),
        "Two of the files are in [tests/foreign/files](files), with their licences; the others may be",
        "used for tests, but not passed on. `python scripts/foreign_files.py` measures and writes this page.",
    ]
    return "\n".join(lines) + "\n"


def _by_statics(row: dict[str, str]) -> str:
    if not row["utilisation"]:
        return row["said"]
    return f"{100.0 * float(row['utilisation']):.0f} %, {row['cracked_at_rest']} of {row['connections']} cracked"


def _awake(row: dict[str, str]) -> str:
    if not row["moved_m"]:
        return "-"
    moves = f"{100.0 * float(row['moved_m']):.1f} cm, {row['cracked']} cracked"
    return f"stands: {moves}" if row["said"] == "stands" else f"does not stand: {moves}"


def _damaged() -> list[str]:
    """Return the paragraph on damaged files, as `scripts/fuzz_foreign.py --keep` has counted them."""
    if not DAMAGED.exists():
        return []
    with DAMAGED.open(encoding="utf-8", newline="") as file:
        results = [(row["kind"], row["result"]) for row in csv.DictReader(file)]
    faults = sum("FAULT" in result for _, result in results)
    texts = [f"{results.count((kind, what))} {what}" for kind in ("ifc", "terrain") for what in ("read", "refused")]
    return [
        f"**Damaged files.** Of {len(results)} files that were damaged at random, IFC and terrain as grids, LandXML,",
        f"GeoTIFF, points, clouds and meshes, {texts[0]} and {texts[1]} of IFC, {texts[2]} and {texts[3]} of terrain;",
        f"{faults or 'none'} ended a process that the user sees, or showed a traceback",
        "(`python scripts/fuzz_foreign.py --keep`, [data](../../docs/data/damaged_files.csv)).",
        "",
    ]


def main() -> None:
    """Measure files, or write the page."""
    words = sys.argv[1:]
    if words[:1] == ["page"]:
        PAGE.write_text(page(), encoding="utf-8")
        return
    if words[:1] != ["measure"] or len(words) < 2:
        raise SystemExit(__doc__)
    only = words[words.index("--only") + 1] if "--only" in words else None
    for word in words[1 : words.index("--only") if "--only" in words else None]:
        keep(measure(Path(word), only))


if __name__ == "__main__":
    main()
