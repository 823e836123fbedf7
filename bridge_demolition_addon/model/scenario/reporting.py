"""How reports are made: their units and their language."""

from dataclasses import dataclass
from typing import ClassVar

from ...engineering.unit_systems import UnitSystem
from ..schema import Table, key

REPORT_LANGUAGES = ("en", "de", "es", "fr", "zh_hans")
"""Languages that reports can be in, English first; `report.languages` has a table for each but English."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ReportSettings(Table):
    """Units and language of reports. What is chosen as a report is made, by an option or in the window, comes first."""

    table: ClassVar[str] = "report"

    units: str | None = key(
        "Units of reports: `metric`, or `imperial` for US customary ones (ft, in, lb, kip, ksi, psi). Without it, "
        "commands make reports in metric units, and Blender's window in those of the scene. The option --units and "
        "*Units* over *Make Report* come first. Files for other programs stay in SI units: tables, logs, "
        "summary.json, site plans.",
        default=None,
        choices=tuple(system.value for system in UnitSystem),
    )
    language: str | None = key(
        "Language of reports. Without it, commands make reports in English, and Blender's window in its own language. "
        "The option --language and *Language* over *Make Report* come first.",
        default=None,
        choices=REPORT_LANGUAGES,
    )
