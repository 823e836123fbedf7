"""Write a run in one of the formats: whole or not at all, and nothing over what is there."""

from __future__ import annotations

from contextlib import AbstractContextManager
from pathlib import Path

from ..errors import OutputError, text_of
from ..model.results.arrays import load_results, results_in
from ..system.disk import whole_file, whole_folder
from ..system.progress import Progress
from . import formats
from .blender_process import write_in_blender
from .formats import Format
from .gltf import write_gltf
from .mat import write_mat
from .paraview import write_paraview
from .sheets import check_sheets, write_sheets


def export_run(folder: Path, form: Format, output: Path, progress: Progress, blender: str = "") -> None:
    """Write a run in a format.

    `blender` is the program that writes what only Blender can; by default it is a module of this Python.
    """
    _check_output(form, output)
    if form == formats.XLSX:
        check_sheets()
    progress.stage("reading the results")
    results = load_results(_results_file(folder))
    try:
        with _whole(form, output) as part:
            match form:
                case formats.PARAVIEW:
                    write_paraview(results, part, progress)
                case formats.XLSX:
                    write_sheets(folder, results, part, progress)
                case formats.GLTF:
                    write_gltf(results, part, progress)
                case formats.MAT:
                    write_mat(results, part, progress)
                case formats.USD | formats.ALEMBIC:
                    write_in_blender(form, folder, part, progress, blender)
    except OSError as error:
        raise OutputError(f"{output}: cannot be written ({text_of(error)})") from error


def _check_output(form: Format, output: Path) -> None:
    if form.ending and output.suffix != form.ending:
        raise OutputError(f"{output}: expected a name that ends in {form.ending}, for the format {form.name}")
    if output.exists() or output.is_symlink():
        raise OutputError(f"{output}: is there already; choose another name, or delete it first")
    if not output.parent.is_dir():
        raise OutputError(f"{output}: cannot be written, as there is no folder {output.parent}")


def _results_file(folder: Path) -> Path:
    if not folder.is_dir():
        raise OutputError(f"{folder}: expected the folder of a run, found {'a file' if folder.exists() else 'nothing'}")
    path = results_in(folder)
    if not path.exists():
        raise OutputError(f"{folder}: holds no frames of a run: expected {path.name} in it")
    return path


def _whole(form: Format, output: Path) -> AbstractContextManager[Path]:
    return whole_file(output) if form.ending else whole_folder(output)
