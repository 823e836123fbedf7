"""Reports and charts made with matplotlib from the results of a run."""
