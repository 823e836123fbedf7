# SPDX-License-Identifier: GPL-3.0-or-later
"""What a study costs over what Blender itself needs, what two jobs win, and what it costs to schedule a draw.

Blender's own time is taken in one process that builds each draw and plays it with nothing recorded: once as Blender
plays it by itself, where pieces that broke apart still pass through each other, and once with only what changes what
comes to pass. A study of the same draws is taken as a user starts it: the command line with its start, that of
Blender, building, recording and writing included. Draws that do nothing show what is left where Blender takes no time.
"""

import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from contextlib import closing, contextmanager, nullcontext
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from bridge_demolition_addon.model.study.draws import draw_of
from bridge_demolition_addon.model.study.file import read_study
from bridge_demolition_addon.studies.draw_process import Limits
from bridge_demolition_addon.studies.folder import StudyFolder
from bridge_demolition_addon.studies.local import LocalProcesses
from bridge_demolition_addon.studies.study_run import StudyRun

ROOT = Path(__file__).resolve().parent.parent

START_FRAME = 1
"""As in `scene.world`, which brings Blender along: here it would count as memory of the parent."""

DRAWS = int(os.environ.get("BENCH_DRAWS", "16"))
NOTHING = int(os.environ.get("BENCH_EMPTY_DRAWS", "1000"))
VERSIONS = {"program": "that does nothing"}
LIMITS = Limits()

DOES_NOTHING = """
import sys
print('bda-draw {"versions": {"program": "that does nothing"}}', flush=True)
for line in sys.stdin:
    print('bda-draw {"status": "done", "outputs": {"reach_m": 1.0}, "fingerprint": {}}', flush=True)
"""
"""A program of draws without anything of ours in it."""


def main() -> None:
    """Print all ratios."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        study = _study_file(folder / "study.toml", DRAWS)
        draws(folder, study)
        scheduling(folder)
        scheduling_on_dask(folder)


def draws(folder: Path, study: Path) -> None:
    """Compare a study of the I-235 span with Blender's own time for the same draws."""
    alone = _times_of(sys.executable, __file__, "alone", study)
    one = _times_of(*_study_command(study, folder / "one", 1))
    same = _times_of(sys.executable, __file__, "same", study)
    two = _times_of(*_study_command(study, folder / "two", 2))
    print(f"{DRAWS} draws of the I-235 span with 200 shards, in seconds of the clock and of the processors")
    for name, (wall_s, processor_s) in {
        "steps as Blender plays them by itself": alone,
        "steps as they come to pass": same,
        "study with one job": one,
        "study with two jobs": two,
    }.items():
        print(f"{name:>40}{wall_s:>8.1f}{processor_s:>8.1f}")
    for name, bare in (("as Blender plays them by itself", alone), ("as they come to pass", same)):
        print(f"study with one job over steps {name}: {one[0] / bare[0]:.2f} and {one[1] / bare[1]:.2f}")
    print(f"two jobs over one: {one[0] / two[0]:.2f} times as fast")


def scheduling(folder: Path) -> None:
    """Time draws that do nothing, here."""
    engine = LocalProcesses(1, LIMITS, [sys.executable, "-c", DOES_NOTHING], VERSIONS)
    seconds = _play(folder / "nothing", engine, NOTHING)
    print(f"scheduling a draw here: {1e3 * seconds / NOTHING:.1f} ms")
    memory_mb = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3
    print(f"most memory of the parent after {NOTHING} draws: {memory_mb:.0f} MB")


def scheduling_on_dask(folder: Path) -> None:
    """Time draws that do nothing, each in a process of its own, on two workers of a cluster on this machine."""
    from distributed import LocalCluster

    from bridge_demolition_addon.studies.dask_cluster import DaskCluster

    count = max(NOTHING // 5, 20)
    with LocalCluster(2, threads_per_worker=1, dashboard_address=None) as cluster:
        command = [sys.executable, "-S", "-c", DOES_NOTHING]
        engine = DaskCluster(cluster.scheduler_address, LIMITS, command, VERSIONS)
        seconds = _play(folder / "dask", engine, count)
    print(f"scheduling a draw on Dask, start of its process included: {1e3 * seconds / count:.1f} ms")


def _play(output: Path, engine, count: int) -> float:
    study = read_study(_study_file(output.with_suffix(".toml"), count))
    with closing(engine), StudyFolder(output, study, engine.versions) as folder:
        run = StudyRun(study, folder, engine)
        began = time.perf_counter()
        while not run.is_finished:
            run.step(1.0)
        seconds = time.perf_counter() - began
        run.write_tables()
        run.write_conclusions()
    return seconds


def _study_command(study: Path, output: Path, jobs: int) -> list[str]:
    module = [sys.executable, "-m", "bridge_demolition_addon"]
    return [*module, "study", str(study), "--output", str(output), "--quiet", "--jobs", str(jobs)]


def _times_of(*command: object) -> tuple[float, float]:
    """Seconds of the clock and of the processors that a command takes, or those that it prints."""
    before, began = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    done = subprocess.run([*map(str, command)], check=True, capture_output=True, text=True, cwd=ROOT)
    seconds, after = time.perf_counter() - began, resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.stdout:
        return tuple(json.loads(done.stdout.splitlines()[-1]))
    return seconds, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def _play_bare(way: str, path: str) -> None:
    """Play all draws of a study with nothing recorded, and print the time of their steps."""
    import bpy

    from bridge_demolition_addon.model.sequence.checked_model import checked_model
    from bridge_demolition_addon.scene.demolition import build_demolition

    study, seconds = read_study(path), np.zeros(2)
    for number in range(1, study.settings.runs + 1):
        scenario = draw_of(study, number).scenario
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        scene = bpy.context.scene
        build_demolition(scene, scenario, checked_model(scenario))
        with _broken_ones_collide(scene) if way == "same" else nullcontext():
            began = np.array((time.perf_counter(), time.process_time()))
            for frame in range(START_FRAME, scene.frame_end + 1):
                scene.frame_set(frame)
            seconds += np.array((time.perf_counter(), time.process_time())) - began
    print(json.dumps(seconds.tolist()), flush=True)
    os._exit(0)  # Blender's own end may hang


@contextmanager
def _broken_ones_collide(scene):
    """Let bodies collide again once nothing connects them, which alone changes what comes to pass."""
    import bpy

    from bridge_demolition_addon.bullet.world import BulletWorld, WorldState
    from bridge_demolition_addon.scene.bodies import bodies_of
    from bridge_demolition_addon.scene.connections.constraints import connections_of

    world = BulletWorld(scene, bodies_of(scene), connections_of(scene))

    def bind(scene, depsgraph) -> None:
        if scene.frame_current == START_FRAME + 1 and world.bind(depsgraph) is WorldState.NEW:
            world.call_around_substeps(lambda _: None, lambda _: world.let_broken_collide(world.intact()))

    bpy.app.handlers.frame_change_post.append(bind)
    yield
    bpy.app.handlers.frame_change_post.remove(bind)
    world.release()


def _study_file(path: Path, runs: int) -> Path:
    scenario = ROOT / "examples" / "i235_one_span.toml"
    settings = f"runs = {runs}\nquantile = 0.5\nconfidence = 0.5\nrank = 1\n"
    vary = '[[vary]]\nkey = "ball.drop_height_m"\ndistribution = "uniform"\nlowest = 4.5\nhighest = 5.5\n'
    path.write_text(f"[study]\nscenario = {str(scenario)!r}\n{settings}\n{vary}", encoding="utf-8")
    return path


if __name__ == "__main__":
    if sys.argv[1:]:
        _play_bare(*sys.argv[1:])
    else:
        main()
