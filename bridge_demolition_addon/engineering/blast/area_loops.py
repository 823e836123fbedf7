"""Areas that bodies show to charges as a loop, which Numba compiles: import this only where it is installed.

It gives the same bits as `exposure`.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..compilation import compiled
from ..geometry.sum_loops import MOST_TERMS, total


@compiled
def projected(face_vectors: Any, starts: Any, rotations: Any, directions: Any) -> Any:
    """`exposure.projected_areas` of bodies with up to `MOST_TERMS` faces each."""
    areas, shown = np.empty(directions.shape[:2]), np.empty(MOST_TERMS)
    for body in range(directions.shape[0]):
        rotation, first, count = rotations[body], starts[body], starts[body + 1] - starts[body]
        for charge in range(directions.shape[1]):
            x, y, z = directions[body, charge, 0], directions[body, charge, 1], directions[body, charge, 2]
            u = rotation[0, 0] * x + rotation[1, 0] * y + rotation[2, 0] * z
            v = rotation[0, 1] * x + rotation[1, 1] * y + rotation[2, 1] * z
            w = rotation[0, 2] * x + rotation[1, 2] * y + rotation[2, 2] * z
            for face in range(count):
                at = first + face
                shown[face] = abs(face_vectors[0, at] * u + face_vectors[1, at] * v + face_vectors[2, at] * w) / 2.0
            areas[body, charge] = total(shown[:count])
    return areas
