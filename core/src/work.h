/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Work between bodies: of impulses, what of it is energy that is taken or made, and what bodies that touch give back.
 */
#ifndef BDA_WORK_H
#define BDA_WORK_H

#include "core.h"
#include "vectors.h"

/* Impulses of k pairs on the first of n bodies, which have mean velocities at the origin, and angular ones. */
typedef struct {
    int64_t count, bodies;
    const int64_t *first, *second;         /* (k,) */
    const double *impulses, *points;       /* (3, k) */
    const double *angular;                 /* (3, k), impulses of moments about the points; none of contacts */
    const double *motion;                  /* (6, n) */
    double *on_first, *on_second;          /* (k,), works */
} bda_works;

/* Work between k pairs of n bodies. */
typedef struct {
    int64_t count, bodies;
    const int64_t *first, *second;              /* (k,) */
    const double *total, *on_first, *on_second; /* (k,), works on both, and with the motion of each */
    const double *returned;                     /* (k,), part that was taken before; none where nothing comes back */
    const uint8_t *is_free;                     /* (n,), whether a body moves freely, and is not led */
    double *taken;                              /* (k,), less what comes back of it, as negative numbers */
    int64_t *rows;                              /* (k,), pairs that make energy */
    double *made;                               /* (k,), by them */
    double *by_first, *by_second;               /* (n,), added to: of it, what bodies get */
    int64_t makers;                             /* how many make energy */
} bda_shared_work;

/* Accounts of pairs that touch, and their work in sub-steps. */
typedef struct {
    int64_t count, substeps, substep, apart;
    const int64_t *pairs;        /* (k,), numbers of pairs, each once in a sub-step */
    const double *work;          /* (k,) */
    const int64_t *order;        /* (k,), rows of each sub-step by the numbers of their pairs */
    const int64_t *ends;         /* (s + 1,) */
    double *returned;            /* (k,) 0: what is given back of what was taken before */
    int64_t room, known, side;   /* accounts in one half of each array, up to the number after those of all pairs */
    int64_t *all_pairs;          /* (2, c), in ascending order */
    double *taken;               /* (2, c) */
    int64_t *last;               /* (2, c), sub-steps in which they last did work */
} bda_touches;

BDA_API int bda_find_works(const bda_works *works);
BDA_API int bda_share_work(bda_shared_work *work);
BDA_API int bda_book_touches(bda_touches *touches);

#endif
