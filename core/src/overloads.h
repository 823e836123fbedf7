/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Connections that carry more than their strength: each alone, and with the faces of its two shards that look its way.
 *
 * Few are judged here and there, between sub-steps in which Bullet drives out of the processor's cache what was read
 * before. So what counts is how many cache lines this waits for: what is read of a connection lies together.
 */
#ifndef BDA_OVERLOADS_H
#define BDA_OVERLOADS_H

#include "core.h"
#include "vectors.h"

/* A connection in the axes of the body that its load is known on. */
typedef struct {
    int64_t body;
    double sign;     /* 1 where that is the first body of the connection, -1 where it is the second */
    double point[3]; /* from the centre of the body */
    double axes[9];  /* of the section, as columns */
    double rest[2];  /* two cache lines */
} bda_carried;

/* Its section, and its strength: in compression, tension, shear, torsion, bending. */
typedef struct {
    double area, second[3]; /* second moments: ∫ z² dA, -∫ y z dA, ∫ y² dA */
    double directions[4], moduli[2], torsion_modulus;
    double strength[5];
} bda_resisting;

/* One face of a cut. */
typedef struct {
    int64_t face;
    double sign, cosine; /* whether the load of its first body counts or the opposite; between the normals of face and cut */
} bda_cut_through;

/* Loads of m connections after each of s sub-steps, about the centres of n bodies. */
typedef struct {
    int64_t substeps, connections, bodies;
    const double *loads;               /* (6, s, m) */
    const double *positions;           /* (3, s, n) */
    const double *rotations;           /* (3, 3, s, n) */
    const bda_carried *carried;        /* (m,) */
} bda_carried_loads;

/* What m connections resist, and which are overloaded. */
typedef struct {
    int64_t connections, entries, most_faces;
    const uint8_t *intact;                    /* (m,) */
    const double *left;                       /* (m,), of strengths */
    const double *by_force, *by_moment;       /* (m,), most that a force of 1 N and a moment of 1 N·m use */
    const double *levers;                     /* (m,), from the centres of bodies */
    const bda_resisting *resisting;           /* (m,) */
    const double *pressed, *friction;         /* (m,), by how much more is left in compression; none where it is no help */
    const int64_t *starts;                    /* (2 m + 1,), first face of each cut: through first shards, then second */
    const bda_cut_through *through;           /* (e,) */
    /* Sections of members, and of each connection (m,) its first face there, -1 where they are not known, how many there
     * are, whether it is a whole section of its member, and what hangs together, which no section goes beyond. */
    const bda_cut_through *sections;
    const int64_t *firsts, *sizes;
    const uint8_t *whole;
    const int64_t *parts;
    int64_t *found;                           /* room for the faces of a cut, (f,) */
    double *noted, *lines;                    /* (f, 9) force, moment and point of each, (9, f) what is added up */
    int64_t *rows;                            /* (m,), overloaded connections */
    double *used;                             /* (m,), their utilisations by what is left */
    int64_t count;                            /* how many they are */
} bda_judging;

/* Loads of m connections on their first bodies, about their points, and r of them with the axes of their sections. */
typedef struct {
    int64_t count;
    const int64_t *rows;                      /* (r,) */
    const double *axes;                       /* (r, 3, 3), as columns */
    const double *forces, *moments, *points;  /* (m, 3) */
    double *used;                             /* (r,), utilisations by whole strengths */
} bda_loads_in_cuts;

BDA_API int bda_carry(const bda_carried_loads *loads, double *forces, double *moments, double *points);
BDA_API int bda_over_alone(bda_judging *judging, const bda_carried_loads *loads);
BDA_API int bda_over_together(bda_judging *judging, const bda_carried_loads *loads, int64_t in_members,
                              double redistributed);
BDA_API int bda_used_together(const bda_judging *judging, const bda_loads_in_cuts *loads, int64_t in_members);
BDA_API int bda_rectangles(int64_t count, const double *areas, const double *second, double *directions, double *bending,
                           double *torsion);
BDA_API int bda_utilisations(int64_t count, const bda_resisting *resisting, const double *forces, const double *friction,
                             double *used);

#endif
