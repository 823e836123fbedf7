/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Blast waves in a sub-step: impulses of pulses, and areas that bodies show to charges.
 */
#ifndef BDA_BLAST_H
#define BDA_BLAST_H

#include "core.h"
#include "vectors.h"

/* Friedlander's pulses from start to end, s after their fronts arrived: p(τ) = p₀ (1 - τ/t_d) e^(-b τ/t_d) (1946). */
typedef struct {
    int64_t count;
    const double *peaks, *durations, *decays; /* (k,), p₀, t_d, b */
    const double *starts, *ends;              /* (k,) */
    double *impulses;                         /* (k,) */
} bda_pulses;

/* Convex hulls of n bodies, and unit vectors from c charges to them. */
typedef struct {
    int64_t bodies, charges, faces, most_faces;
    const double *face_vectors; /* (3, f), normals times areas, in the axes of the bodies */
    const int64_t *starts;      /* (n + 1,), first face of each body */
    const double *rotations;    /* (n, 3, 3) */
    const double *directions;   /* (n, c, 3) */
    double *shown;              /* room for the faces of a body */
    double *areas;              /* (n, c) */
} bda_shown_areas;

BDA_API int bda_impulses_of_pulses(const bda_pulses *pulses);
BDA_API int bda_project(const bda_shown_areas *shown);

#endif
