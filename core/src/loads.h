/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Loads of a frame: sums over the connections of bodies, peaks, impulses, and the average stress in bodies.
 */
#ifndef BDA_LOADS_H
#define BDA_LOADS_H

#include "core.h"
#include "vectors.h"

/* Loads of m connections between n bodies in s sub-steps, on first bodies. */
typedef struct {
    int64_t substeps, connections, bodies;
    const int64_t *pairs;                /* (m, 2) */
    const double *forces, *moments;      /* (3, s, m) */
    const double *signs;                 /* (s, m), numbers that first bodies get, and second ones lose */
    const double *lengths;               /* (s,), of sub-steps */
    double *impulses;                    /* (6, m), added to: of forces, of moments */
    double *peaks;                       /* (7, m), followed: size of the largest force, this force, its moment */
    double *of_first, *of_second;        /* (5, s, n), added to: forces, sizes of these, numbers */
} bda_frame_loads;

/* Forces of k pairs of n bodies, and moments about points in faces with normals, on first bodies. */
typedef struct {
    int64_t count, bodies;
    const int64_t *pairs;                     /* (k, 2) */
    const double *forces, *points;            /* (k, 3) */
    const double *moments, *normals;          /* (k, 3); none where only forces act */
    const double *centres, *volumes;          /* (n, 3), (n,) */
    double *of_forces, *of_moments;           /* (n, 3, 3), added to: sums of products */
    double *stresses;                         /* (n, 3, 3) */
} bda_surface_loads;

BDA_API int bda_add_frame_loads(const bda_frame_loads *loads);
BDA_API int bda_stresses(const bda_surface_loads *loads);

#endif
