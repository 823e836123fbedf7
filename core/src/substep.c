/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "substep.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cages.h"
#include "cracks.h"
#include "guesses.h"
#include "springs.h"

enum { MOST_ROOMS = 96, BAD_BEGINNING = 16 };

/* Room that is given back at the end of the sub-step. */
typedef struct {
    void *rooms[MOST_ROOMS];
    int count, is_short;
} pool;

static void *room_in(pool *p, int64_t count, size_t size)
{
    void *room = p->count < MOST_ROOMS ? calloc((size_t)(count > 0 ? count : 1), size) : NULL;
    if (room)
        p->rooms[p->count++] = room;
    else
        p->is_short = 1;
    return room;
}

static void give_back(pool *p)
{
    while (p->count)
        free(p->rooms[--p->count]);
}

/* Work of a sub-step: guesses, blocks of what is in each part, and impulses. */
typedef struct {
    bda_substep *s;
    guesses all;
    int64_t **first_gaps;           /* of each term (c,) */
    uint8_t *unsolved;              /* (p + 1,), parts that are to be factored */
    int64_t *starts, *next;         /* (p + 1,), where blocks of each part start, and where its next one belongs */
    int64_t *of_part;               /* (most,), numbers of connections within their parts, one part after another */
    blocks_of_connection *blocks;   /* (most,) */
    double *own;                    /* (n, 36) */
    double *right, *unknowns;       /* (6, n) */
    double *loads, *total, *sums;   /* (6, n), impulses of connections, with those of terms, of one term */
    double *changes;                /* (6, n), of velocities */
    double *amounts;                /* (6, k) */
} work;

static int64_t part_of(const bda_substep *s, int64_t number)
{
    int64_t part = s->part_of_connection[number];
    return part < 0 ? s->parts : part;
}

/* Whether parts are of bodies that there are, and those that are awake have equations of these. */
static int are_parts(const bda_substep *s)
{
    int64_t n = s->places->count, last = s->part_starts[s->parts];
    if (s->part_starts[0] != 0 || last > n)
        return 0;
    for (int64_t part = 0; part < s->parts; part++) {
        int64_t count = s->part_starts[part + 1] - s->part_starts[part];
        if (count < 0 || (s->awake[part] && (!s->equations[part] || bodies_of_equations(s->equations[part]) != count)))
            return 0;
    }
    if (!all_below(s->part_bodies, last, n))
        return 0;
    for (int64_t body = 0; body < n; body++)
        if (s->part_of_body[body] < -1 || s->part_of_body[body] >= s->parts)
            return 0;
    for (int64_t number = 0; number < s->frames->count + s->bars; number++)
        if (s->part_of_connection[number] < -1 || s->part_of_connection[number] >= s->parts)
            return 0;
    return 1;
}

/* Check all numbers of bodies, connections and parts that come with a sub-step. */
static int is_in_range(const bda_substep *s)
{
    int64_t n = s->places->count, all = s->frames->count + s->bars;
    if (!are_parts(s))
        return 0;
    if (!all_below(s->frames->first, s->frames->count, n) || !all_below(s->frames->second, s->frames->count, n) ||
        !all_below(s->acting, s->acting_count, s->frames->count))
        return 0;
    for (int64_t at = 1; at < s->acting_count; at++)
        if (s->acting[at] <= s->acting[at - 1])
            return 0;
    for (int64_t number = 0; number < s->term_count; number++) {
        const bda_term *t = s->terms[number]; /* whose number of gaps its law has seen */
        if (!all_below(t->numbers, t->connections, all) || !all_below(t->of_gap, t->gaps, t->connections) ||
            !all_below(t->which, t->gaps, t->all_gaps) || !all_below(t->first, t->gaps, n) ||
            !all_below(t->second, t->gaps, n))
            return 0;
        for (int64_t row = 1; row < t->gaps && t->kind == SPRINGS; row++)
            if (t->of_gap[row] < t->of_gap[row - 1])
                return 0;
    }
    return 1;
}

static void prepare_term(work *w, pool *p, int64_t number)
{
    bda_substep *s = w->s;
    guessed_term *g = w->all.terms + number;
    bda_term *t = s->terms[number];
    int64_t c = t->connections, *part, *within;
    const double at_rest[3] = {0.0, 0.0, 0.0};
    g->term = t;
    g->components = t->kind == BARE_BARS ? 1 : 3;
    g->part = part = room_in(p, c, sizeof *part);
    g->within = within = room_in(p, c, sizeof *within);
    g->first_body = room_in(p, c, sizeof *g->first_body);
    g->second_body = room_in(p, c, sizeof *g->second_body);
    w->first_gaps[number] = room_in(p, c, sizeof **w->first_gaps);
    g->changed = room_in(p, c, sizeof *g->changed);
    double *room = room_in(p, 25 * t->gaps, sizeof *room);
    if (p->is_short)
        return;
    g->slack = room, g->stiff = room + t->gaps;
    g->at_rest = room + 4 * t->gaps;
    g->moved = room + 7 * t->gaps, g->guessed = room + 10 * t->gaps;
    g->next_moved = room + 13 * t->gaps, g->next_guessed = room + 16 * t->gaps;
    g->next_resisted = room + 19 * t->gaps, g->resisted = room + 22 * t->gaps;
    for (int64_t row = t->gaps - 1; row >= 0; row--) {
        int64_t at = t->of_gap[row];
        int is_turned = t->kind == SPRINGS && t->above_first[at];
        g->first_body[at] = is_turned ? t->second[row] : t->first[row];
        g->second_body[at] = is_turned ? t->first[row] : t->second[row];
        w->first_gaps[number][at] = row;
    }
    for (int64_t at = 0; at < c; at++) {
        part[at] = part_of(s, t->numbers[at]);
        within[at] = s->within_part[t->numbers[at]];
    }
    for (int64_t row = 0; row < t->gaps; row++)
        begin_at(g, row, at_rest);
    find_slack(g);
    if (!s->from_rest)
        begin_as_remembered(g);
}

static void prepare(work *w, pool *p)
{
    bda_substep *s = w->s;
    int64_t n = s->places->count, parts = s->parts + 1, most = s->acting_count, rows = 0;
    w->all.count = s->term_count, w->all.parts = s->parts, w->all.are_first = 1;
    w->all.terms = room_in(p, s->term_count, sizeof *w->all.terms);
    w->first_gaps = room_in(p, s->term_count, sizeof *w->first_gaps);
    for (int64_t number = 0; number < s->term_count && !p->is_short; number++) {
        prepare_term(w, p, number);
        rows += s->terms[number]->connections;
    }
    most = rows > most ? rows : most;
    uint8_t *flags = room_in(p, 4 * parts, sizeof *flags);
    double *of_parts = room_in(p, 7 * parts, sizeof *of_parts);
    w->starts = room_in(p, parts + 1, sizeof *w->starts);
    w->next = room_in(p, parts, sizeof *w->next);
    w->of_part = room_in(p, most, sizeof *w->of_part);
    w->blocks = room_in(p, most, sizeof *w->blocks);
    w->own = room_in(p, BLOCK * n, sizeof *w->own);
    double *of_bodies = room_in(p, 36 * n, sizeof *of_bodies);
    w->amounts = room_in(p, 6 * s->acting_count, sizeof *w->amounts);
    if (p->is_short)
        return;
    w->all.off = flags, w->all.seek = flags + parts, w->unsolved = flags + 2 * parts, w->all.open = flags + 3 * parts;
    for (int64_t part = 0; part < parts; part++)
        w->all.open[part] = part == s->parts || s->awake[part];
    w->all.shares = of_parts, w->all.low = of_parts + parts, w->all.share = of_parts + 2 * parts;
    w->all.at_low = of_parts + 3 * parts, w->all.at_high = of_parts + 4 * parts, w->all.at_share = of_parts + 5 * parts;
    w->all.flat = of_parts + 6 * parts;
    w->right = of_bodies, w->unknowns = of_bodies + 6 * n, w->loads = of_bodies + 12 * n;
    w->sums = of_bodies + 18 * n, w->changes = of_bodies + 24 * n, w->total = of_bodies + 30 * n;
}

/* Note the parts of bodies that have turned since their rows were made. */
static void find_stale(bda_substep *s)
{
    int64_t n = s->places->count;
    for (int64_t body = 0; body < n; body++) {
        double largest = 0.0;
        if (s->part_of_body[body] < 0 || s->stale[s->part_of_body[body]])
            continue;
        for (int number = 0; number < 9; number++) {
            double turned = fabs(s->places->rotations[number * n + body] - s->assembled_rotations[number * n + body]);
            if (turned > largest)
                largest = turned;
        }
        if (largest > s->turned_rad)
            s->stale[s->part_of_body[body]] = 1;
    }
}

/* Begin to put blocks beside each other that are of one part, which are counted at starts[part + 1] so far. */
static void begin_parts(work *w)
{
    for (int64_t part = 0; part < w->s->parts; part++) {
        w->starts[part + 1] += w->starts[part];
        w->next[part] = w->starts[part];
    }
}

/* Place of the next block of a part, of a connection that is `within` it. */
static blocks_of_connection *next_block(work *w, int64_t part, int64_t within)
{
    int64_t to = w->next[part]++;
    w->of_part[to] = within;
    return w->blocks + to;
}

/* Make rows and equations of some parts again, but for what is guessed. */
static int assemble(work *w, const uint8_t *chosen)
{
    bda_substep *s = w->s;
    int64_t n = s->places->count;
    int answer = BDA_DONE;
    memset(w->starts, 0, (size_t)(s->parts + 1) * sizeof *w->starts);
    for (int64_t at = 0; at < s->acting_count; at++)
        if (chosen[part_of(s, s->acting[at])])
            w->starts[part_of(s, s->acting[at]) + 1]++;
    begin_parts(w);
    for (int64_t at = 0; at < s->acting_count; at++) {
        int64_t row = s->acting[at], part = part_of(s, row);
        if (!chosen[part])
            continue;
        rows_of_joint(s->frames, s->places, row, s->rows + row);
        blocks_of_joint(s->rows + row, s->stiffness + row, s->frames->count,
                        s->substep_s * (s->substep_s + s->damping_s[row]), next_block(w, part, s->within_part[row]));
    }
    for (int64_t part = 0; part < s->parts && answer == BDA_DONE; part++) {
        int64_t first = s->part_starts[part], start = w->starts[part];
        if (!chosen[part])
            continue;
        for (int64_t at = first; at < s->part_starts[part + 1]; at++) {
            int64_t body = s->part_bodies[at];
            mass_matrix(s->masses, s->inertias, s->places->rotations, n, body, w->own + BLOCK * (at - first));
            for (int number = 0; number < 9; number++)
                s->assembled_rotations[number * n + body] = s->places->rotations[number * n + body];
        }
        answer = bda_equations_assemble(s->equations[part], w->own, w->starts[part + 1] - start, w->of_part + start,
                                        w->blocks + start);
        s->stale[part] = 0;
    }
    return answer;
}

/* Factor the equations of some parts, with what is guessed. */
static int factor(work *w, const uint8_t *chosen)
{
    bda_substep *s = w->s;
    int answer = BDA_DONE;
    memset(w->starts, 0, (size_t)(s->parts + 1) * sizeof *w->starts);
    for (int64_t number = 0; number < s->term_count; number++)
        for (int64_t at = 0; at < s->terms[number]->connections; at++)
            if (chosen[w->all.terms[number].part[at]])
                w->starts[w->all.terms[number].part[at] + 1]++;
    begin_parts(w);
    for (int64_t number = 0; number < s->term_count; number++) {
        guessed_term *g = w->all.terms + number;
        for (int64_t at = 0; at < g->term->connections; at++)
            if (chosen[g->part[at]])
                blocks_of_gaps(g, at, w->first_gaps[number][at], s->substep_s,
                               next_block(w, g->part[at], g->within[at]));
    }
    for (int64_t part = 0; part < s->parts && answer == BDA_DONE; part++)
        if (chosen[part]) {
            int64_t start = w->starts[part];
            answer = bda_equations_factor(s->equations[part], w->starts[part + 1] - start, w->of_part + start,
                                          w->blocks + start);
            s->factorings++;
        }
    return answer;
}

/* Make equations again of parts that have turned or lost a connection; factor these, and those with new guesses. */
static int refresh(work *w)
{
    bda_substep *s = w->s;
    int any = 0, answer = BDA_DONE;
    for (int64_t part = 0; part < s->parts; part++) {
        w->unsolved[part] = s->stale[part] && s->awake[part];
        any |= w->unsolved[part];
    }
    w->unsolved[s->parts] = 0;
    if (any)
        answer = assemble(w, w->unsolved);
    for (int64_t number = 0; number < s->term_count; number++) {
        guessed_term *g = w->all.terms + number;
        find_changed(g);
        for (int64_t at = 0; at < g->term->connections; at++)
            if (g->changed[at] && g->part[at] < s->parts && w->all.open[g->part[at]])
                w->unsolved[g->part[at]] = 1, any = 1;
    }
    return any && answer == BDA_DONE ? factor(w, w->unsolved) : answer;
}

/* Motion of a body, of (6, n). */
static void motion_of(const double *values, int64_t n, int64_t body, double motion[6])
{
    for (int axis = 0; axis < 6; axis++)
        motion[axis] = values[axis * n + body];
}

/* Add up the impulses (6, k) of connections on their bodies (6, n): all on first ones, then all on second ones. */
static void add_on_bodies(const bda_substep *s, double *sums)
{
    int64_t n = s->places->count, k = s->acting_count;
    memset(sums, 0, (size_t)(6 * n) * sizeof *sums);
    for (int axis = 0; axis < 6; axis++) {
        for (int64_t at = 0; at < k; at++)
            sums[axis * n + s->frames->first[s->acting[at]]] += s->of_first[axis * k + at];
        for (int64_t at = 0; at < k; at++)
            sums[axis * n + s->frames->second[s->acting[at]]] += s->of_second[axis * k + at];
    }
}

/* Deformation of a connection that acts, beyond its shape. */
static double strain_of(const bda_substep *s, int axis, int64_t at)
{
    int64_t place = axis * s->frames->count + s->acting[at];
    return s->deformations[place] - s->offsets[place];
}

/* Add to rates and impulses of connections what they resist of a motion (6, n), and of their strains in a time. */
static void add_impulses(work *w, const double *motion, double strained_s)
{
    bda_substep *s = w->s;
    int64_t n = s->places->count, k = s->acting_count;
    for (int64_t at = 0; at < k; at++) {
        int64_t row = s->acting[at];
        double first[6], second[6], rates[6], strains[6], amounts[6], of_first[6], of_second[6];
        double implicit = s->substep_s * (s->substep_s + s->damping_s[row]);
        motion_of(motion, n, s->frames->first[row], first);
        motion_of(motion, n, s->frames->second[row], second);
        rates_of_joint(s->rows + row, first, second, rates);
        for (int axis = 0; axis < 6; axis++)
            strains[axis] = strained_s * strain_of(s, axis, at) - implicit * rates[axis];
        stressed(s->stiffness + row, s->frames->count, strains, amounts);
        for (int axis = 0; axis < 6; axis++)
            amounts[axis] = w->amounts[axis * k + at] += amounts[axis];
        loads_of_joint(s->rows + row, amounts, of_first, of_second);
        for (int axis = 0; axis < 6; axis++) {
            s->rates[axis * k + at] += rates[axis];
            s->of_first[axis * k + at] = of_first[axis];
            s->of_second[axis * k + at] = of_second[axis];
        }
    }
}

/* Solve the equations of the parts that are open and awake: changes of velocities by the impulses, with those of all terms. */
static void solve(work *w)
{
    bda_substep *s = w->s;
    int64_t n = s->places->count;
    const double *loads = w->loads;
    for (int64_t number = 0; number < s->term_count; number++) {
        find_impulses(w->all.terms + number, s->velocities, n, s->substep_s, w->all.open, w->sums);
        for (int64_t at = 0; at < 6 * n; at++)
            w->total[at] = loads[at] + w->sums[at];
        loads = w->total;
    }
    for (int64_t part = 0; part < s->parts; part++) {
        int64_t first = s->part_starts[part], count = s->part_starts[part + 1] - first;
        if (!s->awake[part] || !w->all.open[part])
            continue;
        for (int axis = 0; axis < 6; axis++)
            for (int64_t at = 0; at < count; at++)
                w->right[axis * count + at] = loads[axis * n + s->part_bodies[first + at]];
        bda_equations_solve(s->equations[part], w->right, w->unknowns);
        for (int axis = 0; axis < 6; axis++)
            for (int64_t at = 0; at < count; at++)
                w->changes[axis * n + s->part_bodies[first + at]] = w->unknowns[axis * count + at];
    }
    for (int64_t at = 0; at < 6 * n; at++)
        s->ends[at] = s->velocities[at] + w->changes[at];
}

/* Number of a connection among those that act. */
static int64_t acting_number(const bda_substep *s, int64_t connection)
{
    int64_t at = 0;
    while (at < s->acting_count && s->acting[at] < connection)
        at++;
    return at < s->acting_count && s->acting[at] == connection ? at : -1;
}

/* Add the impulses of terms to those on bodies, and those of springs to the connections that they are in place of. */
static void add_terms(work *w)
{
    bda_substep *s = w->s;
    int64_t n = s->places->count, k = s->acting_count;
    for (int64_t number = 0; number < s->term_count; number++) {
        bda_term *t = s->terms[number];
        find_impulses(w->all.terms + number, s->ends, n, s->substep_s, NULL, w->sums);
        for (int64_t at = 0; at < 6 * n; at++)
            s->of_bodies[at] = s->of_bodies[at] + w->sums[at];
        for (int64_t at = 0; t->kind == SPRINGS && at < t->connections; at++) {
            int64_t acting = acting_number(s, t->numbers[at]);
            for (int axis = 0; acting >= 0 && axis < 6; axis++) {
                s->of_first[axis * k + acting] += t->of_first[axis * t->connections + at];
                s->of_second[axis * k + acting] += t->of_second[axis * t->connections + at];
            }
        }
    }
}

/* Whether forces of a term, and what bars and sides of cracks are known by, are finite: laws take what is no number for
 * bars that there are not. */
static int is_term_finite(const guessed_term *g, bda_not_finite *wrong)
{
    const bda_term *t = g->term;
    int64_t q = t->gaps;
    return are_finite(g->at_rest, g->components, q, BDA_IMPULSES, wrong) &&
           are_finite(t->tangents, 9, q, BDA_STIFFNESS, wrong) && are_finite(t->widths, 3, q, BDA_STRAINS, wrong) &&
           (t->kind != CRACKS ||
            (are_finite(t->yields, 1, q, BDA_IMPULSES, wrong) && are_finite(t->stiffness, 1, q, BDA_STIFFNESS, wrong) &&
             are_finite(t->modulus, 1, q, BDA_STIFFNESS, wrong) && are_finite(t->slips, 3, q, BDA_STRAINS, wrong) &&
             are_finite(t->flows, 1, q, BDA_STRAINS, wrong) && are_finite(t->rests, 3, q, BDA_STRAINS, wrong) &&
             are_finite(t->pressed, 1, q, BDA_STIFFNESS, wrong) && are_finite(t->grips, 1, q, BDA_IMPULSES, wrong)));
}

/* Whether all that a sub-step is solved from is finite. */
static int are_given(work *w)
{
    bda_substep *s = w->s;
    int64_t n = s->places->count, m = s->frames->count;
    if (!are_finite(s->velocities, 6, n, BDA_VELOCITIES, &s->wrong) ||
        !are_finite(s->places->positions, 3, n, BDA_POSITIONS, &s->wrong) ||
        !are_finite(s->places->rotations, 9, n, BDA_ROTATIONS, &s->wrong) ||
        !are_finite(s->masses, 1, n, BDA_MASSES, &s->wrong) ||
        !are_finite(s->inertias, 9, n, BDA_INERTIAS, &s->wrong) ||
        !are_finite(s->stiffness, BLOCK, m, BDA_STIFFNESS, &s->wrong) ||
        !are_finite(s->damping_s, 1, m, BDA_DAMPING, &s->wrong))
        return 0;
    for (int64_t at = 0; at < s->acting_count; at++)
        for (int axis = 0; axis < 6; axis++)
            if (!isfinite(strain_of(s, axis, at))) {
                s->wrong = (bda_not_finite){BDA_STRAINS, s->acting[at]};
                return 0;
            }
    for (int64_t number = 0; number < s->term_count; number++) {
        const bda_term *t = s->terms[number];
        if (!is_term_finite(w->all.terms + number, &s->wrong)) {
            s->wrong.row = t->numbers[t->of_gap[s->wrong.row]];
            return 0;
        }
    }
    return 1;
}

/* Whether what came of it is finite. */
static int are_found(bda_substep *s)
{
    if (!are_finite(s->of_first, 6, s->acting_count, BDA_IMPULSES, &s->wrong)) {
        s->wrong.row = s->acting[s->wrong.row];
        return 0;
    }
    return are_finite(s->ends, 6, s->places->count, BDA_VELOCITIES, &s->wrong) &&
           are_finite(s->of_bodies, 6, s->places->count, BDA_FORCES, &s->wrong);
}

/* Write how a term is as a sub-step begins. */
int bda_begin_term(const bda_term *t, const bda_places *places)
{
    if (!t->law || t->kind < CRACKS || t->kind > BARE_BARS)
        return BDA_OUT_OF_RANGE;
    if (t->kind == CRACKS)
        return begin_cracks(t->law, places, t);
    return t->kind == SPRINGS ? begin_springs(t->law, places, t) : begin_cages(t->law, places, t);
}

/* Find what connections do in a sub-step. */
int bda_solve_substep(bda_substep *s)
{
    pool rooms = {{0}, 0, 0};
    work w = {.s = s};
    int answer = bda_deformations(s->frames, s->places, s->acting_count, s->acting, s->deformations);
    s->guesses = s->factorings = 0;
    for (int64_t number = 0; number < s->term_count && answer == BDA_DONE; number++)
        answer = bda_begin_term(s->terms[number], s->places);
    if (answer != BDA_DONE || !is_in_range(s))
        return BDA_OUT_OF_RANGE;
    prepare(&w, &rooms);
    answer = rooms.is_short ? BDA_NO_MEMORY : are_given(&w) ? BDA_DONE : BDA_NOT_FINITE;
    if (answer == BDA_DONE) {
        find_stale(s);
        answer = refresh(&w);
    }
    if (answer == BDA_DONE) {
        memset(s->rates, 0, (size_t)(6 * s->acting_count) * sizeof *s->rates);
        add_impulses(&w, s->velocities, s->substep_s);
        add_on_bodies(s, w.loads);
        solve(&w);
    }
    for (; answer == BDA_DONE && s->term_count && s->guesses < s->most_guesses; s->guesses++) {
        if (!guess_again(&w.all, s->ends, s->places->count, s->substep_s))
            break;
        /* What gaps did in the last sub-step may be a bad beginning, as where they were wide open and now close. */
        if (s->guesses == BAD_BEGINNING)
            guess_no_motion(&w.all);
        answer = refresh(&w);
        if (answer == BDA_DONE)
            solve(&w);
    }
    if (answer == BDA_DONE) {
        for (int64_t number = 0; number < s->term_count && s->most_guesses; number++)
            remember(w.all.terms + number);
        add_impulses(&w, w.changes, 0.0);
        add_on_bodies(s, s->of_bodies);
        add_terms(&w);
        answer = are_found(s) ? BDA_DONE : BDA_NOT_FINITE;
    }
    give_back(&rooms);
    return answer;
}
