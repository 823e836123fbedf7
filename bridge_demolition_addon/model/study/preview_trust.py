"""How far previews with elastic connections are to be trusted: as docs/sidebar.md has it, from docs/data/previews.csv."""

ALIKE_PERCENT = 90
"""Of all pairs of a preview and a whole run with another draw of shards: so many spans fall in both, or stand in both."""

LEAST_THROW, MOST_THROW = 0.5, 1.5
"""How far 95 % of the shards get on plan, over that of whole runs, by the medians over draws: least and most of all
scenarios in which a span falls."""
