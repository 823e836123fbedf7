# SPDX-License-Identifier: GPL-3.0-or-later
"""Run the cases of the validation and write docs/validation.md and validation/README.md, with a picture for each.

Named ones are run alone and printed; `--keep` writes what they came to into the document, which is otherwise done when
all are run. Each case writes scenarios with their meshes into a folder, so that `bda run` repeats any of them.
"""

import argparse
import importlib
import json
import re
import sys
import tempfile
import time
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
sys.path.insert(1, str(Path(__file__).resolve().parent.parent / "validation"))

import real_demolitions
from blind import BlindCase
from blind_page import section as blind_section
from case import GROUPS, VALIDATION, Against, Case, Comparison, Found
from deciding_version import deciding_version
from matplotlib.figure import Figure

from bridge_demolition_addon.report.wording.checks import TABLE

ROOT = Path(__file__).resolve().parent.parent
CASES = (
    # held against theory of the same model
    "falling_rod",
    "rocking_block",
    "sliding_block",
    "semicircular_arch",
    "breaking_tower",
    "toppling_row",
    "toppling_charge",
    "landing_shaft",
    "blasted_strip",
    "lost_support",
    "sudden_loss",
    "reinforced_slab",
    "drop_on_shards",
    "bars_by_program",
    "bent_beam",
    "catenary",
    # held against what was measured, too
    "tossed_cubes",
    "collapsing_column",
    "prestwood",
    "laboratory_arches",
    "drop_weight",
    "sheared_beam",
    "airblast_far_away",
    "falling_chimney",
    "i235_decks",
)
BLIND_CASES = ("blind_beams", "blind_sections", "blind_airblast")
"""Cases whose forecasts were kept before their outcomes were opened; scripts/blind_forecast makes them."""

KNOWN_CASES = ("real_demolitions",)
"""Cases whose outcomes were known before, and whose forecasts are kept in the same way."""

DOCUMENT, PICTURES = ROOT / "docs" / "validation.md", ROOT / "docs" / "pictures" / "validation"
VERIFICATION = ROOT / "validation" / "README.md"
"""The cases that are held against theory alone, beside their code."""
KEPT = ROOT / "docs" / "data" / "validation"
"""What each case came to when it was kept last, in a file of its own."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """What a case came to, and how many seconds of the processor that took."""

    case: Case
    comparisons: Sequence[Comparison]
    seconds: float
    version: str  # that made it

    @property
    def is_met(self) -> bool:
        """Whether everything in it is as it should be."""
        return all(comparison.is_met for comparison in self.comparisons)

    def held_against(self, against: Against) -> list[Comparison]:
        """Return what is held against that."""
        return [comparison for comparison in self.comparisons if comparison.against == against]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run what is asked for; the exit status is 1 where something is not as it should be."""
    options = _arguments(arguments)
    names = [] if options.page else options.cases or CASES
    is_kept = options.keep or tuple(names) == CASES
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.output or Path(temporary)
        outcomes = [_run(case_named(name), folder, is_kept=is_kept) for name in names]
    if is_kept or options.page:
        outcomes_kept = [kept(name) for name in CASES]
        DOCUMENT.write_text(page(outcomes_kept), encoding="utf-8")
        VERIFICATION.write_text(verification_page(outcomes_kept), encoding="utf-8")
        TABLE.write_text(measurements(outcomes_kept), encoding="utf-8")
        real_demolitions.DOCUMENT.write_text(real_demolitions.page(), encoding="utf-8")
    return 0 if all(outcome.is_met for outcome in outcomes) else 1


def _arguments(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="validate", description=__doc__.splitlines()[0])
    parser.add_argument("cases", nargs="*", choices=[[], *CASES], metavar="CASE", help="cases: " + ", ".join(CASES))
    parser.add_argument("--output", type=Path, metavar="DIR", help="keep scenarios and results here")
    parser.add_argument("--keep", action="store_true", help="write what the named cases come to into the document")
    parser.add_argument("--page", action="store_true", help="write the document again from what was kept; run nothing")
    return parser.parse_args(arguments)


def case_named(name: str) -> Case:
    """Return the case in the module of a name."""
    return importlib.import_module(name).CASE


def blind_case_named(name: str) -> BlindCase:
    """Return the blind case in the module of a name."""
    return importlib.import_module(name).CASE


def _run(case: Case, folder: Path, *, is_kept: bool) -> Outcome:
    """Run a case and print what it came to; keep that and its picture."""
    began = time.process_time()
    found = case.run(folder / case.name)
    seconds, version = time.process_time() - began, deciding_version(f"validation/{case.name}.py")
    outcome = Outcome(case, found.comparisons, seconds, version)
    print(f"{case.title} ({outcome.seconds:.0f} s)")
    for comparison in found.comparisons:
        print("  " + "  ".join(_cells(comparison)), flush=True)
    if is_kept:
        _draw(found, PICTURES / f"{case.name}.png")
        _keep(outcome)
    return outcome


def _keep(outcome: Outcome) -> None:
    rows = [asdict(comparison) for comparison in outcome.comparisons]
    kept = {"seconds": round(outcome.seconds, 1), "version": outcome.version, "comparisons": rows}
    text = json.dumps(kept, indent=1, ensure_ascii=False)
    KEPT.mkdir(parents=True, exist_ok=True)
    (KEPT / f"{outcome.case.name}.json").write_text(text + "\n", encoding="utf-8")


def kept(name: str) -> Outcome:
    """Return what a case came to when it was kept last."""
    data = json.loads((KEPT / f"{name}.json").read_text(encoding="utf-8"))
    comparisons = [
        Comparison(**{**row, "expected": _expected(row["expected"]), "against": Against(row["against"])})
        for row in data["comparisons"]
    ]
    return Outcome(case_named(name), comparisons, data["seconds"], data["version"])


def _expected(value: float | list[float]) -> float | tuple[float, ...]:
    return tuple(value) if isinstance(value, list) else value


def page(outcomes: Sequence[Outcome]) -> str:
    """Return the document."""
    lines = [_HEAD, *_overview(outcomes), "", "## What misses", "", _MISSES, "", *_misses(outcomes)]
    minutes = sum(outcome.seconds for outcome in outcomes) / 60.0
    lines += ["", f"All of them take {minutes:.0f} minutes.", ""]
    lines += ["## Validation", "", _VALIDATION, "", *_sections(outcomes, VALIDATION)]
    lines += blind_section([blind_case_named(name) for name in BLIND_CASES])
    return "\n".join(lines)


def verification_page(outcomes: Sequence[Outcome]) -> str:
    """Return the document of the cases that are held against theory of the same model alone."""
    text = "\n".join([_VERIFICATION, *_sections(outcomes, GROUPS[0])])
    return re.sub(r"\]\((?=[a-z])", "](../docs/", text)


def _sections(outcomes: Sequence[Outcome], group: str) -> list[str]:
    return [line for outcome in outcomes if outcome.case.group == group for line in _section(outcome)]


def _overview(outcomes: Sequence[Outcome]) -> list[str]:
    lines = [
        "| case | verification: within, of | validation: within, of | found over measured |",
        "| --- | --- | --- | --- |",
    ]
    for outcome in outcomes:
        ratios = [given for row in outcome.held_against(Against.MEASURED) if (given := row.ratio) is not None]
        ends = sorted({f"{ratio:.2f}" for ratio in (min(ratios), max(ratios))}) if ratios else []
        cells = [_link(outcome), *(_counted(outcome.held_against(against)) for against in Against), " to ".join(ends)]
        lines.append(f"| {' | '.join(cells)} |")
    totals = [_counted([row for outcome in outcomes for row in outcome.held_against(against)]) for against in Against]
    return [*lines, f"| all | {' | '.join(totals)} | |"]


def measurements(outcomes: Sequence[Outcome]) -> str:
    """Return the table of cases that are held against measurements, as reports count them."""
    lines = ["case,within,of,least_ratio,largest_ratio"]
    for outcome in outcomes:
        if rows := outcome.held_against(Against.MEASURED):
            ratios = [given for row in rows if (given := row.ratio) is not None]
            ends = [f"{end(ratios):.6g}" if ratios else "" for end in (min, max)]
            within = sum(row.is_met for row in rows)
            lines.append(",".join([f'"{outcome.case.title}"', str(within), str(len(rows)), *ends]))
    return "\n".join(lines) + "\n"


def _counted(comparisons: Sequence[Comparison]) -> str:
    return f"{sum(row.is_met for row in comparisons)} of {len(comparisons)}" if comparisons else ""


def _misses(outcomes: Sequence[Outcome]) -> list[str]:
    lines = ["| case | quantity | held against | expected | found | ratio |", "| --- | --- | --- | --- | --- | --- |"]
    for outcome in outcomes:
        for row in outcome.comparisons:
            if not row.is_met:
                quantity, expected, found, *_ = _cells(row)
                ratio = "" if row.ratio is None else f"{row.ratio:.2f}"
                lines.append(
                    f"| {_link(outcome)} | {quantity} | {_NAMES[row.against]} | {expected} | {found} | {ratio} |"
                )
    return lines


def _link(outcome: Outcome) -> str:
    page = "" if outcome.case.group == VALIDATION else "../validation/README.md"
    return f"[{outcome.case.title}]({page}#{_anchor(outcome.case.title)})"


def _anchor(title: str) -> str:
    """Return the anchor of a heading, as GitHub makes it."""
    return "".join(character for character in title.lower() if character.isalnum() or character in " -").replace(
        " ", "-"
    )


def _draw(found: Found, path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    figure = Figure(figsize=(7.0, 3.6), layout="constrained")
    found.draw(figure)
    figure.savefig(path, dpi=130)


def _section(outcome: Outcome) -> list[str]:
    case, seconds = outcome.case, outcome.seconds
    tables = [_table(outcome, against) for against in Against if outcome.held_against(against)]
    return [
        f"### {case.title}",
        "",
        case.asked,
        "",
        f"*Left out*: {case.left_out}",
        "",
        f"*Source*: {case.source}",
        "",
        *(line for table in tables for line in table),
        f"*Tolerance*: {case.reason}",
        "",
        f"![{case.title}](pictures/validation/{case.name}.png)",
        "",
        f"`scripts/validate {case.name} --output DIR`: {max(5, 5 * round(seconds / 5)):.0f} s, version "
        f"`{outcome.version}`.",
        "",
    ]


def _table(outcome: Outcome, against: Against) -> list[str]:
    last = "off by" if against == Against.THEORY else "ratio"
    rows = [f"| {' | '.join(_cells(comparison))} |" for comparison in outcome.held_against(against)]
    return [f"| {_NAMES[against]} | expected | found | {last} | |", "| --- | --- | --- | --- | --- |", *rows, ""]


def _cells(comparison: Comparison) -> tuple[str, ...]:
    unit = f" {comparison.unit}" if comparison.unit else ""
    verdict = "within" if comparison.is_met else "**beyond**"
    if isinstance(comparison.expected, tuple):
        low, high = comparison.expected
        return comparison.quantity, f"{low:.4g} to {high:.4g}{unit}", f"{comparison.found:.4g}{unit}", "", verdict
    off = comparison.found / comparison.expected
    limit = f"{verdict} {100.0 * comparison.tolerance:g} %"
    expected, found = (f"{value:.4g}{unit}" for value in (comparison.expected, comparison.found))
    by = f"{100.0 * (off - 1.0):+.1f} %" if comparison.against == Against.THEORY else f"{off:.2f}"
    return comparison.quantity, expected, found, by, limit


_NAMES = {Against.THEORY: "theory", Against.MEASURED: "measured"}

_HEAD = """# Verification and validation

Cases with a known answer, side by side with what this add-on makes of them. `scripts/validate` runs them and writes
this page.

- **Verification**: does the program calculate what its model says? Its numbers are held against theory of the same
  model: exact answers, limit analysis, other programs. These cases are [beside their code](../validation/README.md).
- **Validation**: is that what happens? Its numbers are held against what was measured, or against formulas that were
  fitted to tests. The ratio is what was found over what was measured.

What agrees with theory may be far from what was measured, where the model leaves out what matters. A case that misses
stays in. Cases were built with their outcome at hand; the [blind forecasts](#blind-forecasts) were not.

Bodies are rigid, and contacts are Bullet's: damping is off but in examples of the add-on and in columns of loose
blocks, and edges are sharp. In cases with bars the connections are elastic.
"""

_VERIFICATION = """# Verification

Cases that are held against theory of the same model alone; `scripts/validate` writes this page.
[Verification and validation](validation.md) says how all cases came out.
"""

_MISSES = """What is beyond its tolerance, with the ratio of what was found to what was expected."""

_VALIDATION = """Held against what was measured, and where it is known against theory of the same model, too."""


if __name__ == "__main__":
    sys.exit(main())
