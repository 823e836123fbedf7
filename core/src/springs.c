/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "springs.h"

#include <string.h>

static const double ANY = 1e300; /* pressing force by which friction holds any slip */

/* Gap below the body above a spring, and arms of the force there from the centres of both bodies; or what is out of range. */
static int gap_of_spring(const bda_spring_places *s, const bda_places *p, int64_t row, double gap[3], double arm[3],
                         double arm_below[3])
{
    int64_t above = s->above[row], below = s->below[row];
    double anchor[3];
    if (above < 0 || above >= p->count || below < 0 || below >= p->count)
        return BDA_OUT_OF_RANGE;
    vector_at(s->anchors_above, s->count, row, anchor);
    turned_at(p->rotations, p->count, above, anchor, arm);
    vector_at(s->anchors_below, s->count, row, anchor);
    turned_at(p->rotations, p->count, below, anchor, arm_below);
    for (int axis = 0; axis < 3; axis++) {
        gap[axis] = p->positions[axis * p->count + above] - p->positions[axis * p->count + below] + arm[axis] -
                    arm_below[axis];
        arm_below[axis] = arm_below[axis] + gap[axis];
    }
    return BDA_DONE;
}

/* Part of the gap of a spring beyond where it resists nothing. */
static void load_gap(const bda_springs *s, int64_t spring, const double gap[3], double loaded[3])
{
    for (int axis = 0; axis < 3; axis++)
        loaded[axis] = gap[axis] - s->free[axis * s->at->count + spring];
}

/* Whether springs are of connections that there are. */
static int are_springs(const bda_springs *s)
{
    return s->law->count == s->at->count && all_below(s->of, s->at->count, s->connections);
}

/* Write how the springs of a term are as a sub-step begins: gaps, arms, and what they are pressed by. */
int begin_springs(const bda_springs *s, const bda_places *p, const bda_term *t)
{
    if (!are_springs(s) || !all_below(t->which, t->gaps, s->at->count))
        return BDA_OUT_OF_RANGE;
    for (int64_t row = 0; row < t->gaps; row++) {
        int64_t spring = t->which[row];
        double gap[3], arm[3], arm_below[3];
        TRY(gap_of_spring(s->at, p, spring, gap, arm, arm_below));
        load_gap(s, spring, gap, gap);
        put_vector(t->widths, t->gaps, row, gap);
        put_vector(t->first_arms, t->gaps, row, arm_below);
        put_vector(t->second_arms, t->gaps, row, arm);
        t->pressed_by[row] = s->holding[spring];
    }
    return BDA_DONE;
}

/* Write the energy (c,) that the springs of each connection would give back. */
int bda_springs_energy(const bda_springs *s, const bda_places *p, double *energies)
{
    const bda_spring_law *law = s->law;
    int64_t n = law->count;
    if (!are_springs(s))
        return BDA_OUT_OF_RANGE;
    memset(energies, 0, (size_t)s->connections * sizeof *energies);
    for (int64_t row = 0; row < n; row++) {
        double gap[3], arm[3], other[3], force[3], tangent[3][3], doubled = 0.0;
        TRY(gap_of_spring(s->at, p, row, gap, arm, other));
        load_gap(s, row, gap, gap);
        force_of_spring(law, row, gap, force, tangent);
        for (int axis = 0; axis < 3; axis++) {
            double stiffness = axis < 2 ? law->sideways[axis * n + row] : law->vertical[row];
            doubled += stiffness > 0.0 ? force[axis] * force[axis] / stiffness : 0.0;
        }
        energies[s->of[row]] += 0.5 * doubled;
    }
    return BDA_DONE;
}

/* Write which part of the stiffness (c,) of each connection acts: of springs that hold what is lifted, or are pressed. */
static void find_touching(const bda_springs *s, const double *pressed)
{
    for (int64_t row = 0, spring = 0; row < s->connections; row++) {
        double acting = 0.0, all = 0.0;
        for (; spring < s->at->count && s->of[spring] == row; spring++) {
            acting += s->law->pulls[spring] || pressed[spring] > 0.0 ? s->law->vertical[spring] : 0.0;
            all += s->law->vertical[spring];
        }
        s->touching[row] = acting / all;
    }
}

/* Take over how far soil has yielded and footings have slid for good. */
int bda_soil_settle(const bda_springs *s, const bda_places *p)
{
    const bda_spring_law *law = s->law;
    int64_t n = law->count;
    if (!are_springs(s))
        return BDA_OUT_OF_RANGE;
    for (int64_t row = 0; row < n; row++) {
        double gap[3], arm[3], other[3], force[3], tangent[3][3], loaded[3];
        TRY(gap_of_spring(s->at, p, row, gap, arm, other));
        double settled = gap[2] + law->capacity[row] / law->vertical[row];
        if (settled < s->free[2 * n + row])
            s->free[2 * n + row] = settled;
        load_gap(s, row, gap, loaded);
        s->holding[row] = ANY;
        force_of_spring(law, row, loaded, force, tangent);
        s->holding[row] = force[2];
        double size = sqrt(force[0] * force[0] + force[1] * force[1]), limit = law->friction[row] * force[2];
        double share = size > limit ? limit / size : 1.0;
        for (int axis = 0; axis < 2; axis++) {
            double held = share * force[axis] / law->sideways[axis * n + row];
            s->free[axis * n + row] = force[2] <= 0.0 ? gap[axis] : gap[axis] + held;
        }
    }
    find_touching(s, s->holding);
    return BDA_DONE;
}

/* Find by what pads hold sideways: by their own pressing force, or by that of all of a bearing that does not slide. */
static void find_holding(const bda_springs *s, const bda_pads *b)
{
    memset(b->whole, 0, (size_t)b->bearings * sizeof *b->whole);
    for (int64_t row = 0; row < s->at->count; row++)
        b->whole[b->numbers[s->of[row]]] += b->pressed[row];
    for (int64_t row = 0; row < s->at->count; row++)
        s->holding[row] = isinf(s->law->friction[row]) ? b->whole[b->numbers[s->of[row]]] : b->pressed[row];
}

/* 1 + 2 cos of the angle by which the bodies of a connection have turned against each other. */
static double trace_of_turn(const bda_pads *b, const bda_places *p, int64_t row, int64_t count)
{
    const double *first = p->rotations + b->first[row], *second = p->rotations + b->second[row];
    double trace = 0.0;
    for (int line = 0; line < 3; line++)
        for (int column = 0; column < 3; column++) {
            double turn = 0.0;
            for (int axis = 0; axis < 3; axis++)
                turn += second[(3 * axis + line) * p->count] * first[(3 * axis + column) * p->count];
            trace += b->built_turns[(3 * line + column) * count + row] * turn;
        }
    return trace;
}

/* Whether the bodies of a connection, whose springs are so far apart on average, have left each other. */
static int have_left(const bda_pads *b, const bda_places *p, int64_t row, int64_t count, const double apart[3])
{
    double trace = trace_of_turn(b, p, row, count);
    int is_unseated = apart[2] > b->lifted || trace < b->least_cosines;
    return sqrt(dot3(apart, apart)) > b->travel[row] || (is_unseated && !b->pulls[row]) || trace < b->overturned;
}

/* Take over how far pads have slid, by what they were pressed in the last sub-step, and which bodies have left each other. */
int bda_pads_settle(const bda_springs *s, const bda_pads *b, const bda_places *p)
{
    const bda_spring_law *law = s->law;
    int64_t n = law->count, c = s->connections;
    if (!are_springs(s) || !all_below(b->numbers, c, b->bearings) || !all_below(b->first, c, p->count) ||
        !all_below(b->second, c, p->count) || !all_below(s->at->above, n, p->count) ||
        !all_below(s->at->below, n, p->count))
        return BDA_OUT_OF_RANGE;
    for (int64_t row = 0; row < n; row++) {
        double gap[3], arm[3], other[3];
        gap_of_spring(s->at, p, row, gap, arm, other);
        double own = -law->vertical[row] * gap[2];
        if (isnan(b->pressed[row]))
            b->pressed[row] = own > 0.0 ? own : 0.0;
    }
    find_holding(s, b);
    for (int64_t row = 0, spring = 0; row < c; row++) {
        double apart[3] = {0.0, 0.0, 0.0}, forces[3] = {0.0, 0.0, 0.0}, springs = 0.0;
        for (; spring < n && s->of[spring] == row; spring++) {
            double gap[3], arm[3], other[3], loaded[3], force[3], tangent[3][3];
            gap_of_spring(s->at, p, spring, gap, arm, other);
            load_gap(s, spring, gap, loaded);
            force_of_spring(law, spring, loaded, force, tangent);
            int slides = !isinf(law->friction[spring]) || (!law->pulls[spring] && s->holding[spring] <= 0.0);
            for (int axis = 0; slides && axis < 2; axis++) {
                double stiffness = law->sideways[axis * n + spring];
                s->free[axis * n + spring] = gap[axis] + (stiffness > 0.0 ? force[axis] / stiffness : 0.0);
            }
            for (int axis = 0; axis < 3; axis++)
                apart[axis] += gap[axis], forces[axis] += force[axis];
            springs += 1.0;
        }
        for (int axis = 0; axis < 3; axis++)
            apart[axis] = apart[axis] / springs;
        put_vector(b->forces, c, row, forces);
        b->gone[row] = (uint8_t)have_left(b, p, row, c, apart);
    }
    find_touching(s, b->pressed);
    return BDA_DONE;
}

/* Write which of connections `rows` (c,), of those that are intact (m,), fail, as they settled last: those whose bodies
 * have left each other, and all of a bearing that carries more than breaks what is left (m,) of it, sideways or upwards. */
int bda_pads_failed(const bda_springs *s, const bda_pads *b, const int64_t *rows, const uint8_t *intact,
                    const double *left, uint8_t *failed)
{
    int64_t c = s->connections;
    if (!all_below(b->numbers, c, b->bearings))
        return BDA_OUT_OF_RANGE;
    memset(b->whole, 0, (size_t)(3 * b->bearings) * sizeof *b->whole);
    for (int64_t row = 0; row < c; row++)
        for (int axis = 0; axis < 3; axis++)
            b->whole[axis * b->bearings + b->numbers[row]] +=
                b->forces[axis * c + row] * (intact[rows[row]] ? 1.0 : 0.0);
    for (int64_t row = 0; row < c; row++) {
        double force[3], limit = isfinite(b->breaking[row]) ? b->breaking[row] * left[rows[row]] : INFINITY;
        vector_at(b->whole, b->bearings, b->numbers[row], force);
        double sideways = sqrt(force[0] * force[0] + force[1] * force[1]), used = larger(sideways, -force[2]);
        failed[row] = intact[rows[row]] && (b->gone[row] || (limit > 0.0 ? used / limit : INFINITY) > 1.0);
    }
    return BDA_DONE;
}
