# SPDX-License-Identifier: GPL-3.0-or-later
"""What contours cost in a frame, next to Blender's bare step and to the way of 2019, in the same run.

The deck in 1000 shards plays the same frames from the start: bare; recorded; recorded with contours; and in the way of
2019, which gives each body one of 200 materials in every frame. What contours cost is the frame with them less the
frame without, and their own code is timed by itself.
"""

import statistics
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path

import bpy
from benches.deck import DECK, SMALLEST, build_scene, deck, frame_s, make_world, recorded
from benches.way_of_2019 import forces_and_colours

from bridge_demolition_addon.display.contour_quantities import ContourQuantity
from bridge_demolition_addon.display.contours import ContourSettings
from bridge_demolition_addon.simulation.blender_events import contours_of

FRAMES, ROUNDS = 5, 3


def main(smallest: bool) -> None:
    """Build the deck, play it every way in turn, and print medians and ratios."""
    scene = build_scene(deck(SMALLEST) if smallest else DECK)
    print(f"{len(scene.rigidbody_world.collection.objects)} bodies")
    painting: list[float] = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        ways = {
            "bare step": nullcontext,
            "recorded": lambda: recorded(scene, folder, in_window=True),
            "with contours": lambda: _contours(scene, folder),
            "way of 2019": lambda: forces_and_colours(folder / "forces.log"),
        }
        seconds: dict[str, list[float]] = {name: [] for name in ways}
        for _ in range(1 if smallest else ROUNDS):
            for name, way in ways.items():
                with way():
                    make_world(scene)
                    seconds[name].append(frame_s(scene, FRAMES))
                    if name == "with contours":
                        painting.append(_painting_seconds(scene))
    medians = {name: statistics.median(times) for name, times in seconds.items()}
    bare = medians["bare step"]
    for name, frame in medians.items():
        print(f"{name:>14}{1e3 * frame:>9.1f} ms a frame{frame / bare - 1.0:>9.1%} over bare step")
    difference, own = medians["with contours"] - medians["recorded"], statistics.median(painting)
    print(
        f"contours add {difference / bare:.1%} of a bare step; painting by itself takes {1e3 * own:.1f} ms, "
        f"{own / bare:.1%}"
    )


@contextmanager
def _contours(scene: bpy.types.Scene, folder: Path) -> Iterator[None]:
    with recorded(scene, folder, in_window=True):
        contours_of(scene).show(ContourSettings(quantity=ContourQuantity.VON_MISES))
        yield
        if error := contours_of(scene).error:
            raise error
        contours_of(scene).hide()


def _painting_seconds(scene: bpy.types.Scene) -> float:
    """Time to paint the current frame."""
    began = time.perf_counter()
    contours_of(scene).refresh()
    return time.perf_counter() - began
