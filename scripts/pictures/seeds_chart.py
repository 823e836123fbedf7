# SPDX-License-Identifier: GPL-3.0-or-later
"""Draw how much the throws of one scenario differ from seed to seed, for the documents.

A row of the CSV is one run: its `seed`, the `largest_throw_m` of any shard, and the `throw_95_percent_m` that 95 % of
the shards stay within.
"""

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

DOCS = Path(__file__).resolve().parents[2] / "docs"
DATA = DOCS / "data" / "seeds" / "two_spans_13m_explosives.csv"
PICTURE = DOCS / "pictures" / "seeds_two_spans_13m_explosives.png"


def read_throws(path: Path) -> np.ndarray:
    """Read the runs, one record each, with the smallest of the largest throws first."""
    runs = np.genfromtxt(path, delimiter=",", names=True, ndmin=1)
    return runs[np.argsort(runs["largest_throw_m"], kind="stable")]


def draw(runs: np.ndarray) -> Figure:
    """Draw one column for each run: the throw of the farthest shard above the throw that 95 % stay within."""
    figure = Figure(figsize=(8.0, 3.4), dpi=150, layout="constrained")
    axes = figure.add_subplot()
    columns = np.arange(len(runs))
    axes.vlines(columns, runs["throw_95_percent_m"], runs["largest_throw_m"], color="0.8", zorder=1)
    axes.plot(columns, runs["largest_throw_m"], "o", color="#b5402a", label="farthest shard")
    axes.plot(columns, runs["throw_95_percent_m"], "s", color="#2a5db5", label="95 % of the shards stay within")
    axes.set_xticks(columns, [f"{seed:.0f}" for seed in runs["seed"]])
    axes.set_xlabel("seed of the run, in order of its largest throw")
    axes.set_ylabel("throw, m")
    axes.set_ylim(bottom=0.0)
    axes.grid(axis="y", color="0.9")
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(loc="upper left", frameon=False)
    return figure


if __name__ == "__main__":
    draw(read_throws(DATA)).savefig(PICTURE)
