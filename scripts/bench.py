# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure how fast this is, as ratios taken in one run: ours against Blender's bare step and against plainer ways.

Each bench is a module of `scripts/benches` and runs in a process of its own.
"""

import argparse
import importlib
import os
import subprocess
import sys
import traceback

BENCHES = ("building", "fracture", "recording", "blast", "contours", "panels", "report", "elastic", "studies")


def main() -> int:
    """Run the benches that are asked for; the exit status is 1 where one failed."""
    parser = argparse.ArgumentParser(prog="bench", description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help="benches, all by default: " + ", ".join(BENCHES))
    parser.add_argument("--smallest", action="store_true", help="the smallest sizes, once: shows that benches work")
    options = parser.parse_args()
    if unknown := set(options.names) - set(BENCHES):
        parser.error(f"no bench has the name {', '.join(sorted(unknown))}")
    if len(options.names) == 1:
        return run(options.names[0], options.smallest)
    status = 0
    for name in options.names or BENCHES:
        print(f"== {name}", flush=True)
        command = [sys.executable, __file__, name, *(["--smallest"] if options.smallest else [])]
        status |= subprocess.run(command, check=False).returncode != 0
    return status


def run(name: str, smallest: bool) -> int:
    """Run a bench in this process."""
    try:
        importlib.import_module(f"benches.{name}").main(smallest)
    except Exception:
        traceback.print_exc()
        return 1
    return 0


if __name__ == "__main__":
    status = main()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)  # Blender's own end may hang
