/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bars that stand bare between two bodies, in groups that are alike: they yield in tension and rupture; in compression
 * they yield or buckle, and then fold in three plastic hinges, at their ends and in their middle.
 */
#ifndef BDA_CAGES_H
#define BDA_CAGES_H

#include "joints.h"
#include "terms.h"

/* g groups, and what has become of them by now. */
typedef struct {
    int64_t count;
    const int64_t *first, *second;                       /* (g,), bodies */
    const double *first_anchors, *second_anchors;        /* (3, g), in the axes of these, from their centres */
    const double *bared, *counts, *shares;               /* (g,), length, bars, part that is counted on */
    const double *squash, *most, *arms;                  /* (g,), of one bar: yield, largest in compression, 2 M / N of hinges */
    const double *stiffness;                             /* (g,) */
    double *stays, *pressed;                             /* (g,), elongation that stays, largest force in compression */
    uint8_t *holds;                                      /* (g,) */
    double rupture_strain, folded_up;                    /* by the bared length */
} bda_cages;

BDA_API int bda_cages_settle(const bda_cages *cages, const bda_places *places);

int begin_cages(const bda_cages *cages, const bda_places *places, const bda_term *term);

#endif
