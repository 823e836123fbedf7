"""Names of the files in the folder of a run, and of its report's files, which the next report replaces.

A report leaves a list of its files. Folders of before have none: there, files have the names that reports had.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path, PurePosixPath

from ...errors import OutputError, UnreadableError
from ...system.disk import write_whole_text
from ...system.reading import MEGABYTE, file_text
from ..results.arrays import BALLS_FILE, CONTACTS_FILE, FRAMES_FILE, INVENTORY_FILE, RESULTS_FILE

SUMMARY_FILE = "summary.json"
FORCE_LOG, DEBRIS_LOG = "force_log.csv", "debris_log.csv"
BREAKING_LOG, EXPLOSION_LOG = "breaking_log.csv", "explosion_log.csv"
BEARING_LOG, BAR_LOG = "bearing_log.csv", "bar_log.csv"
GROUND_MOTION_FILE = "ground_motion.csv"
FORCE_CHART = "force_over_time.png"
BLEND_FILE = "scene.blend"

SCENARIO_FILE = "scenario_as_run.toml"
"""The scenario of the run. Not ``scenario.toml``, which may be the user's own, with comments in it."""

PICTURE_FOLDER = "frames"
PICTURES = BEFORE, IMPACT, AFTER = "before", "impact", "after"
"""Pictures in that folder, PNG."""

FILM_FILE, SLOW_FILM_FILE = "contours.mp4", "contours_slow_motion.mp4"

REPORT_PAGE, REPORT_PDF, REPORT_WORD = "report.html", "report.pdf", "report.docx"
SINGLE_PAGES = {audience: f"page_for_{audience}.pdf" for audience in ("client", "authority", "crew")}
"""Single pages of a report, by whom they are for."""

DXF_FILE, GEOJSON_FILE = "exclusion_zone_of_one_run.dxf", "exclusion_zone_of_one_run.geojson"
TABLE_FOLDER = "tables"
PLAN_WORKBOOK = "charge_plan.xlsx"
CHARGES_DXF, CHARGES_GEOJSON = "charge_plan.dxf", "charge_plan.geojson"

REPORT_FILES = (REPORT_PAGE, REPORT_PDF, *SINGLE_PAGES.values(), DXF_FILE, GEOJSON_FILE)
"""What a report leaves, without its tables. Word files stay, as blanks of theirs are filled in by hand."""

REPORT_LIST = "report_files.txt"
"""Which files a report left in its folder, a line each."""

RESULT_FILES = (
    SUMMARY_FILE,
    FORCE_LOG,
    DEBRIS_LOG,
    BREAKING_LOG,
    EXPLOSION_LOG,
    BEARING_LOG,
    BAR_LOG,
    GROUND_MOTION_FILE,
    RESULTS_FILE,
    FRAMES_FILE,
    BALLS_FILE,
    CONTACTS_FILE,
    INVENTORY_FILE,
    FORCE_CHART,
    BLEND_FILE,
    *(f"{PICTURE_FOLDER}/{name}.png" for name in PICTURES),
    FILM_FILE,
    SLOW_FILM_FILE,
    SCENARIO_FILE,
    *REPORT_FILES,
)
"""All that a run and its report can leave, in the order in which they are listed."""

SURVEY_FOLDER = "survey"
"""Of the report of a survey of the debris beside the run."""


_EARLIER_TABLES = """
bearing_forces.csv bearing_moments.csv bearings.csv breaking.csv candidates.csv charge_neighbours.csv
charge_per_delay.csv charge_table.csv charge_totals.csv charges.csv chosen_candidate.csv collapse.csv comparison.csv
cracked_connections.csv criteria.csv criticality.csv damage_rings.csv debris.csv debris_on_surfaces.csv
drill_holes.csv energy.csv exclusion_corners.csv exclusion_corners_of_one_run.csv exclusion_zone.csv
exclusion_zone_corners.csv exclusion_zone_of_one_run.csv farthest_draws.csv findings.csv firing_sequence.csv
fragment_limits.csv fragments.csv ground_motion_peaks.csv hits_of_the_ball.csv largest_throws.csv lifts.csv
limits_at_once.csv median_and_worst.csv misfires.csv most_loaded_connections.csv most_loaded_shards.csv
neighbours.csv neighbours_of_runs.csv optimisation.csv plan.csv plan_contents.csv pulls.csv rank_correlations.csv
reaction_forces.csv reaction_moments.csv reinforcement.csv run.csv runs.csv search.csv sequence.csv settlements.csv
severed_members.csv solver_energy.csv spans.csv stages.csv study.csv study_areas.csv surfaces.csv survey.csv
survey_cells.csv tendons.csv terrain.csv throw_percentiles.csv touchdown.csv trials.csv varied.csv
vibration_limits.csv zones.csv
"""
"""Tables of reports that left no list."""

_FILES = (*REPORT_FILES, PLAN_WORKBOOK, CHARGES_DXF, CHARGES_GEOJSON)


def reported_in(folder: Path) -> list[str]:
    """Return the files that a report left in a folder, relative to it; files of another name are never among them."""
    try:
        listed = file_text(folder / REPORT_LIST, MEGABYTE).splitlines()
    except UnreadableError:
        if not (folder / REPORT_PAGE).is_file():
            return []
        listed = [*_FILES, *(f"{TABLE_FOLDER}/{name}" for name in _EARLIER_TABLES.split())]
    return [name for name in listed if _can_be(name) and (folder / name).is_file()]


def remove_report(folder: Path) -> None:
    """Remove the report that is kept in a folder, with its tables, if there is one: of a new run it would be wrong."""
    for name in (*reported_in(folder), REPORT_LIST):
        (folder / name).unlink(missing_ok=True)


def check_free(folder: Path, names: Iterable[str] = _FILES) -> None:
    """Refuse files that a report would replace, and that no report wrote."""
    before = reported_in(folder)
    if taken := [name for name in names if name not in before and os.path.lexists(folder / name)]:
        raise OutputError(
            f"{folder / taken[0]}: is there already, and no report wrote it: move it away, or choose another folder"
        )


def list_report(folder: Path, names: Iterable[str]) -> None:
    """Add names to the list of a report's files, before they are written: files of a killed report count as well."""
    listed = sorted({*reported_in(folder), *names})
    write_whole_text(folder / REPORT_LIST, "".join(f"{name}\n" for name in listed))


def _can_be(name: str) -> bool:
    """Return whether a report writes files of such a name: a list that came from elsewhere names any."""
    path = PurePosixPath(name)
    is_table = path.parent == PurePosixPath(TABLE_FOLDER) and path.suffix == ".csv" and path.name != ".."
    return name == str(path) and (name in _FILES or is_table)
