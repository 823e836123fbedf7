# SPDX-License-Identifier: GPL-3.0-or-later
"""What the frames of a run take: in the window of a job, and by `main` in a Blender without one."""

import importlib
import json
import time
from pathlib import Path
from types import ModuleType

FRAMES = 24
"""In which the first zones of the example fire."""
_NOT_COUNTED = 2
"""First frames, in which Blender makes its world."""


class FrameTimes:
    """Times of all frames that are played from now on; work by the thread that plays, s.

    What others do on the machine takes no part in it, nor does drawing, which the window does between two frames.
    """

    def __init__(self, playback: ModuleType):
        self.work_s: list[float] = []
        step = playback.Playing.step

        def timed(playing: object) -> None:
            before = time.thread_time()
            step(playing)
            self.work_s.append(time.thread_time() - before)

        playback.Playing.step = timed

    @property
    def counted_s(self) -> list[float]:
        """Those that are compared."""
        return self.work_s[_NOT_COUNTED:FRAMES]


def main(scenario: str, folder: str) -> None:
    """Run the first frames of a scenario as the command line does, and leave their times in a file of the folder."""
    package = "bridge_demolition_addon"
    file, run, playback, progress = (
        importlib.import_module(f"{package}.{name}")
        for name in ("model.scenario.file", "simulation.run", "simulation.playback", "system.progress")
    )

    class FirstFrames(progress.Progress):
        def frame(self, done: int, *_: object) -> None:
            self.is_stopped = done >= FRAMES

    times = FrameTimes(playback)
    of_run = file.read_scenario(Path(scenario))
    run.run_scenario(of_run, Path(folder, "run"), overwrite=False, pictures=False, progress=FirstFrames())
    Path(folder, "times.json").write_text(json.dumps(times.counted_s), encoding="utf-8")
