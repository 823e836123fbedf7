# SPDX-License-Identifier: GPL-3.0-or-later
"""Which bodies hang together, held against scipy's components of a graph."""

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from bridge_demolition_addon.engineering.elasticity.equations import connected_parts


def test_parts_are_the_components_of_the_graph_in_its_order():
    generator = np.random.default_rng(1)
    for _ in range(300):
        bodies = int(generator.integers(1, 60))
        first, second = generator.integers(0, bodies, (2, int(generator.integers(0, 2 * bodies))))
        moves = generator.random(bodies) < generator.choice([0.0, 0.5, 1.0])
        free = moves[first] & moves[second]
        graph = coo_matrix((np.ones(free.sum()), (first[free], second[free])), shape=(bodies, bodies))
        expected = np.where(moves, connected_components(graph, directed=False)[1], -1)
        assert np.array_equal(connected_parts(moves, first, second), expected)


def test_a_long_chain_in_any_order_is_one_part():
    links = np.random.default_rng(2).permutation(4999)
    assert not connected_parts(np.ones(5000, bool), links, links + 1).any()
