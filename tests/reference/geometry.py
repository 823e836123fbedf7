# SPDX-License-Identifier: GPL-3.0-or-later
"""Eigenvalues of small matrices by numpy: what the compiled core has for them."""

from __future__ import annotations

import numpy as np


def diagonalised(matrices: np.ndarray, followed: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return diagonals (k, 3) of matrices (k, 3, 3) by Jacobi's method, and other matrices with their rows turned."""
    rest, followed = matrices.copy(), followed.copy()
    for _ in range(8):
        for p, q in ((0, 1), (0, 2), (1, 2)):
            beside = rest[:, p, q]
            with np.errstate(over="ignore"):
                ratio = np.divide(
                    rest[:, q, q] - rest[:, p, p], 2.0 * beside, out=np.zeros(len(rest)), where=beside != 0.0
                )
                tangent = np.where(ratio >= 0.0, 1.0, -1.0) / (np.abs(ratio) + np.sqrt(ratio * ratio + 1.0))
            tangent = np.where(beside != 0.0, tangent, 0.0)
            cosine = 1.0 / np.sqrt(tangent * tangent + 1.0)
            for turning in (rest, np.swapaxes(rest, 1, 2), followed):
                _turn(turning, p, q, cosine[:, None], (tangent * cosine)[:, None])
    return np.diagonal(rest, axis1=1, axis2=2), followed


def _turn(matrices: np.ndarray, p: int, q: int, cosine: np.ndarray, sine: np.ndarray) -> None:
    first, second = matrices[:, p].copy(), matrices[:, q].copy()
    matrices[:, p] = cosine * first - sine * second
    matrices[:, q] = sine * first + cosine * second


def symmetric_eigenvectors_2d(matrices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Eigenvalues (..., 2), in ascending order, of symmetric matrices (..., 2, 2), and eigenvectors as columns."""
    first, second, beside = matrices[..., 0, 0], matrices[..., 1, 1], matrices[..., 0, 1]
    cosine, sine = _jacobi_rotation(first, second, beside)
    slope = np.divide(sine, cosine)
    values = np.stack((first - slope * beside, second + slope * beside), axis=-1)
    vectors = np.stack((np.stack((cosine, -sine), axis=-1), np.stack((sine, cosine), axis=-1)), axis=-1)
    falling = values[..., 0] > values[..., 1]
    return (
        np.where(falling[..., None], values[..., ::-1], values),
        np.where(falling[..., None, None], vectors[..., ::-1], vectors),
    )


def _jacobi_rotation(first: np.ndarray, second: np.ndarray, beside: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Cosine and sine of the smaller rotation that makes [[first, beside], [beside, second]] diagonal."""
    needed = beside != 0.0
    with np.errstate(over="ignore"):
        ratio = np.divide(second - first, 2.0 * beside, out=np.zeros(beside.shape), where=needed)
        tangent = np.where(ratio >= 0.0, 1.0, -1.0) / (np.abs(ratio) + np.sqrt(ratio * ratio + 1.0))
    tangent = np.where(needed, tangent, 0.0)
    cosine = 1.0 / np.sqrt(tangent * tangent + 1.0)
    return cosine, tangent * cosine
