# SPDX-License-Identifier: GPL-3.0-or-later
"""Say of every example how it stands, what it carries, and what its runs came to, in docs/examples.md.

How a bridge stands is worked out by statics and kept in docs/data/examples.csv. What runs came to is in
docs/data/seeds, which `scripts/seeds` makes. With names of examples only their statics are worked out again; with
`page` the page is written of what there is.
"""

import csv
import math
import posixpath
import statistics
import sys
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
sys.path.insert(1, str(Path(__file__).resolve().parent.parent / "tests"))

from ensembles import runs_table, settings_file
from support.checkout import REPORT_2019, ROOT, SEEDED
from support.example_runs import MEASURED_S

from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.stages.design_loads import carries_design_loads
from bridge_demolition_addon.model.stages.stability import UNKNOWN, stability_of
from bridge_demolition_addon.model.stages.standing import StandingBridge
from bridge_demolition_addon.model.study.runs_table import RESTED, read_runs

PAGE_OF_2019 = REPORT_2019 / "README.md"
PAGE, STATICS, RANGES = (
    ROOT / "docs" / "examples.md",
    ROOT / "docs" / "data" / "examples.csv",
    ROOT / "docs" / "data" / "seeds",
)
COLUMNS = ("example", "verdict", "reason", "utilisation", "member", "load_factor", "positions", "carried")
STUDIED = {
    "drilled_two_spans_longer_zones": "drilled_two_spans_longer_zones",
    "lillebruen": "lillebruen",
    "overbridge": "overbridge",
}
"""Examples of which a study tells instead, in which more than the seed differs, by its name."""
UNDRAWN = ("truss_severed", "tower_pulled_over", "beam_cut_in_stages")
"""Examples in which nothing is drawn by chance: bars are cut evenly, and the beam in prisms."""
DOWN = 0.5
"""Part of a span's deck that has to be more than 2 m lower for the span to count as down."""

HEADER = """\
# All examples, held against what a plan needs

<!-- Made by `scripts/examples_table.py`, which `scripts/remake` calls. -->

Does the bridge of an example stand, what does it carry, and what do runs come to that differ in nothing but their seed?
By statics, for the example's own seed, and by `scripts/seeds` ([tables](data/seeds)). Runs are of an earlier version,
which [remade.json](data/remade.json) names; `scripts/remake --list` says what waits to be made again. Those of 2019
stand [beside their files](../examples/report_2019/README.md#the-demolitions-of-2019-as-they-run).

- **Stands**: largest utilisation under its own weight, and the collapse load factor: how many times as heavy everything
  may become.
- **Carries**: in how many positions of its traffic it stands under 1.35 G + 1.5 Q, the loads for which its bars are
  designed.
- **At rest**: in how many runs all together rested before the end, by their [energy](glossary.md); single shards may
  still tremble. The distances of the others are not final.
- **Down**: in how many runs each span came down, by more than 2 m of at least half of its deck.
- **Throws**: how far debris went on plan from where it was: 95 % of the shards, and the farthest one; least to largest
  of all runs. No distance here is a limit for a plan: that is [of a study](studies.md#a-plan-is-a-study).
- **Made**: energy that the solver made, as a share of what was dissipated: median, least to largest.
"""

OF_2019 = """
Largest utilisation and load factor by statics, and what runs come to that differ in nothing but their seed, as in [all
examples](../../docs/examples.md). Methods without faces of shards have no stresses, so whether a bridge stands is
unknown; it stands in a run as long as it sleeps, as in 2019. Runs are cut short where a time is given. They are of a
version that counted as made by the solver what contacts only [give
back](../../docs/report.md#what-the-numbers-mean).
"""
BEGIN, END = "<!-- examples -->\n", "<!-- end -->"
"""Between these stands the table of the demolitions of 2019, on the page beside them."""


def main(names: list[str]) -> int:
    """Work out the statics of examples, write the page, and return the exit status."""
    if unknown := [name for name in names if name not in (*SEEDED, "page")]:
        print(f"examples_table: there is no example {', '.join(unknown)}", file=sys.stderr)
        return 2
    kept = {row["example"]: row for row in rows(STATICS)}
    for name in [name for name in names if name != "page"] or ([] if names else SEEDED):
        kept[name] = statics(name)
        print(f"{name}: {kept[name]['verdict']}", flush=True)
        with STATICS.open("w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
            writer.writeheader()
            writer.writerows(kept[example] for example in SEEDED if example in kept)
    PAGE.write_text(page(), encoding="utf-8", newline="\n")
    PAGE_OF_2019.write_text(page_of_2019(), encoding="utf-8", newline="\n")
    return 0


def rows(path: Path) -> list[dict[str, str]]:
    """Return the rows of a table; none where it does not exist."""
    if not path.exists():
        return []
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def statics(name: str) -> dict[str, str]:
    """Return how the bridge of an example stands, and what it carries of the loads of its design."""
    scenario = read_scenario(SEEDED[name])
    model = checked_model(scenario)
    stability = stability_of(scenario, model, with_factor=True)
    found = {
        "example": name,
        "verdict": stability.verdict,
        "reason": stability.reason if stability.verdict == UNKNOWN else "",
        "utilisation": number(stability.utilisation),
        "member": stability.used_most or "",
        "load_factor": number(stability.load_factor),
    }
    if model.crack_bars is None:
        return found
    carried = carries_design_loads(scenario, StandingBridge(model, scenario.joints))
    return found | {"positions": str(len(carried)), "carried": str(sum(carried.values()))}


def number(value: float | None) -> str:
    """Return a value with three digits; nothing where there is none."""
    return "" if value is None or not math.isfinite(value) else f"{value:.3g}"


def page() -> str:
    """Return the page, but for the demolitions of 2019."""
    names = [name for name, path in SEEDED.items() if path.parent != REPORT_2019]
    return "\n".join([HEADER, *table(names, PAGE)]) + "\n"


def page_of_2019() -> str:
    """Return the page beside the demolitions of 2019, with their table as it is now."""
    text = PAGE_OF_2019.read_text(encoding="utf-8")
    names = [name for name, path in SEEDED.items() if path.parent == REPORT_2019]
    own = "\n".join([OF_2019, *table(names, PAGE_OF_2019)]) + "\n"
    return text.partition(BEGIN)[0] + BEGIN + own + END + text.partition(END)[2]


def table(names: Iterable[str], page: Path) -> Iterator[str]:
    """Yield the lines of a table of examples, for a page."""
    kept = {row["example"]: row for row in rows(STATICS)}
    yield "| example | stands | carries | runs | at rest | down | throw of 95 % | farthest | made |"
    yield "| --- | --- | --- | --- | --- | --- | --- | --- | --- |"
    for name in names:
        link = f"[{name}]({posixpath.relpath(SEEDED[name].as_posix(), page.parent.as_posix())})"
        yield f"| {link} | {standing(kept.get(name))} | {carrying(kept.get(name))} | {of_runs(name)} |"


def standing(row: dict[str, str] | None) -> str:
    """Return how a bridge stands."""
    if row is None:
        return "not worked out"
    if not row["utilisation"]:
        return row["verdict"]
    factor = f", {row['load_factor']} times its weight" if row["load_factor"] else ""
    return f"{row['verdict']}: {100.0 * float(row['utilisation']):.0f} % used{factor}"


def carrying(row: dict[str, str] | None) -> str:
    """Return what a bridge carries of the loads of its design."""
    if row is None:
        return ""
    if row["positions"] == "0":
        return "no lanes are known"
    return f"in {row['carried']} of {row['positions']}" if row["positions"] else "no bars"


def of_runs(name: str) -> str:
    """Return the columns of a table on the runs of an example."""
    if name in STUDIED:
        return of_study(STUDIED[name])
    if name in UNDRAWN:
        return "one: nothing in it is drawn by chance |  |  |  |  | "
    found = rows(RANGES / f"{name}.csv")
    if not found:
        return "none |  |  |  |  | "
    count = len(found)
    cut = f", {MEASURED_S[name]:g} s" if name in MEASURED_S else ""
    resting = sum(bool(row.get("came_to_rest_s")) for row in found)
    return " | ".join(
        (
            f"{count}{cut}",
            f"{resting} of {count}",
            spans_down(found),
            span_of(found, "throw_95_percent_m", "{:.2f} to {:.2f} m"),
            span_of(found, "largest_throw_m", "{:.2f} to {:.2f} m"),
            made(found),
        )
    )


def of_study(name: str) -> str:
    """Return the columns of a table on the runs of a study, which keeps the farthest throw alone."""
    outputs = [row.outputs for row in read_runs(runs_table(name)).rows]
    down = [key for key in outputs[0] if key.startswith("criteria.") and "comes down" in key]
    downs = "; ".join(f"span {span}: {sum(run[key] is True for run in outputs)}" for span, key in enumerate(down, 1))
    throws_m = [run["largest_throw_m"] for run in outputs]
    resting = sum(run[RESTED] is not None for run in outputs)
    shares = [{"made_share": run["made_by_solver_share"]} for run in outputs]
    return " | ".join(
        (
            f"{len(outputs)} of [a study](../{settings_file(name).relative_to(ROOT).as_posix()})",
            f"{resting} of {len(outputs)}",
            downs,
            "",
            f"{min(throws_m):.2f} to {max(throws_m):.2f} m",
            made(shares),
        )
    )


def spans_down(found: list[dict[str, str]]) -> str:
    """Return in how many runs each span came down."""
    shares = [column for column in found[0] if column.startswith("span_") and column.endswith("_share_fallen_2_m")]
    downs = [sum(float(row[share] or 0) > DOWN for row in found) for share in shares]
    return "; ".join(f"span {index}: {down}" for index, down in enumerate(downs, 1)) or "-"


def span_of(found: list[dict[str, str]], column: str, text: str) -> str:
    """Return least and largest of a quantity."""
    values = [float(row[column]) for row in found if row.get(column)]
    return text.format(min(values), max(values)) if values else "-"


def made(found: Iterable[Mapping[str, Any]]) -> str:
    """Return the median and the range of the energy that the solver made."""
    shares = [100.0 * float(row["made_share"]) for row in found if row.get("made_share")]
    if not shares:
        return "-"
    return f"{statistics.median(shares):.1f} % ({min(shares):.1f} to {max(shares):.1f})"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
