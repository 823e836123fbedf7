/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "equations.h"

#include <stdlib.h>
#include <string.h>

/* Columns of another panel through which a panel goes as rows: `begin` up to `end`, within that panel. */
typedef struct {
    int64_t panel, begin, end;
} stretch;

struct bda_equations {
    int64_t bodies, connections, unknowns, size;
    /* Where each number of the blocks belongs in the triangle, (bodies or connections, 36); `size` where nowhere. */
    uint32_t *of_bodies, *of_first, *of_second, *between;
    double *assembled, *numbers; /* (size + 1), as assembled, and with what is added as they are factored */
    /* The triangle in the order of elimination: starts of columns, rows, and where each number comes from. */
    int64_t *order, *entry_starts, *entry_rows, *sources;
    /* Panels: where they start, stretches of each, rows below each. */
    int64_t panels, *panel_starts, *stretch_starts, *below_starts;
    stretch *stretches;
    uint32_t *below_rows;
    /* L within panels (p, 6, 6) and below them (r, 6), the inverse of D, and lines that are empty between factorings. */
    double *within, *below, *inverse, *lines, *values;
    int64_t *filled;
};

static void *room(int64_t count, size_t size)
{
    return calloc((size_t)(count > 0 ? count : 1), size);
}

static void *copy_of(const void *from, int64_t count, size_t size)
{
    void *copy = room(count, size);
    if (copy && count > 0)
        memcpy(copy, from, (size_t)count * size);
    return copy;
}

void bda_equations_free(bda_equations *e)
{
    if (!e)
        return;
    free(e->of_bodies), free(e->of_first), free(e->of_second), free(e->between);
    free(e->assembled), free(e->numbers);
    free(e->order), free(e->entry_starts), free(e->entry_rows), free(e->sources);
    free(e->panel_starts), free(e->stretch_starts), free(e->below_starts), free(e->stretches), free(e->below_rows);
    free(e->within), free(e->below), free(e->inverse), free(e->lines), free(e->values), free(e->filled);
    free(e);
}

/* Put the triangle into the order of elimination; numbers of a column stay in the order in which they were. */
static int permute(bda_equations *e, const int32_t *starts, const int32_t *rows)
{
    int64_t count = e->unknowns, *place = room(count, sizeof *place), *following;
    e->entry_starts = room(count + 1, sizeof *e->entry_starts);
    e->entry_rows = room(e->size, sizeof *e->entry_rows);
    e->sources = room(e->size, sizeof *e->sources);
    if (!place || !e->entry_starts || !e->entry_rows || !e->sources) {
        free(place);
        return BDA_NO_MEMORY;
    }
    for (int64_t number = 0; number < count; number++)
        place[e->order[number]] = number;
    for (int64_t column = 0; column < count; column++)
        for (int64_t at = starts[column]; at < starts[column + 1]; at++) {
            int64_t one = place[rows[at]], other = place[column];
            e->entry_starts[(one > other ? one : other) + 1]++;
        }
    for (int64_t column = 0; column < count; column++)
        e->entry_starts[column + 1] += e->entry_starts[column];
    following = copy_of(e->entry_starts, count, sizeof *following);
    if (!following) {
        free(place);
        return BDA_NO_MEMORY;
    }
    for (int64_t column = 0; column < count; column++)
        for (int64_t at = starts[column]; at < starts[column + 1]; at++) {
            int64_t one = place[rows[at]], other = place[column];
            int64_t to = following[one > other ? one : other]++;
            e->entry_rows[to] = one < other ? one : other;
            e->sources[to] = at;
        }
    free(place), free(following);
    return BDA_DONE;
}

/* Find the parent of each column of L, -1 for none, and how many numbers are below it (Davis 2006, section 4.1). */
static void elimination_tree(const bda_equations *e, int64_t *parents, int64_t *below, int64_t *seen)
{
    for (int64_t column = 0; column < e->unknowns; column++) {
        parents[column] = -1;
        below[column] = 0;
        seen[column] = column;
        for (int64_t at = e->entry_starts[column]; at < e->entry_starts[column + 1]; at++)
            for (int64_t row = e->entry_rows[at]; seen[row] != column; row = parents[row]) {
                if (parents[row] == -1)
                    parents[row] = column;
                below[row]++;
                seen[row] = column;
            }
    }
}

/* Find the columns of each row of L, in the order in which QDLDL goes through them. */
static void columns_of_rows(const bda_equations *e, const int64_t *parents, int64_t *starts, int64_t *columns,
                            int64_t *seen, int64_t *path, int64_t *found)
{
    for (int64_t row = 0; row < e->unknowns; row++)
        seen[row] = -1;
    starts[0] = 0;
    for (int64_t row = 0; row < e->unknowns; row++) {
        int64_t length = 0;
        for (int64_t at = e->entry_starts[row]; at < e->entry_starts[row + 1]; at++) {
            int64_t steps = 0;
            for (int64_t column = e->entry_rows[at]; column != -1 && column < row && seen[column] != row;
                 column = parents[column]) {
                seen[column] = row;
                path[steps++] = column;
            }
            while (steps > 0)
                found[length++] = path[--steps];
        }
        for (int64_t number = 0; number < length; number++)
            columns[starts[row] + number] = found[length - 1 - number];
        starts[row + 1] = starts[row] + length;
    }
}

/* Whether a column goes on with the panel that begins at `first`: its rows hang on the same columns in one order. */
static int joins(int64_t first, int64_t column, const int64_t *parents, const int64_t *below, const int64_t *starts,
                 const int64_t *columns)
{
    if (column - first <= 0 || column - first >= UNKNOWNS || parents[column - 1] != column ||
        below[column - 1] != below[column] + 1)
        return 0;
    int64_t shared = starts[first + 1] - starts[first], own = starts[column + 1] - starts[column];
    if (own != shared + column - first)
        return 0;
    for (int64_t number = 0; number < own; number++) {
        int64_t expected = number < shared ? columns[starts[first] + number] : first + number - shared;
        if (columns[starts[column] + number] != expected)
            return 0;
    }
    return 1;
}

static void find_panels(bda_equations *e, const int64_t *parents, const int64_t *below, const int64_t *starts,
                        const int64_t *columns)
{
    e->panels = 0;
    for (int64_t column = 0; column < e->unknowns; column++)
        if (!e->panels || !joins(e->panel_starts[e->panels - 1], column, parents, below, starts, columns))
            e->panel_starts[e->panels++] = column;
    e->panel_starts[e->panels] = e->unknowns;
}

/* Find through which columns of other panels each panel goes together, and the rows below each panel. */
static int find_stretches(bda_equations *e, const int64_t *starts, const int64_t *columns, int64_t *panel_of)
{
    int64_t length = 0;
    for (int64_t panel = 0; panel < e->panels; panel++)
        for (int64_t column = e->panel_starts[panel]; column < e->panel_starts[panel + 1]; column++)
            panel_of[column] = panel;
    for (int64_t panel = 0; panel < e->panels; panel++) {
        int64_t row = e->panel_starts[panel];
        for (int64_t at = starts[row]; at < starts[row + 1]; at++) {
            int64_t of = panel_of[columns[at]], number = columns[at] - e->panel_starts[of];
            stretch *last = e->stretches + length - 1;
            if (length > e->stretch_starts[panel] && last->panel == of && last->end == number)
                last->end++;
            else
                e->stretches[length++] = (stretch){of, number, number + 1};
        }
        e->stretch_starts[panel + 1] = length;
    }
    for (int64_t panel = 0; panel < e->panels; panel++)
        for (int64_t at = e->stretch_starts[panel]; at < e->stretch_starts[panel + 1]; at++)
            if (e->stretches[at].begin == 0)
                e->below_starts[e->stretches[at].panel + 1] += e->panel_starts[panel + 1] - e->panel_starts[panel];
    for (int64_t panel = 0; panel < e->panels; panel++)
        e->below_starts[panel + 1] += e->below_starts[panel];
    e->below_rows = room(e->below_starts[e->panels], sizeof *e->below_rows);
    e->below = room(e->below_starts[e->panels] * UNKNOWNS, sizeof *e->below);
    if (!e->below_rows || !e->below)
        return BDA_NO_MEMORY;
    memcpy(e->filled, e->below_starts, (size_t)e->panels * sizeof *e->filled);
    for (int64_t panel = 0; panel < e->panels; panel++)
        for (int64_t at = e->stretch_starts[panel]; at < e->stretch_starts[panel + 1]; at++)
            if (e->stretches[at].begin == 0)
                for (int64_t row = e->panel_starts[panel]; row < e->panel_starts[panel + 1]; row++)
                    e->below_rows[e->filled[e->stretches[at].panel]++] = (uint32_t)row;
    return BDA_DONE;
}

/* Find what follows from the pattern alone, which takes about as long as it takes to factor. */
static int lay_out(bda_equations *e, const int32_t *starts, const int32_t *rows)
{
    int64_t count = e->unknowns, total = 0, *columns = NULL;
    int64_t *work = room(6 * count + 1, sizeof *work);
    int answer = work ? permute(e, starts, rows) : BDA_NO_MEMORY;
    if (answer == BDA_DONE) {
        int64_t *parents = work, *below = work + count, *seen = work + 2 * count, *path = work + 3 * count;
        int64_t *found = work + 4 * count, *row_starts = work + 5 * count;
        elimination_tree(e, parents, below, seen);
        for (int64_t column = 0; column < count; column++)
            total += below[column];
        columns = room(total, sizeof *columns);
        e->stretches = room(total, sizeof *e->stretches);
        answer = columns && e->stretches ? BDA_DONE : BDA_NO_MEMORY;
        if (answer == BDA_DONE) {
            columns_of_rows(e, parents, row_starts, columns, seen, path, found);
            find_panels(e, parents, below, row_starts, columns);
            answer = find_stretches(e, row_starts, columns, seen);
        }
    }
    free(work), free(columns);
    return answer;
}

/* Check that starts ascend, and that all rows, places and the order are within the equations. */
static int is_whole(const bda_equations *e, const int32_t *starts, const int32_t *rows)
{
    const uint32_t *places[] = {e->of_bodies, e->of_first, e->of_second, e->between};
    if (starts[0] != 0 || starts[e->unknowns] != e->size)
        return 0;
    for (int64_t column = 0; column < e->unknowns; column++) {
        if (starts[column + 1] <= starts[column] || e->order[column] < 0 || e->order[column] >= e->unknowns)
            return 0;
        for (int64_t at = starts[column]; at < starts[column + 1]; at++)
            if (rows[at] < 0 || rows[at] > column)
                return 0;
    }
    for (int kind = 0; kind < 4; kind++)
        for (int64_t at = 0; at < BLOCK * (kind ? e->connections : e->bodies); at++)
            if (places[kind][at] > e->size)
                return 0;
    return 1;
}

/* Return equations of bodies and connections with a pattern, an upper triangle of `size` numbers by columns, in which
 * blocks (bodies or connections, 36) have places; the unknowns are eliminated in an order. NULL without memory, or
 * where a number is out of range. */
bda_equations *bda_equations_new(int64_t bodies, int64_t connections, int64_t size, const int32_t *starts,
                                 const int32_t *rows, const uint32_t *of_bodies, const uint32_t *of_first,
                                 const uint32_t *of_second, const uint32_t *between, const int64_t *order)
{
    bda_equations *e = calloc(1, sizeof *e);
    if (!e)
        return NULL;
    int64_t unknowns = UNKNOWNS * bodies;
    e->bodies = bodies, e->connections = connections, e->unknowns = unknowns, e->size = size;
    e->of_bodies = copy_of(of_bodies, BLOCK * bodies, sizeof *of_bodies);
    e->of_first = copy_of(of_first, BLOCK * connections, sizeof *of_first);
    e->of_second = copy_of(of_second, BLOCK * connections, sizeof *of_second);
    e->between = copy_of(between, BLOCK * connections, sizeof *between);
    e->order = copy_of(order, unknowns, sizeof *order);
    e->assembled = room(size + 1, sizeof *e->assembled);
    e->numbers = room(size + 1, sizeof *e->numbers);
    e->panel_starts = room(unknowns + 1, sizeof *e->panel_starts);
    e->stretch_starts = room(unknowns + 1, sizeof *e->stretch_starts);
    e->below_starts = room(unknowns + 1, sizeof *e->below_starts);
    e->filled = room(unknowns + 1, sizeof *e->filled);
    e->within = room(unknowns * BLOCK, sizeof *e->within);
    e->inverse = room(unknowns, sizeof *e->inverse);
    e->lines = room(unknowns * UNKNOWNS, sizeof *e->lines);
    e->values = room(unknowns, sizeof *e->values);
    int has_room = e->of_bodies && e->of_first && e->of_second && e->between && e->order && e->assembled &&
                   e->numbers && e->panel_starts && e->stretch_starts && e->below_starts && e->filled && e->within &&
                   e->inverse && e->lines && e->values;
    if (!has_room || !is_whole(e, starts, rows) || lay_out(e, starts, rows) != BDA_DONE) {
        bda_equations_free(e);
        return NULL;
    }
    return e;
}

/* Add a block to the triangle; of blocks on the diagonal the upper triangle alone counts. */
static inline void add_block(double *totals, const uint32_t *places, const double *block, int upper)
{
    for (int line = 0; line < UNKNOWNS; line++)
        for (int column = upper ? line : 0; column < UNKNOWNS; column++)
            totals[places[UNKNOWNS * line + column]] += block[UNKNOWNS * line + column];
}

static void add_connections(const bda_equations *e, double *totals, int64_t count, const int64_t *connections,
                            const blocks_of_connection *blocks)
{
    for (int64_t row = 0; row < count; row++)
        add_block(totals, e->of_first + BLOCK * connections[row], blocks[row].of_first, 1);
    for (int64_t row = 0; row < count; row++)
        add_block(totals, e->of_second + BLOCK * connections[row], blocks[row].of_second, 1);
    for (int64_t row = 0; row < count; row++)
        add_block(totals, e->between + BLOCK * connections[row], blocks[row].between, 0);
}

static int are_in_range(const bda_equations *e, int64_t count, const int64_t *connections)
{
    for (int64_t row = 0; row < count; row++)
        if (connections[row] < 0 || connections[row] >= e->connections)
            return 0;
    return 1;
}

/* Take over the numbers of all bodies (b, 36), and what some connections (k,) add. */
int bda_equations_assemble(bda_equations *e, const double *of_bodies, int64_t count, const int64_t *connections,
                           const blocks_of_connection *blocks)
{
    if (!are_in_range(e, count, connections))
        return BDA_OUT_OF_RANGE;
    memset(e->assembled, 0, (size_t)(e->size + 1) * sizeof *e->assembled);
    for (int64_t body = 0; body < e->bodies; body++)
        add_block(e->assembled, e->of_bodies + BLOCK * body, of_bodies + BLOCK * body, 1);
    add_connections(e, e->assembled, count, connections, blocks);
    return BDA_DONE;
}

/* Take some columns of a panel out of the lines, which they have changed within the panel. */
static void take_lead(double *restrict lines, const double *within, int64_t column, int64_t width, int64_t begin,
                      int64_t end, double lead[UNKNOWNS][UNKNOWNS])
{
    for (int64_t number = begin; number < end; number++) {
        double *line = lines + UNKNOWNS * (column + number);
        for (int lane = 0; lane < UNKNOWNS; lane++) {
            lead[number][lane] = line[lane];
            line[lane] = 0.0;
        }
        for (int64_t row = number + 1; row < width; row++) {
            double share = within[UNKNOWNS * row + number], *below = lines + UNKNOWNS * (column + row);
            for (int lane = 0; lane < UNKNOWNS; lane++)
                below[lane] -= share * lead[number][lane];
        }
    }
}

/* Subtract what the six columns of a panel do to the rows below that are found, one column after another. */
static void subtract(double *restrict lines, const uint32_t *rows, const double *restrict below, int64_t count,
                     double lead[UNKNOWNS][UNKNOWNS])
{
    for (int64_t at = 0; at < count; at++) {
        double *line = lines + UNKNOWNS * (int64_t)rows[at];
        const double *share = below + UNKNOWNS * at;
        for (int lane = 0; lane < UNKNOWNS; lane++)
            line[lane] = line[lane] - share[0] * lead[0][lane] - share[1] * lead[1][lane] - share[2] * lead[2][lane] -
                         share[3] * lead[3][lane] - share[4] * lead[4][lane] - share[5] * lead[5][lane];
    }
}

/* The same for some columns. */
static void subtract_some(double *restrict lines, const uint32_t *rows, const double *restrict below, int64_t count,
                          int64_t begin, int64_t end, double lead[UNKNOWNS][UNKNOWNS])
{
    for (int64_t at = 0; at < count; at++) {
        double *line = lines + UNKNOWNS * (int64_t)rows[at];
        for (int64_t number = begin; number < end; number++) {
            double share = below[UNKNOWNS * at + number];
            for (int lane = 0; lane < UNKNOWNS; lane++)
                line[lane] -= share * lead[number][lane];
        }
    }
}

/* Write the numbers of the rows of a panel in some columns of another, and subtract what they do to each other. */
static void write_rows(double *lines, double *below, int64_t first, int64_t width, const double *inverse, int64_t begin,
                       int64_t end, double lead[UNKNOWNS][UNKNOWNS], double diagonal[UNKNOWNS])
{
    for (int64_t number = begin; number < end; number++)
        for (int64_t lane = 0; lane < width; lane++) {
            below[UNKNOWNS * lane + number] = lead[number][lane] * inverse[number];
            diagonal[lane] -= lead[number][lane] * below[UNKNOWNS * lane + number];
            for (int64_t row = 0; row < lane; row++)
                lines[UNKNOWNS * (first + row) + lane] -= below[UNKNOWNS * row + number] * lead[number][lane];
        }
}

/* Find the numbers of a panel within itself, and leave its lines empty. */
static void finish_panel(double *lines, double *within, int64_t first, int64_t width, double *inverse,
                         double diagonal[UNKNOWNS])
{
    for (int64_t column = 0; column < width; column++) {
        inverse[first + column] = 1.0 / diagonal[column];
        for (int64_t lane = column + 1; lane < width; lane++) {
            double number = lines[UNKNOWNS * (first + column) + lane];
            for (int64_t row = column + 1; row < lane; row++)
                lines[UNKNOWNS * (first + row) + lane] -= within[UNKNOWNS * row + column] * number;
            within[UNKNOWNS * lane + column] = number * inverse[first + column];
            diagonal[lane] -= number * within[UNKNOWNS * lane + column];
            lines[UNKNOWNS * (first + column) + lane] = 0.0;
        }
    }
}

static void factor_numbers(bda_equations *e)
{
    double lead[UNKNOWNS][UNKNOWNS] = {{0.0}}, diagonal[UNKNOWNS];
    memcpy(e->filled, e->below_starts, (size_t)e->panels * sizeof *e->filled);
    for (int64_t panel = 0; panel < e->panels; panel++) {
        int64_t first = e->panel_starts[panel], width = e->panel_starts[panel + 1] - first;
        for (int64_t lane = 0; lane < width; lane++)
            for (int64_t at = e->entry_starts[first + lane]; at < e->entry_starts[first + lane + 1]; at++) {
                double number = e->numbers[e->sources[at]];
                if (e->entry_rows[at] == first + lane)
                    diagonal[lane] = number;
                else
                    e->lines[UNKNOWNS * e->entry_rows[at] + lane] = number;
            }
        for (int64_t at = e->stretch_starts[panel]; at < e->stretch_starts[panel + 1]; at++) {
            stretch s = e->stretches[at];
            int64_t column = e->panel_starts[s.panel], start = e->below_starts[s.panel], end = e->filled[s.panel];
            take_lead(e->lines, e->within + BLOCK * s.panel, column, e->panel_starts[s.panel + 1] - column, s.begin,
                      s.end, lead);
            const double *found = e->below + UNKNOWNS * start;
            if (s.begin == 0 && s.end == UNKNOWNS)
                subtract(e->lines, e->below_rows + start, found, end - start, lead);
            else
                subtract_some(e->lines, e->below_rows + start, found, end - start, s.begin, s.end, lead);
            write_rows(e->lines, e->below + UNKNOWNS * end, first, width, e->inverse + column, s.begin, s.end, lead,
                       diagonal);
        }
        for (int64_t at = e->stretch_starts[panel]; at < e->stretch_starts[panel + 1]; at++)
            if (e->stretches[at].begin == 0)
                e->filled[e->stretches[at].panel] += width;
        finish_panel(e->lines, e->within + BLOCK * panel, first, width, e->inverse, diagonal);
    }
}

/* Factor what was assembled, with what other connections (k,) add; the next time that is forgotten. */
int bda_equations_factor(bda_equations *e, int64_t count, const int64_t *connections, const blocks_of_connection *blocks)
{
    if (!are_in_range(e, count, connections))
        return BDA_OUT_OF_RANGE;
    if (count) {
        memset(e->numbers, 0, (size_t)(e->size + 1) * sizeof *e->numbers);
        add_connections(e, e->numbers, count, connections, blocks);
        for (int64_t at = 0; at < e->size; at++)
            e->numbers[at] = e->assembled[at] + e->numbers[at];
    } else {
        memcpy(e->numbers, e->assembled, (size_t)e->size * sizeof *e->numbers);
    }
    factor_numbers(e);
    return BDA_DONE;
}

static void substitute_forward(const bda_equations *e, double *values)
{
    for (int64_t panel = 0; panel < e->panels; panel++) {
        int64_t first = e->panel_starts[panel], width = e->panel_starts[panel + 1] - first;
        double *own = values + first;
        for (int64_t column = 0; column < width; column++)
            for (int64_t row = column + 1; row < width; row++)
                own[row] -= e->within[BLOCK * panel + UNKNOWNS * row + column] * own[column];
        for (int64_t at = e->below_starts[panel]; at < e->below_starts[panel + 1]; at++) {
            const double *share = e->below + UNKNOWNS * at;
            double value = values[e->below_rows[at]];
            for (int64_t column = 0; column < width; column++)
                value = value - share[column] * own[column];
            values[e->below_rows[at]] = value;
        }
    }
}

static void substitute_back(const bda_equations *e, double *values)
{
    for (int64_t panel = e->panels - 1; panel >= 0; panel--) {
        int64_t first = e->panel_starts[panel], width = e->panel_starts[panel + 1] - first;
        for (int64_t column = width - 1; column >= 0; column--) {
            double value = values[first + column];
            for (int64_t row = column + 1; row < width; row++)
                value -= e->within[BLOCK * panel + UNKNOWNS * row + column] * values[first + row];
            for (int64_t at = e->below_starts[panel]; at < e->below_starts[panel + 1]; at++)
                value -= e->below[UNKNOWNS * at + column] * values[e->below_rows[at]];
            values[first + column] = value;
        }
    }
}

/* Write the unknowns (6, b) for a right-hand side (6, b). */
void bda_equations_solve(bda_equations *e, const double *right, double *unknowns)
{
    for (int64_t number = 0; number < e->unknowns; number++)
        e->values[number] = right[e->order[number] % UNKNOWNS * e->bodies + e->order[number] / UNKNOWNS];
    substitute_forward(e, e->values);
    for (int64_t number = 0; number < e->unknowns; number++)
        e->values[number] *= e->inverse[number];
    substitute_back(e, e->values);
    for (int64_t number = 0; number < e->unknowns; number++)
        unknowns[e->order[number] % UNKNOWNS * e->bodies + e->order[number] / UNKNOWNS] = e->values[number];
}
