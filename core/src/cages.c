/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cages.h"

#include <math.h>

/* A group: line from its first point to its second, its length, arms on both bodies, and largest forces. */
typedef struct {
    double line[3], length, first_arm[3], second_arm[3], pulled, pressed;
} standing_bars;

/* Part of its yield force with which a bar resists folding: hinges resist N w = 2 M, M = M_p (1 - (N / N_p)^2), with the
 * bow w of a bar whose ends have come closer (N. Jones, 2011, Structural Impact, 2nd edition, chapter 9). */
static double share_of_hinges(double bared, double folded, double arm)
{
    double closer = folded / bared, straight = 1.0 - (closer < 0.0 ? 0.0 : closer > 1.0 ? 1.0 : closer);
    double bow = 0.5 * bared * sqrt(1.0 - straight * straight);
    return (sqrt(bow * bow + 4.0 * arm * arm) - bow) / (2.0 * arm);
}

static int find_bars(const bda_cages *c, const bda_places *p, int64_t row, standing_bars *bars)
{
    int64_t one = c->first[row], other = c->second[row];
    if (one < 0 || one >= p->count || other < 0 || other >= p->count)
        return BDA_OUT_OF_RANGE;
    lever_at(p->rotations, p->count, one, c->first_anchors, c->count, row, bars->first_arm);
    lever_at(p->rotations, p->count, other, c->second_anchors, c->count, row, bars->second_arm);
    line_between(p, one, other, bars->first_arm, bars->second_arm, bars->line);
    bars->length = sqrt(dot3(bars->line, bars->line));
    double folded = c->stays[row] < 0.0 ? -c->stays[row] : 0.0;
    double resists = share_of_hinges(c->bared[row], folded, c->arms[row]) * c->squash[row];
    double folding = c->counts[row] * (resists < c->most[row] ? resists : c->most[row]);
    bars->pulled = c->shares[row] * (folded > 0.0 ? folding : c->counts[row] * c->squash[row]);
    bars->pressed = c->shares[row] * folding;
    return BDA_DONE;
}

/* Force along a group, above 0 in tension. */
static double force_of(const bda_cages *c, int64_t row, const standing_bars *bars)
{
    double force = c->stiffness[row] * (bars->length - c->bared[row] - c->stays[row]);
    force = force < -bars->pressed ? -bars->pressed : force;
    return (c->holds[row] ? 1.0 : 0.0) * (force > bars->pulled ? bars->pulled : force);
}

/* Take over what has yielded, folded or ruptured by now. */
int bda_cages_settle(const bda_cages *c, const bda_places *p)
{
    for (int64_t row = 0; row < c->count; row++) {
        standing_bars bars;
        TRY(find_bars(c, p, row, &bars));
        double force = force_of(c, row, &bars);
        c->pressed[row] = larger(c->pressed[row], -force);
        if (c->holds[row])
            c->stays[row] = bars.length - c->bared[row] - force / c->stiffness[row];
        if (c->stays[row] > c->rupture_strain * c->bared[row] || bars.length < c->folded_up * c->bared[row])
            c->holds[row] = 0;
    }
    return BDA_DONE;
}

/* Write how the groups of a term are as a sub-step begins. */
int begin_cages(const bda_cages *c, const bda_places *p, const bda_term *t)
{
    if (t->gaps != t->connections)
        return BDA_OUT_OF_RANGE;
    for (int64_t row = 0; row < t->gaps; row++) {
        int64_t group = t->which[row];
        standing_bars bars;
        if (group < 0 || group >= c->count || find_bars(c, p, group, &bars) != BDA_DONE)
            return BDA_OUT_OF_RANGE;
        put_vector(t->widths, t->gaps, row, bars.line);
        put_vector(t->first_arms, t->gaps, row, bars.first_arm);
        put_vector(t->second_arms, t->gaps, row, bars.second_arm);
        for (int axis = 0; axis < 3; axis++)
            t->directions[axis * t->gaps + row] = bars.line[axis] / (bars.length > 0.0 ? bars.length : 1.0);
        t->lengths[row] = bars.length;
        t->stays[row] = c->stays[group];
        t->pulled_limits[row] = bars.pulled;
        t->pressed_limits[row] = bars.pressed;
        t->holds[row] = c->holds[group];
    }
    return BDA_DONE;
}
