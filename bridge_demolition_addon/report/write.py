"""Write the report of a run, or of several: a page, a PDF, tables and site plans."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

import numpy as np
from manifold3d import CrossSection

from ..engineering.terrain.contour_lines import contour_lines
from ..errors import OutputError, text_of
from ..model.debris.exclusion import ExclusionZone
from ..model.debris.throws import debris_of
from ..model.results.files import DXF_FILE, GEOJSON_FILE, REPORT_PAGE, REPORT_PDF, TABLE_FOLDER
from ..model.scenario import Site
from ..model.scenario.file import scenario_text
from ..model.sequence.checked_model import checked_model
from ..model.stages.made_elastic import made_elastic
from ..model.stages.stages import criticality, stages_of
from ..model.stages.standing import StandingBridge
from ..model.stages.tables import write_tables as write_stage_tables
from ..model.study.files import PLAN_DXF, PLAN_GEOJSON, REPORT_FOLDER
from ..system.folder_lock import FolderLock
from ..system.progress import Progress
from .comparison import comparison
from .document.blocks import DataTable, Document, Listing, Section, write_tables
from .document.drawings import drawings
from .document.html import write_html
from .document.pdf import write_pdf
from .ensemble.influence import correlation_table
from .ensemble.plan import layers
from .ensemble.search import search_section
from .ensemble.search_folder import is_search, read_found_search
from .ensemble.study import study_document
from .ensemble.study_folder import is_study, read_study_runs
from .run_folder import Run, holds_run, read_run, shown_name
from .sections.blast import blast_section
from .sections.collapse import collapse_section
from .sections.cover import ONE_RUN, cover_section, scenario_section, trust_section
from .sections.debris import corner_table, debris_section, exclusion_section, terrain_section, zone_of
from .sections.forces import force_section, logged_section
from .sections.ground_motion import motion_section
from .sections.model import model_section
from .sections.stages import has_stages, stages_section
from .sections.touchdown import touchdown_section
from .site_plan import write_dxf, write_geojson

_MANIFESTS = tuple(Path(__file__).parents[level] / "blender_manifest.toml" for level in (1, 2))
"""Of an extension inside Blender, and of the project's own folder."""


def write_report(
    folders: Sequence[Path],
    output: Path | None,
    *,
    trajectories: bool = False,
    stages: bool = False,
    progress: Progress,
) -> list[Path]:
    """Write the report of a run, or the comparison of several; of a study, a search, or stages.

    Parameters
    ----------
    folders
        One folder or more.
    output
        Where the report goes, made if it is new; by default into the folder of the run, if it is only one.
    trajectories
        Whether the map of the debris shows the paths of the shards.
    stages
        Whether the stages of the run's scenario are worked out first, so that the report has a chapter on them. Their
        tables go to where the report goes.
    progress
        Shows stages, pictures and pages.

    Returns
    -------
    list of Path
        All files written.

    Raises
    ------
    ScenarioError
        The scenario's stages cannot be worked out.
    OutputError
        A folder holds no run, several runs are to be compared without a folder for it, something cannot be written, or
        a run or another report is being written to the folder.
    """
    if output is None and len(folders) > 1:
        raise OutputError("several runs are compared in a folder of their own: give one with --output")
    if stages and len(folders) > 1:
        raise OutputError("--stages is for the report of one run: leave it out where several are compared")
    if studies := [folder for folder in folders if is_study(folder)]:
        if len(folders) > 1:
            raise OutputError(f"{studies[0]}: is the folder of a study, whose report is made by itself")
        _check_no_stages(folders[0], stages, "study")
        return write_study_report(folders[0], output, progress=progress)
    if len(folders) == 1 and is_search(folders[0]):
        _check_no_stages(folders[0], stages, "search")
        return _write_search(folders[0], output, progress)
    if len(folders) == 1 and has_stages(folders[0]) and not holds_run(folders[0]):
        _check_no_stages(folders[0], stages, "set of stages")
        return _write_stages_alone(folders[0], output, progress)
    progress.stage("reading the results" if len(folders) == 1 else f"reading the results of {len(folders)} runs")
    runs = [read_run(folder) for folder in folders]
    target = folders[0] if output is None else output
    with _written_to(target):
        if len(runs) > 1:
            return _written(comparison(runs, add_on_version()), target, progress)
        if stages:
            _work_out_stages(runs[0], target, progress)
        return _write_one(runs[0], target, trajectories, progress)


def write_study_report(folder: Path, output: Path | None = None, *, progress: Progress) -> list[Path]:
    """Write the report of a study.

    Parameters
    ----------
    folder
        Of the study.
    output
        Where the report goes, made if it is new; by default into a folder of its own in that of the study.
    progress
        Shows stages, pictures and pages.

    Returns
    -------
    list of Path
        All files written.

    Raises
    ------
    OutputError
        The folder holds no run of a study, something cannot be written, or another report is being written there.
    """
    progress.stage("reading the runs of the study")
    runs = read_study_runs(folder)
    target = folder / REPORT_FOLDER if output is None else output
    with _written_to(target):
        progress.stage("evaluating the runs")
        plans = _write_areas(layers(runs), runs.study.scenario.site, target / PLAN_DXF, target / PLAN_GEOJSON)
        document = study_document(runs, add_on_version(), [path.name for path in plans])
        return [*_written(document, target, progress, correlation_table(runs)), *plans]


@contextmanager
def _written_to(target: Path) -> Iterator[None]:
    """Have a folder to write a report to, and say so where that fails."""
    try:
        target.mkdir(parents=True, exist_ok=True)
        with FolderLock(target):
            yield
    except OSError as error:
        read = isinstance(error, FileNotFoundError) and not Path(error.filename or target).is_relative_to(target)
        cleared = ": a folder was cleared meanwhile, as by a run that has begun in it; make the report again"
        raise OutputError(
            f"{target}: the report cannot be written ({text_of(error)}){cleared if read else ''}"
        ) from error


def add_on_version() -> str:
    """Return the version of this program."""
    try:
        return version("bridge-demolition-addon")
    except PackageNotFoundError:  # an extension inside Blender, or a plain copy
        found = [path for path in _MANIFESTS if path.is_file()]
        return str(tomllib.loads(found[0].read_text(encoding="utf-8"))["version"]) if found else "unknown"


def document_of(
    run: Run,
    version: str,
    zone: ExclusionZone | None,
    plans: Sequence[str] = (),
    *,
    trajectories: bool = False,
    stages: Path | None = None,
) -> Document:
    """Return the report of a run.

    Parameters
    ----------
    run
        The run.
    version
        That of this program.
    zone
        Its exclusion zone.
    plans
        Names of the files that have the zone for the site plan.
    trajectories
        Whether the map of the debris shows the paths of the shards.
    stages
        Folder with the tables of stages, if there is one.
    """
    debris = None if run.results is None else debris_of(run.results)
    sections = [cover_section(run, version, debris), trust_section(run.scenario, ONE_RUN)]
    if run.results is not None and len(run.results.inventory.of_kind("shard")):
        sections.append(model_section(run.results))
        if (terrain := terrain_section(run)) is not None:
            sections.append(terrain)
        sections.append(debris_section(run, debris, trajectories=trajectories))
        sections.append(exclusion_section(zone, run, plans))
        sections.append(force_section(run))
        sections.append(collapse_section(run))
        if run.scenario and (blast := blast_section(run.scenario, debris.outline, debris.ground)):
            sections.append(blast)
        if run.scenario and (touchdown := touchdown_section(run.results, run.scenario.neighbours)):
            sections.append(touchdown)
        if motion := motion_section(run):
            sections.append(motion)
    elif run.results is None:
        sections.append(logged_section(run))
    if stages is not None:
        sections.append(stages_section(stages))
    if run.scenario:
        sections.append(scenario_section(run, scenario_text(run.scenario)))
    subtitle = f"Report of a simulated demolition. Bridge Demolition Add-on {version}"
    return Document(run.title, subtitle, tuple(sections))


def _write_one(run: Run, target: Path, trajectories: bool, progress: Progress) -> list[Path]:
    progress.stage("evaluating debris, zones, forces and energy")
    zone = zone_of(run)
    plans = [] if zone is None else _write_plans(zone, run, target)
    stages = next((folder for folder in (target, run.folder) if has_stages(folder)), None)
    names = [path.name for path in plans]
    document = document_of(run, add_on_version(), zone, names, trajectories=trajectories, stages=stages)
    only_as_file = [] if zone is None else [corner_table(zone)]
    return [*_written(document, target, progress, *only_as_file), *plans]


def _write_search(folder: Path, output: Path | None, progress: Progress) -> list[Path]:
    progress.stage("reading the trials of the search")
    found, version = read_found_search(folder), add_on_version()
    target = folder / REPORT_FOLDER if output is None else output
    scenario = found.search.study.scenario
    sections = (search_section(found), Section("Search file", (Listing(found.search.text),)))
    document = Document(
        scenario.title, f"Report of a search in a simulated demolition. Bridge Demolition Add-on {version}", sections
    )
    with _written_to(target):
        return _written(document, target, progress)


def _write_stages_alone(folder: Path, output: Path | None, progress: Progress) -> list[Path]:
    target = folder if output is None else output
    subtitle = f"Report of the stages of a demolition. Bridge Demolition Add-on {add_on_version()}"
    document = Document(shown_name(folder), subtitle, (stages_section(folder),))
    with _written_to(target):
        return _written(document, target, progress)


def _check_no_stages(folder: Path, stages: bool, what: str) -> None:
    if stages:
        raise OutputError(f"{folder}: --stages is for the report of a run, and this is the folder of a {what}")


def _work_out_stages(run: Run, target: Path, progress: Progress) -> None:
    """Write the tables of the stages of a run's scenario."""
    if run.scenario is None:
        raise OutputError(f"{run.folder}: has no scenario whose stages could be worked out; leave out --stages")
    progress.stage("working out the stages")
    bridge = StandingBridge(checked_model(made_elastic(run.scenario)), run.scenario.joints)
    found = stages_of(run.scenario, bridge, lambda done, total: progress.part(done, total, "stages"))
    members = criticality(bridge, lambda done, total: progress.part(done, total, "members taken away"))
    write_stage_tables(target, found, members, bridge)


def _write_plans(zone: ExclusionZone, run: Run, target: Path) -> list[Path]:
    areas = {
        "exclusion zone": zone.whole,
        "predicted debris": zone.debris,
        "designed drop": zone.drop,
        "bridge": zone.plan,
    }
    contours = _contours_around(run, zone)
    return _write_areas(areas, run.scenario.site, target / DXF_FILE, target / GEOJSON_FILE, contours)


def _contours_around(run: Run, zone: ExclusionZone) -> np.ndarray | None:
    """Contour lines (s, 2, 3) of the ground in and around an exclusion zone, m; None where the ground is flat."""
    terrain = run.results.ground().terrain
    if terrain is None:
        return None
    low, high = np.array(zone.bounds_m).reshape(2, 2)
    room, corners = (high - low) / 2.0, terrain.mesh.corners
    plan = corners[:, :, :2]
    near = (plan.max(axis=1) >= low - room).all(axis=1) & (plan.min(axis=1) <= high + room).all(axis=1)
    return contour_lines(corners[near])


def _write_areas(
    areas: Mapping[str, CrossSection],
    site: Site | None,
    dxf: Path,
    geojson: Path,
    contours_m: np.ndarray | None = None,
) -> list[Path]:
    """Write areas for a site plan, and return the files; in degrees only where the site is known."""
    write_dxf(dxf, areas, contours_m)
    if site is None:
        return [dxf]
    write_geojson(geojson, areas, site)
    return [dxf, geojson]


def _written(document: Document, target: Path, progress: Progress, *only_as_file: DataTable) -> list[Path]:
    progress.stage("drawing the pictures")
    drawn = drawings(document, lambda done, total: progress.part(done, total, "pictures drawn"))
    progress.stage(f"writing {REPORT_PAGE}")
    write_html(document, drawn, target / REPORT_PAGE)
    progress.stage(f"writing {REPORT_PDF}")
    write_pdf(document, drawn, target / REPORT_PDF, lambda done, total: progress.part(done, total, "pages written"))
    tables = target / TABLE_FOLDER
    tables.mkdir(exist_ok=True)
    written = write_tables([*document.named_tables(), *only_as_file], tables)
    return [target / REPORT_PAGE, target / REPORT_PDF, *written]
