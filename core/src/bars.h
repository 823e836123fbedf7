/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Reinforcing bars across a crack: elastic up to their yield force, then with hardening, and elastic again when unloaded
 * (EN 1992-1-1:2004, 3.2.7 (2) a). Pulled askew, their force has the direction in which the sides have parted, and the
 * part that stays follows the force (J. C. Simo and T. J. R. Hughes, 1998, Computational inelasticity, chapter 1).
 */
#ifndef BDA_BARS_H
#define BDA_BARS_H

#include <math.h>

#include "vectors.h"

typedef struct {
    double yields, stiffness, modulus; /* N, N/m, and growth of the yield force with the part of the stretch that stays */
} bar_law;

/* What bars do under a stretch: force as if they did not yield, its size, how far they yield, part of it that is left. */
typedef struct {
    double trial[3], size, flow, share;
} bar_force;

/* Bars that yield at a force and rupture once a crack has opened so far. */
static inline bar_law law_of_bars(double yields, double opening, double yield_strain, double hardening,
                                  double rupture_strain)
{
    double at_yield = opening * yield_strain / rupture_strain;
    double stiffness = yields / at_yield, slope = (hardening - 1.0) * yields / (opening - at_yield);
    return (bar_law){yields, stiffness, stiffness * slope / (stiffness > 0.0 ? stiffness - slope : 1.0)};
}

/* By how much bars that yield fall short of elastic ones, by the part of their stretch that stays. */
static inline double resistance(const bar_law *law)
{
    return law->stiffness > 0.0 ? law->stiffness + law->modulus : 1.0;
}

static inline bar_force force_of_bar(const bar_law *law, const double stretch[3], const double slip[3], double flowed)
{
    bar_force bar;
    for (int axis = 0; axis < 3; axis++)
        bar.trial[axis] = law->stiffness * (stretch[axis] - slip[axis]);
    bar.size = sqrt(dot3(bar.trial, bar.trial));
    double beyond = bar.size - law->yields - law->modulus * flowed;
    bar.flow = (beyond > 0.0 ? beyond : 0.0) / resistance(law);
    bar.share = 1.0 - (bar.size > 0.0 ? law->stiffness * bar.flow / bar.size : 0.0);
    return bar;
}

/* Slip that stays under a force. */
static inline void slip_of_bar(const bar_force *bar, const double before[3], double slip[3])
{
    for (int axis = 0; axis < 3; axis++)
        slip[axis] = before[axis] + bar->flow * (bar->size > 0.0 ? bar->trial[axis] / bar->size : 0.0);
}

/* Stretch of a bar by a gap: less across itself, as a dowel. */
static inline void stretch_of_bar(const double gap[3], const double direction[3], double dowel, double stretch[3])
{
    double along = dot3(gap, direction);
    for (int axis = 0; axis < 3; axis++)
        stretch[axis] = dowel * gap[axis] + (1.0 - dowel) * along * direction[axis];
}

/* Part of a gap along the sides of a crack. */
static inline void slide_of_gap(const double gap[3], const double normal[3], double opened, double slid[3])
{
    for (int axis = 0; axis < 3; axis++)
        slid[axis] = gap[axis] - opened * normal[axis];
}

#endif
