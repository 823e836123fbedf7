/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Symmetric systems of equations with six unknowns a body, coupled in pairs by connections, and their factors L D L^T.
 *
 * The numbers are an upper triangle, column by column. They are factored row after row of L, as QDLDL does (B. Stellato
 * and others, 2020, OSQP, Mathematical Programming Computation 12, with the elimination tree of T. A. Davis, 2006,
 * Direct methods for sparse linear systems, chapter 4), six rows of a body at once where they hang on the same columns.
 * Six such columns are a panel, with the same rows below.
 */
#ifndef BDA_EQUATIONS_H
#define BDA_EQUATIONS_H

#include "core.h"
#include "vectors.h"

enum { UNKNOWNS = 6, BLOCK = 36 };

/* What a connection adds to the equations: to its first body, to its second, and between them. */
typedef struct {
    double of_first[BLOCK], of_second[BLOCK], between[BLOCK];
} blocks_of_connection;

typedef struct bda_equations bda_equations;

BDA_API bda_equations *bda_equations_new(int64_t bodies, int64_t connections, int64_t size, const int32_t *starts,
                                         const int32_t *rows, const uint32_t *of_bodies, const uint32_t *of_first,
                                         const uint32_t *of_second, const uint32_t *between, const int64_t *order);
BDA_API void bda_equations_free(bda_equations *equations);
BDA_API int bda_equations_assemble(bda_equations *equations, const double *of_bodies, int64_t count,
                                   const int64_t *connections, const blocks_of_connection *blocks);
BDA_API int bda_equations_factor(bda_equations *equations, int64_t count, const int64_t *connections,
                                 const blocks_of_connection *blocks);
BDA_API void bda_equations_solve(bda_equations *equations, const double *right, double *unknowns);

#endif
