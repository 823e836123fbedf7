"""How far previews with elastic connections are to be trusted: by docs/data/previews.csv, as docs/sidebar.md has it."""

ALIKE_PERCENT = 93
"""So many spans fall in both or stand in both, of all pairs of a preview and a whole run with other draws of shards."""

LEAST_THROW, MOST_THROW = 0.6, 2.7
"""How far 95 % of the shards get on plan, over that of whole runs, by the medians over draws: least and most of all
scenarios in which a span falls."""
