/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A sub-step of Bullet: all that is done before it in one call, and after it in another.
 *
 * Python makes the context, and changes it with the structure. Where something happens that changes the structure,
 * the call ends at once and says what; Python does it, and calls again to go on.
 */
#ifndef BDA_TICK_H
#define BDA_TICK_H

#include "bullet_fields.h"
#include "cages.h"
#include "overloads.h"
#include "springs.h"
#include "substep.h"

/* What is next. Before Bullet steps: from reading bodies on, or from turning them where connections are rigid. */
enum { BDA_READ, BDA_SETTLE, BDA_PREDICT, BDA_JUDGE, BDA_PUT, BDA_TURN, BDA_BULLET, BDA_TAKE, BDA_STORE, BDA_END };

/* What Python has to do before the call goes on. */
enum {
    BDA_RUPTURED = 1,     /* cracks that no bar holds any more */
    BDA_OTHERS_ACT = 2,   /* connections have broken, or parts fell asleep or woke */
    BDA_NO_SECTIONS = 4,  /* sections of members of connections that are overloaded alone are not known */
    BDA_OVERLOADED = 8,   /* connections, in `judging` and `failed` */
    BDA_NO_ROOM = 16      /* more contacts than there is room for */
};

/* Footings or pads: connections (c,) that they are in place of, and how much of each Bullet's rows take for touching. */
typedef struct {
    const bda_springs *springs;
    const int64_t *rows;
    double *followed;
    double *energies;           /* (c,) */
} bda_standing;

/* n bodies, m connections; what there is not is NULL. */
typedef struct {
    int64_t next, found;
    double substep_s, symmetric, redistributed;
    int64_t is_judged, in_members, is_current; /* whether breaking counts, by sections, and whether all acts as chosen */
    bda_bullet_bodies *bodies;
    const bda_bullet_connections *connections;
    bda_bullet_contacts *contacts;
    const double *times;        /* (n,), s, in which torques turn bodies */
    /* Strength, with loads as they are predicted and as they are taken. */
    bda_judging *judging;
    const bda_carried_loads *coming, *carried;
    /* Elastic connections. */
    bda_substep *solved;
    const bda_bullet_rows *rows;
    const bda_softness *softness;
    const double *soft;         /* (6, m), softness of rows where they touch all over */
    const bda_cracks *cracks;
    const bda_term *crack_term;
    const bda_expected_cracks *expected;
    bda_standing footings, bearings;
    const bda_pads *pads;
    const bda_cages *bars;
    double *motion, *alone;     /* (34, n), (6, n), as a sub-step begins, and velocities at its end without connections */
    uint8_t *asleep, *awake;    /* (n,), (p + 1,) */
    const double *left;         /* (6, n), share of velocities that Bullet leaves */
    uint8_t *holds;             /* (t,), cracks that bars hold */
    const uint8_t *chosen, *on_first; /* (m,), that were intact as what acts was chosen; whose loads are on first bodies */
    uint8_t *intact;            /* (m,) */
    double *loads;              /* (6, m), that are predicted, on the bodies on which they are read */
    const uint8_t *whole;       /* (m,), that have not broken by what was found before */
    const double *strength;     /* (m,), part of it that is left */
    uint8_t *failed;            /* (c,), of bearings */
    /* After the sub-step: as of bda_take_snapshot, energy (m,) of connections, and states (8, t) of cracks. */
    const int64_t *sides;       /* (m,) */
    double *components, *taken, *impulses;
    uint8_t *left_intact;       /* (m,) */
    const int64_t *numbers;     /* (k,), of connections that were chosen */
    int64_t count;
    double *stored, *states;
    bda_not_finite wrong;
} bda_tick;

BDA_API int bda_go_on(bda_tick *tick);

#endif
