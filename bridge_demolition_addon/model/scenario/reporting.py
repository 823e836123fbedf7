"""How reports are made: their units and their language."""

from dataclasses import dataclass
from typing import ClassVar

from ...engineering.unit_systems import UnitSystem
from ..schema import Table, key

REPORT_LANGUAGES = ("en", "de", "es", "fr", "zh_hans")
"""Languages that reports can be in, English first; `report.languages` has a table for each but English."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ReportSettings(Table):
    """Units and language of reports. Options of the command that makes a report come first."""

    table: ClassVar[str] = "report"

    units: str | None = key(
        "Units of reports: `metric`, or `imperial` for US customary ones (ft, in, lb, kip, ksi, psi). Without it, "
        "commands make reports in metric units, and Blender's window in those of its scene. The option --units comes "
        "first; *Units* over *Make Report* is this key. Files for other programs stay in SI units: tables, logs, "
        "summary.json, site plans.",
        default=None,
        choices=tuple(system.value for system in UnitSystem),
    )
    language: str | None = key(
        "Language of reports. Without it, commands make reports in English, and Blender's window in its own language. "
        "The option --language comes first; *Language* over *Make Report* is this key.",
        default=None,
        choices=REPORT_LANGUAGES,
    )
