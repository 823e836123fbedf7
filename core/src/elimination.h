/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * In which order bodies are eliminated, and which blocks of L are not empty then.
 *
 * The order is one of approximate minimum degree (P. R. Amestoy, T. A. Davis and I. S. Duff, 1996, An approximate minimum
 * degree ordering algorithm, SIAM Journal on Matrix Analysis 17, pages 886 to 905): always that body next which is
 * coupled to the fewest others, the lowest number first. A body that is eliminated becomes an element: what it was
 * coupled to is coupled to each other, and the element stands for all these pairs.
 */
#ifndef BDA_ELIMINATION_H
#define BDA_ELIMINATION_H

#include <stdint.h>

/* Columns of L from left to right, of n bodies in the order of elimination; rows ascend, the diagonal comes first. */
typedef struct {
    int64_t bodies;
    int64_t *place;              /* (n,), column of each body */
    int64_t *starts, *rows;      /* (n + 1,), (blocks,) */
    int64_t *left_starts;        /* (n + 1,), and in which columns further left each row has a block, */
    int64_t *left, *left_blocks; /* in ascending order, with the numbers of these blocks */
} elimination;

int find_elimination(elimination *found, int64_t bodies, int64_t pairs, const int64_t *first, const int64_t *second);
void forget_elimination(elimination *found);

#endif
