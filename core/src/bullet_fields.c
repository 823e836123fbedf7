/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bullet_fields.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { IN_VECTOR = 4 * sizeof(double), OF_POINT = 15, IMPULSES = 6 };

/* Bullet's numbers are copied: they are of other objects than any that this program declares. */
static double double_at(uint64_t address)
{
    double value;
    memcpy(&value, (const void *)(uintptr_t)address, sizeof value);
    return value;
}

static int32_t int_at(uint64_t address)
{
    int32_t value;
    memcpy(&value, (const void *)(uintptr_t)address, sizeof value);
    return value;
}

static uint64_t pointer_at(uint64_t address)
{
    uint64_t value;
    memcpy(&value, (const void *)(uintptr_t)address, sizeof value);
    return value;
}

static void put_double(uint64_t address, double value)
{
    memcpy((void *)(uintptr_t)address, &value, sizeof value);
}

static void put_int(uint64_t address, int32_t value)
{
    memcpy((void *)(uintptr_t)address, &value, sizeof value);
}

/* Copy a vector to one of n (3, n). */
static void copy_vector(uint64_t address, double *values, int64_t n, int64_t row)
{
    for (int axis = 0; axis < 3; axis++)
        values[axis * n + row] = double_at(address + 8 * (uint64_t)axis);
}

/* Copy the three rows of a matrix to one of n (3, 3, n). */
static void copy_matrix(uint64_t address, double *values, int64_t n, int64_t row)
{
    for (int axis = 0; axis < 3; axis++)
        copy_vector(address + IN_VECTOR * (uint64_t)axis, values + 3 * axis * n, n, row);
}

/* Copy rotations, positions, velocities and angular velocities (18, n). */
static void copy_places(const bda_bullet_bodies *b, double *components)
{
    int64_t n = b->count;
    for (int64_t body = 0; body < n; body++) {
        uint64_t address = b->addresses[body], transform = address + (uint64_t)b->transform;
        copy_matrix(transform, components, n, body);
        copy_vector(transform + 3 * IN_VECTOR, components + 9 * n, n, body);
        copy_vector(address + (uint64_t)b->linear_velocity, components + 12 * n, n, body);
        copy_vector(address + (uint64_t)b->angular_velocity, components + 15 * n, n, body);
    }
}

/* Whether the places of bodies that were copied are finite. */
static int are_places(bda_bullet_bodies *b, const double *components)
{
    int64_t n = b->count;
    return are_finite(components + 12 * n, 3, n, BDA_VELOCITIES, &b->wrong) &&
           are_finite(components + 15 * n, 3, n, BDA_ANGULAR_VELOCITIES, &b->wrong) &&
           are_finite(components + 9 * n, 3, n, BDA_POSITIONS, &b->wrong) &&
           are_finite(components, 9, n, BDA_ROTATIONS, &b->wrong);
}

static int is_intact(const bda_bullet_connections *c, int64_t row)
{
    return c->exists[row] && *(const uint8_t *)(uintptr_t)(c->addresses[row] + (uint64_t)c->enabled) && !c->cracked[row];
}

/* Copy the state after a sub-step: bodies (19, n) with inverse masses, loads (6, k) on sides (k,) of connections, the
 * impulse (m,) of the last row of each, and whether it is intact (m,). Side 2 c is on body A of c, 2 c + 1 on its B. */
int bda_take_snapshot(bda_bullet_bodies *b, const bda_bullet_connections *c, int64_t count, const int64_t *sides,
                      double *components, double *loads, double *impulses, uint8_t *intact)
{
    if (!all_below(sides, count, 2 * c->count))
        return BDA_OUT_OF_RANGE;
    copy_places(b, components);
    for (int64_t body = 0; body < b->count; body++)
        components[18 * b->count + body] = double_at(b->addresses[body] + (uint64_t)b->inverse_mass);
    for (int64_t row = 0; row < count; row++)
        for (int axis = 0; axis < 3; axis++) {
            loads[axis * count + row] = c->feedback[8 * sides[row] + axis];
            loads[(3 + axis) * count + row] = c->feedback[8 * sides[row] + 4 + axis];
        }
    for (int64_t row = 0; row < c->count; row++)
        impulses[row] = c->exists[row] ? double_at(c->addresses[row] + (uint64_t)c->applied_impulse) : 0.0;
    bda_intact(c, intact);
    return are_places(b, components) ? BDA_DONE : BDA_NOT_FINITE;
}

/* Find which connections (m,) exist and have not broken. */
int bda_intact(const bda_bullet_connections *c, uint8_t *intact)
{
    for (int64_t row = 0; row < c->count; row++)
        intact[row] = (uint8_t)is_intact(c, row);
    return BDA_DONE;
}

/* Iterations of Bullet's solver can end with friction where no normal impulse is left. */
static int is_loaded(const bda_bullet_contacts *c, uint64_t point)
{
    for (int axis = IMPULSES; axis < IMPULSES + 3; axis++)
        if (double_at(point + (uint64_t)c->components[axis]) != 0.0)
            return 1;
    return 0;
}

/* Copy the points that carry a load, as many as there is room for. */
int bda_copy_contacts(bda_bullet_contacts *c)
{
    int32_t manifolds = int_at(c->dispatcher + (uint64_t)c->manifold_count);
    uint64_t list = pointer_at(c->dispatcher + (uint64_t)c->manifold_data);
    c->found = 0;
    if (manifolds < 0 || manifolds > c->most_manifolds)
        return BDA_OUT_OF_RANGE;
    for (uint64_t number = 0; number < (uint64_t)manifolds; number++) {
        uint64_t manifold = pointer_at(list + 8 * number), point = manifold + (uint64_t)c->points;
        int32_t points = int_at(manifold + (uint64_t)c->point_count);
        if (points < 0 || points > c->most_points)
            return BDA_OUT_OF_RANGE;
        for (int32_t left = points; left > 0; left--, point += (uint64_t)c->point_size) {
            int64_t row = c->found;
            if (!is_loaded(c, point))
                continue;
            if (c->found++ >= c->room)
                continue;
            for (int field = 0; field < OF_POINT; field++)
                c->values[field * c->room + row] = double_at(point + (uint64_t)c->components[field]);
            c->bodies[row] = c->wrong = pointer_at(manifold + (uint64_t)c->body_a);
            c->bodies[c->room + row] = pointer_at(manifold + (uint64_t)c->body_b);
            for (int field = 0; field < IMPULSES + 3; field++) /* Bullet sets the second direction only if it solved it */
                if (!(fabs(c->values[field * c->room + row]) <= DBL_MAX))
                    return BDA_NOT_FINITE;
        }
    }
    return BDA_DONE;
}

/* Whether one of n tensors (3, 3, n) is finite, symmetric by a part of its largest number, and not negative. */
static int is_inertia(const double *tensors, int64_t n, int64_t body, double symmetric)
{
    double largest = 0.0, difference = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        if (!(tensors[4 * axis * n + body] >= 0.0))
            return 0;
        for (int other = 0; other < 3; other++) {
            double value = tensors[(3 * axis + other) * n + body], size = fabs(value);
            double apart = fabs(value - tensors[(3 * other + axis) * n + body]);
            if (!(size <= DBL_MAX))
                return 0;
            largest = size > largest ? size : largest;
            difference = apart > difference ? apart : difference;
        }
    }
    return difference <= symmetric * largest;
}

static int is_awake(const bda_bullet_bodies *b, int64_t body)
{
    int32_t state = int_at(b->addresses[body] + (uint64_t)b->activation);
    return state != b->asleep && state != b->disabled;
}

/* Read how bodies move before a sub-step (34, n): places, forces and torques, inverse masses and tensors of inertia in
 * the axes of the world; and whether each is asleep (n,). A tensor that is none is out of range. */
int bda_read_motion(bda_bullet_bodies *b, double symmetric, double *components, uint8_t *asleep)
{
    int64_t n = b->count;
    double *tensors = components + 25 * n;
    copy_places(b, components);
    for (int64_t body = 0; body < n; body++) {
        uint64_t address = b->addresses[body];
        copy_vector(address + (uint64_t)b->total_force, components + 18 * n, n, body);
        copy_vector(address + (uint64_t)b->total_torque, components + 21 * n, n, body);
        components[24 * n + body] = double_at(address + (uint64_t)b->inverse_mass);
        copy_matrix(address + (uint64_t)b->inverse_inertia, tensors, n, body);
        asleep[body] = !is_awake(b, body);
    }
    if (!are_places(b, components) || !are_finite(components + 18 * n, 6, n, BDA_FORCES, &b->wrong) ||
        !are_finite(components + 24 * n, 1, n, BDA_MASSES, &b->wrong) ||
        !are_finite(tensors, 9, n, BDA_INERTIAS, &b->wrong))
        return BDA_NOT_FINITE;
    for (int64_t body = 0; body < n; body++)
        if (!is_inertia(tensors, n, body, symmetric))
            return BDA_OUT_OF_RANGE;
    return BDA_DONE;
}

/* Write loads (6, n) with those of impulses (6, n) to bodies that have any of these and move freely. */
int bda_push(const bda_bullet_bodies *b, const double *inverse_masses, const double *loads, const double *impulses,
             double substep_s)
{
    int64_t n = b->count;
    for (int64_t body = 0; body < n; body++) {
        int is_pushed = 0;
        for (int axis = 0; axis < 6; axis++)
            is_pushed |= impulses[axis * n + body] != 0.0;
        for (int axis = 0; is_pushed && inverse_masses[body] > 0.0 && axis < 6; axis++) {
            uint64_t field = b->addresses[body] + (uint64_t)(axis < 3 ? b->total_force : b->total_torque);
            put_double(field + 8 * (uint64_t)(axis % 3),
                       loads[axis * n + body] + impulses[axis * n + body] / substep_s);
        }
    }
    return BDA_DONE;
}

/* Whether a torque turns a body that is awake. */
static int turns(const bda_bullet_bodies *b, int64_t body, double time_s, double torque[3])
{
    copy_vector(b->addresses[body] + (uint64_t)b->total_torque, torque, 1, 0);
    return (torque[0] != 0.0 || torque[1] != 0.0 || torque[2] != 0.0) && is_awake(b, body) && fabs(time_s) <= DBL_MAX;
}

/* Whether the motion of a body, and what acts on it, is finite before Bullet lets others feel it. */
static int is_motion_finite(bda_bullet_bodies *b, int64_t body)
{
    const int64_t quantities[] = {BDA_VELOCITIES, BDA_ANGULAR_VELOCITIES, BDA_POSITIONS, BDA_FORCES};
    const int64_t fields[] = {b->linear_velocity, b->angular_velocity, b->transform + 3 * IN_VECTOR, b->total_force};
    for (int number = 0; number < 4; number++) {
        double vector[3];
        copy_vector(b->addresses[body] + (uint64_t)fields[number], vector, 1, 0);
        if (!are_finite(vector, 3, 1, quantities[number], &b->wrong)) {
            b->wrong.row = body;
            return 0;
        }
    }
    return 1;
}

/* Change angular velocities by what torques do in times (n,), and end these torques; where a time is infinite, they
 * stay. Where an inertia of a body is none, and some body would turn, nothing is written. */
int bda_turn_by_torques(bda_bullet_bodies *b, const double *times_s, double symmetric)
{
    double torque[3], inertia[9];
    int any = 0, are_inertias = 1;
    for (int64_t body = 0; body < b->count; body++)
        if (!is_motion_finite(b, body))
            return BDA_NOT_FINITE;
    for (int64_t body = 0; body < b->count; body++) {
        copy_matrix(b->addresses[body] + (uint64_t)b->inverse_inertia, inertia, 1, 0);
        any |= turns(b, body, times_s[body], torque);
        are_inertias &= is_inertia(inertia, 1, 0, symmetric);
    }
    if (any && !are_inertias)
        return BDA_OUT_OF_RANGE;
    for (int64_t body = 0; any && body < b->count; body++) {
        if (!turns(b, body, times_s[body], torque))
            continue;
        copy_matrix(b->addresses[body] + (uint64_t)b->inverse_inertia, inertia, 1, 0);
        for (uint64_t axis = 0; axis < 3; axis++) {
            uint64_t field = b->addresses[body] + (uint64_t)b->angular_velocity + 8 * axis;
            put_double(field, double_at(field) + times_s[body] * dot3(inertia + 3 * axis, torque));
        }
        for (uint64_t axis = 0; axis < 3; axis++)
            put_double(b->addresses[body] + (uint64_t)b->total_torque + 8 * axis, 0.0);
    }
    return BDA_DONE;
}

/* Have a spring be deformed by one of r limits (6, r) at the end of the coming sub-step: both limits of a row that is held
 * are alike, and crossed ones leave it free. */
void put_limits(const bda_bullet_rows *rows, int64_t spring, const double *limits, int64_t r)
{
    static const double SIGNS[6] = {1.0, 1.0, 1.0, -1.0, -1.0, -1.0}; /* Bullet takes rotations the other way */
    for (int row = 0; row < 6; row++) {
        int64_t place = row * rows->count + spring;
        uint64_t address = rows->addresses[spring];
        double limit = limits[row * r] * SIGNS[row];
        if (!rows->held[place])
            continue;
        put_double(address + (uint64_t)rows->lower[row], rows->resists[place] ? limit : 1.0);
        put_double(address + (uint64_t)rows->upper[row], rows->resists[place] ? limit : -1.0);
    }
}

/* Write one of r frames: axes (3, 3, r), as columns, and positions (3, r). */
static void put_frame(uint64_t address, const double *axes, const double *points, int64_t r)
{
    for (uint64_t row = 0; row < 4; row++)
        for (uint64_t axis = 0; axis < 3; axis++)
            put_double(address + IN_VECTOR * row + 8 * axis,
                       row < 3 ? axes[(3 * row + axis) * (uint64_t)r] : points[axis * (uint64_t)r]);
}

/* Correct all of an error of a spring in a sub-step, with a softness (6,); rows that are freer are left free. */
void soften_spring(const bda_bullet_rows *rows, const bda_softness *s, int64_t spring, const double own[6])
{
    uint64_t address = rows->addresses[spring];
    for (int row = 0; row < 6; row++) {
        int64_t place = row * rows->count + spring;
        rows->resists[place] = rows->held[place] && own[row] < s->free_from;
        put_double(address + (uint64_t)rows->correction[row], 1.0);
        put_double(address + (uint64_t)rows->softness[row], own[row] > s->softest ? s->softest : own[row]);
    }
    put_int(address + (uint64_t)rows->flags, (int32_t)s->flags);
}

/* Have springs (r,), of those that exist (k,), resist as cracks do: all of an error is corrected in a sub-step. */
int bda_put_cracks(const bda_bullet_rows *rows, const bda_expected_cracks *e, const bda_softness *s, int64_t count,
                   const int64_t *chosen, const uint8_t *exists)
{
    if (!all_below(chosen, count, rows->count))
        return BDA_OUT_OF_RANGE;
    for (int64_t at = 0; at < count; at++) {
        uint64_t address = rows->addresses[chosen[at]];
        double softness[6];
        if (!exists[chosen[at]])
            continue;
        for (int row = 0; row < 6; row++)
            softness[row] = e->softness[row * count + at];
        put_frame(address + (uint64_t)s->frame_a, e->first_axes + at, e->first_points + at, count);
        put_frame(address + (uint64_t)s->frame_b, e->second_axes + at, e->second_points + at, count);
        soften_spring(rows, s, chosen[at], softness);
        put_limits(rows, chosen[at], e->deformations + at, count);
    }
    return BDA_DONE;
}
