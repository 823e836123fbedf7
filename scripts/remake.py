# SPDX-License-Identifier: GPL-3.0-or-later
"""Make figures, tables and pictures of the documents again by the program as it is.

Without names all that is of another version is made, the quickest first: overnight, if much has changed. What is made
is noted at once in docs/data/remade.json, so that a call that was stopped goes on with what is left. A version is the
last commit that changed what decides runs, or a script that makes the product. After a change that should decide no
run, `--check` makes the first seed of ranges and one run of each study again, and notes the version where they are the
same.
"""

import argparse
import csv
import json
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests"))

from deciding_version import deciding_version
from ensembles import ENSEMBLES, answer, outputs_that_differ, picture, runs_table, settings_file
from support.checkout import ROOT, SEEDED

RANGES = ROOT / "docs" / "data" / "seeds"
NOTES = ROOT / "docs" / "data" / "remade.json"
SEEDS = 20
UNKNOWN_S = 1800.0
"""What a product is taken to need that was never made here."""


@dataclass(frozen=True)
class Product:
    """What one command makes: files, by paths from the project's folder, and what else than runs decides them."""

    name: str
    command: tuple[str, ...]
    outputs: tuple[str, ...]
    sources: tuple[str, ...]

    def version(self) -> str:
        """The last commit that changed what decides it."""
        return deciding_version(*self.sources)

    def make(self) -> float:
        """Run its command and return the seconds that this took."""
        began = time.monotonic()
        subprocess.run([sys.executable, *self.command], cwd=ROOT, check=True)
        if missing := [path for path in self.outputs if not (ROOT / path).exists()]:
            sys.exit(f"remake: {self.name} did not write {', '.join(missing)}")
        return round(time.monotonic() - began, 1)


def main() -> int:
    """Make what is asked for, or say what would be made; the exit status."""
    known = {product.name: product for product in products()}
    options = arguments(known)
    chosen = [known[name] for name in options.names] or stale(known.values())
    left_s = sum(needed_s(product) for product in chosen)
    print(f"{len(chosen)} of {len(known)} to make, {left_s / 3600.0:.1f} h by what each took before")
    for product in sorted(chosen, key=needed_s):
        print(f"  {product.name:44} {needed_s(product) / 60.0:6.1f} min  {' '.join(product.command)}", flush=True)
        if options.check:
            check(product)
        elif not options.list:
            note(product, product.make())
    return 0


def arguments(known: Iterable[str]) -> argparse.Namespace:
    """What the command line says."""
    parser = argparse.ArgumentParser(prog="remake", description=__doc__.splitlines()[0])
    # No name at all is checked against the choices as an empty list.
    parser.add_argument("names", nargs="*", choices=[*known, []], metavar="NAME", help="products; see --list")
    parser.add_argument("--list", action="store_true", help="print what would be made and how long that takes")
    parser.add_argument("--check", action="store_true", help="note the version of what is the same when run again")
    return parser.parse_args()


def products() -> Iterator[Product]:
    """Yield all that is made from runs."""
    for path in sorted(RANGES.glob("*.csv")):
        command = ("scripts/seeds.py", path.stem, "--seeds", str(SEEDS), "--csv", "docs/data/seeds")
        example = SEEDED[path.stem].relative_to(ROOT).as_posix()
        yield Product(path.stem, command, (path.relative_to(ROOT).as_posix(),), (example, "scripts/seeds.py"))
    for path in sorted((ROOT / "docs" / "data" / "validation").glob("*.json")):
        command = ("scripts/validate.py", "--keep", path.stem)
        output = path.relative_to(ROOT).as_posix()
        yield Product(f"validation/{path.stem}", command, (output,), (f"validation/{path.stem}.py",))
    for name, words in (
        ("growth", ("measure",)),
        ("elastic_beam", ("measure",)),
        ("reinforced_deck", ("12",)),
        ("tosses", ("measure",)),
    ):
        script = f"scripts/experiments/{name}.py"
        yield Product(f"experiments/{name}", (script, *words), (f"docs/data/{name}.csv",), (script,))
    of_shards = "scripts/experiments/drilled_shards.py"
    by_shards = tuple(f"docs/data/shards/{shards}/drilled_two_spans.csv" for shards in (100, 400))
    yield Product("experiments/drilled_shards", (of_shards,), by_shards, ("examples/drilled/two_spans.toml", of_shards))
    for name, ensemble in ENSEMBLES.items():
        example = settings_file(name).relative_to(ROOT).as_posix()
        outputs = tuple(path.relative_to(ROOT).as_posix() for path in (runs_table(name), answer(name), picture(name)))
        yield Product(
            f"{ensemble.command}/{name}", ("scripts/ensembles.py", name), outputs, (example, "scripts/ensembles.py")
        )
    table = ("scripts/examples_table.py",)
    yield Product("examples", table, ("docs/data/examples.csv", "docs/examples.md"), ("examples", *table))
    yield Product("gallery", ("scripts/gallery.py",), ("docs/gallery.md",), ("examples", "scripts/gallery.py"))


def check(product: Product) -> None:
    """Make a run of a product again, and note the version where it is as it was; only ranges and studies have one."""
    if (RANGES / f"{product.name}.csv").exists():
        check_ranges(product)
    elif product.command[0] == "scripts/ensembles.py":
        if differ := outputs_that_differ(product.command[1]):
            print(f"    the run is another one: {', '.join(differ)}", flush=True)
        else:
            note(product)
            print("    the run is the same", flush=True)


def check_ranges(product: Product) -> None:
    """Run the first seed of ranges and that of the example, and note the version where the first is as it was."""
    kept = RANGES / f"{product.name}.csv"
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        command = [sys.executable, "scripts/seeds.py", product.name, "--seeds", "1", "--csv", name]
        subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        first, again = (row(path) for path in (kept, folder / kept.name))
        if differ := [quantity for quantity in first if first[quantity] != again.get(quantity)]:
            print(f"    seed 1 is another run: {', '.join(differ)}", flush=True)
            return
        versions = RANGES / "versions.json"
        known = json.loads(versions.read_text(encoding="utf-8")) if versions.exists() else {}
        known |= json.loads((folder / versions.name).read_text(encoding="utf-8"))
        versions.write_text(json.dumps(known, indent=1, sort_keys=True) + "\n", encoding="utf-8", newline="\n")
    note(product)
    print("    seed 1 is the same run", flush=True)


def row(path: Path) -> dict[str, str]:
    """The first row of a table."""
    with path.open(newline="", encoding="utf-8") as file:
        return next(csv.DictReader(file))


def stale(known: Iterable[Product]) -> list[Product]:
    """The products that were made by another version, or never."""
    made = notes()
    return [product for product in known if made.get(product.name, {}).get("version") != product.version()]


def needed_s(product: Product) -> float:
    """How long a product took the last time."""
    return float(notes().get(product.name, {}).get("seconds", UNKNOWN_S))


def note(product: Product, seconds: float | None = None) -> None:
    """Keep which version made a product, or would make it alike, and how long it took if it was made."""
    took = notes().get(product.name, {}) if seconds is None else {"seconds": seconds}
    made = notes() | {product.name: took | {"version": product.version()}}
    NOTES.write_text(json.dumps(made, indent=1, sort_keys=True) + "\n", encoding="utf-8", newline="\n")


def notes() -> dict[str, dict[str, str | float]]:
    """Version and seconds of all that was made, by name."""
    return json.loads(NOTES.read_text(encoding="utf-8")) if NOTES.exists() else {}


if __name__ == "__main__":
    sys.exit(main())
