"""Shards, connections and supports: the structural model."""
