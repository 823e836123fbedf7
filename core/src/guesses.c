/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "guesses.h"

#include <math.h>
#include <string.h>

enum { MOST_SECANTS = 12 };

/* Slope of the energy on the way from one guess to the next, by that at its beginning, which is taken for none. */
static const double FLAT = 0.01;

/* Take over the motion that solves the equations; note the parts whose gaps do not resist what was guessed. */
static void take(guessed_term *g, const double *velocities, int64_t bodies, double substep_s, const uint8_t *open,
                 uint8_t *off)
{
    const bda_term *t = g->term;
    for (int64_t row = 0; row < t->gaps; row++) {
        int64_t part = g->part[t->of_gap[row]];
        double moved[3], guessed[3], resisted[3];
        if (!open[part])
            continue;
        moved_by(g, row, velocities, bodies, substep_s, moved);
        linear_at(g, row, moved, guessed);
        resisted_at(g, row, moved, resisted);
        for (int axis = 0; axis < g->components; axis++) {
            int64_t at = axis * t->gaps + row;
            g->next_moved[at] = moved[axis];
            g->next_guessed[at] = guessed[axis];
            g->next_resisted[at] = resisted[axis];
            if (fabs(resisted[axis] - guessed[axis]) > g->slack[row])
                off[part] = 1;
        }
    }
}

/* Motion of a gap at a share of the way from one guess to the next. */
static void on_the_way(const guessed_term *g, int64_t row, double share, double moved[3])
{
    for (int axis = 0; axis < g->components; axis++) {
        int64_t at = axis * g->term->gaps + row;
        moved[axis] = g->moved[at] + share * (g->next_moved[at] - g->moved[at]);
    }
}

/* What a gap resists at a share of the way; at both ends it is known. */
static void resisted_on_the_way(const guessed_term *g, int64_t row, double share, double resisted[3])
{
    double moved[3];
    if (share == 0.0 || share == 1.0) {
        for (int axis = 0; axis < g->components; axis++)
            resisted[axis] = (share == 0.0 ? g->resisted : g->next_resisted)[axis * g->term->gaps + row];
        return;
    }
    on_the_way(g, row, share, moved);
    resisted_at(g, row, moved, resisted);
}

/* Add the slopes of the energy of a term's parts that are sought, at shares (p + 1,) of their ways. */
static void add_slopes(const guessed_term *g, const double *shares, const uint8_t *sought, double *slopes)
{
    const bda_term *t = g->term;
    for (int64_t row = 0; row < t->gaps; row++) {
        int64_t part = g->part[t->of_gap[row]];
        double resisted[3];
        if (!sought[part])
            continue;
        resisted_on_the_way(g, row, shares[part], resisted);
        for (int axis = 0; axis < g->components; axis++) {
            int64_t at = axis * t->gaps + row;
            double guessed = g->guessed[at] + shares[part] * (g->next_guessed[at] - g->guessed[at]);
            slopes[part] += (resisted[axis] - guessed) * (g->next_moved[at] - g->moved[at]);
        }
    }
}

static void slopes_at(guesses *all, const double *shares, double *slopes)
{
    memset(slopes, 0, (size_t)(all->parts + 1) * sizeof *slopes);
    for (int64_t number = 0; number < all->count; number++)
        add_slopes(all->terms + number, shares, all->seek, slopes);
}

/* Begin the search of how far each part goes; return whether there is one whose slope becomes 0 on its way. */
static int begin_search(guesses *all)
{
    int any = 0;
    for (int64_t part = 0; part <= all->parts; part++)
        all->low[part] = 0.0, all->shares[part] = 1.0, all->seek[part] = all->off[part];
    slopes_at(all, all->low, all->at_low);
    slopes_at(all, all->shares, all->at_high);
    for (int64_t part = 0; part <= all->parts; part++) {
        all->flat[part] = FLAT * fabs(all->at_low[part]);
        all->seek[part] = all->off[part] && all->at_low[part] < 0.0 && all->at_high[part] > all->flat[part];
        any |= all->seek[part];
    }
    return any;
}

/* Take over the slope at a share of the way of a part. */
static void narrow(guesses *all, int64_t part)
{
    double share = all->share[part], slope = all->at_share[part];
    if (slope < -all->flat[part]) {
        all->low[part] = share, all->at_low[part] = slope, all->at_high[part] *= 0.5;
    } else {
        all->shares[part] = share;
        if (slope > all->flat[part])
            all->at_high[part] = slope, all->at_low[part] *= 0.5;
        else
            all->seek[part] = 0;
    }
}

/* Find how far each part goes on its way: to where its slope, which grows from below 0, becomes 0; at most 1.
 * M. Dowell and P. Jarratt (1971), A modified regula falsi method for computing the root of an equation, BIT 11, for the
 * Illinois method. */
static void find_shares(guesses *all)
{
    int any = begin_search(all);
    for (int secant = 0; any && secant < MOST_SECANTS; secant++) {
        for (int64_t part = 0; part <= all->parts; part++) {
            double low = all->low[part], high = all->shares[part];
            double at_low = all->at_low[part], at_high = all->at_high[part];
            all->share[part] = all->seek[part] ? (low * at_high - high * at_low) / (at_high - at_low) : high;
        }
        slopes_at(all, all->share, all->at_share);
        any = 0;
        for (int64_t part = 0; part <= all->parts; part++) {
            if (all->seek[part])
                narrow(all, part);
            any |= all->seek[part];
        }
    }
}

/* Take forces for linear about the guess at shares (p + 1,) of the ways, of parts that are off. */
static void go(guessed_term *g, const double *shares, const uint8_t *off)
{
    const bda_term *t = g->term;
    for (int64_t row = 0; row < t->gaps; row++) {
        int64_t part = g->part[t->of_gap[row]];
        double moved[3];
        if (!off[part])
            continue;
        on_the_way(g, row, shares[part], moved);
        for (int axis = 0; axis < g->components; axis++) {
            int64_t at = axis * t->gaps + row;
            g->guessed[at] += shares[part] * (g->next_guessed[at] - g->guessed[at]);
        }
        begin_at(g, row, moved);
    }
}

/* Begin with no motion in the parts that are open. */
void guess_no_motion(guesses *all)
{
    const double none[3] = {0.0, 0.0, 0.0};
    for (int64_t number = 0; number < all->count; number++) {
        guessed_term *g = all->terms + number;
        for (int64_t row = 0; row < g->term->gaps; row++)
            if (all->open[g->part[g->term->of_gap[row]]])
                begin_at(g, row, none);
    }
    all->are_first = 1;
}

/* Return whether forces do not agree with the velocities (6, n) that solve the equations; then guess others. Parts that
 * agree are not open any more. */
int guess_again(guesses *all, const double *velocities, int64_t bodies, double substep_s)
{
    int any = 0;
    memset(all->off, 0, (size_t)(all->parts + 1));
    for (int64_t number = 0; number < all->count; number++)
        take(all->terms + number, velocities, bodies, substep_s, all->open, all->off);
    for (int64_t part = 0; part <= all->parts; part++) {
        any |= all->off[part];
        all->open[part] = all->off[part];
        all->shares[part] = 1.0;
    }
    if (!any)
        return 0;
    if (!all->are_first) /* there is no way from a guess that was in balance with nothing */
        find_shares(all);
    for (int64_t number = 0; number < all->count; number++)
        go(all->terms + number, all->shares, all->off);
    all->are_first = 0;
    return 1;
}
