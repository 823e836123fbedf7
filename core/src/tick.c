/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tick.h"

#include <math.h>
#include <string.h>

/* Read how bodies move, and what they do without connections. */
static int read_bodies(bda_tick *t)
{
    int64_t n = t->bodies->count;
    const double *m = t->motion;
    TRY(bda_read_motion(t->bodies, t->symmetric, t->motion, t->asleep));
    t->next = BDA_SETTLE;
    return bda_velocities_alone(n, m + 12 * n, t->left, m + 24 * n, m + 25 * n, m + 18 * n, t->substep_s, t->alone);
}

/* Make Bullet's rows of footings or pads that are intact softer as less of them touches. */
static void follow_lifting(const bda_tick *t, const bda_standing *s)
{
    for (int64_t row = 0; s->springs && row < s->springs->connections; row++) {
        double softness[6], share = s->springs->touching[row];
        if (share == s->followed[row] || !t->intact[s->rows[row]])
            continue;
        for (int64_t axis = 0; axis < 6; axis++)
            softness[axis] = share > 0.0 ? t->soft[axis * t->rows->count + s->rows[row]] / share : INFINITY;
        soften_spring(t->rows, t->softness, s->rows[row], softness);
        s->followed[row] = share;
    }
}

/* Take over how far springs and bars have yielded. */
static int settle(bda_tick *t)
{
    const bda_places *places = t->solved->places;
    if (t->footings.springs)
        TRY(bda_soil_settle(t->footings.springs, places));
    if (t->pads)
        TRY(bda_pads_settle(t->bearings.springs, t->pads, places));
    TRY(bda_cages_settle(t->bars, places));
    if (t->cracks)
        TRY(bda_cracks_settle(t->cracks, places, t->holds));
    for (int64_t crack = 0; t->cracks && crack < t->cracks->count; crack++)
        t->found |= t->holds[crack] ? 0 : BDA_RUPTURED;
    t->next = BDA_PREDICT;
    return BDA_DONE;
}

/* Whether all acts that was chosen, and nothing else: intact connections, of parts with a body that is awake. */
static int acts_as_chosen(bda_tick *t)
{
    const bda_substep *s = t->solved;
    int is_same = 1;
    bda_intact(t->connections, t->intact);
    follow_lifting(t, &t->footings);
    follow_lifting(t, &t->bearings);
    if (!t->is_current)
        return 0;
    for (int64_t row = 0; row < s->frames->count; row++)
        is_same &= t->intact[row] || !t->chosen[row];
    memset(t->awake, 0, (size_t)s->parts + 1);
    for (int64_t body = 0; body < s->places->count; body++)
        if (!t->asleep[body] && s->part_of_body[body] >= 0 && s->part_of_body[body] < s->parts)
            t->awake[s->part_of_body[body]] = 1;
    return is_same && !memcmp(t->awake, s->awake, (size_t)s->parts + 1);
}

/* Add those that hold by bars to flags (m,) of connections that are intact. */
static void add_held(const bda_cracks *c, uint8_t *intact)
{
    for (int64_t crack = 0; c && crack < c->count; crack++)
        intact[c->rows[crack]] = 1;
}

/* Write the loads of connections (k,), whose numbers were checked, by impulses (6, k) on both bodies. */
static void put_loads(const bda_tick *t, int64_t count, const int64_t *rows, const double *first, const double *second)
{
    for (int64_t at = 0; at < 6 * count; at++) {
        int64_t row = rows[at % count], place = at / count * t->connections->count + row;
        t->loads[place] = (t->on_first[row] ? first : second)[at] / t->substep_s;
    }
}

/* Solve the sub-step, and write what connections and bars carry in it; those that sleep carry what they did. */
static int predict(bda_tick *t)
{
    t->found = acts_as_chosen(t) ? 0 : BDA_OTHERS_ACT;
    if (t->found)
        return BDA_DONE;
    const bda_substep *s = t->solved;
    const bda_term *c = t->crack_term;
    int64_t m = t->connections->count;
    TRY(bda_solve_substep(t->solved));
    add_held(t->cracks, t->intact);
    for (int64_t at = 0; at < 6 * m; at++)
        t->loads[at] = t->intact[at % m] ? t->loads[at] : 0.0;
    put_loads(t, s->acting_count, s->acting, s->of_first, s->of_second);
    if (c)
        put_loads(t, c->connections, c->numbers, c->of_first, c->of_second);
    t->next = BDA_JUDGE;
    return BDA_DONE;
}

/* Find the connections that loads overload. */
static int find_overloaded(bda_tick *t, const bda_carried_loads *loads)
{
    bda_judging *j = t->judging;
    if (!j || !t->is_judged)
        return BDA_DONE;
    TRY(bda_over_alone(j, loads));
    for (int64_t number = 0; t->in_members && number < j->count; number++)
        t->found |= j->firsts[j->rows[number]] < 0 ? BDA_NO_SECTIONS : 0;
    if (t->found || !j->count)
        return BDA_DONE;
    TRY(bda_over_together(j, loads, t->in_members, t->redistributed));
    t->found |= j->count ? BDA_OVERLOADED : 0;
    return BDA_DONE;
}

/* Find what breaks in the sub-step. */
static int judge(bda_tick *t)
{
    const bda_springs *pads = t->pads && t->is_judged ? t->bearings.springs : NULL;
    TRY(find_overloaded(t, t->coming));
    if (t->found & BDA_NO_SECTIONS)
        return BDA_DONE;
    if (pads)
        TRY(bda_pads_failed(pads, t->pads, t->bearings.rows, t->whole, t->strength, t->failed));
    for (int64_t row = 0; pads && row < pads->connections; row++)
        t->found |= t->failed[row] ? BDA_OVERLOADED : 0;
    t->next = t->found ? BDA_PREDICT : BDA_PUT;
    return BDA_DONE;
}

/* Put the sub-step into Bullet: what connections do, and what its rows are to expect of them. */
static int put(bda_tick *t)
{
    const bda_substep *s = t->solved;
    int64_t n = t->bodies->count, m = s->frames->count, k = s->acting_count;
    TRY(bda_push(t->bodies, t->motion + 24 * n, t->motion + 18 * n, s->of_bodies, t->substep_s));
    for (int64_t at = 0; at < k; at++) {
        double coming[6];
        for (int64_t axis = 0; axis < 6; axis++)
            coming[axis] = s->deformations[axis * m + s->acting[at]] - t->substep_s * s->rates[axis * k + at];
        put_limits(t->rows, s->acting[at], coming, 1);
    }
    t->next = BDA_TURN;
    if (!t->crack_term)
        return BDA_DONE;
    TRY(bda_expect_cracks(t->crack_term, s->places, t->expected));
    return bda_put_cracks(t->rows, t->expected, t->softness, t->crack_term->connections, t->crack_term->numbers,
                          t->connections->exists);
}

static int turn(bda_tick *t)
{
    TRY(bda_turn_by_torques(t->bodies, t->times, t->symmetric));
    t->next = BDA_BULLET;
    return BDA_DONE;
}

/* Copy what Bullet has done, with the loads of connections, and find what these break. */
static int take(bda_tick *t)
{
    int64_t m = t->connections->count;
    TRY(bda_take_snapshot(t->bodies, t->connections, m, t->sides, t->components, t->taken, t->impulses, t->left_intact));
    t->bodies->wrong.quantity = BDA_CONTACT_IMPULSES;
    if (t->contacts)
        TRY(bda_copy_contacts(t->contacts));
    t->found = t->contacts && t->contacts->found > t->contacts->room ? BDA_NO_ROOM : 0;
    if (t->found)
        return BDA_DONE;
    for (int64_t at = 0; t->loads && at < 6 * m; at++)
        t->taken[at] += t->loads[at];
    t->next = t->solved && t->stored ? BDA_STORE : BDA_END;
    TRY(find_overloaded(t, t->carried));
    t->next = t->found & BDA_NO_SECTIONS ? BDA_TAKE : t->next;
    return BDA_DONE;
}

/* Write the energy of footings or pads in place of that of their connections. */
static int store_springs(bda_tick *t, const bda_standing *s, const bda_places *places)
{
    if (!s->springs)
        return BDA_DONE;
    TRY(bda_springs_energy(s->springs, places, s->energies));
    for (int64_t row = 0; row < s->springs->connections; row++)
        t->stored[s->rows[row]] = s->energies[row] * (t->chosen[s->rows[row]] ? 1.0 : 0.0);
    return BDA_DONE;
}

/* Write the energy of connections, bars and springs, and the state of cracks. */
static int store(bda_tick *t)
{
    const bda_substep *s = t->solved;
    int64_t m = s->frames->count, n = t->bodies->count;
    const bda_places places = {n, t->components + 9 * n, t->components};
    TRY(bda_deformations(s->frames, &places, t->count, t->numbers, s->deformations));
    TRY(bda_stored(m, s->stiffness, s->offsets, t->count, t->numbers, s->deformations, t->stored));
    if (t->cracks)
        TRY(bda_cracks_state(t->cracks, &places, t->states));
    for (int64_t crack = 0; t->cracks && crack < t->cracks->count; crack++)
        t->stored[t->cracks->rows[crack]] = t->states[crack];
    TRY(store_springs(t, &t->footings, &places));
    TRY(store_springs(t, &t->bearings, &places));
    memcpy(t->intact, t->left_intact, (size_t)m);
    add_held(t->cracks, t->intact);
    for (int64_t row = 0; row < m; row++)
        t->stored[row] = t->stored[row] * (t->intact[row] ? 1.0 : 0.0);
    t->next = BDA_END;
    return BDA_DONE;
}

/* Whether all is of the same bodies and connections. */
static int fits(const bda_tick *t)
{
    int64_t n = t->bodies->count, m = t->connections->count;
    const bda_substep *s = t->solved;
    const bda_carried_loads *loads = t->next > BDA_JUDGE ? t->carried : t->coming;
    if (t->judging && t->next != BDA_TURN && (t->judging->connections != m || !loads || loads->bodies != n))
        return 0;
    if (t->next < BDA_TURN && (!s || !t->bars || !t->rows || !all_below(s->acting, s->acting_count, m)))
        return 0;
    if (t->pads && !t->bearings.springs)
        return 0;
    if (t->cracks && (t->cracks->connections != m || !all_below(t->cracks->rows, t->cracks->count, m)))
        return 0;
    if ((t->footings.springs && !all_below(t->footings.rows, t->footings.springs->connections, m)) ||
        (t->bearings.springs && !all_below(t->bearings.rows, t->bearings.springs->connections, m)) ||
        (t->crack_term && !all_below(t->crack_term->numbers, t->crack_term->connections, m)))
        return 0;
    return (!s || (s->places->count == n && s->frames->count == m && t->rows->count == m &&
                   (!t->crack_term || t->expected->bodies == n)));
}

/* Go on with a sub-step until Bullet is to step, or it is over, or something has happen. */
int bda_go_on(bda_tick *t)
{
    static int (*const STAGES[])(bda_tick *) = {read_bodies, settle, predict, judge, put, turn, 0, take, store, 0};
    int answer = t->next >= BDA_READ && t->next <= BDA_END && fits(t) ? BDA_DONE : BDA_OUT_OF_RANGE;
    for (t->found = 0; answer == BDA_DONE && !t->found && STAGES[t->next];)
        answer = STAGES[t->next](t);
    if (answer == BDA_NOT_FINITE)
        t->wrong = t->next == BDA_PREDICT ? t->solved->wrong : t->bodies->wrong;
    return answer;
}
