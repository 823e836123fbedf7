# SPDX-License-Identifier: GPL-3.0-or-later
"""Make the gallery: run every example, put its pictures side by side, and write what `gallery_texts.toml` says of it.

Runs go to runs/gallery/NAME, pictures to docs/pictures/gallery/NAME.jpg. The page docs/gallery.md is rewritten. With
names of examples only those are run again; all other texts and times stay. With --pictures nothing is run: pictures are
taken again of the runs that are there.
"""

import csv
import json
import subprocess
import sys
import textwrap
import time
import tomllib
from dataclasses import replace
from pathlib import Path

from PIL import Image

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
sys.path.insert(1, str(Path(__file__).resolve().parent.parent / "tests"))

from support.checkout import SEEDED as FILES
from support.example_runs import MEASURED_S

ROOT = Path(__file__).resolve().parent.parent
SEEDED = {path: name for name, path in FILES.items()}
"""Names of examples that are run with many seeds, by their files."""

SMALL_M, SMALL_SHARE = 0.1, 0.02
"""Below these a digit more is shown."""

EXAMPLES, RUNS = ROOT / "examples", ROOT / "runs" / "gallery"
REPORT_2019 = EXAMPLES / "report_2019"
DRILLED = EXAMPLES / "drilled" / "two_spans.toml"
PAGE, PICTURES = ROOT / "docs" / "gallery.md", ROOT / "docs" / "pictures" / "gallery"
TIMES = PICTURES / "times.json"
SEEDS = ROOT / "docs" / "data" / "seeds"
"""Runs of examples that differ in nothing but their seed, which `scripts/seeds` measured."""

"""Seconds that each run took, kept so that a page can be written without all of them."""

REALISTIC_PICTURES = PICTURES / "realistic.json"
"""Names of the examples whose pictures are by `pictures.renderer = "realistic"`."""

LOOKS = """\
They are by `pictures.renderer = "realistic"`. Road, banks, figures, machines, dust, chips, bent bars and rough faces
are for looks only: they are no bodies, and change no motion ([what is drawn](run_folder.md#looks-of-pictures))."""

MOMENTS = ("before", "impact", "after")
PICTURE_PX, GAP_PX = (480, 270), 8
QUALITY, MOST_BYTES = 85, 60_000
"""Of a picture in the repository: less quality where it would be larger."""
REALISTIC = """\
[scenario]
based_on = "{example}"

[pictures]
renderer = "realistic"
width_px = {width}
height_px = {height}
"""
PICTURES_ALONE = "--pictures"
TEXTS = Path(__file__).with_name("gallery_texts.toml")
"""What the page says of each example, by its file."""

HEADER = """\
# Gallery

<!-- Made by `scripts/gallery`: change `scripts/gallery_texts.toml` instead. -->

Every example is a [scenario file](scenario.md) to start from. Run it with `bda run examples/NAME.toml --output DIR`.
Add `--report` for a [report](report.md). The pictures show the start, the impact (or the blast, or the largest force)
and the end of one run.
{looks}
[One run is one possible outcome](accuracy.md#one-run-is-one-possible-outcome): the last line has least and largest over
runs that differ in nothing but their seed; *solver* is what Bullet's solver made of the dissipated energy. Times are
the most that a run takes without pictures on two idle cores: for all examples together {minutes} minutes.

First come bridges as they are: with bars, bearings and elastic connections. Plan a demolition with these. Then come
[the demolitions of the 2019 report](#the-2019-report).

{table}

Examples of studies, searches, optimisations and others stand [at the end](#other-examples).
"""

HEADER_2019 = """\
## The 2019 report

Every demolition of the [2019 report](../examples/report_2019/README.md), with its settings or its bare charges. In most
one breaking force holds everything, and some bridges stand only because they sleep until they are hit: these say little
of a bridge of today. A demolition of today is planned with bars, bearings and drilled charges.

{table}

`bda run examples/report_2019/i235_three_spans_*.toml --output DIR --report` runs several examples one after the other
and compares them: here four positions where the ball falls.
"""

STUDY = """\
## A study of the I-235 span

![Plan of the study with its limit, and how many of its runs reach how far](pictures/study_i235_one_span.png)

93 runs of the first of these examples. Shaded is where the probability of debris may be above 5 % and 50 %. All runs
are in [a table](data/ensembles/i235_one_span.csv).

Study: [i235_one_span.toml](../examples/studies/i235_one_span.toml).
"""
"""Section on the example of a study, whose picture `scripts/ensembles` makes."""


def main(arguments: list[str]) -> int:
    """Run examples, write the page and return the exit status."""
    names = [argument for argument in arguments if argument != PICTURES_ALONE]
    found = {name(path): path for path in (*examples(), *examples(REPORT_2019))}
    if missing := [unknown for unknown in names if unknown not in found]:
        print(f"gallery: there is no example {', '.join(missing)}", file=sys.stderr)
        return 2
    wanted = [found[wanted_name] for wanted_name in names or found]
    PICTURES.mkdir(parents=True, exist_ok=True)
    for path in wanted:
        seconds: dict[str, float] = {}
        if PICTURES_ALONE in arguments:
            take_pictures(RUNS / name(path))
        else:
            seconds = {name(path): run(path)}
        side_by_side(RUNS / name(path) / "frames", PICTURES / f"{name(path)}.jpg")
        is_realistic_now(name(path))
        TIMES.write_text(json.dumps(times() | seconds, indent=2, sort_keys=True) + "\n", encoding="utf-8")
    PAGE.write_text(page(), encoding="utf-8", newline="\n")
    return 0


def examples(folder: Path = EXAMPLES) -> list[Path]:
    """Return the examples in a folder, by name: those of bridges as they are, drilled charges first, or of 2019."""
    return [*([DRILLED] if folder == EXAMPLES else []), *sorted(folder.glob("*.toml"))]


def name(path: Path) -> str:
    """Return what the pictures of an example are called."""
    return f"drilled_{path.stem}" if path == DRILLED else path.stem


def link(path: Path) -> str:
    """Return the link from the page to an example."""
    return f"../{path.relative_to(ROOT).as_posix()}"


def run(path: Path) -> float:
    """Run an example with realistic pictures, and return the seconds that it took without these."""
    bda, variant = Path(sys.executable).parent / "bda", RUNS / f"{name(path)}.toml"
    RUNS.mkdir(parents=True, exist_ok=True)
    width, height = PICTURE_PX
    variant.write_text(REALISTIC.format(example=path.as_posix(), width=width, height=height), encoding="utf-8")
    began = time.perf_counter()
    subprocess.run([bda, "run", variant, "--output", RUNS / name(path), "--overwrite"], check=True)
    took = time.perf_counter() - began
    summary = json.loads((RUNS / name(path) / "summary.json").read_text(encoding="utf-8"))
    return round(took - summary["wall_time_s"]["pictures"], 1)


def take_pictures(folder: Path) -> None:
    """Take the pictures of a run again, from the scene and the results in its folder."""
    sys.path.insert(0, str(ROOT))
    import bpy

    from bridge_demolition_addon.model.scenario.file import read_scenario
    from bridge_demolition_addon.scene.rendering.stills import prepare_scene_for_pictures
    from bridge_demolition_addon.simulation.display.pictures import rendered_pictures

    bpy.ops.wm.open_mainfile(filepath=str(folder / "scene.blend"), use_scripts=False)
    scene, (width, height) = bpy.context.scene, PICTURE_PX
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    view = read_scenario(folder / "scenario_as_run.toml").pictures
    view = replace(view, renderer="realistic", width_px=width, height_px=height)
    prepare_scene_for_pictures(scene, view)
    list(rendered_pictures(scene, folder, view, summary["key_frame"]["frame"], scene.frame_end))


def times() -> dict[str, float]:
    """Return the seconds of every run so far, by name."""
    return json.loads(TIMES.read_text(encoding="utf-8")) if TIMES.exists() else {}


def is_realistic_now(example: str) -> None:
    """Note that the pictures of an example are realistic."""
    known = json.loads(REALISTIC_PICTURES.read_text(encoding="utf-8")) if REALISTIC_PICTURES.exists() else []
    REALISTIC_PICTURES.write_text(json.dumps(sorted({*known, example}), indent=2) + "\n", encoding="utf-8")


def side_by_side(folder: Path, target: Path) -> None:
    """Put the pictures of a run beside each other."""
    width, height = PICTURE_PX
    strip = Image.new("RGB", (len(MOMENTS) * (width + GAP_PX) - GAP_PX, height), "white")
    for number, moment in enumerate(MOMENTS):
        with Image.open(folder / f"{moment}.png") as picture:
            fitted = picture.convert("RGB").resize(PICTURE_PX, Image.Resampling.LANCZOS)
        strip.paste(fitted, (number * (width + GAP_PX), 0))
    for quality in range(QUALITY, 0, -5):
        strip.save(target, quality=quality, optimize=True)
        if target.stat().st_size <= MOST_BYTES:
            break


def page() -> str:
    """Return the page, made of the texts on the examples."""
    taken = times()
    header = HEADER.format(looks=looks(), minutes=max(1, round(sum(taken.values()) / 60.0)), table=table(EXAMPLES))
    now, of_2019 = (
        [section(path, taken.get(name(path))) for path in examples(folder)] for folder in (EXAMPLES, REPORT_2019)
    )
    return "\n".join([header, *now, HEADER_2019.format(table=table(REPORT_2019)), *of_2019, STUDY, others()])


def others() -> str:
    """Return what is said of all other examples: variants, studies, searches, stages."""
    shown = {path.relative_to(EXAMPLES).as_posix() for path in (*examples(), *examples(REPORT_2019))}
    sections = []
    for path in (EXAMPLES / file for file in texts() if file not in shown):
        heading = f"### {path.relative_to(ROOT).as_posix()}"
        sections.append(
            "\n\n".join([heading, *paragraphs(path), " ".join([*of_seeds(path), f"[{path.name}]({link(path)})."])])
        )
    return "\n\n".join(["## Other examples", *sections]) + "\n"


def texts() -> dict[str, dict[str, str]]:
    """Return what is said of examples, by their files in the folder of all."""
    return tomllib.loads(TEXTS.read_text(encoding="utf-8"))


def looks() -> str:
    """Return what pictures show for looks only, and which ones are plain instead."""
    realistic = set(json.loads(REALISTIC_PICTURES.read_text(encoding="utf-8")))
    plain = [name(path) for path in (*examples(), *examples(REPORT_2019)) if name(path) not in realistic]
    told = LOOKS if not plain else f"{LOOKS} Those of {', '.join(plain)} are by Workbench, and have none of this."
    return textwrap.fill(told, 120)


def table(folder: Path) -> str:
    """Return a table of the examples in a folder and their times."""
    taken = times()
    rows = [
        f"| [{name(path)}]({link(path)}) | {title(path)} | {rounded(taken[name(path)])} |" for path in examples(folder)
    ]
    return "\n".join(["| example | what it shows | s |", "| --- | --- | --- |", *rows])


def title(path: Path) -> str:
    """Return the title of a scenario."""
    return tomllib.loads(path.read_text(encoding="utf-8"))["scenario"]["title"]


def section(path: Path, seconds: float | None) -> str:
    """Return the section of an example: its title, its pictures, its words and how long it takes."""
    took = "" if seconds is None else f", {rounded(seconds)} s"
    file = f"[{path.name}]({link(path)}){took}."
    picture = f"![{title(path)}](pictures/gallery/{name(path)}.jpg)"
    return "\n\n".join([f"## {title(path)}", picture, *paragraphs(path), " ".join([*of_seeds(path), file])]) + "\n"


def of_seeds(path: Path) -> list[str]:
    """Return how far debris goes, what breaks and what the solver makes in runs of an example, where they were made."""
    table = SEEDS / f"{SEEDED.get(path, '')}.csv"
    if not table.is_file():
        return []
    with table.open(encoding="utf-8", newline="") as file:
        runs = list(csv.DictReader(file))
    most, farthest, broken, made = (
        [float(run[column] or 0.0) for run in runs]
        for column in ("throw_95_percent_m", "largest_throw_m", "broken_connections", "made_share")
    )
    until = f", until {MEASURED_S[SEEDED[path]]:g} s" if SEEDED[path] in MEASURED_S else ""
    return [
        f"*{len(runs)} seeds{until}*: 95 % of the shards within {between(most)}, the farthest {between(farthest)}; "
        f"{min(broken):.0f} to {max(broken):.0f} connections break; solver {shares(made)}."
    ]


def between(distances_m: list[float]) -> str:
    """Return least and largest of some distances, in cm where they are small."""
    factor, unit = (100.0, "cm") if max(distances_m) < SMALL_M else (1.0, "m")
    return f"{factor * min(distances_m):.1f} to {factor * max(distances_m):.1f} {unit}"


def shares(made: list[float]) -> str:
    """Return least and largest of some shares in percent, with a digit after the point where they are small."""
    digits = 1 if max(made) < SMALL_SHARE else 0
    return f"{100.0 * min(made):.{digits}f} to {100.0 * max(made):.{digits}f} %"


def paragraphs(path: Path) -> list[str]:
    """Return the paragraphs on an example."""
    told = texts()[path.relative_to(EXAMPLES).as_posix()]["text"]
    return [paragraph.replace("\n", " ").strip() for paragraph in told.split("\n\n")]


def rounded(seconds: float) -> int:
    """Return seconds to the next 5, as the next run takes a little more or less."""
    return max(5, 5 * round(seconds / 5.0))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
