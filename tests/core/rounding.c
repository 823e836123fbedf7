/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a compiler may round in another way: products before sums, long sums, quotients and roots. */
#include "core.h"

#include <math.h>
#include <stdint.h>

BDA_API void rounding(int64_t count, const double *a, const double *b, const double *c, double *results);

/* results (3, count): a b + c; sqrt(|a|) / b - a c; running sum of a b. */
void rounding(int64_t count, const double *a, const double *b, const double *c, double *results) {
    double sum = 0.0;
    for (int64_t i = 0; i < count; i++) {
        results[i] = a[i] * b[i] + c[i];
        results[count + i] = sqrt(fabs(a[i])) / b[i] - a[i] * c[i];
        sum += a[i] * b[i];
        results[2 * count + i] = sum;
    }
}
