"""Film frames: which recorded frame each picture of a film shows, in real time or slowed down."""

from __future__ import annotations

import numpy as np

from ..errors import OutputError


def film_rows(times_s: np.ndarray, pictures_per_second: float, slowness: float = 1.0) -> np.ndarray:
    """Return the rows (p,) of recorded frames, one for every picture of a film from the first frame to the last.

    The film shows the frame whose time (k,) is nearest. So it keeps time where frames are of different lengths, as
    around a detonation, and where it is slowed down it repeats frames, as nothing is known between them. With a
    `slowness` of 10 a second of the simulation takes ten seconds of film.
    """
    times_s = np.asarray(times_s, float)
    if not len(times_s):
        raise OutputError("film: there are no recorded frames; play the timeline with the handler registered first")
    if not (pictures_per_second > 0.0 and slowness > 0.0):
        raise OutputError(
            f"film: expected positive numbers, found {pictures_per_second:g} pictures a second and a "
            f"slowness of {slowness:g}"
        )
    duration = times_s[-1] - times_s[0]
    count = int(np.floor(duration * slowness * pictures_per_second + 1e-6)) + 1
    wanted = times_s[0] + np.arange(count) / (pictures_per_second * slowness)
    after = np.clip(np.searchsorted(times_s, wanted), 1, max(len(times_s) - 1, 1))
    if len(times_s) == 1:
        return np.zeros(count, int)
    before = after - 1
    return np.where(wanted - times_s[before] <= times_s[after] - wanted, before, after)
