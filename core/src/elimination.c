/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "elimination.h"

#include <stdlib.h>
#include <string.h>

#include "vectors.h"

/* Numbers of bodies, in a list that grows. */
typedef struct {
    int64_t count, most, *numbers;
} list;

static int append(list *l, int64_t number)
{
    if (l->count == l->most) {
        int64_t most = 2 * l->most + 8, *numbers = realloc(l->numbers, (size_t)most * sizeof *numbers);
        if (!numbers)
            return BDA_NO_MEMORY;
        l->numbers = numbers, l->most = most;
    }
    l->numbers[l->count++] = number;
    return BDA_DONE;
}

/* Bodies that are left, with others and elements that each is coupled to, and what the elements stand for. */
typedef struct {
    int64_t bodies;
    list *others, *elements, *coupled; /* (n,); `coupled` is of a body that was eliminated, in any order */
    int64_t *degrees;                  /* (n,), -1 for a body that was eliminated */
    int64_t *seen, *outside;           /* (n,), marks, and how many of an element's bodies are not of the newest one */
    int64_t mark;
} graph;

static void forget_graph(graph *g)
{
    for (int64_t body = 0; g->others && body < 3 * g->bodies; body++)
        free(g->others[body].numbers);
    free(g->others), free(g->degrees);
}

static int begin_graph(graph *g, int64_t bodies, int64_t pairs, const int64_t *first, const int64_t *second)
{
    size_t room = (size_t)(bodies > 0 ? bodies : 1);
    g->bodies = bodies;
    g->others = calloc(3 * room, sizeof *g->others);
    g->degrees = calloc(3 * room, sizeof *g->degrees);
    if (!g->others || !g->degrees)
        return BDA_NO_MEMORY;
    g->elements = g->others + bodies, g->coupled = g->others + 2 * bodies;
    g->seen = g->degrees + bodies, g->outside = g->degrees + 2 * bodies;
    for (int64_t pair = 0; pair < pairs; pair++) {
        int64_t one = first[pair], other = second[pair], known = one < 0 || other < 0 || one == other;
        if (known)
            continue;
        if (append(g->others + one, other) != BDA_DONE || append(g->others + other, one) != BDA_DONE)
            return BDA_NO_MEMORY;
    }
    for (int64_t body = 0; body < bodies; body++) { /* each other body once */
        list *l = g->others + body;
        int64_t kept = 0;
        g->mark++;
        for (int64_t at = 0; at < l->count; at++)
            if (g->seen[l->numbers[at]] != g->mark) {
                g->seen[l->numbers[at]] = g->mark;
                l->numbers[kept++] = l->numbers[at];
            }
        g->degrees[body] = l->count = kept;
    }
    return BDA_DONE;
}

/* Body of the lowest degree. */
static int64_t next_body(const graph *g)
{
    int64_t found = -1;
    for (int64_t body = 0; body < g->bodies; body++)
        if (g->degrees[body] >= 0 && (found < 0 || g->degrees[body] < g->degrees[found]))
            found = body;
    return found;
}

/* Add the bodies of a list that are left and not yet marked to those that an element is coupled to. */
static int couple(graph *g, list *coupled, const list *more)
{
    for (int64_t at = 0; at < more->count; at++) {
        int64_t body = more->numbers[at];
        if (g->degrees[body] < 0 || g->seen[body] == g->mark)
            continue;
        g->seen[body] = g->mark;
        if (append(coupled, body) != BDA_DONE)
            return BDA_NO_MEMORY;
    }
    return BDA_DONE;
}

/* Make an element of a body, which takes in the elements that it is coupled to: so elements have only bodies left. */
static int eliminate(graph *g, int64_t body)
{
    list *coupled = g->coupled + body, *elements = g->elements + body;
    int answer;
    g->mark++;
    g->degrees[body] = -1;
    answer = couple(g, coupled, g->others + body);
    for (int64_t at = 0; at < elements->count && answer == BDA_DONE; at++) {
        list *taken_in = g->coupled + elements->numbers[at];
        answer = couple(g, coupled, taken_in);
        taken_in->count = 0;
    }
    return answer;
}

/* Count of the elements that bodies of the newest one are coupled to how many bodies they have that it does not. */
static void count_outside(graph *g, const list *newest)
{
    for (int turn = 0; turn < 2; turn++)
        for (int64_t at = 0; at < newest->count; at++) {
            const list *elements = g->elements + newest->numbers[at];
            for (int64_t number = 0; number < elements->count; number++) {
                int64_t element = elements->numbers[number];
                g->outside[element] = turn ? g->outside[element] - 1 : g->coupled[element].count;
            }
        }
}

/* Couple the bodies of the newest element to it in place of each other, and find their degrees. */
static int update_degrees(graph *g, int64_t element)
{
    const list *newest = g->coupled + element;
    count_outside(g, newest);
    for (int64_t at = 0; at < newest->count; at++) {
        int64_t body = newest->numbers[at], kept = 0;
        list *others = g->others + body, *elements = g->elements + body;
        for (int64_t number = 0; number < others->count; number++)
            if (g->degrees[others->numbers[number]] >= 0 && g->seen[others->numbers[number]] != g->mark)
                others->numbers[kept++] = others->numbers[number];
        others->count = kept;
        g->degrees[body] = newest->count - 1 + kept;
        kept = 0;
        for (int64_t number = 0; number < elements->count; number++)
            if (g->outside[elements->numbers[number]] > 0) { /* the newest one has all bodies of the others */
                g->degrees[body] += g->outside[elements->numbers[number]];
                elements->numbers[kept++] = elements->numbers[number];
            }
        elements->count = kept;
        if (append(elements, element) != BDA_DONE)
            return BDA_NO_MEMORY;
    }
    return BDA_DONE;
}

/* Eliminate all bodies; `rows` become those that each column is coupled to, by their bodies. */
static int eliminate_all(graph *g, elimination *found, list *rows)
{
    for (int64_t column = 0; column < g->bodies; column++) {
        int64_t body = next_body(g);
        if (eliminate(g, body) != BDA_DONE || update_degrees(g, body) != BDA_DONE || append(rows, body) != BDA_DONE)
            return BDA_NO_MEMORY;
        found->place[body] = column;
        for (int64_t at = 0; at < g->coupled[body].count; at++)
            if (append(rows, g->coupled[body].numbers[at]) != BDA_DONE)
                return BDA_NO_MEMORY;
        found->starts[column + 1] = rows->count;
    }
    return BDA_DONE;
}

/* Find in which columns further left each row has a block, and with that the rows of each column in ascending order. */
static int find_left(elimination *found)
{
    int64_t n = found->bodies, blocks = found->starts[n], *next = calloc((size_t)n + 1, sizeof *next);
    found->left = malloc((size_t)(blocks + 1) * sizeof *found->left);
    found->left_blocks = malloc((size_t)(blocks + 1) * sizeof *found->left_blocks);
    if (!next || !found->left || !found->left_blocks) {
        free(next);
        return BDA_NO_MEMORY;
    }
    for (int64_t block = 0; block < blocks; block++)
        found->left_starts[found->rows[block] + 1]++;
    for (int64_t row = 0; row < n; row++) {
        found->left_starts[row + 1] += found->left_starts[row] - 1; /* less the diagonal */
        next[row] = found->left_starts[row];
    }
    for (int64_t column = 0; column < n; column++)
        for (int64_t block = found->starts[column] + 1; block < found->starts[column + 1]; block++)
            found->left[next[found->rows[block]]++] = column;
    for (int64_t row = 0; row < n; row++) {
        found->rows[found->starts[row]] = row;
        next[row] = found->starts[row] + 1;
        for (int64_t at = found->left_starts[row]; at < found->left_starts[row + 1]; at++) {
            int64_t block = next[found->left[at]]++;
            found->rows[block] = row, found->left_blocks[at] = block;
        }
    }
    free(next);
    return BDA_DONE;
}

void forget_elimination(elimination *found)
{
    free(found->place), free(found->starts), free(found->rows);
    free(found->left_starts), free(found->left), free(found->left_blocks);
}

/* Find the order and the blocks of bodies that are coupled in pairs; -1 is a body whose motion is known. */
int find_elimination(elimination *found, int64_t bodies, int64_t pairs, const int64_t *first, const int64_t *second)
{
    graph g = {0};
    list rows = {0};
    memset(found, 0, sizeof *found);
    found->bodies = bodies;
    found->place = calloc((size_t)bodies + 1, sizeof *found->place);
    found->starts = calloc((size_t)bodies + 1, sizeof *found->starts);
    found->left_starts = calloc((size_t)bodies + 1, sizeof *found->left_starts);
    int answer = found->place && found->starts && found->left_starts ? BDA_DONE : BDA_NO_MEMORY;
    if (answer == BDA_DONE)
        answer = begin_graph(&g, bodies, pairs, first, second);
    if (answer == BDA_DONE)
        answer = eliminate_all(&g, found, &rows);
    forget_graph(&g);
    found->rows = rows.numbers;
    for (int64_t at = 0; at < rows.count && answer == BDA_DONE; at++)
        rows.numbers[at] = found->place[rows.numbers[at]];
    return answer == BDA_DONE ? find_left(found) : answer;
}
