/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Answers, and vectors of three, in arrays of numpy.
 *
 * Arrays are in C order with their components first: a vector of n things is (3, n), and component `axis` of thing `row`
 * stands at [axis * n + row]. Whole numbers have 64 bits. Sums are added in the order in which they are written.
 */
#ifndef BDA_VECTORS_H
#define BDA_VECTORS_H

#include <math.h>
#include <stdint.h>

enum { BDA_DONE = 0, BDA_NO_MEMORY = 1, BDA_OUT_OF_RANGE = 2, BDA_NOT_FINITE = 3 };

/* End a function with the answer of another that could not do what it was asked for. */
#define TRY(call)                                                                                                      \
    do {                                                                                                               \
        int answer_of_call = (call);                                                                                   \
        if (answer_of_call != BDA_DONE)                                                                                \
            return answer_of_call;                                                                                     \
    } while (0)

/* Quantity that is not finite, and the body or connection that it is of. */
typedef struct {
    int64_t quantity, row;
} bda_not_finite;

/* Whether a quantity (c, n) is finite; where it is not, this is noted. */
static inline int are_finite(const double *values, int64_t components, int64_t n, int64_t quantity,
                             bda_not_finite *wrong)
{
    int any = 0;
    for (int64_t at = 0; at < components * n; at++)
        any |= !(values[at] - values[at] == 0.0);
    for (int64_t at = 0; any && at < components * n; at++)
        if (!(values[at] - values[at] == 0.0)) {
            *wrong = (bda_not_finite){quantity, at % n};
            return 0;
        }
    return 1;
}

/* Whether numbers are 0 or more, and below a bound: rows of an array. */
static inline int all_below(const int64_t *numbers, int64_t count, int64_t bound)
{
    for (int64_t at = 0; at < count; at++)
        if (numbers[at] < 0 || numbers[at] >= bound)
            return 0;
    return 1;
}

/* Larger of two numbers; none where one of them is none. */
static inline double larger(double one, double other)
{
    return one != one || one > other ? one : other;
}

static inline double dot3(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void unit_of(const double vector[3], double size, double unit[3])
{
    for (int axis = 0; axis < 3; axis++)
        unit[axis] = size > 0.0 ? vector[axis] / size : 0.0;
}

static inline void subtract3(const double a[3], const double b[3], double difference[3])
{
    for (int axis = 0; axis < 3; axis++)
        difference[axis] = a[axis] - b[axis];
}

static inline void cross3(const double a[3], const double b[3], double product[3])
{
    product[0] = a[1] * b[2] - a[2] * b[1];
    product[1] = a[2] * b[0] - a[0] * b[2];
    product[2] = a[0] * b[1] - a[1] * b[0];
}

/* One of n vectors (3, n). */
static inline void vector_at(const double *values, int64_t n, int64_t row, double vector[3])
{
    vector[0] = values[row];
    vector[1] = values[n + row];
    vector[2] = values[2 * n + row];
}

/* Vector turned by one of n rotations (3, 3, n). */
static inline void turned_at(const double *rotations, int64_t n, int64_t row, const double v[3], double turned[3])
{
    for (int axis = 0; axis < 3; axis++) {
        const double *line = rotations + 3 * axis * n + row;
        turned[axis] = line[0] * v[0] + line[n] * v[1] + line[2 * n] * v[2];
    }
}

/* Vector turned back by one of n rotations (3, 3, n). */
static inline void turned_back_at(const double *rotations, int64_t n, int64_t row, const double v[3], double turned[3])
{
    for (int axis = 0; axis < 3; axis++) {
        const double *column = rotations + axis * n + row;
        turned[axis] = column[0] * v[0] + column[3 * n] * v[1] + column[6 * n] * v[2];
    }
}

/* Write one of n vectors (3, n). */
static inline void put_vector(double *values, int64_t n, int64_t row, const double vector[3])
{
    values[row] = vector[0];
    values[n + row] = vector[1];
    values[2 * n + row] = vector[2];
}

#endif
