"""What is recorded in a run, its pictures, and how its reports are made."""

from dataclasses import dataclass
from enum import StrEnum
from typing import ClassVar

from ...engineering.unit_systems import UnitSystem
from ...errors import ScenarioError
from ..schema import POSITION, Table, key


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordingSettings(Table):
    """What is recorded while the simulation runs."""

    table: ClassVar[str] = "recording"

    every_substep: bool = key(
        "Whether loads are read after every sub-step, which gives their means, peaks and impulses, or only after the "
        "last one of each frame, which is faster and misses most of an impact.",
        default=True,
    )
    contacts: bool = key(
        "Whether the contacts of the last sub-step of each frame are kept: where bodies touched, and the impulses "
        "there. Each takes 72 bytes a frame. Studies record none.",
        default=False,
    )


class CameraKind(StrEnum):
    """From where pictures and films are taken."""

    FRAMED = "framed"
    """From beside the road, with all of the bridge and where it falls."""

    ORBITING = "orbiting"
    """The same while it goes round the bridge."""

    OWN = "own"
    """From a position of the user's own, or by the camera that the scene has."""


class Renderer(StrEnum):
    """What of Blender draws pictures."""

    WORKBENCH = "workbench"
    """In plain colours, in a second."""

    CYCLES = "cycles"
    """With the light of sun and sky and the patterns of materials, in some ten seconds."""

    REALISTIC = "realistic"
    """As by Cycles: by EEVEE where there is a graphics card, and by Cycles where there is none."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PictureSettings(Table):
    """Size of the pictures of a run, what draws them, and the camera that takes them and its films."""

    table: ClassVar[str] = "pictures"

    width_px: int = key("Width.", default=1280, unit="px", at_least=16, at_most=8192)
    height_px: int = key("Height.", default=720, unit="px", at_least=16, at_most=8192)
    renderer: str = key(
        "What draws the pictures of a run: `workbench` in plain colours, in a second each; `cycles` in the light of "
        "sun and sky, with materials, in half a minute each for 1280 × 720 px on two cores; `realistic` by EEVEE where "
        "Blender has a window and a graphics card, else by Cycles. These two also draw what is for looks only, and "
        "write time and scale into each picture. In Blender's window the scene's own settings of Cycles count, such as "
        "its samples. Films of contours are always by Workbench.",
        default=Renderer.WORKBENCH.value,
        choices=tuple(renderer.value for renderer in Renderer),
    )
    camera: str = key(
        "Camera of pictures and films: `framed` stands beside the road and sees the whole bridge, `orbiting` goes "
        "round it during the run, `own` stands at `pictures.camera_m`, or is the scene's own camera in Blender's "
        "window.",
        default=CameraKind.FRAMED.value,
        choices=tuple(kind.value for kind in CameraKind),
    )
    orbit_deg: float = key(
        "How far an orbiting camera goes round the bridge, counter-clockwise seen from above.",
        default=90.0,
        unit="°",
        at_least=-3600,
        at_most=3600,
    )
    camera_m: tuple[float, float, float] | None = key("Where a camera of your own stands.", default=None, **POSITION)
    look_at_m: tuple[float, float, float] | None = key("What it looks at.", default=None, **POSITION)

    @property
    def why_not_without_window(self) -> str:
        """Why no pictures can be taken but in Blender's window; empty where they can."""
        if self.camera != CameraKind.OWN or self.camera_m:
            return ""
        return (
            'pictures.camera is "own": expected pictures.camera_m and pictures.look_at_m as well, as only a scene in '
            "Blender's window has a camera of its own"
        )

    def _check_together(self) -> None:
        if (self.camera_m is None) != (self.look_at_m is None):
            missing = "camera_m" if self.camera_m is None else "look_at_m"
            raise ScenarioError(
                f"pictures.{missing} is missing: expected both pictures.camera_m and pictures.look_at_m"
            )
        if self.camera_m is not None:
            if self.camera != CameraKind.OWN:
                raise self.unexpected("camera", '"own", as pictures.camera_m is given')
            if self.camera_m == self.look_at_m:
                raise self.unexpected("look_at_m", "another position than pictures.camera_m")


REPORT_LANGUAGES = ("en", "de", "es", "fr", "zh_hans")
"""Languages that reports can be in, English first; `report.languages` has a table for each but English."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ReportSettings(Table):
    """Units and language of reports, and what identifies them: project, people, revision.

    Options of the command that makes a report come first.
    """

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
    project: str | None = key("Name of the project, on the first page.", default=None)
    document_number: str | None = key(
        "Number of the document or contract, on the first page and at the foot of each.", default=None
    )
    client: str | None = key("Who the report is for.", default=None)
    site: str | None = key("Where the bridge is: road, place, address. Coordinates follow from `[site]`.", default=None)
    author: str | None = key("Who prepared the report.", default=None)
    checked_by: str | None = key("Who checked it; the report has a line to sign.", default=None)
    approved_by: str | None = key("Who approved it; the report has a line to sign.", default=None)
    date: str | None = key("Date of the document, such as 2026-11-29.", default=None)
    revision: str | None = key("Revision of the document, on the first page and at the foot of each.", default=None)
    changed: str | None = key("What changed in this revision.", default=None)
