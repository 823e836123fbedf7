"""Members cut into shards."""
