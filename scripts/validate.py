# SPDX-License-Identifier: GPL-3.0-or-later
"""Run the cases of the validation and write docs/validation.md, with a picture for each.

Named ones are run alone and printed; the document is written when all are run. Each case writes scenarios with their
meshes into a folder, so that `bda run` repeats any of them.
"""

import argparse
import importlib
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
sys.path.insert(1, str(Path(__file__).resolve().parent.parent / "validation"))

from case import GROUPS, Case, Comparison, Found
from matplotlib.figure import Figure

ROOT = Path(__file__).resolve().parent.parent
CASES = ("falling_rod", "rocking_block", "sliding_block", "semicircular_arch", "breaking_tower")
DOCUMENT, PICTURES = ROOT / "docs" / "validation.md", ROOT / "docs" / "pictures" / "validation"


def main(arguments: Sequence[str] | None = None) -> int:
    """Run what is asked for; the exit status is 1 where something is not as it should be."""
    options = _arguments(arguments)
    names = options.cases or CASES
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.output or Path(temporary)
        outcomes = [(case, *_run(case, folder)) for case in map(_case, names)]
    for case, found, seconds in outcomes:
        print(f"{case.title} ({seconds:.0f} s)")
        for each in found.comparisons:
            print("  " + "  ".join(_cells(each)))
    if tuple(names) == CASES:
        _write(outcomes)
    return 0 if all(each.is_met for _, found, _ in outcomes for each in found.comparisons) else 1


def _arguments(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="validate", description=__doc__.splitlines()[0])
    parser.add_argument("cases", nargs="*", choices=[[], *CASES], metavar="CASE", help="cases: " + ", ".join(CASES))
    parser.add_argument("--output", type=Path, metavar="DIR", help="keep scenarios and results here")
    return parser.parse_args(arguments)


def _case(name: str) -> Case:
    return importlib.import_module(name).CASE


def _run(case: Case, folder: Path) -> tuple[Found, float]:
    began = time.perf_counter()
    return case.run(folder / case.name), time.perf_counter() - began


def _write(outcomes: Sequence[tuple[Case, Found, float]]) -> None:
    """Write the document and the pictures."""
    PICTURES.mkdir(parents=True, exist_ok=True)
    lines = [_HEAD]
    for group in GROUPS:
        members = [each for each in outcomes if each[0].group == group]
        lines += [f"## {group}", ""] if members else []
        for case, found, seconds in members:
            _draw(found, PICTURES / f"{case.name}.png")
            lines += _section(case, found, seconds)
    DOCUMENT.write_text("\n".join(lines), encoding="utf-8")


def _draw(found: Found, path: Path) -> None:
    figure = Figure(figsize=(7.0, 3.6), layout="constrained")
    found.draw(figure)
    figure.savefig(path, dpi=130)


def _section(case: Case, found: Found, seconds: float) -> list[str]:
    rows = [f"| {' | '.join(_cells(each))} |" for each in found.comparisons]
    return [
        f"### {case.title}",
        "",
        case.asked,
        "",
        f"*Left out*: {case.left_out}",
        "",
        f"*Source*: {case.source}",
        "",
        "| quantity | expected | found | off by | |",
        "| --- | --- | --- | --- | --- |",
        *rows,
        "",
        f"*Why it may be off by so much*: {case.reason}",
        "",
        f"![{case.title}](pictures/validation/{case.name}.png)",
        "",
        f"    scripts/validate {case.name} --output DIR",
        "",
        f"repeats it in {max(5, 5 * round(seconds / 5)):.0f} s, and leaves its scenarios in `DIR`.",
        "",
    ]


def _cells(comparison: Comparison) -> tuple[str, ...]:
    unit = f" {comparison.unit}" if comparison.unit else ""
    verdict = "within its tolerance" if comparison.is_met else "**beyond its tolerance**"
    if isinstance(comparison.expected, tuple):
        low, high = comparison.expected
        return comparison.quantity, f"{low:.4g} to {high:.4g}{unit}", f"{comparison.found:.4g}{unit}", "", verdict
    off = comparison.found / comparison.expected - 1.0
    limit = f"{verdict} of {100.0 * comparison.tolerance:g} %"
    expected, found = (f"{value:.4g}{unit}" for value in (comparison.expected, comparison.found))
    return comparison.quantity, expected, found, f"{100.0 * off:+.1f} %", limit


_HEAD = """# Validation

Cases with a known answer, side by side with what this add-on makes of them. `scripts/validate` runs them and writes
this page. Exact answers, published formulas and measurements are kept apart; so far there are exact answers alone. What
the model leaves out stands before the numbers. A case that misses stays in.

Bodies are rigid, and contacts are Bullet's: damping is off in all cases, and edges are sharp.
"""


if __name__ == "__main__":
    sys.exit(main())
