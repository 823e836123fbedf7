/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "equations.h"

#include <stdlib.h>
#include <string.h>

#include "elimination.h"

/* Where what a connection adds belongs: blocks of L, -1 where nothing is added. */
typedef struct {
    int64_t of_first, of_second, between;
    int is_turned; /* whether rows of the block in L are those of the second body */
} places_of_connection;

struct bda_equations {
    int64_t bodies, connections;
    elimination columns;
    places_of_connection *places;  /* (c,) */
    double *assembled, *blocks;    /* (blocks, 36), as assembled, and L: on the diagonal the triangle below its ones */
    double *diagonal, *inverse;    /* (6 n,), D and what is one by it */
    int64_t *block_of_row;         /* (n,), of the column that is being found */
    double *values;                /* (6 n,) */
};

static void *room(int64_t count, size_t size)
{
    return calloc((size_t)(count > 0 ? count : 1), size);
}

int64_t bodies_of_equations(const bda_equations *e) { return e->bodies; }

void bda_equations_free(bda_equations *e)
{
    if (!e)
        return;
    forget_elimination(&e->columns);
    free(e->places), free(e->assembled), free(e->blocks), free(e->diagonal), free(e->inverse);
    free(e->block_of_row), free(e->values);
    free(e);
}

/* Block of L in a row of a column. */
static int64_t block_at(const elimination *c, int64_t row, int64_t column)
{
    int64_t block = c->starts[column];
    while (block + 1 < c->starts[column + 1] && c->rows[block] < row)
        block++;
    return block;
}

static places_of_connection places_of(const elimination *c, int64_t first, int64_t second)
{
    places_of_connection places = {-1, -1, -1, 0};
    if (first >= 0)
        places.of_first = c->starts[c->place[first]];
    if (second >= 0)
        places.of_second = c->starts[c->place[second]];
    if (first >= 0 && second >= 0 && first != second) {
        int64_t one = c->place[first], other = c->place[second];
        places.is_turned = one < other;
        places.between = places.is_turned ? block_at(c, other, one) : block_at(c, one, other);
    }
    return places;
}

/* Return equations of bodies that connections couple in pairs (c,), -1 for a body whose motion is known. NULL without
 * memory, or where a number is out of range. */
bda_equations *bda_equations_new(int64_t bodies, int64_t connections, const int64_t *first, const int64_t *second)
{
    for (int64_t row = 0; row < connections; row++)
        if (first[row] < -1 || first[row] >= bodies || second[row] < -1 || second[row] >= bodies)
            return NULL;
    bda_equations *e = calloc(1, sizeof *e);
    if (!e)
        return NULL;
    e->bodies = bodies, e->connections = connections;
    int answer = find_elimination(&e->columns, bodies, connections, first, second);
    if (answer == BDA_DONE) {
        int64_t blocks = e->columns.starts[bodies];
        e->places = room(connections, sizeof *e->places);
        e->assembled = room(blocks * BLOCK, sizeof *e->assembled);
        e->blocks = room(blocks * BLOCK, sizeof *e->blocks);
        e->diagonal = room(bodies * UNKNOWNS, sizeof *e->diagonal);
        e->inverse = room(bodies * UNKNOWNS, sizeof *e->inverse);
        e->block_of_row = room(bodies, sizeof *e->block_of_row);
        e->values = room(bodies * UNKNOWNS, sizeof *e->values);
    }
    if (answer != BDA_DONE || !e->places || !e->assembled || !e->blocks || !e->diagonal || !e->inverse ||
        !e->block_of_row || !e->values) {
        bda_equations_free(e);
        return NULL;
    }
    for (int64_t row = 0; row < connections; row++)
        e->places[row] = places_of(&e->columns, first[row], second[row]);
    return e;
}

static inline void add_block(double *restrict total, const double *restrict block)
{
    for (int number = 0; number < BLOCK; number++)
        total[number] += block[number];
}

static inline void add_turned(double *restrict total, const double *restrict block)
{
    for (int line = 0; line < UNKNOWNS; line++)
        for (int column = 0; column < UNKNOWNS; column++)
            total[UNKNOWNS * line + column] += block[UNKNOWNS * column + line];
}

static void add_connections(const bda_equations *e, double *totals, int64_t count, const int64_t *connections,
                            const blocks_of_connection *blocks)
{
    for (int64_t row = 0; row < count; row++) {
        const places_of_connection *places = e->places + connections[row];
        if (places->of_first >= 0)
            add_block(totals + BLOCK * places->of_first, blocks[row].of_first);
        if (places->of_second >= 0)
            add_block(totals + BLOCK * places->of_second, blocks[row].of_second);
        if (places->between >= 0 && places->is_turned)
            add_turned(totals + BLOCK * places->between, blocks[row].between);
        else if (places->between >= 0)
            add_block(totals + BLOCK * places->between, blocks[row].between);
    }
}

/* Take over the numbers of all bodies (b, 36), and what some connections (k,) add. */
int bda_equations_assemble(bda_equations *e, const double *of_bodies, int64_t count, const int64_t *connections,
                           const blocks_of_connection *blocks)
{
    if (!all_below(connections, count, e->connections))
        return BDA_OUT_OF_RANGE;
    memset(e->assembled, 0, (size_t)(BLOCK * e->columns.starts[e->bodies]) * sizeof *e->assembled);
    for (int64_t body = 0; body < e->bodies; body++)
        add_block(e->assembled + BLOCK * e->columns.starts[e->columns.place[body]], of_bodies + BLOCK * body);
    add_connections(e, e->assembled, count, connections, blocks);
    return BDA_DONE;
}

/* Subtract the product of two blocks, line by line. */
static inline void subtract_product(double *restrict from, const double *restrict left, const double *restrict right)
{
    for (int line = 0; line < UNKNOWNS; line++) {
        double sum[UNKNOWNS];
        for (int column = 0; column < UNKNOWNS; column++)
            sum[column] = from[UNKNOWNS * line + column];
        for (int number = 0; number < UNKNOWNS; number++)
            for (int column = 0; column < UNKNOWNS; column++)
                sum[column] -= left[UNKNOWNS * line + number] * right[UNKNOWNS * number + column];
        for (int column = 0; column < UNKNOWNS; column++)
            from[UNKNOWNS * line + column] = sum[column];
    }
}

/* Subtract from the blocks of a column what a column further left does to them, which has a block in its row. */
static void subtract(const bda_equations *e, int64_t from, int64_t block)
{
    const elimination *c = &e->columns;
    const double *own = e->blocks + BLOCK * block, *diagonal = e->diagonal + UNKNOWNS * from;
    double turned[BLOCK];
    for (int line = 0; line < UNKNOWNS; line++)
        for (int column = 0; column < UNKNOWNS; column++)
            turned[UNKNOWNS * line + column] = diagonal[line] * own[UNKNOWNS * column + line];
    for (int64_t at = block; at < c->starts[from + 1]; at++)
        subtract_product(e->blocks + BLOCK * e->block_of_row[c->rows[at]], e->blocks + BLOCK * at, turned);
}

/* Factor a block on the diagonal, whose upper triangle counts, in place: L below it; D and its inverse beside it. */
static void factor_diagonal(double *block, double *diagonal, double *inverse)
{
    for (int column = 0; column < UNKNOWNS; column++) {
        double pivot = block[7 * column];
        diagonal[column] = pivot;
        inverse[column] = 1.0 / pivot;
        for (int row = column + 1; row < UNKNOWNS; row++)
            block[UNKNOWNS * row + column] = block[UNKNOWNS * column + row] * inverse[column];
        for (int row = column + 1; row < UNKNOWNS; row++)
            for (int other = row; other < UNKNOWNS; other++)
                block[UNKNOWNS * row + other] -= block[UNKNOWNS * row + column] * block[UNKNOWNS * column + other];
    }
}

/* Divide a block below the diagonal by the triangle on it and by D. */
static void divide(double *block, const double *triangle, const double *inverse)
{
    for (int column = 0; column < UNKNOWNS; column++)
        for (int line = 0; line < UNKNOWNS; line++)
            for (int before = 0; before < column; before++)
                block[UNKNOWNS * line + column] -=
                    block[UNKNOWNS * line + before] * triangle[UNKNOWNS * column + before];
    for (int line = 0; line < UNKNOWNS; line++)
        for (int column = 0; column < UNKNOWNS; column++)
            block[UNKNOWNS * line + column] *= inverse[column];
}

static void find_column(bda_equations *e, int64_t column)
{
    const elimination *c = &e->columns;
    int64_t first = c->starts[column], end = c->starts[column + 1];
    double *triangle = e->blocks + BLOCK * first, *inverse = e->inverse + UNKNOWNS * column;
    for (int64_t block = first; block < end; block++)
        e->block_of_row[c->rows[block]] = block;
    for (int64_t at = c->left_starts[column]; at < c->left_starts[column + 1]; at++)
        subtract(e, c->left[at], c->left_blocks[at]);
    factor_diagonal(triangle, e->diagonal + UNKNOWNS * column, inverse);
    for (int64_t block = first + 1; block < end; block++)
        divide(e->blocks + BLOCK * block, triangle, inverse);
}

/* Factor what was assembled, with what other connections (k,) add; the next time that is forgotten. */
int bda_equations_factor(bda_equations *e, int64_t count, const int64_t *connections, const blocks_of_connection *blocks)
{
    if (!all_below(connections, count, e->connections))
        return BDA_OUT_OF_RANGE;
    memcpy(e->blocks, e->assembled, (size_t)(BLOCK * e->columns.starts[e->bodies]) * sizeof *e->blocks);
    add_connections(e, e->blocks, count, connections, blocks);
    for (int64_t column = 0; column < e->bodies; column++)
        find_column(e, column);
    return BDA_DONE;
}

static void substitute_forward(const bda_equations *e, double *values)
{
    const elimination *c = &e->columns;
    for (int64_t column = 0; column < e->bodies; column++) {
        double *own = values + UNKNOWNS * column;
        const double *triangle = e->blocks + BLOCK * c->starts[column];
        for (int row = 1; row < UNKNOWNS; row++)
            for (int before = 0; before < row; before++)
                own[row] -= triangle[UNKNOWNS * row + before] * own[before];
        for (int64_t block = c->starts[column] + 1; block < c->starts[column + 1]; block++) {
            const double *left = e->blocks + BLOCK * block;
            double *below = values + UNKNOWNS * c->rows[block];
            for (int line = 0; line < UNKNOWNS; line++) {
                const double *share = left + UNKNOWNS * line;
                below[line] -= share[0] * own[0] + share[1] * own[1] + share[2] * own[2] + share[3] * own[3] +
                               share[4] * own[4] + share[5] * own[5];
            }
        }
    }
}

static void substitute_back(const bda_equations *e, double *values)
{
    const elimination *c = &e->columns;
    for (int64_t column = e->bodies - 1; column >= 0; column--) {
        double *own = values + UNKNOWNS * column;
        const double *triangle = e->blocks + BLOCK * c->starts[column];
        for (int64_t block = c->starts[column] + 1; block < c->starts[column + 1]; block++) {
            const double *left = e->blocks + BLOCK * block, *below = values + UNKNOWNS * c->rows[block];
            for (int line = 0; line < UNKNOWNS; line++)
                for (int number = 0; number < UNKNOWNS; number++)
                    own[number] -= left[UNKNOWNS * line + number] * below[line];
        }
        for (int row = UNKNOWNS - 1; row > 0; row--)
            for (int before = 0; before < row; before++)
                own[before] -= triangle[UNKNOWNS * row + before] * own[row];
    }
}

/* Write the unknowns (6, b) for a right-hand side (6, b). */
void bda_equations_solve(bda_equations *e, const double *right, double *unknowns)
{
    for (int64_t body = 0; body < e->bodies; body++)
        for (int axis = 0; axis < UNKNOWNS; axis++)
            e->values[UNKNOWNS * e->columns.place[body] + axis] = right[axis * e->bodies + body];
    substitute_forward(e, e->values);
    for (int64_t number = 0; number < UNKNOWNS * e->bodies; number++)
        e->values[number] *= e->inverse[number];
    substitute_back(e, e->values);
    for (int64_t body = 0; body < e->bodies; body++)
        for (int axis = 0; axis < UNKNOWNS; axis++)
            unknowns[axis * e->bodies + body] = e->values[UNKNOWNS * e->columns.place[body] + axis];
}
