# SPDX-License-Identifier: GPL-3.0-or-later
"""Reinforced sections of many laboratories under two loads: the moment that each carried, foreseen by its bars."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from blind import BlindCase, Foreseen

from bridge_demolition_addon.model.materials import ReinforcedSection

LEAST, MOST = 0.9, 1.1
"""What the plastic moment with the yield strength, and that with the tensile strength, are multiplied by."""


@dataclass(frozen=True, slots=True)
class TestedSection:
    """A section as the database has it: its row there, counted from 0, sizes in mm, strengths in N/mm².

    `below` and `above` are the covers of bars at the bottom and the top, `bottom` and `top` their areas in percent of
    width times height.
    """

    row: int
    width: float
    height: float
    below: float
    above: float
    bottom: float
    top: float
    yields: float
    ruptures: float
    concrete: float

    def moment_knm(self, steel_n_mm2: float) -> float:
        """Return the plastic moment with the top pressed, as `bda check` prints it, for a strength of the steel."""
        area_m2 = 1e-8 * self.width * self.height
        layers = [(1e-3 * (self.height - self.below), area_m2 * self.bottom)]
        if self.top:
            layers.append((1e-3 * self.above, area_m2 * self.top))
        section = ReinforcedSection(
            height_m=1e-3 * self.height,
            width_m=1e-3 * self.width,
            compressive_pa=1e6 * self.concrete,
            depths_m=[depth for depth, _ in layers],
            areas_m2=[area for _, area in layers],
            yields_pa=[1e6 * steel_n_mm2] * len(layers),
        )
        return 1e-3 * section.moments_nm()[0]

    @property
    def foreseen(self) -> Foreseen:
        """Return what is foreseen of it."""
        value, most = self.moment_knm(self.yields), self.moment_knm(self.ruptures)
        name = f"section {self.row}: {self.width:g} × {self.height:g} mm, {self.bottom:g} % of bars"
        return Foreseen(name, "kN·m", *(round(number, 3) for number in (value, LEAST * value, MOST * most)))


SECTIONS = (
    TestedSection(0, 150, 150, 35, 15, 0.503, 0.698, 450, 650, 40),
    TestedSection(12, 150, 200, 31, 25, 0.524, 0.335, 575, 655, 50),
    TestedSection(26, 200, 250, 30, 30, 0.796, 0.796, 343, 477, 39.2),
    TestedSection(30, 100, 150, 25, 25, 1.047, 0.377, 520, 598, 40),
    TestedSection(155, 100, 150, 54, 53, 0.67, 0.377, 460, 496.8, 40),
    TestedSection(181, 152, 254, 40.5, 37, 0.915, 0.26, 450, 585, 40),
    TestedSection(190, 150, 150, 30, 40, 0.698, 0.447, 520, 551, 45.8),
    TestedSection(246, 150, 200, 36, 26, 5.362, 0.754, 498, 604, 48.5),
    TestedSection(287, 200, 215, 48, 29, 0.935, 0.234, 593, 700, 28),
    TestedSection(295, 200, 265, 48, 29, 0.759, 0.19, 593, 700, 28),
    TestedSection(303, 200, 315, 48, 29, 0.638, 0.16, 593, 700, 28),
    TestedSection(347, 240, 200, 40, 0, 1.257, 0, 369, 523, 30.8),
    TestedSection(360, 100, 200, 26.5, 23, 1.327, 0.283, 345, 490, 21.7),
    TestedSection(373, 150, 200, 46, 43, 1.34, 0.524, 425.47, 652.99, 25.9),
    TestedSection(400, 200, 300, 44, 41, 1.272, 0.377, 360, 560, 30),
    TestedSection(483, 150, 250, 41, 35, 2.027, 0.419, 383.7, 572.6, 45.4),
    TestedSection(501, 150, 300, 36.5, 33, 0.885, 0.126, 394.4, 540.7, 30),
    TestedSection(512, 120, 200, 37.5, 35.5, 0.942, 0.419, 385, 630, 34.2),
    TestedSection(525, 100, 150, 25, 0, 1.047, 0, 250, 375, 33),
    TestedSection(545, 230, 300, 31, 31, 0.328, 0.328, 369, 490.77, 25),
    TestedSection(590, 120, 250, 40, 37, 1.026, 0.335, 450, 587, 35.7),
    TestedSection(602, 100, 200, 26, 24, 1.131, 0.503, 555, 656, 45.8),
    TestedSection(645, 80, 120, 23, 22, 1.047, 0.589, 334, 437.4, 25),
    TestedSection(651, 100, 170, 32, 31, 1.331, 0.924, 385, 630, 42.5),
    TestedSection(678, 80, 120, 31, 26, 0.818, 0, 390, 520, 30),
    TestedSection(696, 150, 200, 35, 34, 1.026, 0.754, 584, 626, 67.4),
    TestedSection(704, 100, 100, 20, 0, 1.571, 0, 240, 360, 38.6),
    TestedSection(716, 150, 200, 34, 32, 0.754, 0.335, 507, 627.7, 33.2),
)


def foresee(folder: Path) -> Sequence[Foreseen]:
    """Foresee the moment of each."""
    return [section.foreseen for section in SECTIONS]


CASE = BlindCase(
    name="blind_sections",
    title="Reinforced sections of many laboratories",
    asked="Beams between two loads in equal distances from their supports: which moment do their sections carry at "
    "most? Of the tests of a database in which bars had no corrosion, it is the first of each width, height and "
    "distance of a load from its support.",
    known="Sizes, bars and strengths: the columns of the database that are inputs. Its last two columns, the moments, "
    "were cut off by a program before the file was looked at. Known as well: all tests failed in bending.",
    assumed="Covers are those of the axes of bars, as many of them are by half of a diameter more than a round number. "
    "The forecast is the plastic moment with the yield strength, as `bda check` prints it: nothing runs. The range "
    f"begins at {LEAST:g} of it and ends at {MOST:g} of that with the tensile strength.",
    source="As for the [beams](#reinforced-beams-of-many-laboratories).",
    foresee=foresee,
)
