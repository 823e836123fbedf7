/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Cracks that reinforcement holds together, in place of connections that broke: their state from sub-step to sub-step.
 *
 * At each of four corners is a quarter of the bars, or what resists the same moments. There the sides press on each
 * other where the crack is closed, and rub on each other as far as they were pressed as the sub-step began.
 */
#ifndef BDA_CRACKS_H
#define BDA_CRACKS_H

#include "joints.h"
#include "terms.h"

/* t cracks of m connections, q = 4 t corners, one corner after another; vectors are in the axes of the first bodies. */
typedef struct {
    int64_t count, connections;
    const int64_t *rows;                        /* (t,), connections that they are in place of */
    const int64_t *first, *second;              /* (q,), bodies */
    const double *first_anchors, *second_anchors, *normals, *directions; /* (3, q) */
    double *slips, *flows, *rests, *grips;      /* (3, q), (q,), (3, q), (q,) */
    uint8_t *holds, *meets;                     /* (q,), whether bars have not ruptured, sides have not slid off */
    double *remembered;                         /* (12, q), as in terms */
    /* Of connections: forces at which bars at corners yield (4, m), part of them that is left, openings at which they
     * rupture, stiffness of pressed sides, steel (m,). */
    const double *yields, *shares, *openings, *pressed, *yield_strain, *hardening, *rupture_strain;
    double dowel, sheared, friction;
} bda_cracks;

enum { CRACK_STATES = 8 };

/* Frames on both bodies, in their axes, of Bullet's rows in place of c cracks; softness and deformations of the rows at
 * the end of a sub-step, if nothing else acts. n bodies have velocities (6, n) there. */
typedef struct {
    int64_t bodies;
    double substep_s;
    const double *inverse_masses, *inverse_inertias, *velocities;      /* (n,); (3, 3, n); (6, n) */
    double *first_axes, *first_points, *second_axes, *second_points; /* (3, 3, c), as columns; (3, c) */
    double *softness, *deformations;                                  /* (6, c) */
} bda_expected_cracks;

BDA_API int bda_cracks_settle(const bda_cracks *cracks, const bda_places *places, uint8_t *holds);
BDA_API int bda_cracks_grip(const bda_cracks *cracks, const bda_places *places);
BDA_API int bda_cracks_state(const bda_cracks *cracks, const bda_places *places, double *states);
BDA_API int bda_expect_cracks(const bda_term *term, const bda_places *places, const bda_expected_cracks *expected);

int begin_cracks(const bda_cracks *cracks, const bda_places *places, const bda_term *term);

#endif
