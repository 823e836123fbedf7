"""Read a study for its report: its runs, with the outlines and pictures that are kept of them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

from manifold3d import CrossSection

from ...engineering.geometry.plan_areas import united
from ...errors import OutputError
from ...model.ensemble.folder import EnsembleRuns, read_ensemble
from ...model.study.file import Study
from ...model.study.files import AGAIN_FOLDER, RUN_FOLDER
from ..run_folder import pictures_in
from .study_runs import StudyRuns

_BEYOND_M2 = 1e-3
"""Area by which the plan of a bridge has to stick out of others to be another one."""


def read_study_runs(folder: Path) -> StudyRuns:
    """Read a study and its runs.

    Raises
    ------
    OutputError
        The folder is none of a study, no run of it is there, or what is kept of one cannot be read.
    """
    return study_runs(read_ensemble(folder))


def study_runs(read: EnsembleRuns) -> StudyRuns:
    """Return a study that was read, with what is kept of its runs."""
    if not isinstance(read.ensemble, Study):
        raise OutputError(f"{read.folder}: expected the folder of a study")
    folders = read.run_folders()
    outlines = {number: read.outlines_in(folder) for number, folder in folders.items()}
    return StudyRuns(
        name=read.name,
        study=read.ensemble,
        table=read.table,
        swept=[outlines[row.number].swept if row.number in outlines else None for row in read.table.rows],
        bridge=_common_plan(run.bridge for run in outlines.values()),
        pictures=_pictures(read.folder, folders),
        versions=read.versions,
    )


def _common_plan(plans: Iterable[Iterable]) -> CrossSection:
    """Return what bridges cover together; nearly always all of them the same."""
    common = CrossSection()
    for rings in plans:
        plan = CrossSection(list(rings))
        if (plan - common).area() > _BEYOND_M2:
            common = united([common, plan])
    return common


def _pictures(folder: Path, run_folders: Mapping[int, Path]) -> dict[int, dict[str, Path]]:
    """Return pictures of runs that were repeated, or of which everything was kept, by number and name."""
    found = {}
    for number, run_folder in run_folders.items():
        for run in (folder / AGAIN_FOLDER / str(number), run_folder / RUN_FOLDER):
            if pictures := pictures_in(run, []):
                found[number] = pictures
                break
    return found
