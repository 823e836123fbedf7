/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A sub-step of an elastic structure: bodies of known mass, held together by connections, and how these share loads.
 *
 * It is solved implicitly (backward Euler): the forces of connections are those at its end, so that no stiffness is too
 * large for it. With the velocities v that bodies would have without connections, stiffness K, damping C, rows J and
 * deformations e at its beginning, the velocities v' at its end follow from
 *
 *     (M + J^T dt (dt K + C) J) (v' - v) = J^T g,    g = dt K e - dt (dt K + C) J v,
 *
 * and the impulses of the connections are g - dt (dt K + C) J (v' - v). D. Baraff and A. Witkin (1998), Large steps in
 * cloth simulation, SIGGRAPH 98, equation 6, for springs in general; here C = beta K. Parts that no connection holds to
 * each other have equations of their own.
 */
#ifndef BDA_SUBSTEP_H
#define BDA_SUBSTEP_H

#include "joints.h"
#include "terms.h"

typedef struct {
    const bda_frames *frames;   /* of m connections */
    const bda_places *places;   /* of n bodies, as the sub-step begins */
    double substep_s, turned_rad;
    const double *velocities;   /* (6, n), at its end without connections */
    const double *masses, *inertias;       /* (n,), kg; (3, 3, n), kg m2, in the axes of the bodies */
    double *assembled_rotations;           /* (3, 3, n), for which rows and equations were made last */
    const double *stiffness, *damping_s;   /* (6, 6, m); (m,) */
    joint_rows *rows;           /* (m,), rows of connections as they were made last */
    /* Parts, and which bodies (n,), and connections and bare bars (m + g,), are of each; -1 for none. */
    int64_t parts, bars;
    bda_equations *const *equations;       /* (p,) */
    const int64_t *part_starts, *part_bodies; /* (p + 1,), (b,), bodies one part after another */
    const int64_t *part_of_body, *part_of_connection, *within_part;
    uint8_t *stale;             /* (p + 1,), whose rows and equations are to be made again; the last is of none */
    const uint8_t *awake;       /* (p + 1,) */
    /* Connections (k,) that act, in ascending order, and deformations (6, m), of which offsets are without load. */
    int64_t acting_count;
    const int64_t *acting;
    const double *offsets;
    int64_t term_count;
    bda_term *const *terms;     /* (t,) */
    int64_t most_guesses;
    int64_t from_rest;          /* whether guesses begin with no motion, and not with that of the last sub-step */
    /* What comes of it: deformations (6, m) of those that act, as it begins, rates (6, k), impulses (6, k) on both
     * bodies, their sums (6, n), velocities (6, n) at the end. */
    double *deformations, *rates, *of_first, *of_second, *of_bodies, *ends;
    int64_t guesses, factorings; /* how many there were */
    bda_not_finite wrong;        /* what was not finite, where the answer is that something was not */
} bda_substep;

BDA_API int bda_begin_term(const bda_term *term, const bda_places *places);
BDA_API int bda_solve_substep(bda_substep *substep);

#endif
