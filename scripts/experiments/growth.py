# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure how time and memory of a run grow with the number of shards, and draw it for scripts/benches/README.md.

The I-235 span is cut into more and more shards, connected where they share a face, awake from the start and as strong
as large models are by default. Each number has a process of its own, which prints one row of the CSV. All times are CPU
time, which other programs disturb least. With elastic connections they are a hundred times as strong, so that all of
them stand. Usage: growth.py measure [elastic] | draw
"""

import csv
import os
import resource
import subprocess
import sys
import tempfile
import time
from dataclasses import asdict, dataclass, fields, replace
from pathlib import Path

from bridge_demolition_addon.model.scenario.connections import MATERIAL_OF_LARGE_MODELS
from bridge_demolition_addon.model.scenario.file import read_scenario

ROOT = Path(__file__).resolve().parents[2]
EXAMPLE = ROOT / "examples" / "report_2019" / "i235_one_span.toml"
DATA = ROOT / "docs" / "data" / "growth.csv"
ELASTIC_DATA = DATA.with_name("growth_elastic.csv")
PICTURE = ROOT / "docs" / "pictures" / "growth.png"
SHARDS = (1000, 2000, 5000, 10_000)
FRAMES = 8


@dataclass(frozen=True, slots=True)
class Growth:
    """What one number of shards takes: CPU time in s, memory in MB.

    Attributes
    ----------
    model_s, scene_s
        Cutting the bridge and finding its connections; making them objects of Blender.
    blender_start_s
        Blender's first look at all objects, and the frame in which it makes its world of bodies.
    recording_start_s
        What recording takes before and in that frame, to look at all of them and find them in memory.
    blender_frame_s, recording_frame_s
        A frame simulated, in the mean: Blender's part and that of recording.
    results_s
        Summary, results and the saved scene.
    blender_mb, peak_mb
        Memory once Blender has made its world; the most that the process ever had.
    """

    shards: int
    connections: int
    model_s: float
    scene_s: float
    blender_start_s: float
    recording_start_s: float
    blender_frame_s: float
    recording_frame_s: float
    results_s: float
    blender_mb: float
    peak_mb: float


def growth_of(shards: int, *, is_elastic: bool = False) -> Growth:
    """Build, simulate and save the bridge in so many shards, in this process."""
    import bpy

    from bridge_demolition_addon.model.sequence.checked_model import checked_model
    from bridge_demolition_addon.scene.demolition import build_demolition
    from bridge_demolition_addon.scene.world import keep_played_frames
    from bridge_demolition_addon.simulation.kept_run import keep_results
    from bridge_demolition_addon.simulation.playback import Playing
    from bridge_demolition_addon.simulation.recording.recorder import Recording
    from bridge_demolition_addon.simulation.run_summary import RunContext, run_summary

    scenario = _scenario(shards, is_elastic)
    watch = _Watch()
    model = checked_model(scenario)
    model_s = watch.lap()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    build_demolition(scene, scenario, model)
    scene_s = watch.lap()
    bpy.context.view_layer.update()
    first_look_s = watch.lap()
    with tempfile.TemporaryDirectory() as folder:
        context = RunContext.of(scene, scenario.title, scenario)
        recording = Recording(scene, Path(folder))
        playing = Playing(recording)
        checks_s = watch.lap()
        playing.step()
        world_s, world_share = watch.lap(), recording.seconds / playing.seconds
        blender_mb, before = _memory_mb(), (playing.seconds, recording.seconds)
        while not playing.finished:
            playing.step()
        frames = playing.total - 1
        share = (recording.seconds - before[1]) / (playing.seconds - before[0])
        frame_s = watch.lap() / frames
        playing.end()
        results = recording.results()
        keep_results(Path(folder), results, run_summary(recording, results, context, completed=True))
        keep_played_frames(scene)
        bpy.ops.wm.save_as_mainfile(filepath=str(Path(folder) / "scene.blend"), check_existing=False, compress=True)
        results_s = watch.lap()
    return Growth(
        shards=shards,
        connections=len(model.connections),
        model_s=model_s,
        scene_s=scene_s,
        blender_start_s=first_look_s + world_s * (1.0 - world_share),
        recording_start_s=checks_s + world_s * world_share,
        blender_frame_s=frame_s * (1.0 - share),
        recording_frame_s=frame_s * share,
        results_s=results_s,
        blender_mb=blender_mb,
        peak_mb=resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0,
    )


def measure(path: Path, *way: str) -> None:
    """Measure all numbers of shards, each in a process of its own, and write the CSV."""
    path.parent.mkdir(exist_ok=True)
    rows = []
    for shards in SHARDS:
        command = [sys.executable, str(Path(__file__).resolve()), "one", str(shards), *way]
        rows.append(subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()[-1])
        print(rows[-1], flush=True)
        names = ",".join(item.name for item in fields(Growth))
        path.write_text("\n".join((names, *rows, "")), encoding="utf-8")


def read_growth(path: Path) -> list[Growth]:
    """Read the rows of the CSV."""
    with path.open(encoding="utf-8") as file:
        return [Growth(**{name: float(value) for name, value in row.items()}) for row in csv.DictReader(file)]


def draw(rows: list[Growth], path: Path) -> None:
    """Draw time, next to that of Blender's own frame with the fewest shards, and memory."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(9.0, 4.6), dpi=150, layout="constrained")
    times, memory = figure.subplots(1, 2)
    shards = [row.shards for row in rows]
    lines = {
        "start of Blender's world": [row.blender_start_s for row in rows],
        "start of recording": [row.recording_start_s for row in rows],
        "cutting and connecting": [row.model_s for row in rows],
        "making objects": [row.scene_s for row in rows],
        "results and scene": [row.results_s for row in rows],
        "24 frames, Blender": [24.0 * row.blender_frame_s for row in rows],
        "24 frames, recording": [24.0 * row.recording_frame_s for row in rows],
    }
    unit = 24.0 * rows[0].blender_frame_s
    for number, (label, seconds) in enumerate(lines.items()):
        style = "s--" if "Blender" in label else "o-"
        times.loglog(
            shards, [second / unit for second in seconds], style, label=label, color=f"C{number}", markersize=4
        )
    times.set_ylabel("time, Blender's second with 1,000 shards = 1")
    figure.legend(*times.get_legend_handles_labels(), loc="outside lower center", ncols=4, frameon=False, fontsize=8)
    memory.plot(shards, [row.peak_mb / 1000.0 for row in rows], "o-", color="#b5402a", label="most of the whole run")
    memory.plot(
        shards, [row.blender_mb / 1000.0 for row in rows], "s--", color="#2a5db5", label="once Blender's world is made"
    )
    memory.set_ylabel("memory, GB")
    memory.set_ylim(bottom=0.0)
    memory.legend(frameon=False, fontsize=8)
    for axes in (times, memory):
        axes.set_xlabel("shards")
        ticks = shards if axes is times else range(0, int(max(shards)) + 1, 2000)
        axes.set_xticks(ticks, [f"{tick:,.0f}" for tick in ticks])
        axes.minorticks_off()
        axes.grid(color="0.9")
        axes.spines[["top", "right"]].set_visible(False)
    figure.savefig(path)


class _Watch:
    """CPU time of this process between one look and the next."""

    def __init__(self):
        self._last_s = time.process_time()

    def lap(self) -> float:
        now = time.process_time()
        passed, self._last_s = now - self._last_s, now
        return passed


def _scenario(shards: int, is_elastic: bool):
    example = read_scenario(EXAMPLE)
    return replace(
        example,
        time=replace(example.time, duration_s=FRAMES / example.time.frames_per_second),
        fracture=replace(example.fracture, shards=shards),
        connections=replace(
            example.connections,
            type="FIXED",
            method="face",
            search_radius_m=None,
            breaking_force_kgf=None,
            material=MATERIAL_OF_LARGE_MODELS,
            stiffness="elastic" if is_elastic else "rigid",
            strength_factor=100.0 if is_elastic else 1.0,
        ),
        shards=replace(example.shards, start_deactivated=False, use_deactivation=False),
        ball=None,
    )


def _memory_mb() -> float:
    pages = int(Path("/proc/self/statm").read_text(encoding="utf-8").split()[1])
    return pages * resource.getpagesize() / 1e6


def main(arguments: list[str]) -> None:
    """Do as asked."""
    match arguments:
        case ["one", shards, *way]:
            row = asdict(growth_of(int(shards), is_elastic=way == ["elastic"]))
            print(",".join(f"{value:.4g}" if isinstance(value, float) else str(value) for value in row.values()))
            sys.stdout.flush()
            os._exit(0)  # Blender's own end takes longer than the run
        case ["measure"]:
            measure(DATA)
        case ["measure", "elastic"]:
            measure(ELASTIC_DATA, "elastic")
        case ["draw"]:
            draw(read_growth(DATA), PICTURE)
        case _:
            sys.exit("usage: growth.py measure [elastic] | draw")


if __name__ == "__main__":
    main(sys.argv[1:])
