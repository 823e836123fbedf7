# SPDX-License-Identifier: GPL-3.0-or-later
"""Bring down a reinforced bridge of two spans by drilled charges, as an example of what a run gives::

    python scripts/demo.py [OUTPUT]      (runs/drilled_two_spans)

Needs an environment in which the project is installed; on Linux, scripts/demo makes one.
"""

import sys
from pathlib import Path

from bridge_demolition_addon.__main__ import main

ROOT = Path(__file__).resolve().parents[1]
EXAMPLE = ROOT / "examples" / "drilled" / "two_spans.toml"
OUTPUT = ROOT / "runs" / "drilled_two_spans"

if __name__ == "__main__":
    output = sys.argv[1] if len(sys.argv) > 1 else str(OUTPUT)
    sys.argv = ["bda", "run", str(EXAMPLE), "--output", output, "--overwrite"]
    main()
