"""Options that the commands on blast have in common."""

import argparse

from ..core.blast.models import BlastModel
from ..core.blast.wave import Burst


def add_blast_options(parser: argparse.ArgumentParser) -> None:
    """Add where the charge detonates, and where the wave comes from."""
    parser.add_argument(
        "--burst",
        choices=[burst.value for burst in Burst],
        default=Burst.AIR.value,
        help="where the charge detonates: free in the air, or on the ground, which sends its wave back up (air)",
    )
    parser.add_argument(
        "--model",
        choices=[model.value for model in BlastModel],
        default=BlastModel.KINGERY_BULMASH.value,
        help="formulas for the blast wave (kingery-bulmash)",
    )
