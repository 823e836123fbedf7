# SPDX-License-Identifier: GPL-3.0-or-later
"""All arrays of a run for MATLAB, read by scipy."""

import numpy as np
import pytest
from scipy.io import loadmat
from support.exported_runs import turning_run

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.errors import OutputError
from bridge_demolition_addon.exports import mat
from bridge_demolition_addon.exports.mat import write_mat


def test_every_array_is_in_it_to_the_bit(tmp_path):
    results = turning_run()
    write_mat(results, tmp_path / "run.mat", Silence())
    found = loadmat(tmp_path / "run.mat")
    arrays = {name: np.asarray(values) for name, values in results.arrays().items()}
    assert {name for name in found if not name.startswith("__")} == set(arrays)
    for name, values in arrays.items():
        if values.dtype.kind == "U":
            texts = (
                [cell[0] if cell.size else "" for cell in found[name].ravel()] if values.ndim else found[name].tolist()
            )
            assert texts == np.atleast_1d(values).tolist()
        else:
            # MATLAB knows no arrays of fewer than two axes.
            assert np.array_equal(found[name].reshape(values.shape), values, equal_nan=True)
            assert found[name].shape == (values.shape if values.ndim > 1 else (len(values), 1))


def test_an_array_that_does_not_fit_is_named(tmp_path, monkeypatch):
    monkeypatch.setattr(mat, "MOST_BYTES", 1000)
    with pytest.raises(OutputError, match="a MAT file can hold"):
        write_mat(turning_run(), tmp_path / "run.mat", Silence())
    assert not (tmp_path / "run.mat").exists()
