"""The folder of a run: what its files are called, and how they are written and read."""
