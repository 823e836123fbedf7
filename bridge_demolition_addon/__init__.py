# SPDX-License-Identifier: GPL-3.0-or-later
"""Bridge Demolition Add-on: plan the demolition of a bridge with Blender's rigid bodies.

For Python there are three functions, which stay as they are: `read_scenario`, `run` and `load_results`. Blender is
loaded by `run` alone. With the small bridge of ``docs/small_bridge.toml``:

>>> from bridge_demolition_addon import load_results, read_scenario, run
>>> scenario = read_scenario("docs/small_bridge.toml")
>>> results = run(scenario, "my_results")
>>> results.frames.positions_m.shape == (len(results.frames), len(results.inventory.body_names), 3)
True
>>> bool(load_results("my_results").frames.time_s[-1] == results.frames.time_s[-1])
True
"""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .model.results.arrays import Results
    from .model.scenario import Scenario

__all__ = ["load_results", "read_scenario", "run"]


def read_scenario(path: str | PathLike[str]) -> Scenario:
    """Read a scenario from its TOML file, and check it.

    Its frozen dataclasses are named as the tables and keys of the file; `dataclasses.replace` varies them.

    Examples
    --------
    >>> from dataclasses import replace
    >>> scenario = read_scenario("docs/small_bridge.toml")
    >>> scenario.ball.mass_kg
    5000.0
    >>> heavier = replace(scenario, ball=replace(scenario.ball, mass_kg=8000.0))
    """
    from .model.scenario.file import read_scenario as read

    return read(path)


def run(scenario: Scenario, output: str | PathLike[str], *, overwrite: bool = False, pictures: bool = False) -> Results:
    """Run a scenario with Blender in this process, and leave what ``bda run`` leaves in a folder, which is made.

    Inside Blender's window this replaces the file that is open. `overwrite` replaces results of an earlier run in the
    folder, `pictures` renders pictures. Returned is what `load_results` reads.
    """
    from .cli.progress import Silence
    from .simulation.run import run_scenario

    run_scenario(scenario, Path(output), overwrite=overwrite, pictures=pictures, progress=Silence())
    return load_results(output)


def load_results(folder: str | PathLike[str]) -> Results:
    """Read what a run recorded, also one that was killed, from its folder or its file ``results.npz``.

    The parts ``inventory``, ``frames`` and ``balls`` hold numpy arrays; `Results.arrays` gives all by their names in
    the file. Large ones are read when they are looked at.
    """
    from .model.results.arrays import load_results as load

    return load(Path(folder))


def register() -> None:
    """Called by Blender when the extension is switched on."""
    for module in _interface():
        module.register()


def unregister() -> None:
    """Called by Blender when the extension is switched off: takes back all that `register` and the buttons did."""
    for module in reversed(_interface()):
        module.unregister()


def _interface() -> tuple:
    # The engineering and the checks of the command line work where there is no Blender to import.
    from .simulation import blender_events
    from .ui import registration, scene_settings
    from .ui.contours import decorator
    from .ui.ensemble import study
    from .ui.ground import decorator as ground_decorator
    from .ui.preview import bars
    from .ui.preview import decorator as preview_decorator

    drawings = (module.drawing for module in (decorator, ground_decorator, study, preview_decorator, bars))
    return (blender_events, scene_settings, registration, *drawings)
