# SPDX-License-Identifier: GPL-3.0-or-later
"""Set up a study in its panel, play the timeline while it runs, pause it, look at its map, and run its worst draw."""

import json
import math
import re
import subprocess
from pathlib import Path

import bpy
import numpy as np
from habits import build, delete_all, play_or_pause
from panels import Panels
from person import Person, Steps, region_of
from pulse import Pulse, judge
from traces import module, recording_runs, rows, something_goes_on

RUNS, QUANTILE, CONFIDENCE, RANK = 24, 0.5, 0.9, 1
"""Enough runs to pause them in the middle."""
HEIGHT_KEY, LOWEST_M, HIGHEST_M = "ball.drop_height_m", 2.0, 8.0

RUNS_PANEL, VARY_PANEL = 0, 1
"""Their places among the sub-panels."""

CHECK_BOX_PX = 23
"""From the left of the sidebar to the check boxes of keys that may be left out."""

STUDY_S = 300.0
"""A study of a small bridge ends in this time, on a busy machine too."""
PAUSE_S = 4.0
"""Longer than a draw takes: what was not begun before is seen not to begin."""

LIMIT_RGB = (255, 51, 51)
NEARLY = 40
"""Between the colour of a line as it is meant, and as it is seen at its smoothed edges."""
LINE_PIXELS = 500
"""Fewer than a line has that goes around a bridge in the middle of the view."""


def steps(person: Person) -> Steps:
    yield from person.open_sidebar()
    panels = Panels(person)
    yield from delete_all(person)
    yield from panels.widen(160)
    yield from build(person)
    person.expect_reports("nothing but the building is reported", "Deleted 3 object", "30 shards")
    yield from panels.show_only("Study")
    person.expect("nothing to pause yet", "No study is at work" in person.refusal("bda.pause_study"), True)
    yield from person.picture("panel_at_first")
    yield from begin_small(person, panels)
    yield from set_up(person, panels)
    yield from run_beside_the_work(person)
    yield from look_at_the_findings(person)
    yield from run_the_worst_draw(person, panels)
    yield from quit_in_the_middle(person, panels)


def begin_small(person: Person, panels: Panels) -> Steps:
    """Two runs, without a folder: too few for a limit, which is said; then one more in the folder that was made."""
    work = module("ui.ensemble.study").WORK
    yield from panels.toggle_inner(RUNS_PANEL, "bda.start_study")
    for runs in (2, 3):
        yield from person.fill_in("runs", f"{runs}")
        yield from person.click("bda.start_study")
        yield from person.wait_for(f"a study of {runs} runs begins", lambda: work.session is not None, 20.0)
        yield from person.wait_for("it ends", lambda: work.session is None, STUDY_S)
        yield 1.0
        person.expect("nothing went wrong", work.why_ended, "")
        person.expect(f"{runs} runs are there", len(rows(Path(person.scene.bda.study_directory) / "runs.csv")), runs)
        said = " ".join(work.result.sentences)
        person.expect(f"{runs} are too few, which is said", "Too few runs for a limit yet" in said)
    yield from person.picture("three_runs")
    yield from panels.toggle_inner(RUNS_PANEL, "bda.start_study")
    person.take_reports()


def set_up(person: Person, panels: Panels) -> Steps:
    """A folder; how many runs; and one key that varies."""
    study = person.scene.bda.study
    yield from person.fill_in("study_directory", str(folder(person)))
    yield from panels.toggle_inner(RUNS_PANEL, "bda.start_study")
    for name, value in (("runs", RUNS), ("quantile", QUANTILE), ("confidence", CONFIDENCE), ("rank", RANK)):
        yield from person.fill_in(name, f"{value:g}")
    yield from person.picture("runs_and_limit")
    found = (study.runs, study.quantile, study.confidence, study.rank)
    person.expect("runs and limit are as typed", np.allclose(found, (RUNS, QUANTILE, CONFIDENCE, RANK), rtol=1e-6))
    yield from panels.toggle_inner(RUNS_PANEL, "bda.start_study")

    yield from panels.toggle_inner(VARY_PANEL, "bda.start_study")
    yield from person.click("bda.add_table")
    yield 0.5
    yield from person.picture("empty_table")
    yield from person.hover("highest")  # scrolls, as the lower edge of the sidebar may cut the first field
    yield from person.click("key")
    yield from person.replace_text(HEIGHT_KEY)
    yield 1.0  # Blender looks for what it proposes
    yield from person.press("RET")
    yield from person.click("distribution")
    yield 0.3
    yield from person.picture("distributions")
    yield from person.press("U", "u")  # the letter that is underlined
    yield 0.3
    for name, value in (("lowest", LOWEST_M), ("highest", HIGHEST_M)):
        yield from person.hover(name)
        yield from person.move(person.sidebar.x + CHECK_BOX_PX, person.mouse[1])
        yield from person.press("LEFTMOUSE")
        yield from person.fill_in(name, f"{value:g}")
    yield from person.picture("what_varies")
    vary = study.vary[0]
    person.expect("the key is as typed", (len(study.vary), vary.key), (1, HEIGHT_KEY))
    person.expect("its distribution is as chosen", vary.distribution, "uniform")
    person.expect("its ends are as typed", np.allclose((vary.lowest, vary.highest), (LOWEST_M, HIGHEST_M), rtol=1e-6))
    yield from panels.toggle_inner(VARY_PANEL, "bda.start_study")
    person.expect_reports("nothing is reported")


def run_beside_the_work(person: Person) -> Steps:
    """Start; play the timeline; Pause; Resume; and wait for the end."""
    work = module("ui.ensemble.study").WORK
    yield from person.click("bda.start_study")
    person.expect_reports("nothing but the start is reported", f"The study runs in {folder(person)}")
    run = work.session
    person.expect("a second one is refused", "at work already" in person.refusal("bda.start_study"), True)
    yield from person.hover("bda.pause_study")
    pause_at = person.mouse
    yield from person.picture("started")
    yield from play_or_pause(person)
    pulse, frames, played_from = Pulse(), set(), run.planner.done
    for _ in range(round(STUDY_S / 0.1)):
        frames.add(person.scene.frame_current)
        if run.planner.done > played_from + 1 and len(frames) > 1:
            break
        yield 0.1
    for x, y in ((pause_at[0] - 1, pause_at[1]), pause_at):
        yield from person.move(x, y)
    yield from person.press("LEFTMOUSE")  # Pause is where it was before the time left came
    yield 0.3
    yield from person.picture("paused")
    person.expect("Pause pauses", run.is_paused, True)
    yield PAUSE_S
    paused_at = run.planner.done
    person.expect("there is something left to do", paused_at < RUNS, True)
    yield PAUSE_S
    person.expect("no run ends while it is paused", run.planner.done, paused_at)
    person.expect("runs have ended while the timeline played", paused_at > played_from and len(frames) > 1, True)
    yield from person.click("bda.resume_study")
    yield from person.wait_for("it goes on", lambda: run.planner.done > paused_at, STUDY_S)
    person.expect("the timeline plays all the time", person.playing, True)
    yield from person.picture("at_work")
    pulse.stop()
    yield from play_or_pause(person)
    for what, waits in pulse.waits().items():
        judge(person, what, waits)
    yield from person.wait_for("the study ends", lambda: work.session is None, STUDY_S)
    yield 1.0
    yield from person.picture("ended")
    person.expect("nothing went wrong", work.why_ended, "")
    table = rows(folder(person) / "runs.csv")
    person.expect("all runs are in the table", [row["run"] for row in table], [str(n) for n in range(1, RUNS + 1)])
    person.expect("all are done", {row["status"] for row in table}, {"done"})
    heights = {float(row[f"in.{HEIGHT_KEY}"]) for row in table}
    person.expect("each has another height", len(heights), RUNS)
    person.expect("all of them as typed", min(heights) >= LOWEST_M and max(heights) <= HIGHEST_M)
    person.expect_reports("nothing is reported of its end")


def look_at_the_findings(person: Person) -> Steps:
    """The sentence, in a panel that is open by itself, the map on the ground, and the limit around the bridge."""
    yield from person.move_to_view()
    for _ in range(2):  # away from the bridge
        yield from person.press("WHEELDOWNMOUSE")
    yield from person.hover("show_study")  # below all sentences
    yield from person.move_to_view()
    yield from person.illustrate("study_panel", person.view)
    shown = module("ui.ensemble.study").WORK.result
    farthest = max(float(row["out.reach_m"]) for row in rows(folder(person) / "runs.csv"))
    said = re.search(r"debris stayed within ([\d.]+) m", shown.sentences[0])
    # Of rank 1 is the largest; sentences round up.
    person.expect("it says the largest reach", said and float(said[1]), math.ceil(farthest * 10.0 - 1e-9) / 10.0)
    person.expect("everything can be drawn", module("ui.ensemble.study").drawing.error, "")
    with_study = pixels(person)
    yield from person.click("show_study")
    yield from person.move_to_view()
    yield from person.picture("study_hidden")
    without = pixels(person)
    line, still_red = of_limit(with_study), of_limit(without)  # an axis of the view is as red
    person.expect("the limit is seen as a red line", int((line & ~still_red).sum()) > LINE_PIXELS)
    person.expect("and not when it is not shown", int((still_red & ~line).sum()), 0)
    changed = np.abs(with_study.astype(int) - without).max(axis=2) > NEARLY
    person.expect("the map is seen, and not when it is not shown", int((changed & ~line).sum()) > LINE_PIXELS)
    yield from person.click("show_study")


def run_the_worst_draw(person: Person, panels: Panels) -> Steps:
    """Open Worst Draw builds it; run, it is the same to the last bit."""
    yield from person.click("bda.open_worst_draw")
    yield 1.0
    yield from person.move_to_view()
    yield from person.picture("worst_draw")
    worst = max(rows(folder(person) / "runs.csv"), key=lambda row: float(row["out.reach_m"]))
    person.expect_reports("the worst draw is reported", f"Run {worst['run']}, whose debris distance is")
    height = person.scene.bda.scenario.ball.drop_height_m
    person.expect("the panels show its height", math.isclose(height, float(worst[f"in.{HEIGHT_KEY}"]), rel_tol=1e-6))
    yield from panels.show_only("Run")
    results = person.folder / "worst"
    yield from person.fill_in("output_directory", str(results))
    yield from person.click("bda.run")
    yield from person.wait_for("it runs", recording_runs, 10.0)
    yield from person.wait_for("it runs to its end", lambda: not something_goes_on(), 120.0)
    yield 1.0
    yield from person.picture("worst_draw_run")
    person.expect_reports(
        "what moves and the results are reported",
        "still move at the end",
        "Results are in",
        "Pictures of the run are in",
    )
    expected = next(
        kept["fingerprint"]
        for kept in map(read_json, folder(person).glob("draws/*/outcome.json"))
        if kept["inputs"]["scenario.seed"] == int(worst["in.scenario.seed"])
    )
    found = read_json(results / "summary.json")["fingerprint"]
    person.expect("it moves as in the study, to the last bit", {name: found[name] for name in expected}, expected)


def quit_in_the_middle(person: Person, panels: Panels) -> Steps:
    """A study is at work when Blender quits, which ends it and does not wait."""
    yield from panels.show_only("Study")
    yield from person.fill_in("study_directory", str(person.folder / "left"))
    yield from person.click("bda.start_study")
    person.expect_reports("a second study starts", "The study runs in")
    yield 3.0


def folder(person: Person) -> Path:
    return person.folder / "study"


def read_json(file: Path) -> dict:
    return json.loads(file.read_text(encoding="utf-8"))


def pixels(person: Person) -> np.ndarray:
    """What is seen of the 3D view left of its sidebar (height, width, 3)."""
    region: bpy.types.Region = region_of(person.view, "WINDOW")
    width, height = person.sidebar.x - region.x, region.height
    top = person.window.height - region.y - height
    crop = ("-crop", f"{width}x{height}+{region.x}+{top}", "+repage", "-depth", "8")
    screen = subprocess.run(["import", "-window", "root", *crop, "rgb:-"], check=True, capture_output=True)
    return np.frombuffer(screen.stdout, dtype=np.uint8).reshape(height, width, 3)


def of_limit(seen: np.ndarray) -> np.ndarray:
    """Which pixels have the colour of the limit (height, width)."""
    return np.abs(seen.astype(int) - LIMIT_RGB).max(axis=2) < NEARLY
