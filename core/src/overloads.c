/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "overloads.h"

#include "sums.h"

#include <math.h>

static const double SINGLE_PRECISION = 1e-6; /* slack of bounds by which connections are left out */
static const double ROUNDING = 1e-9;         /* largest difference of principal second moments of a square */

enum { COMPRESSION, TENSION, SHEAR, TORSION, BENDING };

/* Load on the first body of a connection, about the connection's point. */
typedef struct {
    double force[3], moment[3], point[3];
} carried_load;

/* A section as the rectangle with the same area and second moments. */
typedef struct {
    double area, directions[4], moduli[2], torsion_modulus; /* directions: principal axes of bending as columns */
} section;

/* Load of a connection after a sub-step. */
static void carry(const bda_carried_loads *all, int64_t step, int64_t row, carried_load *load)
{
    const bda_carried *own = all->carried + row;
    int64_t places = all->substeps * all->bodies, place = step * all->bodies + own->body;
    int64_t loads = all->substeps * all->connections, at = step * all->connections + row;
    double centre[3], turned[3], lever[3], force[3], torque[3], by_force[3];
    vector_at(all->positions, places, place, centre);
    turned_at(all->rotations, places, place, own->point, turned);
    vector_at(all->loads, loads, at, force);
    vector_at(all->loads + 3 * loads, loads, at, torque);
    for (int axis = 0; axis < 3; axis++) {
        load->point[axis] = centre[axis] + turned[axis];
        lever[axis] = load->point[axis] - centre[axis];
    }
    cross3(lever, force, by_force);
    for (int axis = 0; axis < 3; axis++) {
        load->moment[axis] = own->sign * (torque[axis] - by_force[axis]);
        load->force[axis] = own->sign * force[axis];
    }
}

/* Axes of a section, one after another, as they turn with its body. */
static void turn_axes(const bda_carried_loads *all, int64_t row, double axes[3][3])
{
    const bda_carried *own = all->carried + row;
    for (int axis = 0; axis < 3; axis++) {
        const double column[3] = {own->axes[axis], own->axes[3 + axis], own->axes[6 + axis]};
        turned_at(all->rotations, all->bodies, own->body, column, axes[axis]);
    }
}

static void in_axes(double axes[3][3], const double vector[3], double along[3])
{
    for (int axis = 0; axis < 3; axis++)
        along[axis] = dot3(axes[axis], vector);
}

/* Section with an area and second moments. Its edges are as far from its middle as those of the rectangle with the same:
 * √(3 I / A). Torsion of b > c: stress = T / (b c²) (3 + 1.8 c / b) (S. Timoshenko, 1955, Strength of Materials, part I,
 * section 62). Principal axes by Jacobi's rotation; squares, which rounding alone would turn, lie along the section's. */
static section rectangle(double area, const double second[3])
{
    double tangent = 0.0;
    if (second[1] != 0.0) {
        double ratio = (second[2] - second[0]) / (2.0 * second[1]);
        tangent = (ratio >= 0.0 ? 1.0 : -1.0) / (fabs(ratio) + sqrt(ratio * ratio + 1.0));
    }
    double cosine = 1.0 / sqrt(tangent * tangent + 1.0), sine = tangent * cosine, slope = sine / cosine;
    double small = second[0] - slope * second[1], large = second[2] + slope * second[1];
    section s = {area > 0.0 ? area : NAN, {cosine, sine, -sine, cosine}, {0.0, 0.0}, 0.0};
    if (small > large) {
        double other = small;
        small = large, large = other;
        s.directions[0] = sine, s.directions[1] = cosine, s.directions[2] = cosine, s.directions[3] = -sine;
    }
    if (large - small <= ROUNDING * large)
        s.directions[0] = s.directions[3] = 1.0, s.directions[1] = s.directions[2] = 0.0;
    double shorter = sqrt(12.0 * small / s.area), longer = sqrt(12.0 * large / s.area);
    s.moduli[0] = 2.0 * small / shorter;
    s.moduli[1] = 2.0 * large / longer;
    s.torsion_modulus = s.area * shorter / (3.0 + 1.8 * shorter / longer);
    return s;
}

/* Utilisation of a section by force and moment in its axes, with a strength, of which more may be left where it is pressed:
 * the larger of the stretched and the pressed edge acts together with shear, √(edge² + shear²) (EN 1993-1-1:2005, equation
 * 6.1; L. Ye, 1988). Friction, where there is any, helps a pressed section: EN 1992-1-1:2004, equation 6.25. */
static double utilisation(const section *s, const double *strength, double pressed, const double *friction,
                          const double force[3], const double moment[3])
{
    const double *d = s->directions;
    double axial = force[0] / s->area;
    double first = fabs(d[0] * moment[1] + d[2] * moment[2]), second = fabs(d[1] * moment[1] + d[3] * moment[2]);
    double bending = first / s->moduli[0] + second / s->moduli[1];
    double shear = sqrt(force[1] * force[1] + force[2] * force[2]) / s->area;
    if (friction)
        shear = larger(shear + *friction * (axial > 0.0 ? 0.0 : axial), 0.0);
    shear = shear / strength[SHEAR];
    shear += fabs(moment[0]) / s->torsion_modulus / strength[TORSION];
    double stretched = axial / strength[axial > 0.0 ? TENSION : BENDING] + bending / strength[BENDING];
    double edge = larger(stretched, (bending - axial) / (pressed * strength[COMPRESSION]));
    return sqrt(edge * edge + shear * shear);
}

/* Utilisation of a section by the strength of a connection. */
static double used_of(const bda_judging *j, int64_t row, const section *s, const double force[3], const double moment[3])
{
    const double *friction = j->friction ? j->friction + row : 0;
    return utilisation(s, j->resisting[row].strength, j->pressed[row], friction, force, moment);
}

static section own_section(const bda_resisting *own)
{
    section s = {own->area > 0.0 ? own->area : NAN,
                 {own->directions[0], own->directions[1], own->directions[2], own->directions[3]},
                 {own->moduli[0], own->moduli[1]},
                 own->torsion_modulus};
    return s;
}

/* Utilisation of a connection alone, by whole strengths. */
static double used_alone(const bda_judging *j, const bda_carried_loads *all, int64_t row)
{
    section s = own_section(j->resisting + row);
    double axes[3][3], force[3], moment[3];
    carried_load load;
    carry(all, 0, row, &load);
    turn_axes(all, row, axes);
    in_axes(axes, load.force, force);
    in_axes(axes, load.moment, moment);
    return used_of(j, row, &s, force, moment);
}

/* Whether the load of a connection is so small that it holds, whatever it acts on. */
static int holds_anyway(const bda_judging *j, const bda_carried_loads *all, int64_t row)
{
    double force[3], torque[3];
    vector_at(all->loads, all->connections, row, force);
    vector_at(all->loads + 3 * all->connections, all->connections, row, torque);
    double push = sqrt(dot3(force, force)), turn = sqrt(dot3(torque, torque));
    double most = (j->by_force[row] + j->by_moment[row] * j->levers[row]) * push + j->by_moment[row] * turn;
    return !(most * (1.0 + SINGLE_PRECISION) > j->left[row]);
}

/* Find the intact faces of a cut, and return how many there are. */
static int64_t intact_faces(const bda_judging *j, int64_t cut)
{
    int64_t count = 0;
    for (int64_t entry = j->starts[cut]; entry < j->starts[cut + 1]; entry++)
        if (j->intact[j->through[entry].face])
            j->found[count++] = entry;
    return count;
}

/* Middle of the faces of a cut that are noted, by their areas, and their area. */
static double middle_of_cut(const bda_judging *j, const bda_cut_through *through, int64_t count, double middle[3])
{
    for (int64_t at = 0; at < count; at++) {
        const bda_cut_through *member = through + j->found[at];
        j->lines[at] = j->resisting[member->face].area * member->cosine;
        for (int axis = 0; axis < 3; axis++)
            j->lines[(1 + axis) * count + at] = j->lines[at] * j->noted[9 * at + 6 + axis];
    }
    double area = total_of(j->lines, count);
    for (int axis = 0; axis < 3; axis++)
        middle[axis] = total_of(j->lines + (1 + axis) * count, count) / area;
    return area;
}

/* Write force, moment about a middle, and second moments of a face of a cut into a column of what is added up. */
static void add_face(const bda_judging *j, const bda_cut_through *member, int64_t at, int64_t count, double axes[3][3],
                     const double middle[3])
{
    const bda_resisting *face = j->resisting + member->face;
    const double *load = j->noted + 9 * at;
    double lever[3], pull[3], turn[3], share = face->area * member->cosine;
    for (int axis = 0; axis < 3; axis++) {
        lever[axis] = load[6 + axis] - middle[axis];
        pull[axis] = member->sign * load[axis];
    }
    cross3(lever, pull, turn);
    double across = dot3(axes[1], lever), up = dot3(axes[2], lever);
    double moved[3] = {up * up, -across * up, across * across};
    for (int axis = 0; axis < 3; axis++) {
        j->lines[axis * count + at] = pull[axis];
        j->lines[(3 + axis) * count + at] = member->sign * load[3 + axis] + turn[axis];
        j->lines[(6 + axis) * count + at] = face->second[axis] * member->cosine + share * moved[axis];
    }
}

/* Utilisation of a cut through faces that are noted and stay plane together, by the strength of a connection. */
static double used_in_cut(const bda_judging *j, const bda_cut_through *through, int64_t row, int64_t count,
                          double axes[3][3])
{
    double middle[3], sums[9], force[3], moment[3], area = middle_of_cut(j, through, count, middle);
    for (int64_t at = 0; at < count; at++)
        add_face(j, through + j->found[at], at, count, axes, middle);
    for (int line = 0; line < 9; line++)
        sums[line] = total_of(j->lines + line * count, count);
    in_axes(axes, sums, force);
    in_axes(axes, sums + 3, moment);
    section s = rectangle(area, sums + 6);
    return used_of(j, row, &s, force, moment);
}

static void note(const bda_judging *j, int64_t at, const double force[3], const double moment[3], const double point[3])
{
    for (int axis = 0; axis < 3; axis++) {
        j->noted[9 * at + axis] = force[axis];
        j->noted[9 * at + 3 + axis] = moment[axis];
        j->noted[9 * at + 6 + axis] = point[axis];
    }
}

/* Loads of connections, as bodies carry them, or as they are given. What a face carries is worked out for each section:
 * mostly few are overloaded alone, and numbers that are kept take longer to find again. */
typedef struct {
    const bda_carried_loads *carried;
    const bda_loads_in_cuts *given;
} loads_of_faces;

/* Utilisation of a cut through faces that are found, by whole strengths. */
static double used_by_faces(const bda_judging *j, loads_of_faces loads, const bda_cut_through *through, int64_t row,
                            int64_t count, double axes[3][3])
{
    for (int64_t at = 0; at < count; at++) {
        int64_t face = through[j->found[at]].face;
        carried_load load;
        if (loads.given) {
            note(j, at, loads.given->forces + 3 * face, loads.given->moments + 3 * face, loads.given->points + 3 * face);
        } else {
            carry(loads.carried, 0, face, &load);
            note(j, at, load.force, load.moment, load.point);
        }
    }
    return used_in_cut(j, through, row, count, axes);
}

/* Find the intact faces of a member's section that hang together with a connection, and return how many there are; -1
 * where there are more than there is room for, or numbers are out of range. */
static int64_t faces_of_section(const bda_judging *j, int64_t row)
{
    int64_t count = 0;
    for (int64_t entry = 0; entry < j->sizes[row]; entry++) {
        int64_t face = j->sections[j->firsts[row] + entry].face;
        if (face < 0 || face >= j->connections || count == j->most_faces)
            return -1;
        if (j->intact[face] && j->parts[face] == j->parts[row])
            j->found[count++] = entry;
    }
    return count;
}

/* Find the utilisation of a connection with the faces beside it, by whole strengths: of the section of its member, or the
 * mean of its two cuts where there is none that is whole. */
static int use_together(const bda_judging *j, loads_of_faces loads, int64_t in_members, int64_t row, double axes[3][3],
                        double *used)
{
    double sides[2];
    if (in_members && j->firsts[row] < 0)
        return BDA_OUT_OF_RANGE;
    if (in_members && j->whole[row]) {
        int64_t count = faces_of_section(j, row);
        if (count < 0)
            return BDA_OUT_OF_RANGE;
        *used = used_by_faces(j, loads, j->sections + j->firsts[row], row, count, axes);
        return BDA_DONE;
    }
    for (int side = 0; side < 2; side++)
        sides[side] = used_by_faces(j, loads, j->through, row, intact_faces(j, row + side * j->connections), axes);
    *used = (sides[0] + sides[1]) / 2.0;
    return BDA_DONE;
}

/* Write forces, moments and points (3, s, m) of all connections. */
int bda_carry(const bda_carried_loads *all, double *forces, double *moments, double *points)
{
    int64_t count = all->substeps * all->connections;
    for (int64_t step = 0; step < all->substeps; step++)
        for (int64_t row = 0; row < all->connections; row++) {
            carried_load load;
            carry(all, step, row, &load);
            put_vector(forces, count, step * all->connections + row, load.force);
            put_vector(moments, count, step * all->connections + row, load.moment);
            put_vector(points, count, step * all->connections + row, load.point);
        }
    return BDA_DONE;
}

/* Find the intact connections that loads overload alone. */
int bda_over_alone(bda_judging *j, const bda_carried_loads *all)
{
    j->count = 0;
    if (all->substeps != 1 || all->connections != j->connections)
        return BDA_OUT_OF_RANGE;
    for (int64_t row = 0; row < j->connections; row++) {
        if (!j->intact[row] || holds_anyway(j, all, row))
            continue;
        double used = used_alone(j, all, row) / j->left[row];
        if (used > 1.0) {
            j->rows[j->count] = row;
            j->used[j->count++] = used;
        }
    }
    return BDA_DONE;
}

/* Keep those that loads overload alone of which the same holds with the faces beside them, with their utilisations in
 * these. In members a face may carry so many times its strength, `redistributed`, as long as its section holds. */
int bda_over_together(bda_judging *j, const bda_carried_loads *all, int64_t in_members, double redistributed)
{
    int64_t alone = j->count;
    j->count = 0;
    if (all->substeps != 1 || all->connections != j->connections || alone < 0 || alone > j->connections ||
        !all_below(j->rows, alone, j->connections))
        return BDA_OUT_OF_RANGE;
    for (int64_t number = 0; number < alone; number++) {
        int64_t row = j->rows[number];
        double axes[3][3], used;
        turn_axes(all, row, axes);
        TRY(use_together(j, (loads_of_faces){all, 0}, in_members, row, axes, &used));
        used = used / j->left[row];
        if (in_members)
            used = larger(used, j->used[number] / redistributed);
        if (used > 1.0) {
            j->rows[j->count] = row;
            j->used[j->count++] = used;
        }
    }
    return BDA_DONE;
}

/* Write utilisations of some connections with the faces beside them, by loads that are given. */
int bda_used_together(const bda_judging *j, const bda_loads_in_cuts *loads, int64_t in_members)
{
    for (int64_t number = 0; number < loads->count; number++) {
        int64_t row = loads->rows[number];
        double axes[3][3];
        if (row < 0 || row >= j->connections)
            return BDA_OUT_OF_RANGE;
        for (int axis = 0; axis < 3; axis++) /* given as columns */
            for (int line = 0; line < 3; line++)
                axes[axis][line] = loads->axes[9 * number + 3 * line + axis];
        TRY(use_together(j, (loads_of_faces){0, loads}, in_members, row, axes, loads->used + number));
    }
    return BDA_DONE;
}

/* Write principal directions (m, 2, 2) and moduli, of bending (m, 2) and torsion (m,), of sections with areas (m,) and
 * second moments (m, 2, 2). */
int bda_rectangles(int64_t count, const double *areas, const double *second, double *directions, double *bending,
                   double *torsion)
{
    for (int64_t row = 0; row < count; row++) {
        const double *own = second + 4 * row, moments[3] = {own[0], own[1], own[3]};
        section s = rectangle(areas[row], moments);
        for (int at = 0; at < 4; at++)
            directions[4 * row + at] = s.directions[at];
        bending[2 * row] = s.moduli[0];
        bending[2 * row + 1] = s.moduli[1];
        torsion[row] = s.torsion_modulus;
    }
    return BDA_DONE;
}

/* Write utilisations (m,) of sections by forces (m, 6), force and moment in their axes; friction (m,) of 0 does not help. */
int bda_utilisations(int64_t count, const bda_resisting *resisting, const double *forces, const double *friction,
                     double *used)
{
    for (int64_t row = 0; row < count; row++) {
        section s = own_section(resisting + row);
        const double *force = forces + 6 * row;
        used[row] = utilisation(&s, resisting[row].strength, 1.0, friction + row, force, force + 3);
    }
    return BDA_DONE;
}
