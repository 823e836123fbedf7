# SPDX-License-Identifier: GPL-3.0-or-later
"""Ratios of benches by commit: a table, a picture, and which of them have grown.

Ratios of one processor alone are held against each other: `docs/data/bench.csv` has them in the order in which they
were taken, and how many programs wanted to run on each core in the last quarter of an hour: 1 by the bench alone on one
core, more where others took its time.
"""

import csv
import datetime
import os
import platform
import subprocess
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path

from matplotlib.figure import Figure

from bridge_demolition_addon.system.processor import processor_name

ROOT = Path(__file__).resolve().parent.parent
TABLE, PICTURE = ROOT / "docs" / "data" / "bench.csv", ROOT / "docs" / "pictures" / "bench_history.png"
COLUMNS = ("commit", "date", "processor", "python", "load", "bench", "ratio", "value")
SEEN = 1.05
"""Growth that is named. Where a computer shares its memory with others, ratios scatter by more: run a bench again
before you look for a change."""


def keep(found: Mapping[str, Mapping[str, float]], table: Path = TABLE, picture: Path = PICTURE) -> None:
    """Add the ratios of benches to the table, with the commit that is checked out, and draw all of them."""
    of_run = {
        "commit": commit(),
        "date": datetime.datetime.now(datetime.UTC).date().isoformat(),
        "processor": processor_name(),
        "python": platform.python_version(),
        "load": load(),
    }
    rows = kept(table)
    for bench, ratios in found.items():
        rows += [of_run | {"bench": bench, "ratio": name, "value": f"{value:.4g}"} for name, value in ratios.items()]
    table.parent.mkdir(parents=True, exist_ok=True)
    with table.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    drawn(rows).savefig(picture)


def kept(table: Path = TABLE) -> list[dict[str, str]]:
    """Return all rows of the table; none where it does not exist."""
    if not table.exists():
        return []
    with table.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def load() -> str:
    """Return how many programs wanted to run on each core in a quarter of an hour; empty where it is not known."""
    if not hasattr(os, "getloadavg"):
        return ""
    return f"{os.getloadavg()[2] / (os.cpu_count() or 1):.1f}"


def commit() -> str:
    """Return the commit that is checked out; the program exits where files of the program have been changed since."""
    words = ("git", "status", "--porcelain", "--", "bridge_demolition_addon", "scripts")
    if subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=True).stdout:
        sys.exit("bench: commit your changes first: ratios are kept with a commit")
    words = ("git", "rev-parse", "--short", "HEAD")
    return subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=True).stdout.strip()


def series(rows: list[dict[str, str]]) -> dict[tuple[str, str, str], list[tuple[str, float]]]:
    """Return commits and values of each ratio, by processor, bench and name, in the order in which they were taken."""
    found: dict[tuple[str, str, str], list[tuple[str, float]]] = {}
    for row in rows:
        key = row["processor"], row["bench"], row["ratio"]
        found.setdefault(key, []).append((row["commit"], float(row["value"])))
    return found


def grown(table: Path = TABLE) -> Iterator[str]:
    """Yield a line for each ratio that is more than 5 % larger than the last time on the same processor."""
    for (_, bench, name), values in series(kept(table)).items():
        if len(values) > 1 and values[-1][1] > SEEN * values[-2][1]:
            (before, less), (now, more) = values[-2:]
            yield f"slower: {bench}, {name}: {less:.2f} in {before}, {more:.2f} in {now}, {more / less - 1.0:+.0%}"


def drawn(rows: list[dict[str, str]]) -> Figure:
    """Draw ratios over commits, a bench beside the other."""
    of_ratios = series(rows)
    benches = list(dict.fromkeys(bench for _, bench, _ in of_ratios))
    commits = list(dict.fromkeys(row["commit"] for row in rows))
    figure = Figure(figsize=(11.0, 3.0 * len(benches)), dpi=100, layout="constrained")
    for axes, bench in zip(figure.subplots(len(benches), squeeze=False)[:, 0], benches, strict=True):
        for (_, of_bench, name), values in of_ratios.items():
            if of_bench == bench:
                places = [commits.index(made) for made, _ in values]
                axes.plot(places, [value for _, value in values], marker="o", label=name)
        axes.set_xticks(range(len(commits)), commits, rotation=45, ha="right")
        axes.set(title=bench, ylabel="ratio", yscale="log", xlim=(-0.5, len(commits) - 0.5))
        axes.yaxis.set_major_formatter("{x:g}")
        axes.yaxis.set_minor_formatter("{x:.2g}")
        axes.legend(fontsize="x-small", loc="center left", bbox_to_anchor=(1.0, 0.5))
    return figure
