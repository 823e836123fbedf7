/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Elastic connections: frames on two bodies, how they are deformed, and the rows in which they resist.
 *
 * The deformation is the shift and turn of the second frame against the first, as Bullet measures it (its generic
 * constraint with six degrees of freedom): shifts along the axes of the first, angles about x, y and z in that order.
 */
#ifndef BDA_JOINTS_H
#define BDA_JOINTS_H

#include "equations.h"

/* Frames of m connections between n bodies, in the axes of the bodies. */
typedef struct {
    int64_t count;
    const int64_t *first, *second;                  /* (m,) bodies */
    const double *first_axes, *second_axes;         /* (3, 3, m), as columns */
    const double *first_points, *second_points;     /* (3, m), m, from the centres */
} bda_frames;

/* Where n bodies are. */
typedef struct {
    int64_t count;
    const double *positions; /* (3, n), m, of centres of mass */
    const double *rotations; /* (3, 3, n) */
} bda_places;

/* Rates at which deformations of a connection shrink: velocities of the first body against the second. */
typedef struct {
    double along[3][3];          /* unit vectors along which velocities count */
    double first_turning[3][3];  /* share of the angular velocity of the first body in these rows */
    double second_turning[3][3];
    double turning[3][3];        /* unit vectors about which relative angular velocities count */
} joint_rows;

BDA_API int bda_deformations(const bda_frames *frames, const bda_places *places, int64_t count, const int64_t *chosen,
                             double *deformations);
BDA_API int bda_stored(int64_t all, const double *stiffness, const double *offsets, int64_t count,
                       const int64_t *chosen, const double *deformations, double *energies);
BDA_API int bda_velocities_alone(int64_t bodies, const double *velocities, const double *left,
                                 const double *inverse_masses, const double *inverse_inertias, const double *loads,
                                 double substep_s, double *alone);

void lever_at(const double *rotations, int64_t bodies, int64_t body, const double *points, int64_t count, int64_t row,
              double lever[3]);
void line_between(const bda_places *places, int64_t one, int64_t other, const double lever[3],
                  const double other_lever[3], double line[3]);
void rows_of_joint(const bda_frames *frames, const bda_places *places, int64_t row, joint_rows *rows);
void blocks_of_joint(const joint_rows *rows, const double *stiffness, int64_t stride, double implicit_s2,
                     blocks_of_connection *blocks);
void mass_matrix(const double *masses, const double *inertias, const double *rotations, int64_t bodies, int64_t body,
                 double matrix[BLOCK]);
void rates_of_joint(const joint_rows *rows, const double first[6], const double second[6], double rates[6]);
void loads_of_joint(const joint_rows *rows, const double amounts[6], double of_first[6], double of_second[6]);
void stressed(const double *stiffness, int64_t stride, const double strains[6], double amounts[6]);

#endif
