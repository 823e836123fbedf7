/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "springs.h"

/* Write gaps (3, p) below the bodies above, and arms (3, p) of the force there from the centres of both bodies. */
int bda_spring_gaps(const bda_spring_places *s, const bda_places *p, double *gaps, double *arms_above,
                    double *arms_below)
{
    for (int64_t row = 0; row < s->count; row++) {
        int64_t above = s->above[row], below = s->below[row];
        double anchor[3], arm[3], other[3], gap[3];
        if (above < 0 || above >= p->count || below < 0 || below >= p->count)
            return BDA_OUT_OF_RANGE;
        vector_at(s->anchors_above, s->count, row, anchor);
        turned_at(p->rotations, p->count, above, anchor, arm);
        vector_at(s->anchors_below, s->count, row, anchor);
        turned_at(p->rotations, p->count, below, anchor, other);
        for (int axis = 0; axis < 3; axis++) {
            gap[axis] = p->positions[axis * p->count + above] - p->positions[axis * p->count + below] + arm[axis] -
                        other[axis];
            other[axis] = other[axis] + gap[axis];
        }
        put_vector(gaps, s->count, row, gap);
        put_vector(arms_above, s->count, row, arm);
        put_vector(arms_below, s->count, row, other);
    }
    return BDA_DONE;
}

/* Write forces (3, p) on what lies above gaps (3, p), and by how much these fall with them, (3, 3, p). */
int bda_springs_resisted(const bda_spring_law *s, const double *gaps, double *forces, double *tangents)
{
    for (int64_t row = 0; row < s->count; row++) {
        double gap[3], force[3], tangent[3][3];
        vector_at(gaps, s->count, row, gap);
        force_of_spring(s, row, gap, force, tangent);
        put_vector(forces, s->count, row, force);
        for (int number = 0; number < 9; number++)
            tangents[number * s->count + row] = tangent[number / 3][number % 3];
    }
    return BDA_DONE;
}

/* Write the energy (p,) that springs across gaps (3, p) would give back. */
int bda_springs_stored(const bda_spring_law *s, const double *gaps, double *energies)
{
    for (int64_t row = 0; row < s->count; row++) {
        double gap[3], force[3], tangent[3][3], doubled = 0.0;
        vector_at(gaps, s->count, row, gap);
        force_of_spring(s, row, gap, force, tangent);
        for (int axis = 0; axis < 3; axis++) {
            double stiffness = axis < 2 ? s->sideways[axis * s->count + row] : s->vertical[row];
            doubled += stiffness > 0.0 ? force[axis] * force[axis] / stiffness : 0.0;
        }
        energies[row] = 0.5 * doubled;
    }
    return BDA_DONE;
}
