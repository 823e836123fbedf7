/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bullet's bodies, connections and contacts, read and written in its own memory around a sub-step.
 *
 * This is all of the core that knows Bullet. Python says where structures are and at which offsets, in bytes, their
 * fields lie, once it has checked both; numbers of rows are checked here. Vectors of Bullet have room for four doubles,
 * and matrices are three such rows.
 */
#ifndef BDA_BULLET_FIELDS_H
#define BDA_BULLET_FIELDS_H

#include "cracks.h"

/* n rigid bodies (btRigidBody). */
typedef struct {
    int64_t count;
    const uint64_t *addresses;  /* (n,) */
    int64_t transform, linear_velocity, angular_velocity, total_force, total_torque, inverse_mass, inverse_inertia;
    int64_t activation;
    int64_t asleep, disabled;   /* states of activation in which a body is not simulated */
    bda_not_finite wrong;       /* what was not finite, where the answer is that something was not */
} bda_bullet_bodies;

/* m connections (btTypedConstraint), some of which do not exist. */
typedef struct {
    int64_t count;
    const uint64_t *addresses;      /* (m,) */
    const uint8_t *exists, *cracked; /* (m,); one that is cracked has broken */
    int64_t enabled, applied_impulse;
    const double *feedback;         /* (m, 2, 8): force and torque on body A, then on body B, four doubles each */
} bda_bullet_connections;

/* Contacts (btPersistentManifold), which a btCollisionDispatcher lists. */
typedef struct {
    uint64_t dispatcher;
    int64_t manifold_count, manifold_data;  /* in the dispatcher */
    int64_t body_a, body_b, point_count, points, point_size;
    const int64_t *components;      /* (15,), in a point: position, normal, impulses, two lateral directions */
    int64_t most_manifolds, most_points;
    int64_t room;
    double *values;                 /* (15, room) */
    uint64_t *bodies;               /* (2, room) */
    int64_t found;                  /* points that carry a load; where there is no room for all, copy again */
    uint64_t wrong;                 /* first body of the point that is not finite, where one is not */
} bda_bullet_contacts;

/* Six rows of each of k springs (btGeneric6DofSpring2Constraint). */
typedef struct {
    int64_t count;
    const uint64_t *addresses;      /* (k,) */
    const int64_t *lower, *upper, *correction, *softness; /* (6,) */
    int64_t flags;
    const uint8_t *held;            /* (6, k), whether rows hold a shift or rotation */
    uint8_t *resists;               /* (6, k), and whether they resist it now */
} bda_bullet_rows;

/* How soft rows may be, and where frames on both bodies are: offsets in bytes. */
typedef struct {
    double softest, free_from; /* as soft as Bullet's solver bears, and as soft as rows that are left free */
    int64_t flags, frame_a, frame_b;
} bda_softness;

BDA_API int bda_take_snapshot(bda_bullet_bodies *bodies, const bda_bullet_connections *connections, int64_t count,
                              const int64_t *sides, double *components, double *loads, double *impulses,
                              uint8_t *intact);
BDA_API int bda_intact(const bda_bullet_connections *connections, uint8_t *intact);
BDA_API int bda_copy_contacts(bda_bullet_contacts *contacts);
BDA_API int bda_read_motion(bda_bullet_bodies *bodies, double symmetric, double *components, uint8_t *asleep);
BDA_API int bda_push(const bda_bullet_bodies *bodies, const double *inverse_masses, const double *loads,
                     const double *impulses, double substep_s);
BDA_API int bda_turn_by_torques(bda_bullet_bodies *bodies, const double *times_s, double symmetric);
BDA_API int bda_put_cracks(const bda_bullet_rows *rows, const bda_expected_cracks *expected,
                           const bda_softness *softness, int64_t count, const int64_t *chosen, const uint8_t *exists);

void put_limits(const bda_bullet_rows *rows, int64_t spring, const double *limits, int64_t r);
void soften_spring(const bda_bullet_rows *rows, const bda_softness *s, int64_t spring, const double own[6]);

#endif
