"""Section with the run as a model that can be turned and played."""

from __future__ import annotations

from ...exports.gltf import animated_glb
from ...model.results.arrays import Results
from ...texts import Text
from ..document.blocks import AnimatedModel, Block, Paragraph, Section

MOST_BYTES = 20_000_000
"""Of a model as it stands in a page: beyond that, browsers take seconds to open it."""


def model_section(results: Results) -> Section:
    """Return the section."""
    model = AnimatedModel.of(
        animated_glb(results), "The run: drag to turn, drag with Shift to move, wheel to come closer."
    )
    megabytes = len(model.packed) / 1e6
    how = Text("bda export --to gltf writes it as a file for other programs.")
    blocks: tuple[Block, ...]
    if len(model.packed) > MOST_BYTES:
        blocks = (
            Paragraph(
                Text("As a model the run would take {} MB of this page, so it is left out. {}", f"{megabytes:.0f}", how)
            ),
        )
    else:
        text = Text(
            "The page report.html has the run here as a model that can be turned and played. It takes {} MB of "
            "that page, and loads nothing from elsewhere. Bodies have the shapes that collide, their hulls. {}",
            f"{megabytes:.2g}",
            how,
        )
        blocks = (Paragraph(text), model)
    return Section("The run as a model", blocks)
