/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "terms.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bars.h"
#include "springs.h"

static const double AGREES = 1e-4;   /* largest error of a force, by what its bars yield at, or the mean of springs */
static const double LITTLE_M = 1e-5; /* or presses the sides of a crack together so far */
static const double EVEN_M = 1e-10;  /* deformation of a spring up to which it counts as none */

static bar_law bars_of(const bda_term *t, int64_t row)
{
    return (bar_law){t->yields[row], t->stiffness[row], t->modulus[row]};
}

/* Sides that rub, as bars that yield at their friction. */
static bar_law sides_of(const bda_term *t, int64_t row)
{
    return (bar_law){t->grips[row], t->sheared * t->pressed[row], 0.0};
}

/* Force across a crack whose gap is `gap`, of bars, of sides that rub, and of sides that are pressed where it is closed. */
static void crack_at(const bda_term *t, int64_t row, const double gap[3], bar_force *bar, bar_force *rub,
                     double *opened, double normal[3], double direction[3], double force[3])
{
    double stretch[3], slid[3], slip[3], rest[3], left[3], pull[3];
    vector_at(t->normals, t->gaps, row, normal);
    vector_at(t->directions, t->gaps, row, direction);
    vector_at(t->slips, t->gaps, row, slip);
    vector_at(t->rests, t->gaps, row, rest);
    *opened = dot3(normal, gap);
    bar_law bars = bars_of(t, row), sides = sides_of(t, row);
    stretch_of_bar(gap, direction, t->dowel, stretch);
    *bar = force_of_bar(&bars, stretch, slip, t->flows[row]);
    slide_of_gap(gap, normal, *opened, slid);
    *rub = force_of_bar(&sides, slid, rest, 0.0);
    double pressing = t->pressed[row] * (*opened < 0.0 ? *opened : 0.0);
    for (int axis = 0; axis < 3; axis++)
        left[axis] = bar->share * bar->trial[axis];
    stretch_of_bar(left, direction, t->dowel, pull);
    for (int axis = 0; axis < 3; axis++)
        force[axis] = pull[axis] + rub->share * rub->trial[axis] + pressing * normal[axis];
}

/* Force across the gap of a crack, and how it grows with the gap. */
static void linear_crack(const bda_term *t, int64_t row, const double gap[3], double force[3], double tangent[3][3])
{
    bar_force bar, rub;
    double opened, normal[3], direction[3], unit[3], along[3], turn[3];
    crack_at(t, row, gap, &bar, &rub, &opened, normal, direction, force);
    bar_law bars = bars_of(t, row), sides = sides_of(t, row);
    double even = t->dowel * t->dowel, hardening = bars.modulus / resistance(&bars);
    double bars_across = bars.stiffness * bar.share, rubs_across = sides.stiffness * rub.share;
    double bars_along = bars.stiffness * (bar.flow > 0.0 ? hardening : 1.0);
    double rubs_along = sides.stiffness * (rub.flow > 0.0 ? 0.0 : 1.0);
    double presses = opened < 0.0 ? t->pressed[row] : 0.0;
    unit_of(bar.trial, bar.size, unit);
    stretch_of_bar(unit, direction, t->dowel, along);
    unit_of(rub.trial, rub.size, turn);
    for (int axis = 0; axis < 3; axis++)
        for (int other = 0; other < 3; other++) {
            double total = (presses - rubs_across) * (normal[axis] * normal[other]);
            total += (1.0 - even) * bars_across * (direction[axis] * direction[other]);
            total += (bars_along - bars_across) * (along[axis] * along[other]);
            total += (rubs_along - rubs_across) * (turn[axis] * turn[other]);
            if (axis == other)
                total += even * bars_across + rubs_across;
            tangent[axis][other] = total;
        }
}

static bda_spring_law springs_of(const bda_term *t)
{
    return (bda_spring_law){t->gaps, t->vertical, t->sideways, t->capacity, t->friction, t->pressed_by, t->pulls};
}

/* Force along bare bars that are longer by `moved` than as the sub-step began, above 0 in tension. */
static double force_of_bare_bars(const bda_term *t, int64_t row, double moved)
{
    double force = t->stiffness[row] * (t->lengths[row] - t->bared[row] + moved - t->stays[row]);
    if (force < -t->pressed_limits[row])
        force = -t->pressed_limits[row];
    if (force > t->pulled_limits[row])
        force = t->pulled_limits[row];
    return (t->holds[row] ? 1.0 : 0.0) * force;
}

static void gap_at(const bda_term *t, int64_t row, const double moved[3], double gap[3])
{
    for (int axis = 0; axis < 3; axis++)
        gap[axis] = t->widths[axis * t->gaps + row] + moved[axis];
}

/* Forces that pull the sides of a gap together which has opened further. */
void resisted_at(const guessed_term *g, int64_t row, const double moved[3], double force[3])
{
    const bda_term *t = g->term;
    double gap[3], tangent[3][3];
    if (t->kind == BARE_BARS) {
        force[0] = force_of_bare_bars(t, row, moved[0]);
        return;
    }
    gap_at(t, row, moved, gap);
    if (t->kind == CRACKS) {
        bar_force bar, rub;
        double opened, normal[3], direction[3];
        crack_at(t, row, gap, &bar, &rub, &opened, normal, direction, force);
    } else {
        bda_spring_law springs = springs_of(t);
        force_of_spring(&springs, row, gap, force, tangent);
        for (int axis = 0; axis < 3; axis++)
            force[axis] = -force[axis];
    }
}

static double turned_by_tangents(const bda_term *t, int64_t row, int axis, const double moved[3])
{
    const double *line = t->tangents + 3 * axis * t->gaps + row;
    return line[0] * moved[0] + line[t->gaps] * moved[1] + line[2 * t->gaps] * moved[2];
}

/* The same, linear about the guess. */
void linear_at(const guessed_term *g, int64_t row, const double moved[3], double force[3])
{
    const bda_term *t = g->term;
    if (t->kind == BARE_BARS)
        force[0] = g->at_rest[row] + g->stiff[row] * moved[0];
    else
        for (int axis = 0; axis < 3; axis++)
            force[axis] = g->at_rest[axis * t->gaps + row] + turned_by_tangents(t, row, axis, moved);
}

static void begin_bare_bars(guessed_term *g, int64_t row, double moved)
{
    const bda_term *t = g->term;
    double force = force_of_bare_bars(t, row, moved), direction[3];
    int is_elastic = t->holds[row] && force < t->pulled_limits[row] && force > -t->pressed_limits[row];
    g->stiff[row] = is_elastic ? t->stiffness[row] : 0.0;
    g->at_rest[row] = force - g->stiff[row] * moved;
    g->resisted[row] = force;
    vector_at(t->directions, t->gaps, row, direction);
    double beside = t->held_sideways && t->holds[row] ? t->stiffness[row] : 0.0;
    for (int axis = 0; axis < 3; axis++)
        for (int other = 0; other < 3; other++) {
            double *tangent = t->tangents + (3 * axis + other) * t->gaps + row;
            double product = direction[axis] * direction[other];
            *tangent = g->stiff[row] * product;
            if (t->held_sideways)
                *tangent = *tangent + beside * ((axis == other ? 1.0 : 0.0) - product);
        }
}

/* Take the forces of a gap for linear about one that has opened further, by `moved` (d,). */
void begin_at(guessed_term *g, int64_t row, const double moved[3])
{
    const bda_term *t = g->term;
    double gap[3], force[3], tangent[3][3];
    for (int axis = 0; axis < g->components; axis++)
        g->moved[axis * t->gaps + row] = moved[axis];
    if (t->kind == BARE_BARS) {
        begin_bare_bars(g, row, moved[0]);
        return;
    }
    bda_spring_law springs = springs_of(t);
    gap_at(t, row, moved, gap);
    if (t->kind == CRACKS)
        linear_crack(t, row, gap, force, tangent);
    else
        force_of_spring(&springs, row, gap, force, tangent);
    for (int axis = 0; axis < 3; axis++) {
        double pulling = t->kind == CRACKS ? force[axis] : -force[axis];
        for (int other = 0; other < 3; other++)
            t->tangents[(3 * axis + other) * t->gaps + row] = tangent[axis][other];
        g->resisted[axis * t->gaps + row] = pulling;
        g->at_rest[axis * t->gaps + row] = pulling - turned_by_tangents(t, row, axis, moved);
    }
}

/* Begin with the motion of the last sub-step, as most gaps open or close on. */
void begin_as_remembered(guessed_term *g)
{
    const bda_term *t = g->term;
    for (int64_t row = 0; row < t->gaps; row++) {
        const double *before = t->remembered + 9 * t->all_gaps + t->which[row];
        double moved[3] = {before[0], before[t->all_gaps], before[2 * t->all_gaps]};
        if (isfinite(moved[0]))
            begin_at(g, row, moved);
    }
}

/* Keep the motion for the next sub-step. */
void remember(const guessed_term *g)
{
    const bda_term *t = g->term;
    for (int64_t row = 0; row < t->gaps; row++)
        for (int axis = 0; axis < 3; axis++)
            t->remembered[(9 + axis) * t->all_gaps + t->which[row]] =
                axis < g->components ? g->next_moved[axis * t->gaps + row] : 0.0;
}

static void find_slack_of_cracks(guessed_term *g)
{
    const bda_term *t = g->term;
    for (int64_t crack = 0; crack < t->connections; crack++) {
        double yields = t->yields[crack];
        for (int corner = 1; corner < CORNERS; corner++)
            yields = yields + t->yields[corner * t->connections + crack];
        for (int64_t row = crack; row < t->gaps; row += t->connections) {
            double mean = yields / CORNERS, little = LITTLE_M * t->pressed[row];
            g->slack[row] = AGREES * (mean > little ? mean : little);
        }
    }
}

static void find_slack_of_springs(guessed_term *g)
{
    const bda_term *t = g->term;
    for (int64_t start = 0, end; start < t->gaps; start = end) {
        double sum = 0.0;
        for (end = start; end < t->gaps && t->of_gap[end] == t->of_gap[start]; end++) {
            double largest = 0.0;
            for (int axis = 0; axis < 3; axis++)
                if (fabs(g->at_rest[axis * t->gaps + end]) > largest)
                    largest = fabs(g->at_rest[axis * t->gaps + end]);
            sum += largest;
        }
        for (int64_t row = start; row < end; row++)
            g->slack[row] = AGREES * (sum / (double)(end - start)) + EVEN_M * t->vertical[row];
    }
}

/* Find the errors of forces that count as none, of forces without motion. */
void find_slack(guessed_term *g)
{
    if (g->term->kind == CRACKS)
        find_slack_of_cracks(g);
    else if (g->term->kind == SPRINGS)
        find_slack_of_springs(g);
    else
        for (int64_t row = 0; row < g->term->gaps; row++)
            g->slack[row] = AGREES * g->term->yields[row];
}

/* How fast a gap opens by velocities (6, n) of bodies. */
static void rate_of_gap(const bda_term *t, int64_t row, const double *velocities, int64_t bodies, double rate[3])
{
    int64_t one = t->first[row], other = t->second[row];
    double arm[3], turning[3], of_first[3], of_second[3];
    vector_at(t->second_arms, t->gaps, row, arm);
    vector_at(velocities + 3 * bodies, bodies, other, turning);
    cross3(turning, arm, of_second);
    vector_at(t->first_arms, t->gaps, row, arm);
    vector_at(velocities + 3 * bodies, bodies, one, turning);
    cross3(turning, arm, of_first);
    for (int axis = 0; axis < 3; axis++) {
        double moving = velocities[axis * bodies + other] + of_second[axis];
        rate[axis] = moving - velocities[axis * bodies + one] - of_first[axis];
    }
}

/* How far a gap (d,) opens in a sub-step by velocities (6, n). */
void moved_by(const guessed_term *g, int64_t row, const double *velocities, int64_t bodies, double substep_s,
              double moved[3])
{
    double rate[3], direction[3];
    rate_of_gap(g->term, row, velocities, bodies, rate);
    if (g->term->kind == BARE_BARS) {
        vector_at(g->term->directions, g->term->gaps, row, direction);
        moved[0] = substep_s * dot3(direction, rate);
        return;
    }
    for (int axis = 0; axis < 3; axis++)
        moved[axis] = substep_s * rate[axis];
}

/* Impulse of a gap that pulls its first body towards its second, by velocities (6, n) at the end of the sub-step. */
static void pull_of_gap(const guessed_term *g, int64_t row, const double *velocities, int64_t bodies, double substep_s,
                        double pull[3])
{
    const bda_term *t = g->term;
    double rate[3], moved[3], force[3], direction[3];
    moved_by(g, row, velocities, bodies, substep_s, moved);
    linear_at(g, row, moved, force);
    if (t->kind != BARE_BARS) {
        if (t->solved_pressed)
            t->solved_pressed[t->which[row]] = larger(-force[2], 0.0);
        for (int axis = 0; axis < 3; axis++)
            pull[axis] = substep_s * force[axis];
        return;
    }
    vector_at(t->directions, t->gaps, row, direction);
    for (int axis = 0; axis < 3; axis++)
        pull[axis] = substep_s * force[0] * direction[axis];
    if (t->held_sideways) {
        rate_of_gap(t, row, velocities, bodies, rate);
        for (int axis = 0; axis < 3; axis++)
            moved[axis] = t->widths[axis * t->gaps + row] - t->bared_lines[axis * t->gaps + row] +
                          substep_s * rate[axis];
        double along = dot3(moved, direction), beside = (t->holds[row] ? 1.0 : 0.0) * t->stiffness[row];
        for (int axis = 0; axis < 3; axis++)
            pull[axis] += substep_s * (beside * (moved[axis] - along * direction[axis]));
    }
}

/* Write the impulses of a term on its bodies, and their sums (6, n), by velocities (6, n) at the end of the sub-step, for
 * some parts of the structure (p + 1,), none where NULL is all. */
void find_impulses(guessed_term *g, const double *velocities, int64_t bodies, double substep_s,
                   const uint8_t *of_parts, double *sums)
{
    bda_term *t = g->term;
    int64_t c = t->connections;
    memset(t->of_first, 0, (size_t)(6 * c) * sizeof *t->of_first);
    memset(t->of_second, 0, (size_t)(6 * c) * sizeof *t->of_second);
    for (int64_t row = 0; row < t->gaps; row++) {
        double pull[3], push[3], arm[3], moment[3];
        int64_t at = t->of_gap[row];
        if (of_parts && !of_parts[g->part[at]])
            continue;
        int is_turned = t->kind == SPRINGS && t->above_first[at]; /* its second body is the first of the connection */
        double *on_first = is_turned ? t->of_second : t->of_first, *on_second = is_turned ? t->of_first : t->of_second;
        pull_of_gap(g, row, velocities, bodies, substep_s, pull);
        for (int axis = 0; axis < 3; axis++)
            push[axis] = -pull[axis];
        vector_at(t->first_arms, t->gaps, row, arm);
        cross3(arm, pull, moment);
        for (int axis = 0; axis < 3; axis++) {
            on_first[axis * c + at] += pull[axis];
            on_first[(3 + axis) * c + at] += moment[axis];
        }
        vector_at(t->second_arms, t->gaps, row, arm);
        cross3(arm, push, moment);
        for (int axis = 0; axis < 3; axis++) {
            on_second[axis * c + at] += push[axis];
            on_second[(3 + axis) * c + at] += moment[axis];
        }
    }
    memset(sums, 0, (size_t)(6 * bodies) * sizeof *sums);
    for (int axis = 0; axis < 6; axis++) {
        for (int64_t at = 0; at < c; at++)
            sums[axis * bodies + g->first_body[at]] += t->of_first[axis * c + at];
        for (int64_t at = 0; at < c; at++)
            sums[axis * bodies + g->second_body[at]] += t->of_second[axis * c + at];
    }
}

/* Find which connections have other tangents than their equations. */
void find_changed(guessed_term *g)
{
    const bda_term *t = g->term;
    memset(g->changed, 0, (size_t)t->connections);
    for (int64_t row = 0; row < t->gaps; row++)
        for (int number = 0; number < 9; number++)
            if (t->tangents[number * t->gaps + row] != t->remembered[number * t->all_gaps + t->which[row]])
                g->changed[t->of_gap[row]] = 1;
}

/* Sums over the gaps of a connection, of which its blocks consist: stiffness against shifts, against turns of either
 * body, moments of shifts and of turns. */
typedef struct {
    double pushed[3][3], turning_first[3][3], turning_second[3][3], moments_first[3][3], moments_second[3][3];
    double about_first[3][3], about_second[3][3], about_both[3][3];
} sums_of_gaps;

/* Add the moment of a column of a matrix about an arm to that of sums. */
static void add_moment(double sums[3][3], const double arm[3], double matrix[3][3], int column)
{
    double product[3], forces[3] = {matrix[0][column], matrix[1][column], matrix[2][column]};
    cross3(arm, forces, product);
    for (int axis = 0; axis < 3; axis++)
        sums[axis][column] += product[axis];
}

static void add_gap(sums_of_gaps *s, double tangent[3][3], const double first_arm[3], const double second_arm[3])
{
    double turning_first[3][3], turning_second[3][3];
    for (int axis = 0; axis < 3; axis++) {
        cross3(first_arm, tangent[axis], turning_first[axis]);
        cross3(second_arm, tangent[axis], turning_second[axis]);
        for (int other = 0; other < 3; other++) {
            s->pushed[axis][other] += tangent[axis][other];
            s->turning_first[axis][other] += turning_first[axis][other];
            s->turning_second[axis][other] += turning_second[axis][other];
        }
    }
    for (int column = 0; column < 3; column++) {
        add_moment(s->moments_first, first_arm, tangent, column);
        add_moment(s->moments_second, second_arm, tangent, column);
        add_moment(s->about_first, first_arm, turning_first, column);
        add_moment(s->about_second, second_arm, turning_second, column);
        add_moment(s->about_both, first_arm, turning_second, column);
    }
}

static void put_blocks(const sums_of_gaps *s, double *first, double *second, double *between)
{
    for (int axis = 0; axis < 3; axis++)
        for (int other = 0; other < 3; other++) {
            int at = UNKNOWNS * axis + other;
            first[at] = second[at] = s->pushed[axis][other];
            between[at] = -s->pushed[axis][other];
            first[at + 3] = s->turning_first[axis][other];
            second[at + 3] = s->turning_second[axis][other];
            between[at + 3] = -s->turning_second[axis][other];
            first[at + 18] = s->moments_first[axis][other];
            second[at + 18] = s->moments_second[axis][other];
            between[at + 18] = -s->moments_first[axis][other];
            first[at + 21] = s->about_first[axis][other];
            second[at + 21] = s->about_second[axis][other];
            between[at + 21] = -s->about_both[axis][other];
        }
}

/* Write what a connection adds to the equations, whose gaps begin with `first_gap`, and note its tangents as solved. */
void blocks_of_gaps(guessed_term *g, int64_t connection, int64_t first_gap, double substep_s,
                    blocks_of_connection *blocks)
{
    const bda_term *t = g->term;
    sums_of_gaps sums;
    int is_turned = t->kind == SPRINGS && !t->above_first[connection];
    int64_t stride = t->kind == CRACKS ? t->connections : 1;
    memset(&sums, 0, sizeof sums);
    for (int64_t row = first_gap; row < t->gaps && t->of_gap[row] == connection; row += stride) {
        double tangent[3][3], first_arm[3], second_arm[3];
        for (int number = 0; number < 9; number++) {
            double value = t->tangents[number * t->gaps + row];
            t->remembered[number * t->all_gaps + t->which[row]] = value;
            tangent[number / 3][number % 3] = substep_s * substep_s * value;
        }
        vector_at(t->first_arms, t->gaps, row, first_arm);
        vector_at(t->second_arms, t->gaps, row, second_arm);
        if (t->kind == SPRINGS) /* the body above comes first */
            add_gap(&sums, tangent, second_arm, first_arm);
        else
            add_gap(&sums, tangent, first_arm, second_arm);
    }
    if (is_turned) {
        double between[BLOCK];
        put_blocks(&sums, blocks->of_second, blocks->of_first, between);
        for (int line = 0; line < UNKNOWNS; line++)
            for (int column = 0; column < UNKNOWNS; column++)
                blocks->between[UNKNOWNS * line + column] = between[UNKNOWNS * column + line];
    } else {
        put_blocks(&sums, blocks->of_first, blocks->of_second, blocks->between);
    }
}

/* Write the forces (d, q) that pull the sides of gaps together which have opened further, by `moved` (d, q), and how they
 * change with that. */
int bda_try_term(bda_term *t, const double *moved, double *forces)
{
    double *room = calloc((size_t)(7 * t->gaps + 1), sizeof *room);
    guessed_term g = {.term = t, .components = t->kind == BARE_BARS ? 1 : 3, .at_rest = room, .resisted = forces};
    if (!room)
        return BDA_NO_MEMORY;
    g.stiff = room + 3 * t->gaps, g.moved = room + 4 * t->gaps;
    for (int64_t row = 0; row < t->gaps; row++) {
        double own[3];
        for (int axis = 0; axis < g.components; axis++)
            own[axis] = moved[axis * t->gaps + row];
        begin_at(&g, row, own);
    }
    free(room);
    return BDA_DONE;
}
