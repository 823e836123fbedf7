"""``bda run``: run scenarios, and keep the results of each in a folder."""

import argparse
import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, nullcontext
from pathlib import Path

from ..engineering.unit_systems import UnitSystem
from ..engineering.units import kilonewtons
from ..errors import Faults, OutputError
from ..model.reinforcement.concrete_members import plain_concrete_text
from ..model.results.arrays import SHORT
from ..model.results.moving import creep_text
from ..model.run_folder.files import RESULT_FILES, remove_report
from ..model.run_folder.folder import check_folder, numbered_folder
from ..model.run_folder.summary import RunSummary
from ..model.scenario import Scenario
from ..model.scenario.file import read_scenario
from ..model.schema import given
from ..model.sequence.checked_model import checked_model
from ..model.sequence.ending import doubts_of_run, first_doubts, unusable_texts
from ..model.structure.model import Model
from ..report.languages.translation import ENGLISH, Translation
from ..system.progress import Progress
from ..texts import Quantity, Text, distance_to_keep
from .arguments import add_report_options, naming
from .console import simulation_module
from .progress import progress_on

COMPARISON = "comparison"
"""Name of the folder of several runs, counted up, where none is given."""

COMPARISON_FOLDER = "report"
"""Where in the folder of a comparison its report is."""


def add_to(commands: argparse._SubParsersAction) -> None:
    """Add the command to the command line."""
    parser = commands.add_parser(
        "run",
        description="Of one scenario, the results are kept in DIR. Several are a comparison: they are run in order, "
        "and the results of each are kept in a folder in DIR that is called like its file. Without --output, DIR is a "
        "new folder here, called like the scenario and counted up.",
        allow_abbrev=False,
    )
    parser.add_argument("scenarios", metavar="SCENARIO.toml", nargs="+", help="scenario file, see docs/scenario.md")
    parser.add_argument("--output", metavar="DIR", type=Path, help="folder for the results, made if new (here)")
    parser.add_argument("--overwrite", action="store_true", help="replace the results of an earlier run in that folder")
    parser.add_argument("--no-pictures", action="store_true", help="render no pictures")
    parser.add_argument(
        "--film",
        action="store_true",
        help="make films with contours of force, contours.mp4 and contours_slow_motion.mp4; it takes minutes",
    )
    parser.add_argument(
        "--report",
        action="store_true",
        help=f"make a report of each run at its end, and one that compares all of them, in DIR/{COMPARISON_FOLDER}",
    )
    add_report_options(parser)
    parser.add_argument(
        "--quiet", action="store_true", help="print nothing but errors, and that a run is not to be used"
    )
    parser.set_defaults(execute=run)


def run(arguments: argparse.Namespace) -> None:
    """Run the scenarios, show how far they are, and print where the results are."""
    scenarios = _scenarios(arguments.scenarios)
    if arguments.output is None:
        title = scenarios[0].title if len(scenarios) == 1 else COMPARISON
        arguments.output = numbered_folder(Path(), title)
    progress = progress_on(sys.stdout, quiet=arguments.quiet)
    try:
        with _blender_silenced() if arguments.quiet else nullcontext():
            if len(scenarios) == 1:
                _run_and_report(arguments.scenarios[0], scenarios[0], None, arguments.output, arguments, progress)
            else:
                _run_comparison(scenarios, arguments, progress)
    finally:
        progress.finish()


def _scenarios(paths: Sequence[str]) -> list[Scenario]:
    """Read scenarios, or raise all their faults."""
    scenarios, faults = [], Faults()
    for path in paths:
        with faults.noted():
            scenarios.append(read_scenario(path))
    faults.check()
    return scenarios


def _run_comparison(scenarios: Sequence[Scenario], arguments: argparse.Namespace, progress: Progress) -> None:
    """Run scenarios one after the other, none of them if any has to be refused, and compare them if wanted."""
    comparison = arguments.output / COMPARISON_FOLDER
    folders = comparison_folders(arguments.scenarios, arguments.output)
    if arguments.report and comparison in folders:
        raise OutputError(f"{comparison}: is the folder of the report; call its scenario something else")
    progress.stage(f"checking {len(scenarios)} scenarios")
    for folder in [*folders, comparison] if arguments.report else folders:
        check_folder(folder, overwrite=arguments.overwrite)
    models = []
    for path, scenario in zip(arguments.scenarios, scenarios, strict=True):
        with naming(path):
            models.append(checked_model(scenario))
    if arguments.overwrite:
        remove_report(comparison)  # it would be that of earlier runs
    plan = zip(arguments.scenarios, scenarios, models, folders, strict=True)
    for number, (path, scenario, model, folder) in enumerate(plan, 1):
        progress.stage(f"scenario {number} of {len(scenarios)}: {path}")
        _run_and_report(path, scenario, model, folder, arguments, progress)
    if arguments.report:
        progress.stage(f"comparing {len(scenarios)} runs")
        written = _report(folders, comparison, arguments, progress)
        if not arguments.quiet:
            progress.finish()
            _print_paths(written)


def comparison_folders(scenarios: Sequence[str], output: Path) -> list[Path]:
    """Return the folders of the runs of several scenario files, called like these."""
    files: dict[str, str] = {}
    for file in scenarios:
        name = Path(file).stem
        if other := files.get(name.casefold()):
            raise OutputError(
                f"{other} and {file}: the results of both would go to {output / name}; "
                "call one of the files something else"
            )
        files[name.casefold()] = file
    return [output / Path(file).stem for file in scenarios]


def _run_and_report(
    path: str, scenario: Scenario, model: Model | None, output: Path, arguments: argparse.Namespace, progress: Progress
) -> None:
    plain = plain_concrete_text(scenario)
    is_rendered = arguments.film or not arguments.no_pictures
    with naming(path):
        values = simulation_module("run", one_thread=not is_rendered).run_scenario(
            scenario,
            output,
            model=model,
            overwrite=arguments.overwrite,
            pictures=not arguments.no_pictures,
            film=arguments.film,
            progress=progress,
        )
    summary = RunSummary.of(values)
    report = _report([output], None, arguments, progress) if arguments.report else []
    if arguments.quiet:
        for text in unusable_texts(summary):
            print(f"bda: {path}: {text}", file=sys.stderr, flush=True)
    else:
        progress.finish()
        system = UnitSystem(arguments.units or scenario.report.units or UnitSystem.METRIC)
        _print_results(summary, output, report, plain, Translation.into(ENGLISH, system))


def run_with_everything(scenario: Scenario, output: Path, progress: Progress, *, quiet: bool) -> RunSummary:
    """Run a scenario in place of what is in a folder, keep all but films, and return its summary."""
    with _blender_silenced() if quiet else nullcontext():
        run_scenario = simulation_module("run").run_scenario
        return RunSummary.of(run_scenario(scenario, output, overwrite=True, pictures=True, progress=progress))


@contextmanager
def _blender_silenced() -> Iterator[None]:
    """Drop what is written to standard output, also past Python: Blender names each file that it saves."""
    sys.stdout.flush()
    standard_output = os.dup(1)
    with open(os.devnull, "wb") as nowhere:
        os.dup2(nowhere.fileno(), 1)
    try:
        yield
    finally:
        sys.stdout.flush()  # Blender writes part of it through Python
        os.dup2(standard_output, 1)
        os.close(standard_output)


def _report(
    folders: Sequence[Path], output: Path | None, arguments: argparse.Namespace, progress: Progress
) -> list[Path]:
    from ..report.write import write_report

    return write_report(folders, output, language=arguments.language, units=arguments.units, progress=progress)


def _print_results(
    summary: RunSummary, output: Path, report: Sequence[Path], plain: str, translation: Translation
) -> None:
    print()
    first = first_doubts(summary)
    others = doubts_of_run(summary)[len(first) :]
    for doubt in (*first, plain, *(summary.stability.texts if summary.stability else ()), *others):
        if doubt:
            print(f"{translation.text(doubt)}.\n")
    for name, value in _result_facts(summary):
        print(f"{name:<24}{translation.text(value)}")
    results = [output / name for name in RESULT_FILES]
    _print_paths([*(path for path in results if path.exists() and path not in report), *report])


def _print_paths(paths: Sequence[Path]) -> None:
    """Print paths after an empty line, one on each."""
    print()
    for path in paths:
        print(path)


def _result_facts(summary: RunSummary) -> Iterator[tuple[str, str]]:
    if not summary.only_motion_because:
        yield "connections", summary.counts.text
    if bars := summary.reinforcement:
        yield "reinforcement", bars.text
    if force := summary.largest_resultant:
        largest = Quantity(kilonewtons(force.force_n), "kN")
        position = f"the resultant on {force.body} at {force.time_s:.3f} s"
        yield "largest load on a shard", Text("{}, {}", largest, position)
    if impact := summary.impact:
        yield "impact of the ball", f"{summary.first_hit_s:.3f} s, frame {impact.frame}"
    creeping = creep_text(summary.creeping)
    if summary.came_to_rest_s is not None:
        but_for = ", but for what creeps" if creeping else ""
        yield "everything rests from", f"{summary.came_to_rest_s:.3f} s{but_for}"
    if creeping:
        yield "creeping", creeping
    if moving := summary.moving_at_end:
        yield (
            "still moving",
            Text(
                "{} of {} shards, at up to {}",
                moving.shards,
                moving.of_shards,
                Quantity(moving.fastest_m_s, "m/s", ".1f"),
            ),
        )
    if throw := summary.largest_throw:
        so_far = ", not final: shards still moved" if moving else ""
        yield "largest throw", Text("{}, {}{}", distance_to_keep(throw.throw_m, ".2f"), throw.body, so_far)
    if energy := summary.energy:
        made = energy.made_by_solver
        share = f"{made.share_of_dissipated:.1%} of the dissipated energy"
        if by_bars_j := energy.dissipated_by_bars_j:
            works = (Quantity(work_j / 1000.0, "kJ", ".1f") for work_j in (by_bars_j, energy.dissipated_j))
            yield "work of bars", Text("{} of {} dissipated", *works)
        yield "energy made by solver", Text("{}, {}", Quantity(made.j / 1000.0, "kJ", ".1f"), share)
        if doubtful := energy.doubtful_throws:
            yield "doubtful throws", f"{doubtful} shards, marked in debris_log.csv and summary.json"
    parts = (f"{name.replace('_', ' ')} {seconds:.1f}" for name, seconds in given(summary.wall_time_s).items())
    yield "wall time in s", ", ".join(parts)
    fingerprint = given(summary.fingerprint)
    yield "fingerprint", f"built {fingerprint['built'][:SHORT]}, result {fingerprint['result'][:SHORT]}"
