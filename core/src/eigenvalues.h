/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Eigenvalues of many small symmetric matrices.
 */
#ifndef BDA_EIGENVALUES_H
#define BDA_EIGENVALUES_H

#include "core.h"
#include "vectors.h"

/* Symmetric matrices (k, 3, 3), which become diagonal, and others whose rows turn along; none where nothing follows. */
typedef struct {
    int64_t count;
    double *matrices, *followed;
} bda_matrices;

BDA_API int bda_diagonalise(const bda_matrices *matrices);

#endif
