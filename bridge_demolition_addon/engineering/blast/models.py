"""Models of the blast wave, and the wave of any charge at any stand-off."""

import numpy as np
from numpy.typing import ArrayLike

from ..arithmetic import cube_root
from . import kingery_bulmash, kinney_graham
from .wave import Burst, Choice, Wave, scaled_distance


class BlastModel(Choice):
    """Where peak, impulse, arrival and duration come from."""

    KINGERY_BULMASH = "kingery-bulmash"
    """Fits to tests, for either burst: what the field uses."""

    KINNEY_GRAHAM = "kinney-graham"
    """The formulas of the report of 2019."""


_UNIT_WAVES = {
    BlastModel.KINGERY_BULMASH: kingery_bulmash.unit_wave,
    BlastModel.KINNEY_GRAHAM: kinney_graham.unit_wave,
}


def blast_wave(
    stand_off_m: ArrayLike,
    tnt_kg: ArrayLike,
    burst: Burst | str = Burst.AIR,
    model: BlastModel | str = BlastModel.KINGERY_BULMASH,
) -> Wave:
    """Return the waves of charges at stand-offs.

    Parameters
    ----------
    stand_off_m : (...) float
        Distances from the charges, m; nearer than a charge's surface (`wave.SMALLEST_SCALED_DISTANCE`) counts as
        that.
    tnt_kg : (...) float
        Charges, kg of TNT; a charge of 0 has a wave of zeros.
    burst : Burst
        Where the charges detonate.
    model : BlastModel
        Where the wave comes from.

    Returns
    -------
    Wave
        Arrays of the shape to which stand-offs and charges broadcast.

    Raises
    ------
    BlastError
        A stand-off or a charge is negative or not finite.

    Examples
    --------
    >>> wave = blast_wave([10.0, 20.0], 8.0)
    >>> (wave.peak_overpressure_pa / 1e3).round(2)
    array([31.3 , 11.09])
    """
    distance = scaled_distance(stand_off_m, tnt_kg)
    unit_wave = _UNIT_WAVES[BlastModel(model)]
    anywhere = np.where(np.isinf(distance), 1.0, distance)
    return unit_wave(anywhere, Burst(burst)).scaled(cube_root(tnt_kg))
