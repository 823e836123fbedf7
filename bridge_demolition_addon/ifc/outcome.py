"""What an element of an IFC file became."""

from __future__ import annotations

from dataclasses import dataclass

from ..engineering.geometry.mesh import TriangleMesh
from ..model.bridge.member import Member
from ..model.schema import given
from .element_materials import ElementMaterial
from .kinds import ElementFacts

MEMBER, CONNECTION, LEFT_OUT, ADDED, BAR = "member", "connection", "left out", "added", "bar"


@dataclass(frozen=True, slots=True)
class Outcome:
    """The result for an element, ``member``, ``bar``, ``connection``, ``left out`` or ``added``, with why, or a note.

    Its member and substance are None where it is left out. A ``bar`` is one of the scenario's steelwork; its member has
    the body that the file gives it. The mesh is written in place of the member's solid. What is
    ``added`` is in no file: a support that the file lacks. It keeps the element's facts, not its entity, which is only
    valid while the file is open. `file_volume_m3` and `file_mass_kg` are what the file says of it.
    """

    facts: ElementFacts
    member: Member | None
    substance: ElementMaterial | None
    became: str
    why: str
    mesh: TriangleMesh | None = None
    file_volume_m3: float | None = None
    file_mass_kg: float | None = None

    @property
    def part(self) -> tuple[Member, ElementMaterial]:
        """Member and substance of an element that is not left out."""
        return given(self.member), given(self.substance)
