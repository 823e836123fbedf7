"""Types of arrays, by what they hold."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.integer[Any]]
BoolArray = npt.NDArray[np.bool_]

Rows = Sequence[int] | IntArray
"""Numbers of rows, such as of some bodies."""
