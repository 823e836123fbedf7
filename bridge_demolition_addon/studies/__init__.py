"""Studies, searches and optimisations at work: many runs, each in a process of its own, here or on a cluster."""
