"""The report of a run: page, tables and site plans."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ..engineering.terrain.raster import contour_lines
from ..errors import OutputError
from ..model.debris.throws import debris_of
from ..model.debris.zones import ExclusionZone
from ..model.results.moving import still_moving_note
from ..model.results.stability import ZoneLoad
from ..model.run_folder.files import DXF_FILE, GEOJSON_FILE
from ..model.scenario.file import scenario_text
from ..model.sequence.checked_model import checked_model
from ..model.stages.misfires import misfires
from ..model.stages.stages import criticality, stages_of
from ..model.stages.standing import StandingBridge, made_elastic
from ..model.stages.tables import write_tables as write_stage_tables
from ..system.progress import Progress
from ..texts import Text
from ..version import VERSION
from .document.blocks import Document, Report, Section
from .run_folder import ReportedRun
from .sections.blast import blast_section
from .sections.charge_plan import charge_plan_section, flyrock_of, known_plan
from .sections.collapse import collapse_section
from .sections.control import document_control
from .sections.cover import (
    ONE_RUN,
    RUN_TITLE,
    findings_section,
    model_section,
    run_section,
    scenario_section,
    trust_section,
)
from .sections.debris import corner_table, debris_section, exclusion_section, terrain_section, zone_of
from .sections.forces import force_section, logged_section
from .sections.ground_motion import motion_section, touchdown_section
from .sections.loads import load_section, pull_section
from .sections.plan_contents import with_plan_contents
from .sections.planned_sequence import sequence_section
from .sections.programme import programme_section
from .sections.reinforcement import reinforcement_section, tendon_section
from .sections.stages import has_stages, stages_section
from .sections.summary import first_photo, run_summary
from .single_pages import single_pages
from .site_plan import areas_of_fragments, cordon_area, write_areas


def run_report(
    run: ReportedRun, target: Path, progress: Progress, *, trajectories: bool = False, stages: bool = False
) -> Report:
    """Return the report of a run, and write its site plans.

    `trajectories` draws the paths of the shards on the map of debris; `stages` works out the stages of its scenario
    first, for a chapter on them.
    """
    if stages:
        _work_out_stages(run, target, progress)
    progress.stage("evaluating debris, zones, forces and energy")
    zone = zone_of(run)
    plans = [] if zone is None else _write_plans(zone, run, target)
    with_stages = next((folder for folder in (target, run.folder) if has_stages(folder)), None)
    names = [path.name for path in plans]
    document = run_document(run, VERSION, zone, names, trajectories=trajectories, stages=with_stages)
    tables = () if zone is None else (corner_table(zone),)
    return Report(document, tables, tuple(plans), single_pages(document, run.scenario), run.report_settings)


def run_document(
    run: ReportedRun,
    version: str,
    zone: ExclusionZone | None,
    plans: Sequence[str] = (),
    *,
    trajectories: bool = False,
    stages: Path | None = None,
) -> Document:
    """Return the page of a run.

    `plans` are names of the files with the zone for the site plan; `stages` is the folder with tables of stages, if
    any.
    """
    debris = None if run.results is None else debris_of(run.results)
    plan = known_plan(run.scenario)
    flyrock = flyrock_of(plan)
    sections: list[Section] = []
    if run.results is not None and debris is not None and len(run.results.inventory.of_kind("shard")):
        others = {name: path for name, path in run.pictures.items() if name != first_photo(run)}
        sections.append(findings_section(run, debris, others, flyrock))
        if run.scenario:
            sections.append(sequence_section(run.scenario))
            if (programme := programme_section(run.scenario)) is not None:
                sections.append(programme)
        sections.append(model_section(run.results))
        if (terrain := terrain_section(run)) is not None:
            sections.append(terrain)
        sections.append(debris_section(run, debris, trajectories=trajectories))
        sections.append(exclusion_section(zone, run, plans))
        sections.append(force_section(run))
        sections.append(collapse_section(run))
        if run.scenario and (blast := blast_section(run.scenario, debris.outline, debris.ground)):
            sections.append(blast)
        if run.scenario and (charges := charge_plan_section(run.scenario, plan, _zone_loads(run))):
            sections.append(charges)
        if run.scenario and (touchdown := touchdown_section(run.results, run.scenario)):
            sections.append(touchdown)
        if motion := motion_section(run):
            sections.append(motion)
    elif run.results is None:
        sections.append(logged_section(run))
    if (tendons := tendon_section(run)) is not None:
        sections.append(tendons)
    if (loads := load_section(run)) is not None:
        sections.append(loads)
    if (pulls := pull_section(run)) is not None:
        sections.append(pulls)
    if stages is not None:
        sections.append(stages_section(stages))
    if run.scenario and (reinforcement := reinforcement_section(run.scenario)):
        sections.append(reinforcement)
    sections += [run_section(run, version), trust_section(run.scenario, ONE_RUN)]
    if run.scenario:
        sections.append(scenario_section(run, scenario_text(run.scenario)))
    subtitle = Text("Report of a simulated demolition. Bridge Demolition Add-on {}", version)
    fingerprint = run.summary.fingerprint if run.summary else None
    control = document_control(run.scenario, fingerprint)
    document = Document(run.title, subtitle, tuple(sections), run_summary(run, debris, flyrock), control)
    return with_plan_contents(document, run.scenario, RUN_TITLE)


def _zone_loads(run: ReportedRun) -> Sequence[ZoneLoad]:
    """Return what blast zones carried at rest, where the run knew."""
    return run.summary.stability.zones if run.summary and run.summary.stability else ()


def _work_out_stages(run: ReportedRun, target: Path, progress: Progress) -> None:
    """Write the tables of the stages of a run's scenario."""
    if run.scenario is None:
        raise OutputError(f"{run.folder}: has no scenario whose stages could be worked out; leave out --stages")
    progress.stage("working out the stages")
    bridge = StandingBridge(checked_model(made_elastic(run.scenario)), run.scenario.joints)
    worked_out = stages_of(run.scenario, bridge, lambda done, total: progress.part(done, total, "stages"))
    members = criticality(bridge, lambda done, total: progress.part(done, total, "members taken away"))
    failures = misfires(run.scenario, bridge, lambda done, total: progress.part(done, total, "zones that fail"))
    write_stage_tables(target, worked_out, members, bridge, failures)


def _write_plans(zone: ExclusionZone, run: ReportedRun, target: Path) -> list[Path]:
    around = areas_of_fragments(run.scenario) | cordon_area(run.planned, zone.plan)
    areas = around | {
        "exclusion zone of one run": zone.whole,
        "debris of one run": zone.debris,
        "designed drop": zone.drop,
        "bridge": zone.plan,
    }
    contours = _contours_around(run, zone)
    note = still_moving_note(run.recorded)
    return write_areas(areas, run.planned.site, target / DXF_FILE, target / GEOJSON_FILE, contours, note)


def _contours_around(run: ReportedRun, zone: ExclusionZone) -> np.ndarray | None:
    """Contour lines (s, 2, 3) of the ground in and around an exclusion zone, m; None where the ground is flat."""
    terrain = run.recorded.ground().terrain
    if terrain is None:
        return None
    low, high = np.array(zone.bounds_m).reshape(2, 2)
    room, corners = (high - low) / 2.0, terrain.mesh.corners
    plan = corners[:, :, :2]
    near = (plan.max(axis=1) >= low - room).all(axis=1) & (plan.min(axis=1) <= high + room).all(axis=1)
    return contour_lines(corners[near])
