/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "blast.h"

#include "sums.h"

#include <math.h>
#include <string.h>

/* Exponential: fdlibm (Sun Microsystems, 1993), e_exp.c. */
static const double LN2_UPPER = 6.93147180369123816490e-01, LN2_LOWER = 1.90821492927058770002e-10;
static const double PER_LN2 = 1.44269504088896338700e00;
static const double EXPONENTIAL[] = {1.66666666666666019037e-01, -2.77777777770155933842e-03, 6.61375632143793436117e-05,
                                     -1.65339022054652515390e-06, 4.13813679705723846039e-08};
static const double WHOLE = 6755399441055744.0; /* 1.5 * 2^52: numbers that are added to it and taken off are whole */

enum { SERIES_TERMS = 15 };
static const double SERIES_BELOW = 0.5;

/* Number within limits. */
static double within(double low, double number, double high)
{
    return number < low ? low : number > high ? high : number;
}

/* 2 to the power of a number from -1022 to 1023. */
static double power_of_two(int number)
{
    uint64_t bits = (uint64_t)(1023 + number) << 52;
    double power;
    memcpy(&power, &bits, sizeof power);
    return power;
}

/* Number times 2 to the power of -1100 to 1100, rounded once. */
static double doubled(double number, int times)
{
    int first = times < -1000 ? -1000 : times > 1000 ? 1000 : times;
    return number * power_of_two(first) * power_of_two(times - first);
}

static double exponential(double x)
{
    double limited = within(-750.0, x, 710.0);
    double doublings = limited != limited ? 0.0 : (limited * PER_LN2 + WHOLE) - WHOLE;
    double upper = limited - doublings * LN2_UPPER, lower = doublings * LN2_LOWER, rest = upper - lower;
    double square = rest * rest, value = EXPONENTIAL[4];
    for (int term = 3; term >= 0; term--)
        value = EXPONENTIAL[term] + square * value;
    double bend = rest - square * value;
    return doubled(1.0 - ((lower - rest * bend / (2.0 - bend)) - upper), (int)doublings);
}

/* Part of the positive phase that has passed; a pulse without duration is over at once. */
static double passed(double time, double duration)
{
    return duration > 0.0 ? within(0.0, time / duration, 1.0) : 1.0;
}

/* Coefficients of the series of ∫₀¹ uⁿ e^(-y u) du, the last term first: 1 / (k! (k + n + 1)). */
static void find_series(double series[SERIES_TERMS][2])
{
    double factorial = 1.0;
    for (int term = 0; term < SERIES_TERMS; term++) {
        factorial *= term ? term : 1;
        for (int order = 0; order < 2; order++)
            series[SERIES_TERMS - 1 - term][order] = 1.0 / (factorial * (term + order + 1));
    }
}

/* Find ∫₀¹ e^(-y u) du and ∫₀¹ u e^(-y u) du; by a series where the closed form would lose its digits. */
static void find_moments(double series[SERIES_TERMS][2], double exponent, double moments[2])
{
    moments[0] = moments[1] = 0.0;
    if (exponent < SERIES_BELOW) {
        for (int term = 0; term < SERIES_TERMS; term++)
            for (int order = 0; order < 2; order++)
                moments[order] = series[term][order] - exponent * moments[order];
        return;
    }
    double left = exponential(-exponent);
    moments[0] = (1.0 - left) / exponent;
    moments[1] = (moments[0] - left) / exponent;
}

/* Write impulses per area, integrated from the beginning of each interval: short ones lose no digits. */
int bda_impulses_of_pulses(const bda_pulses *p)
{
    double series[SERIES_TERMS][2], moments[2];
    find_series(series);
    for (int64_t pulse = 0; pulse < p->count; pulse++) {
        double duration = p->durations[pulse], first = passed(p->starts[pulse], duration);
        double length = passed(p->ends[pulse], duration) - first;
        find_moments(series, p->decays[pulse] * length, moments);
        double mean = (1.0 - first) * moments[0] - length * moments[1];
        double left = exponential(-p->decays[pulse] * first);
        p->impulses[pulse] = p->peaks[pulse] * duration * left * length * mean;
    }
    return BDA_DONE;
}

/* Write areas that bodies show to charges: ½ Σ |n̂ · n̂ᵢ| Sᵢ over the faces (report of 2019, equation 6). */
int bda_project(const bda_shown_areas *s)
{
    for (int64_t body = 0; body < s->bodies; body++) {
        int64_t first = s->starts[body], count = s->starts[body + 1] - first;
        if (first < 0 || count < 0 || count > s->most_faces || first + count > s->faces)
            return BDA_OUT_OF_RANGE;
        for (int64_t charge = 0; charge < s->charges; charge++) {
            double own[3], vector[3];
            turned_back_at(s->rotations + 9 * body, 1, 0, s->directions + 3 * (body * s->charges + charge), own);
            for (int64_t face = 0; face < count; face++) {
                vector_at(s->face_vectors, s->faces, first + face, vector);
                s->shown[face] = fabs(dot3(vector, own)) / 2.0;
            }
            s->areas[body * s->charges + charge] = total_of(s->shown, count);
        }
    }
    return BDA_DONE;
}
