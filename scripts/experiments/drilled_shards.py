# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure whether the drilled bridge comes down, and how far its debris goes, by how finely it is cut.

The bridge is examples/drilled/two_spans.toml, which has 200 shards: its runs are in docs/data/seeds. Those with 100 and
400 are in docs/data/shards.

Usage: drilled_shards.py makes them again, some two hours of one core; drilled_shards.py --table prints what
docs/drilled_charges.md says of them.
"""

from __future__ import annotations

import csv
import statistics
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
NAME, DATA = "drilled_two_spans", ROOT / "docs" / "data"
SEEDS = {100: 20, 400: 6}
FOLDERS = {100: DATA / "shards" / "100", 200: DATA / "seeds", 400: DATA / "shards" / "400"}
DOWN = 0.5
"""Part of a span's deck that has to be more than 2 m lower for the span to count as down."""

HEADER = (
    "| shards | seeds | both spans down | ends at rest | 95 % of debris within, median (range) | made by solver |",
    "| --- | --- | --- | --- | --- | --- |",
)


def main(arguments: list[str]) -> int:
    """Measure, or print the table; the exit status."""
    if arguments == ["--table"]:
        print("\n".join(table()))
        return 0
    for shards, seeds in SEEDS.items():
        options = (f"--seeds={seeds}", f"--shards={shards}", f"--csv={FOLDERS[shards]}")
        subprocess.run([sys.executable, ROOT / "scripts" / "seeds.py", NAME, *options], cwd=ROOT, check=True)
    return 0


def rows(shards: int) -> list[dict[str, str]]:
    """What was measured in the run of each seed."""
    with (FOLDERS[shards] / f"{NAME}.csv").open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def are_down(row: dict[str, str]) -> bool:
    """Whether both spans came down."""
    return all(float(row[f"span_{span}_share_fallen_2_m"]) >= DOWN for span in (1, 2))


def table() -> list[str]:
    """What the page says, a line for each number of shards."""
    return [*HEADER, *(_line(shards) for shards in FOLDERS)]


def _line(shards: int) -> str:
    found = rows(shards)
    throws_m = [float(row["throw_95_percent_m"]) for row in found]
    made = [100.0 * float(row["made_share"]) for row in found]
    at_rest = sum(bool(row["came_to_rest_s"]) for row in found)
    return (
        f"| {shards} | {len(found)} | {sum(map(are_down, found))} | {at_rest} "
        f"| {statistics.median(throws_m):.1f} m ({min(throws_m):.1f} to {max(throws_m):.1f}) "
        f"| {statistics.median(made):.1f} % ({min(made):.1f} to {max(made):.1f}) |"
    )


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
