# SPDX-License-Identifier: GPL-3.0-or-later
"""Reinforced beams of many laboratories in three-point bending: the moment that each carried, foreseen."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from blind import BlindCase, Foreseen
from loaded_beams import LoadedBeam, collapse_loads_n, courses

DIAMETER_MM, SHEAR_N_MM2, SHARDS = 12.0, 4.0, 40
LEAST, MOST = 0.85, 1.2
"""What the lowest and the highest of the seeds are multiplied by for the range."""

LOADED_SHARE = 0.12
"""Part of the span on which the load lies, so that it is on some shards; the moment is that of a load so long."""

GROWS_TO = 1.8
"""Largest load over that at which bars have their tensile strength."""


@dataclass(frozen=True, slots=True)
class TestedBeam:
    """A beam as the database has it: its row there, counted from 0, sizes in mm, strengths in N/mm².

    `bottom` and `top` are areas of bars, and `links` that of links, in percent of width times height and of width times
    spacing.
    """

    row: int
    width: float
    height: float
    cover: float
    shear_span: float
    bottom: float
    top: float
    yields: float
    ruptures: float
    links: float
    concrete: float

    @property
    def beam(self) -> LoadedBeam:
        """Return the beam to load."""
        area = 1e-2 * self.width * self.height
        span_m = 2e-3 * self.shear_span
        return LoadedBeam(
            span_m=span_m,
            width_m=1e-3 * self.width,
            height_m=1e-3 * self.height,
            depth_m=1e-3 * (self.height - self.cover - DIAMETER_MM / 2.0),
            area_mm2=self.bottom * area,
            compression_n_mm2=self.concrete,
            shear_n_mm2=SHEAR_N_MM2,
            links_mm2_m2=1e4 * self.links,
            shards=SHARDS,
            yield_n_mm2=self.yields,
            hardening=self.ruptures / self.yields,
            diameter_mm=DIAMETER_MM,
            top_mm2=self.top * area,
            loaded_m=LOADED_SHARE * span_m,
        )

    def foreseen(self, folder: Path) -> Foreseen:
        """Load it with each seed, and return the largest moment in its middle."""
        beam = self.beam
        loads = collapse_loads_n(courses(folder, beam, GROWS_TO * beam.hardening * beam.bends_at_n))
        arm_m = beam.span_m / 4.0 - beam.loaded_m / 8.0
        moments = {name: 1e-3 * arm_m * load for name, load in loads.items()}
        name = f"beam {self.row}: {self.width:g} × {self.height:g} mm, {self.bottom:g} % of bars"
        return Foreseen(
            name,
            "kN·m",
            *(
                round(value, 3)
                for value in (moments["median"], LEAST * min(moments.values()), MOST * max(moments.values()))
            ),
        )


BEAMS = (
    TestedBeam(143, 100, 150, 25, 750, 0.524, 0.0, 415, 664, 0.0, 37),
    TestedBeam(263, 100, 150, 25, 750, 0.524, 0.0, 415, 664, 0.0, 27),
    TestedBeam(274, 150, 200, 25, 500, 0.524, 0.524, 342.7, 387.3, 0.302, 43.2),
    TestedBeam(335, 150, 200, 31, 1000, 0.754, 0.524, 350, 520, 0.251, 28.6),
    TestedBeam(339, 150, 200, 33, 1000, 1.34, 0.524, 350, 520, 0.251, 30),
    TestedBeam(343, 150, 200, 32, 1000, 1.026, 0.524, 380, 580, 0.251, 24.1),
    TestedBeam(495, 150, 300, 41, 800, 1.689, 0.684, 365, 453, 0.67, 18),
)


def foresee(folder: Path) -> Sequence[Foreseen]:
    """Foresee the moment of each."""
    return [tested.foreseen(folder / f"beam_{tested.row}") for tested in BEAMS]


CASE = BlindCase(
    name="blind_beams",
    title="Reinforced beams of many laboratories",
    asked="Beams of 0.1 to 0.15 m width and 0.15 to 0.3 m height, in the middle of a span of 1 to 2 m, under a load "
    "that grows: which moment does each carry at most? They are all beams of a database that have no corrosion, stand "
    "on two supports, were loaded in their middle alone, and differ; of those that do, the "
    "first seven of eleven: the others were left out before the outcome was opened, as runs took long.",
    known="Sizes, bars, strengths and spans: the columns of the database that are inputs. Its last two columns, the "
    "moments, were cut off by a program before the file was looked at. Known as well: all tests failed in "
    "bending. The moments of other tests of the file, those of the "
    "[sections](#reinforced-sections-of-many-laboratories), were opened a little earlier, after these runs had begun.",
    assumed=f"Bars of {DIAMETER_MM:g} mm, whose cover is that of their surface; a shear strength of concrete of "
    f"{SHEAR_N_MM2:g} N/mm²; {SHARDS} shards; the load lies on {LOADED_SHARE:g} of the span. Bars harden to their "
    f"tensile strength. The forecast is the median of three seeds, the range {LEAST:g} of the lowest to {MOST:g} of "
    "the highest: for cover, diameter and strengths that are not known well.",
    source="Data.csv of a public repository of B. Matthews, corroded-RC-beam-moment-capacity, made from 54 "
    "experimental campaigns; the whole database is at Zenodo, record 8062007. A beam has the number of its row there, "
    "from 0.",
    foresee=foresee,
)
