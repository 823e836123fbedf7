/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "eigenvalues.h"

#include <math.h>

enum { SWEEPS = 8 }; /* each squares the rest beside the diagonal: double precision needs five */

static void turn(double *first, double *second, int64_t stride, double cosine, double sine)
{
    for (int at = 0; at < 3; at++) {
        double one = first[at * stride], other = second[at * stride];
        first[at * stride] = cosine * one - sine * other;
        second[at * stride] = sine * one + cosine * other;
    }
}

/* Turn a matrix by the smaller rotation after which two of its numbers are 0. */
static void clear(double *matrix, double *followed, int p, int q)
{
    double beside = matrix[3 * p + q], tangent = 0.0;
    if (beside != 0.0) {
        double ratio = (matrix[4 * q] - matrix[4 * p]) / (2.0 * beside);
        tangent = (ratio >= 0.0 ? 1.0 : -1.0) / (fabs(ratio) + sqrt(ratio * ratio + 1.0));
    }
    double cosine = 1.0 / sqrt(tangent * tangent + 1.0), sine = tangent * cosine;
    turn(matrix + 3 * p, matrix + 3 * q, 1, cosine, sine);
    turn(matrix + p, matrix + q, 3, cosine, sine);
    if (followed)
        turn(followed + 3 * p, followed + 3 * q, 1, cosine, sine);
}

/* Make matrices diagonal by Jacobi's method (G. H. Golub, C. F. Van Loan, 1996, Matrix Computations, 3rd edition,
 * section 8.4). */
int bda_diagonalise(const bda_matrices *m)
{
    for (int64_t number = 0; number < m->count; number++) {
        double *matrix = m->matrices + 9 * number, *followed = m->followed ? m->followed + 9 * number : 0;
        for (int sweep = 0; sweep < SWEEPS; sweep++) {
            clear(matrix, followed, 0, 1);
            clear(matrix, followed, 0, 2);
            clear(matrix, followed, 1, 2);
        }
    }
    return BDA_DONE;
}
