/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "joints.h"

#include <math.h>
#include <string.h>

/* Polynomial and intervals of the arc tangent: fdlibm (Sun Microsystems, 1993), s_atan.c. */
static const double ARCTANGENT[] = {
    3.33333333333329318027e-01,  -1.99999999998764832476e-01, 1.42857142725034663711e-01,  -1.11111104054623557880e-01,
    9.09088713343650656196e-02,  -7.69187620504482999495e-02, 6.66107313738753120669e-02,  -5.83357013379057348645e-02,
    4.97687799461593236017e-02,  -3.65315727442169155270e-02, 1.62858201153657823623e-02,
};
static const double LIMITS[] = {7.0 / 16.0, 11.0 / 16.0, 19.0 / 16.0, 39.0 / 16.0};
static const double STARTS[][2] = {
    {0.0, 0.0},
    {4.63647609000806093515e-01, 2.26987774529616870924e-17},
    {7.85398163397448278999e-01, 3.06161699786838301793e-17},
    {9.82793723247329054082e-01, 1.39033110312309984516e-17},
    {1.57079632679489655800e00, 6.12323399573676603587e-17},
};
static const double PI = 3.141592653589793115998e+00, PI_REST = 1.2246467991473531772e-16;

/* Angle, rad, of a point. */
static double angle_of(double y, double x)
{
    double slope = y != 0.0 ? fabs(y / x) : 0.0, shorter;
    int region = 0, last = (int)(sizeof ARCTANGENT / sizeof *ARCTANGENT) - 1;
    while (region < 4 && !(slope < LIMITS[region]))
        region++;
    switch (region) {
    case 0: shorter = slope; break;
    case 1: shorter = (2.0 * slope - 1.0) / (2.0 + slope); break;
    case 2: shorter = (slope - 1.0) / (slope + 1.0); break;
    case 3: shorter = (slope - 1.5) / (1.0 + 1.5 * slope); break;
    default: shorter = -1.0 / slope;
    }
    double square = shorter * shorter, value = ARCTANGENT[last];
    for (int number = last - 1; number >= 0; number--)
        value = ARCTANGENT[number] + square * value;
    double less = shorter * square * value;
    double angle = STARTS[region][0] - ((less - STARTS[region][1]) - shorter);
    if (signbit(x) && slope < INFINITY)
        angle = PI - (angle - PI_REST);
    return copysign(angle, y);
}

/* Axes of one of m frames (3, 3, m) in the world, one after another. */
static void axes_at(const double *rotations, int64_t bodies, int64_t body, const double *axes, int64_t frames,
                    int64_t row, double world[3][3])
{
    for (int axis = 0; axis < 3; axis++) {
        const double *column = axes + axis * frames + row;
        const double own[3] = {column[0], column[3 * frames], column[6 * frames]};
        turned_at(rotations, bodies, body, own, world[axis]);
    }
}

/* From the centre of a body to one of m points (3, m) of it, in the world. */
void lever_at(const double *rotations, int64_t bodies, int64_t body, const double *points, int64_t count,
                     int64_t row, double lever[3])
{
    double point[3];
    vector_at(points, count, row, point);
    turned_at(rotations, bodies, body, point, lever);
}

/* From a point of a body to one of another, at levers from their centres. */
void line_between(const bda_places *p, int64_t one, int64_t other, const double lever[3], const double other_lever[3],
                  double line[3])
{
    for (int axis = 0; axis < 3; axis++)
        line[axis] = p->positions[axis * p->count + other] + other_lever[axis] - p->positions[axis * p->count + one] -
                     lever[axis];
}

/* Write deformations, of (6, m), of chosen connections (k,). */
int bda_deformations(const bda_frames *f, const bda_places *p, int64_t count, const int64_t *chosen,
                     double *deformations)
{
    for (int64_t at = 0; at < count; at++) {
        int64_t row = chosen[at];
        if (row < 0 || row >= f->count)
            return BDA_OUT_OF_RANGE;
        int64_t a = f->first[row], b = f->second[row];
        if (a < 0 || a >= p->count || b < 0 || b >= p->count)
            return BDA_OUT_OF_RANGE;
        double one[3][3], other[3][3], lever[3], lever_of_second[3], shift[3];
        axes_at(p->rotations, p->count, a, f->first_axes, f->count, row, one);
        axes_at(p->rotations, p->count, b, f->second_axes, f->count, row, other);
        lever_at(p->rotations, p->count, a, f->first_points, f->count, row, lever);
        lever_at(p->rotations, p->count, b, f->second_points, f->count, row, lever_of_second);
        for (int axis = 0; axis < 3; axis++)
            shift[axis] = p->positions[axis * p->count + b] - p->positions[axis * p->count + a] +
                          lever_of_second[axis] - lever[axis];
        double about_y = dot3(one[0], other[2]), upright = 1.0 - about_y * about_y;
        for (int axis = 0; axis < 3; axis++)
            deformations[axis * f->count + row] = dot3(one[axis], shift);
        deformations[3 * f->count + row] = angle_of(-dot3(one[1], other[2]), dot3(one[2], other[2]));
        deformations[4 * f->count + row] = angle_of(about_y, sqrt(upright > 0.0 ? upright : 0.0));
        deformations[5 * f->count + row] = angle_of(-dot3(one[0], other[1]), dot3(one[0], other[0]));
    }
    return BDA_DONE;
}

/* Rows of a connection with bodies at their places. */
void rows_of_joint(const bda_frames *f, const bda_places *p, int64_t row, joint_rows *rows)
{
    int64_t a = f->first[row], b = f->second[row];
    double other[3][3], lever[3], lever_of_second[3], y[3], to_z[3], to_x[3];
    axes_at(p->rotations, p->count, a, f->first_axes, f->count, row, rows->along);
    axes_at(p->rotations, p->count, b, f->second_axes, f->count, row, other);
    lever_at(p->rotations, p->count, a, f->first_points, f->count, row, lever);
    lever_at(p->rotations, p->count, b, f->second_points, f->count, row, lever_of_second);
    for (int axis = 0; axis < 3; axis++) {
        cross3(lever, rows->along[axis], rows->first_turning[axis]);
        cross3(rows->along[axis], lever_of_second, rows->second_turning[axis]);
    }
    cross3(rows->along[2], other[0], y);
    cross3(y, rows->along[2], to_z);
    cross3(other[0], y, to_x);
    unit_of(to_z, sqrt(dot3(to_z, to_z)), rows->turning[0]);
    unit_of(y, sqrt(dot3(y, y)), rows->turning[1]);
    unit_of(to_x, sqrt(dot3(to_x, to_x)), rows->turning[2]);
}

/* Rates (6,) by velocities and angular velocities (6,) of both bodies. */
void rates_of_joint(const joint_rows *rows, const double first[6], const double second[6], double rates[6])
{
    const double x = first[0] - second[0], y = first[1] - second[1], z = first[2] - second[2];
    const double about_x = first[3] - second[3], about_y = first[4] - second[4], about_z = first[5] - second[5];
    for (int row = 0; row < 3; row++) {
        const double *along = rows->along[row], *turning = rows->turning[row];
        double shifting = along[0] * x + along[1] * y + along[2] * z;
        shifting += dot3(rows->first_turning[row], first + 3);
        shifting += dot3(rows->second_turning[row], second + 3);
        rates[row] = shifting;
        rates[3 + row] = turning[0] * about_x + turning[1] * about_y + turning[2] * about_z;
    }
}

/* Amounts in rows, by one of stiffnesses (6, 6, stride), of deformations. */
void stressed(const double *stiffness, int64_t stride, const double strains[6], double amounts[6])
{
    for (int row = 0; row < 6; row++) {
        const double *line = stiffness + 6 * row * stride;
        amounts[row] = line[0] * strains[0] + line[stride] * strains[1] + line[2 * stride] * strains[2] +
                       line[3 * stride] * strains[3] + line[4 * stride] * strains[4] + line[5 * stride] * strains[5];
    }
}

/* What amounts in the rows do to both bodies: forces or impulses, then torques about the centres. */
void loads_of_joint(const joint_rows *r, const double amounts[6], double of_first[6], double of_second[6])
{
    for (int axis = 0; axis < 3; axis++) {
        double force = r->along[0][axis] * amounts[0] + r->along[1][axis] * amounts[1] + r->along[2][axis] * amounts[2];
        double torque =
            r->turning[0][axis] * amounts[3] + r->turning[1][axis] * amounts[4] + r->turning[2][axis] * amounts[5];
        double on_first = r->first_turning[0][axis] * amounts[0] + r->first_turning[1][axis] * amounts[1] +
                          r->first_turning[2][axis] * amounts[2];
        double on_second = r->second_turning[0][axis] * amounts[0] + r->second_turning[1][axis] * amounts[1] +
                           r->second_turning[2][axis] * amounts[2];
        of_first[axis] = force;
        of_second[axis] = -force;
        of_first[3 + axis] = on_first + torque;
        of_second[3 + axis] = on_second - torque;
    }
}

/* Sum of products over the rows; those of shifts, columns up to 2, are in the first three of them alone. */
static double over_rows(const double *a, const double *b, int column)
{
    double sum = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    return column < 3 ? sum : sum + a[3] * b[3] + a[4] * b[4] + a[5] * b[5];
}

/* What a connection adds to the equations, J^T K J with its stiffness times `implicit_s2`, and none of it below the
 * diagonal of its own blocks. */
void blocks_of_joint(const joint_rows *r, const double *stiffness, int64_t stride, double implicit_s2,
                     blocks_of_connection *blocks)
{
    double hard[6][6], one[6][6] = {{0.0}}, other[6][6] = {{0.0}}, by_one[6][6], by_other[6][6];
    for (int line = 0; line < 6; line++)
        for (int column = 0; column < 6; column++)
            hard[line][column] = implicit_s2 * stiffness[(6 * line + column) * stride];
    for (int line = 0; line < 3; line++)
        for (int column = 0; column < 3; column++) {
            one[column][line] = r->along[line][column];
            other[column][line] = -r->along[line][column];
            one[3 + column][line] = r->first_turning[line][column];
            other[3 + column][line] = r->second_turning[line][column];
            one[3 + column][3 + line] = r->turning[line][column];
            other[3 + column][3 + line] = -r->turning[line][column];
        }
    for (int column = 0; column < 6; column++)
        for (int line = 0; line < 6; line++) {
            by_one[column][line] = over_rows(hard[line], one[column], column);
            by_other[column][line] = over_rows(hard[line], other[column], column);
        }
    for (int line = 0; line < 6; line++)
        for (int column = 0; column < 6; column++) {
            int at = 6 * line + column;
            blocks->of_first[at] = line <= column ? over_rows(one[line], by_one[column], line) : 0.0;
            blocks->of_second[at] = line <= column ? over_rows(other[line], by_other[column], line) : 0.0;
            blocks->between[at] = over_rows(one[line], by_other[column], line);
        }
}

/* Mass and inertia of a body in the axes of the world; inertias (3, 3, n) are in those of the bodies. */
void mass_matrix(const double *masses, const double *inertias, const double *rotations, int64_t bodies, int64_t body,
                 double matrix[BLOCK])
{
    double half[3][3];
    memset(matrix, 0, BLOCK * sizeof *matrix);
    for (int line = 0; line < 3; line++) {
        const double *turn = rotations + 3 * line * bodies + body;
        for (int column = 0; column < 3; column++) {
            const double *inertia = inertias + column * bodies + body;
            half[line][column] = turn[0] * inertia[0] + turn[bodies] * inertia[3 * bodies] +
                                 turn[2 * bodies] * inertia[6 * bodies];
        }
    }
    for (int line = 0; line < 3; line++) {
        matrix[7 * line] = masses[body];
        for (int column = 0; column < 3; column++) {
            const double *turn = rotations + 3 * column * bodies + body;
            matrix[6 * (3 + line) + 3 + column] =
                half[line][0] * turn[0] + half[line][1] * turn[bodies] + half[line][2] * turn[2 * bodies];
        }
    }
}

/* Write the energy (m,) in chosen connections (k,), of all with a stiffness (6, 6, m), with deformations (6, m), of which
 * offsets (6, m) count as none; 0 for the others. */
int bda_stored(int64_t m, const double *stiffness, const double *offsets, int64_t count, const int64_t *chosen,
               const double *deformations, double *energies)
{
    if (!all_below(chosen, count, m))
        return BDA_OUT_OF_RANGE;
    memset(energies, 0, (size_t)m * sizeof *energies);
    for (int64_t at = 0; at < count; at++) {
        double own[6], amounts[6], energy = 0.0;
        for (int axis = 0; axis < 6; axis++)
            own[axis] = deformations[axis * m + chosen[at]] - offsets[axis * m + chosen[at]];
        stressed(stiffness + chosen[at], m, own, amounts);
        for (int axis = 0; axis < 6; axis++)
            energy += 0.5 * amounts[axis] * own[axis];
        energies[chosen[at]] = energy;
    }
    return BDA_DONE;
}

/* Write velocities (6, n) at the end of a sub-step without connections. Bullet leaves a share (6, n) of those of bodies
 * that move freely; loads (6, n) act on bodies with inverse masses (n,) and inverse inertias (3, 3, n). */
int bda_velocities_alone(int64_t n, const double *velocities, const double *left, const double *inverse_masses,
                         const double *inverse_inertias, const double *loads, double substep_s, double *alone)
{
    for (int64_t body = 0; body < n; body++) {
        int moves = inverse_masses[body] > 0.0;
        for (int axis = 0; axis < 3; axis++) {
            const double *inverse = inverse_inertias + 3 * axis * n + body;
            double gained = inverse_masses[body] * loads[axis * n + body];
            double turning = (inverse[0] * loads[3 * n + body] + inverse[n] * loads[4 * n + body] +
                              inverse[2 * n] * loads[5 * n + body]) *
                             (moves ? 1.0 : 0.0);
            int64_t shift = axis * n + body, turn = (3 + axis) * n + body;
            alone[shift] = (moves ? left[shift] : 1.0) * velocities[shift] + substep_s * gained;
            alone[turn] = (moves ? left[turn] : 1.0) * velocities[turn] + substep_s * turning;
        }
    }
    return BDA_DONE;
}
