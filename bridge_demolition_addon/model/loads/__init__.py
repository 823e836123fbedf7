"""Forces on parts of the bridge that change with time."""
