# SPDX-License-Identifier: GPL-3.0-or-later
"""Play sequences of random steps, and print the fewest steps that crash, hang or end in a traceback.

In `blender`, steps are the add-on's buttons and settings, mixed with Blender's own edits, undo, files and scenes. A
crash counts only where bare Blender, which does the same without the add-on, does not crash. In `scenarios`, files are
changed, checked and run; in `folders`, results are damaged and reported. Each seed always gives the same sequence.
"""

import argparse
import os
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
sys.path.insert(1, str(Path(__file__).resolve().parent.parent / "tests"))
os.environ["OPENBLAS_NUM_THREADS"] = "1"

from fuzzing.batches import Ending, Outcome, alone, fewest_before, is_ours, minimised, outcomes
from fuzzing.players import PLAYERS
from fuzzing.sequences import Drawn


def main() -> int:
    """Play what is asked for; the exit status is 1 where anything went wrong."""
    options = arguments()
    if options.only:
        return show(options)
    seeds = range(options.seed, options.seed + options.count)
    drawn = [Drawn(seed, options.length) for seed in seeds]
    began, findings = time.monotonic(), 0
    for first in range(0, len(drawn), options.batch):
        batch = drawn[first : first + options.batch]
        before: list[Drawn] = []
        for sequence, outcome in zip(batch, outcomes(options.player, batch, bare=options.bare), strict=True):
            if outcome.ending != Ending.WELL:
                findings += report(options, before, sequence, outcome)
            before = [] if outcome.ending in (Ending.CRASH, Ending.HANG) else [*before, sequence]
        print(f"{first + len(batch)} sequences, {findings} findings, {time.monotonic() - began:.0f} s", flush=True)
    return 1 if findings else 0


def arguments() -> argparse.Namespace:
    """What the command line says."""
    parser = argparse.ArgumentParser(prog="fuzz", description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("player", choices=PLAYERS, help="what is tried")
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="seed of the first sequence (1)")
    parser.add_argument("--count", type=int, default=100, metavar="N", help="how many sequences (100)")
    parser.add_argument("--length", type=int, default=30, metavar="N", help="steps in each (30)")
    parser.add_argument("--batch", type=int, default=25, metavar="N", help="sequences in a process (25)")
    parser.add_argument(
        "--only", type=rows, metavar="N,N", help="play only these steps of one sequence, and print them"
    )
    parser.add_argument(
        "--after", type=rows, default=(), metavar="N,N", help="with --only: play these seeds first, in the same process"
    )
    parser.add_argument("--bare", action="store_true", help="leave out the add-on")
    parser.add_argument("--whole", action="store_true", help="do not look for the fewest steps")
    return parser.parse_args()


def rows(text: str) -> tuple[int, ...]:
    """Return numbers of steps, divided by commas."""
    return tuple(int(word) for word in text.split(","))


def show(options: argparse.Namespace) -> int:
    """Play steps by themselves, and print what they do."""
    before = [Drawn(seed, options.length) for seed in options.after]
    drawn = Drawn(options.seed, options.length, options.only)
    outcome = alone(options.player, drawn, before=before, bare=options.bare, tries=1)
    print_outcome(outcome)
    return 0 if outcome.ending == Ending.WELL else 1


def report(options: argparse.Namespace, before: list[Drawn], drawn: Drawn, outcome: Outcome) -> bool:
    """Print what went wrong in a sequence, unless bare Blender crashes as well; whether it is a finding."""
    player, bare = options.player, options.bare
    print(f"\n{player}, seed {drawn.seed}: {outcome.ending} in {outcome.done[-1:]}", flush=True)
    needed: list[Drawn] = []
    again = alone(player, drawn, bare=bare)
    if again.ending == Ending.WELL and before:
        needed, again = before, alone(player, drawn, before=before, bare=bare)
    if again.ending == Ending.WELL:
        print(f"not again, alone or after {[sequence.seed for sequence in before]}")
        print_outcome(outcome)
        return True
    if not bare and not is_ours(player, drawn, again, before=needed):
        print("so it is in bare Blender")
        return False
    fewest = drawn._replace(rows=tuple(range(len(again.done))))
    if not options.whole:
        needed = fewest_before(player, needed, drawn, again, bare=bare)
        fewest = minimised(player, drawn, again, before=needed, bare=bare)
    only, after = (",".join(map(str, numbers)) for numbers in (fewest.rows, [sequence.seed for sequence in needed]))
    after = f" --after {after}" if after else ""
    print(f"again: scripts/fuzz {player} --seed {drawn.seed} --length {drawn.length} --only {only}{after}")
    last = again if options.whole else alone(player, fewest, before=needed, bare=bare)
    print_outcome(last if last.ending != Ending.WELL else again)
    return True


def print_outcome(outcome: Outcome) -> None:
    """Print the steps of a sequence, and how it ended."""
    print(*(f"  {step}" for step in outcome.done), outcome.ending, outcome.text.strip(), sep="\n", flush=True)


if __name__ == "__main__":
    sys.exit(main())
