"""Write the report of a run, or of several: a page, a PDF, tables and site plans."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

from ..engineering.unit_systems import UnitSystem
from ..errors import OutputError, text_of
from ..exports.sheets import write_workbook
from ..model.debris.survey import SurveyComparison, SurveySettings, compared, read_survey
from ..model.ensemble.folder import holds_ensemble
from ..model.run_folder.files import (
    CHARGES_DXF,
    CHARGES_GEOJSON,
    PLAN_WORKBOOK,
    REPORT_PAGE,
    REPORT_PDF,
    REPORT_WORD,
    SINGLE_PAGES,
    TABLE_FOLDER,
    check_free,
    list_report,
)
from ..model.run_folder.folder import holds_run
from ..model.run_folder.own_code import own_code
from ..model.scenario import Scenario
from ..model.study.file import OPTIMISE_FILE, REPORT_FOLDER, SEARCH_FILE, STUDY_FILE
from ..model.terrain.placed import Placing
from ..system.disk import check_no_link, own_folder
from ..system.folder_lock import FolderLock
from ..system.progress import Progress
from ..version import VERSION
from .comparison import comparison
from .document.blocks import Document, Report, write_tables
from .document.drawings import Drawings, drawings
from .document.html import write_html
from .document.pdf import write_pdf
from .document.word import is_as_written, write_word
from .document.word_library import check_word
from .ensemble.optimise import optimise_report, read_candidates
from .ensemble.reported_ensemble import read_study_runs
from .ensemble.search import read_answer, search_report
from .ensemble.study import study_report
from .languages.letters import NO_LETTERS, letters_of
from .languages.translated_report import notes_at_head, translated_document, with_notes
from .languages.translation import ENGLISH, Translation, check_language
from .run import run_report
from .run_folder import ReportedRun, read_run
from .sections.charge_plan import planned_section
from .sections.control import document_control
from .sections.stages import has_stages, stages_report
from .site_plan import charge_areas, write_areas
from .survey import survey_report, survey_rows


@dataclass(frozen=True, slots=True)
class FolderKind:
    """A kind of folder that a report is made from: its name in messages, and the command that makes it."""

    name: str
    command: str
    recognised: Callable[[Path], bool]
    read: Callable[[Path], Any]
    report: Callable[[Any, Path, Progress], Report]  # from what was read, and the folder that it goes to
    subfolder: str = ""  # that the report goes to by default


def _ensemble_kind(
    name: str,
    command: str,
    file_name: str,
    read: Callable[[Path], Any],
    report: Callable[[Any, Path, Progress], Report],
) -> FolderKind:
    return FolderKind(name, command, partial(holds_ensemble, file_name=file_name), read, report, REPORT_FOLDER)


RUN = FolderKind("run", "bda run", holds_run, read_run, run_report)
KINDS = (
    _ensemble_kind("study", "bda study", STUDY_FILE, read_study_runs, study_report),
    _ensemble_kind("search", "bda search", SEARCH_FILE, read_answer, search_report),
    _ensemble_kind("optimisation", "bda optimise", OPTIMISE_FILE, read_candidates, optimise_report),
    RUN,
    FolderKind("set of stages", "bda stages", has_stages, Path, stages_report),
)
"""A folder is of the first kind that recognises it."""


_WITH_PAGES = ("run", "study")


@dataclass(frozen=True, slots=True)
class Extras:
    """What is written with page and PDF, a Word file and single pages by whom they are for; language and units.

    Without a language or units of its own, a report is in those that its scenario asks for, else English and metric.
    """

    word: bool = False
    pages: tuple[str, ...] = ()
    language: str | None = None
    units: str | None = None

    def language_of(self, report: Report) -> str:
        """Return the language of a report."""
        return self.language or report.settings.language or ENGLISH

    def system_of(self, report: Report) -> UnitSystem:
        """Return the system of units of a report."""
        return UnitSystem(self.units or report.settings.units or UnitSystem.METRIC)


NO_EXTRAS = Extras()

SurveyPlace = tuple[Sequence[float] | None, float | None, float | None]
_AS_GROUND: SurveyPlace = (None, None, None)
_USUAL_CELLS = SurveySettings()
"""Origin of the scenario in a survey, direction of its x axis, and metres in its unit; None for those of the ground."""


def kind_of(folder: Path) -> FolderKind:
    """Return the kind of a folder; a run's where none recognises it; its reader says what is missing."""
    return next((kind for kind in KINDS if kind.recognised(folder)), RUN)


def write_report(
    folders: Sequence[Path],
    output: Path | None,
    *,
    trajectories: bool = False,
    stages: bool = False,
    word: bool = False,
    pages: Sequence[str] = (),
    language: str | None = None,
    units: str | None = None,
    progress: Progress,
) -> list[Path]:
    """Write the report of a folder of any kind, or the comparison of several runs, and return all files written.

    The report goes to `output`, or by default into the folder that it is made from. `trajectories` draws the paths of
    the shards on the map of debris; `stages` first works out the stages of the run's scenario, for a chapter on them.
    `word` also writes it as a Word file; `pages` are for whom single pages of a run or a study are written. `language`
    is one of `language_names` and `units` one of `UnitSystem`, both None for those that the scenario asks for; files
    and their keys stay English and in SI units.
    """
    extras = Extras(word, tuple(dict.fromkeys(pages)), _checked_language(language), _checked_units(units))
    if word:
        check_word()
    if len(folders) > 1:
        return _write_comparison(folders, output, extras, stages=stages, progress=progress)
    [folder] = folders
    kind = kind_of(folder)
    if pages and kind.name not in _WITH_PAGES:
        raise OutputError(
            f"{folder}: pages are of a run or a study, and this is the folder of a {kind.name}; leave out --pages"
        )
    if stages and kind is not RUN:
        raise OutputError(f"{folder}: --stages is for the report of a run, and this is the folder of a {kind.name}")
    make = partial(run_report, trajectories=trajectories, stages=stages) if kind is RUN else kind.report
    progress.stage("reading the results")
    content, target = kind.read(folder), folder / kind.subfolder if output is None else output
    with _written_to(target):
        return _written(make(content, target, progress), target, progress, extras)


def write_survey(
    folder: Path,
    survey: Path,
    place: SurveyPlace,
    settings: SurveySettings,
    output: Path,
    progress: Progress,
    language: str | None = None,
    units: str | None = None,
) -> tuple[list[tuple[str, str]], list[Path]]:
    """Compare a run with a survey of its debris, write that as a report, and return what it says and all files.

    The survey lies like the ground of the run's scenario, but for what `place` says.
    """
    progress.stage(f"reading the results, and {survey.name}")
    comparison, run = survey_beside_run(folder, survey, place, settings)
    with _written_to(output):
        report = replace(survey_report(comparison, run.name, survey), settings=run.report_settings)
        extras = Extras(language=_checked_language(language), units=_checked_units(units))
        written = _written(report, output, progress, extras)
    shown = Translation.into(ENGLISH, extras.system_of(report)).text
    return [(name, shown(value)) for name, value in survey_rows(comparison)], written


def survey_beside_run(
    folder: Path, survey: Path, place: SurveyPlace = _AS_GROUND, settings: SurveySettings = _USUAL_CELLS
) -> tuple[SurveyComparison, ReportedRun]:
    """Return the comparison of a survey of debris with a run, and the run."""
    run = read_run(folder)
    if run.results is None or run.scenario is None:
        raise OutputError(f"{folder}: {' '.join(run.shortcomings)}")
    origin, bearing_deg, scale = place
    ground = run.scenario.ground
    if origin is not None:
        ground = replace(ground, origin=tuple(origin))
    if bearing_deg is not None:
        ground = replace(ground, bearing_deg=bearing_deg)
    if scale is not None:
        ground = replace(ground, scale=scale)
    points = read_survey(survey, Placing.of(replace(run.scenario, ground=ground)))
    return compared(run.results, points, settings), run


def _write_comparison(
    folders: Sequence[Path], output: Path | None, extras: Extras, *, stages: bool, progress: Progress
) -> list[Path]:
    if output is None:
        raise OutputError("several runs are compared in a folder of their own: give one with --output")
    if extras.pages:
        raise OutputError("--pages is for the report of one run or study: leave it out where several are compared")
    if stages:
        raise OutputError("--stages is for the report of one run: leave it out where several are compared")
    for folder in folders:
        if (kind := kind_of(folder)).subfolder:
            raise OutputError(f"{folder}: is the folder of a {kind.name}, whose report is made by itself")
    progress.stage(f"reading the results of {len(folders)} runs")
    runs = [read_run(folder) for folder in folders]
    with _written_to(output):
        report = Report(comparison(runs, VERSION), settings=runs[0].report_settings)
        return _written(report, output, progress, extras)


def write_charge_plan(
    scenario: Scenario, target: Path, progress: Progress, language: str | None = None, units: str | None = None
) -> list[Path]:
    """Write the charge plan of a scenario with blast zones to a folder, and return all files written.

    Without XlsxWriter there is no workbook.
    """
    progress.stage("working out the charge plan")
    section, areas = planned_section(scenario), charge_areas(scenario)
    subtitle = f"Charge plan. Bridge Demolition Add-on {VERSION}"
    control = document_control(scenario, {"program": own_code()})
    document = Document(scenario.title, subtitle, (section,), control=control)
    with _written_to(target):
        drawn = write_areas(areas, scenario.site, target / CHARGES_DXF, target / CHARGES_GEOJSON)
        report = Report(document, files=tuple(drawn), settings=scenario.report)
        extras = Extras(language=_checked_language(language), units=_checked_units(units))
        written = _written(report, target, progress, extras)
        book = target / PLAN_WORKBOOK
        tables = [
            (table.name, [column.key for column in table.columns], table.rows) for table in document.named_tables()
        ]
        list_report(target, [PLAN_WORKBOOK])
        return [*written, book] if write_workbook(tables, book) else written


def _checked_language(name: str | None) -> str | None:
    return None if name is None else check_language(name)


def _checked_units(name: str | None) -> str | None:
    if name is not None and name not in list(UnitSystem):
        raise OutputError(f"units of the report are {name!r}: expected {', '.join(UnitSystem)}")
    return name


@contextmanager
def _written_to(target: Path) -> Iterator[None]:
    """Have a folder to write a report to, and say so where that fails."""
    if any(kind.recognised(target.parent) for kind in KINDS):
        check_no_link(target)
    try:
        target.mkdir(parents=True, exist_ok=True)
        with FolderLock(target):
            check_free(target)
            yield
    except OSError as error:
        read = isinstance(error, FileNotFoundError) and not Path(error.filename or target).is_relative_to(target)
        cleared = ": a folder was cleared meanwhile, as by a run that has begun in it; make the report again"
        raise OutputError(
            f"{target}: the report cannot be written ({text_of(error)}){cleared if read else ''}"
        ) from error


def _written(report: Report, target: Path, progress: Progress, extras: Extras = NO_EXTRAS) -> list[Path]:
    translation = Translation.into(extras.language_of(report), extras.system_of(report))
    with letters_of(translation.table) as can_draw:
        written = _written_in(report, translation, can_draw, target, progress, extras)
    if not can_draw:
        raise OutputError(NO_LETTERS.format(target / REPORT_PAGE))
    return written


def _written_in(
    report: Report, translation: Translation, can_draw: bool, target: Path, progress: Progress, extras: Extras
) -> list[Path]:
    """Write a report in a language; without letters to draw it, only what needs none, with drawings in English."""
    progress.stage("drawing the pictures")
    english = [report.document, *(report.single_pages[audience] for audience in extras.pages)]
    document, *pages = (translated_document(each, translation) for each in english)
    on_drawings = translation if can_draw else Translation.into(ENGLISH, translation.system)
    drawn = drawings((document, *pages), lambda done, total: progress.part(done, total, "pictures drawn"), on_drawings)
    if notes := notes_at_head(translation, can_draw):
        document, pages = with_notes(document, notes), [with_notes(page, notes) for page in pages]
    tables = [*report.document.named_tables(), *report.tables]
    names = [f"{TABLE_FOLDER}/{table.name}.csv" for table in tables]
    check_no_link(target / TABLE_FOLDER)
    check_free(target, names)
    pages_here = [SINGLE_PAGES[audience] for audience in extras.pages]
    list_report(target, [*names, REPORT_PAGE, REPORT_PDF, *pages_here, *(path.name for path in report.files)])
    progress.stage(f"writing {REPORT_PAGE}")
    write_html(document, drawn, target / REPORT_PAGE, translation)
    files = [target / REPORT_PAGE]
    pdfs = {target / REPORT_PDF: document}
    pdfs |= {target / SINGLE_PAGES[audience]: page for audience, page in zip(extras.pages, pages, strict=True)}
    for path, content in pdfs.items():
        if can_draw:
            progress.stage(f"writing {path.name}")
            write_pdf(
                content, drawn, path, lambda done, total: progress.part(done, total, "pages written"), translation
            )
            files.append(path)
        else:
            path.unlink(missing_ok=True)  # an earlier report's would say something else
    if extras.word:
        files += _word_files((document, *pages), drawn, target, progress, extras, translation)
    return [*files, *write_tables(tables, own_folder(target / TABLE_FOLDER)), *report.files]


def _word_files(
    documents: Sequence[Document],
    drawn: Drawings,
    target: Path,
    progress: Progress,
    extras: Extras,
    translation: Translation,
) -> list[Path]:
    """Write the report and its single pages as Word files, unless one was changed by hand."""
    paths = [target / REPORT_WORD, *((target / SINGLE_PAGES[who]).with_suffix(".docx") for who in extras.pages)]
    for path in paths:
        if path.exists() and not is_as_written(path):
            raise OutputError(f"{path}: was changed by hand, and would be lost: save it under another name")
    for path, document in zip(paths, documents, strict=True):
        progress.stage(f"writing {path.name}")
        write_word(
            document, drawn, path, lambda done, total: progress.part(done, total, "sections written"), translation
        )
    return paths
