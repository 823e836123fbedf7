"""Which files in a folder are those of a report: only these are replaced by the next one, or removed by the next run.

A report leaves a list of its files. Folders of before have none: there, files have the names that reports had.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path, PurePosixPath

from ...errors import OutputError, UnreadableError
from ...system.disk import write_whole_text
from ...system.reading import MEGABYTE, file_text
from .files import CHARGES_DXF, CHARGES_GEOJSON, PLAN_WORKBOOK, REPORT_FILES, REPORT_LIST, REPORT_PAGE, TABLE_FOLDER

_EARLIER_TABLES = """
bearing_forces bearing_moments bearings breaking candidates charge_neighbours charge_per_delay charge_table
charge_totals charges chosen_candidate collapse comparison cracked_connections criteria criticality damage_rings
debris debris_on_surfaces drill_holes energy exclusion_corners exclusion_corners_of_one_run exclusion_zone
exclusion_zone_corners exclusion_zone_of_one_run farthest_draws findings firing_sequence fragment_limits fragments
ground_motion_peaks hits_of_the_ball largest_throws lifts limits_at_once median_and_worst misfires
most_loaded_connections most_loaded_shards neighbours neighbours_of_runs optimisation plan plan_contents pulls
rank_correlations reaction_forces reaction_moments reinforcement run runs search sequence settlements
severed_members solver_energy spans stages study study_areas surfaces survey survey_cells tendons terrain
throw_percentiles touchdown trials varied vibration_limits zones
"""
"""Tables of reports that left no list."""

_FILES = (*REPORT_FILES, PLAN_WORKBOOK, CHARGES_DXF, CHARGES_GEOJSON)


def reported_in(folder: Path) -> list[str]:
    """Return the files that a report left in a folder, relative to it; those of another name are never among them."""
    try:
        listed = file_text(folder / REPORT_LIST, MEGABYTE).splitlines()
    except UnreadableError:
        if not (folder / REPORT_PAGE).is_file():
            return []
        listed = [*_FILES, *(f"{TABLE_FOLDER}/{name}.csv" for name in _EARLIER_TABLES.split())]
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
    """Add names to the list of a report's files, before they are written: those of one that is killed count as well."""
    listed = sorted({*reported_in(folder), *names})
    write_whole_text(folder / REPORT_LIST, "".join(f"{name}\n" for name in listed))


def _can_be(name: str) -> bool:
    """Return whether a report writes files of such a name: a list that came from elsewhere names any."""
    path = PurePosixPath(name)
    is_table = path.parent == PurePosixPath(TABLE_FOLDER) and path.suffix == ".csv" and path.name != ".."
    return name == str(path) and (name in _FILES or is_table)
