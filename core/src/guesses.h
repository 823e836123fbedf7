/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Guesses of forces that are not proportional to motion, followed in a sub-step until they agree (Newton).
 *
 * The equations hold forces that are linear about a guess of how far gaps open. The motion that solves them is the next
 * guess. On the way from one to the other, the forces that are in balance with all else change evenly, so that the slope
 * of the energy is the work of what the gaps resist beyond these. Each part of the structure goes as far as its slope is
 * below 0. The energy is convex: so each guess takes energy off, and guesses end (J. Nocedal and S. J. Wright, 2006,
 * Numerical optimization, chapter 3).
 */
#ifndef BDA_GUESSES_H
#define BDA_GUESSES_H

#include "terms.h"

/* Terms of a sub-step, and what is of each of p parts of the structure and, last, of what belongs to none. */
typedef struct {
    int64_t count, parts;
    guessed_term *terms;
    int are_first;             /* whether there was no guess before the next one: then there is no way to it */
    uint8_t *open, *off, *seek; /* (p + 1,), whose guess is not the last; does not agree with the motion; is sought */
    double *shares;            /* (p + 1,), of the way to the next guess */
    double *low, *share, *at_low, *at_high, *at_share, *flat; /* (p + 1,), of that search */
} guesses;

void guess_no_motion(guesses *guesses);
int guess_again(guesses *guesses, const double *velocities, int64_t bodies, double substep_s);

#endif
