/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "loads.h"

#include <math.h>

/* Add the load of a connection in a sub-step to its impulses, and follow its largest force; one that is not known stays. */
static void follow(const bda_frame_loads *l, int64_t step, int64_t row, const double force[3], double size)
{
    int64_t m = l->connections;
    int is_higher = size > l->peaks[row];
    double moment[3];
    vector_at(l->moments, l->substeps * m, step * m + row, moment);
    if (is_higher || isnan(size))
        l->peaks[row] = size;
    for (int axis = 0; axis < 3; axis++) {
        l->impulses[axis * m + row] += l->lengths[step] * force[axis];
        l->impulses[(3 + axis) * m + row] += l->lengths[step] * moment[axis];
        if (is_higher) {
            l->peaks[(1 + axis) * m + row] = force[axis];
            l->peaks[(4 + axis) * m + row] = moment[axis];
        }
    }
}

/* Add up what connections carry in the sub-steps of a frame. */
int bda_add_frame_loads(const bda_frame_loads *l)
{
    int64_t m = l->connections, places = l->substeps * l->bodies;
    if (!all_below(l->pairs, 2 * m, l->bodies))
        return BDA_OUT_OF_RANGE;
    for (int64_t step = 0; step < l->substeps; step++)
        for (int64_t row = 0; row < m; row++) {
            double force[3];
            vector_at(l->forces, l->substeps * m, step * m + row, force);
            double size = sqrt(dot3(force, force));
            double added[5] = {force[0], force[1], force[2], size, l->signs[step * m + row]};
            for (int number = 0; number < 5; number++) {
                l->of_first[number * places + step * l->bodies + l->pairs[2 * row]] += added[number];
                l->of_second[number * places + step * l->bodies + l->pairs[2 * row + 1]] += added[number];
            }
            follow(l, step, row, force, size);
        }
    return BDA_DONE;
}

static void add_products(double *sums, int64_t body, const double first[3], const double second[3])
{
    for (int line = 0; line < 3; line++)
        for (int column = 0; column < 3; column++)
            sums[9 * body + 3 * line + column] += first[line] * second[column];
}

/* Add what a pair gives to one of its bodies: force ⊗ lever, and normal ⊗ (normal × moment). */
static void add_load(const bda_surface_loads *l, int64_t row, int side)
{
    int64_t body = l->pairs[2 * row + side];
    double sign = side ? -1.0 : 1.0, force[3], lever[3], normal[3], moment[3], spread[3];
    for (int axis = 0; axis < 3; axis++) {
        force[axis] = sign * l->forces[3 * row + axis];
        lever[axis] = l->points[3 * row + axis] - l->centres[3 * body + axis];
    }
    add_products(l->of_forces, body, force, lever);
    if (!l->moments)
        return;
    for (int axis = 0; axis < 3; axis++) {
        normal[axis] = sign * l->normals[3 * row + axis];
        moment[axis] = sign * l->moments[3 * row + axis];
    }
    cross3(normal, moment, spread);
    add_products(l->of_moments, body, normal, spread);
}

/* Write the average stress of bodies, tension positive; 0 without a volume. Of forces f at r from the centre it is the
 * symmetric part of (1/V) Σ f ⊗ r (A. E. H. Love, 1927, § 123; J. Weber, 1966), of moments M about points in faces with
 * normals n it is that of (1/V) Σ n ⊗ (n × M). */
int bda_stresses(const bda_surface_loads *l)
{
    if (!all_below(l->pairs, 2 * l->count, l->bodies))
        return BDA_OUT_OF_RANGE;
    for (int side = 0; side < 2; side++)
        for (int64_t row = 0; row < l->count; row++)
            add_load(l, row, side);
    for (int64_t at = 0; at < 9 * l->bodies; at++) {
        int64_t body = at / 9, beside = 9 * body + at % 3 * 3 + at % 9 / 3;
        double twice = 2.0 * l->volumes[body];
        l->stresses[at] = 0.0;
        if (!(l->volumes[body] > 0.0))
            continue;
        l->stresses[at] = (l->of_forces[at] + l->of_forces[beside]) / twice;
        if (l->moments)
            l->stresses[at] += (l->of_moments[at] + l->of_moments[beside]) / twice;
    }
    return BDA_DONE;
}
