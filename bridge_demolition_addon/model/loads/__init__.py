"""Forces on parts of the bridge that grow with time."""
