# SPDX-License-Identifier: GPL-3.0-or-later
"""Bridge Demolition Add-on: plan the demolition of a bridge with Blender's rigid bodies.

For Python there are the functions of `__all__`, which cover a job and stay as they are. They do what the command line
does, and raise `DemolitionError` with a sentence where a file or a value is wrong. Blender is loaded by `run` alone.
With the small bridge of ``docs/small_bridge.toml``:

>>> import bridge_demolition_addon as bda
>>> scenario = bda.read_scenario("docs/small_bridge.toml")
>>> results = bda.run(scenario, "my_results")
>>> results.frames.positions_m.shape == (len(results.frames), len(results.inventory.body_names), 3)
True
>>> bool(bda.load_results("my_results").frames.time_s[-1] == results.frames.time_s[-1])
True
"""

from __future__ import annotations

from collections.abc import Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

from .errors import DemolitionError
from .version import VERSION

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from .model.debris.throws import Debris
    from .model.ensemble.folder import EnsembleResult, EnsembleRuns
    from .model.results.arrays import Results
    from .model.scenario import Scenario

__all__ = [
    "DemolitionError",
    "__version__",
    "check",
    "debris",
    "debris_plan",
    "export",
    "force_chart",
    "load_results",
    "load_study",
    "read_scenario",
    "run",
    "run_study",
    "write_report",
    "write_scenario",
]

__version__ = VERSION


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


def write_scenario(scenario: Scenario, path: str | PathLike[str]) -> None:
    """Write a scenario with all its values to a TOML file, in place of what is there; reading it gives an equal one.

    Examples
    --------
    >>> scenario = read_scenario("docs/small_bridge.toml")
    >>> write_scenario(scenario, "copy.toml")
    >>> read_scenario("copy.toml") == scenario
    True
    """
    from .model.scenario.file import scenario_text
    from .system.disk import write_whole_text, writing

    with writing(Path(path)):
        write_whole_text(Path(path), scenario_text(scenario))


def check(scenario: Scenario, *, stand: bool = False) -> list[str]:
    """Return what ``bda check`` prints: what follows from a scenario, without running it.

    With `stand` it says how the bridge stands under its own weight, as with elastic connections, also where they are
    rigid.

    Examples
    --------
    >>> for line in check(read_scenario("docs/small_bridge.toml")):
    ...     if "impact speed" in line:
    ...         print(line)
      impact speed            2.43 m/s
    """
    from .cli.check import scenario_facts

    return list(scenario_facts(scenario, stand=stand))


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


def debris(results: Results) -> Debris:
    """Return the debris at the end of a run: its shards, with throws, masses and distances from the bridge's plan.

    Examples
    --------
    >>> pile = debris(load_results("my_results"))
    >>> len(pile.throws_m) == len(pile.masses_kg) == len(pile.bodies)
    True
    """
    from .model.debris.throws import debris_of

    return debris_of(results)


def force_chart(results: Results, title: str = "") -> Figure:
    """Draw the largest force on a shard, and how many connections are intact, over time.

    Examples
    --------
    >>> force_chart(load_results("my_results"), "Small bridge").savefig("forces.png")
    """
    from .charts.histories import forces_figure

    return forces_figure(results, title, None)


def debris_plan(results: Results, scenario: Scenario | None = None) -> Figure:
    """Draw where debris lies in plan, with the bridge before and the largest throws; with a scenario, also its zones.

    Examples
    --------
    >>> debris_plan(load_results("my_results")).savefig("plan.png")
    """
    from .charts.plan_maps import debris_figure

    return debris_figure(results, debris(results), () if scenario is None else scenario.zones)


def write_report(
    folder: str | PathLike[str] | Sequence[str | PathLike[str]],
    output: str | PathLike[str] | None = None,
    *,
    language: str | None = None,
    units: str | None = None,
) -> list[Path]:
    """Write the report of a run, study, search, optimisation or stages from its folder, and return the files.

    The first file is the page. Several folders of runs are compared, in the folder `output`. By default the report goes
    into the folder of the results. `language` is ``en``, ``de``, ``es``, ``fr`` or ``zh_hans``, and `units` ``metric``
    or ``imperial``; without them those that the scenario asks for count, else English and metric.

    Examples
    --------
    >>> write_report("my_results")[0].name
    'report.html'
    """
    from .cli.progress import Silence
    from .report.write import write_report as write

    folders = [folder] if isinstance(folder, str | PathLike) else folder
    target = None if output is None else Path(output)
    return write([Path(one) for one in folders], target, language=language, units=units, progress=Silence())


def export(folder: str | PathLike[str], to: str, output: str | PathLike[str] | None = None) -> Path:
    """Write a run for another program, and return the file or folder, which must be new.

    `to` is one of ``paraview``, ``xlsx``, ``gltf``, ``usd``, ``alembic`` and ``mat``, as ``bda export --to``. By
    default it is written into the folder of the run.

    Examples
    --------
    >>> export("my_results", "gltf").name
    'export.glb'
    """
    from .cli.progress import Silence
    from .errors import OutputError
    from .exports.formats import FORMATS, new_export
    from .exports.write import export_run

    if to not in FORMATS:
        raise OutputError(f"to is {to!r}: expected one of {', '.join(FORMATS)}")
    target = new_export(Path(folder), FORMATS[to]) if output is None else Path(output)
    export_run(Path(folder), FORMATS[to], target, Silence())
    return target


def run_study(file: str | PathLike[str], output: str | PathLike[str], *, jobs: int | None = None) -> EnsembleResult:
    """Make all runs of a study, a search or an optimisation, each in a process of its own, and return their result.

    `jobs` run at a time, by default as many as there are cores. A folder that holds some of the runs is gone on with.
    A study gives its conclusions, a search its answer, an optimisation the best candidate.

    Examples
    --------
    >>> result = run_study("docs/small_study.toml", "my_study", jobs=2)
    >>> result.reach.runs, result.reach.is_known
    (2, True)
    """
    from .model.ensemble.folder import ensemble_of_file
    from .studies.engine import LocalProcesses, cores
    from .studies.run_process import RunLimits
    from .studies.session import EnsembleSession

    ensemble = ensemble_of_file(Path(file))
    engine = LocalProcesses(jobs or cores(), RunLimits.of(ensemble.settings))
    return EnsembleSession(ensemble, Path(output), engine).complete()


def load_study(folder: str | PathLike[str]) -> EnsembleRuns:
    """Read a study, a search or an optimisation with its runs so far; `EnsembleRuns.result` gives what they state.

    Examples
    --------
    >>> runs = load_study("my_study")
    >>> runs.table.numbers.tolist(), runs.table.done.tolist()
    ([1, 2], [True, True])
    >>> runs.result().reach.limit_m == max(runs.table.largest("reach_m").tolist())
    True
    """
    from .model.ensemble.folder import read_ensemble

    return read_ensemble(Path(folder))


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
    from .ui import key_figures, registration, scene_settings, sections
    from .ui.comparison import shown as other_run
    from .ui.contours import decorator
    from .ui.ensemble import study
    from .ui.ground import decorator as ground_decorator
    from .ui.languages import tables
    from .ui.preview import bars, run_beside
    from .ui.preview import decorator as preview_decorator
    from .ui.scenario import hints

    drawn = (other_run, decorator, key_figures, ground_decorator, sections, study)
    drawings = (module.drawing for module in (*drawn, preview_decorator, bars, run_beside))
    return (blender_events, tables, scene_settings, registration, run_beside, hints, *drawings)
