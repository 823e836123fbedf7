# SPDX-License-Identifier: GPL-3.0-or-later
"""What contours cost in a frame, next to Blender's bare step and to the way of 2019, in the same run.

The deck of bench_recording.py, 1000 awake shards, plays the same frames from the start: bare; recorded; recorded with
contours; and in the way of 2019, which gives each body one of 200 materials in every frame. What contours cost is the
frame with them less the frame without, and their own code is timed by itself.
"""

import statistics
import sys
import tempfile
import time
from contextlib import contextmanager
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import bench_recording as bench
import bpy

from bridge_demolition_addon.display.contour_quantities import ContourQuantity
from bridge_demolition_addon.display.contour_ranges import ContourSettings
from bridge_demolition_addon.simulation.blender_events import contours_of

ROUNDS = 3


def main() -> None:
    """Build the deck, play it every way in turn, and print medians and ratios."""
    scene = bench._deck_scene()
    print(f"{len(scene.rigidbody_world.collection.objects)} bodies")
    painting: list[float] = []
    with tempfile.TemporaryDirectory() as folder:
        ways = {
            "bare step": bench._bare,
            "recorded": lambda: bench._recording(scene, Path(folder), every_substep=True),
            "with contours": lambda: _contours(scene, Path(folder)),
            "way of 2019": lambda: bench._way_of_2019(Path(folder) / "forces.log"),
        }
        seconds: dict[str, list[float]] = {name: [] for name in ways}
        for _ in range(ROUNDS):
            for name, way in ways.items():
                with way():
                    bench._make_world(scene)
                    seconds[name].append(bench._frame_seconds(scene))
                    if name == "with contours":
                        painting.append(_painting_seconds(scene))
    medians = {name: statistics.median(each) for name, each in seconds.items()}
    bare = medians["bare step"]
    for name, frame in medians.items():
        print(f"{name:>14}{1e3 * frame:>9.1f} ms a frame{frame / bare - 1.0:>9.1%} over bare step")
    difference = medians["with contours"] - medians["recorded"]
    own = statistics.median(painting)
    print(
        f"contours add {difference / bare:.1%} of a bare step; painting by itself takes {1e3 * own:.1f} ms, "
        f"{own / bare:.1%}"
    )


@contextmanager
def _contours(scene: bpy.types.Scene, folder: Path):
    with bench._recording(scene, folder, every_substep=True) as recording:
        contours_of(scene).show(ContourSettings(quantity=ContourQuantity.VON_MISES))
        yield recording
        if error := contours_of(scene).error:
            raise error
        contours_of(scene).hide()


def _painting_seconds(scene: bpy.types.Scene) -> float:
    """Time to paint the current frame."""
    began = time.perf_counter()
    contours_of(scene).refresh()
    return time.perf_counter() - began


if __name__ == "__main__":
    main()
