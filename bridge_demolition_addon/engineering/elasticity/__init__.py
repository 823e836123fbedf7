"""Elastic connections: how stiff faces between shards are, and the forces with which they hold bodies together."""
