# SPDX-License-Identifier: GPL-3.0-or-later
"""Make the gallery: run every example, put its pictures side by side, and write what its file says of it.

Runs go to runs/gallery/NAME, pictures to docs/pictures/gallery/NAME.jpg. The page docs/gallery.md is rewritten. With
names of examples only those are run again; all other texts and times stay.
"""

import json
import subprocess
import sys
import time
import tomllib
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).resolve().parent.parent
EXAMPLES, RUNS = ROOT / "examples", ROOT / "runs" / "gallery"
PAGE, PICTURES = ROOT / "docs" / "gallery.md", ROOT / "docs" / "pictures" / "gallery"
TIMES = PICTURES / "times.json"
"""Seconds that each run took, kept so that a page can be written without all of them."""

MOMENTS = ("before", "impact", "after")
PICTURE_PX, GAP_PX = (640, 360), 10
QUALITY = 85
LEFT_OUT = "Every key is explained"
"""Beginning of a paragraph that examples have and the page does without."""

HEADER = """\
# Gallery

<!-- Made by `scripts/gallery`: change the examples' own comments instead. -->

Every example is a [scenario file](scenario.md) to start from. Run it with `bda run examples/NAME.toml --output DIR`.
Add `--report` for a [report](report.md). The pictures show the start, the impact (or the blast, or the largest force)
and the end of one run. [One run is one possible outcome](accuracy.md#one-run-is-one-possible-outcome): with another
seed single pieces end elsewhere. Times are those of a machine with two cores and nothing else to do, pictures included.
All examples together took {minutes} minutes.

Every demolition of the 2019 report is here, and some examples go beyond it.

{table}

`bda run examples/report_2019/i235_three_spans_*.toml --output DIR --report` runs several examples one after the other and compares
them: here four positions where the ball falls. A variant needs only the values that differ from another scenario; see
`based_on` in [scenario files](scenario.md). There are also examples of [studies](../examples/studies),
[searches](../examples/searches), [optimisations](../examples/optimisations), [stages](../examples/stages) and
[ground motion](../examples/ground_motion).
"""

STUDY = """\
## A study of the I-235 span

![Plan of the study with its limit, and how many of its runs reach how far](pictures/study_i235_one_span.png)

93 runs of the first of these examples, each with other shards, another height and place of the ball, another strength
and another mass. Shaded is where the probability of debris may be above 5 % and 50 %. Its runs are of an earlier
version, before friction was that of pairs of surfaces and saw torques. What it says stands in
[studies](studies.md#a-plan-is-a-study), all its runs are in [a table](data/studies/i235_one_span.csv), and
`scripts/pictures/study_picture.py` draws the picture from its folder.

Study: [i235_one_span.toml](../examples/studies/i235_one_span.toml).
"""
"""Section on the example of a study, whose picture `scripts/pictures/study_picture.py` makes."""


def main(names: list[str]) -> int:
    """Run examples, write the page and return the exit status."""
    wanted = [EXAMPLES / f"{name}.toml" for name in names] or examples()
    if missing := [path.stem for path in wanted if not path.exists()]:
        print(f"gallery: there is no example {', '.join(missing)}", file=sys.stderr)
        return 2
    PICTURES.mkdir(parents=True, exist_ok=True)
    for path in wanted:
        seconds = run(path)
        side_by_side(RUNS / path.stem / "frames", PICTURES / f"{path.stem}.jpg")
        TIMES.write_text(json.dumps(times() | {path.stem: seconds}, indent=2, sort_keys=True) + "\n", encoding="utf-8")
    PAGE.write_text(page(), encoding="utf-8", newline="\n")
    return 0


def examples() -> list[Path]:
    """Return all examples, by name."""
    return sorted(EXAMPLES.glob("*.toml"))


def run(path: Path) -> float:
    """Run an example as a reader does and return the seconds it took."""
    bda = Path(sys.executable).parent / "bda"
    began = time.perf_counter()
    subprocess.run([bda, "run", path, "--output", RUNS / path.stem, "--overwrite"], check=True)
    return round(time.perf_counter() - began, 1)


def times() -> dict[str, float]:
    """Return the seconds of every run so far, by name."""
    return json.loads(TIMES.read_text(encoding="utf-8")) if TIMES.exists() else {}


def side_by_side(folder: Path, target: Path) -> None:
    """Put the pictures of a run beside each other."""
    width, height = PICTURE_PX
    strip = Image.new("RGB", (len(MOMENTS) * (width + GAP_PX) - GAP_PX, height), "white")
    for number, moment in enumerate(MOMENTS):
        with Image.open(folder / f"{moment}.png") as picture:
            fitted = picture.convert("RGB").resize(PICTURE_PX, Image.Resampling.LANCZOS)
        strip.paste(fitted, (number * (width + GAP_PX), 0))
    strip.save(target, quality=QUALITY, optimize=True)


def page() -> str:
    """Return the page, made of the comments of the examples."""
    taken = times()
    header = HEADER.format(minutes=max(1, round(sum(taken.values()) / 60.0)), table=table())
    return "\n".join([header, *(section(path, taken.get(path.stem)) for path in examples()), STUDY])


def table() -> str:
    """Return a table of all examples and their times."""
    taken = times()
    rows = [
        f"| [{path.stem}](../examples/{path.name}) | {title(path)} | {rounded(taken[path.stem])} |"
        for path in examples()
    ]
    return "\n".join(["| example | what it shows | s |", "| --- | --- | --- |", *rows])


def title(path: Path) -> str:
    """Return the title of a scenario."""
    return tomllib.loads(path.read_text(encoding="utf-8"))["scenario"]["title"]


def section(path: Path, seconds: float | None) -> str:
    """Return the section of an example: its title, its pictures, its words and how long it takes."""
    words = [paragraph for paragraph in paragraphs(path) if not paragraph.startswith(LEFT_OUT)]
    took = [] if seconds is None else [f"Takes {rounded(seconds)} s."]
    file = f"[{path.name}](../examples/{path.name})"
    picture = f"![{title(path)}: at the start, at the decisive moment, at the end](pictures/gallery/{path.stem}.jpg)"
    return "\n\n".join([f"## {title(path)}", picture, *words, " ".join([f"Scenario: {file}.", *took])]) + "\n"


def paragraphs(path: Path) -> list[str]:
    """Return the paragraphs of the comment at the head of an example."""
    lines = []
    for line in path.read_text(encoding="utf-8").splitlines():
        if not line.startswith("#"):
            break
        lines.append(line.removeprefix("#").strip())
    return [" ".join(word.split("\n")) for word in "\n".join(lines).split("\n\n")]


def rounded(seconds: float) -> int:
    """Return seconds to the next 5, as the next run takes a little more or less."""
    return max(5, 5 * round(seconds / 5.0))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
