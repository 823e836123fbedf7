/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Springs between two bodies, one above the other: footings on soil, and pads of bearings. They press upwards by their
 * stiffness up to their capacity, and hold sideways up to friction.
 */
#ifndef BDA_SPRINGS_H
#define BDA_SPRINGS_H

#include <math.h>

#include "joints.h"
#include "terms.h"

/* Where p springs are: on bodies above and below, at anchors (3, p) from the centres of these, in their axes. */
typedef struct {
    int64_t count;
    const int64_t *above, *below;
    const double *anchors_above, *anchors_below;
} bda_spring_places;

/* Stiffness (p,) upwards, (2, p) along x and y; largest pressing force, friction, which may be infinite, and pressing
 * force by which they hold sideways (p,); whether they hold what is lifted. */
typedef struct {
    int64_t count;
    const double *vertical, *sideways, *capacity, *friction, *pressed;
    const uint8_t *pulls;
} bda_spring_law;

/* All springs of c connections, and what has become of them by now. */
typedef struct {
    const bda_spring_places *at;
    const bda_spring_law *law;
    int64_t connections;
    const int64_t *of;        /* (p,), connection of each, in ascending order */
    double *free;             /* (3, p), gaps at which they resist nothing */
    double *holding;          /* (p,), pressing forces by which they hold sideways: `pressed` of the law */
    double *touching;         /* (c,), part of the stiffness of each connection that acts */
} bda_springs;

/* Bearings, of whose pads these are the springs. */
typedef struct {
    int64_t bearings;
    const int64_t *numbers, *first, *second; /* (c,), bearing and bodies of each connection */
    const uint8_t *pulls;                    /* (c,), whether it holds what is lifted */
    const double *travel, *breaking;         /* (c,), m and N, displacement and force at which it is left or breaks */
    const double *built_turns;               /* (3, 3, c), first bodies in the axes of second ones */
    double lifted, least_cosines, overturned; /* m; 1 + 2 cos of angles from which on edges carry, and none holds */
    double *pressed;                         /* (p,), pressing forces as they were solved last, none before that */
    double *forces;                          /* (3, c), on what lies above */
    double *whole;                           /* (3, b), room for sums of bearings */
    uint8_t *gone;                           /* (c,), whether its bodies have left each other */
} bda_pads;

BDA_API int bda_springs_energy(const bda_springs *springs, const bda_places *places, double *energies);
BDA_API int bda_soil_settle(const bda_springs *springs, const bda_places *places);
BDA_API int bda_pads_settle(const bda_springs *springs, const bda_pads *pads, const bda_places *places);
BDA_API int bda_pads_failed(const bda_springs *springs, const bda_pads *pads, const int64_t *rows,
                            const uint8_t *intact, const double *left, uint8_t *failed);

int begin_springs(const bda_springs *springs, const bda_places *places, const bda_term *term);

/* Force of a spring on what lies above, and by how much it falls with the gap. */
static inline void force_of_spring(const bda_spring_law *s, int64_t row, const double gap[3], double force[3],
                                   double tangent[3][3])
{
    double wanted = -s->vertical[row] * gap[2], held[2], limit;
    int acts = s->pulls[row] || wanted > 0.0;
    force[2] = acts ? (wanted < s->capacity[row] ? wanted : s->capacity[row]) : 0.0;
    for (int axis = 0; axis < 2; axis++)
        held[axis] = -s->sideways[axis * s->count + row] * gap[axis];
    double size = sqrt(held[0] * held[0] + held[1] * held[1]);
    if (s->friction[row] < INFINITY)
        limit = s->friction[row] * s->pressed[row];
    else
        limit = s->pulls[row] || s->pressed[row] > 0.0 ? INFINITY : 0.0;
    int slides = size > limit;
    double share = slides ? limit / size : 1.0, across = slides ? share / (size * size) : 0.0;
    for (int axis = 0; axis < 3; axis++)
        for (int other = 0; other < 3; other++)
            tangent[axis][other] = 0.0;
    tangent[2][2] = s->vertical[row] * (acts && wanted < s->capacity[row] ? 1.0 : 0.0);
    for (int axis = 0; axis < 2; axis++) {
        force[axis] = share * held[axis];
        for (int other = 0; other < 2; other++) {
            double whole = axis == other ? s->sideways[axis * s->count + row] : 0.0;
            tangent[axis][other] =
                whole * share - across * held[axis] * held[other] * s->sideways[other * s->count + row];
        }
    }
}

#endif
