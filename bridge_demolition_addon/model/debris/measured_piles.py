"""How far loose rubble of this model runs out, by what was measured: the error of each forecast of a pile.

Columns of loose blocks that collapse are held against the laws of experiments with grains: G. Lube, H. E. Huppert,
R. S. J. Sparks and M. A. Hallworth (2004), Axisymmetric collapses of granular columns, Journal of Fluid Mechanics 508,
175-199. `scripts/validate collapsing_column` makes the figures.
"""

from ...texts import Text

RUNOUT = 0.55, 0.73
"""Runout by that of the law, smallest and largest of eight columns, rounded down and up."""

HEIGHT = 0.89, 1.12
"""The same of the height of the pile."""

PILES_NOTE = Text(
    "Columns of loose blocks run out {} to {} times as far in this model as measured "
    "ones of grains, and their piles are {} to {} times as high: loose rubble may spread "
    "farther than is shown here",
    f"{RUNOUT[0]:g}",
    f"{RUNOUT[1]:g}",
    f"{HEIGHT[0]:g}",
    f"{HEIGHT[1]:g}",
)
"""What a report says of it."""
