/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "work.h"

static double at_most_0(double number) { return number > 0.0 ? 0.0 : number; }
static double at_least_0(double number) { return number < 0.0 ? 0.0 : number; }

/* Work of an impulse and of its moment about the origin on a body. */
static double work_on(const bda_works *w, int64_t body, const double push[3], const double turn[3])
{
    double work = push[0] * w->motion[body] + push[1] * w->motion[w->bodies + body];
    work = work + push[2] * w->motion[2 * w->bodies + body];
    for (int axis = 0; axis < 3; axis++)
        work = work + turn[axis] * w->motion[(3 + axis) * w->bodies + body];
    return work;
}

/* Write the works of impulses with the motion of first and of second bodies. */
int bda_find_works(const bda_works *w)
{
    if (!all_below(w->first, w->count, w->bodies) || !all_below(w->second, w->count, w->bodies))
        return BDA_OUT_OF_RANGE;
    for (int64_t row = 0; row < w->count; row++) {
        double push[3], point[3], turn[3], further[3];
        vector_at(w->impulses, w->count, row, push);
        vector_at(w->points, w->count, row, point);
        cross3(point, push, turn);
        if (w->angular) {
            vector_at(w->angular, w->count, row, further);
            for (int axis = 0; axis < 3; axis++)
                turn[axis] = turn[axis] + further[axis];
        }
        w->on_first[row] = work_on(w, w->first[row], push, turn);
        w->on_second[row] = work_on(w, w->second[row], push, turn);
    }
    return BDA_DONE;
}

/* Let the bodies of a pair that makes energy get it, by what each gains. */
static void give(bda_shared_work *w, int64_t row, double made)
{
    int64_t one = w->first[row], other = w->second[row];
    double first = at_least_0(w->on_first[row]) * w->is_free[one];
    double second = at_least_0(-w->on_second[row]) * w->is_free[other];
    double both = first + second, share = both > 0.0 ? made / both : 0.0;
    w->by_first[one] += share * first;
    w->by_second[other] += share * second;
    w->rows[w->makers] = row;
    w->made[w->makers++] = made;
}

/* Share works out to what takes and what makes energy; bodies that are both led do no work that counts. */
int bda_share_work(bda_shared_work *w)
{
    w->makers = 0;
    if (!all_below(w->first, w->count, w->bodies) || !all_below(w->second, w->count, w->bodies))
        return BDA_OUT_OF_RANGE;
    for (int64_t row = 0; row < w->count; row++) {
        double work = w->is_free[w->first[row]] || w->is_free[w->second[row]] ? w->total[row] : 0.0;
        double lost = at_most_0(work);
        if (w->returned) {
            work = work - w->returned[row];
            lost = lost + w->returned[row];
        }
        w->taken[row] = lost;
        if (work > 0.0)
            give(w, row, work);
    }
    return BDA_DONE;
}

/* Where the accounts of one half are, and how many. */
typedef struct {
    int64_t count, *pairs, *last;
    double *taken;
} accounts;

static accounts accounts_of(const bda_touches *t, int64_t side, int64_t count)
{
    return (accounts){count, t->all_pairs + side * t->room, t->last + side * t->room, t->taken + side * t->room};
}

static void add_account(accounts *to, int64_t pair, double taken, int64_t last)
{
    to->pairs[to->count] = pair;
    to->taken[to->count] = taken;
    to->last[to->count++] = last;
}

/* Keep the accounts up to a pair: of those that still touch, and the last one, which is no pair. */
static int64_t keep_until(const bda_touches *t, const accounts *from, int64_t place, int64_t pair, int64_t now, accounts *to)
{
    for (; place < from->count && from->pairs[place] < pair; place++)
        if (from->last[place] >= now - t->apart)
            add_account(to, from->pairs[place], from->taken[place], from->last[place]);
    return place;
}

/* Book the work of pairs in a sub-step, from one half of the accounts into the other. Only what was taken comes back. */
static void book(bda_touches *t, int64_t begin, int64_t end, int64_t now)
{
    accounts from = accounts_of(t, t->side, t->known), to = accounts_of(t, 1 - t->side, 0);
    int64_t place = 0;
    for (int64_t at = begin; at < end; at++) {
        int64_t row = t->order[at], pair = t->pairs[row];
        double work = t->work[row], had = 0.0;
        if (work == 0.0)
            continue;
        place = keep_until(t, &from, place, pair, now, &to);
        if (place < from.count && from.pairs[place] == pair) {
            had = from.last[place] >= now - t->apart ? from.taken[place] : 0.0;
            place++;
        }
        double gained = at_least_0(work);
        t->returned[row] = had != had || gained > had ? had : gained;
        add_account(&to, pair, at_least_0(had - work), now);
    }
    if (!to.count)
        return;
    int64_t last = from.count - 1;
    keep_until(t, &from, place, from.pairs[last], now, &to);
    add_account(&to, from.pairs[last], from.taken[last], from.last[last]);
    t->side = 1 - t->side;
    t->known = to.count;
}

/* Book the work in sub-steps that follow each other. */
int bda_book_touches(bda_touches *t)
{
    if (!all_below(t->order, t->count, t->count) || !all_below(t->ends, t->substeps + 1, t->count + 1) || t->known < 1 ||
        t->room <= t->known + t->count)
        return BDA_OUT_OF_RANGE;
    for (int64_t step = 0; step < t->substeps; step++)
        book(t, t->ends[step], t->ends[step + 1], t->substep + step);
    return BDA_DONE;
}
