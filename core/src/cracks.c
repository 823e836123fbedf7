/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cracks.h"

#include <math.h>
#include <string.h>

#include "bars.h"

static int are_in_range(const bda_cracks *c, int64_t bodies)
{
    return c->count >= 0 && all_below(c->rows, c->count, c->connections) &&
           all_below(c->first, CORNERS * c->count, bodies) && all_below(c->second, CORNERS * c->count, bodies);
}

/* Bars at a corner, all of them, also those that have ruptured. */
static bar_law bars_at(const bda_cracks *c, int64_t at)
{
    int64_t row = c->rows[at % c->count], corner = at / c->count;
    return law_of_bars(c->yields[corner * c->connections + row] * c->shares[row], c->openings[row],
                       c->yield_strain[row], c->hardening[row], c->rupture_strain[row]);
}

/* Stiffness of sides that lie on each other at a corner; 0 once they have slid off. */
static double pressed_at(const bda_cracks *c, int64_t at)
{
    return c->meets[at] ? c->pressed[c->rows[at % c->count]] : 0.0;
}

/* Sides that rub at a corner, as bars that yield at their friction. */
static bar_law sides_at(const bda_cracks *c, int64_t at)
{
    return (bar_law){c->grips[at], c->sheared * pressed_at(c, at), 0.0};
}

/* Square of the distance of a corner from the middle of the four: sides that slid further have left each other there. */
static double reach_squared(const bda_cracks *c, int64_t at)
{
    double middle[3] = {0.0, 0.0, 0.0}, corner[3], away[3];
    for (int64_t other = at % c->count; other < CORNERS * c->count; other += c->count) {
        vector_at(c->first_anchors, CORNERS * c->count, other, corner);
        for (int axis = 0; axis < 3; axis++)
            middle[axis] = middle[axis] + corner[axis] / CORNERS;
    }
    vector_at(c->first_anchors, CORNERS * c->count, at, corner);
    for (int axis = 0; axis < 3; axis++)
        away[axis] = corner[axis] - middle[axis];
    return dot3(away, away);
}

/* Place of an anchor of a body. */
static void anchor_at(const bda_places *p, int64_t body, const double *anchors, int64_t count, int64_t at,
                      double place[3])
{
    double anchor[3], lever[3];
    vector_at(anchors, count, at, anchor);
    turned_at(p->rotations, p->count, body, anchor, lever);
    for (int axis = 0; axis < 3; axis++)
        place[axis] = p->positions[axis * p->count + body] + lever[axis];
}

/* Gap at a corner, in the axes of the world and of its first body. */
static void gap_at(const bda_cracks *c, const bda_places *p, int64_t at, double world[3], double gap[3])
{
    double one[3], other[3];
    anchor_at(p, c->first[at], c->first_anchors, CORNERS * c->count, at, one);
    anchor_at(p, c->second[at], c->second_anchors, CORNERS * c->count, at, other);
    subtract3(other, one, world);
    turned_back_at(p->rotations, p->count, c->first[at], world, gap);
}

/* Friction of sides that are pressed where the gap is closed. */
static double grip_of(const bda_cracks *c, int64_t at, double opened)
{
    return -c->friction * pressed_at(c, at) * (opened < 0.0 ? opened : 0.0);
}

/* Take over how far bars have yielded and sides have slid by now; say which cracks (t,) bars still hold. */
int bda_cracks_settle(const bda_cracks *c, const bda_places *p, uint8_t *holds)
{
    int64_t count = CORNERS * c->count;
    if (!are_in_range(c, p->count))
        return BDA_OUT_OF_RANGE;
    memset(holds, 0, (size_t)c->count);
    for (int64_t at = 0; at < count; at++) {
        int64_t row = c->rows[at % c->count];
        double world[3], gap[3], normal[3], direction[3], before[3], stretch[3], slid[3], after[3];
        gap_at(c, p, at, world, gap);
        vector_at(c->normals, count, at, normal);
        vector_at(c->directions, count, at, direction);
        c->holds[at] = c->holds[at] && dot3(world, world) <= c->openings[row] * c->openings[row];
        if (c->holds[at]) {
            bar_law bars = bars_at(c, at);
            vector_at(c->slips, count, at, before);
            stretch_of_bar(gap, direction, c->dowel, stretch);
            bar_force bar = force_of_bar(&bars, stretch, before, c->flows[at]);
            slip_of_bar(&bar, before, after);
            put_vector(c->slips, count, at, after);
            c->flows[at] = c->flows[at] + bar.flow;
        }
        double opened = dot3(normal, gap);
        slide_of_gap(gap, normal, opened, slid);
        c->meets[at] = c->meets[at] && dot3(slid, slid) <= reach_squared(c, at);
        bar_law sides = sides_at(c, at);
        vector_at(c->rests, count, at, before);
        bar_force rub = force_of_bar(&sides, slid, before, 0.0);
        slip_of_bar(&rub, before, after);
        put_vector(c->rests, count, at, after);
        c->grips[at] = grip_of(c, at, opened);
        holds[at % c->count] |= c->holds[at] && c->shares[row] > 0.0;
    }
    return BDA_DONE;
}

/* Let sides resist sliding by how they are pressed now. */
int bda_cracks_grip(const bda_cracks *c, const bda_places *p)
{
    if (!are_in_range(c, p->count))
        return BDA_OUT_OF_RANGE;
    for (int64_t at = 0; at < CORNERS * c->count; at++) {
        double world[3], gap[3], normal[3];
        gap_at(c, p, at, world, gap);
        vector_at(c->normals, CORNERS * c->count, at, normal);
        c->grips[at] = grip_of(c, at, dot3(normal, gap));
    }
    return BDA_DONE;
}

/* Twice the energy that bars give back under a force. */
static double doubled_energy(const double force[3], double stiffness)
{
    return stiffness > 0.0 ? dot3(force, force) / stiffness : 0.0;
}

/* Sums and maxima over the corners of a crack. */
typedef struct {
    double stored, yielding, rubbing, opening, force[3], yield_share, rupture_share, ruptured, whole;
} crack_state;

static void add_corner(const bda_cracks *c, const bda_places *p, int64_t at, crack_state *state)
{
    int64_t count = CORNERS * c->count;
    double world[3], gap[3], normal[3], direction[3], slip[3], rest[3], stretch[3], slid[3], moved[3];
    double pull[3], across[3], rubbing[3], after[3], holds = c->holds[at] ? 1.0 : 0.0;
    double pressed = pressed_at(c, at), opening = c->openings[c->rows[at % c->count]];
    bar_law bars = bars_at(c, at), sides = sides_at(c, at);
    gap_at(c, p, at, world, gap);
    vector_at(c->normals, count, at, normal);
    vector_at(c->directions, count, at, direction);
    vector_at(c->slips, count, at, slip);
    vector_at(c->rests, count, at, rest);
    stretch_of_bar(gap, direction, c->dowel, stretch);
    slide_of_gap(gap, normal, dot3(gap, normal), slid);
    bar_force bar = force_of_bar(&bars, stretch, slip, c->flows[at]), rub = force_of_bar(&sides, slid, rest, 0.0);
    for (int axis = 0; axis < 3; axis++) {
        pull[axis] = holds * (bar.share * bar.trial[axis]);
        rubbing[axis] = rub.share * rub.trial[axis];
    }
    stretch_of_bar(pull, direction, c->dowel, across);
    double opened = dot3(normal, gap), closing = opened < 0.0 ? opened : 0.0;
    state->stored +=
        0.5 * (doubled_energy(pull, bars.stiffness) + doubled_energy(rubbing, sides.stiffness) + pressed * closing * closing);
    slip_of_bar(&bar, slip, after);
    for (int axis = 0; axis < 3; axis++)
        moved[axis] = after[axis] - slip[axis], state->force[axis] += across[axis];
    state->yielding += dot3(pull, moved);
    slip_of_bar(&rub, rest, after);
    subtract3(after, rest, moved);
    state->rubbing += dot3(rubbing, moved);
    double wide = bars.yields > 0.0 && c->holds[at] ? sqrt(dot3(gap, gap)) : 0.0, used = wide / opening;
    double share = bars.yields > 0.0 ? sqrt(dot3(pull, pull)) / bars.yields : 0.0;
    state->opening = wide > state->opening ? wide : state->opening;
    state->yield_share = share > state->yield_share ? share : state->yield_share;
    state->rupture_share = used > state->rupture_share ? used : state->rupture_share;
    state->ruptured += bars.yields * (!c->holds[at] || used > 1.0 ? 1.0 : 0.0);
    state->whole += bars.yields;
}

/* Write, of each crack, energy that it would give back, work of bars that yield and of sides that slide in the sub-step,
 * largest opening where bars hold, resultant of the bars, largest force by that at which they yield, largest opening by
 * that at which they rupture, and part of the bars that has ruptured: (8, t). */
int bda_cracks_state(const bda_cracks *c, const bda_places *p, double *states)
{
    if (!are_in_range(c, p->count))
        return BDA_OUT_OF_RANGE;
    for (int64_t crack = 0; crack < c->count; crack++) {
        crack_state s = {0};
        for (int64_t at = crack; at < CORNERS * c->count; at += c->count)
            add_corner(c, p, at, &s);
        double found[CRACK_STATES] = {s.stored,
                                      s.yielding,
                                      s.rubbing,
                                      s.opening,
                                      sqrt(dot3(s.force, s.force)),
                                      s.yield_share,
                                      s.rupture_share < 1.0 ? s.rupture_share : 1.0,
                                      s.whole > 0.0 ? s.ruptured / s.whole : 0.0};
        for (int number = 0; number < CRACK_STATES; number++)
            states[number * c->count + crack] = found[number];
    }
    return BDA_DONE;
}

/* Vector (3, q) of a body's axes in those of the world. */
static void put_turned(const bda_places *p, int64_t body, const double *from, int64_t all, int64_t at, double *to,
                       int64_t count, int64_t row)
{
    double own[3], turned[3];
    vector_at(from, all, at, own);
    turned_at(p->rotations, p->count, body, own, turned);
    put_vector(to, count, row, turned);
}

/* Write how the cracks of a term are as a sub-step begins. */
int begin_cracks(const bda_cracks *c, const bda_places *p, const bda_term *t)
{
    int64_t all = CORNERS * c->count, count = t->gaps;
    if (!are_in_range(c, p->count) || count != CORNERS * t->connections ||
        !all_below(t->chosen, t->connections, c->count))
        return BDA_OUT_OF_RANGE;
    for (int64_t row = 0; row < count; row++) {
        int64_t crack = t->chosen[row % t->connections];
        int64_t at = row / t->connections * c->count + crack, one = c->first[at], other = c->second[at];
        double first_lever[3], second_lever[3], gap[3], arm[3];
        lever_at(p->rotations, p->count, one, c->first_anchors, all, at, first_lever);
        lever_at(p->rotations, p->count, other, c->second_anchors, all, at, second_lever);
        line_between(p, one, other, first_lever, second_lever, gap);
        put_vector(t->widths, count, row, gap);
        for (int axis = 0; axis < 3; axis++)
            arm[axis] = first_lever[axis] + 0.5 * gap[axis];
        put_vector(t->first_arms, count, row, arm);
        for (int axis = 0; axis < 3; axis++)
            arm[axis] = second_lever[axis] - 0.5 * gap[axis];
        put_vector(t->second_arms, count, row, arm);
        put_turned(p, one, c->slips, all, at, t->slips, count, row);
        put_turned(p, one, c->normals, all, at, t->normals, count, row);
        put_turned(p, one, c->directions, all, at, t->directions, count, row);
        put_turned(p, one, c->rests, all, at, t->rests, count, row);
        bar_law bars = bars_at(c, at);
        double holds = c->holds[at] ? 1.0 : 0.0;
        t->yields[row] = holds * bars.yields;
        t->stiffness[row] = holds * bars.stiffness;
        t->modulus[row] = holds * bars.modulus;
        t->flows[row] = c->flows[at];
        t->pressed[row] = pressed_at(c, at);
        t->grips[row] = c->grips[at];
        t->of_gap[row] = row % t->connections;
        t->which[row] = at;
        t->first[row] = one;
        t->second[row] = other;
    }
    return BDA_DONE;
}

/* Stiffness of a corner against a shift in a direction. */
static double stiffness_along(const bda_term *t, int64_t row, const double along[3])
{
    double pushed[3];
    turned_at(t->tangents, t->gaps, row, along, pushed);
    return dot3(along, pushed);
}

/* Find the axes (3, 3) of a crack, one after another: normal to its sides, and along them. */
static void axes_of_crack(const bda_term *t, int64_t crack, double axes[3][3])
{
    double one[3], other[3];
    vector_at(t->normals, t->gaps, crack, axes[0]);
    vector_at(t->first_arms, t->gaps, crack, one);
    vector_at(t->first_arms, t->gaps, crack + 2 * t->connections, other);
    subtract3(other, one, axes[1]);
    double across = dot3(axes[1], axes[0]);
    for (int axis = 0; axis < 3; axis++)
        axes[1][axis] = axes[1][axis] - across * axes[0][axis];
    double size = sqrt(dot3(axes[1], axes[1]));
    for (int axis = 0; axis < 3; axis++)
        axes[1][axis] = axes[1][axis] / size;
    cross3(axes[0], axes[1], axes[2]);
}

/* How a crack resists small changes of the motion that was guessed last: arms from both bodies to the middle of its
 * stiffness, axes, one after another, and stiffness along and about these. So the sides of a crack that is closed at one
 * edge turn about that edge, against its bars alone. */
typedef struct {
    double first_arm[3], second_arm[3], axes[3][3], stiffness[6];
} crack_joint;

static void find_joint(const bda_term *t, int64_t crack, crack_joint *joint)
{
    int64_t count = t->connections;
    double shares[CORNERS], total = 0.0, sum = 0.0, normal[3], arm[3], moved[3];
    memset(joint, 0, sizeof *joint);
    axes_of_crack(t, crack, joint->axes);
    for (int corner = 0; corner < CORNERS; corner++) {
        vector_at(t->normals, t->gaps, crack + corner * count, normal);
        shares[corner] = stiffness_along(t, crack + corner * count, normal);
        total += shares[corner];
    }
    for (int corner = 0; corner < CORNERS; corner++) {
        shares[corner] = total > 0.0 ? shares[corner] : 1.0;
        sum += shares[corner];
    }
    for (int corner = 0; corner < CORNERS; corner++) {
        double share = shares[corner] / sum;
        vector_at(t->first_arms, t->gaps, crack + corner * count, arm);
        for (int axis = 0; axis < 3; axis++)
            joint->first_arm[axis] += share * arm[axis];
        vector_at(t->second_arms, t->gaps, crack + corner * count, arm);
        for (int axis = 0; axis < 3; axis++)
            joint->second_arm[axis] += share * arm[axis];
    }
    for (int corner = 0; corner < CORNERS; corner++) {
        vector_at(t->first_arms, t->gaps, crack + corner * count, arm);
        subtract3(arm, joint->first_arm, arm);
        for (int axis = 0; axis < 3; axis++) {
            cross3(joint->axes[axis], arm, moved);
            joint->stiffness[axis] += stiffness_along(t, crack + corner * count, joint->axes[axis]);
            joint->stiffness[3 + axis] += stiffness_along(t, crack + corner * count, moved);
        }
    }
}

/* Vector times one of n matrices (3, 3, n) times the vector. */
static double square_by(const double *matrices, int64_t n, int64_t row, const double vector[3])
{
    double turned[3];
    turned_at(matrices, n, row, vector, turned);
    return dot3(vector, turned);
}

/* By how much a unit impulse in each row (6,) of a joint changes the velocity in it; and how fast the rows close. */
static void motion_of_joint(const bda_expected_cracks *e, const crack_joint *joint, int64_t one, int64_t other,
                            double mobilities[6], double rates[6])
{
    int64_t n = e->bodies;
    double velocity[3], angular[3], of_second[3], turning[3];
    for (int axis = 0; axis < 3; axis++) {
        velocity[axis] = e->velocities[axis * n + one] - e->velocities[axis * n + other];
        angular[axis] = e->velocities[(3 + axis) * n + one] - e->velocities[(3 + axis) * n + other];
    }
    for (int axis = 0; axis < 3; axis++) {
        const double *along = joint->axes[axis];
        cross3(joint->first_arm, along, turning);
        vector_at(e->velocities + 3 * n, n, one, of_second);
        rates[axis] = dot3(along, velocity) + dot3(turning, of_second);
        mobilities[axis] = e->inverse_masses[one] + square_by(e->inverse_inertias, n, one, turning);
        cross3(along, joint->second_arm, turning);
        vector_at(e->velocities + 3 * n, n, other, of_second);
        rates[axis] += dot3(turning, of_second);
        mobilities[axis] += e->inverse_masses[other] + square_by(e->inverse_inertias, n, other, turning);
        rates[3 + axis] = dot3(along, angular);
        mobilities[3 + axis] =
            square_by(e->inverse_inertias, n, one, along) + square_by(e->inverse_inertias, n, other, along);
    }
}

/* Write a joint as frames of Bullet: axes (3, 3, c), as columns, and points (3, c) in the axes of a body. */
static void put_frame(const bda_places *p, int64_t body, double axes[3][3], const double arm[3], int64_t count,
                      int64_t crack, double *to_axes, double *to_points)
{
    double own[3];
    for (int axis = 0; axis < 3; axis++) {
        turned_back_at(p->rotations, p->count, body, axes[axis], own);
        put_vector(to_axes + axis * count, 3 * count, crack, own);
    }
    turned_back_at(p->rotations, p->count, body, arm, own);
    put_vector(to_points, count, crack, own);
}

/* Find how Bullet's rows of cracks are to resist what contacts change of the motion that was guessed last. */
int bda_expect_cracks(const bda_term *t, const bda_places *p, const bda_expected_cracks *e)
{
    int64_t count = t->connections;
    if (p->count != e->bodies || t->kind != CRACKS || t->gaps != CORNERS * count)
        return BDA_OUT_OF_RANGE;
    for (int64_t crack = 0; crack < count; crack++) {
        int64_t one = t->first[crack], other = t->second[crack];
        crack_joint joint;
        double mobilities[6], rates[6];
        if (one < 0 || one >= e->bodies || other < 0 || other >= e->bodies)
            return BDA_OUT_OF_RANGE;
        find_joint(t, crack, &joint);
        motion_of_joint(e, &joint, one, other, mobilities, rates);
        put_frame(p, one, joint.axes, joint.first_arm, count, crack, e->first_axes, e->first_points);
        put_frame(p, other, joint.axes, joint.second_arm, count, crack, e->second_axes, e->second_points);
        for (int row = 0; row < 6; row++) {
            double hardness = e->substep_s * e->substep_s * joint.stiffness[row] * mobilities[row];
            e->softness[row * count + crack] = hardness > 0.0 ? 1.0 / hardness : INFINITY;
            e->deformations[row * count + crack] = -e->substep_s * rates[row];
        }
    }
    return BDA_DONE;
}
