/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Symmetric systems of equations with six unknowns a body, coupled in pairs by connections, and their factors L D L^T.
 *
 * All is done in blocks of six by six: `elimination` finds the order of the bodies and where L has blocks, and L is found
 * column by column, each from those to its left (T. A. Davis, 2006, Direct methods for sparse linear systems, chapter 4).
 */
#ifndef BDA_EQUATIONS_H
#define BDA_EQUATIONS_H

#include "core.h"
#include "vectors.h"

enum { UNKNOWNS = 6, BLOCK = 36 };

/* What a connection adds to the equations: to its first body, to its second, and between them, with rows for the first.
 * Of what it adds to a body the upper triangle counts. */
typedef struct {
    double of_first[BLOCK], of_second[BLOCK], between[BLOCK];
} blocks_of_connection;

typedef struct bda_equations bda_equations;

BDA_API bda_equations *bda_equations_new(int64_t bodies, int64_t connections, const int64_t *first,
                                         const int64_t *second);
int64_t bodies_of_equations(const bda_equations *equations);
BDA_API void bda_equations_free(bda_equations *equations);
BDA_API int bda_equations_assemble(bda_equations *equations, const double *of_bodies, int64_t count,
                                   const int64_t *connections, const blocks_of_connection *blocks);
BDA_API int bda_equations_factor(bda_equations *equations, int64_t count, const int64_t *connections,
                                 const blocks_of_connection *blocks);
BDA_API void bda_equations_solve(bda_equations *equations, const double *right, double *unknowns);

#endif
