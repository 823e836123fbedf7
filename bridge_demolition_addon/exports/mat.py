"""All arrays of a run in one file for MATLAB and Octave (MAT, version 5)."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy.io import savemat

from ..errors import OutputError
from ..model.results.arrays import Results
from ..system.progress import Progress

MOST_BYTES = 2**31 - 1
"""Of an array in such a file."""


def write_mat(results: Results, path: Path, progress: Progress) -> None:
    """Write all arrays under the names that they have in ``results.npz``; texts become cell arrays."""
    arrays = {name: np.asarray(values) for name, values in results.arrays().items()}
    progress.stage(f"writing {len(arrays)} arrays")
    for name, values in arrays.items():
        if values.nbytes > MOST_BYTES:
            raise OutputError(f"{path}: {name} takes {values.nbytes / 1e9:.1f} GB, and a MAT file can hold 2.1 of each")
    texts = {name: values.astype(object) for name, values in arrays.items() if values.dtype.kind == "U" and values.ndim}
    with path.open("wb") as file:
        savemat(file, arrays | texts, do_compression=True, oned_as="column", long_field_names=True)
    progress.part(len(arrays), len(arrays), "arrays written")
