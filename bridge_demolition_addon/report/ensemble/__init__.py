"""Reports of studies, searches and optimisations: what many runs state about further runs."""
