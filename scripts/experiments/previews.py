# SPDX-License-Identifier: GPL-3.0-or-later
"""Run previews of presets and examples with elastic connections over several seeds, and compare them with whole runs.

What a preview says in its first seconds is taken after twice the CPU time of a whole preview with rigid connections,
which was run in the same process just before: on another computer, or beside other work, both take longer alike.
"""

import argparse
import csv
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
sys.path.insert(1, str(Path(__file__).resolve().parents[2] / "tests"))

import numpy as np
from support.checkout import PRESETS, ROOT, SEEDED
from support.example_measures import deck_falls
from support.example_runs import ExampleRun

from bridge_demolition_addon.model.debris.footprint import landed
from bridge_demolition_addon.model.results.arrays import Results
from bridge_demolition_addon.model.results.motion import MOVED_M, relative_to_ground
from bridge_demolition_addon.model.scenario import Scenario
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.study.preview_scenario import preview_model
from bridge_demolition_addon.simulation.motion_run import motion_run
from bridge_demolition_addon.simulation.playback import Playing

KEPT = ROOT / "docs" / "data" / "previews.csv"
SCENARIOS = {path.stem: path for path in PRESETS.rglob("*.toml")} | dict(SEEDED)
RIGID = "span_of_2019_ball"
HALF = 0.5
SOON_IN_RIGID = 2.0
"""After so many times as long as a preview with rigid connections takes, a first picture is looked at."""


@dataclass(frozen=True)
class Outcome:
    """Share of each span's deck that is more than 2 m lower, and how far shards got on plan, m."""

    spans: tuple[float, ...]
    largest_m: float
    most_m: float  # 95 % of the shards get no farther


@dataclass(frozen=True)
class Row:
    """A run, as it is kept."""

    scenario: str
    seed: int
    kind: str
    shards: int
    spans: str
    largest_throw_m: float
    throw_95_percent_m: float
    time_in_rigid: float | None = None
    soon_s: float | None = None
    soon_spans: str = ""
    soon_throw_95_percent_m: float | None = None


def main() -> None:
    """Run what is asked for, and keep a row of each run."""
    parser = argparse.ArgumentParser(prog="previews.py", description=__doc__.splitlines()[0])
    parser.add_argument("--table", action="store_true", help="print what docs/sidebar.md says of all, and run nothing")
    parser.add_argument("names", nargs="*", choices=sorted(SCENARIOS), metavar="NAME", help="presets and examples")
    parser.add_argument("--seeds", type=int, default=4, metavar="COUNT", help="how many, from 1 on (4)")
    parser.add_argument("--whole", action="store_true", help="whole runs; examples have theirs in docs/data/seeds")
    parser.add_argument("--csv", type=Path, default=KEPT, metavar="FILE", help="to which rows are added")
    options = parser.parse_args()
    if options.table:
        print(table(options.csv))
        return
    rigid_s = 0.0 if options.whole else time_of_rigid()
    for name in options.names:
        for seed in range(1, options.seeds + 1):
            row = run(name, seed, rigid_s, is_whole=options.whole)
            keep(options.csv, row)
            print(row, flush=True)


def time_of_rigid() -> float:
    """CPU time of a preview with rigid connections, s; of the second, as the first loads what all need."""
    times_s = []
    for _ in range(2):
        began = time.process_time()
        run(RIGID, 1, 0.0, is_whole=False)
        times_s.append(time.process_time() - began)
    return times_s[-1]


def run(name: str, seed: int, rigid_s: float, *, is_whole: bool) -> Row:
    """Run a scenario with a seed, as a preview or whole, and return what came of it."""
    began = time.process_time()
    scenario = replace(read_scenario(SCENARIOS[name]), seed=seed)
    scenario, model = (scenario, checked_model(scenario)) if is_whole else preview_model(scenario)
    soon: list[tuple[float, Outcome]] = []

    def look_on(playing: Playing) -> None:
        if rigid_s and not soon and time.process_time() - began > SOON_IN_RIGID * rigid_s:
            results = landed(relative_to_ground(playing.recording.results()))[0]
            soon.append((float(results.frames.time_s[-1]), outcome(scenario, results)))

    with tempfile.TemporaryDirectory() as folder, motion_run(scenario, model, Path(folder), look_on) as (results, _):
        took_s, found = time.process_time() - began, outcome(scenario, results)
        if rigid_s and not soon:
            soon.append((float(results.frames.time_s[-1]), found))
    row = Row(name, seed, "whole" if is_whole else "preview", len(model.shards), *as_text(found))
    if not soon:
        return row
    (soon_s, first), in_rigid = soon[0], took_s / rigid_s
    texts = as_text(first)
    return replace(row, time_in_rigid=in_rigid, soon_s=soon_s, soon_spans=texts[0], soon_throw_95_percent_m=texts[2])


def outcome(scenario: Scenario, results: Results) -> Outcome:
    """What of a bridge has fallen by the last frame; all of it counts as one span where it has no decks."""
    part = ExampleRun(scenario, {}, results)
    spans = tuple(value for quantity, value in deck_falls(part).items() if "share" in quantity)
    throws_m = part.throws_m(part.shards)
    spans = spans or ((part.fallen_m(part.shards) > 2.0).mean(),)
    return Outcome(spans, float(throws_m.max()), float(np.quantile(throws_m, 0.95)))


def as_text(found: Outcome) -> tuple[str, float, float]:
    """Shares of spans in one text, and throws to the cm."""
    return " ".join(f"{share:.2f}" for share in found.spans), round(found.largest_m, 2), round(found.most_m, 2)


def keep(path: Path, row: Row) -> None:
    """Add a row to a table, in place of an older one of the same run."""
    columns = [field.name for field in fields(Row)]
    mine = (row.scenario, str(row.seed), row.kind)
    rows = [old for old in read(path) if (old["scenario"], old["seed"], old["kind"]) != mine]
    values = {name: getattr(row, name) for name in columns}
    for name in ("time_in_rigid", "soon_s"):
        values[name] = "" if values[name] is None else round(values[name], 2)
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows(sorted([*rows, values], key=lambda one: (one["scenario"], one["kind"], int(one["seed"]))))


def read(path: Path) -> Iterator[dict[str, str]]:
    """Rows of a table; none where it is not there yet."""
    rows: Sequence[dict[str, str]] = ()
    if path.exists():
        with path.open(encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
    yield from rows


def table(path: Path) -> str:
    """Lines of docs/sidebar.md: how previews of each scenario compare with its whole runs."""
    lines = []
    for name, (previews, wholes) in compared(path).items():
        spans = [f"{percent(pairs_alike(column, previews, wholes)):.0f}" for column in ("soon_spans", "spans")]
        among = percent(pairs_alike("spans", wholes, wholes)) if len(wholes) > 1 else None
        ratio = throw_ratio(previews, wholes)
        times = [float(row["time_in_rigid"]) for row in previews]
        cells = (
            f"`{name}`",
            f"{len(previews)}, {len(wholes)}",
            *spans,
            "" if among is None else f"{among:.0f}",
            "none gets far" if ratio is None else f"{ratio:.2f}",
            f"{min(times):.1f} to {max(times):.1f}",
        )
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)


def compared(path: Path = KEPT) -> dict[str, tuple[list[dict[str, str]], list[dict[str, str]]]]:
    """Previews and whole runs of each scenario, each with `spans` and `throw_95_percent_m`."""
    rows = list(read(path))
    names = sorted({row["scenario"] for row in rows if row["kind"] == "preview"})
    found = {}
    for name in names:
        mine = [row for row in rows if row["scenario"] == name]
        wholes = [row for row in mine if row["kind"] == "whole"] or list(whole_runs(name))
        found[name] = [row for row in mine if row["kind"] == "preview"], wholes
    return found


def whole_runs(name: str) -> Iterator[dict[str, str]]:
    """Whole runs of an example over seeds that `scripts/seeds` has kept."""
    for row in read(ROOT / "docs" / "data" / "seeds" / f"{name}.csv"):
        spans = [value for quantity, value in row.items() if quantity.endswith("_share_fallen_2_m")]
        yield {"spans": " ".join(spans), "throw_95_percent_m": row["throw_95_percent_m"]}


def pairs_alike(column: str, previews: Sequence[dict[str, str]], wholes: Sequence[dict[str, str]]) -> tuple[int, int]:
    """Of all spans in all pairs of runs, how many fall in both or stand in both, and how many there are."""
    alike = count = 0
    for preview in previews:
        for whole in wholes:
            if preview is whole:
                continue
            pairs = zip(falls(preview[column]), falls(whole["spans"]), strict=True)
            same = [one == other for one, other in pairs if None not in (one, other)]
            alike, count = alike + sum(same), count + len(same)
    return alike, count


def falls(spans: str) -> list[bool | None]:
    """Whether each span falls: half of its deck; None where a preview has no middle of a shard in it."""
    shares = [float(share) for share in spans.split()]
    return [None if np.isnan(share) else share >= HALF for share in shares]


def percent(counts: tuple[int, int]) -> float:
    """A part of a whole, in %."""
    return 100.0 * counts[0] / counts[1]


def throw_ratio(previews: Sequence[dict[str, str]], wholes: Sequence[dict[str, str]]) -> float | None:
    """How far most shards of previews get over those of whole runs, by medians; None where nothing gets anywhere."""
    of_previews, of_wholes = (
        float(np.median([float(row["throw_95_percent_m"]) for row in rows])) for rows in (previews, wholes)
    )
    return of_previews / of_wholes if min(of_previews, of_wholes) > MOVED_M else None


if __name__ == "__main__":
    main()
