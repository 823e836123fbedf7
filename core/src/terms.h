/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Forces that are not proportional to motion, across gaps between points on two bodies: cracks that bars hold together,
 * springs of footings and bearings, and bars that stand bare. In a sub-step each is linear about a guess of how far its
 * gaps open; `guesses` finds guesses that agree.
 */
#ifndef BDA_TERMS_H
#define BDA_TERMS_H

#include "equations.h"

enum { CRACKS = 0, SPRINGS = 1, BARE_BARS = 2 };
enum { CORNERS = 4 };

/* c connections with q gaps, as a sub-step begins. Gaps of cracks come corner by corner, in each all cracks; those of
 * springs in the order of their connections, from the body below to the one above; bare bars have one each. */
typedef struct {
    int64_t kind, connections, gaps, all_gaps;
    const void *law;                        /* bda_cracks, bda_springs or bda_cages; none where nobody begins it */
    const int64_t *chosen;                  /* (c,), which of the cracks of the law */
    const int64_t *numbers;                 /* (c,), among all that connects bodies */
    int64_t *of_gap;                  /* (q,), connection of each gap */
    int64_t *which;                   /* (q,), number of each gap among all gaps (p,) of its kind */
    int64_t *first, *second;                /* (q,), bodies */
    double *first_arms, *second_arms;       /* (3, q), m, from the centres of the bodies to where forces act */
    double *widths;                         /* (3, q), m, from the first points to the second, or from no force */
    double *remembered;                     /* (12, p), of the last sub-step: N/m, tangents (3, 3) of the equations, m, */
                                            /* and how far gaps opened (3,); not a number where there was none */
    double *tangents;                       /* (3, 3, q), N/m, of the last guess */
    double *of_first, *of_second;           /* (6, c), impulses on both bodies of each connection */
    /* Bars: of a crack (q,), (3, q), in the axes of the world; `stiffness` and `yields` of bare ones, too. */
    double *yields, *stiffness, *modulus, *slips, *flows, *directions;
    /* Sides of a crack, which press and rub. */
    double *normals, *pressed, *rests, *grips;
    double dowel, sheared;
    /* Springs. */
    const double *vertical, *sideways, *capacity, *friction;
    double *pressed_by;
    const uint8_t *pulls, *above_first; /* (q,); (c,) */
    double *solved_pressed;             /* (p,), N, pressing forces as they are solved; NULL where nobody asks */
    /* Bare bars. */
    double *lengths;
    const double *bared;
    double *stays, *pulled_limits, *pressed_limits;
    const double *bared_lines;
    uint8_t *holds;
    int64_t held_sideways;
} bda_term;

/* A term with its guesses. */
typedef struct {
    bda_term *term;
    int components;                  /* d, of forces and motion: 1 along bare bars, otherwise 3 */
    const int64_t *part, *within;    /* (c,), part of the structure of each connection, and its number there */
    int64_t *first_body, *second_body; /* (c,) */
    double *slack;                   /* (q,), errors of forces that count as none */
    double *at_rest;                 /* (d, q), forces without motion, linear about the guess */
    double *moved, *guessed, *resisted; /* (d, q), motion, forces in balance with all else and by the law, at the guess */
    double *next_moved, *next_guessed, *next_resisted; /* (d, q), and where the equations with it are solved */
    double *stiff;                   /* (q,), of bare bars, along themselves */
    uint8_t *changed;                /* (c,), whether tangents differ from those in the equations */
} guessed_term;

BDA_API int bda_try_term(bda_term *term, const double *moved, double *forces);

void begin_at(guessed_term *term, int64_t gap, const double moved[3]);
void begin_as_remembered(guessed_term *term);
void remember(const guessed_term *term);
void find_slack(guessed_term *term);
void moved_by(const guessed_term *term, int64_t gap, const double *velocities, int64_t bodies, double substep_s,
              double moved[3]);
void resisted_at(const guessed_term *term, int64_t gap, const double moved[3], double force[3]);
void linear_at(const guessed_term *term, int64_t gap, const double moved[3], double force[3]);
void find_impulses(guessed_term *term, const double *velocities, int64_t bodies, double substep_s,
                   const uint8_t *of_parts, double *sums);
void find_changed(guessed_term *term);
void blocks_of_gaps(guessed_term *term, int64_t connection, int64_t first_gap, double substep_s,
                    blocks_of_connection *blocks);

#endif
