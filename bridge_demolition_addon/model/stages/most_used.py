"""What of a standing bridge is used most: of the resistance of sections with bars, or of the strength of a face."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..structure.section_use import SectionsWithBars
from .standing import Standing, StandingBridge

RESISTANCE = "resistance"
"""In place of one of `DIRECTIONS`: bending and axial force, by the resistance of a section with its bars."""

ALONG_SLAB = "links along the slab"
"""In place of one of these: shear between a girder and its slab, by what the links between them resist."""


@dataclass(frozen=True, slots=True, eq=False)
class MostUsed:
    """The section with bars, or the face elsewhere, with the largest utilisation.

    `governed_by` is `RESISTANCE`, `ALONG_SLAB` or one of `DIRECTIONS`, and `between` are the members on both sides,
    which may be one.
    """

    used: float
    governed_by: str
    between: tuple[str, ...]
    at_m: np.ndarray  # (3,)

    @property
    def words(self) -> str:
        """What the utilisation is a part of."""
        if self.governed_by == ALONG_SLAB:
            return "of what links carry along the slab"
        return "of the resistance in bending" if self.governed_by == RESISTANCE else "of the strength of a face"


def most_used_of(bridge: StandingBridge, sections: SectionsWithBars, standing: Standing) -> MostUsed | None:
    """Return what is used most; None where nothing is held.

    Faces within members with layers of bars are judged by their sections, and those of girders under slabs by their
    links: such a face cracks, and the bars hold.
    """
    model = bridge.model
    of_faces = np.where(sections.judged, np.nan, standing.used)
    uncracked = np.where(standing.cracked, np.nan, standing.used)
    section = sections.most_used(standing.loads, uncracked)
    face = int(np.nanargmax(of_faces)) if np.isfinite(of_faces).any() else None
    if section and (face is None or section.used >= of_faces[face]):
        governed_by = ALONG_SLAB if section.along_slab else RESISTANCE
        return MostUsed(section.used, governed_by, (model.members[section.member].name,), section.at_m)
    if face is None:
        return None
    return MostUsed(
        float(of_faces[face]), bridge.governed_by(standing)[face], model.between(face), model.connections.points[face]
    )
