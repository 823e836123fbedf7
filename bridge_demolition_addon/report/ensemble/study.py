"""The report of a study, put together."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ...model.study.file import Study
from ...model.study.files import PLAN_DXF, PLAN_GEOJSON
from ...system.progress import Progress
from ..document.blocks import Document, Listing, Paragraph, Report, Section
from ..sections.cover import add_on_version, trust_section
from ..site_plan import write_areas
from .criteria import criteria_section
from .influence import correlation_table, influence_section, varied_section
from .plan import layers, plan_section
from .runs import draws_section, telling_section
from .statement import reach_section, statement_section
from .study_runs import StudyRuns

_STATISTICS = (
    "All statements hold for independent runs, whose number and whose rank were fixed beforehand: limits by rank after "
    "Wilks (1941), of several outputs at once after Guba, Makai and Pál (2003), probabilities after Clopper and "
    "Pearson (1934). They ask nothing of the form of a distribution."
)
_AS_DRAWN = (
    "They say how the model scatters over the inputs that were drawn, from the distributions that were given. Wrong "
    "distributions, inputs that scatter and were not drawn, and errors of the model are in none of them."
)


def study_report(runs: StudyRuns, target: Path, progress: Progress) -> Report:
    """Return the report of a study, and write its site plans."""
    progress.stage("evaluating the runs")
    plans = write_areas(layers(runs), runs.study.scenario.site, target / PLAN_DXF, target / PLAN_GEOJSON)
    document = study_document(runs, add_on_version(), [path.name for path in plans])
    return Report(document, (correlation_table(runs),), tuple(plans))


def study_document(runs: StudyRuns, version: str, files: Sequence[str] = ()) -> Document:
    """Return the report of a study.

    Parameters
    ----------
    runs
        The study and its runs, at least one.
    version
        That of this program.
    files
        Names of those that have the plan for a site plan.
    """
    sections = (
        statement_section(runs, version),
        plan_section(runs, files),
        reach_section(runs),
        criteria_section(runs),
        varied_section(runs),
        influence_section(runs),
        telling_section(runs),
        draws_section(runs),
        trust_section(runs.study.scenario, _STATISTICS, _AS_DRAWN),
        _study_section(runs.study),
    )
    subtitle = (
        f"Report of a study of {runs.study.settings.runs} simulated demolitions. Bridge Demolition Add-on {version}"
    )
    return Document(runs.study.scenario.title, subtitle, tuple(filter(None, sections)))


def _study_section(study: Study) -> Section:
    use = (
        "With these two files and the versions above the study can be repeated: the same files give the same draws, "
        "and the same draws the same outcomes."
    )
    return Section("The study and its scenario", (Paragraph(use), Listing(study.text), Listing(study.scenario_text)))
