"""Members that the user brings along as mesh files."""

from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from ...errors import Faults, ScenarioError
from ..mesh_reading import MESH_FILES
from ..schema import DENSITY, Table, check_exactly_one, key

_ADVICE = {
    ".ifc": "; of a bridge in an IFC file, bda import makes them",
    **dict.fromkeys((".dwg", ".dxf", ".step", ".stp", ".iges", ".rvt", ".skp", ".3dm"), "; export it as one of these"),
}
"""What to do with files of other programs, by how their names end."""

_WITH_OBJECTS = (".obj", ".glb")


@dataclass(frozen=True, slots=True, kw_only=True)
class Geometry(Table):
    """A member of your own, from a file of closed surfaces: STL, OBJ, PLY or GLB. It stands beside the bridge, or in
    its position. What is not closed, wound wrongly or overlaps itself is repaired where that is possible, and refused
    where not. Files of the same name become one solid; what a member has in common with those before it is cut off."""

    table: ClassVar[str] = "geometry"
    may_share_names: ClassVar[bool] = True  # its files become one solid

    name: str = key("Name of the member.")
    file: str = key("Path of the file, from the scenario file's folder.")
    part: str | None = key(
        "Name of the object in an OBJ or GLB file of several, with `*` for any letters; by default all of them.",
        default=None,
    )
    kind: str = key("What kind of member it is, such as `deck` or `pier`.", default="member")
    scale: float = key("Metres in one unit of the file: 0.001 for a file in millimetres.", default=1.0, above=0)
    up: str | None = key(
        "Axis of the file that points up; by default `y` for GLB, as its standard has it, and `z` for the others.",
        default=None,
        choices=("y", "z"),
    )
    tilt_deg: tuple[float, float] = key(
        "Turns about the axes x and y through the file's origin, first about x; `rotation_deg` follows.",
        default=(0.0, 0.0),
        unit="°",
    )
    rotation_deg: float = key(
        "Turn about the vertical through the file's origin, counter-clockwise.", default=0.0, unit="°"
    )
    position_m: tuple[float, float, float] = key(
        "Where the file's origin goes: along the road, across it, above the ground.", default=(0.0, 0.0, 0.0), unit="m"
    )
    velocity_m_s: tuple[float, float, float] = key(
        "Velocity with which the member begins, along x, y and z.", default=(0.0, 0.0, 0.0), unit="m/s"
    )
    angular_velocity_rad_s: tuple[float, float, float] = key(
        "Angular velocity with which it begins, about axes along x, y and z through its centre of mass.",
        default=(0.0, 0.0, 0.0),
        unit="rad/s",
    )
    density_kg_m3: float | None = key("Density. Give this or `mass_kg`.", **DENSITY)
    mass_kg: float | None = key(
        "Mass of what is in the file, before anything is cut off. Give this or `density_kg_m3`.",
        default=None,
        unit="kg",
        above=0,
    )

    @property
    def is_moving(self) -> bool:
        """Return whether it begins with a velocity or an angular velocity."""
        return any(self.velocity_m_s) or any(self.angular_velocity_rad_s)

    def _check_together(self) -> None:
        faults = Faults()
        with faults.noted():
            self._check_format()
        with faults.noted():
            check_exactly_one(self, "density_kg_m3", "mass_kg")
        faults.check()

    def _check_format(self) -> None:
        suffix = Path(self.file).suffix.lower()
        if suffix not in MESH_FILES:
            *first, last = MESH_FILES
            advice = _ADVICE.get(suffix, "")
            raise ScenarioError(
                f'geometry.file is "{self.file}": expected a file that ends in {", ".join(first)} or {last}{advice}'
            )
        if self.part is not None and suffix not in _WITH_OBJECTS:
            raise self.unexpected("part", f"none of a file that ends in {suffix}, whose objects have no names")
