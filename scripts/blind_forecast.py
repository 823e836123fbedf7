# SPDX-License-Identifier: GPL-3.0-or-later
"""Make a forecast of a case whose outcome is not known, and keep it, once and for all.

Commit what it writes, in docs/data/blind, before the outcome is opened. Then write the outcome beside it, as
CONTRIBUTING.md says, and `scripts/validate --page` puts both on docs/validation.md.
"""

import argparse
import sys
import tempfile
from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
sys.path.insert(1, str(Path(__file__).resolve().parent.parent / "validation"))

from blind import Forecast, forecast_path, keep
from deciding_version import deciding_version
from validate import BLIND_CASES, KNOWN_CASES, blind_case_named

CASES = *BLIND_CASES, *KNOWN_CASES


def main(arguments: Sequence[str] | None = None) -> int:
    """Make a forecast; the exit status is 1 where one was kept before, and --again was not given."""
    parser = argparse.ArgumentParser(prog="blind_forecast", description=__doc__.splitlines()[0])
    parser.add_argument("case", choices=CASES, metavar="CASE", help="one of " + ", ".join(CASES))
    parser.add_argument("--output", type=Path, metavar="DIR", help="keep scenarios and results here")
    parser.add_argument("--again", action="store_true", help="print what it would be now; keep nothing")
    options = parser.parse_args(arguments)
    case = blind_case_named(options.case)
    if not options.again and forecast_path(case.name).exists():
        print(f"The forecast of {case.name} was kept before, and is never made again: see --again", file=sys.stderr)
        return 1
    with tempfile.TemporaryDirectory() as temporary:
        foreseen = list(case.foresee((options.output or Path(temporary)) / case.name))
    for one in foreseen:
        print(f"{one.quantity}: {one.value:g} {one.unit}, {one.low:g} to {one.high:g}", flush=True)
    if not options.again:
        day = datetime.now(UTC).date().isoformat()
        keep(case.name, Forecast(day, deciding_version(f"validation/{case.name}.py"), foreseen))
    return 0


if __name__ == "__main__":
    sys.exit(main())
