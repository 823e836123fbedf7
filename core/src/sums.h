/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Sums in numpy's order: in halves down to 128 numbers, and there in eight sums side by side.
 */
#ifndef BDA_SUMS_H
#define BDA_SUMS_H

#include <stdint.h>

static inline double pairwise_sum(const double *values, int64_t count)
{
    if (count > 128) {
        int64_t half = count / 2 - count / 2 % 8;
        return pairwise_sum(values, half) + pairwise_sum(values + half, count - half);
    }
    int64_t at = 0;
    double sum = -0.0;
    if (count >= 8) {
        double s[8];
        for (; at < 8; at++)
            s[at] = values[at];
        for (; at < count - count % 8; at++)
            s[at % 8] += values[at];
        sum = ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]));
    }
    for (; at < count; at++)
        sum += values[at];
    return sum;
}

/* Sum as of `numpy.add.reduceat`: the first number, and the sum of the others; 0 of none. */
static inline double total_of(const double *values, int64_t count)
{
    return count ? values[0] + pairwise_sum(values + 1, count - 1) : 0.0;
}

#endif
